// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The closest point of the zero set of a smooth function, by the function and its derivatives.
/// Lengths are in voxels; the function has a slope of some 0.1 to 10 at its zero.

#include "molsurf/kernel/spline/spline.h"

#include <openvdb/Types.h>

#include <cmath>
#include <optional>

namespace molsurf
{

/// Newton's method along the gradient: moves a point onto the zero set.
/// @param[in]     jetAt  the function: a Jet at a point
/// @param[in,out] y      the start; then the point, or the last iterate
/// @param[out]    jet    at the point
/// @return whether |value| < tolerance after 6 steps at most; false where the slope is below 0.1
template<typename JetAt>
bool project(const JetAt& jetAt, openvdb::Vec3d& y, Jet& jet)
{
    constexpr double tolerance = 1e-5, leastSlope2 = 0.01, longest = 0.5; // a step [voxel]
    for (int i = 0; i < 6; ++i) {
        jet = jetAt(y);
        const double slope2 = jet.gradient.lengthSqr();
        if (slope2 < leastSlope2) return false;
        if (std::abs(jet.value) < tolerance) return true;
        const double fall = jet.value / slope2, length = std::abs(jet.value) / std::sqrt(slope2);
        y -= (length > longest ? fall * longest / length : fall) * jet.gradient;
    }
    return false;
}

/// The point of the zero set that is closest to x: Newton's method along the surface, or gradient
/// descent where the squared distance is not convex, with a line search until the point is nearer.
/// With y the point, n the normal, s = n.(x - y) and t = x - y - s n, the Newton step d along the
/// surface solves (I + s A) d = t, A being the Hessian over the slope; descent takes d = t.
/// @param[in] start  where project() begins; the point stays within `farthest` of it
/// @param[in] steps  that may be made
/// @return nothing if project() fails from the start; never farther from x than its point
template<typename JetAt>
std::optional<openvdb::Vec3d> closestFoot(const JetAt& jetAt, const openvdb::Vec3d& x,
                                          const openvdb::Vec3d& start, int steps = 20)
{
    using openvdb::Vec3d;
    constexpr double close = 3e-3;                  // the search ends at this |t| [voxel]
    constexpr double longest = 0.7, farthest = 3.0; // a step; from the start [voxel]
    constexpr int halvings = 6; // trials of a step, each 0.4 times as long as the last
    Vec3d y = start;
    Jet jet;
    if (!project(jetAt, y, jet)) return {};
    double least2 = (x - y).lengthSqr();
    for (int i = 0; i < steps; ++i) {
        const double slope = jet.gradient.length();
        const Vec3d n = jet.gradient / slope, offset = x - y;
        const double s = n.dot(offset);
        const Vec3d t = offset - s * n;
        if (t.lengthSqr() < close * close) break;
        Vec3d u =
            std::abs(n.x()) < 0.6 ? n.cross(Vec3d(1.0, 0.0, 0.0)) : n.cross(Vec3d(0.0, 1.0, 0.0));
        u.normalize();
        const Vec3d w = n.cross(u), Hu = jet.hessian * u, Hw = jet.hessian * w;
        const double k = s / slope; // I + s A is (a b; b c) in the basis u, w
        const double a = 1.0 + k * u.dot(Hu), b = k * u.dot(Hw), c = 1.0 + k * w.dot(Hw);
        const double det = a * c - b * b, tu = t.dot(u), tw = t.dot(w);
        Vec3d d =
            a + c > 0.0 && det > 0.01 ? ((c * tu - b * tw) * u + (a * tw - b * tu) * w) / det : t;
        const double length = d.length();
        if (length > longest) d *= longest / length;
        bool nearer = false;
        for (int halving = 0; halving < halvings && !nearer; ++halving, d *= 0.4) {
            Vec3d next = y + d;
            Jet there;
            if ((next - start).lengthSqr() > farthest * farthest) continue;
            if (!project(jetAt, next, there)) continue;
            const double r2 = (x - next).lengthSqr();
            if (r2 >= least2) continue;
            nearer = true;
            least2 = r2;
            y = next;
            jet = there;
        }
        if (!nearer) break;
    }
    return y;
}

} // namespace molsurf
