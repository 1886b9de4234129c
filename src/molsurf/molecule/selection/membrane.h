// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The membrane of a structure.

#include "molsurf/molecule/structure/structure.h"

#include <optional>

namespace molsurf
{

/// The normal of the membrane, a unit vector: from the side N to the side O of the dummy atoms of
/// OPM and PPM (residues DUM), which are its two planes, or the direction along which lipids lie,
/// with z above 0. Nothing: the model has no membrane, or lipids that lie in all directions, as in
/// a micelle.
std::optional<openvdb::Vec3d> membraneNormal(const Structure& structure, const Model& model);

} // namespace molsurf
