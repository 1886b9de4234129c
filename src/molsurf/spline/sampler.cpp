// SPDX-License-Identifier: MPL-2.0
#include "molsurf/spline/spline.h"

#include "molsurf/core/simd.h"

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

/// The four cubic B-splines that overlap a cell, at t, and their derivatives.
struct Weights {
    Floats4 value, first, second;
};

MOLSURF_INLINE Weights weightsAt(float t)
{
    constexpr float sixth = 1.0f / 6.0f;
    const Floats4 a = {-sixth, 0.5f, -0.5f, sixth}, b = {0.5f, -1.0f, 0.5f, 0.0f};
    const Floats4 c = {-0.5f, 0.0f, 0.5f, 0.0f}, d = {sixth, 4.0f * sixth, sixth, 0.0f};
    return {((a * t + b) * t + c) * t + d, (3.0f * a * t + 2.0f * b) * t + c,
            6.0f * a * t + 2.0f * b};
}

/// The sums of the elements of four vectors: of a transposed matrix.
MOLSURF_INLINE Floats4 sums(Floats4 a, Floats4 b, Floats4 c, Floats4 d)
{
    const Floats4 x =
        __builtin_shufflevector(a, b, 0, 4, 1, 5) + __builtin_shufflevector(a, b, 2, 6, 3, 7);
    const Floats4 y =
        __builtin_shufflevector(c, d, 0, 4, 1, 5) + __builtin_shufflevector(c, d, 2, 6, 3, 7);
    return __builtin_shufflevector(x, y, 0, 1, 4, 5) + __builtin_shufflevector(x, y, 2, 3, 6, 7);
}

/// @param[out] out  value, derivatives along x, y, z, xx, yy, zz, xy, xz, yz
MOLSURF_KERNEL void evaluate(const float* c, int strideX, int strideY, const float* t,
                             float* __restrict out)
{
    const Weights x = weightsAt(t[0]), y = weightsAt(t[1]), z = weightsAt(t[2]);
    // Contracted along x, then y, four z at a time; `sab` is the derivative of order a along x, b
    // along y.
    Floats4 s00{}, s01{}, s02{}, s10{}, s11{}, s20{};
    for (int j = 0; j < 4; ++j) {
        const float* row = c - strideX + (j - 1) * strideY - 1;
        Floats4 p{}, q{}, r{};
        for (int i = 0; i < 4; ++i) {
            const Floats4 v = load4(row + i * strideX);
            p += x.value[i] * v;
            q += x.first[i] * v;
            r += x.second[i] * v;
        }
        s00 += y.value[j] * p;
        s01 += y.first[j] * p;
        s02 += y.second[j] * p;
        s10 += y.value[j] * q;
        s11 += y.first[j] * q;
        s20 += y.value[j] * r;
    }
    const Floats4 first = sums(s00 * z.value, s10 * z.value, s01 * z.value, s00 * z.first);
    const Floats4 second = sums(s20 * z.value, s02 * z.value, s00 * z.second, s11 * z.value);
    const Floats4 mixed = sums(s10 * z.first, s01 * z.first, Floats4{}, Floats4{});
    store4(out, first);
    store4(out + 4, second);
    std::memcpy(out + 8, &mixed, 2 * sizeof(float));
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
