// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Parts of a space, split at its necks.

#include "molsurf/analysis/pockets/cut_graph.h"
#include "molsurf/analysis/pockets/void_field.h"
#include "molsurf/analysis/pockets/void_graph.h"
#include "molsurf/ball.h"
#include "molsurf/progress.h"

#include <openvdb/Types.h>

#include <cstdint>
#include <vector>

namespace molsurf
{

/// A voxel as a number: 512 times its leaf and its place there.
using VoxelPlace = std::uint32_t;

/// Voxels that edges of the tetrahedra of cells join: seven of them beyond it in each leaf's order,
/// as many before it. A cell is six tetrahedra about its long diagonal (Kuhn's triangulation).
constexpr int edgeWays[7][3] = {{0, 0, 1}, {0, 1, 0}, {0, 1, 1}, {1, 0, 0},
                                {1, 0, 1}, {1, 1, 0}, {1, 1, 1}};

/// Calls f(place) for the voxels that edges join to one, as far as there are leaves for them.
template<typename F>
void forEachJoined(const LeafTable& table, VoxelPlace place, const F& f)
{
    const std::size_t n = place / leafSize;
    const int v = int(place % leafSize), at[3] = {v >> 6, v >> 3 & 7, v & 7};
    for (const int sign : {1, -1}) {
        for (const auto& way : edgeWays) {
            int leaf = centreNeighbour, voxel = 0;
            constexpr int weights[3] = {9, 3, 1};
            for (int k = 0; k < 3; ++k) {
                const int to = at[k] + sign * way[k];
                leaf += weights[k] * (to < 0 ? -1 : to >= leafDim ? 1 : 0);
                voxel = 8 * voxel + (to & 7);
            }
            const std::int32_t m = table.neighbours(n)[std::size_t(leaf)];
            if (m != noLeaf) f(VoxelPlace(std::size_t(m) * leafSize + std::size_t(voxel)));
        }
    }
}

/// Where two basins touch.
struct Neck {
    std::int32_t basins[2]; ///< ascending
    float clearance;        ///< of its widest voxel [Å]
};

/// Parts of the active voxels of a VoidField.
struct Basins {
    LeafArray<std::int32_t> of; ///< of each voxel its basin, or -1
    std::vector<float> peaks;   ///< of each basin the largest clearance [Å]
    std::vector<Neck> necks;    ///< in ascending order of the basins

    std::size_t count() const { return peaks.size(); }
};

/// Splits a space where it is narrow, by the persistence of the maxima of its clearance: voxels
/// join, those of large clearance first, and two parts that meet stay apart if the clearance there
/// is below a share of the smaller of their maxima.
/// @param[in] share        1: every maximum is a basin; 0: what hangs together is one
/// @param[in] leastVoxels  a basin of fewer joins the neighbour with the widest neck
Basins splitAtNecks(const VoidField& space, double share, double leastVoxels);

/// Where a space is split, as by splitAtNecks().
struct SplitRule {
    double share, leastVoxels;
};

/// A split space, and the graph that decided it.
struct RoomBasins {
    Basins basins;
    VoidGraph graph;                   ///< of what the small probe passes
    CutGraph cut;                      ///< of that what is below the cut
    std::vector<std::int32_t> ofNodes; ///< of each node its basin, or -1
};

/// Splits a space as splitAtNecks() does, but by the nodes and exits of the graph of the void below
/// the cut and what passes between them, which do not depend on voxels: labels of these flow from
/// the nodes and exits down. Where the probe does not pass, parts stay apart. Only maxima of voxels
/// that lead to no node and no exit count as they are.
/// @param[in] probe  the small one [Å]
RoomBasins splitAtRooms(const std::vector<Ball>& balls, double probe, const VoidField& space,
                        const SplitRule& rule, const BelowCut& below, const Progress& progress);

} // namespace molsurf
