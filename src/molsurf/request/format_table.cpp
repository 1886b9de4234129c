// SPDX-License-Identifier: MPL-2.0
#include "molsurf/request/format_table.h"

#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/molecule/structure/archive.h"
#include "molsurf/molecule/structure/text_fields.h"
#include "molsurf/request/drawn_request.h"
#include "molsurf/request/usd_stage.h"
#include "molsurf/show/color/color_table.h"
#include "molsurf/show/color/legend.h"
#include "molsurf/show/color/palette.h"
#include "molsurf/show/io/part_ranges.h"
#include "molsurf/show/io/write_glb.h"
#include "molsurf/show/io/write_mesh.h"
#include "molsurf/show/io/write_nvdb.h"
#include "molsurf/show/io/write_report.h"
#include "molsurf/show/io/write_structure.h"
#include "molsurf/show/io/write_table.h"
#include "molsurf/show/io/write_tunnels.h"
#include "molsurf/show/io/write_usda.h"
#include "molsurf/show/io/write_usda_instances.h"
#include "molsurf/show/io/write_vdb.h"
#include "molsurf/show/io/write_view_script.h"
#include "molsurf/show/io/write_volume.h"
#include "molsurf/show/picture/draw_profile.h"
#include "molsurf/show/picture/film.h"
#include "molsurf/show/picture/legend_svg.h"
#include "molsurf/show/picture/view_file.h"
#include "molsurf/show/picture/write_html.h"
#include "molsurf/show/picture/write_png.h"
#include "molsurf/surface/pore.h"
#include "molsurf/surface/solver_files.h"
#include "molsurf/surface/stored_surface.h"
#include "molsurf/surface/tunnels.h"
#include "molsurf/surface/unit_mesh.h"

#include <algorithm>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

