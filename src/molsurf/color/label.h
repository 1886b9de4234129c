// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The atoms' identities and colours on a surface.
///
/// Every point of a surface belongs to the ball whose own surface is nearest to it: the least
/// |x - x_i| - r_i, see nearestBalls().

#include "molsurf/color/color_map.h"
#include "molsurf/mesh.h"
#include "molsurf/progress.h"
#include "molsurf/selection/select_balls.h"

#include <openvdb/openvdb.h>

#include <cstdint>
#include <vector>

namespace molsurf
{

/// One number a point: a ball, or -1.
using Labels = std::vector<std::int32_t>;

/// Adds the labels atom_id and, of labelled balls, chain_id and group_id to a mesh.
/// @param[in] nearest  ball of each vertex
void labelVertices(const BallSet& atoms, const Labels& nearest, Mesh& mesh);

/// The grids of labels that are wanted.
struct LabelNames {
    bool atoms = false, chains = false, groups = false;
};

/// The grids atom_id, chain_id and group_id on the active voxels of a level set, -1 elsewhere.
/// @param[in] reach  farthest that a point of the band may lie from the balls [Å]
std::vector<openvdb::GridBase::Ptr> labelGrids(const BallSet& atoms,
                                               const openvdb::FloatGrid& surface,
                                               const LabelNames& names, double reach,
                                               const Progress& progress);

/// The colour of the ball of each point, neutral without one.
std::vector<Color> colorsOf(const Labels& nearest, const std::vector<Color>& ballColor);

/// A grid Cd: colours on the band of a level set.
/// @param[in] inside     whether all of the inside has colours, too, as fog needs it
/// @param[in] ballColor  one a ball
openvdb::GridBase::Ptr colorGrid(const openvdb::FloatGrid& surface, bool inside,
                                 const std::vector<Ball>& balls,
                                 const std::vector<Color>& ballColor, double reach,
                                 const Progress& progress);

/// The area of every group, and at last of no group, on a mesh [Å^2]. A triangle of two groups is
/// cut where it is equally far from the balls of both.
/// @param[in] memberOf  group of each ball, or -1
/// @param[in] members   how many groups there are
/// @param[in] nearest   ball of each vertex
std::vector<double> memberAreas(const std::vector<Ball>& balls, const Labels& memberOf,
                                std::size_t members, const Labels& nearest, const Mesh& mesh);

/// One point in every cell of a lattice, if inside the surface. Cells are an Å wide, smaller if the
/// volume is small, and larger if it is very large; the places in them vary, so that borders along
/// the lattice do no harm.
/// @param[in] volume  inside the surface [Å^3]
std::vector<openvdb::Vec3f> pointsInside(const openvdb::FloatGrid& surface, double volume);

} // namespace molsurf
