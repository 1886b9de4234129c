// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The files of simulations: .gro of GROMACS and .psf of CHARMM, X-PLOR and NAMD.

#include "molsurf/structure/structure.h"

#include <string>

namespace molsurf
{

/// Reads a .gro file: title, number of atoms, atoms in nanometres, box; further frames are models.
/// The columns of coordinates are as wide as the distance of their decimal points says, velocities
/// are passed over. Names tell the elements.
/// @throws Error(ErrorKind::Input) with the line, if it is not as described
Structure readGro(const std::string& text, const std::string& path);

/// Reads the atoms of a .psf file, whose places are to come from elsewhere (Structure::placed is
/// false). Segments are the chains, masses and names tell the elements.
/// @throws Error(ErrorKind::Input) with the line, if it is not as described
Structure readPsf(const std::string& text, const std::string& path);

} // namespace molsurf
