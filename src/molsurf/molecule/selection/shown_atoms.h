// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Atoms of a molecule that pictures show, name or measure beside its surface.

#include "molsurf/atoms.h"

#include <string>

namespace molsurf
{

/// The options of atoms beside a surface: ligands and ions are among them; model, copies and
/// alternate locations are the surface's.
inline SelectOptions besideSurface(const SelectOptions& surface, const std::string& select)
{
    SelectOptions options;
    options.select = select;
    options.model = surface.model;
    options.assembly.name = surface.assembly.name;
    options.assembly.copies = surface.assembly.copies;
    options.altloc = surface.altloc;
    options.hydrogens = surface.hydrogens;
    options.waters = surface.waters;
    options.radii = surface.radii;
    options.limits.maxInput = surface.limits.maxInput;
    options.hetero = Hetero::All;
    options.ions = true;
    return options;
}

/// The options of the copies of an assembly that a surface leaves out: each distinct one once.
/// @param[in] select  empty: their atoms are chosen as the surface's
inline SelectOptions ofOtherCopies(const SelectOptions& surface, const std::string& select)
{
    SelectOptions options = select.empty() ? surface : besideSurface(surface, select);
    options.assembly.copies.others = true;
    options.assembly.instances = true;
    return options;
}

/// The mean of the centres [Å].
inline openvdb::Vec3d middleOf(const BallSet& atoms)
{
    openvdb::Vec3d sum(0.0);
    for (const Ball& ball : atoms.balls) sum += ball.center;
    return sum / double(atoms.balls.size());
}

} // namespace molsurf
