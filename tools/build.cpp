// SPDX-License-Identifier: MPL-2.0
#include "verbs.h"

#include "bricks.h"
#include "cli/option_table.h"
#include "draw_result.h"
#include "identity.h"
#include "input_files.h"
#include "outputs.h"
#include "pocket_files.h"
#include "sidecar.h"
#include "stop.h"
#include "terminal.h"
#include "write_result.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/kernel/pipeline/check_balls.h"
#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/kernel/spline/curvature.h"
#include "molsurf/request/format_table.h"
#include "molsurf/request/usd_stage.h"
#include "molsurf/scale/bricks/plan_bricks.h"
#include "molsurf/show/io/output_folders.h"
#include "molsurf/surface.h"
#include "molsurf/surface/product_cost.h"
#include "molsurf/surface/run.h"

#include <malloc.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

namespace molsurf::tool
{

namespace
{

void writeAll(const CommandLine& call, const BallSet& atoms, MolecularSurface& result,
              const ShownMeshes& shown, Terminal& terminal, Clock::time_point programStart,
              const ExtraOutputs& companions)
{
    writeOutputs(
        call, terminal,
        [&](const Output& output, OutputFile& file) {
            writeOutput(call, atoms, result, output, terminal, file, shown);
        },
        [&](double writeSeconds) { endReport(writeSeconds, programStart, result.report); }, true,
        [&](OutputFiles& files) {
            if (companions.add) companions.add(result.report, files);
        });
}

// Adds the report of makeUnitSurface() to that of reading.
void completeReport(const CommandLine& call, const Report& read, Report& report)
{
    beginReport(call, report);
    report.voxel = call.options.grid ? call.options.voxel : 0.0;
    addReading(read, report);
}

} // namespace

bool seesBehind(const CommandLine& call)
{
    const bool showsBodies = call.showsPockets() || !call.places.tunnelsFrom.empty();
    const bool throughBodies = showsBodies && !call.shows.empty();
    return throughBodies ||
           (call.picture.opacity < 1.0 && (call.picture.showBehind || showsBodies));
}

bool needsClosedForm(const CommandLine& call)
{
    const bool withTable = call.verb == Batch || !call.frames.empty();
    return withTable || call.writes(Numbers | Areas);
}

RunLimits limitsOf(const CommandLine& call)
{
    const std::size_t threads =
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    RunLimits limits{std::max(call.memory, availableMemory()), call.hours, int(threads)};
    if (call.verb == BricksRun) limits.hint = " [hint: a plan of more bricks";
    if (call.verb == Convert) limits.hint = " [hint: a surface of a larger `voxel`";
    limits.bricks = goesInBricks(call);
    if (call.verb != Convert && call.writes(Pixels))
        limits.besides = costOfPicture(0, call.picture.width, seesBehind(call));
    return limits;
}

RunLimits limitsOf(const CommandLine& call, const BallSet& atoms)
{
    RunLimits limits = limitsOf(call);
    // measured: build --show pockets=all of 1CRN, 4AT1, with --opacity 0.4 and without: 1.1 to 1.5;
    // few bodies take nothing beside the search for them
    constexpr double shareOfBodies = 0.7; // of what the search for them takes
    constexpr std::size_t few = 20;
    if (call.shownPockets > few && call.writes(Pixels))
        limits.besides.bytes += std::size_t(
            shareOfBodies * costOfPockets(atoms, call.options, {double(atoms.balls.size())}).bytes);
    const std::pair<Content, decltype(&costOfMask)> maps[] = {{Density, costOfDensity},
                                                              {Mask, costOfMask}};
    for (const auto& [content, cost] : maps)
        if (call.writes(content)) {
            const Cost map = cost(atoms, call.tomogram);
            limits.besides.seconds += map.seconds;
            limits.besides.bytes += std::size_t(map.bytes);
        }
    if (call.writes(Volume)) limits.besides.seconds += costOfMap(atoms, call.options).seconds;
    if (!call.options.grid) limits.hint = " [hint: fewer atoms by `select`";
    return limits;
}

std::string summary(const Report& report)
{
    const SurfaceReport& surface = report.surface;
    const bool exact = surface.kind == "ses" || surface.kind == "sas" || surface.kind == "vdw";
    const bool byMesh = exact && surface.triangles > 0 && !surface.meshArea;
    std::string line = surface.kind + (byMesh ? " by its mesh: " : ": ");
    if (!std::isnan(surface.area))
        line += formatted("area %.1f Å^2, volume %.1f Å^3, ", surface.area, surface.volume);
    if (surface.piecesKnown) {
        line += counted(std::size_t(surface.components), "component", "components") + ", ";
        line += counted(surface.cavities.size(), "cavity", "cavities") + ", ";
    }
    if (surface.triangles > 0)
        line += counted(surface.triangles, "triangle", "triangles") + ", ";
    else if (report.activeVoxels > 0)
        line += counted(report.activeVoxels, "active voxel", "active voxels") + ", ";
    line += formatted("%.2f s", report.seconds.back().second);
    if (!report.areasOf.empty() && report.areasOf != surface.kind)
        line += "; areas of atoms and groups: " + report.areasOf + " [hint: --surface]";
    return line;
}

void sayTimes(const Report& report)
{
    for (const auto& [stage, time] : report.seconds) {
        printLine(formatted("%-10s %9.3f s", stage.c_str(), time));
    }
    printLine(formatted("%d threads, %.1f MB at most, %zu active voxels", report.threads,
                        double(report.peakMemoryBytes) / 1e6, report.activeVoxels));
}

namespace
{

// The meshes of --lod behind the first one.
std::vector<Mesh> coarserMeshes(const CommandLine& call, const BallSet& balls, Report& report,
                                Terminal& terminal)
{
    std::vector<Mesh> meshes;
    SurfaceOptions options = call.options;
    options.fields.erase(std::remove_if(options.fields.begin(), options.fields.end(),
                                        [](const auto& f) { return !findCurvatureField(f); }),
                         options.fields.end());
    for (std::size_t level = 1; level < call.lod.size(); ++level) {
        const Clock::time_point start = Clock::now();
        options.voxel = call.lod[level];
        try {
            meshes.push_back(makeUnitSurface(balls, options, &terminal).mesh);
        } catch (const Error& error) {
            throw Error(error, "--lod " + shortest(options.voxel) + ": " + error.what());
        }
        report.addSeconds("lod", secondsSince(start));
    }
    return meshes;
}

// Gives back what pictures need more than files without grids.
void dropGrids(MolecularSurface& result)
{
    if (!result.surface && result.fields.empty()) return; // the next frame can use the memory
    result.surface.reset();
    result.fields.clear();
    malloc_trim(0); // fields leave pieces of memory
}

// Moves points by a shift.
void shiftBack(const openvdb::Vec3d& shift, std::vector<openvdb::Vec3f>& points)
{
    for (openvdb::Vec3f& x : points) x = openvdb::Vec3f(openvdb::Vec3d(x) - shift);
}

// The middle of the mesh's box comes to the origin, of frames that of the first one (FrameRun sets
// scene.center), with what pictures and pages show beside it. Grids and other atoms follow when
// they are written. Panels share the model, so it is copied.
void centerMesh(CommandLine& call, MolecularSurface& result, Mesh& bodies)
{
    const openvdb::Vec3d center =
        moveToOrigin(result.mesh, call.frame > 0 ? &call.scene.center : nullptr);
    for (PictureNote& note : call.picture.notes) {
        note.from -= center;
        if (note.to) *note.to -= center;
    }
    for (openvdb::Vec3d& place : call.picture.zoom) place -= center;
    if (call.picture.model) {
        auto model = std::make_shared<AtomModel>(*call.picture.model);
        for (MeshInstance& copy : model->copies) copy.translation -= center;
        shiftBack(center, model->bodies.mesh.positions);
        call.picture.model = model;
    }
    shiftBack(center, bodies.positions);
    call.scene.center = center;
    result.report.center = {center[0], center[1], center[2]};
}

/// The stages of a run with their shares of its time.
/// @param[in] drawing  share of pictures, which are written at the end
std::vector<StageShare> stagesOf(const SurfaceOptions& options, double drawing)
{
    // measured: vdb_molsurf 6zu5.xyzr -v --force -j 1 -o a.ply -o a.vdb, variational and ses
    std::vector<StageShare> stages =
        isUnion(options.kind)
            ? std::vector<StageShare>{{"redistance", 0.66}, {"spline", 0.02}, {"mesh", 0.22}}
            : std::vector<StageShare>{{"density", 0.16},    {"initial", 0.03}, {"evolve", 0.10},
                                      {"redistance", 0.42}, {"spline", 0.02},  {"mesh", 0.17}};
    stages.push_back({"color", 0.05});
    stages.push_back({"write", 0.05});
    for (StageShare& stage : stages) stage.share *= 1.0 - std::min(drawing, 0.9);
    stages.back().share += std::min(drawing, 0.9);
    return stages;
}

/// Refuses interfaces of one group, where the report of one structure would have nothing else.
void checkGroups(const CommandLine& call, const BallSet& balls)
{
    const bool implied = !call.has("groups") && !call.has("group-by") && !call.colorGroups &&
                         call.colorGroupsFile.empty();
    if (!call.has("interfaces") || !implied || call.verb != Build || !call.frames.empty() ||
        balls.labels->groups.size() > 1)
        return;
    throw Error(ErrorKind::Input,
                "--interfaces: expected at least two groups, got " +
                    counted(balls.labels->groups.size(), "group", "groups") +
                    " by --group-by chain [hint: --groups FILE names parts of a chain]");
}

/// Whether the estimate is that of the run: it is of one surface, and of the steps that it needs.
bool isEstimated(const SurfaceOptions& options)
{
    const EvolveOptions& flow = options.evolution;
    const bool several =
        options.interfaces || options.ofParts() || options.matchVolume || options.ballAreas;
    const bool asked = flow.flow == Flow::Paper || flow.steps || flow.maxSteps;
    return !several && !asked;
}

/// Whether a number was asked for that depends on what the field closes: pieces, handles, cavities,
/// pockets, areas of atoms. The report has the gaps in any case.
bool dependsOnGaps(const CommandLine& call)
{
    const bool ofPieces =
        std::any_of(call.required.begin(), call.required.end(), [](const Requirement& one) {
            return one.word == "components" || one.word == "cavities" || one.word == "genus";
        });
    const SurfaceOptions& options = call.options;
    const bool ofAreas =
        options.ballAreas && options.areasOf.value_or(options.kind) == options.kind;
    return ofPieces || ofAreas || options.pockets || options.fillCavities || call.verbose;
}

/// Whether a call shows the mesh, or what is measured on it.
bool readsMesh(const CommandLine& call)
{
    constexpr unsigned ofLevelSet = heldByVdb | heldByNvdb | Volume | Solver | Density;
    const bool inFiles = call.outputs.empty() || call.writes(~ofLevelSet);
    return inFiles || call.verb != Build || !call.frames.empty() || !call.required.empty() ||
           call.center;
}

/// What the files, the options and the lines at the end of a call read of a surface.
void chooseWork(CommandLine& call)
{
    SurfaceOptions& options = call.options;
    options.closedForm = needsClosedForm(call);
    options.meshLabels = call.writes(Triangles | PlainColor);
    options.energy = options.needs.statistics = call.writes(Numbers);
    options.needs.passages = call.writes(Numbers) || dependsOnGaps(call);
    options.needs.mesh = readsMesh(call);
    options.needs.levelSet = call.writes(anyGrids | Stage | Volume | Solver);
    options.pocketBodies = wantsBodies(call);
}

/// A line on what the field closes, with what opens the widest of it, and all; empty if that is
/// narrow.
std::string closedByField(const Report& report, const SurfaceOptions& options)
{
    constexpr double wide = 0.25; // [Å], the room of the tunnel of gramicidin (1GRM)
    if (!report.evolution || !report.evolution->gaps || report.evolution->gaps->widestClosed < wide)
        return {};
    const EvolutionReport::Gaps& gaps = *report.evolution->gaps;
    const std::string line =
        formatted("gaps: the field closes %s that a probe fits into, with up to %.2f Å of room",
                  counted(*gaps.closedByField, "passage or void", "passages and voids").c_str(),
                  gaps.widestClosed);
    for (const double epsilon : {0.25, 0.1, 0.05}) {
        if (epsilon >= gaps.opensBelow) continue;
        if (options.voxel <= 2.0 * epsilon) // larger ones do not resolve it
            return line +
                   formatted(" [hint: --epsilon %g opens the widest, --surface ses all]", epsilon);
        return line + formatted(" [hint: --epsilon %g --voxel %g opens the widest, --surface ses "
                                "all]",
                                epsilon, 2.0 * epsilon);
    }
    return line;
}

} // namespace

Report surfaceOf(CommandLine call, const BallSet& balls, const Report& read, Terminal& terminal,
                 Clock::time_point start, const std::function<void(MolecularSurface&)>& extend,
                 const ExtraOutputs& companions)
{
    stopIfAsked();
    checkGroups(call, balls);
    chooseWork(call);
    const RunLimits limits = limitsOf(call, balls);
    const double coreSeconds = checkCost(balls, call.options, limits, terminal);
    constexpr double any = std::numeric_limits<double>::infinity();
    if (!call.options.grid) { // in closed form, without the stages of voxels
        terminal.limitTo(any, call.hours);
    } else {
        constexpr double some = 1e-9; // lest the estimate is 0
        terminal.limitTo(isEstimated(call.options) ? coreSeconds : any, call.hours);
        terminal.expect(stagesOf(call.options, limits.besides.seconds / (coreSeconds + some)),
                        coreSeconds / limits.threads);
    }
    MolecularSurface result;
    try {
        result = makeUnitSurface(balls, call.options, &terminal);
    } catch (const Cancelled&) {
        terminal.failIfOverdue(" [hint: a larger --voxel or --max-hours, or fewer --max-steps]");
        throw;
    }
    if (call.options.contacts && call.contacts != ContactLevel::Atom &&
        balls.names->residues.size() == 1)
        result.report.warnings.push_back("contacts: all atoms are of one residue [hint: --contacts "
                                         "atom]");
    if (call.options.interfaces && balls.labels->groups.size() < 2)
        result.report.warnings.push_back("interfaces: all atoms are of one group [hint: --groups "
                                         "FILE names parts of them]");
    const auto& pockets = result.report.pockets;
    if (pockets && pockets->list.empty() && pockets->isChosen && call.frames.empty())
        throw Error(ErrorKind::Input,
                    "--pocket-at " + call.places.pocketAt +
                        ": no pocket is within 4 Å of these atoms [hint: --pocket-cut 0 finds "
                        "shallow ones, too]");
    keepPieces(call.pieces, terminal, result.mesh); // the report and the .vdb have all
    checkRequired(call.required, result.mesh, result.report.surface);
    warnOfPaint(call, result.mesh, result.report);
    terminal.erase();
    if (!call.quiet)
        for (const std::string& warning : result.report.warnings) printLine("warning: " + warning);
    completeReport(call, read, result.report);
    if (extend) extend(result);
    for (const std::string& table : call.areas)
        result.report.tables.push_back(areaTable(table, call, balls, result));

    const auto bodies = std::make_shared<Mesh>(std::move(result.pocketBodies));
    if (call.writes(Numbered)) numberOutputs(result.report.pockets->list.size(), call);
    const auto drawn =
        std::make_shared<Bodies>(drawnBodies(call, balls, *bodies, result, terminal));
    showBodies(*drawn, call.picture);
    if (call.center) centerMesh(call, result, drawn->mesh);
    if (!call.panels.empty()) {
        call.firstName = firstName(call);
        makePanels(call, balls, result.mesh, terminal);
    }
    ShownMeshes shown = shownMeshes(call, call.options, balls, result.mesh, {}, terminal);
    shown.bodies = bodies;
    shown.drawnBodies = drawn;
    shown.coarser = coarserMeshes( // not with --center
        call, balls, result.report, terminal);
    if (!call.options.needs.levelSet) dropGrids(result);
    writeAll(call, balls, result, shown, terminal, start, companions);
    terminal.erase();
    return result.report;
}

namespace
{

/// A line on what was found.
std::string pocketsLine(const Report::Pockets& pockets)
{
    std::string line = "pockets: " + std::to_string(pockets.list.size());
    if (!pockets.list.empty())
        line += formatted(", the largest of %.0f Å^3", pockets.list.front().volume);
    return line + formatted("; below a cut of %g Å", pockets.cut);
}

std::string patchesLine(const Report::Patches& patches)
{
    std::string line = "patches: " + std::to_string(patches.list.size());
    if (!patches.list.empty())
        line += formatted(", the largest of %.1f Å^2", patches.list.front().area);
    return line + formatted("; %s %s %g", patches.value.c_str(), patches.above ? "above" : "below",
                            patches.level);
}

/// A line on the pore.
std::string poreLine(const Report::Pore& pore)
{
    const auto narrower = [](const auto& a, const auto& b) { return a.radius < b.radius; };
    const auto& least = *std::min_element(pore.stations.begin(), pore.stations.end(), narrower);
    std::string line = formatted("pore: %s %.3f Å at (%.2f, %.2f, %.2f), length %.1f Å",
                                 least.radius < 0.0 ? "closed, radius" : "narrowest", least.radius,
                                 least.place[0], least.place[1], least.place[2], pore.length());
    if (const auto conductance = pore.conductance())
        line += formatted(", conductance %.3g pS", *conductance);
    else
        line += formatted(", no water passes below %g Å", Report::Pore::leastWater);
    line += formatted("; along (%.3f, %.3f, %.3f) it crosses %.0f %% of the molecule", pore.axis[0],
                      pore.axis[1], pore.axis[2], 100.0 * pore.crossed);
    if (!pore.bundle.empty())
        line += "; " + counted(pore.bundle.size() + 1, "pore", "pores") + " as wide within 5 %";
    if (!pore.others.empty()) {
        const auto& other = pore.others.front();
        line += formatted("; %s: %.3f Å at (%.2f, %.2f, %.2f)%s",
                          counted(pore.others.size(), "other way", "other ways").c_str(),
                          other.radius, other.place[0], other.place[1], other.place[2],
                          pore.others.size() > 1 ? ", ..." : "");
    }
    return line;
}

/// A line on the tunnels.
std::string tunnelsLine(const Report::Tunnels& tunnels)
{
    const auto& start = tunnels.start;
    const auto& first = tunnels.list.front();
    const auto& least = first.narrowest();
    return formatted("tunnels: %zu from (%.2f, %.2f, %.2f); the widest: %.3f Å at (%.2f, %.2f, "
                     "%.2f), length %.1f Å, curvature %.2f",
                     tunnels.list.size(), start[0], start[1], start[2], least.radius,
                     least.place[0], least.place[1], least.place[2], first.length(),
                     first.curvature());
}

/// Names pages that are slow to load or to send, with options that make them lighter. Triangles,
/// and so their bytes, go by the inverse square of the voxel. 4V5A, 1K4R and 1F2N have about 16
/// bytes an atom besides, and their solvent-excluded surfaces half as many triangles again as the
/// variational ones. These do not come to rest on large voxels.
void sayLargePages(const CommandLine& call, std::size_t balls)
{
    constexpr double large = 12e6, wanted = 11e6; // [byte]
    const double ofAtoms = std::min(16.0 * double(balls), 0.75 * wanted);
    for (const Output& output : call.outputs) {
        std::error_code none;
        const auto bytes = std::filesystem::file_size(output.path, none);
        if (output.format != findFormat("html") || none || double(bytes) <= large) continue;
        double shrink = (double(bytes) - ofAtoms) / (wanted - ofAtoms);
        const bool other =
            hasFlow(call.options.kind) && call.options.voxel * std::sqrt(shrink) > 1.0;
        if (other) shrink *= 1.5;
        const double voxel = std::ceil(10.0 * call.options.voxel * std::sqrt(shrink)) / 10.0;
        printLine(formatted("%s: the page has %.0f MB [hint: %s--voxel %g makes it lighter]",
                            output.path.c_str(), double(bytes) / 1e6, other ? "--surface ses " : "",
                            std::min(voxel, maxVoxel)));
    }
}

} // namespace

Report buildSurface(const CommandLine& call, const BallSet& balls, const Report& read,
                    Terminal& terminal, Clock::time_point start)
{
    const Report report = surfaceOf(call, balls, read, terminal, start);
    if (call.verbose) sayTimes(report);
    if (call.quiet) return report;
    printLine(summary(report));
    if (report.evolution)
        if (const std::string held = heldText(*report.evolution, call.options); !held.empty())
            printLine(held);
    if (report.pockets) printLine(pocketsLine(*report.pockets));
    if (report.patches) printLine(patchesLine(*report.patches));
    if (report.pore) printLine(poreLine(*report.pore));
    if (report.tunnels) printLine(tunnelsLine(*report.tunnels));
    for (const std::string& line : leftOutOf(call)) printLine(line);
    sayLargePages(call, balls.balls.size());
    const std::string closed = dependsOnGaps(call) ? closedByField(report, call.options) : "";
    if (!closed.empty()) printLine(closed);
    return report;
}

/// A line on the lattice, and how to go on.
void saySolver(const CommandLine& call)
{
    const auto input = std::find_if(call.outputs.begin(), call.outputs.end(), [](auto& output) {
        return output.format == findFormat("apbs.in");
    });
    if (!call.apbsGrid || input == call.outputs.end()) return;
    const openvdb::Vec3d h = call.apbsGrid->spacing();
    const auto& n = call.apbsGrid->points;
    printLine(
        formatted("lattice: %d x %d x %d points, %.3g x %.3g x %.3g Å apart; to go on: apbs %s",
                  n[0], n[1], n[2], h[0], h[1], h[2], input->path.c_str()));
}

Report buildSurface(CommandLine call, Clock::time_point start)
{
    MadeFolders folders;
    for (const Output& output : call.outputs)
        if (output.holds(Solver))
            folders.make(std::filesystem::path(output.path).parent_path().string());
    prepareOutputs(call, folders.made());
    for (const Panel& panel : call.panels)
        if (!panel.file.empty()) failIfNoFile(panel.file);
    Terminal terminal(call.progress);
    Report read;
    const BallSet balls = readBalls(call, terminal, read);
    Report report = buildSurface(call, balls, read, terminal, start);
    if (!call.quiet) saySolver(call);
    return report;
}

int build(const CommandLine& asked, Clock::time_point start)
{
    CommandLine call = asked;
    if (const auto status = call.skipExisting ? statusOfExisting(call) : std::nullopt) {
        if (!call.quiet) printLine("done before");
        return *status;
    }
    if (call.dryRun || (call.options.grid && call.memory > 0)) return buildInBricks(call, start);
    call.panelSurfaces = std::make_shared<std::vector<PanelSurface>>();
    const int status = endOf(buildSurface(call, start), moreSteps(call));
    return std::max(status, endOf(*call.panelSurfaces));
}

std::string moreSteps(const CommandLine& call)
{
    return call.has("steps") ? "--steps" : "--max-steps";
}

int endOf(const Report& report, const std::string& more)
{
    const auto& evolution = report.evolution;
    if (evolution && !evolution->converged) {
        printLine(unrestText(*evolution, report.voxel, more));
        return notConvergedStatus;
    }
    return 0;
}

} // namespace molsurf::tool
