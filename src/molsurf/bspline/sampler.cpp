// SPDX-License-Identifier: MPL-2.0
#include "molsurf/bspline/spline.h"

#include <cmath>

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

float dot(const float* a, const float* b)
{
    return (a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3]);
}

} // namespace

Jet evaluateSpline(const float* c, int strideX, int strideY, const Vec3d& t)
{
    const Weights x(t.x()), y(t.y()), z(t.z());
    // Contracted along z, then y, then x; 'abc' is the derivative of order a, b, c along x, y, z.
    float s[4][6]; // 00 01 02 10 11 20 of (y, z)
    for (int i = 0; i < 4; ++i) {
        float p[4], q[4], r[4];
        for (int j = 0; j < 4; ++j) {
            const float* row = c + (i - 1) * strideX + (j - 1) * strideY - 1;
            p[j] = dot(row, z.value);
            q[j] = dot(row, z.first);
            r[j] = dot(row, z.second);
        }
        s[i][0] = dot(p, y.value);
        s[i][1] = dot(q, y.value);
        s[i][2] = dot(r, y.value);
        s[i][3] = dot(p, y.first);
        s[i][4] = dot(q, y.first);
        s[i][5] = dot(p, y.second);
    }
    const auto along = [&](const float* w, int k) {
        return double((w[0] * s[0][k] + w[1] * s[1][k]) + (w[2] * s[2][k] + w[3] * s[3][k]));
    };
    Jet jet;
    jet.value = along(x.value, 0);
    jet.gradient = Vec3d(along(x.first, 0), along(x.value, 3), along(x.value, 1));
    const double xx = along(x.second, 0), yy = along(x.value, 5), zz = along(x.value, 2);
    const double xy = along(x.first, 3), xz = along(x.first, 1), yz = along(x.value, 4);
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

double meanCurvature(const Jet& jet)
{
    const double norm = jet.gradient.length();
    const Vec3d n = jet.gradient / norm;
    const double trace = jet.hessian(0, 0) + jet.hessian(1, 1) + jet.hessian(2, 2);
    return 0.5 * (trace - n.dot(jet.hessian * n)) / norm;
}

double gaussianCurvature(const Jet& jet)
{
    const Vec3d n = jet.gradient.unit();
    const Mat3d& H = jet.hessian;
    const Vec3d x = H.row(0), y = H.row(1), z = H.row(2);
    const Vec3d adjugateTimesN = n.x() * y.cross(z) + n.y() * z.cross(x) + n.z() * x.cross(y);
    return n.dot(adjugateTimesN) / jet.gradient.lengthSqr();
}

} // namespace molsurf
