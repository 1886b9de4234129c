// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The atoms' identities and colours on a surface.
///
/// Every point of a surface belongs to the ball whose own surface is nearest to it: the least
/// |x - x_i| - r_i, see nearestBalls().

#include "molsurf/mesh.h"
#include "molsurf/molecule/selection/select_balls.h"
#include "molsurf/progress.h"
#include "molsurf/show/color/color_map.h"

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

/// The voxels of the band of a level set.
/// @param[in] inside  whether all of the inside is among them, as fog needs it
openvdb::BoolGrid::Ptr shownVoxels(const openvdb::FloatGrid& surface, bool inside);

/// The ball of each active voxel, in the order of the tree.
/// @param[in] reach  farthest that a point of the band may lie from the balls [Å]
Labels ownersOf(const openvdb::BoolGrid& voxels, const std::vector<Ball>& balls, double reach,
                const Progress& progress);

/// The atom of each ball.
Labels atomsOf(const std::vector<Ball>& balls);

/// The label of the ball that each point belongs to; -1 without one.
Labels labelsOf(const Labels& nearest, const Labels& labelOf);

/// The colour of the ball of each point, neutral without one.
std::vector<Color> colorsOf(const Labels& nearest, const std::vector<Color>& ballColor);

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
