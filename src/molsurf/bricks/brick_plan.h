// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// How a molecule is cut into bricks, and what each of them is expected to cost.

#include <openvdb/Types.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace molsurf
{

/// One brick: a box of whole leaves.
struct PlannedBrick {
    openvdb::CoordBBox box;
    std::size_t atoms = 0;  ///< balls whose centres lie in it
    std::size_t voxels = 0; ///< expected active voxels of the grid `surface` in it
    std::size_t bytes = 0;  ///< expected peak memory of the process that computes it
    double seconds = 0.0;   ///< expected time on one core
};

/// The bricks, and what all of them have to agree on.
struct BrickPlan {
    std::vector<PlannedBrick> bricks; ///< they do not overlap, and hold the whole surface
    int steps = 0;                    ///< of the flow
    openvdb::Coord anchor;            ///< positions in sums are taken from this voxel
    double largest = 0.0, swollen = 0.0, tolerance = 0.0; ///< GaussianExtent of all balls [Å]
    std::size_t atoms = 0;                                ///< balls
    bool keepsMemory = false; ///< what one brick has given back stays in the process for the next
};

/// A file that a plan depends on.
struct PlanInput {
    std::string path;
    std::string sha256;
};

/// The content of plan.json: what to compute, and how it is cut.
struct PlanManifest {
    std::string version;                ///< of the program
    std::string input;                  ///< the structure
    std::vector<std::string> arguments; ///< options of the surface, as on the command line
    std::vector<PlanInput> files;       ///< the structure and other files that were read
    double voxel = 0.0;                 ///< [Å]
    BrickPlan plan;
};

} // namespace molsurf
