// SPDX-License-Identifier: MPL-2.0
#include "molsurf/files.h"

#include "molsurf/color/crisp_borders.h"
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
#include "molsurf/picture/draw_mesh.h"
#include "molsurf/picture/write_png.h"
#include "molsurf/structure/detect_format.h"
#include "molsurf/structure/text_fields.h"
#include "molsurf/surface/drawn_surface.h"
#include "molsurf/surface/surface_kind.h"

#include <algorithm>
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
BallSet repeated(const BallSet& atoms, ColorBy color, const WholeBalls& whole)
{
    BallSet colored = atoms;
    if (color != ColorBy::Nothing && colored.colors.empty())
        colored.colors = ballColors(atoms, color, Progress());
    return subset(colored, whole.sources);
}

/// Puts atoms into a picture.
void showAtoms(const std::vector<std::pair<std::string, const BallSet*>>& show,
               const BallSet& surface, const Progress& progress, DrawOptions& picture)
{
    std::vector<ShowRule> rules;
    std::vector<BallSet> atoms;
    for (const auto& [word, some] : show) {
        rules.push_back(parseShow(word));
        if (!some || !some->names || !some->labels || !rules.back().select.empty())
            throw Error(ErrorKind::Usage,
                        "`show`: expected a word and atoms with names, got " + inQuotes(word));
        atoms.push_back(*some);
    }
    showAtoms(rules, std::move(atoms), nullptr, surface, progress, picture);
}

/// Whether two sets have the same balls, but for their radii.
bool areInOnePlace(const BallSet& a, const BallSet& b)
{
    return std::equal(
        a.balls.begin(), a.balls.end(), b.balls.begin(), b.balls.end(),
        [](const Ball& one, const Ball& other) { return one.center == other.center; });
}

/// The layers of a page.
std::vector<HtmlLayer> layersOf(const std::vector<ShownSurface>& surfaces,
                                const std::vector<DrawnSurface>& drawn, const std::string& title,
                                const Progress& progress)
{
    std::vector<HtmlLayer> layers;
    for (std::size_t n = 0; n < surfaces.size(); ++n) {
        const ShownSurface& shown = surfaces[n];
        const std::string about =
            aboutPage(shown.surface->report.surface.kind, shown.options->voxel);
        HtmlPage page = pageOf(drawn[n], title, about, progress);
        page.inPlace = areInOnePlace(*shown.atoms, *surfaces[0].atoms);
        layers.push_back({shown.surface->mesh, std::move(page)});
    }
    return layers;
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
    writePicture({{&atoms, &surface, &options}}, path, settings, replace);
}

void writePicture(const std::vector<ShownSurface>& surfaces, const std::string& path,
                  const std::vector<std::pair<std::string, std::string>>& settings, bool replace)
{
    const Progress nobody;
    const std::filesystem::path name = path;
    const bool isPage = name.extension() == ".html";
    PictureSettings look;
    for (const auto& [setting, value] : settings) pictureSetting(setting).set(look, {value});
    if (surfaces.empty()) throw Error(ErrorKind::Usage, path + ": expected a surface, got none");
    std::vector<WholeBalls> wholes;
    for (const ShownSurface& shown : surfaces) {
        checkArrays(shown.surface->mesh);
        wholes.push_back(ballsOfWhole(*shown.atoms));
    }
    std::vector<DrawnSurface> drawn;
    for (std::size_t n = 0; n < surfaces.size(); ++n) {
        const ShownSurface& shown = surfaces[n];
        const BallSet& atoms = *shown.atoms;
        const SurfaceOptions& options = *shown.options;
        const bool repeats = !atoms.placement.isWhole();
        drawn.push_back(
            {atoms, shown.surface->mesh, options, look.picture, repeats ? &wholes[n] : nullptr});
        drawn[n].name = shown.name;
        const bool inPlace = areInOnePlace(atoms, *surfaces[0].atoms);
        if (!inPlace) drawn[n].look.notes.clear();
        if (isPage) continue;
        const bool likeFirst = inPlace && shown.show.empty();
        showAtoms(likeFirst ? surfaces[0].show : shown.show, atoms, nobody, drawn[n].look);
        drawn[n].borders =
            bordersOf(options.color, repeats ? repeated(atoms, options.color, wholes[n]) : atoms,
                      asMeshed(wholes[n].balls, options), shown.surface->mesh, nobody);
    }
    OutputFile file(path, replace);
    isPage ? writeHtml(layersOf(surfaces, drawn, name.stem().string(), nobody), file)
           : writePng(drawSurfaces(drawn, look, nobody), file);
    file.commit();
}

} // namespace molsurf
