// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Radii of beads by equal volume.

#include "molsurf/ball.h"
#include "molsurf/progress.h"

#include <cstddef>
#include <vector>

namespace molsurf
{

/// Gives every bead the volume of its atoms: its part of the union of all beads is as large as the
/// parts of its atoms in the union of all atoms, both with the probe radius added to every radius
/// (parts as in powerCells()). So the union of the beads has the volume of that of the atoms. Atoms
/// that stay atoms keep their radii.
///
/// There is one such set of radii if the centres are distinct: it is the partial optimal transport
/// of Lévy, J. Comput. Phys. 451:110838, 2022, with the squared radii as potentials. Found by the
/// damped Newton method of Kitagawa, Mérigot and Thibert, J. Eur. Math. Soc. 21:2603-2651, 2019,
/// to 1e-4 of every volume. Radii are at least 0.1 Å, whatever the volume.
///
/// @param[in]     balls    all atoms
/// @param[in]     members  one list a bead: indices in `balls`; every ball is in one
/// @param[in]     probe    [Å]; 0 keeps the van der Waals volume
/// @param[in,out] beads    centres are set, and radii of atoms; radii of 0 are set here
/// @throws Error(ErrorKind::Numeric) if two beads have one centre
void sizeBeads(const std::vector<Ball>& balls, const std::vector<std::vector<std::size_t>>& members,
               double probe, std::vector<Ball>& beads, const Progress& progress);

} // namespace molsurf
