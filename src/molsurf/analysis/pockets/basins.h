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
#include <optional>
#include <vector>

namespace molsurf
{

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

/// Where two basins meet.
struct Neck {
    std::int32_t basins[2]; ///< ascending
    float clearance; ///< of its widest place [Å]; 0: the probe does not pass, but balls of it
                     ///< on both sides overlap
};

/// Parts of the active voxels of a VoidField.
struct Basins {
    LeafArray<std::int32_t> of; ///< of each voxel its basin, or -1
    std::vector<float> peaks;   ///< of each basin the largest clearance of its voxels [Å]
    std::vector<Neck> necks;    ///< in ascending order of the basins

    std::size_t count() const { return peaks.size(); }
};

/// Where a basin is widest.
struct WidestPlace {
    VoidPoint ball;
    std::int32_t node; ///< it, or that above the cut to which a way leads from there
    bool isExit;       ///< whether it lies on the cut
};

/// A split space, and the graph that decided it.
struct RoomBasins {
    Basins basins;
    VoidGraph graph;                   ///< of what the small probe passes
    CutGraph cut;                      ///< of that what is below the cut
    std::vector<std::int32_t> ofNodes; ///< of each node its basin, or -1
    /// Of each basin the largest ball about a node or an exit; none: it has neither.
    std::vector<std::optional<WidestPlace>> widest;
    std::vector<char> isCut; ///< of each basin whether an exit is of it
};

/// Splits a space where it is narrow. The nodes and exits of the graph of the void below the cut,
/// where the clearance is largest, join, the widest places where two meet first, and two parts stay
/// apart if the clearance there is below a share of the smaller of their largest clearances. Each
/// place belongs to the part of the ball about a node or an exit that it lies deepest in, of what
/// hangs together with it: two balls that touch the same three atoms meet in the circle through
/// these. None of it depends on voxels, but that they hang together. What has no node and no exit
/// is one part.
/// @param[in] probe  the small one [Å]
/// @param[in] share  1: every maximum is a basin; 0: what hangs together is one
RoomBasins splitAtRooms(const std::vector<Ball>& balls, double probe, const VoidField& space,
                        double share, const BelowCut& below, const Progress& progress);

} // namespace molsurf
