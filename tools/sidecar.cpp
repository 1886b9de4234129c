// SPDX-License-Identifier: MPL-2.0
#include "sidecar.h"

#include "molsurf/error.h"
#include "molsurf/request/usd_stage.h"
#include "molsurf/show/io/frame_files.h"
#include "molsurf/show/io/usda_text.h"
#include "molsurf/show/io/write_usda.h"
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

bool mayReplace(const CommandLine& call, const Output& output)
{
    if (call.force) return true;
    if (!output.holds(Stage) || !frameName(output.beside).frame) return false;
    return isFilm(output) ? isOwnFilm(output.path) : isOwnUsda(output.path);
}

} // namespace molsurf::tool
