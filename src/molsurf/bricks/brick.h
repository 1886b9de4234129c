// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The result of a brick: its part of the grids and of the mesh, and what adds up over bricks.

#include "molsurf/bricks/brick_mesh.h"
#include "molsurf/report.h"

#include <openvdb/openvdb.h>

#include "molsurf/flow/displacement.h"
#include <optional>
#include <string>
#include <vector>

namespace molsurf
{

/// What adds up over bricks.
struct BrickSums {
    std::optional<EvolutionReport> evolution; ///< sums over the owned voxels, step by step
    Displacements displacements;              ///< of the last step, at the owned voxels
    double maxResidual = 0.0;                 ///< largest |S| at a vertex [Å]
    std::size_t kinkVertices = 0;    ///< owned vertices within two voxels of a kink of the distance
    std::size_t unitVertices = 0;    ///< the others with | |grad S| - 1 | < 0.03
    std::vector<GroupReport> groups; ///< areas of the owned triangles, at last those of no group
    std::vector<std::pair<std::string, double>> seconds; ///< stage, wall seconds
};

/// The result of a brick. Without any surface in it, grids have no leaves and the mesh no
/// triangles.
struct Brick : BrickSums {
    BrickMesh mesh;
    std::vector<openvdb::GridBase::Ptr> grids; ///< the owned leaves; `surface` first
};

} // namespace molsurf
