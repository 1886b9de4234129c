// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/spline/spline.h"

#include "molsurf/kernel/core/simd.h"
#include "molsurf/kernel/spline/spline_lanes.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace molsurf
{

using openvdb::Coord;
using openvdb::Mat3d;
using openvdb::Vec3d;

namespace
{

/// @param[out] out  value, derivatives along x, y, z, xx, yy, zz, xy, xz, yz
MOLSURF_KERNEL void evaluate(const float* c, int strideX, int strideY, const float* t,
                             float* __restrict out)
{
    const SplineJet jet = splineJet(c, strideX, strideY, t);
    store4(out, jet.first);
    store4(out + 4, jet.second);
    std::memcpy(out + 8, &jet.mixed, 2 * sizeof(float));
}

} // namespace

Jet evaluateSpline(const float* c, int strideX, int strideY, const Vec3d& t)
{
    const float place[3] = {float(t.x()), float(t.y()), float(t.z())};
    float d[10];
    evaluate(c, strideX, strideY, place, d);
    Jet jet;
    jet.value = d[0];
    jet.gradient = Vec3d(d[1], d[2], d[3]);
    jet.hessian = Mat3d(d[4], d[7], d[8], d[7], d[5], d[9], d[8], d[9], d[6]);
    return jet;
}

void SplineSampler::locate(const Vec3d& x, Coord& local, Vec3d& t)
{
    const Vec3d index = x / spline_.voxelSize();
    const Coord cell = Coord::floor(index);
    t = index - cell.asVec3d();
    const Coord origin = cell & ~(leafDim - 1);
    if (origin != origin_) {
        const std::int32_t n = spline_.table().find(cell);
        if (n == noLeaf) {
            std::fill_n(block_.values, block_.dim * block_.dim * block_.dim, 0.0f);
        } else {
            block_.gather(spline_.coefficients, n);
        }
        origin_ = origin;
    }
    local = cell - origin;
}

Jet SplineSampler::at(const Vec3d& x)
{
    Coord cell;
    Vec3d t;
    locate(x, cell, t);
    Jet jet =
        evaluateSpline(block_.at(cell.x(), cell.y(), cell.z()), block_.strideX, block_.strideY, t);
    const double h = spline_.voxelSize();
    jet.gradient /= h;
    jet.hessian *= 1.0 / (h * h);
    return jet;
}

bool moveToSurface(SplineSampler& sampler, double h, double reach, Vec3d& x, Jet& jet)
{
    constexpr double tolerance = 1e-5; // |S| [voxel]
    constexpr double leastGradient = 0.05;
    constexpr int steps = 8;
    const Vec3d start = x;
    for (int i = 0; i < steps; ++i) {
        jet = sampler.at(x);
        if (std::abs(jet.value) <= tolerance * h) return true;
        const double slope = jet.gradient.length();
        if (slope < leastGradient) return false;
        const double step = std::clamp(jet.value / slope, -0.5 * reach * h, 0.5 * reach * h);
        x -= step / slope * jet.gradient;
        if ((x - start).lengthSqr() > reach * reach * h * h) return false;
    }
    return false;
}

} // namespace molsurf
