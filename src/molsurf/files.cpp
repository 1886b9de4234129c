// SPDX-License-Identifier: MPL-2.0
#include "molsurf/files.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/kernel/mesh/check_arrays.h"
#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/molecule/structure/archive.h"
#include "molsurf/molecule/structure/detect_format.h"
#include "molsurf/molecule/structure/text_fields.h"
#include "molsurf/show/color/crisp_borders.h"
#include "molsurf/show/color/palette.h"
#include "molsurf/show/io/commit.h"
#include "molsurf/show/io/file_content.h"
#include "molsurf/show/io/output_file.h"
#include "molsurf/show/io/output_folders.h"
#include "molsurf/show/io/read_mesh.h"
#include "molsurf/show/io/scene.h"
#include "molsurf/show/io/write_glb.h"
#include "molsurf/show/io/write_mesh.h"
#include "molsurf/show/io/write_nvdb.h"
#include "molsurf/show/io/write_report.h"
#include "molsurf/show/io/write_vdb.h"
#include "molsurf/show/picture/draw_mesh.h"
#include "molsurf/show/picture/write_png.h"
#include "molsurf/surface/drawn_surface.h"
#include "molsurf/surface/file_settings.h"
#include "molsurf/surface/solver_files.h"

#include <algorithm>
#include <deque>
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

using Words = std::vector<std::pair<std::string, std::string>>;

/// The options of a file.
struct FileLook : PictureSettings, FileSettings {
};

/// Sets what words say.
/// @param[in] holds  the content of the file, a set of holds::Content
/// @throws Error(ErrorKind::Usage) if one is wrong or the file does not show it
FileLook lookOf(const Words& settings, const std::string& path, unsigned holds)
{
    FileLook look;
    const auto take = [&](const auto& row, const std::string& value) {
        if (!(row.shownIn & holds))
            throw Error(ErrorKind::Usage, memberName(row.name) + ": " + path + " does not show it");
        row.set(look, {value});
    };
    for (const auto& [name, value] : settings) {
        const FileSetting* row = findRow(fileSettings(), name);
        row ? take(*row, value) : take(pictureSetting(name), value);
    }
    return look;
}

/// A surface as a file shows it: in the place of the whole, with the walls and the borders between
/// colours that are asked for.
class FileSurface
{
public:
    FileSurface(const ShownSurface& shown, const FileLook& look)
        : shown_(shown), look_(look), whole_(ballsOfWhole(*shown.atoms))
    {
        checkArrays(shown.surface->mesh);
        if (look.walls == Walls::All) return;
        own_ = shown.surface->mesh;
        keepWalls(look.walls, Progress(), *own_);
    }

    const Mesh& mesh() const { return own_ ? *own_ : shown_.surface->mesh; }

    /// Finds the borders between colours.
    /// @param[in] cut  whether triangles are cut there
    void findBorders(bool cut)
    {
        const BallSet& atoms = *shown_.atoms;
        const SurfaceOptions& options = *shown_.options;
        const Progress nobody;
        const BallSet colored = repeats() ? repeated(atoms, options.color, whole_) : BallSet();
        const BallSet& all = repeats() ? colored : atoms;
        borders_ = bordersOf(options.color, all, asMeshed(whole_.balls, options), mesh(), nobody);
        if (cut && borders_) own_ = crispMesh(mesh(), *borders_, all, options, nobody);
    }

    /// Moves the middle of the mesh's box to the origin.
    /// @return where it was [Å]
    openvdb::Vec3d center()
    {
        if (!own_) own_ = shown_.surface->mesh;
        return moveToOrigin(*own_);
    }

    DrawnSurface drawn() const
    {
        DrawnSurface all{*shown_.atoms, mesh(), *shown_.options, look_.picture,
                         repeats() ? &whole_ : nullptr};
        all.name = shown_.name;
        all.borders = borders_;
        return all;
    }

private:
    bool repeats() const { return !shown_.atoms->placement.isWhole(); }

    const ShownSurface& shown_;
    const FileLook& look_;
    WholeBalls whole_;
    std::optional<Mesh> own_{}; ///< unless it is that of the surface
    std::shared_ptr<const ColorOwners> borders_{};
};

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
        layers.push_back({drawn[n].mesh, std::move(page)});
    }
    return layers;
}

void drawSurfaceFiles(const std::vector<ShownSurface>& surfaces, const std::string& path,
                      const FileLook& look, bool isPage, bool replace)
{
    const Progress nobody;
    std::deque<FileSurface> made; // DrawnSurface refers to it
    std::vector<DrawnSurface> drawn;
    for (const ShownSurface& shown : surfaces) {
        made.emplace_back(shown, look).findBorders(isPage);
        drawn.push_back(made.back().drawn());
        const bool inPlace = areInOnePlace(*shown.atoms, *surfaces[0].atoms);
        if (!inPlace) drawn.back().look.notes.clear();
        if (isPage) continue;
        const bool likeFirst = inPlace && shown.show.empty();
        showAtoms(likeFirst ? surfaces[0].show : shown.show, *shown.atoms, nobody,
                  drawn.back().look);
    }
    const std::string title = std::filesystem::path(path).stem().string();
    OutputFile file(path, replace);
    isPage ? writeHtml(layersOf(surfaces, drawn, title, nobody), file)
           : writePng(drawSurfaces(drawn, look, nobody), file);
    file.commit();
}

/// @param[in] path  for messages
openvdb::GridCPtrVec placedGrids(const MolecularSurface& surface, const std::string& path,
                                 const Scene& scene, bool moved)
{
    const openvdb::GridPtrVec all = surface.grids();
    if (all.empty()) throw Error(ErrorKind::Usage, path + ": the surface has no grid of its own");
    const openvdb::GridCPtrVec grids(all.begin(), all.end());
    return placeInScene(grids, scene, moved);
}

