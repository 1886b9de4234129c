// SPDX-License-Identifier: MPL-2.0
#include "molsurf/files.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/kernel/mesh/check_arrays.h"
#include "molsurf/molecule/structure/detect_format.h"
#include "molsurf/molecule/structure/text_fields.h"
#include "molsurf/request/drawn_request.h"
#include "molsurf/request/format_table.h"
#include "molsurf/request/identity.h"
#include "molsurf/request/run_metadata.h"
#include "molsurf/request/run_outputs.h"
#include "molsurf/show/io/commit.h"
#include "molsurf/show/io/file_content.h"
#include "molsurf/show/io/output_file.h"
#include "molsurf/show/io/output_folders.h"
#include "molsurf/show/io/read_mesh.h"
#include "molsurf/show/io/scene.h"
#include "molsurf/show/io/write_mesh.h"
#include "molsurf/show/io/write_report.h"
#include "molsurf/show/io/write_vdb.h"
#include "molsurf/show/picture/draw_mesh.h"
#include "molsurf/show/picture/film.h"
#include "molsurf/show/picture/write_png.h"
#include "molsurf/surface/drawn_surface.h"
#include "molsurf/surface/file_settings.h"
#include "molsurf/surface/solver_files.h"

#include <algorithm>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <tuple>

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

