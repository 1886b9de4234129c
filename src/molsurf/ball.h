// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Balls, all that the kernel knows of a molecule, and rigid motions.

#include <openvdb/Types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace molsurf
{

/// A ball that stands for an atom, or for a bead of several atoms.
struct Ball {
    openvdb::Vec3d center; ///< position of the centre [Å]
    double radius;         ///< van der Waals radius [Å], > 0
    std::int32_t atom;     ///< index of the atom in the structure it came from
};

/// The fall-off of a ball's Gaussian, whose term in the sum is
/// exp(level - rate (|x - x_i|^2 - R_i^2)) with the ball's centre x_i and R_i, its radius plus that
/// of the probe. docs/math.md, section 2.
struct Decay {
    float rate = 0.0f;  ///< C [1/Å^2], >= 0; 0: the rate that the options of the run give
    float level = 0.0f; ///< no unit; above 0 swells the ball, below 0 shrinks it
};

/// The balls of a molecule: all that the kernel knows of it.
struct BallModel {
    std::vector<Ball> balls;
    std::vector<Decay> decays; ///< one a ball; empty: the options give one for all
};

/// A motion x -> rotation x + translation [Å].
struct Motion {
    std::array<std::array<double, 3>, 3> rotation; ///< rows
    openvdb::Vec3d translation;                    ///< [Å]

    static Motion identity() { return {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, openvdb::Vec3d(0.0)}; }

    /// Returns rotation x, for directions.
    openvdb::Vec3d turned(const openvdb::Vec3d& x) const
    {
        const auto& r = rotation;
        return {r[0][0] * x[0] + r[0][1] * x[1] + r[0][2] * x[2],
                r[1][0] * x[0] + r[1][1] * x[1] + r[1][2] * x[2],
                r[2][0] * x[0] + r[2][1] * x[1] + r[2][2] * x[2]};
    }

    /// Returns the place that x goes to.
    openvdb::Vec3d placed(const openvdb::Vec3d& x) const { return turned(x) + translation; }

    /// Returns the place that goes to x, if `rotation` is a rotation.
    openvdb::Vec3d broughtBack(const openvdb::Vec3d& x) const
    {
        const openvdb::Vec3d d = x - translation;
        const auto& r = rotation;
        return {r[0][0] * d[0] + r[1][0] * d[1] + r[2][0] * d[2],
                r[0][1] * d[0] + r[1][1] * d[1] + r[2][1] * d[2],
                r[0][2] * d[0] + r[1][2] * d[1] + r[2][2] * d[2]};
    }

    /// Returns the motion that makes `first`, then this one.
    Motion after(const Motion& first) const
    {
        Motion product{{}, placed(first.translation)};
        const auto& b = first.rotation;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto& a = rotation[i];
            for (std::size_t j = 0; j < 3; ++j)
                product.rotation[i][j] = a[0] * b[0][j] + a[1] * b[1][j] + a[2] * b[2][j];
        }
        return product;
    }

    /// Returns the motion back, if `rotation` is a rotation.
    Motion inverse() const
    {
        Motion back{{}, broughtBack(openvdb::Vec3d(0.0))};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) back.rotation[i][j] = rotation[j][i];
        return back;
    }

    /// Returns the rotation as a matrix.
    openvdb::Mat3d matrix() const
    {
        const auto& r = rotation;
        return {r[0][0], r[0][1], r[0][2], r[1][0], r[1][1], r[1][2], r[2][0], r[2][1], r[2][2]};
    }
};

} // namespace molsurf
