// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Meshes whose colours meet along exact lines.

#include "molsurf/atoms.h"
#include "molsurf/ball.h"
#include "molsurf/kernel/balls/power_owners.h"
#include "molsurf/mesh.h"
#include "molsurf/options.h"
#include "molsurf/progress.h"
#include "molsurf/show/color/color_map.h"

#include <memory>
#include <string>
#include <vector>

namespace molsurf
{

/// The colours of balls, and who has which part of space: a point has the colour of the ball whose
/// power distance |x - c|^2 - r^2 to it is the least.
struct ColorOwners {
    std::vector<Color> colors; ///< of the owners, all different
    PowerOwners owners;
};

/// @param[in] balls      that the surface is of
/// @param[in] ballColor  one a ball
ColorOwners colorOwners(const std::vector<Ball>& balls, const std::vector<Color>& ballColor);

/// The owners of colours that meet along exact lines, or null: these run smoothly, are of vertices,
/// or are those of parts.
/// @param[in] balls  of the atoms, where they lie to the mesh, as large as its surface has them
std::shared_ptr<const ColorOwners> bordersOf(ColorBy color, const BallSet& atoms,
                                             const std::vector<Ball>& balls, const Mesh& mesh,
                                             const Progress& progress);

/// Cuts triangles along the borders between colours, so that each triangle has one. The border of
/// two balls is the circle in which their spheres meet.
///
/// New vertices lie on the cubic arcs that the normals imply (see measure()); there is one for each
/// colour, with the labels of its side and means of the scalars. The vertices of the mesh keep
/// their indices and come first.
///
/// @param[in] mesh       with normals and without parts, near the balls (within 30 Å)
/// @param[in] owners     of the balls that it is the surface of
/// @param[in] crease     of a union of balls, how far its mesh may lie off the circle where two
///                       spheres meet [Å]; 0 for other surfaces
/// @param[in] stepwise   name of a scalar that belongs to a side, as labels do; empty: none
Mesh withCrispBorders(const Mesh& mesh, const ColorOwners& owners, double crease,
                      const std::string& stepwise, const Progress& progress);

} // namespace molsurf
