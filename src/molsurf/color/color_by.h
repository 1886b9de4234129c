// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The meanings that the colours of a surface can have.

namespace molsurf
{

/// What the colours of the surface tell.
enum class ColorBy { Nothing, Chain, Group, Element, Residue, MeanCurvature, GaussianCurvature };

/// The word of a user for it: none, chain, group, element, residue, mean-curvature,
/// gaussian-curvature.
const char* nameOf(ColorBy color);

} // namespace molsurf