/// Puts atoms into a picture.
void showAtoms(const std::vector<std::pair<std::string, const BallSet*>>& show,
               const BallSet& surface, const Progress& progress, DrawOptions& picture)
{
    std::vector<ShowRule> rules;
    std::vector<BallSet> atoms;
    for (const auto& [word, some] : show) {
        rules.push_back(parseShow(word));
        const ShowRule& rule = rules.back();
        if (!some || !some->names || !some->labels || !rule.select.empty() || rule.others)
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

/// A surface as the files of a request show it.
class FileSurface
{
public:
    FileSurface(const ShownSurface& shown, const Request& request) : shown_(shown)
    {
        checkArrays(shown.surface->mesh);
        if (!shown.atoms->placement.isWhole())
            whole_ = std::make_shared<const WholeBalls>(ballsOfWhole(*shown.atoms));
        if (request.pieces == KeptPieces::All) return;
        own_ = shown.surface->mesh;
        keepPieces(request.pieces, Progress(), *own_);
    }

    const Mesh& mesh() const { return own_ ? *own_ : shown_.surface->mesh; }

    /// Moves the middle of the mesh's box to the origin.
    /// @return where it was [Å]
    openvdb::Vec3d center()
    {
        if (!own_) own_ = shown_.surface->mesh;
        return moveToOrigin(*own_);
    }

    /// The borders that the files of a request show.
    ShownMeshes meshes(const Request& request) const
    {
        ShownMeshes shown =
            shownMeshes(request, *shown_.options, *shown_.atoms, mesh(), whole_, Progress());
        shown.about = aboutPage(shown_.surface->report.surface.kind, shown_.options->voxel);
        return shown;
    }

private:
    const ShownSurface& shown_;
    std::shared_ptr<const WholeBalls> whole_{};
    std::optional<Mesh> own_{}; ///< unless it is that of the surface
};

/// The request of a file: the options of its surface, and those of the file in words.
/// @throws Error(ErrorKind::Usage) if a word is wrong or the file does not show it
Request requestOf(const ShownSurface& shown, const Words& settings, const std::string& path,
                  unsigned holds)
{
    Request request;
    const SelectionRecord& record = shown.atoms->record;
    request.knowsAtoms = bool(record.asked);
    if (record.asked) {
        request.atoms = record.asked->options;
        request.labels = record.asked->labels;
        request.places = record.asked->places;
    }
    request.options = *shown.options;
    request.input = shown.surface->report.input;
    if (request.input.empty()) request.input = std::filesystem::path(path).stem().string();
    request.firstName = shown.name;
    const auto take = [&](const auto& row, const std::string& value) {
        if (!(row.shownIn & holds))
            throw Error(ErrorKind::Usage, memberName(row.name) + ": " + path + " does not show it");
        row.set(request, {value});
    };
    for (const auto& [name, value] : settings) {
        const FileSetting* row = findRow(fileSettings(), name);
        row ? take(*row, value) : take(pictureSetting(name), value);
    }
    return request;
}

/// The files of APBS in a folder, and their lattice.
void takeSolver(const ShownSurface& shown, const std::string& folder, Request& request)
{
    const BallSet& atoms = *shown.atoms;
    if (!atoms.charges || !atoms.placement.isWhole() || !shown.surface->surface)
        throw Error(ErrorKind::Usage,
                    "`for` apbs: expected a surface with a grid, of all atoms of a file with their "
                    "`charges`");
    const std::string& input = shown.surface->report.input;
    request.apbsGrid = solverGrid(request.apbsInput, atoms);
    for (const SolverFile& file : solverFiles())
        request.outputs.push_back({solverPath(folder, input.empty() ? "surface" : input, file.word),
                                   findFormat(file.word)});
}

/// Refuses a file of what the surface was made without.
void checkMade(const ShownSurface& shown, const Output& output)
{
    const MolecularSurface& made = *shown.surface;
    const SurfaceOptions& options = *shown.options;
    const std::string table = output.format->table;
    const bool ofAtoms = table == "atoms" || table == "residues";
    const std::vector<std::tuple<bool, bool, const char*>> needs = {
        {output.holds(holds::Areas), shown.atoms->names && shown.atoms->labels,
         "atoms of a file, with `names` and `labels`"},
        {ofAtoms, !made.ballAreas.empty(), "a surface with `ballAreas`"},
        {table == "contacts", options.contacts || !made.contacts.empty(),
         "a surface with `contacts`"},
        {table == "interfaces", options.interfaces, "a surface with `interfaces`"},
        {table == "pockets", bool(made.report.pockets), "a surface with `pockets`"},
        {table == "patches", bool(made.report.patches), "a surface with `patches`"},
        {output.holds(holds::Numbered), options.pocketBodies, "a surface with `pocketBodies`"},
        {table == "pore", bool(made.report.pore), "a surface of atoms with a `pore`"},
        {table == "tunnels", bool(made.report.tunnels), "a surface of atoms with `tunnelsFrom`"},
        {output.holds(holds::Mask), !made.mesh.triangles.empty(), "a surface with a mesh"},
        {output.holds(holds::anyGrids | holds::Volume), bool(made.surface),
         "a surface with a grid of its own"}};
    for (const auto& [asks, has, what] : needs)
        if (asks && !has)
            throw Error(ErrorKind::Usage, output.path + ": expected " + what + ", got one without");
}

/// The files that a name stands for.
/// @throws Error(ErrorKind::Usage) if the surface has not what they hold
void takeOutputs(const ShownSurface& shown, const Output& output, Request& request)
{
    const std::string& path = output.path;
    checkMade(shown, output);
    request.outputs = {output};
    constexpr int turn = 36; // pictures of a film
    if (output.holds(holds::Moving)) {
        checkFilm(path);
        if (request.turntable == 0) request.turntable = turn;
    }
    if (request.turntable > 0) {
        request.outputs = withTurntable(request.outputs, request.turntable);
        request.picture.turnable = true;
    }
    if (output.holds(holds::Numbered))
        request.outputs = withPockets(request.outputs, shown.surface->report.pockets->list.size());
}

/// The panels of a picture or page.
void takePanels(const std::vector<ShownSurface>& surfaces, bool isPage, Request& request)
{
    const DrawOptions look = request.picture;
    const auto pictureOf = [&](const ShownSurface& shown, bool inPlace) {
        DrawOptions picture = look;
        if (!inPlace) picture.notes.clear();
        const bool likeFirst = inPlace && shown.show.empty();
        if (!isPage)
            showAtoms(likeFirst ? surfaces[0].show : shown.show, *shown.atoms, Progress(), picture);
        return picture;
    };
    request.picture = pictureOf(surfaces[0], true);
    if (surfaces.size() < 2) return;
    request.panelSurfaces = std::make_shared<std::vector<PanelSurface>>();
    for (std::size_t n = 1; n < surfaces.size(); ++n) {
        const ShownSurface& shown = surfaces[n];
        const FileSurface file(shown, request);
        PanelSurface panel{shown.name, *shown.atoms, *shown.options, file.mesh(),
                           file.meshes(request)};
        panel.inPlace = areInOnePlace(*shown.atoms, *surfaces[0].atoms);
        panel.picture = pictureOf(shown, panel.inPlace);
        request.panels.push_back({"", openvdb::Vec3d(0.0), shown.options->kind});
        request.panelSurfaces->push_back(std::move(panel));
    }
}

/// Writes the files of a request, all or none.
void writeRequest(const ShownSurface& shown, Request& request, bool replace)
{
    const Progress nobody;
    FileSurface file(shown, request);
    if (request.center) request.scene.center = file.center();
    ShownMeshes meshes = file.meshes(request);
    if (request.writes(holds::Numbered))
        meshes.bodies = std::make_shared<const Mesh>(shown.surface->pocketBodies);
    const Mesh& mesh = file.mesh();
    Report report = shown.surface->report;
    if (request.writes(holds::Numbers | holds::Grids))
        report.inputSha256 = inputSha256(shown.atoms->record);
    const FileSource source{request,
                            *shown.atoms,
                            *shown.surface,
                            mesh,
                            meshes,
                            report,
                            [&] { return runMetadata(request, report); },
                            nobody};
    std::deque<OutputFile> files;
    std::vector<OutputFile*> all;
    const std::vector<Output> outputs = request.outputs;
    for (const Output& output : outputs) {
        const char* const opens = output.format->opens; // of a script: the file beside it
        if (*opens)
            request.outputs.push_back(
                {std::filesystem::path(output.path).replace_extension(opens).string(),
                 findFormat(opens)});
        all.push_back(&files.emplace_back(output.path, replace));
        writeFile(source, output, files.back());
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

/// Refuses a name that ends in no format.
[[noreturn]] void refuseName(const std::string& path)
{
    const std::string word = formatWordOf(path);
    std::vector<std::string> known;
    for (const std::string& ending : surfaceEndings()) known.push_back(ending.substr(1));
    throw Error(ErrorKind::Usage, path +
                                      ": expected a name that ends in .vdb, .ply, .json, .png, "
                                      ".html, .atoms.csv or another format, got " +
                                      inQuotes(word) + didYouMean(word, known));
}

/// Writes the files of a name, whose format is known.
void writeFormat(const std::vector<ShownSurface>& surfaces, const Output& output,
                 const Words& settings, bool replace)
{
    const std::string& path = output.path;
    const bool isPage = output.holds(holds::ColorChoices);
    const bool isDrawn = isPage || output.holds(holds::Pixels);
    if (surfaces.empty()) throw Error(ErrorKind::Usage, path + ": expected a surface, got none");
    if (surfaces.size() > 1 && !isDrawn)
        throw Error(ErrorKind::Usage, path + ": expected one surface, got " +
                                          std::to_string(surfaces.size()) +
                                          "; pictures, films and pages show more");
    Request request = requestOf(surfaces[0], settings, path, output.format->holds);
    takeOutputs(surfaces[0], output, request);
    if (isDrawn) takePanels(surfaces, isPage, request);
    writeRequest(surfaces[0], request, replace);
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

std::vector<std::string> surfaceEndings()
{
    std::vector<std::string> all;
    for (const Format& format : formatTable())
        if (format.write && !(format.holds & holds::Solver))
            all.push_back("." + std::string(format.word));
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
    const openvdb::GridPtrVec all = surface.grids();
    if (all.empty()) throw Error(ErrorKind::Usage, path + ": the surface has no grid of its own");
    openvdb::MetaMap metadata;
    describeScene(*place, metadata);
    OutputFile file(path, replace);
    writeVdb(placeInScene({all.begin(), all.end()}, *place, false), metadata, file);
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
    const bool isPage = std::filesystem::path(path).extension() == ".html";
    writeFormat(surfaces, {path, findFormat(isPage ? "html" : "png")}, settings, replace);
}

void writeSurface(const std::vector<ShownSurface>& surfaces, const std::string& path,
                  const std::vector<std::pair<std::string, std::string>>& settings, bool replace)
{
    if (surfaces.size() == 1 &&
        std::count(settings.begin(), settings.end(), Words::value_type("for", "apbs"))) {
        Request request = requestOf(surfaces[0], settings, path, holds::Solver);
        takeSolver(surfaces[0], path, request);
        MadeFolders folders; // before the files in it
        folders.make(path);
        return writeRequest(surfaces[0], request, replace);
    }
    const Format* format = findFormat(formatWordOf(path));
    if (!format || !format->write || (format->holds & holds::Solver)) refuseName(path);
    writeFormat(surfaces, {path, format}, settings, replace);
}

} // namespace molsurf
