// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The colours of pores.

#include "molsurf/show/color/color_map.h"

#include <array>

namespace molsurf
{

/// Room for water in a pore, as pictures of HOLE show it: radii below the first have none, below
/// the second one molecule, others more [Å].
constexpr std::array<double, 2> poreSteps = {1.15, 2.3};

/// The colour of a radius by poreSteps.
inline Color poreColor(double radius)
{
    if (radius < poreSteps[0]) return {214, 69, 65};
    return radius < poreSteps[1] ? Color{86, 170, 96} : Color{66, 110, 200};
}

} // namespace molsurf
