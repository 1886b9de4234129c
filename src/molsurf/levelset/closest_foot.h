// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The closest point of the zero set of a smooth function, by the function and its derivatives.
/// Lengths are in voxels; the function has a slope of some 0.1 to 10 at its zero.

#include "molsurf/spline/spline.h"

#include <openvdb/Types.h>

#include <cmath>
#include <optional>

namespace molsurf
{

/// Moves a point onto the zero set along the gradient.
/// @param[in]  jetAt  the function: a Jet at a point
/// @param[out] jet    there
/// @return whether it got there
template<typename JetAt>
bool project(const JetAt& jetAt, openvdb::Vec3d& y, Jet& jet)
{
    constexpr double tolerance = 1e-5, leastSlope2 = 0.01, longest = 0.5;
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

/// The point of the zero set that is closest to x, sought from a start until it is found: Newton's
/// method along the surface where the squared distance is convex, else descent; each step is
/// shortened until the point is nearer.
/// @param[in] steps  that may be made
/// @return nothing if there is no zero set at the start; never farther from x than the point there
template<typename JetAt>
std::optional<openvdb::Vec3d> closestFoot(const JetAt& jetAt, const openvdb::Vec3d& x,
                                          const openvdb::Vec3d& start, int steps = 20)
{
    using openvdb::Vec3d;
    constexpr double close = 3e-3, longest = 0.7, farthest = 3.0; // [voxel]
    constexpr int halvings = 6;
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
        const double k = s / slope;
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
