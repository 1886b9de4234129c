// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The rotations of a biological assembly as a group.

#include "molsurf/molecule/structure/structure.h"
#include "molsurf/molecule/structure/symmetry.h"

#include <openvdb/Types.h>

#include <cstddef>
#include <vector>

namespace molsurf
{

/// The rotations that take an assembly onto itself, freed of the rounding of its operators: they
/// are a group to the last bits. Indices of motions count from the identity, 0.
struct RotationGroup {
    Symmetry symmetry;
    std::vector<Operator> motions; ///< x -> rotation x + translation [Å]; all keep the centre
    std::vector<std::vector<std::size_t>> images;  ///< motion k moves copy i to copy images[k][i]
    std::vector<std::vector<std::size_t>> product; ///< motion k after motion l is product[k][l]
    std::vector<std::size_t> inverse;              ///< of each motion
    /// The first copy that a motion brings to where each copy is; their number for copies that
    /// stand more than once, after the first.
    std::vector<std::size_t> orbitOf;
    std::vector<std::size_t> motionOf; ///< the motion that brings it there
};

/// Finds the group of an assembly.
/// @param[in] reference  as of findSymmetry()
/// @throws Error(ErrorKind::Input) if an operator is no rotation, if only the identity takes the
///         assembly onto itself, or if the rotations are no group
RotationGroup findRotationGroup(const Assembly& assembly, const openvdb::Vec3d& reference);

} // namespace molsurf
