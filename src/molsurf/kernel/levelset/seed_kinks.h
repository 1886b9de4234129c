// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The kinks of a distance by the closest points of its voxels (kink.h).

#include "molsurf/kernel/levelset/nearest_seeds.h"

#include <vector>

namespace molsurf
{

/// Places where the closest points of neighbours differ.
struct SeedKinks {
    LeafTable kinks; ///< leaves of the domain; active: voxels with a kink between them and the next
                     ///< one along an axis
    std::vector<LeafMask> turns; ///< those between which the normal turns as much, by curvature too
};

SeedKinks kinksOf(const NearestSeeds& near, const Progress& progress);

} // namespace molsurf
