// SPDX-License-Identifier: MPL-2.0
#include "verbs.h"

#include "cli/option_table.h"
#include "outputs.h"
#include "sha256.h"
#include "terminal.h"

#include "molsurf/color/color_map.h"
#include "molsurf/error.h"
#include "molsurf/io/read_mesh.h"
#include "molsurf/io/read_vdb.h"
#include "molsurf/io/write_comparison.h"
#include "molsurf/io/write_mesh.h"
#include "molsurf/io/write_vdb.h"
#include "molsurf/surface.h"
#include "molsurf/surface/compare.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iostream>

namespace molsurf::tool
{

namespace
{

/// One of the two files, read.
struct Read {
    std::string path;
    Operand operand;
    bool converged = true;
};

/// Runs f; an Input error of it names the file.
template<typename F>
auto naming(const std::string& path, const F& f)
{
    try {
        return f();
    } catch (const Error& e) {
        if (e.kind() != ErrorKind::Input) throw;
        throw Error(ErrorKind::Input, path + ": " + e.what());
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

Read readOne(const Call& call, const std::string& path, Terminal& terminal,
             std::vector<std::string>& said)
{
    Read read;
    read.path = path;
    terminal.update("read", 0.0);
    if (isVdbFile(path)) {
        const VdbFile file = readVdb(path);
        stopIfAsked();
        refuseScene(path, file.metadata);
        terminal.update("surface", 0.0);
        read.operand = naming(path, [&] { return operandOf(file.grids, terminal); });
    } else if (isMeshName(path)) {
        Mesh mesh = readMesh(path);
        stopIfAsked();
        read.operand = operandOf(std::move(mesh), terminal);
    } else {
        const auto [selection, description] = readBalls(path, call, terminal);
        said.push_back(description);
        SurfaceOptions options = call.options;
        options.fields = {"spline"};
        MolecularSurface result = makeSurface(selection, options, &terminal);
        read.converged = !result.report.evolution || result.report.evolution->converged;
        read.operand = operandOf(std::move(result));
        auto& warnings = read.operand.warnings;
        warnings.insert(warnings.begin(), selection.warnings.begin(), selection.warnings.end());
    }
    for (std::string& warning : read.operand.warnings) warning = path + ": " + warning;
    return read;
}

std::vector<std::string> warningsOf(const Call& call, const Read& a, const Read& b)
{
    std::vector<std::string> all;
    const bool structures = a.operand.kind == "structure" || b.operand.kind == "structure";
    if (structures) all = call.warnings;
    std::vector<std::string> idle; // options that only structures need; meshes have voxels, too
    for (const OptionGroup& group : optionTable())
        for (const Option& option : group.options)
            if (option.stored && (option.verbs & Compare) && call.has(option.name) &&
                option.name != std::string("voxel"))
                idle.push_back(std::string("--") + option.name);
    if (!structures && !idle.empty())
        all.push_back(joinWords(idle, ", ") +
                      ": without effect, since neither A nor B is a structure");
    for (const Read* read : {&a, &b})
        all.insert(all.end(), read->operand.warnings.begin(), read->operand.warnings.end());
    return all;
}

/// The distance that 99 % of the vertices do not exceed; at least a thousandth of an Å, below which
/// differences are rounding.
double usualRange(const std::vector<float>& distances)
{
    constexpr double share = 0.99, least = 1e-3;
    std::vector<float> sorted = distances;
    const auto place = sorted.begin() + std::ptrdiff_t(share * double(sorted.size() - 1));
    std::nth_element(sorted.begin(), place, sorted.end());
    return std::max(double(*place), least);
}

std::string number(double value)
{
    char digits[32];
    return std::string(digits, std::to_chars(digits, digits + sizeof digits, float(value)).ptr);
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

/// What a reader of the mesh file must know of its colours.
std::vector<std::string> colorComments(const ComparisonReport& report)
{
    const ColorScale& color = report.color;
    std::vector<std::string> lines = {"colors: " + report.shown + " in Angstrom, map " + color.map +
                                      " from " + number(color.low) + " to " + number(color.high)};
    for (std::size_t i = 0; i < color.stops.size(); ++i) {
        std::string line = "color " + number(color.valueOf(i));
        for (const std::uint8_t part : color.stops[i]) line += " " + std::to_string(int(part));
        lines.push_back(line);
    }
    return lines;
}

openvdb::MetaMap metadata(const Call& call, const ComparisonReport& report)
{
    openvdb::MetaMap map;
    const auto text = [&](const char* name, const std::string& value) {
        map.insertMeta(name, openvdb::StringMetadata(value));
    };
    const auto number = [&](const std::string& name, double value) {
        map.insertMeta(name, openvdb::DoubleMetadata(value));
    };
    text("program", report.program);
    text("version", report.version);
    text("command", report.command);
    text("a", report.a.input);
    text("b", report.b.input);
    if (call.inputs[0] != "-") text("a_sha256", sha256OfFile(call.inputs[0]));
    if (call.inputs[1] != "-") text("b_sha256", sha256OfFile(call.inputs[1]));
    for (const bool there : {true, false}) {
        const OneWay& way = there ? report.distances.aToB : report.distances.bToA;
        const std::string name = there ? "a_to_b." : "b_to_a.";
        number(name + "mean", way.mean);
        number(name + "rms", way.rms);
        number(name + "max", way.max);
    }
    number("hausdorff", report.distances.hausdorff);
    return map;
}

/// The grid `surface` of A, and the distances on its band.
openvdb::GridCPtrVec grids(const Call& call, const Operand& a, const DistanceTo& toB,
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

} // namespace

int compare(const Call& call, Clock::time_point start)
{
    prepareOutputs(call);
    openvdb::initialize();
    const auto limit = limitThreads(call);
    const auto wanted = [&](Format format) {
        return std::any_of(call.outputs.begin(), call.outputs.end(),
                           [&](const Output& output) { return output.format == format; });
    };

    Terminal terminal(call.progress);
    ComparisonReport all;
    Clock::time_point lapStart = Clock::now();
    const auto lap = [&](const char* stage) {
        all.seconds.emplace_back(stage, secondsSince(lapStart));
        lapStart = Clock::now();
    };
    std::vector<std::string> said;
    Read a = readOne(call, call.inputs[0], terminal, said);
    Read b = readOne(call, call.inputs[1], terminal, said);
    lap("surfaces");
    for (const std::string& warning : warningsOf(call, a, b))
        all.warnings.push_back(withOptionNames(warning));
    terminal.erase();
    if (!call.quiet) {
        for (const std::string& line : said) say(line);
        for (const std::string& warning : all.warnings) say("warning: " + warning);
    }
    if (call.colorBySign && !b.operand.surface.closed)
        throw Error(ErrorKind::Input, b.path + ": expected a closed surface for --color "
                                               "signed-distance, got one without an inside");
    if (wanted(Format::Vdb) && !a.operand.levelSet && !a.operand.surface.closed)
        throw Error(ErrorKind::Input, a.path + ": expected a closed mesh for -o .vdb, got an open "
                                               "one [hint: -o .ply]");
    stopIfAsked();

    const DistanceTo toA(a.operand.surface), toB(b.operand.surface);
    lap("search tree");
    all.distances = molsurf::compare(a.operand, toA, b.operand, toB, terminal);
    lap("distance");

    const OneWay& there = all.distances.aToB;
    const std::vector<float>& shown = there.distance;
    const double range = call.colorRange > 0.0 ? call.colorRange : usualRange(shown);
    const ColorScale& scale = all.color =
        call.colorBySign ? signedScale(range) : magnitudeScale(range);
    all.version = MOLSURF_VERSION;
    all.command = call.command;
    all.a = described(a);
    all.b = described(b);
    all.shown = call.colorBySign ? "signed_distance" : "distance";
    all.threads =
        int(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));

    writeOutputs(
        call, terminal,
        [&](const Output& output, OutputFile& file) {
            const Format format = output.format;
            if (format == Format::Ply) {
                Mesh mesh = a.operand.surface.mesh;
                const auto& values = call.colorBySign ? there.signedDistance : shown;
                mesh.colors.reserve(values.size());
                for (const float value : values) mesh.colors.push_back(scale.at(value));
                mesh.scalars.insert(mesh.scalars.begin(), {"distance", shown});
                if (!there.signedDistance.empty())
                    mesh.scalars.insert(mesh.scalars.begin() + 1,
                                        {"signed_distance", there.signedDistance});
                writePly(mesh, file, colorComments(all));
            } else if (format == Format::Vdb) {
                writeVdb(grids(call, a.operand, toB, terminal), metadata(call, all), file);
            } else {
                writeComparison(all, file);
            }
        },
        [&](double seconds) {
            all.seconds.emplace_back("write", seconds);
            all.seconds.emplace_back("total", secondsSince(start));
            all.peakMemoryBytes = peakMemory();
        });
    terminal.erase();
    if (call.outputs.empty()) std::cout << comparisonTable(all);
    if (call.verbose)
        for (const auto& [stage, time] : all.seconds) {
            char text[64];
            std::snprintf(text, sizeof text, "%-11s %9.3f s", stage.c_str(), time);
            say(text);
        }
    if (!call.quiet && !call.outputs.empty()) {
        char text[160];
        std::snprintf(text, sizeof text,
                      "mean distance %.4f Å there, %.4f Å back, Hausdorff %.4f Å, %.2f s",
                      all.distances.aToB.mean, all.distances.bToA.mean, all.distances.hausdorff,
                      all.seconds.back().second);
        say(text);
    }
    for (const Read* read : {&a, &b})
        if (!read->converged)
            say(read->path + ": not converged; the files are written [hint: --max-steps or "
                             "--tolerance]");
    return a.converged && b.converged ? 0 : notConvergedStatus;
}

} // namespace molsurf::tool
