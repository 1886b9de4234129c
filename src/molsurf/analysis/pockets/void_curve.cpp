// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/pockets/void_curve.h"

#include "molsurf/kernel/core/orthonormal_basis.h"

#include <algorithm>

namespace molsurf
{

namespace
{

using openvdb::Vec3d;

constexpr double noRoot = std::numeric_limits<double>::quiet_NaN();

/// Centres so near to a line are on it, as two so near are one [Å]: more than they are moved by.
constexpr double flat = 1e-5;

/// The roots of p x^2 + 2 q x + s = 0, of which root is sqrt(q^2 - p s), without loss of digits.
std::array<double, 2> rootsBy(double p, double q, double s, double root)
{
    const double t = -(q + std::copysign(root, q));
    return {p != 0.0 ? t / p : noRoot, t != 0.0 ? s / t : noRoot};
}

} // namespace

std::optional<VoidCurve> VoidCurve::ofThree(const Ball& a, const Ball& b, const Ball& c)
{
    Vec3d e1 = b.center - a.center;
    const double bx = e1.length();
    if (!(bx > flat)) return {};
    e1 /= bx;
    const Vec3d toC = c.center - a.center;
    const double cx = toC.dot(e1);
    Vec3d e2 = toC - e1 * cx;
    const double cy = e2.length();
    if (!(cy > flat)) return {};
    e2 /= cy;
    // |x - a|^2 - |x - b|^2 = (r_a + d)^2 - (r_b + d)^2, and the same of c.
    const double u1 = (a.radius - b.radius) / bx;
    const double u0 = (bx * bx + (a.radius - b.radius) * (a.radius + b.radius)) / (2.0 * bx);
    const double v1 = (a.radius - c.radius - cx * u1) / cy;
    const double v0 =
        (cx * cx + cy * cy + (a.radius - c.radius) * (a.radius + c.radius) - 2.0 * cx * u0) /
        (2.0 * cy);
    VoidCurve out;
    out.origin_ = a.center;
    out.radius_ = a.radius;
    out.fixed_ = e1 * u0 + e2 * v0;
    out.grow_ = e1 * u1 + e2 * v1;
    out.normal_ = e1.cross(e2);
    out.square_ = 1.0 - u1 * u1 - v1 * v1;
    out.linear_ = a.radius - u0 * u1 - v0 * v1;
    out.constant_ = a.radius * a.radius - u0 * u0 - v0 * v0;
    out.findEnds();
    return std::isfinite(out.bottom_) ? std::optional(out) : std::nullopt;
}

std::optional<VoidCurve> VoidCurve::ofTwo(const Ball& a, const Ball& b, const Vec3d& x)
{
    Vec3d e1 = b.center - a.center;
    const double bx = e1.length();
    if (!(bx > flat)) return {};
    e1 /= bx;
    const double u1 = (a.radius - b.radius) / bx;
    const double u0 = (bx * bx + (a.radius - b.radius) * (a.radius + b.radius)) / (2.0 * bx);
    VoidCurve out;
    out.origin_ = a.center;
    out.radius_ = a.radius;
    out.fixed_ = e1 * u0;
    out.grow_ = e1 * u1;
    out.normal_ = x - a.center;
    out.normal_ -= e1 * out.normal_.dot(e1);
    if (!out.normal_.normalize(flat)) out.normal_ = perpendicular(e1)[0];
    out.square_ = 1.0 - u1 * u1;
    out.linear_ = a.radius - u0 * u1;
    out.constant_ = a.radius * a.radius - u0 * u0;
    out.findEnds();
    return std::isfinite(out.bottom_) ? std::optional(out) : std::nullopt;
}

std::optional<VoidCurve> VoidCurve::ofOne(const Ball& a, const Vec3d& x)
{
    VoidCurve out;
    out.origin_ = a.center;
    out.radius_ = a.radius;
    out.grow_ = x - a.center;
    if (!out.grow_.normalize(flat)) out.grow_ = Vec3d(1.0, 0.0, 0.0);
    out.fixed_ = out.grow_ * a.radius;
    out.bottom_ = -a.radius;
    return out;
}

void VoidCurve::findEnds()
{
    const double inside = linear_ * linear_ - square_ * constant_;
    if (!(inside >= 0.0)) {
        bottom_ = noRoot;
        return;
    }
    auto [low, high] = rootsBy(square_, linear_, constant_, std::sqrt(inside));
    if (!(low <= high)) std::swap(low, high);
    if (square_ > 0.0) {
        bottom_ = std::isfinite(high) ? high : low;
    } else if (square_ < 0.0) {
        bottom_ = low;
        top_ = high;
    } else {
        bottom_ = linear_ > 0.0 ? -constant_ / (2.0 * linear_) : noRoot;
    }
}

std::array<double, 2> VoidCurve::roots(const Seen& ball) const
{
    const double h2 = ball.height * ball.height, k = ball.constant, s = ball.slope;
    // The discriminant is height^2 inside: without height both halves touch at one d.
    const double inside = h2 * (linear_ * linear_ - square_ * constant_) - 2.0 * k * s * linear_ +
                          square_ * k * k + constant_ * s * s;
    if (!(inside >= 0.0)) return {noRoot, noRoot};
    return rootsBy(s * s - h2 * square_, k * s - h2 * linear_, k * k - h2 * constant_,
                   std::abs(ball.height) * std::sqrt(inside));
}

} // namespace molsurf
