// SPDX-License-Identifier: MPL-2.0
#include "sidecar.h"

#include "write_result.h"

#include "molsurf/error.h"
#include "molsurf/show/io/frame_files.h"
#include "molsurf/show/io/usda_text.h"
#include "molsurf/show/io/write_usda_mesh.h"

#include <algorithm>
#include <filesystem>

namespace molsurf::tool
{

namespace fs = std::filesystem;

void addSidecars(CommandLine& call)
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

bool isFilm(const Output& output)
{
    return output.holds(Stage) && fs::path(output.beside).extension() == ".usda";
}

bool mayReplace(const CommandLine& call, const Output& output)
{
    if (call.force) return true;
    if (!output.holds(Stage) || !frameName(output.beside).frame) return false;
    return isFilm(output) ? isOwnFilm(output.path) : isOwnUsda(output.path);
}

namespace
{

constexpr double defaultRate = 24.0; // frames a second

double rateOf(const CommandLine& call)
{
    return call.fps > 0.0 ? call.fps : defaultRate;
}

/// The frames that a .usda shows.
FrameFiles framesOf(const CommandLine& call, const Output& output)
{
    return framesBeside(output.beside, call.frame > 0 ? optionsDigest(call) : "",
                        *call.frameOptions);
}

} // namespace

UsdVolume usdVolume(const CommandLine& call, const Output& output)
{
    const std::string vdb = output.beside.empty()
                                ? fs::path(output.path).replace_extension(".vdb").string()
                                : output.beside;
    UsdVolume volume;
    volume.name = frameName(vdb).stem;
    volume.metersPerUnit = usdaMetersPerAngstrom / call.scene.scale;
    volume.file = fs::path(vdb).filename().string();
    // With --fog-density the density has what an Å scatters.
    constexpr double scattering = 0.5; // [1/Å]
    volume.scattering = call.scene.fogDensity > 0.0 ? 1.0 : scattering / call.scene.scale;
    if (!frameName(output.beside).frame) return volume;
    volume.frames = framesOf(call, output).frames;
    volume.framesPerSecond = rateOf(call);
    if (isOwnUsda(output.path)) volume.extents = extentsOfUsda(output.path);
    return volume;
}

void writeMeshStage(const CommandLine& call, const Output& output, const Mesh& mesh,
                    OutputFile& file)
{
    const std::string frame = isFilm(output) ? output.beside : output.path;
    UsdScene scene{fs::path(output.path).stem().string(),
                   call.scene.scale,
                   call.picture.plain,
                   call.options.fields,
                   {}};
    if (call.frame > 0) {
        const FrameName name = frameName(frame);
        scene.name = name.stem;
        scene.frame = {name.frame.value_or(0), call.frame, optionsDigest(call), rateOf(call),
                       call.fps > 0.0 ? 1.0 : defaultRate};
    }
    if (isFilm(output))
        writeUsdaFilm(mesh, scene, framesOf(call, output).frames, file);
    else
        writeUsdaMesh(mesh, scene, file);
}

std::vector<std::string> leftOutOf(const CommandLine& call)
{
    std::vector<std::string> lines;
    for (const Output& output : call.outputs) {
        if (!output.holds(Stage) || !frameName(output.beside).frame) continue;
        const std::vector<std::string> files = framesOf(call, output).leftOut;
        if (files.empty()) continue;
        lines.push_back(output.path + ": without " + files.front() +
                        (files.size() > 1 ? " and " + std::to_string(files.size() - 1) + " more"
                                          : std::string()) +
                        ", of another input or other options");
    }
    return lines;
}

} // namespace molsurf::tool
