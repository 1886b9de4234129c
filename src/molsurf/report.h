// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The report of a run on itself and its result: the content of the .json file.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace molsurf
{

/// A closed inner wall of the surface.
struct Cavity {
    double area;   ///< [Å^2]
    double volume; ///< [Å^3], positive
};

/// The percentiles of Statistics.
constexpr std::array<int, 9> percents = {1, 5, 10, 25, 50, 75, 90, 95, 99};

/// How a quantity is distributed over the area of a surface, in its unit.
struct Statistics {
    double mean = 0.0;
    double standardDeviation = 0.0;
    double min = 0.0;
    double max = 0.0;
    std::array<double, percents.size()> percentiles = {}; ///< the values below which there is as
                                                          ///< many percent of the area
};

/// Integrals over a closed surface, walls of cavities included.
struct SurfaceIntegrals {
    double area = 0.0;                 ///< [Å^2]
    double volume = 0.0;               ///< [Å^3]
    double meanCurvature = 0.0;        ///< of H [Å]
    double gaussianCurvature = 0.0;    ///< of K [sr]: 2 pi times the Euler characteristic
    double squaredMeanCurvature = 0.0; ///< of H^2 (Willmore) [1]: at least 4 pi
    double unresolvedArea = 0.0;       ///< part of the area over which H and H^2 were not
                                       ///< integrated [Å^2]

    SurfaceIntegrals& operator+=(const SurfaceIntegrals& o)
    {
        area += o.area;
        volume += o.volume;
        meanCurvature += o.meanCurvature;
        gaussianCurvature += o.gaussianCurvature;
        squaredMeanCurvature += o.squaredMeanCurvature;
        unresolvedArea += o.unresolvedArea;
        return *this;
    }
};

/// Area, volume and topology of a closed surface.
struct SurfaceReport {
    std::string kind = "variational";
    double area = 0.0;   ///< of all walls [Å^2]
    double volume = 0.0; ///< enclosed, cavities left out [Å^3]
    int eulerCharacteristic = 0;
    int components = 0; ///< closed pieces that are not cavity walls
    std::vector<Cavity> cavities;
    double outerArea = 0.0;   ///< without the cavity walls [Å^2]
    double outerVolume = 0.0; ///< cavities counted in [Å^3]
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    bool closed = false;   ///< every edge has two triangles
    bool manifold = false; ///< the triangles about each vertex form one fan, consistently oriented
    std::size_t degenerateTriangles = 0; ///< triangles without area
    double maxResidual = 0.0;            ///< largest |S| at a vertex [Å]
    /// Share of the vertices away from kinks with | |grad Phi| - 1 | < 0.03; not a number if every
    /// vertex is near one.
    double gradientShare = 0.0;
    double kinkShare = 0.0;       ///< share of vertices within two voxels of a kink of the distance
    Statistics meanCurvature;     ///< [1/Å], at the vertices
    Statistics gaussianCurvature; ///< [1/Å^2], at the vertices
    std::optional<SurfaceIntegrals> integrals; ///< if SurfaceOptions::curvatureTotals
};

/// The history of the flow. The interface is the evolving level set's, near the solvent-accessible
/// surface; entry 0 of the first three is the initial one.
struct EvolutionReport {
    int steps = 0;
    bool converged = false;
    std::vector<double> energy;           ///< integral of w over the interface [Å^2]
    std::vector<double> area;             ///< of the interface [Å^2]
    std::vector<double> volume;           ///< inside the interface [Å^3]
    std::vector<double> meanDisplacement; ///< area-weighted mean of |displacement| [Å] of each step
    std::vector<double> maxSpeed;         ///< max |F| near the interface [1/Å] of each step
    /// Estimate of the mean displacement to the state of rest, by the rate at which the steps
    /// shrink [Å]; infinite if they do not.
    double estimatedRemainingDisplacement = 0.0;
    /// Voxels at gaps of the final interface that are too narrow for the grid.
    std::size_t unresolvedGapVoxels = 0;
};

/// A group of atoms and its part of the surface.
struct GroupReport {
    std::string name;
    std::size_t atoms = 0;
    double area = 0.0;   ///< of the surface nearest to its balls [Å^2]; all groups add up to the
                         ///< whole, atoms without a group being one more, "other"
    double volume = 0.0; ///< inside the surface and nearest to its balls [Å^3]; adds up too
    std::string color;   ///< "#rrggbb", if the surface is coloured by group
    std::optional<double> aloneArea{}; ///< of the group surfaced alone, with interfaces [Å^2]
};

/// The area that two groups of atoms bury between them.
struct InterfaceReport {
    std::string first, second; ///< names of the groups
    double area = 0.0;         ///< (A_first + A_second - A_both) / 2, each surfaced alone [Å^2]
};

/// Atoms of one resolution.
struct ResolutionReport {
    std::string select;      ///< as asked; empty: all
    double resolution = 0.0; ///< d [Å]
    std::size_t atoms = 0;   ///< balls that have it
    double level = 0.0;      ///< of their Gaussians; not 0 where the volume was matched
};

/// Beads that stand for several atoms.
struct CoarseReport {
    std::size_t beads = 0;
    std::size_t atoms = 0; ///< that they stand for
};

/// A surface of some of the atoms, alone.
struct PartReport {
    std::string name;
    std::size_t atoms = 0;
    SurfaceReport surface;
};

/// Everything in the .json report.
struct Report {
    std::string program = "vdb_molsurf";
    std::string version;
    std::string command;
    std::string input;
    std::size_t atoms = 0; ///< balls used, after selection, expansion and drops
    double voxel = 0.0;    ///< [Å]
    std::optional<std::array<double, 3>> center; ///< point of the input that was put at the origin
                                                 ///< [Å], if any was
    SurfaceReport surface;
    std::optional<CoarseReport> coarse;        ///< with beads
    std::vector<ResolutionReport> resolutions; ///< one a rule, in their order
    std::vector<GroupReport> groups;
    std::vector<InterfaceReport> interfaces; ///< of groups that touch, if asked for
    std::vector<PartReport> parts; ///< surfaces of their own, of which `surface` is the sum; empty
                                   ///< if there is one only
    std::optional<EvolutionReport> evolution; ///< absent for surfaces that are not evolved
    std::size_t activeVoxels = 0;             ///< of the grid `surface`
    std::size_t gridBytes = 0;                ///< of the grid `surface` in memory
    std::vector<std::pair<std::string, double>> seconds; ///< stage, wall seconds; "total" last
    std::size_t peakMemoryBytes = 0;
    int threads = 0;
    std::vector<std::string> warnings;

    /// Adds to the time of a stage, which may come more than once.
    void addSeconds(const std::string& stage, double more)
    {
        for (auto& [name, sum] : seconds) {
            if (name != stage) continue;
            sum += more;
            return;
        }
        seconds.emplace_back(stage, more);
    }
};

} // namespace molsurf
