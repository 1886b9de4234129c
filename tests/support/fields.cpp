// SPDX-License-Identifier: MPL-2.0
#include "support/fields.h"

#include "support/convergence.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace molsurf::test
{

using openvdb::Coord;
using openvdb::Mat3d;
using openvdb::Vec3d;

Pose::Pose()
{
    const double a = 0.61, b = -1.13;
    const double c = std::cos(a), s = std::sin(a), C = std::cos(b), S = std::sin(b);
    const Mat3d aboutZ(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0);
    const Mat3d aboutX(1.0, 0.0, 0.0, 0.0, C, -S, 0.0, S, C);
    turn = aboutZ * aboutX;
}

Shape sphere(double R, const Pose& pose, int count)
{
    Shape shape;
    const Vec3d c = pose.centre;
    shape.distance = [=](const Vec3d& x) { return (x - c).length() - R; };
    shape.smooth = [=](const Vec3d& x) {
        const double r = (x - c).length();
        return (r * r * r - R * R * R) / (3.0 * R * R);
    };
    for (const Vec3d& n : directions(count)) {
        shape.points.push_back({c + R * n, n, 1.0 / R, 1.0 / (R * R)});
    }
    shape.area = 4.0 * M_PI * R * R;
    shape.volume = shape.area * R / 3.0;
    shape.extent = R;
    shape.centre = c;
    return shape;
}

Shape torus(double A, double a, const Pose& pose, int count)
{
    Shape shape;
    shape.distance = [=](const Vec3d& world) {
        const Vec3d x = pose.toLocal(world);
        return std::hypot(std::hypot(x.x(), x.y()) - A, x.z()) - a;
    };
    shape.smooth = [=](const Vec3d& world) {
        const Vec3d x = pose.toLocal(world);
        const double u = std::hypot(x.x(), x.y()) - A;
        return (u * u + x.z() * x.z() - a * a) / (2.0 * a) * (1.0 + 0.1 * x.x());
    };
    for (int i = 0; i < count; ++i) {
        const double s = 2.0 * M_PI * (i + 0.5) / count, t = 2.399963 * i + 0.2;
        const Vec3d radial(std::cos(t), std::sin(t), 0.0);
        const Vec3d n = std::cos(s) * radial + Vec3d(0, 0, std::sin(s));
        const double k = std::cos(s) / (A + a * std::cos(s));
        shape.points.push_back({pose.toWorld(A * radial + a * n), pose.turn * n,
                                0.5 * (1.0 / a + k), k / a,
                                pose.turn * (Vec3d(0, 0, std::cos(s)) - std::sin(s) * radial)});
    }
    shape.area = 4.0 * M_PI * M_PI * A * a;
    shape.volume = 2.0 * M_PI * M_PI * A * a * a;
    shape.extent = A + a;
    shape.centre = pose.centre;
    return shape;
}

namespace
{

/// Distance of a point to the surface of an ellipsoid: the root t of
/// sum (a_i x_i/(t + a_i^2))^2 = 1 in the interval where it decreases, by bisection (Eberly,
/// Distance from a point to an ellipse, an ellipsoid, or a hyperellipsoid, 2013).
double distanceToEllipsoid(const Vec3d& x, const Vec3d& axes)
{
    const Vec3d p(std::abs(x.x()), std::abs(x.y()), std::abs(x.z()));
    const double least = std::min({axes.x(), axes.y(), axes.z()});
    double low = -least * least, high = p.length() * std::max({axes.x(), axes.y(), axes.z()});
    const auto excess = [&](double t) {
        double sum = -1.0;
        for (int i = 0; i < 3; ++i) {
            const double q = axes[i] * p[i] / (t + axes[i] * axes[i]);
            sum += q * q;
        }
        return sum;
    };
    for (int i = 0; i < 46; ++i) {
        const double t = 0.5 * (low + high);
        (excess(t) > 0.0 ? low : high) = t;
    }
    const double t = 0.5 * (low + high);
    Vec3d y;
    for (int i = 0; i < 3; ++i) y[i] = axes[i] * axes[i] * p[i] / (t + axes[i] * axes[i]);
    return std::copysign((p - y).length(), t);
}

/// The principal direction of the larger curvature of an ellipsoid: the normal of the confocal
/// quadric sum x_i^2/(a_i^2 + t) = 1 through the point with the smaller |t|. (Principal directions
/// are those of the confocal system, by Dupin's theorem; the curvature is -h/t, with h the distance
/// of the tangent plane from the centre.)
Vec3d largerDirection(const Vec3d& x, const Vec3d& axes)
{
    const Vec3d a = axes * axes;
    // t^2 + p t + q = 0, the cubic without its root t = 0; both roots are negative.
    const double p = a[0] + a[1] + a[2] - x.lengthSqr();
    double q = a[0] * a[1] + a[1] * a[2] + a[2] * a[0];
    for (int i = 0; i < 3; ++i) q -= x[i] * x[i] * (a[(i + 1) % 3] + a[(i + 2) % 3]);
    const double t = -0.5 * p + std::sqrt(std::max(0.25 * p * p - q, 0.0));
    return (x / (a + Vec3d(t))).unit();
}

} // namespace

Shape ellipsoid(const Vec3d& axes, const Pose& pose, int count)
{
    Shape shape;
    shape.distance = [=](const Vec3d& x) { return distanceToEllipsoid(pose.toLocal(x), axes); };
    const double least = std::min({axes.x(), axes.y(), axes.z()});
    shape.smooth = [=](const Vec3d& x) {
        const Vec3d u = pose.toLocal(x) / axes;
        return 0.5 * least * (u.lengthSqr() - 1.0);
    };
    const double product = axes.x() * axes.y() * axes.z();
    for (const Vec3d& u : directions(count)) {
        const Vec3d x = u * axes;
        const Vec3d n = x / (axes * axes); // half the gradient
        const double s = n.lengthSqr();
        shape.points.push_back(
            {pose.toWorld(x), pose.turn * n.unit(),
             (axes.lengthSqr() - x.lengthSqr()) / (2.0 * product * product * std::pow(s, 1.5)),
             1.0 / (product * product * s * s), pose.turn * largerDirection(x, axes)});
    }
    // The area as an integral over the sphere: product |u/axes| du, by Gauss-free brute force on a
    // fine product grid in (z, angle); midpoint rule in z is replaced by Gauss-Legendre's two-point
    // rule to fourth order.
    const int rings = 400, steps = 400;
    double area = 0.0;
    for (int i = 0; i < rings; ++i) {
        for (const double g : {-0.5 / std::sqrt(3.0), 0.5 / std::sqrt(3.0)}) {
            const double z = -1.0 + 2.0 * (i + 0.5 + g) / rings, r = std::sqrt(1.0 - z * z);
            for (int k = 0; k < steps; ++k) {
                const double t = 2.0 * M_PI * (k + 0.5) / steps;
                const Vec3d u(r * std::cos(t), r * std::sin(t), z);
                area += (u / axes).length();
            }
        }
    }
    shape.area = area * product * (1.0 / rings) * (2.0 * M_PI / steps);
    shape.volume = 4.0 / 3.0 * M_PI * product;
    shape.extent = std::max({axes.x(), axes.y(), axes.z()});
    shape.centre = pose.centre;
    return shape;
}

Shape saddleOfTwoBalls(const Pose& pose, int count)
{
    const double probe = 1.4, R = 1.7 + probe, half = 2.0;
    const double ring = std::sqrt(R * R - half * half); // of the probe's centres
    Shape shape;
    shape.distance = [=](const Vec3d& world) {
        const Vec3d x = pose.toLocal(world), b(0.0, 0.0, half);
        return distanceToTwoBalls(x, -b, R, b, R) + probe;
    };
    const double limit = std::asin(half / R) - 0.75 / probe; // seen from the probe
    for (int i = 0; i < count; ++i) {
        const double s = limit * (2.0 * (i + 0.5) / count - 1.0), t = 2.399963 * i + 0.2;
        const Vec3d radial(std::cos(t), std::sin(t), 0.0), axis(0.0, 0.0, 1.0);
        const Vec3d n = std::cos(s) * radial + std::sin(s) * axis;
        const double k1 = std::cos(s) / (ring - probe * std::cos(s)), k2 = -1.0 / probe;
        shape.points.push_back({pose.toWorld(ring * radial - probe * n), pose.turn * n,
                                0.5 * (k1 + k2), k1 * k2, pose.turn * axis.cross(radial)});
    }
    shape.area = shape.volume = std::numeric_limits<double>::quiet_NaN();
    shape.extent = half + 1.7;
    shape.centre = pose.centre;
    return shape;
}

double distanceToTwoBalls(const Vec3d& x, const Vec3d& a, double R, const Vec3d& b, double S)
{
    const double da = (x - a).length() - R, db = (x - b).length() - S;
    const double outside = std::min(da, db);
    if (outside >= 0.0) return outside;
    // Candidates: the nearest point of either sphere, if the other ball does not cover it, and the
    // circle that they share.
    double best = std::numeric_limits<double>::infinity();
    const Vec3d onA = a + R * (x - a).unit(), onB = b + S * (x - b).unit();
    if ((onA - b).length() >= S) best = std::min(best, std::abs(da));
    if ((onB - a).length() >= R) best = std::min(best, std::abs(db));
    const Vec3d axis = (b - a).unit();
    const double D = (b - a).length();
    const double along = (D * D + R * R - S * S) / (2.0 * D);
    if (std::abs(along) < R) {
        const double rho = std::sqrt(R * R - along * along);
        const double s = (x - a).dot(axis), t = (x - a - s * axis).length();
        best = std::min(best, std::hypot(s - along, t - rho));
    }
    return -best;
}

LeafTable bandTable(const Function& f, const Vec3d& centre, double extent, double voxel,
                    double width)
{
    return bandTable(f, centre, extent, voxel, -width, width);
}

LeafTable bandTable(const Function& f, const Vec3d& centre, double extent, double voxel,
                    double below, double above)
{
    const double reach = extent + above + voxel;
    const Coord low = Coord::floor((centre - Vec3d(reach)) / voxel) & ~(leafDim - 1);
    const Coord high = Coord::ceil((centre + Vec3d(reach)) / voxel);
    std::vector<Coord> origins;
    std::vector<LeafMask> masks;
    for (int x = low.x(); x <= high.x(); x += leafDim) {
        for (int y = low.y(); y <= high.y(); y += leafDim) {
            for (int z = low.z(); z <= high.z(); z += leafDim) {
                const Coord origin(x, y, z);
                LeafMask mask;
                for (int v = 0; v < leafSize; ++v) {
                    const Coord c = origin.offsetBy(v >> 6, v >> 3 & 7, v & 7);
                    const double value = f(c.asVec3d() * voxel);
                    mask.set(v, value > below && value < above);
                }
                if (!mask.any()) continue;
                origins.push_back(origin);
                masks.push_back(mask);
            }
        }
    }
    LeafTable table(origins);
    for (std::size_t i = 0; i < origins.size(); ++i)
        table.active(std::size_t(table.find(origins[i]))) = masks[i];
    return table;
}

SparseField filled(const LeafTable& table, double voxelSize, const Function& f)
{
    SparseField field{table, LeafField(table.size()), voxelSize};
    for (std::size_t n = 0; n < table.size(); ++n) {
        for (int v = 0; v < leafSize; ++v) {
            const Coord c = table.origin(n).offsetBy(v >> 6, v >> 3 & 7, v & 7);
            field.leaf(n)[v] = float(f(c.asVec3d() * voxelSize));
        }
    }
    return field;
}

Spline splineOf(const Function& f, const Function& distance, const Vec3d& centre, double extent,
                double voxel, double width)
{
    const LeafTable table = bandTable(distance, centre, extent, voxel, width);
    return {prefilter(filled(table, voxel, f), Progress())};
}

double zeroOnRay(const Spline& spline, const Vec3d& centre, const Vec3d& direction, double low,
                 double high)
{
    SplineSampler sampler(spline);
    const auto value = [&](double t) { return sampler.at(centre + t * direction).value; };
    const bool sign = value(low) < 0.0;
    if (sign == (value(high) < 0.0)) return std::numeric_limits<double>::quiet_NaN();
    for (int i = 0; i < 40; ++i) {
        const double t = 0.5 * (low + high);
        ((value(t) < 0.0) == sign ? low : high) = t;
    }
    return 0.5 * (low + high);
}

} // namespace molsurf::test
