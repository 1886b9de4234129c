// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The part that balls cover of the circle in which two spheres meet.

#include "molsurf/kernel/balls/ball_caps.h"

#include <vector>

namespace molsurf
{

/// Thrown where not even quadruple precision decides how balls cover a circle.
struct SpecialPosition {
};

/// The circle at the rim of a cap, of a sphere of radius 1: the points cosine axis + sine (x e1 + y
/// e2) with x^2 + y^2 = 1.
struct Circle {
    openvdb::Vec3d axis, e1, e2; ///< right-handed, orthonormal
    double cosine, sine;
};

/// A part of a circle that is not covered, from one direction (x, y) about the axis to another one.
struct Gap {
    double beginX, beginY, endX, endY;
    int before, after; ///< places of the caps that cover the circle before and after it; -1: the
                       ///< whole circle
};

/// The parts of a circle that caps cover, as arrays. A cap covers the directions a with x cos a + y
/// sin a > cosine, (x, y) being a unit vector: nothing for a cosine of 1 and more, all for one of
/// -1 and less.
struct CircleCovers {
    std::vector<double> x, y, cosine;
    std::vector<double> error; ///< of the cosine and the direction, at most

    /// Makes room, and gives no memory back.
    void resize(std::size_t count);
};

/// The arcs that caps cover of a circle, as floats: the points x e1 + y e2 with u x + v y + base >
/// 0. Eight can be read at any place.
struct RoundedCovers {
    std::vector<float> base, u, v;
    std::vector<float> sine, holds, held; ///< used by findGaps()

    void resize(std::size_t count);
};

/// Some of the caps of a sphere.
struct CapColumns {
    std::vector<double> x, y, z, cosine;

    void take(const CapArrays& caps, const std::vector<std::int32_t>& places);
};

/// The part of a circle that a cap covers, between two directions.
template<typename Real>
struct Cover {
    Real beginX, beginY, endX, endY;
    int cap;
};

/// Room for one circle, kept from circle to circle by a thread.
struct CircleScratch {
    RoundedCovers rounded;
    std::vector<std::int32_t> kept; // places of caps
    CapColumns caps;
    CircleCovers circleCovers;
    std::vector<Cover<double>> covers;
};

/// The gaps of the circle at the rim of a cap, in their order about its axis.
/// @param[in]  i       the ball of the sphere
/// @param[in]  caps    of the sphere
/// @param[in]  own     place of the cap among these
/// @param[out] circle  if there are gaps
/// @throws SpecialPosition
void findGaps(const std::vector<PlacedBall>& balls, std::int32_t i, const CapArrays& caps, int own,
              CircleScratch& scratch, Circle& circle, std::vector<Gap>& gaps);

} // namespace molsurf
