// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/levelset/foot_points.h"

#include "molsurf/kernel/core/simd.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

namespace
{

using Lanes = FootPoints::Lanes;

/// The vector from a foot to its voxel, along the normal (s) and aside (t), and A t.
struct Offset {
    float s, t[3], At[3];
};

inline __attribute__((always_inline)) Offset offsetOf(const FootPoints& f, const Lanes* x, int l)
{
    const float d[3] = {x[0][l] - f.y[0][l], x[1][l] - f.y[1][l], x[2][l] - f.y[2][l]};
    Offset o;
    o.s = f.n[0][l] * d[0] + f.n[1][l] * d[1] + f.n[2][l] * d[2];
    for (int a = 0; a < 3; ++a) o.t[a] = d[a] - o.s * f.n[a][l];
    o.At[0] = f.A[0][l] * o.t[0] + f.A[3][l] * o.t[1] + f.A[5][l] * o.t[2];
    o.At[1] = f.A[3][l] * o.t[0] + f.A[1][l] * o.t[1] + f.A[4][l] * o.t[2];
    o.At[2] = f.A[5][l] * o.t[0] + f.A[4][l] * o.t[1] + f.A[2][l] * o.t[2];
    return o;
}

/// Component a of the step along the surface, (I + s A)^-1 t. On the tangent plane the inverse is
/// (I + s (kappa I - A)) / det by Cayley-Hamilton, with det = 1 + s kappa + s^2 K. det is 0 at a
/// centre of curvature; 0.2 at least keeps the step short there.
inline __attribute__((always_inline)) float stepAlong(const FootPoints& f, const Offset& o, int l,
                                                      int a)
{
    const float determinant = larger(1.0f + o.s * (f.kappa[l] + o.s * f.gauss[l]), 0.2f);
    return (o.t[a] + o.s * (f.kappa[l] * o.t[a] - o.At[a])) / determinant;
}

} // namespace

Jet JetLanes::at(int l) const
{
    const auto H = [&](int i) { return double(hessian[i][l]); };
    return {value[l], openvdb::Vec3d(gradient[0][l], gradient[1][l], gradient[2][l]),
            openvdb::Mat3d(H(0), H(3), H(5), H(3), H(1), H(4), H(5), H(4), H(2))};
}

MOLSURF_KERNEL void shapeFrom(const JetLanes& jets, FootPoints& feet, float largest)
{
    const float largest2 = largest * largest;
    for (int l = 0; l < lanes; ++l) {
        const float gx = jets.gradient[0][l], gy = jets.gradient[1][l], gz = jets.gradient[2][l];
        const float scale = 1.0f / larger(std::sqrt(gx * gx + gy * gy + gz * gz), 1e-3f);
        const float nx = gx * scale, ny = gy * scale, nz = gz * scale;
        const float xx = jets.hessian[0][l] * scale, yy = jets.hessian[1][l] * scale,
                    zz = jets.hessian[2][l] * scale, xy = jets.hessian[3][l] * scale,
                    yz = jets.hessian[4][l] * scale, xz = jets.hessian[5][l] * scale;
        const float hx = xx * nx + xy * ny + xz * nz, hy = xy * nx + yy * ny + yz * nz,
                    hz = xz * nx + yz * ny + zz * nz;
        // With P = I - n n^T: A = P H P = H - n m^T - m n^T, m being H n - (n.H n)/2 n.
        const float half = 0.5f * (nx * hx + ny * hy + nz * hz);
        const float mx = hx - half * nx, my = hy - half * ny, mz = hz - half * nz;
        float A[6] = {xx - 2.0f * nx * mx,    yy - 2.0f * ny * my,    zz - 2.0f * nz * mz,
                      xy - nx * my - ny * mx, yz - ny * mz - nz * my, xz - nx * mz - nz * mx};
        const float square = A[0] * A[0] + A[1] * A[1] + A[2] * A[2] + // tr A^2 = kappa^2 - 2 K
                             2.0f * (A[3] * A[3] + A[4] * A[4] + A[5] * A[5]);
        // Scaled to k1^2 + k2^2 <= largest^2.
        const float limit = largest / std::sqrt(larger(square, largest2));
        const float kappa = (A[0] + A[1] + A[2]) * limit;
        for (int i = 0; i < 6; ++i) feet.A[i][l] = A[i] * limit;
        feet.n[0][l] = nx;
        feet.n[1][l] = ny;
        feet.n[2][l] = nz;
        feet.kappa[l] = kappa;
        feet.gauss[l] = 0.5f * (kappa * kappa - smaller(square, largest2));
    }
}

MOLSURF_KERNEL void stepsAlong(const FootPoints& feet, const Lanes* x, Lanes* d)
{
    alignas(64) Lanes out[3]; // written apart, so that the loop vectorises
    for (int l = 0; l < lanes; ++l) {
        const Offset o = offsetOf(feet, x, l);
        out[0][l] = stepAlong(feet, o, l, 0);
        out[1][l] = stepAlong(feet, o, l, 1);
        out[2][l] = stepAlong(feet, o, l, 2);
    }
    std::copy_n(&out[0][0], 3 * lanes, &d[0][0]);
}

MOLSURF_KERNEL void newtonSteps(const JetLanes& jets, const FootPoints& feet, const Lanes* x,
                                Lanes* d)
{
    alignas(64) Lanes out[3]; // written apart, so that the loop vectorises
    for (int l = 0; l < lanes; ++l) {
        const Offset o = offsetOf(feet, x, l);
        const float gx = jets.gradient[0][l], gy = jets.gradient[1][l], gz = jets.gradient[2][l];
        const float fall = jets.value[l] / larger(std::sqrt(gx * gx + gy * gy + gz * gz), 0.2f);
        out[0][l] = stepAlong(feet, o, l, 0) - fall * feet.n[0][l];
        out[1][l] = stepAlong(feet, o, l, 1) - fall * feet.n[1][l];
        out[2][l] = stepAlong(feet, o, l, 2) - fall * feet.n[2][l];
    }
    std::copy_n(&out[0][0], 3 * lanes, &d[0][0]);
}

MOLSURF_KERNEL void distances(const FootPoints& feet, const Lanes* x, const float* sign,
                              float* __restrict d, float* __restrict aside2)
{
    for (int l = 0; l < lanes; ++l) {
        const Offset o = offsetOf(feet, x, l);
        const float s = o.s, gauss = feet.gauss[l];
        const float t2 = o.t[0] * o.t[0] + o.t[1] * o.t[1] + o.t[2] * o.t[2];
        const float tAt = o.t[0] * o.At[0] + o.t[1] * o.At[1] + o.t[2] * o.At[2];
        const float determinant = larger(1.0f + s * (feet.kappa[l] + s * gauss), 0.02f);
        const float expanded = sign[l] * (s + 0.5f * (tAt + s * gauss * t2) / determinant);
        const float r2 = s * s + t2, r = std::sqrt(r2);
        const float least = std::sqrt(larger(r2 - 0.76f * (1.0f + r), 0.0f)); // 0.76 = 0.87^2
        d[l] = smaller(larger(expanded, least), r);
        aside2[l] = t2;
    }
}

} // namespace molsurf
