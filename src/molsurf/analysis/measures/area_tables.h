// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Columns that files add to the tables of areas.

#include "molsurf/surface.h"

#include <string>
#include <vector>

namespace molsurf
{

/// Rounds the numbers of a table to 13 digits, and adds columns with the origin of its areas:
/// surface, its kind; probe_A; radii, the name of their set or file, or "input".
/// @param[in] probe  radius [Å]
void addOrigin(const BallSet& atoms, const std::string& kind, double probe, Table& table);

/// The area of each ball's residue [Å^2].
std::vector<double> residueAreasOfBalls(const BallSet& atoms, const std::vector<double>& ballAreas);

/// A row for every ball: its names as in atomTable() up to radius_A, and the derivatives of volume
/// and area by the coordinates of its centre: dV_dx_A2, dV_dy_A2, dV_dz_A2, dA_dx_A, dA_dy_A and
/// dA_dz_A.
/// @param[in] mesh  of the surface, where it has no closed form
/// @throws Error(ErrorKind::Usage) if the atoms have no names, or are a unit or copies
/// Of smooth surfaces beside_gap and beside_ridge, too: those of MolecularSurface::Gradients.
/// @throws Error as surfaceGradients()
Table forceTable(const BallSet& atoms, const SurfaceSpec& spec, const Mesh& mesh);

} // namespace molsurf
