// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The charges of the atoms that a surface is of, those without a radius too.

#include "molsurf/molecule/structure/structure.h"

#include <openvdb/Types.h>

#include <cstdint>
#include <string>
#include <vector>

namespace molsurf
{

/// An atom with a charge.
struct PointCharge {
    openvdb::Vec3d position; ///< [Å]
    double charge;           ///< [e]
    double radius;           ///< [Å], >= 0
    std::string atom, residue, chain;
    int number; ///< of the residue
};

/// Charged atoms in the order of their file.
struct PointCharges {
    std::vector<PointCharge> atoms;

    /// Gives the box of all atoms [Å].
    /// @param[in] withRadii  whether it is that of their balls, or of their centres
    openvdb::BBoxd box(bool withRadii) const;
};

/// Lists the charges of some atoms.
/// @param[in] atoms  their indices
/// @throws Error(ErrorKind::Input) if the structure has no charges, or no radii
PointCharges pointCharges(const Structure& structure, const std::vector<std::int32_t>& atoms);

} // namespace molsurf
