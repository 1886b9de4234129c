// SPDX-License-Identifier: MPL-2.0

/// @file
/// vdb_molsurf_nanoshaper, which stands in for NanoShaper.

#include "bricks.h"
#include "nanoshaper/config.h"
#include "program.h"
#include "stand_in.h"
#include "terminal.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/kernel/mesh/measure.h"
#include "molsurf/kernel/pipeline/check_balls.h"
#include "molsurf/molecule/selection/select_balls.h"
#include "molsurf/molecule/structure/read_structure.h"
#include "molsurf/show/io/output_buffer.h"
#include "molsurf/show/io/write_mesh.h"
#include "molsurf/surface.h"

#include <openvdb/openvdb.h>

#include <thread>

using namespace molsurf;
using namespace molsurf::nanoshaper;
using tool::printed;
using tool::printLine;

namespace
{

constexpr const char* costHint = " [hint: a smaller Grid_scale, or fewer spheres";

SurfaceOptions optionsOf(const Config& config)
{
    SurfaceOptions options;
    options.kind = config.kind;
    options.probe = config.probe;
    options.blobbiness = config.blobbyness;
    options.voxel = 1.0 / config.scale;
    return options;
}

/// The mesh without the walls of cavities up to some volume [Å^3].
Mesh withoutCavities(const Mesh& mesh, double largest, const Progress& progress)
{
    const MeshPieces pieces = piecesOf(mesh, progress);
    const auto isKept = [&](std::uint32_t v) {
        const double volume = pieces.measures[pieces.of[v]].volume;
        return volume >= 0.0 || -volume > largest;
    };
    Mesh out;
    for (const auto& label : mesh.labels) out.labels.push_back({label.name, {}});
    std::vector<std::uint32_t> places(mesh.positions.size());
    for (std::uint32_t v = 0; v < places.size(); ++v) {
        if (!isKept(v)) continue;
        places[v] = std::uint32_t(out.positions.size());
        out.positions.push_back(mesh.positions[v]);
        out.normals.push_back(mesh.normals[v]);
        for (std::size_t l = 0; l < mesh.labels.size(); ++l)
            out.labels[l].values.push_back(mesh.labels[l].values[v]);
    }
    for (const auto& [a, b, c] : mesh.triangles)
        if (isKept(a)) out.triangles.push_back({places[a], places[b], places[c]});
    return out;
}

/// Writes .off as NanoShaper does: two lines of comments before the counts, and behind the places
/// normals and the nearest sphere (from 0), if they are asked for.
void writeNanoOff(const Config& config, const Mesh& mesh, OutputFile& file)
{
    TextOutput out(file);
    out << "OFF" << (config.normals ? "+N" : "") << (config.atoms ? "+A" : "")
        << "\n# written by vdb_molsurf_nanoshaper\n# lengths in Å\n"
        << mesh.positions.size() << " " << mesh.triangles.size() << " 0\n";
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const auto vector = [&](const openvdb::Vec3f& x) {
            for (int axis = 0; axis < 3; ++axis) out.fixed(double(x[axis]), 3) << " ";
        };
        vector(mesh.positions[v]);
        if (config.normals) vector(mesh.normals[v]);
        if (config.atoms) out << mesh.labels.at(0).values[v];
        out << "\n";
    }
    for (const auto& [a, b, c] : mesh.triangles) out << "3 " << a << " " << b << " " << c << "\n";
    out.finish();
}

/// The areas of the flat triangles, a line each [Å^2].
void writeTriangleAreas(const Mesh& mesh, OutputFile& file)
{
    TextOutput out(file);
    for (const auto& [a, b, c] : mesh.triangles) {
        const openvdb::Vec3d x(mesh.positions[a]), y(mesh.positions[b]), z(mesh.positions[c]);
        out.fixed(0.5 * (y - x).cross(z - x).length(), 6) << "\n";
    }
    out.finish();
}

/// The spheres that the probe touches: their places, or their numbers from 0.
void writeExposed(const std::vector<Ball>& exposed, bool places, OutputFile& file)
{
    TextOutput out(file);
    if (places) out << exposed.size() << "\nExposed_atoms\n";
    for (const Ball& ball : exposed) {
        if (places) {
            out << "C";
            for (int axis = 0; axis < 3; ++axis) out << " ", out.fixed(ball.center[axis], 6);
        } else {
            out << ball.atom;
        }
        out << "\n";
    }
    out.finish();
}

/// A file of results.
struct ResultFile {
    std::string path;
    std::function<void(OutputFile&)> write;
};

/// Results of a run.
struct Results {
    Mesh mesh;
    std::vector<Ball> exposed;
    std::string warnings; ///< a line each
};

/// Writes a mesh in one of meshFormats().
std::function<void(OutputFile&)> meshWriter(const Mesh& mesh, const std::string& word)
{
    return [&mesh, word](OutputFile& file) {
        for (const MeshFormat& format : meshFormats())
            if (word == format.word) format.write(mesh, {"triangulatedSurf", {}}, file);
    };
}