namespace molsurf
{

using namespace holds;

const std::vector<std::string>& areaTables()
{
    static const std::vector<std::string> all = {"atoms",      "residues", "contacts",
                                                 "interfaces", "pockets",  "patches",
                                                 "pore",       "tunnels",  "forces"};
    return all;
}

namespace
{

openvdb::GridCPtrVec gridsOf(const Request& request, const MolecularSurface& result)
{
    const openvdb::GridPtrVec all = result.grids();
    const openvdb::GridCPtrVec grids(all.begin(), all.end());
    return placeInScene(grids, request.scene, request.center);
}

std::string stemOf(const std::string& path)
{
    return path == "-" ? "surface" : std::filesystem::path(path).stem().string();
}

} // namespace

Table areaTable(const std::string& name, const Request& request, const BallSet& atoms,
                const MolecularSurface& result)
{
    SurfaceOptions shown = request.options;
    shown.kind = shown.areasOf.value_or(shown.kind);
    Table table;
    if (name == "atoms") table = atomTable(atoms, result);
    if (name == "residues") table = residueTable(atoms, probeOf(shown), result);
    if (name == "contacts") table = contactTable(atoms, request.contacts, result);
    if (name == "interfaces") table = interfaceTable(atoms, result.report);
    if (name == "patches") {
        table = result.report.patches->table(atoms);
        addOrigin(atoms, nameOf(request.options.kind), probeOf(request.options), table);
        return table;
    }
    if (name == "pockets") return result.report.pockets->table(atoms);
    if (name == "pore") return result.report.pore.value_or(Report::Pore()).table(atoms);
    if (name == "tunnels") return result.report.tunnels.value_or(Report::Tunnels()).table(atoms);
    if (name == "forces") table = forceTable(atoms, shown, result.mesh);
    addOrigin(atoms, result.report.areasOf, probeOf(shown), table);
    return table;
}

namespace
{

std::vector<MeshInstance> instancesOf(const Writing& w)
{
    if (w.shown.whole) return {};
    return instancesOf(w.atoms, w.mesh, w.request.colorsCopies(), w.request.picture.plain,
                       w.progress);
}

DrawnSurface drawnOf(const Writing& w, double turn = 0.0, bool quick = false)
{
    return drawnSurface(w.request, w.atoms, w.mesh, w.shown, turn, quick);
}

/// A picture with its panels.
Picture draw(const Writing& w, double turn, bool quick)
{
    return drawSurfaces(drawnPanels(w.request, drawnOf(w, turn, quick)), w.request, w.progress);
}

void writePicture(const Writing& w, OutputFile& file)
{
    writePng(draw(w, w.output.turn, false), file);
}

void writeFilm(const Writing& w, OutputFile& file)
{
    if (w.output.film) return w.output.film->add(draw(w, 0.0, true));
    Film film(file, w.request.fps > 0.0 ? w.request.fps : filmRate, w.progress);
    const int count = w.request.turntable;
    for (int n = 0; n < count; ++n) film.add(draw(w, 360.0 * n / count, true));
    film.finish();
}

void writeLegend(const Writing& w, OutputFile& file)
{
    writeLegendSvg(legendsOf(drawnPanels(w.request, drawnOf(w)), w.progress),
                   w.request.picture.background, file);
}

void writeCamera(const Writing& w, OutputFile& file)
{
    writeView(w.mesh, pictureOf(drawnOf(w), w.progress), file);
}

void writeGrids(const Writing& w, OutputFile& file)
{
    openvdb::MetaMap metadata = w.metadata();
    addLabelMetadata(w.atoms, w.request.options.fields, w.progress, metadata);
    writeVdb(gridsOf(w.request, w.result), metadata, file);
}

void writeBareGrids(const Writing& w, OutputFile& file)
{
    writeNvdb(gridsOf(w.request, w.result), file);
}

/// Copies that are all alike share the volume; others are in it once, where the input has them.
void writeVolumeStage(const Writing& w, OutputFile& file)
{
    UsdVolume volume = usdVolume(w.request, w.output);
    const std::vector<Instance>& copies = w.atoms.placement.instances;
    const auto isFirst = [](const Instance& copy) { return copy.part == 0; };
    if (!w.shown.whole && !w.atoms.placement.isWhole() &&
        std::all_of(copies.begin(), copies.end(), isFirst))
        volume.copies = copies;
    for (Instance& copy : volume.copies) copy.translation *= w.request.scene.scale;
    writeUsda(gridsOf(w.request, w.result), volume, file);
}

void writeStage(const Writing& w, OutputFile& file)
{
    const bool ofMesh = w.output.beside.empty() || isFilm(w.output);
    if (ofMesh && !w.shown.whole && !w.atoms.placement.isWhole())
        writeUsdaInstances(w.mesh,
                           {stemOf(w.output.path), w.request.scene.scale, instancesOf(w), w.coarser,
                            w.request.options.fields},
                           file);
    else if (ofMesh)
        writeUsdStage(w.request, w.output, w.mesh, file);
    else
        writeVolumeStage(w, file);
}

void writeGlb(const Writing& w, OutputFile& file)
{
    writeGlb(w.mesh,
             {stemOf(w.output.path), w.request.scene.scale, w.request.picture.plain, instancesOf(w),
              w.coarser},
             file);
}

void writePage(const Writing& w, OutputFile& file)
{
    const Request& request = w.request;
    const std::string title = displayName(inputStem(request.input));
    std::vector<HtmlLayer> layers = {
        {w.mesh, pageOf(drawnOf(w), title, w.shown.about, w.progress)}};
    layers[0].page.name = request.firstName;
    layers[0].page.coarser = w.coarser;
    layers[0].page.bodies = w.shown.drawnBodies.get();
    if (w.shown.about.empty())
        layers[0].page.about = aboutPage(w.result.report.surface.kind, request.options.voxel);
    const std::vector<PanelSurface> none;
    for (const PanelSurface& panel : request.panelSurfaces ? *request.panelSurfaces : none) {
        const Mesh& mesh = panel.shown.crisp ? *panel.shown.crisp : panel.mesh;
        DrawnSurface drawn = drawnPanel(request, panel, mesh);
        drawn.look = request.picture;
        HtmlPage page = pageOf(drawn, title, panel.shown.about, w.progress);
        page.name = panel.name;
        page.inPlace = panel.inPlace;
        if (panel.inPlace) page.bodies = layers[0].page.bodies;
        if (!panel.inPlace) layers[0].page.title += ", " + displayName(panel.name);
        layers.push_back({mesh, std::move(page)});
    }
    writeHtml(std::move(layers), file);
}

void writeMesh(const Writing& w, OutputFile& file)
{
    for (const MeshFormat& format : meshFormats())
        if (std::string(format.word) == w.output.format->word)
            format.write(w.whole, {stemOf(w.output.path), w.request.printUnit()}, file);
}

template<void write(const openvdb::FloatGrid&, const openvdb::Vec3d&, OutputFile&)>
void writeVolume(const Writing& w, OutputFile& file)
{
    write(*w.result.surface, w.request.origin(), file);
}

/// The pixels where the files of a run lie.
PixelBox placed(PixelBox box, const Request& request)
{
    box.corner -= request.origin();
    return box;
}

void writeDensity(const Writing& w, OutputFile& file)
{
    const TomogramSettings& settings = w.request.tomogram;
    const PixelBox box = tomogramBox(w.atoms, settings);
    writeMrc(placed(box, w.request), tomogramDensity(w.atoms, settings, box, w.progress),
             settings.invert ? "vdb_molsurf: electrons [1/A^3], negative"
                             : "vdb_molsurf: electrons [1/A^3]",
             file);
}

void writeMask(const Writing& w, OutputFile& file)
{
    const TomogramSettings& settings = w.request.tomogram;
    const PixelBox box = tomogramBox(w.atoms, settings);
    const PixelBox ofMesh = placed(box, w.request);
    writeMrc(ofMesh, softMask(w.mesh, settings, ofMesh, w.progress), "vdb_molsurf: soft mask",
             file);
}

template<void write(const std::string&, const std::optional<Legend>&, OutputFile&)>
void writeScript(const Writing& w, OutputFile& file)
{
    const auto& files = w.request.outputs;
    const auto mesh = std::find_if(files.begin(), files.end(), [&](const Output& output) {
        return output.format->word == std::string(w.output.format->opens);
    });
    write(std::filesystem::path(mesh->path).filename().string(),
          legendOf(w.request.options.color, w.atoms, w.mesh, w.progress), file);
}

void writeAreaTable(const Writing& w, OutputFile& file)
{
    writeCsv(areaTable(w.output.format->table, w.request, w.atoms, w.result), file);
}

/// The pore or the tunnels where the mesh lies.
Mesh tubeOf(const Writing& w)
{
    const Report& report = w.result.report;
    Mesh tube = w.output.format->table == std::string("tunnels") ? tunnelTubes(*report.tunnels)
                                                                 : poreTube(*report.pore);
    for (openvdb::Vec3f& x : tube.positions)
        x = openvdb::Vec3f(openvdb::Vec3d(x) - w.request.origin());
    return tube;
}

/// Writes a mesh beside that of the surface, by the last ending of its format.
void writeBeside(const Writing& w, const Mesh& mesh, OutputFile& file)
{
    const std::string word = w.output.format->word, last = word.substr(word.rfind('.') + 1);
    if (last == "glb") {
        GlbOptions options;
        options.name = stemOf(w.output.path);
        options.scale = w.request.scene.scale;
        return writeGlb(mesh, options, file);
    }
    for (const MeshFormat& format : meshFormats())
        if (format.word == last)
            format.write(mesh, {stemOf(w.output.path), w.request.printUnit()}, file);
}

void writeTube(const Writing& w, OutputFile& file)
{
    writeBeside(w, tubeOf(w), file);
}

/// Writes the balls of tunnels with their radii as B factors.
void writeTunnelPdb(const Writing& w, OutputFile& file)
{
    const BallSet balls = tunnelBalls(*w.result.report.tunnels);
    std::vector<double> radii;
    for (const Ball& ball : balls.balls) radii.push_back(ball.radius);
    writePdb(balls, radii, w.request.origin(), file);
}

void writeTunnelCif(const Writing& w, OutputFile& file)
{
    writeTunnelsCif(w.atoms, *w.result.report.tunnels, w.request.origin(), file);
}

template<void write(const Report::Tunnels&, const openvdb::Vec3d&, OutputFile&)>
void writeTunnelScript(const Writing& w, OutputFile& file)
{
    write(*w.result.report.tunnels, w.request.origin(), file);
}

/// The body of one pocket where the mesh lies.
Mesh bodyOf(const Writing& w)
{
    const Mesh& all = *w.shown.bodies;
    Mesh body;
    appendPart(all, partRanges(all, "").at(w.output.pocket - 1), body);
    body.parts.clear();
    for (openvdb::Vec3f& x : body.positions)
        x = openvdb::Vec3f(openvdb::Vec3d(x) - w.request.origin());
    return body;
}

void writeBody(const Writing& w, OutputFile& file)
{
    writeBeside(w, bodyOf(w), file);
}

/// Writes a file that APBS reads.
void writeForSolver(const Writing& w, OutputFile& file)
{
    const auto pathOf = [&](const std::string& word) {
        for (const Output& output : w.request.outputs)
            if (output.format->word == word) return output.path;
        return std::string();
    };
    const std::string title =
        displayName(inputStem(w.request.input)) + ", surface " + nameOf(w.request.options.kind);
    const SolverRun run{
        w.atoms, *w.result.surface, *w.request.apbsGrid, w.request.dielectric, title, pathOf};
    for (const SolverFile& row : solverFiles())
        if (row.word == std::string(w.output.format->word)) row.write(run, w.progress, file);
}

/// Writes atoms with their areas, or those of their residues, as B factors.
template<void write(const BallSet&, const std::vector<double>&, const openvdb::Vec3d&, OutputFile&)>
void writeAtoms(const Writing& w, OutputFile& file)
{
    const std::vector<double>& own = w.result.ballAreas;
    const bool ofResidues = w.output.format->table == std::string("residues");
    write(w.atoms, ofResidues ? residueAreasOfBalls(w.atoms, own) : own, w.request.origin(), file);
}

/// Writes atoms with the areas of their residues in patches as B factors.
template<void write(const BallSet&, const std::vector<double>&, const openvdb::Vec3d&, OutputFile&)>
void writePatchAtoms(const Writing& w, OutputFile& file)
{
    std::vector<double> areas(w.atoms.names->residueOf.size());
    for (const Report::Patches::Patch& patch : w.result.report.patches->list)
        for (const auto& part : patch.parts) areas[part.ball] += part.area;
    write(w.atoms, residueAreasOfBalls(w.atoms, areas), w.request.origin(), file);
}

} // namespace

namespace
{

/// Tables of areas and the like, and what else is made of them.
std::vector<Format> areaFormats()
{
    constexpr const char* ofAreas = "table of areas";
    constexpr const char *ofPore = "", *ofTunnels = ""; // the options of both say it
    constexpr const char* withAreas = "areas as B factors";
    constexpr unsigned built = Build | Batch;
    return {
        {"atoms.csv", built, Areas | AllFrames, ofAreas, "atoms", writeAreaTable},
        {"residues.csv", built, Areas | AllFrames, ofAreas, "residues", writeAreaTable},
        {"contacts.csv", built, Areas | AllFrames, ofAreas, "contacts", writeAreaTable},
        {"interfaces.csv", built, Areas | AllFrames, ofAreas, "interfaces", writeAreaTable},
        {"pockets.csv", built, Areas | AllFrames, ofAreas, "pockets", writeAreaTable},
        {"patches.csv", built, Areas | AllFrames, "", "patches", writeAreaTable},
        {"pore.csv", built, Areas | AllFrames, ofAreas, "pore", writeAreaTable},
        {"tunnels.csv", built, Areas | AllFrames, ofAreas, "tunnels", writeAreaTable},
        {"forces.csv", built, Areas | AllFrames, "forces of atoms", "forces", writeAreaTable},
        {"pore.svg", built, Areas, ofPore, "pore",
         [](const Writing& w, OutputFile& file) { writeProfileSvg(*w.result.report.pore, file); }},
        {"pore.png", built, Areas, ofPore, "pore",
         [](const Writing& w, OutputFile& file) {
             writePng(drawProfile(*w.result.report.pore, w.request.picture.width), file);
         }},
        {"tunnel_frames.csv", Build, Areas | AllFrames, ofTunnels, "tunnel_frames", nullptr},
        {"tunnels.pdb", built, Areas, ofTunnels, "tunnels", writeTunnelPdb},
        {"tunnels.cif", built, Areas, ofTunnels, "tunnels", writeTunnelCif},
        {"tunnels.cxc", built, Areas, ofTunnels, "tunnels",
         writeTunnelScript<writeTunnelsChimeraX>},
        {"tunnels.pml", built, Areas, ofTunnels, "tunnels", writeTunnelScript<writeTunnelsPymol>},
        {"pdb", built, Areas, withAreas, "atoms", writeAtoms<writePdb>},
        {"cif", built, Areas, withAreas, "atoms", writeAtoms<writeMmcif>},
        {"residues.pdb", built, Areas, withAreas, "residues", writeAtoms<writePdb>},
        {"residues.cif", built, Areas, withAreas, "residues", writeAtoms<writeMmcif>},
        {"patches.pdb", built, Areas, "", "patches", writePatchAtoms<writePdb>},
        {"patches.cif", built, Areas, "", "patches", writePatchAtoms<writeMmcif>}};
}

/// A product that has a mesh of its own.
struct MeshedProduct {
    const char* table;
    unsigned verbs, holds;
    void (*write)(const Writing&, OutputFile&);
};

/// The meshes of products in the formats of meshes. The products' options have their help.
std::vector<Format> productMeshes()
{
    static const MeshedProduct products[] = {{"pockets", Build, Areas | Numbered, writeBody},
                                             {"pore", Build | Batch, Areas, writeTube},
                                             {"tunnels", Build | Batch, Areas, writeTube}};
    static std::deque<std::string> words; // of which rows have pointers
    std::vector<Format> rows;
    for (const MeshedProduct& product : products)
        for (const char* mesh : {"ply", "obj", "stl", "off", "wrl", "vtk", "glb", "3mf"}) {
            words.push_back(product.table + std::string(".") + mesh);
            rows.push_back({words.back().c_str(), product.verbs, product.holds, "", product.table,
                            product.write});
        }
    return rows;
}

/// The row of a format of the library.
/// @throws std::logic_error if there is none of this name
Format ofMesh(const std::string& word, unsigned verbs,
              void (*write)(const Writing&, OutputFile&) = writeMesh)
{
    for (const MeshFormat& format : meshFormats())
        if (format.word == word) return {format.word, verbs, format.holds, format.help, "", write};
    throw std::logic_error("no format of meshes is named " + word);
}

/// All formats in one list, with those of solvers between two others.
std::vector<Format> joined(std::vector<Format> all, const std::vector<Format>& second)
{
    for (const SolverFile& file : solverFiles())
        all.push_back({file.word, Build, Solver, "", "", writeForSolver});
    all.insert(all.end(), second.begin(), second.end());
    for (const auto& more : {areaFormats(), productMeshes()})
        all.insert(all.end(), more.begin(), more.end());
    return all;
}

} // namespace

const std::vector<Format>& formatTable()
{
    constexpr unsigned all = Build | Batch | Convert | Compare | BricksMerge;
    constexpr unsigned meshed = Build | Batch | Convert, seen = meshed | Compare;
    constexpr unsigned film = heldByPng | Moving;
    static const std::vector<Format> table =
        joined({{"vdb", all, heldByVdb, "level set and fields", "", writeGrids},
                ofMesh("ply", all),
                ofMesh("obj", meshed),
                ofMesh("stl", meshed),
                ofMesh("vtk", meshed),
                ofMesh("glb", meshed, writeGlb),
                {"usda", Build,
                 Stage | Colors | PlainColor | CutBorders | VertexCurvatures | SceneUnits | Copies |
                     Levels,
                 "mesh", "", writeStage},
                ofMesh("3mf", meshed),
                ofMesh("vert", meshed),
                ofMesh("face", meshed),
                ofMesh("poly", meshed),
                ofMesh("msh", meshed),
                ofMesh("off", meshed),
                ofMesh("wrl", meshed),
                ofMesh("msh2", meshed),
                {"nvdb", meshed, heldByNvdb, "level set and fields for GPUs", "", writeBareGrids},
                {"mrc", meshed, Volume, "level set in a box", "", writeVolume<writeMrc>},
                {"dx", meshed, Volume, "level set in a box", "", writeVolume<writeDx>},
                {"density.mrc", Build | Batch, Density, "", "", writeDensity},
                {"mask.mrc", Build | Batch, Mask, "", "", writeMask}},
               {{"cxc", meshed, Script | Colors | Copies, "scripts for .glb and .ply", "",
                 writeScript<writeChimeraXScript>, "glb"},
                {"pml", meshed, Script | Colors, "scripts for .glb and .ply", "",
                 writeScript<writePymolScript>, "ply"},
                {"html", seen, heldByHtml, "page", "", writePage},
                {"json", all, Numbers | Copies, "report", "",
                 [](const Writing& w, OutputFile& file) { writeReport(w.report, file); }},
                {"png", seen, heldByPng, "picture", "", writePicture},
                {"mp4", seen, film, "film", "", writeFilm},
                {"webm", seen, film, "film", "", writeFilm},
                {"gif", seen, film, "film", "", writeFilm},
                {"legend.svg", seen, Colors | Copies, "legend", "", writeLegend},
                {"view", seen, Copies | Views, "view for `view`", "", writeCamera},
                {"csv", Build, FrameRows | AllFrames, "table of `frames`", "", nullptr},
                {"pockets.vdb", Build, Shares | AllFrames, "", "", nullptr}});
    return table;
}

const Format* findFormat(const std::string& word)
{
    for (const Format& format : formatTable())
        if (word == format.word) return &format;
    return nullptr;
}

std::string filesOf(unsigned verb)
{
    std::string all, last;
    for (const Format& format : formatTable()) {
        if (!(format.verbs & verb) || !*format.help) continue;
        if (!last.empty() && last != format.help) all += " " + last + ";";
        all += (all.empty() ? "." : " .") + std::string(format.word);
        last = format.help;
    }
    return all + " " + last;
}

std::string endingsOf(unsigned holds, unsigned verbs, const char* last)
{
    std::vector<std::string> words;
    for (const Format& format : formatTable())
        if ((format.holds & holds) && (format.verbs & verbs))
            words.push_back("." + std::string(format.word));
    const std::string end = words.back();
    words.pop_back();
    return words.empty() ? end : joinWords(words, ", ") + last + end;
}

void writeFile(const FileSource& source, const Output& output, OutputFile& file)
{
    const auto& [request, atoms, result, all, shown, report, metadata, progress] = source;
    const Mesh& mesh = shown.crisp && isCrisp(request, output) ? *shown.crisp : all;
    std::optional<Mesh> whole;
    if (atoms.placement.unit && !shown.whole && output.holds(Triangles))
        whole = wholeMesh(atoms, result, mesh, request.weld,
                          request.colorsCopies() ? instanceColors(atoms, progress)
                                                 : std::vector<Color>(),
                          progress);
    std::vector<const Mesh*> coarser;
    for (const Mesh& level : shown.coarser) coarser.push_back(&level);
    output.format->write({request, atoms, result, output, progress, mesh, whole ? *whole : mesh,
                          coarser, shown, report, metadata},
                         file);
}

} // namespace molsurf
