// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The rotation axes of a biological assembly, found from its operators.

#include "molsurf/molecule/structure/structure.h"

#include <openvdb/math/Mat3.h>
#include <openvdb/Types.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace molsurf
{

/// A rotation axis: a line through Symmetry::centre.
struct RotationAxis {
    int fold;                 ///< order of the rotations about it, >= 2
    openvdb::Vec3d direction; ///< unit vector, its last component that is not zero positive
    /// Rotation k of the fold - 1 rotations moves copy i to the place of copy images[k][i].
    std::vector<std::vector<std::size_t>> images;
};

/// All copies follow from the first by screws about one line.
struct Helix {
    openvdb::Vec3d direction; ///< unit vector
    double rise;              ///< along the axis, from one copy to the next along it [Å], > 0
    double twist;             ///< about the axis, right-handed [rad], in (-pi, pi]
};

/// The symmetry of an assembly: its point group, its rotation axes and, if it is helical, its
/// screw.
struct Symmetry {
    std::string pointGroup;         ///< Schoenflies: "C1", "C5", "D3", "T", "O", "I"; "" if other
    std::size_t order = 1;          ///< number of rotations, the identity counted
    openvdb::Vec3d centre;          ///< all axes pass through it [Å]
    std::vector<RotationAxis> axes; ///< in descending order of the fold
    std::optional<Helix> helix;     ///< if it is helical; it may have axes all the same
};

/// The operators of an assembly, part by part. Copy i of the assembly, counted from 0, is made by
/// the i-th of them.
std::vector<Operator> operatorsOf(const Assembly& assembly);

/// The index in Assembly::parts of every copy.
std::vector<std::size_t> partsOfCopies(const Assembly& assembly);

/// Why an operator is no rotation with a translation, by name: "operator 7: expected a rotation,
/// got a reflection (determinant -1)"; empty if it is one, but for 1 % in every component.
std::string rotationProblem(const Operator& op);

/// The rotation that is nearest to a matrix, which must be near one.
openvdb::Mat3d nearestRotation(openvdb::Mat3d m);

/// Finds the rotations that take the copies of an assembly onto each other.
///
/// A rotation counts if it takes the operators of every part onto themselves, so that a part of a
/// shell has the axes of that part only, and an assembly of several copies an asymmetric unit those
/// of the whole. The operators may stand in any order, in any frame, more than once, and be
/// rounded: rotations are told apart by 1 degree, positions by 0.3 Å and 0.4 % of the extent.
///
/// @param[in] reference  a point of the molecule in the coordinates of the file [Å]: copies are
///                       told apart by where they have it
/// @throws Error(ErrorKind::Input) naming the operator, if one is no proper rotation
Symmetry findSymmetry(const Assembly& assembly, const openvdb::Vec3d& reference);

} // namespace molsurf
