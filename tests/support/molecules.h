// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The molecules of tests/data as balls, and balls in random places.

#include "molsurf/molecule/selection/select_balls.h"
#include "molsurf/molecule/structure/read_structure.h"

#include <optional>
#include <random>
#include <string>
#include <vector>

namespace molsurf::test
{

inline std::vector<Ball> balls(const std::string& file,
                               const std::optional<std::string>& assembly = {})
{
    SelectOptions options;
    options.assembly.name = assembly;
    return selectBalls(readStructure(std::string(MOLSURF_TEST_DATA) + "/" + file), options).balls;
}

/// Balls of radius 1.2 to 2.0 Å in a cube about a centre.
inline std::vector<Ball> randomBalls(int count, double edge, const openvdb::Vec3d& centre,
                                     unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-0.5 * edge, 0.5 * edge), radius(1.2, 2.0);
    std::vector<Ball> out;
    for (int i = 0; i < count; ++i) {
        const openvdb::Vec3d x{place(random), place(random), place(random)};
        out.push_back({openvdb::Vec3f(centre + x), float(radius(random)), i});
    }
    return out;
}

} // namespace molsurf::test
