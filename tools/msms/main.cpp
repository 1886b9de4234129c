// SPDX-License-Identifier: MPL-2.0

/// @file
/// vdb_molsurf_msms, which stands in for MSMS 2.6.

#include "bricks.h"
#include "msms/call.h"
#include "msms/files.h"
#include "msms/surface.h"
#include "program.h"
#include "stand_in.h"
#include "terminal.h"

#include "molsurf/error.h"
#include "molsurf/kernel/pipeline/check_balls.h"
#include "molsurf/molecule/selection/select_balls.h"
#include "molsurf/molecule/structure/read_structure.h"

#include <openvdb/openvdb.h>

#include <cmath>
#include <thread>

using namespace molsurf;
using namespace molsurf::msms;
using tool::printed;
using tool::printLine;

namespace
{

/// The files of a surface of so many components.
std::vector<std::string> outputsOf(const MsmsCall& call, std::size_t components)
{
    std::vector<std::string> paths;
    for (std::size_t n = 0; n < components && !call.surface.empty(); ++n) {
        paths.push_back(componentName(call.surface, n, ".vert"));
        paths.push_back(componentName(call.surface, n, ".face"));
    }
    if (!call.areas.empty()) paths.push_back(call.areas + ".area");
    return paths;
}

void prepare(const MsmsCall& call, const std::vector<std::string>& paths)
{
    tool::prepareFiles(paths, call.input, " [hint: another name after -of or -af]");
}

Structure readSpheres(const MsmsCall& call)
{
    Structure structure =
        readStructureAs(StructureFormat::Xyzrn, call.input, tool::mostSphereBytes);
    if (call.hydrogens) return structure;
    // A sphere without a radius is not used, and the others keep their numbers.
    constexpr float hydrogen = 1.2f, rounding = 1e-4f; // [Å]
    for (Atom& atom : structure.atoms)
        if (std::abs(atom.radius - hydrogen) < rounding) atom.radius = 0.0f;
    return structure;
}

/// Cost of a call: the mesh, and then the exact surface. Measured with 1 to 30 vertices an Å^2
/// on 327 to 60,000 atoms: these give 0.8 to 1.4 times the seconds, and 1 to 1.8 times the memory.
PlannedBrick costOf(const MsmsCall& call, const BallSet& spheres, const Progress& progress)
{
    PlannedBrick cost =
        planWhole(spheres, meshOptions(spheres.balls, call.probe, call.density), progress)
            .bricks[0];
    constexpr double start = 0.03, secondsPerSphere = 0.17e-3, bytesPerSphere = 4e3;
    cost.seconds += start + secondsPerSphere * double(spheres.balls.size());
    cost.bytes += std::size_t(bytesPerSphere * double(spheres.balls.size()));
    return cost;
}

MsmsSurface surfaceOf(const MsmsCall& call, const std::vector<Ball>& balls,
                      tool::Terminal& terminal)
{
    try {
        return msmsSurface(balls, call.probe, call.density, call.all, terminal);
    } catch (const Cancelled&) {
        terminal.failIfOverdue(" [hint: a smaller -density, or fewer spheres]");
        throw;
    }
}

void perform(const MsmsCall& call)
{
    openvdb::initialize();
    tool::recoverFolders(outputsOf(call, 1));
    prepare(call, outputsOf(call, 1));

    tool::Terminal terminal(false);
    const Structure structure = readSpheres(call);
    SelectOptions all;
    all.waters = true;
    const BallSet selected = selectBalls(structure, all, {}, call.probe, terminal);
    const Spheres spheres{structure, selected.balls};
    for (const auto* list : {&call.warnings, &structure.warnings, &selected.record.warnings})
        for (const std::string& warning : *list) printLine("warning: " + warning);
    const PlannedBrick cost = costOf(call, selected, terminal);
    if (call.dryRun) return printLine(tool::costText(cost));
    constexpr double hours = 24.0;
    checkCost(cost, {availableMemory(), hours, int(std::thread::hardware_concurrency()),
                     " [hint: a smaller -density, or fewer spheres"});
    terminal.limitTo(cost.seconds, hours);
    printed(titleText(call, spheres));

    const MsmsSurface surface = surfaceOf(call, selected.balls, terminal);
    if (surface.components.empty())
        throw Error(ErrorKind::Numeric, call.input + ": the spheres have no outer surface");
    const std::vector<std::string> paths = outputsOf(call, surface.components.size());
    prepare(call, paths);
    const auto write = [&](std::size_t i, OutputFile& file) {
        const std::size_t n = i / 2;
        if (call.surface.empty() || n >= surface.components.size())
            writeAreas(spheres, surface, file);
        else if (i % 2 == 0)
            writeVertices(call, spheres, surface.components[n], file);
        else
            writeFaces(call, spheres, surface.components[n], file);
    };
    tool::writeFiles(paths, write, [&] { printed(resultText(call, surface)); });
    printed("MSMS terminated normally\n");
}

} // namespace

const char* const tool::programName = "vdb_molsurf_msms";
const char* const tool::noMemoryText =
    "error: not enough memory [hint: a smaller -density, or fewer spheres]";

int main(int argc, char** argv)
{
    return tool::runStandIn([&] {
        const MsmsCall call = parseMsms(argc, argv);
        if (call.help)
            printed(msmsHelp());
        else if (call.manual)
            printed(msmsManual());
        else if (call.version)
            printed(std::string("vdb_molsurf_msms ") + MOLSURF_VERSION + "\n");
        else
            perform(call);
    });
}
