// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Finds the atoms near some others.

#include "molsurf/molecule/structure/structure.h"

#include <openvdb/Types.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace molsurf
{

/// Where an atom is.
struct AtomSite {
    openvdb::Vec3d position; ///< [Å]
    std::int32_t residue;
    bool isHeavy; ///< whether it is no hydrogen
};

/// For each atom the heavy atom of its residue that is nearest to it, the first of equally near
/// ones; itself, if it is heavy or its residue has none.
/// @param[in] residues  how many there are
std::vector<std::int32_t> heavyAtoms(const std::vector<AtomSite>& atoms, std::size_t residues);

/// Marks the atoms whose centres lie within a distance of the centre of a marked one of the same
/// model, and those too.
/// @param[in] marked    one char an atom
/// @param[in] distance  at least 0 [Å]
/// @throws Error(ErrorKind::Input) if an atom lies farther than 1e6 Å from the origin
std::vector<char> nearAtoms(const Structure& structure, const std::vector<char>& marked,
                            double distance);

} // namespace molsurf
