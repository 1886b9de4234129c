// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The atoms' labels on the surface: identities, colours, the groups' parts.

#include "molsurf/options.h"
#include "molsurf/surface.h"

namespace molsurf
{

/// Every point of the surface belongs to the ball whose own surface is nearest to it (the least |x
/// - x_i| - r_i).
///
/// Adds to the mesh the labels atom_id, with labelled balls chain_id and group_id, and the colours
/// that the options ask for; to the fields the grids atom_id, chain_id, group_id and Cd that they
/// ask for; to the report the groups with their areas (in closed form where there is one, else of
/// the triangles, scaled to the area of the smooth surface) and volumes (shares of 1e5 to 1e6
/// points inside). Without a grid only to the report.
///
/// @param[in] known  areas of the balls in closed form [Å^2]; empty: there are none
/// @param[in] reach  farthest that a point of the surface may lie from the balls [Å]
/// @return areas of the balls, those that are known or those of the triangles if the options ask
///         for them; else empty
std::vector<double> labelSurface(const BallSet& atoms, const SurfaceOptions& options,
                                 std::vector<double> known, double reach, Progress& progress,
                                 MolecularSurface& result);

/// The areas of the balls by the triangles of a mesh of all of it, scaled to the area of the smooth
/// surface [Å^2].
/// @param[in] area   of the smooth surface [Å^2]
/// @param[in] reach  as above
std::vector<double> areasOnMesh(const BallSet& atoms, const Mesh& mesh, double area, double reach,
                                const Progress& progress);

/// Does the same for a part of a surface; the report gets the areas of all groups on the mesh, as
/// they are, and at last that of no group.
void labelPart(const BallSet& atoms, const SurfaceOptions& options, double reach,
               Progress& progress, MolecularSurface& result);

} // namespace molsurf
