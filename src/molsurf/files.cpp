// SPDX-License-Identifier: MPL-2.0
#include "molsurf/files.h"

#include "molsurf/color/crisp_borders.h"
#include "molsurf/color/legend.h"
#include "molsurf/color/palette.h"
#include "molsurf/core/words.h"
#include "molsurf/error.h"
#include "molsurf/io/output_file.h"
#include "molsurf/io/read_mesh.h"
#include "molsurf/io/scene.h"
#include "molsurf/io/write_mesh.h"
#include "molsurf/io/write_report.h"
#include "molsurf/io/write_vdb.h"
#include "molsurf/mesh/check_arrays.h"
#include "molsurf/picture/draw_legend.h"
#include "molsurf/picture/draw_mesh.h"
#include "molsurf/picture/write_html.h"
#include "molsurf/picture/write_png.h"
#include "molsurf/selection/subset.h"
#include "molsurf/structure/detect_format.h"
#include "molsurf/structure/text_fields.h"
#include "molsurf/surface/picture_settings.h"
#include "molsurf/surface/surface_kind.h"

#include <filesystem>
#include <optional>

namespace molsurf
{

namespace
{

DrawOptions drawn(int width)
{
    if (width < 16 || width > 16384)
        throw Error(ErrorKind::Usage,
                    "width: expected 16 to 16384 pixels, got " + std::to_string(width));
    DrawOptions options;
    options.width = width;
    return options;
}

/// Balls as motions repeat them, in the colours of those that they are made of.
BallSet repeated(const BallSet& atoms, ColorBy color, const std::vector<std::size_t>& sources)
{
    BallSet colored = atoms;
    if (color != ColorBy::Nothing && colored.colors.empty())
        colored.colors = ballColors(atoms, color, Progress());
    return subset(colored, sources);
}

} // namespace

std::vector<std::string> structureEndings()
{
    std::vector<std::string> all;
    for (const StructureFormatRow& row : structureFormats())
        all.insert(all.end(), row.endings.begin(), row.endings.end());
    return all;
}

std::vector<std::string> meshEndings()
{
    std::vector<std::string> all;
    for (const MeshFormat& format : meshFormats()) all.push_back(std::string(".") + format.word);
    return all;
}

void writeMesh(const Mesh& mesh, const std::string& path, bool replace)
{
    checkArrays(mesh);
    const std::filesystem::path name = path;
    for (const MeshFormat& format : meshFormats()) {
        if (name.extension().string() != std::string(".") + format.word) continue;
        OutputFile file(path, replace);
        format.write(mesh, {name.stem().string()}, file);
        file.commit();
        return;
    }
    throw Error(ErrorKind::Usage,
                path + ": expected a name that ends in " + joinWords(meshEndings(), " or "));
}

void writeVdb(const MolecularSurface& surface, const std::string& path, bool replace,
              const std::string& scene)
{
    const std::optional<Scene> place = scene.empty() ? Scene() : parseScene(scene);
    if (!place)
        throw Error(ErrorKind::Usage, "scene: expected blender, houdini or usd, perhaps with "
                                      "=SCALE, got " +
                                          inQuotes(scene));
    const openvdb::GridPtrVec all = surface.grids();
    if (all.empty()) throw Error(ErrorKind::Usage, path + ": the surface has no grid of its own");
    const openvdb::GridCPtrVec grids(all.begin(), all.end());
    openvdb::MetaMap metadata;
    describeScene(*place, metadata);
    OutputFile file(path, replace);
    writeVdb(place->known() ? placeInScene(grids, *place) : grids, metadata, file);
    file.commit();
}

void writeReport(const Report& report, const std::string& path, bool replace)
{
    OutputFile file(path, replace);
    writeReport(report, file);
    file.commit();
}

void writePicture(const Mesh& mesh, const std::string& path, int width, bool replace)
{
    checkArrays(mesh);
    OutputFile file(path, replace);
    writePng(drawMesh(mesh, drawn(width), Progress()), file);
    file.commit();
}

void writePicture(const BallSet& atoms, const MolecularSurface& surface,
                  const SurfaceOptions& options, const std::string& path,
                  const std::vector<std::pair<std::string, std::string>>& settings, bool replace)
{
    const Progress nobody;
    const Mesh& mesh = surface.mesh;
    checkArrays(mesh);
    const ColorBy color = options.color;
    PictureSettings look;
    for (const auto& [name, value] : settings) pictureSetting(name).set(look, {value});
    DrawOptions& how = look.picture;
    setUpright(atoms, how);
    if (color == ColorBy::Pocket) how.glass = neutralColor;
    const WholeBalls whole = ballsOfWhole(atoms);
    for (const Ball& ball : whole.balls) how.about.push_back(ball.center);
    const std::filesystem::path name = path;
    OutputFile file(path, replace);
    if (name.extension() == ".html") {
        HtmlPage page;
        page.title = name.stem().string();
        page.about = aboutPage(surface.report.surface.kind, options.voxel);
        page.legends = offeredLegends(color, atoms, mesh, nobody);
        page.axes = viewAxes(mesh, how);
        if (atoms.names) {
            nameAtoms(*atoms.names, whole.balls, mesh, nobody, page);
            for (std::int32_t& ball : page.ballOf)
                if (ball >= 0) ball = std::int32_t(whole.sources[std::size_t(ball)]);
        }
        colorCut(atoms, whole.balls, nobody, page);
        writeHtml(mesh, page, file);
    } else {
        const bool repeats = !atoms.placement.isWhole();
        how.borders = bordersOf(color, repeats ? repeated(atoms, color, whole.sources) : atoms,
                                asMeshed(whole.balls, options), mesh, nobody);
        if (how.clip) how.inside = insideColors(options, atoms, openvdb::Vec3d(0.0), how.borders);
        const auto legends = look.drawsLegend()
                                 ? legendsOf(legendOf(color, atoms, mesh, nobody), nullptr)
                                 : std::vector<Legend>();
        writePng(drawExplained(mesh, std::move(how), legends, look.scaleBar, nobody), file);
    }
    file.commit();
}

} // namespace molsurf
