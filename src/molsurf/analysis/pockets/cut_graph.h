// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// What of the graph of the void lies below a cut.

#include "molsurf/analysis/pockets/clearance.h"
#include "molsurf/analysis/pockets/void_field.h"
#include "molsurf/analysis/pockets/void_graph.h"
#include "molsurf/progress.h"

#include <openvdb/Types.h>

#include <array>
#include <cstdint>
#include <vector>

namespace molsurf
{

/// A VoidGraph below a cut: its nodes there, and the exits, where its edges come up to the cut.
///
/// In what is below the cut the clearance is largest at nodes or at exits, and parts of it meet at
/// necks, or on the cut between two exits.
struct CutGraph {
    /// Where an edge comes to the cut.
    struct Exit {
        std::int32_t node;                 ///< below the cut, or none: it comes up from the floor
        std::int32_t above;                ///< the node above the cut that the edge leads to
        double least;                      ///< clearance on the way there [Å]
        openvdb::Vec3d narrowest;          ///< the place of that [Å]
        VoidPoint end;                     ///< on the cut
        std::array<std::int32_t, 3> balls; ///< of the edge
    };
    /// Two exits of edges that have two balls in common.
    struct Arc {
        std::int32_t exits[2];
        std::int32_t balls[2]; ///< places in VoidGraph::balls
    };

    std::vector<char> isBelow; ///< of each node
    std::vector<Exit> exits;
    std::vector<Arc> arcs;
};

/// Finds them. Voxels only say which nodes are far from the cut.
CutGraph cutGraph(const VoidGraph& graph, const VoidField& space, const BelowCut& below,
                  const Progress& progress);

/// The largest ball that gets from one exit of an arc to the other along the cut, where its two
/// balls are equally near, to about 1e-3 Å; less than 0 if there is no such way [Å].
double widthOf(const CutGraph::Arc& arc, const CutGraph& cut, const VoidGraph& graph,
               const Clearance& clearance, const BelowCut& below);

} // namespace molsurf
