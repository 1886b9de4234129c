// SPDX-License-Identifier: MPL-2.0
#include "sidecar.h"

#include "write_result.h"

#include "molsurf/error.h"
#include "molsurf/io/usda_text.h"

#include <algorithm>
#include <filesystem>

namespace molsurf::tool
{

namespace fs = std::filesystem;

void addSidecars(Call& call)
{
    std::vector<Output> sidecars;
    for (const Output& output : call.outputs) {
        if (!output.holds(Grids)) continue;
        if (isStream(output.path))
            throw Error(ErrorKind::Usage,
                        "--for usd: expected a file for the .vdb, got " + output.path);
        const fs::path path = output.path;
        if (call.verb == Verb::Batch) // its paths are extensions
            sidecars.push_back({".usda", findFormat("usda")});
        else
            sidecars.push_back(
                {(path.parent_path() / (frameName(output.path).stem + ".usda")).string(),
                 findFormat("usda"), output.path});
        const auto same = [&](const Output& o) {
            return fs::path(o.path).lexically_normal() ==
                   fs::path(sidecars.back().path).lexically_normal();
        };
        if (std::any_of(call.outputs.begin(), call.outputs.end(), same))
            throw Error(ErrorKind::Usage, "-o " + sidecars.back().path +
                                              ": --for usd writes that file beside " + output.path +
                                              " [hint: another name]");
        if (std::count_if(sidecars.begin(), sidecars.end(), same) > 1)
            throw Error(ErrorKind::Usage, "--for usd: two .vdb files would have " +
                                              sidecars.back().path + " beside them");
    }
    call.outputs.insert(call.outputs.end(), sidecars.begin(), sidecars.end());
}

bool mayReplace(const Call& call, const Output& output)
{
    return call.force || (output.holds(Stage) && !output.beside.empty() &&
                          frameName(output.beside).frame && isOwnUsda(output.path));
}

UsdVolume usdVolume(const Call& call, const Output& output)
{
    const std::string vdb = output.beside.empty()
                                ? fs::path(output.path).replace_extension(".vdb").string()
                                : output.beside;
    UsdVolume volume =
        usdVolumeOf(vdb, !output.beside.empty(), call.frame > 0 ? optionsDigest(call) : "",
                    usdaMetersPerAngstrom / call.scene.scale);
    if (call.fps > 0.0) volume.framesPerSecond = call.fps;
    if (isOwnUsda(output.path)) volume.extents = extentsOfUsda(output.path);
    return volume;
}

std::vector<std::string> leftOutOf(const Call& call)
{
    std::vector<std::string> lines;
    for (const Output& output : call.outputs) {
        if (!output.holds(Stage) || output.beside.empty()) continue;
        const std::vector<std::string> files = usdVolume(call, output).leftOut;
        if (files.empty()) continue;
        lines.push_back(output.path + ": without " + files.front() +
                        (files.size() > 1 ? " and " + std::to_string(files.size() - 1) + " more"
                                          : std::string()) +
                        ", of another input or other options");
    }
    return lines;
}

} // namespace molsurf::tool
