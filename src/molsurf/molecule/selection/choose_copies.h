// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Some of the copies of an assembly: by number, or those about a rotation axis.

#include "molsurf/atoms.h"
#include "molsurf/molecule/structure/structure.h"
#include "molsurf/molecule/structure/symmetry.h"

#include <openvdb/Types.h>

#include <cstddef>
#include <string>
#include <vector>

namespace molsurf
{

/// Reads "1,7,20-25" or "fold:5"; an empty text is all copies.
/// @throws Error(ErrorKind::Usage) if the text is neither
CopyChoice parseCopies(const std::string& text);

/// The text that parseCopies() reads as a choice.
std::string textOf(const CopyChoice& copies);

/// @throws Error(ErrorKind::Usage) if a number is not possible
void checkCopies(const CopyChoice& copies);

/// The n-fold axis that passes nearest to a point; of equally near ones (to 0.01 Å) the first.
/// Null if there is no such axis.
const RotationAxis* nearestAxis(const Symmetry& symmetry, int fold, const openvdb::Vec3d& point);

/// The axes for people: "6 five-fold, 10 three-fold, 15 two-fold axes", "helical,
/// rise 1.41 Å, twist 22.03 degrees", "no rotation axis".
std::string describeSymmetry(const Symmetry& symmetry);

/// Indices of the chosen copies, or with CopyChoice::others of all but these, ascending, each once;
/// copies are counted part by part of the assembly.
///
/// With a fold these are copy 1 and those that the n-fold axis makes of it; of several such axes
/// the one nearest to the molecule of copy 1. If the assembly has further parts (chains with
/// operators of their own) the copy of each that has the operator of copy 1, or else is nearest to
/// it, comes along in the same way.
///
/// @param[in] centroid  of the molecule in the coordinates of the file [Å]
/// @throws Error(ErrorKind::Input) if there is no such copy, or no such axis: it says which there
///         are
std::vector<std::size_t> chooseCopies(const Structure& structure, const Assembly& assembly,
                                      const CopyChoice& choice, const openvdb::Vec3d& centroid);

} // namespace molsurf
