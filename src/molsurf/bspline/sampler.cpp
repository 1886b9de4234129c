// SPDX-License-Identifier: MPL-2.0
#include "molsurf/bspline/spline.h"

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
    float value[4], first[4], second[4];

    explicit Weights(double td)
    {
        const float t = float(td), s = 1.0f - t;
        value[0] = s * s * s / 6.0f;
        value[1] = (4.0f + t * t * (3.0f * t - 6.0f)) / 6.0f;
        value[2] = (4.0f + s * s * (3.0f * s - 6.0f)) / 6.0f;
        value[3] = t * t * t / 6.0f;
        first[0] = -0.5f * s * s;
        first[1] = t * (1.5f * t - 2.0f);
        first[2] = -s * (1.5f * s - 2.0f);
        first[3] = 0.5f * t * t;
        second[0] = s;
        second[1] = 3.0f * t - 2.0f;
        second[2] = 3.0f * s - 2.0f;
        second[3] = t;
    }
};

/// Four floats that are added and multiplied at once (a compiler extension of GCC and Clang).
using Four = float __attribute__((vector_size(16)));

Four load(const float* p)
{
    Four v;
    std::memcpy(&v, p, sizeof v);
    return v;
}

double sum(const Four& v)
{
    return double((v[0] + v[1]) + (v[2] + v[3]));
}

} // namespace

Jet evaluateSpline(const float* c, int strideX, int strideY, const Vec3d& t)
{
    const Weights x(t.x()), y(t.y()), z(t.z());
    // Contracted along x, then y, four z at a time; `ab` is the derivative of order a along x, b
    // along y.
    Four s00{}, s01{}, s02{}, s10{}, s11{}, s20{};
    for (int j = 0; j < 4; ++j) {
        const float* row = c - strideX + (j - 1) * strideY - 1;
        Four p{}, q{}, r{};
        for (int i = 0; i < 4; ++i) {
            const Four v = load(row + i * strideX);
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
    const Four value = load(z.value), first = load(z.first), second = load(z.second);
    Jet jet;
    jet.value = sum(s00 * value);
    jet.gradient = Vec3d(sum(s10 * value), sum(s01 * value), sum(s00 * first));
    const double xx = sum(s20 * value), yy = sum(s02 * value), zz = sum(s00 * second);
    const double xy = sum(s11 * value), xz = sum(s10 * first), yz = sum(s01 * first);
    jet.hessian = Mat3d(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    return jet;
}

void SplineSampler::locate(const Vec3d& x, Coord& local, Vec3d& t)
{
    const Vec3d index = x / spline_.voxel;
    const Coord cell = Coord::floor(index);
    t = index - cell.asVec3d();
    const Coord origin = cell & ~(leafDim - 1);
    if (origin != origin_) {
        const std::int32_t n = spline_.table.find(cell);
        if (n == noLeaf) {
            std::fill_n(block_.values, block_.dim * block_.dim * block_.dim, 0.0f);
        } else {
            block_.gather(spline_.table, spline_.coefficients, n);
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
    jet.gradient /= spline_.voxel;
    jet.hessian *= 1.0 / (spline_.voxel * spline_.voxel);
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
