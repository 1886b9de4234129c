// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Rings of atoms with a thin wall in the middle.

#include <openvdb/Types.h>

#include <cmath>
#include <vector>

namespace molsurf::test
{

constexpr double ringProbe = 1.4, ringRadius = 1.7, ringRim = ringRadius + ringProbe; // [Å]
constexpr double ringRate = M_LN2 / (0.5 * ringRim); // of the default tolerance [1/Å^2]

/// Centres of atoms about the origin, in the middle of which psi = 0 lies `depth` above and below.
inline std::vector<openvdb::Vec3d> ring(int atoms, double depth)
{
    const double around =
        std::sqrt(ringRim * ringRim - depth * depth + std::log(double(atoms)) / ringRate);
    std::vector<openvdb::Vec3d> out;
    for (int i = 0; i < atoms; ++i) {
        const double angle = 2.0 * M_PI * i / atoms;
        out.emplace_back(around * std::cos(angle), around * std::sin(angle), 0.0);
    }
    return out;
}

} // namespace molsurf::test