void writeGrids(const openvdb::GridCPtrVec& grids, const std::string& path, const Scene& scene,
                bool replace)
{
    openvdb::MetaMap metadata;
    describeScene(scene, metadata);
    OutputFile file(path, replace);
    writeVdb(grids, metadata, file);
    file.commit();
}

void writeBareGrids(const openvdb::GridCPtrVec& grids, const std::string& path, bool replace)
{
    OutputFile file(path, replace);
    writeNvdb(grids, file);
    file.commit();
}

/// Writes what APBS reads into a folder, which is made.
void writeSolverFiles(const ShownSurface& shown, const std::string& folder, const FileLook& look,
                      bool replace)
{
    const BallSet& atoms = *shown.atoms;
    if (!atoms.charges || !atoms.placement.isWhole() || !shown.surface->surface)
        throw Error(ErrorKind::Usage,
                    "`for` apbs: expected a surface with a grid, of all atoms of a file with their "
                    "`charges`");
    const std::string& input = shown.surface->report.input;
    const auto pathOf = [&](const std::string& word) {
        return solverPath(folder, input.empty() ? "surface" : input, word);
    };
    const SolverRun run{atoms,
                        *shown.surface->surface,
                        solverGrid(look.apbsInput, atoms),
                        look.dielectric,
                        displayName(inputStem(input)) + ", surface " + nameOf(shown.options->kind),
                        pathOf};
    MadeFolders folders; // before the files in it
    folders.make(folder);
    std::deque<OutputFile> files;
    std::vector<OutputFile*> all;
    for (const SolverFile& row : solverFiles()) {
        all.push_back(&files.emplace_back(pathOf(row.word), replace));
        row.write(run, Progress(), files.back());
    }
    commit(all);
}

/// The format of a mesh file, or null.
const MeshFormat* meshFormatOf(const std::string& ending)
{
    for (const MeshFormat& format : meshFormats())
        if (ending == std::string(".") + format.word) return &format;
    return nullptr;
}

void writeMeshFile(const ShownSurface& shown, const MeshFormat& format, const std::string& path,
                   const FileLook& look, bool replace)
{
    FileSurface made(shown, look);
    if (look.crisp) made.findBorders(true);
    if (look.center) made.center();
    const std::string name = std::filesystem::path(path).stem().string();
    OutputFile file(path, replace);
    if (format.holds & holds::SceneUnits)
        writeGlb(made.mesh(), {name, look.scene.scale, look.picture.plain}, file);
    else
        format.write(made.mesh(), {name, look.printUnit()}, file);
    file.commit();
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
    const MeshFormat* format = meshFormatOf(name.extension().string());
    if (!format)
        throw Error(ErrorKind::Usage,
                    path + ": expected a name that ends in " + joinWords(meshEndings(), " or "));
    OutputFile file(path, replace);
    format->write(mesh, {name.stem().string()}, file);
    file.commit();
}

void writeVdb(const MolecularSurface& surface, const std::string& path, bool replace,
              const std::string& scene)
{
    const std::optional<Scene> place = scene.empty() ? Scene() : parseScene(scene);
    if (!place)
        throw Error(ErrorKind::Usage, "scene: expected blender, houdini or usd, perhaps with "
                                      "=SCALE, got " +
                                          inQuotes(scene));
    writeGrids(placedGrids(surface, path, *place, false), path, *place, replace);
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
    const bool isPage = std::filesystem::path(path).extension() == ".html";
    const FileLook look = lookOf(settings, path, isPage ? holds::heldByHtml : holds::heldByPng);
    if (surfaces.empty()) throw Error(ErrorKind::Usage, path + ": expected a surface, got none");
    drawSurfaceFiles(surfaces, path, look, isPage, replace);
}

void writeSurface(const std::vector<ShownSurface>& surfaces, const std::string& path,
                  const std::vector<std::pair<std::string, std::string>>& settings, bool replace)
{
    const std::string ending = std::filesystem::path(path).extension().string();
    if (ending == ".png" || ending == ".html")
        return writePicture(surfaces, path, settings, replace);
    if (surfaces.size() != 1)
        throw Error(ErrorKind::Usage,
                    path + ": expected one surface, got " + std::to_string(surfaces.size()));
    const ShownSurface& shown = surfaces[0];
    if (std::count(settings.begin(), settings.end(),
                   std::pair<std::string, std::string>("for", "apbs")))
        return writeSolverFiles(shown, path, lookOf(settings, path, holds::Solver), replace);
    if (const bool isBare = ending == ".nvdb"; isBare || ending == ".vdb") {
        FileLook look = lookOf(settings, path, isBare ? holds::heldByNvdb : holds::heldByVdb);
        if (look.center) look.scene.center = FileSurface(shown, look).center();
        const auto grids = placedGrids(*shown.surface, path, look.scene, look.center);
        return isBare ? writeBareGrids(grids, path, replace)
                      : writeGrids(grids, path, look.scene, replace);
    }
    if (ending == ".json") {
        lookOf(settings, path, holds::Numbers);
        return writeReport(shown.surface->report, path, replace);
    }
    if (const MeshFormat* format = meshFormatOf(ending))
        return writeMeshFile(shown, *format, path, lookOf(settings, path, format->holds), replace);
    throw Error(ErrorKind::Usage, path + ": expected a name that ends in " +
                                      joinWords(meshEndings(), ", ") +
                                      ", .vdb, .nvdb, .json, .png or .html");
}

} // namespace molsurf
