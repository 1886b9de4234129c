// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The metric w of the energy  E = integral over Gamma of w  and what the flow needs of it, from
/// the field psi at one voxel. With g = 1 - e^psi:  w = g^2 + lambda h,  h = |grad g|^2 or 1.
/// Everything is taken at the foot point x - phi n of the voxel, by the second-order Taylor
/// expansion of psi (docs/math.md, section 4).

#include "molsurf/kernel/core/simd.h"
#include "molsurf/kernel/levelset/stencil.h"

#include <cmath>

namespace molsurf
{

/// lambda, split by regulariser so that one formula serves both.
struct Weights {
    float gradient = 0.0f; ///< lambda of h = |grad g|^2 [Å^2]; 0 for the area regulariser
    float area = 0.0f;     ///< lambda of h = 1; 0 for the gradient regulariser
};

/// w and its derivative along the normal, at a foot point.
struct Metric {
    float w;      ///< no unit
    float normal; ///< n . grad w [1/Å]
    /// Slope of n . grad w over the way to the bottom of the valley: a Newton step by it ends there
    /// from any distance, if psi is linear along the normal [1/Å^2].
    float secant;
    float tangent; ///< derivative of n . grad w in the same valley, in [0, secant] [1/Å^2]
};

/// @param[in] psi      value at the voxel
/// @param[in] d        gradient and Hessian of psi at the voxel
/// @param[in] a,b,c    unit normal of the level set, outward
/// @param[in] phi      distance of the voxel from the interface [Å]
inline __attribute__((always_inline)) Metric metricAtFoot(float psi, const Derivatives& d, float a,
                                                          float b, float c, float phi,
                                                          const Weights& weights)
{
    // Hessian times normal, and psi and its gradient moved by -phi n.
    const float hx = d.xx * a + d.xy * b + d.xz * c;
    const float hy = d.xy * a + d.yy * b + d.yz * c;
    const float hz = d.xz * a + d.yz * b + d.zz * c;
    const float hnn = hx * a + hy * b + hz * c;
    const float foot = psi - phi * (d.x * a + d.y * b + d.z * c) + 0.5f * phi * phi * hnn;
    const float x = d.x - phi * hx, y = d.y - phi * hy, z = d.z - phi * hz;

    const float e = fastExp(smaller(foot, 20.0f)); // e^psi; beyond 20 the step's cap rules anyway
    const float g = 1.0f - e;
    const float slope = x * a + y * b + z * c; // n . grad psi
    const float slope2 = x * x + y * y + z * z;
    const float gradG2 = e * e * slope2;           // |grad g|^2
    const float curved = x * hx + y * hy + z * hz; // grad psi . Hess psi n

    Metric m;
    m.w = g * g + weights.gradient * gradG2 + weights.area;
    // grad g = -e grad psi;  grad |grad g|^2 = 2 e^2 (|grad psi|^2 grad psi + Hess psi grad psi)
    m.normal = -2.0f * g * e * slope + 2.0f * weights.gradient * e * e * (slope2 * slope + curved);
    // The bottom lies where y = (1 + q) e^psi is 1, with q = lambda |grad psi|^2: at ln y = 0.
    const float q1 = 1.0f + weights.gradient * slope2;
    const float t = clamped(smaller(foot, 20.0f) + fastLog(q1), -8.0f, 24.0f);
    const bool far = std::abs(t) > 0.05f;
    const float series = 1.0f + t * (0.5f + t * (1.0f / 6.0f));
    const float ratio = far ? (q1 * e - 1.0f) / (far ? t : 1.0f) : series; // (y - 1)/ln y
    const float valley = 2.0f * slope2 * e;
    m.secant = valley * ratio;
    m.tangent = valley * clamped(2.0f * q1 * e - 1.0f, 0.0f, ratio);
    return m;
}

} // namespace molsurf
