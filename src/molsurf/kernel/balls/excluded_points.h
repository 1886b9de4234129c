// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Points spread evenly over a solvent-excluded surface.

#include "molsurf/kernel/balls/ball_boundary.h"

#include <openvdb/Types.h>

#include <functional>
#include <map>
#include <vector>

namespace molsurf
{

/// A point of a solvent-excluded surface. The probe that touches it has its centre at
/// position + probe normal.
struct ExcludedPoint {
    openvdb::Vec3d position; ///< on the surface [Å]
    openvdb::Vec3d normal;   ///< of the surface, unit, outward
    double area;             ///< that it represents [Å^2]
};

using ExcludedPoints = std::vector<ExcludedPoint>;

/// Spreads points over the faces of solvent-excluded surfaces: by golden spirals over contact and
/// concave faces, by rings over toric ones. The areas add up to that of a surface but for what the
/// borders of faces cut of a point's share. Points that follow each other are near each other, but
/// for the jumps from face to face.
class ExcludedSampler
{
public:
    /// Tells whether a part of a face that lies in a ball of a centre and radius may have points
    /// that are wanted; others are left out.
    using Counts = std::function<bool(const openvdb::Vec3d&, double)>;

    /// @param[in] probe    > 0 [Å]
    /// @param[in] density  of the points [1/Å^2]
    ExcludedSampler(double probe, double density) : probe_(probe), density_(density) {}

    /// Points of one surface, in an order that depends on the boundary alone. One thread at a time.
    /// @param[in] boundary  of the balls of radius r_i + probe
    /// @param[in] counts    empty: all are wanted
    ExcludedPoints of(const BallBoundary& boundary, const Progress& progress,
                      const Counts& counts = {});

    /// Directions that share a sphere evenly.
    struct Spread {
        static constexpr std::size_t run = 32; ///< directions that are neighbours

        std::vector<openvdb::Vec3d> directions;
        std::vector<Ball> runs; ///< about each run of them
    };

private:
    /// The directions for a sphere, kept.
    /// @param[in] radius  [Å]
    const Spread& spreadOver(double radius);

    double probe_, density_;
    std::map<std::size_t, Spread> spreads_; // by their numbers: molecules have few radii
};

} // namespace molsurf
