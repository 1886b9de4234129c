// SPDX-License-Identifier: MPL-2.0
#include "verbs.h"

#include "bricks.h"
#include "cli/option_table.h"
#include "outputs.h"
#include "terminal.h"
#include "write_result.h"

#include "molsurf/analysis/measures/compare.h"
#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/structure/sha256.h"
#include "molsurf/molecule/structure/text_fields.h"
#include "molsurf/scale/bricks/plan_bricks.h"
#include "molsurf/show/io/read_mesh.h"
#include "molsurf/show/io/read_vdb.h"
#include "molsurf/show/io/write_comparison.h"
#include "molsurf/show/io/write_vdb.h"
#include "molsurf/surface/run.h"

#include <filesystem>
#include <iostream>
#include <limits>

namespace molsurf::tool
{

namespace
{

/// One of the two files, read; of a dry run only its cost.
struct Read {
    std::string path;
    PlannedBrick cost;
    Operand operand;
    bool converged = true;
    std::shared_ptr<const Anchors> anchors{};     ///< of a structure, for --superpose
    std::optional<Superposition> superposition{}; ///< of the second one on the first
};

/// Runs f; an Input error of it names the file.
template<typename F>
auto naming(const std::string& path, const F& f)
{
    try {
        return f();
    } catch (const Error& e) {
        if (e.kind() != ErrorKind::Input) throw;
        throw Error(e, path + ": " + e.what());
    }
}

// Refuses grids that --for has moved or scaled: they are no longer where the mesh is, in Å.
void refuseScene(const std::string& path, const openvdb::MetaMap& metadata)
{
    const auto number = [&](const char* name, double plain) {
        const auto entry = metadata.getMetadata<openvdb::DoubleMetadata>(name);
        return entry ? entry->value() : plain;
    };
    if (number("scene.units_per_angstrom", 1.0) == 1.0 && number("scene.shift_in_voxels", 0.0) == 0)
        return;
    throw Error(ErrorKind::Input, path + ": it was scaled or moved for another program by --for "
                                         "[hint: write a plain .vdb]");
}

/// Reads a .vdb, a mesh or a structure, whose surface is made; of a dry run only the cost.
/// @param[in,out] said  gets a line on a structure
/// @param[in]     first  the other one, if that was read before
/// @throws Error(ErrorKind::Input) if it costs too much, with the other one
Read readOne(const CommandLine& call, const std::string& path, Terminal& terminal,
             std::vector<std::string>& said, const Read* first = nullptr)
{
    Read read;
    read.path = path;
    const auto costs = [&](const PlannedBrick& cost) { // gives whether to go on
        read.cost = cost;
        if (!call.dryRun)
            checkCost(first ? costOfComparison(first->cost, cost) : cost, limitsOf(call));
        return !call.dryRun;
    };
    terminal.update("read", 0.0);
    if (isVdbFile(path)) {
        const VdbFile file =
            readVdb(path, [&](const VdbContent& content) { return costs(costOfStored(content)); });
        if (call.dryRun) return read;
        stopIfAsked();
        refuseScene(path, file.metadata);
        terminal.update("surface", 0.0);
        read.operand = naming(path, [&] { return operandOf(file.grids, terminal); });
    } else if (isMeshName(path)) {
        std::error_code none; // a stream has no size
        const auto bytes = std::filesystem::file_size(path, none);
        const bool flat = lowered(std::filesystem::path(path).extension().string()) == ".ply";
        if (!costs(costOfMesh(none ? 0 : bytes, flat))) return read;
        Mesh mesh = readMesh(path, call.atoms.limits.maxInput);
        stopIfAsked();
        read.operand = operandOf(std::move(mesh), terminal);
    } else {
        CommandLine own = call;
        if (first) own.anchors = first->anchors;
        const auto [selection, places, description, anchors, motion] =
            readBalls(path, own, terminal);
        said.push_back(description);
        read.anchors = anchors;
        read.superposition = motion;
        SurfaceOptions options = call.options;
        options.fields = {"spline"};
        if (!call.dryRun) checkCost(selection, options, limitsOf(call), terminal);
        if (!costs(planWhole(selection, options, terminal).bricks[0])) return read;
        MolecularSurface result = makeUnitSurface(selection, options, &terminal);
        read.converged = !result.report.evolution || result.report.evolution->converged;
        read.operand = operandOf(std::move(result));
        auto& warnings = read.operand.warnings;
        warnings.insert(warnings.begin(), selection.record.warnings.begin(),
                        selection.record.warnings.end());
    }
    for (std::string& warning : read.operand.warnings) warning = path + ": " + warning;
    return read;
}

/// A warning where the two lie beside each other, so that distances are those of their places.
std::string apartText(const Read& a, const Read& b)
{
    const auto boxOf = [](const Read& read) {
        openvdb::BBoxd box;
        for (const openvdb::Vec3f& x : read.operand.surface.mesh.positions)
            box.expand(openvdb::Vec3d(x));
        return box;
    };
    const openvdb::BBoxd one = boxOf(a), other = boxOf(b);
    const double apart = (one.getCenter() - other.getCenter()).length();
    const double size = std::max(one.extents().length(), other.extents().length());
    if (!(apart > 0.5 * size)) return {};
    const bool structures = a.operand.kind == "structure" && b.operand.kind == "structure";
    return formatted("A and B lie %.1f Å apart, more than half of their size%s", apart,
                     structures ? " [hint: --superpose auto lays B on A]" : "");
}

std::vector<std::string> warningsOf(const CommandLine& call, const Read& a, const Read& b)
{
    std::vector<std::string> all = call.warnings;
    const bool structures = a.operand.kind == "structure" || b.operand.kind == "structure";
    std::vector<std::string> idle; // options that only structures need; meshes have voxels, too
    for (const OptionGroup& group : optionTable())
        for (const Option& option : group.options)
            if (option.get && (option.verbs & Compare) && call.has(option.name) &&
                option.name != std::string("voxel"))
                idle.push_back(std::string("--") + option.name);
    if (!structures && !idle.empty())
        all.push_back(joinWords(idle, ", ") +
                      ": without effect, since neither A nor B is a structure");
    for (const Read* read : {&a, &b})
        all.insert(all.end(), read->operand.warnings.begin(), read->operand.warnings.end());
    const std::string apart = apartText(a, b);
    if (!apart.empty()) all.push_back(apart);
    return all;
}

ComparedFile described(const Read& read)
{
    const Operand& operand = read.operand;
    const Mesh& mesh = operand.surface.mesh;
    return {read.path,
            operand.kind,
            operand.atoms,
            operand.voxel,
            operand.size.area,
            operand.size.volume,
            mesh.positions.size(),
            mesh.triangles.size(),
            operand.surface.closed};
}

openvdb::MetaMap metadata(const CommandLine& call, const ComparisonReport& report)
{
    openvdb::MetaMap map;
    const auto text = [&](const char* name, const std::string& value) {
        if (!value.empty()) map.insertMeta(name, openvdb::StringMetadata(value));
    };
    const auto number = [&](const std::string& name, double value) {
        map.insertMeta(name, openvdb::DoubleMetadata(value));
    };
    text("program", report.program);
    text("version", report.version);
    text("command", report.command);
    text("a", report.a.input);
    text("b", report.b.input);
    text("a_sha256", sha256OfFile(call.inputs[0])); // of streams empty
    text("b_sha256", sha256OfFile(call.inputs[1]));
    for (const bool there : {true, false}) {
        const Comparison::OneWay& way = there ? report.distances.aToB : report.distances.bToA;
        const std::string name = there ? "a_to_b." : "b_to_a.";
        number(name + "mean", way.mean);
        number(name + "rms", way.rms);
        number(name + "max", way.max);
    }
    number("hausdorff", report.distances.hausdorff);
    return map;
}

/// The grid `surface` of A, and the distances on its band.
openvdb::GridCPtrVec grids(const CommandLine& call, const Operand& a, const DistanceTo& toB,
                           Terminal& terminal)
{
    const openvdb::FloatGrid::Ptr surface =
        a.levelSet ? a.levelSet->copy() : levelSetOf(a.surface, call.options.voxel);
    surface->setName("surface");
    openvdb::GridPtrVec all = {surface};
    for (const auto& grid : distanceGrids(*surface, toB, terminal)) all.push_back(grid);
    for (const auto& grid : all) grid->setCreator("vdb_molsurf " MOLSURF_VERSION);
    return {all.begin(), all.end()};
}

/// Says what cannot be done with these two surfaces.
void refuse(const CommandLine& call, const Read& a, const Read& b)
{
    const bool vdb = call.writes(Grids);
    if (call.colorBySign && !b.operand.surface.closed)
        throw Error(ErrorKind::Input, b.path + ": expected a closed surface for --color "
                                               "signed-distance, got one without an inside");
    if (vdb && !a.operand.levelSet && !a.operand.surface.closed)
        throw Error(ErrorKind::Input, a.path + ": expected a closed mesh for -o .vdb, got an open "
                                               "one [hint: -o .ply]");
}

/// Prints the numbers that no file holds.
void sayResult(const CommandLine& call, const ComparisonReport& report)
{
    if (call.outputs.empty()) std::cout << comparisonTable(report);
    if (call.verbose) {
        for (const auto& [stage, time] : report.seconds) {
            printLine(formatted("%-11s %9.3f s", stage.c_str(), time));
        }
    }
    if (call.quiet || call.outputs.empty()) return;
    const Comparison& both = report.distances;
    printLine(formatted("mean distance %.4f Å there, %.4f Å back, Hausdorff %.4f Å, %.2f s",
                        both.aToB.mean, both.bToA.mean, both.hausdorff,
                        report.seconds.back().second));
}

/// Compares two files and writes what was asked for.
/// @return the exit status
int compareFiles(const CommandLine& call, Clock::time_point start, Terminal& terminal)
{
    ComparisonReport report;
    Clock::time_point lapStart = Clock::now();
    const auto lap = [&](const char* stage) {
        report.seconds.emplace_back(stage, secondsSince(lapStart));
        lapStart = Clock::now();
    };
    std::vector<std::string> said;
    const Read a = readOne(call, call.inputs[0], terminal, said);
    const Read b = readOne(call, call.inputs[1], terminal, said, &a);
    if (call.dryRun) {
        terminal.erase();
        printLine(costText(costOfComparison(a.cost, b.cost)));
        return 0;
    }
    lap("surfaces");
    if (!call.superpose.empty() && !b.superposition)
        throw Error(ErrorKind::Input, "--superpose: expected two structures, got a " +
                                          (a.anchors ? b : a).operand.kind + ", " +
                                          (a.anchors ? b : a).path);
    report.superposition = b.superposition;
    for (const std::string& warning : warningsOf(call, a, b))
        report.warnings.push_back(withOptionNames(warning));
    terminal.erase();
    if (!call.quiet) {
        for (const std::string& line : said) printLine(line);
        for (const std::string& warning : report.warnings) printLine("warning: " + warning);
    }
    refuse(call, a, b);
    stopIfAsked();

    const DistanceTo toA(a.operand.surface), toB(b.operand.surface);
    lap("search tree");
    report.distances = molsurf::compare(a.operand, toA, b.operand, toB, terminal);
    lap("distance");
    chooseColors(call.colorBySign, call.colorRange, call.labels.coloring.palette, report);
    report.version = MOLSURF_VERSION;
    report.command = call.command;
    report.a = described(a);
    report.b = described(b);
    report.threads =
        int(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
    MolecularSurface drawn;
    if (call.writes(Views)) drawn.mesh = comparisonMesh(a.operand.surface.mesh, report);
    ShownMeshes shown;
    shown.legend = comparisonLegend(report);
    shown.about = "Distances from " + displayName(inputStem(b.path)) + ". Areas are of the mesh.";
    writeOutputs(
        call, terminal,
        [&](const Output& output, OutputFile& file) {
            if (output.holds(Triangles))
                writeComparisonMesh(a.operand.surface.mesh, report, file);
            else if (output.holds(Grids))
                writeVdb(grids(call, a.operand, toB, terminal), metadata(call, report), file);
            else if (output.holds(Numbers))
                writeComparison(report, file);
            else
                writeOutput(call, {}, drawn, output, terminal, file, shown);
        },
        [&](double seconds) { endReport(seconds, start, report); });
    terminal.erase();
    sayResult(call, report);
    for (const Read* read : {&a, &b})
        if (!read->converged)
            printLine(read->path + ": not converged; the files are written [hint: a larger "
                                   "--tolerance or a smaller --voxel]");
    return a.converged && b.converged ? 0 : notConvergedStatus;
}

} // namespace

int compare(const CommandLine& call, Clock::time_point start)
{
    prepareOutputs(call);
    Terminal terminal(call.progress);
    // Where the triangles of a mesh lie in a tangle, each distance takes many of them: no estimate
    // tells that before, so the clock does.
    terminal.limit(std::numeric_limits<double>::infinity(), call.hours);
    try {
        return compareFiles(call, start, terminal);
    } catch (const Cancelled&) {
        if (!terminal.overdue()) throw;
        throw Error(ErrorKind::Numeric, formatted("the comparison takes more than %g hours [hint: "
                                                  "a larger --max-hours]",
                                                  call.hours));
    }
}

} // namespace molsurf::tool
