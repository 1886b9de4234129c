// SPDX-License-Identifier: MPL-2.0
#include "molsurf/request/usd_stage.h"

#include "molsurf/show/io/frame_files.h"
#include "molsurf/show/io/usda_text.h"
#include "molsurf/show/io/write_usda_mesh.h"

#include <filesystem>

namespace molsurf
{

using namespace holds;
namespace fs = std::filesystem;

bool isFilm(const Output& output)
{
    return output.holds(Stage) && fs::path(output.beside).extension() == ".usda";
}

namespace
{

constexpr double defaultRate = 24.0; // frames a second

double rateOf(const Request& request)
{
    return request.fps > 0.0 ? request.fps : defaultRate;
}

/// The frames that a .usda shows.
FrameFiles framesOf(const Request& request, const Output& output)
{
    return framesBeside(output.beside, request.frameDigest, *request.frameOptions);
}

} // namespace

UsdVolume usdVolume(const Request& request, const Output& output)
{
    const std::string vdb = output.beside.empty()
                                ? fs::path(output.path).replace_extension(".vdb").string()
                                : output.beside;
    UsdVolume volume;
    volume.name = frameName(vdb).stem;
    volume.metersPerUnit = usdaMetersPerAngstrom / request.scene.scale;
    volume.file = fs::path(vdb).filename().string();
    // With --fog-density the density has what an Å scatters.
    constexpr double scattering = 0.5; // [1/Å]
    volume.scattering = request.scene.fogDensity > 0.0 ? 1.0 : scattering / request.scene.scale;
    if (!frameName(output.beside).frame) return volume;
    volume.frames = framesOf(request, output).frames;
    volume.framesPerSecond = rateOf(request);
    if (isOwnUsda(output.path)) volume.extents = extentsOfUsda(output.path);
    return volume;
}

void writeUsdStage(const Request& request, const Output& output, const Mesh& mesh, OutputFile& file)
{
    const std::string frame = isFilm(output) ? output.beside : output.path;
    UsdScene scene{fs::path(output.path).stem().string(),
                   request.scene.scale,
                   request.picture.plain,
                   request.options.fields,
                   {}};
    if (request.frame > 0) {
        const FrameName name = frameName(frame);
        scene.name = name.stem;
        scene.frame = {name.frame.value_or(0), request.frame, request.frameDigest, rateOf(request),
                       request.fps > 0.0 ? 1.0 : defaultRate};
    }
    if (isFilm(output))
        writeUsdaFilm(mesh, scene, framesOf(request, output).frames, file);
    else
        writeUsdaMesh(mesh, scene, file);
}

std::vector<std::string> leftOutOf(const Request& request)
{
    std::vector<std::string> lines;
    for (const Output& output : request.outputs) {
        if (!output.holds(Stage) || !frameName(output.beside).frame) continue;
        const std::vector<std::string> files = framesOf(request, output).leftOut;
        if (files.empty()) continue;
        lines.push_back(output.path + ": without " + files.front() +
                        (files.size() > 1 ? " and " + std::to_string(files.size() - 1) + " more"
                                          : std::string()) +
                        ", of another input or other options");
    }
    return lines;
}

} // namespace molsurf
