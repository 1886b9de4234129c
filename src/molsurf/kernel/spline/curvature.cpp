// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/spline/curvature.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

using openvdb::Mat3d;
using openvdb::Vec3d;

namespace
{

/// A unit vector perpendicular to another: across the axis that is farthest from it.
Vec3d perpendicularTo(const Vec3d& n)
{
    const double x = std::abs(n.x()), y = std::abs(n.y()), z = std::abs(n.z());
    const Vec3d axis = x <= y && x <= z ? Vec3d(1, 0, 0) : y <= z ? Vec3d(0, 1, 0) : Vec3d(0, 0, 1);
    return n.cross(axis).unit();
}

void put(const Vec3d& v, float* out)
{
    for (int i = 0; i < 3; ++i) out[i] = float(v[i]);
}

} // namespace

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

double Curvature::shapeIndex() const
{
    return 2.0 / M_PI * std::atan2(k1 + k2, k1 - k2); // atan2(0, 0) = 0
}

double Curvature::curvedness() const
{
    return std::sqrt(0.5 * (k1 * k1 + k2 * k2));
}

Curvature curvature(const Jet& jet)
{
    Curvature out;
    const double slope = jet.gradient.length();
    if (!(slope >= leastSlope)) return out;
    const Vec3d n = jet.gradient / slope;
    const Vec3d u = perpendicularTo(n), v = n.cross(u);
    // The shape operator (a b; b c) in the basis u, v.
    const Vec3d Hu = jet.hessian * u / slope, Hv = jet.hessian * v / slope;
    const double a = u.dot(Hu), b = u.dot(Hv), c = v.dot(Hv);
    const double mean = 0.5 * (a + c), d = 0.5 * (a - c), r = std::hypot(d, b);
    out.k1 = mean + r;
    out.k2 = mean - r;
    // The eigenvector of (d b; b -d) for r, by the row of (d - r, b; b, -d - r) that does not
    // cancel.
    double p = d >= 0.0 ? r + d : b, q = d >= 0.0 ? b : r - d;
    const double length = std::hypot(p, q);
    p = length > 0.0 ? p / length : 1.0;
    q = length > 0.0 ? q / length : 0.0;
    out.direction1 = p * u + q * v;
    out.direction2 = p * v - q * u;
    return out;
}

const std::vector<CurvatureField>& curvatureFields()
{
    static const std::vector<CurvatureField> fields = {
        {"mean_curvature", 1, [](const Curvature& k, float* out) { *out = float(k.mean()); }},
        {"gaussian_curvature", 1,
         [](const Curvature& k, float* out) { *out = float(k.gaussian()); }},
        {"principal_curvature_1", 1, [](const Curvature& k, float* out) { *out = float(k.k1); }},
        {"principal_curvature_2", 1, [](const Curvature& k, float* out) { *out = float(k.k2); }},
        {"shape_index", 1, [](const Curvature& k, float* out) { *out = float(k.shapeIndex()); }},
        {"curvedness", 1, [](const Curvature& k, float* out) { *out = float(k.curvedness()); }},
        {"principal_direction_1", 3,
         [](const Curvature& k, float* out) { put(k.direction1, out); }},
        {"principal_direction_2", 3,
         [](const Curvature& k, float* out) { put(k.direction2, out); }},
    };
    return fields;
}

const CurvatureField* findCurvatureField(const std::string& name)
{
    const auto& fields = curvatureFields();
    const auto it = std::find_if(fields.begin(), fields.end(),
                                 [&](const CurvatureField& f) { return name == f.name; });
    return it == fields.end() ? nullptr : &*it;
}

} // namespace molsurf