std::vector<ResultFile> filesOf(const Config& config, const Results& results)
{
    std::vector<ResultFile> files;
    const auto add = [&](const std::string& end, std::function<void(OutputFile&)> write) {
        files.push_back({config.path(end), std::move(write)});
    };
    const auto mesh = [&](const char* word) {
        add(std::string("triangulatedSurf.") + word, meshWriter(results.mesh, word));
    };
    if (config.mesh && config.msms) {
        mesh("vert");
        mesh("face");
    }
    if (config.mesh && config.ply) mesh("ply");
    if (config.mesh && !config.msms && !config.ply)
        add("triangulatedSurf.off",
            [&](OutputFile& file) { writeNanoOff(config, results.mesh, file); });
    if (config.mesh)
        add("triangleAreas.txt", [&](OutputFile& file) { writeTriangleAreas(results.mesh, file); });
    add("exposed.xyz", [&](OutputFile& file) { writeExposed(results.exposed, true, file); });
    add("exposedIndices.txt",
        [&](OutputFile& file) { writeExposed(results.exposed, false, file); });
    add("stderror.txt", [&](OutputFile& file) {
        file.write(results.warnings);
        file.finish();
    });
    return files;
}

std::vector<std::string> pathsOf(const std::vector<ResultFile>& files)
{
    std::vector<std::string> paths;
    for (const ResultFile& file : files) paths.push_back(file.path);
    return paths;
}

MolecularSurface surfaceOf(const Config& config, const BallSet& spheres, tool::Terminal& terminal)
{
    try {
        return makeSurface(spheres, optionsOf(config), &terminal);
    } catch (const Cancelled&) {
        terminal.failIfOverdue(std::string(costHint) + "]");
        throw;
    }
}

void checkRun(const Config& config, const BallSet& spheres, tool::Terminal& terminal)
{
    constexpr double hours = 24.0;
    const PlannedBrick cost = planWhole(spheres, optionsOf(config), terminal).bricks[0];
    checkCost(cost, {availableMemory(), hours, int(std::thread::hardware_concurrency()), costHint});
    terminal.limitTo(cost.seconds, hours);
}

void perform(const std::string& path)
{
    openvdb::initialize();
    const Config config = readConfig(path);
    tool::limitThreads(config.threads);
    Results results;
    const std::vector<ResultFile> files = filesOf(config, results);
    tool::recoverFolders(pathsOf(files));
    tool::prepareFiles(pathsOf(files), config.input, " [hint: another Root_FileName]");

    tool::Terminal terminal(false);
    const Structure structure =
        readStructureAs(StructureFormat::Xyzrn, config.input, tool::mostSphereBytes);
    SelectOptions all;
    all.waters = true;
    const BallSet spheres = selectBalls(structure, all, {}, config.probe, terminal);
    for (const auto* list : {&config.warnings, &structure.warnings, &spheres.record.warnings})
        for (const std::string& warning : *list) {
            printLine("warning: " + warning);
            results.warnings += warning + "\n";
        }
    checkRun(config, spheres, terminal);
    MolecularSurface surface = surfaceOf(config, spheres, terminal);
    results.mesh = config.fill ? withoutCavities(surface.mesh, config.filled, terminal)
                               : std::move(surface.mesh);
    const std::vector<double> areas = exposedAreas(spheres.balls, config.probe, terminal);
    for (std::size_t i = 0; i < areas.size(); ++i)
        if (areas[i] > 0.0) results.exposed.push_back(spheres.balls[i]);
    const SurfaceReport measured = measure(results.mesh, terminal);
    tool::writeFiles(
        pathsOf(files), [&](std::size_t i, OutputFile& file) { files[i].write(file); },
        [&] {
            printed(
                formatted("vdb_molsurf_nanoshaper %s: %zu atoms, %zu exposed\n", MOLSURF_VERSION,
                          spheres.balls.size(), results.exposed.size()) +
                formatted("Mesh: %zu vertices, %zu triangles\n", results.mesh.positions.size(),
                          results.mesh.triangles.size()) +
                formatted("Volume %.3f [A^3]\nArea %.3f [A^2]\n", measured.volume, measured.area));
        });
}

} // namespace

const char* const tool::programName = "vdb_molsurf_nanoshaper";
const char* const tool::noMemoryText =
    "error: not enough memory [hint: a smaller Grid_scale, or fewer spheres]";

int main(int argc, char** argv)
{
    return tool::runStandIn([&] {
        const std::string word = argc > 1 ? argv[1] : "";
        if (argc > 2)
            throw Error(ErrorKind::Usage, "expected one configuration file, got " +
                                              std::to_string(argc - 1) + " words");
        if (word == "-h" || word == "--help")
            printed(helpText());
        else if (word == "--man")
            printed(manualText());
        else if (word == "--version")
            printed(std::string("vdb_molsurf_nanoshaper ") + MOLSURF_VERSION + "\n");
        else
            perform(word.empty() ? "surfaceConfiguration.prm" : word);
    });
}
