// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Random rigid motions.

#include <openvdb/Types.h>

#include <random>

namespace molsurf::test
{

struct Motion {
    openvdb::Mat3d turn;
    openvdb::Vec3d shift;
    openvdb::Vec3f operator()(const openvdb::Vec3d& x) const
    {
        return openvdb::Vec3f(turn * x + shift);
    }
};

inline Motion randomMotion(std::mt19937& random)
{
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> place(-3.0, 3.0);
    openvdb::Vec3d a{normal(random), normal(random), normal(random)};
    openvdb::Vec3d b{normal(random), normal(random), normal(random)};
    a.normalize();
    b -= b.dot(a) * a;
    b.normalize();
    return {openvdb::Mat3d(a, b, a.cross(b)), {place(random), place(random), place(random)}};
}

} // namespace molsurf::test
