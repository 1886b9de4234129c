// SPDX-License-Identifier: MPL-2.0
#include "write_result.h"

#include "cli/option_table.h"
#include "draw_result.h"
#include "film.h"
#include "identity.h"
#include "outputs.h"
#include "sha256.h"
#include "sidecar.h"

#include "molsurf/kernel/balls/nearest_ball.h"
#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/molecule/selection/coarse_grain.h"
#include "molsurf/molecule/structure/text_fields.h"
#include "molsurf/show/color/color_table.h"
#include "molsurf/show/color/crisp_borders.h"
#include "molsurf/show/color/legend.h"
#include "molsurf/show/color/palette.h"
#include "molsurf/show/color/value_colors.h"
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
#include "molsurf/show/picture/legend_svg.h"
#include "molsurf/show/picture/view.h"
#include "molsurf/show/picture/view_file.h"
#include "molsurf/show/picture/write_html.h"
#include "molsurf/show/picture/write_png.h"
#include "molsurf/surface/pore.h"
#include "molsurf/surface/solver_files.h"
#include "molsurf/surface/stored_surface.h"
#include "molsurf/surface/tunnels.h"
#include "molsurf/surface/unit_mesh.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

namespace molsurf::tool
{

namespace
{

// Adds values of metadata by name.
struct Metadata {
    openvdb::MetaMap& map;
    void text(const char* name, const std::string& value)
    {
        map.insertMeta(name, openvdb::StringMetadata(value));
    }
    void number(const char* name, double value)
    {
        map.insertMeta(name, openvdb::DoubleMetadata(value));
    }
    void count(const char* name, std::int64_t value)
    {
        map.insertMeta(name, openvdb::Int64Metadata(value));
    }
};

} // namespace

openvdb::MetaMap vdbMetadata(const CommandLine& call, const Report& report)
{
    openvdb::MetaMap map;
    Metadata to{map};
    to.text("program", report.program);
    to.text("version", report.version);
    to.text("command", report.command);
    to.text("input", report.input);
    if (!report.commit.empty()) to.text("commit", report.commit);
    if (!report.inputSha256.empty()) to.text("input_sha256", report.inputSha256);
    to.count("atoms", std::int64_t(report.atoms));
    if (!std::isnan(report.surface.area)) {
        to.number("area", report.surface.area);
        to.number("volume", report.surface.volume);
    }

    if (call.frame > 0) {
        to.count("frame", call.frame);
        to.text("trajectory", call.trajectory.empty() ? call.input : call.trajectory);
        to.text("frames.options", optionsDigest(call));
    }
    addOptions(call, map);
    describeScene(call.scene, map);
    return map;
}

namespace
{

openvdb::GridCPtrVec gridsOf(const CommandLine& call, const MolecularSurface& result)
{
    const openvdb::GridPtrVec all = result.grids();
    const openvdb::GridCPtrVec grids(all.begin(), all.end());
    return placeInScene(grids, call.scene, call.center);
}

std::string stemOf(const std::string& path)
{
    return path == "-" ? "surface" : std::filesystem::path(path).stem().string();
}

} // namespace

Table areaTable(const std::string& name, const CommandLine& call, const BallSet& atoms,
                const MolecularSurface& result)
{
    SurfaceOptions shown = call.options;
    shown.kind = shown.areasOf.value_or(shown.kind);
    Table table;
    if (name == "atoms") table = atomTable(atoms, result);
    if (name == "residues") table = residueTable(atoms, probeOf(shown), result);
    if (name == "contacts") table = contactTable(atoms, call.contacts, result);
    if (name == "interfaces") table = interfaceTable(atoms, result.report);
    if (name == "pockets") return result.report.pockets->table(atoms);
    if (name == "pore") return result.report.pore.value_or(Report::Pore()).table(atoms);
    if (name == "tunnels") return result.report.tunnels.value_or(Report::Tunnels()).table(atoms);
    if (name == "forces") table = forceTable(atoms, shown, result.mesh);
    addOrigin(atoms, result.report.areasOf, probeOf(shown), table);
    return table;
}

std::string optionsDigest(const CommandLine& call)
{
    openvdb::MetaMap map;
    addOptions(call, map);
    std::string all = call.trajectory + "\n" + shortest(call.scene.scale) +
                      sha256OfInput(call.input, call.atoms.limits.maxInput);
    for (auto meta = map.beginMeta(); meta != map.endMeta(); ++meta)
        if (meta->first.rfind("option.", 0) == 0 && meta->first != "option.model")
            all += "\n" + meta->first + "=" + meta->second->str();
    return sha256OfText(all).substr(0, 16);
}

/// Whether a file shows borders between colours that are cut: pictures find them by themselves.
bool isCrisp(const CommandLine& call, const Output& output)
{
    return output.holds(ColorChoices) || (call.crisp && !output.holds(Pixels));
}

ShownMeshes shownMeshes(const CommandLine& call, const BallSet& atoms, const Mesh& mesh,
                        const Progress& progress)
{
    ShownMeshes shown;
    const auto shows = [&](auto&& what) {
        return std::any_of(call.outputs.begin(), call.outputs.end(), what);
    };
    const bool cut = shows([&](const Output& output) { return isCrisp(call, output); });
    if (cut || shows([](const Output& output) { return output.holds(Pixels); }))
        shown.borders =
            bordersOf(call.options.color, atoms,
                      asMeshed(movedBalls(atoms, originOf(call)), call.options), mesh, progress);
    if (!cut || !shown.borders) return shown;
    shown.crisp = crispMesh(mesh, *shown.borders, atoms, call.options, progress);
    return shown;
}

struct Writing {
    const CommandLine& call;
    const BallSet& atoms;
    const MolecularSurface& result;
    const Output& output;
    const Progress& progress;
    const Mesh& mesh;                 ///< with the borders that the format shows
    const Mesh& whole;                ///< by symmetry the mesh of the whole, else the same
    std::vector<const Mesh*> coarser; ///< further levels of detail
    const ShownMeshes& shown;
};

namespace
{

std::vector<MeshInstance> instancesOf(const Writing& w)
{
    return instancesOf(w.atoms, w.mesh, w.call.colorsCopies(), w.call.picture.plain, w.progress);
}

DrawnSurface drawnOf(const Writing& w, double turn = 0.0, bool quick = false)
{
    return drawnSurface(w.call, w.atoms, w.mesh, w.shown, turn, quick);
}

/// A picture with its panels.
Picture draw(const Writing& w, double turn, bool quick)
{
    return drawSurfaces(drawnPanels(w.call, drawnOf(w, turn, quick)), w.call, w.progress);
}

/// Says that pictures show nothing of the surface, since --clip cuts all of it away.
void warnOfClip(const Writing& w)
{
    if (!w.call.picture.clip || w.output.turn != 0.0 || w.call.quiet) return;
    const DrawOptions options = pictureOf(drawnOf(w), w.progress);
    const double low = chooseView(w.mesh, options).low;
    if (*options.clip > low) return;
    printLine(
        formatted("warning: --clip %g: it cuts all of the surface away, expected more than %.1f",
                  *options.clip, low));
}

void writePicture(const Writing& w, OutputFile& file)
{
    warnOfClip(w);
    writePng(draw(w, w.output.turn, false), file);
}

void writeFilm(const Writing& w, OutputFile& file)
{
    warnOfClip(w);
    if (w.output.film) return w.output.film->add(draw(w, 0.0, true));
    Film film(file, w.call.fps > 0.0 ? w.call.fps : filmRate);
    const int count = w.call.turntable;
    for (int n = 0; n < count; ++n) film.add(draw(w, 360.0 * n / count, true));
    film.finish();
}

void writeLegend(const Writing& w, OutputFile& file)
{
    writeLegendSvg(legendsOf(drawnPanels(w.call, drawnOf(w)), w.progress),
                   w.call.picture.background, file);
}

void writeCamera(const Writing& w, OutputFile& file)
{
    writeView(w.mesh, pictureOf(drawnOf(w), w.progress), file);
}

void writeGrids(const Writing& w, OutputFile& file)
{
    openvdb::MetaMap metadata = vdbMetadata(w.call, w.result.report);
    addLabelMetadata(w.atoms, w.call.options.fields, w.progress, metadata);
    writeVdb(gridsOf(w.call, w.result), metadata, file);
}

void writeBareGrids(const Writing& w, OutputFile& file)
{
    writeNvdb(gridsOf(w.call, w.result), file);
}

/// Copies that are all alike share the volume; others are in it once, where the input has them.
void writeVolumeStage(const Writing& w, OutputFile& file)
{
    UsdVolume volume = usdVolume(w.call, w.output);
    const std::vector<Instance>& copies = w.atoms.placement.instances;
    const auto isFirst = [](const Instance& copy) { return copy.part == 0; };
    if (!w.atoms.placement.isWhole() && std::all_of(copies.begin(), copies.end(), isFirst))
        volume.copies = copies;
    for (Instance& copy : volume.copies) copy.translation *= w.call.scene.scale;
    writeUsda(gridsOf(w.call, w.result), volume, file);
}

void writeStage(const Writing& w, OutputFile& file)
{
    const bool ofMesh = w.output.beside.empty() || isFilm(w.output);
    if (ofMesh && !w.atoms.placement.isWhole())
        writeUsdaInstances(w.mesh,
                           {stemOf(w.output.path), w.call.scene.scale, instancesOf(w), w.coarser,
                            w.call.options.fields},
                           file);
    else if (ofMesh)
        writeMeshStage(w.call, w.output, w.mesh, file);
    else
        writeVolumeStage(w, file);
}

void writeGlb(const Writing& w, OutputFile& file)
{
    writeGlb(w.mesh,
             {stemOf(w.output.path), w.call.scene.scale, w.call.picture.plain, instancesOf(w),
              w.coarser},
             file);
}

void writePage(const Writing& w, OutputFile& file)
{
    const CommandLine& call = w.call;
    const std::string title = displayName(inputStem(call.input));
    std::vector<HtmlLayer> layers = {
        {w.mesh, pageOf(drawnOf(w), title, w.shown.about, w.progress)}};
    layers[0].page.name = firstName(call);
    layers[0].page.coarser = w.coarser;
    layers[0].page.bodies = w.shown.drawnBodies.get();
    if (w.shown.about.empty())
        layers[0].page.about = aboutPage(w.result.report.surface.kind, call.options.voxel);
    const std::vector<PanelSurface> none;
    for (const PanelSurface& panel : call.panelSurfaces ? *call.panelSurfaces : none) {
        const Mesh& mesh = panel.shown.crisp ? *panel.shown.crisp : panel.mesh;
        HtmlPage page = pageOf(drawnSurface(call, panel.atoms, mesh, panel.shown), title,
                               panel.shown.about, w.progress);
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
            format.write(w.whole, {stemOf(w.output.path), w.call.printUnit()}, file);
}

template<void write(const openvdb::FloatGrid&, const openvdb::Vec3d&, OutputFile&)>
void writeVolume(const Writing& w, OutputFile& file)
{
    write(*w.result.surface, originOf(w.call), file);
}

template<void write(const std::string&, const std::optional<Legend>&, OutputFile&)>
void writeScript(const Writing& w, OutputFile& file)
{
    const auto& files = w.call.outputs;
    const auto mesh = std::find_if(files.begin(), files.end(), [&](const Output& output) {
        return output.format->word == std::string(w.output.format->opens);
    });
    write(std::filesystem::path(mesh->path).filename().string(),
          legendOf(w.call.options.color, w.atoms, w.mesh, w.progress), file);
}

void writeAreaTable(const Writing& w, OutputFile& file)
{
    writeCsv(areaTable(w.output.format->table, w.call, w.atoms, w.result), file);
}

/// The pore or the tunnels where the mesh lies.
Mesh tubeOf(const Writing& w)
{
    const Report& report = w.result.report;
    Mesh tube = w.output.format->table == std::string("tunnels") ? tunnelTubes(*report.tunnels)
                                                                 : poreTube(*report.pore);
    for (openvdb::Vec3f& x : tube.positions)
        x = openvdb::Vec3f(openvdb::Vec3d(x) - originOf(w.call));
    return tube;
}

/// Writes a mesh beside that of the surface, by the last ending of its format.
void writeBeside(const Writing& w, const Mesh& mesh, OutputFile& file)
{
    const std::string word = w.output.format->word, last = word.substr(word.rfind('.') + 1);
    if (last == "glb") {
        GlbOptions options;
        options.name = stemOf(w.output.path);
        options.scale = w.call.scene.scale;
        return writeGlb(mesh, options, file);
    }
    for (const MeshFormat& format : meshFormats())
        if (format.word == last)
            format.write(mesh, {stemOf(w.output.path), w.call.printUnit()}, file);
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
    writePdb(balls, radii, originOf(w.call), file);
}

void writeTunnelCif(const Writing& w, OutputFile& file)
{
    writeTunnelsCif(w.atoms, *w.result.report.tunnels, originOf(w.call), file);
}

template<void write(const Report::Tunnels&, const openvdb::Vec3d&, OutputFile&)>
void writeTunnelScript(const Writing& w, OutputFile& file)
{
    write(*w.result.report.tunnels, originOf(w.call), file);
}

/// The body of one pocket where the mesh lies.
Mesh bodyOf(const Writing& w)
{
    const Mesh& all = *w.shown.bodies;
    Mesh body;
    appendPart(all, partRanges(all, "").at(w.output.pocket - 1), body);
    body.parts.clear();
    for (openvdb::Vec3f& x : body.positions)
        x = openvdb::Vec3f(openvdb::Vec3d(x) - originOf(w.call));
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
        for (const Output& output : w.call.outputs)
            if (output.format->word == word) return output.path;
        return std::string();
    };
    const std::string title =
        displayName(inputStem(w.call.input)) + ", surface " + nameOf(w.call.options.kind);
    const SolverRun run{w.atoms, *w.result.surface, *w.call.apbsGrid, w.call.dielectric, title,
                        pathOf};
    for (const SolverFile& row : solverFiles())
        if (row.word == std::string(w.output.format->word)) row.write(run, w.progress, file);
}

/// Writes atoms with their areas, or those of their residues, as B factors.
template<void write(const BallSet&, const std::vector<double>&, const openvdb::Vec3d&, OutputFile&)>
void writeAtoms(const Writing& w, OutputFile& file)
{
    const std::vector<double>& own = w.result.ballAreas;
    const bool ofResidues = w.output.format->table == std::string("residues");
    write(w.atoms, ofResidues ? residueAreasOfBalls(w.atoms, own) : own, originOf(w.call), file);
}

} // namespace

namespace
{

/// Tables of areas and the like, and what else is made of them.
std::vector<Format> areaFormats()
{
    constexpr const char* ofAreas = "table of areas";
    constexpr const char *ofPore = "", *ofTunnels = ""; // --pore and --tunnels-from say it
    constexpr unsigned ofPocket = Areas | Numbered;
    constexpr const char* perPocket = ""; // --pockets says it
    constexpr const char* withAreas = "areas as B factors";
    constexpr unsigned built = Build | Batch;
    return {
        {"atoms.csv", built, Areas | AllFrames, ofAreas, "atoms", writeAreaTable},
        {"residues.csv", built, Areas | AllFrames, ofAreas, "residues", writeAreaTable},
        {"contacts.csv", built, Areas | AllFrames, ofAreas, "contacts", writeAreaTable},
        {"interfaces.csv", built, Areas | AllFrames, ofAreas, "interfaces", writeAreaTable},
        {"pockets.csv", built, Areas | AllFrames, ofAreas, "pockets", writeAreaTable},
        {"pore.csv", built, Areas | AllFrames, ofAreas, "pore", writeAreaTable},
        {"tunnels.csv", built, Areas | AllFrames, ofAreas, "tunnels", writeAreaTable},
        {"forces.csv", built, Areas | AllFrames, "forces of atoms", "forces", writeAreaTable},
        {"pore.svg", built, Areas, ofPore, "pore",
         [](const Writing& w, OutputFile& file) { writeProfileSvg(*w.result.report.pore, file); }},
        {"pore.png", built, Areas, ofPore, "pore",
         [](const Writing& w, OutputFile& file) {
             writePng(drawProfile(*w.result.report.pore, w.call.picture.width), file);
         }},
        {"pore.ply", built, Areas, ofPore, "pore", writeTube},
        {"pore.obj", built, Areas, ofPore, "pore", writeTube},
        {"pore.glb", built, Areas, ofPore, "pore", writeTube},
        {"tunnel_frames.csv", Build, Areas | AllFrames, ofTunnels, "tunnel_frames", nullptr},
        {"tunnels.ply", built, Areas, ofTunnels, "tunnels", writeTube},
        {"tunnels.obj", built, Areas, ofTunnels, "tunnels", writeTube},
        {"tunnels.glb", built, Areas, ofTunnels, "tunnels", writeTube},
        {"tunnels.pdb", built, Areas, ofTunnels, "tunnels", writeTunnelPdb},
        {"tunnels.cif", built, Areas, ofTunnels, "tunnels", writeTunnelCif},
        {"tunnels.cxc", built, Areas, ofTunnels, "tunnels",
         writeTunnelScript<writeTunnelsChimeraX>},
        {"tunnels.pml", built, Areas, ofTunnels, "tunnels", writeTunnelScript<writeTunnelsPymol>},
        {"pockets.ply", Build, ofPocket, perPocket, "pockets", writeBody},
        {"pockets.obj", Build, ofPocket, perPocket, "pockets", writeBody},
        {"pockets.stl", Build, ofPocket, perPocket, "pockets", writeBody},
        {"pockets.off", Build, ofPocket, perPocket, "pockets", writeBody},
        {"pockets.vtk", Build, ofPocket, perPocket, "pockets", writeBody},
        {"pockets.glb", Build, ofPocket, perPocket, "pockets", writeBody},
        {"pdb", built, Areas, withAreas, "atoms", writeAtoms<writePdb>},
        {"cif", built, Areas, withAreas, "atoms", writeAtoms<writeMmcif>},
        {"residues.pdb", built, Areas, withAreas, "residues", writeAtoms<writePdb>},
        {"residues.cif", built, Areas, withAreas, "residues", writeAtoms<writeMmcif>}};
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
    const std::vector<Format> areas = areaFormats();
    all.insert(all.end(), areas.begin(), areas.end());
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
                ofMesh("off", meshed),
                ofMesh("wrl", meshed),
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
                ofMesh("msh2", meshed),
                {"nvdb", meshed, heldByNvdb, "level set and fields for GPUs", "", writeBareGrids},
                {"mrc", meshed, Volume, "level set in a box", "", writeVolume<writeMrc>},
                {"dx", meshed, Volume, "level set in a box", "", writeVolume<writeDx>}},
               {{"cxc", meshed, Script | Colors | Copies, "scripts for .glb and .ply", "",
                 writeScript<writeChimeraXScript>, "glb"},
                {"pml", meshed, Script | Colors, "scripts for .glb and .ply", "",
                 writeScript<writePymolScript>, "ply"},
                {"html", seen, heldByHtml, "page", "", writePage},
                {"json", all, Numbers | Copies, "report", "",
                 [](const Writing& w, OutputFile& file) { writeReport(w.result.report, file); }},
                {"png", seen, heldByPng, "picture", "", writePicture},
                {"mp4", seen, film, "film", "", writeFilm},
                {"webm", seen, film, "film", "", writeFilm},
                {"gif", seen, film, "film", "", writeFilm},
                {"legend.svg", seen, Colors | Copies, "legend", "", writeLegend},
                {"view", seen, Copies | Views, "view for --view", "", writeCamera},
                {"csv", Build, FrameRows | AllFrames, "table of --frames", "", nullptr},
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

void writeOutput(const CommandLine& call, const BallSet& atoms, const MolecularSurface& result,
                 const Output& output, const Progress& progress, OutputFile& file,
                 const ShownMeshes& shown)
{
    const Mesh& mesh = shown.crisp && isCrisp(call, output) ? *shown.crisp : result.mesh;
    std::optional<Mesh> whole;
    if (atoms.placement.unit && output.holds(Triangles))
        whole = wholeMesh(
            atoms, result, mesh, call.weld,
            call.colorsCopies() ? instanceColors(atoms, progress) : std::vector<Color>(), progress);
    std::vector<const Mesh*> coarser;
    for (const Mesh& level : shown.coarser) coarser.push_back(&level);
    output.format->write(
        {call, atoms, result, output, progress, mesh, whole ? *whole : mesh, coarser, shown}, file);
}

} // namespace molsurf::tool
