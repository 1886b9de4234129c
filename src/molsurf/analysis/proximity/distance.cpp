// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/proximity/distance.h"

#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/spline/curvature.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

using openvdb::Mat3d;
using openvdb::Vec3d;

namespace
{

/// A point of {S = 0} with the gradient there.
struct Foot {
    Vec3d y, normal;
};

/// The part of a step along the surface: the solution d of (I + s A) d = t on the tangent plane, 0
/// where that matrix is not safely positive, as at a centre of curvature.
Vec3d alongSurface(const Jet& jet, const Vec3d& n, double s, const Vec3d& t)
{
    const double kappa = 2.0 * meanCurvature(jet), K = gaussianCurvature(jet);
    const double trace = 2.0 + s * kappa, determinant = 1.0 + s * kappa + s * s * K;
    if (trace <= 0.0 || determinant < 0.02 * trace * trace) return Vec3d(0.0);
    Vec3d At = jet.hessian * t;
    At = (At - n.dot(At) * n) / jet.gradient.length();
    return ((1.0 + s * kappa) * t - s * At) / determinant;
}

/// Largest distance of a foot from that of the triangles [voxel]: little holds it in place far from
/// a surface that is flat along one direction.
constexpr double mostWay = 4.0;

/// Moves y to the point of {S = 0} closest to x.
/// @return nothing if that fails
std::optional<Foot> closestOnSpline(SplineSampler& sampler, double voxel, const Vec3d& x,
                                    const Vec3d& start)
{
    constexpr int steps = 20;
    constexpr double leastSlope = 0.1, normalTolerance = 1e-6, tangentTolerance = 1e-4; // voxels
    const auto limited = [&](const Vec3d& step) {
        const double length = step.length();
        return length > 0.5 * voxel ? step * (0.5 * voxel / length) : step;
    };
    Vec3d y = start;
    for (int i = 0; i < steps; ++i) {
        const Jet jet = sampler.at(y);
        const double slope = jet.gradient.length();
        if (!(slope > leastSlope)) return std::nullopt;
        const Vec3d n = jet.gradient / slope;
        const double s = n.dot(x - y);
        const Vec3d t = x - y - s * n;
        const Vec3d d = alongSurface(jet, n, s, t);
        // Rounding of the float coefficients ends the convergence, so the last steps may do
        // without.
        const bool onSurface =
            std::abs(jet.value) <= (i < 4 ? 1.0 : 10.0) * normalTolerance * voxel;
        if (onSurface && d.length() <= tangentTolerance * voxel) return Foot{y, n};
        y += limited(d) - limited(jet.value / slope * n);
        if ((y - start).length() > mostWay * voxel) return std::nullopt;
    }
    return std::nullopt;
}

/// The same along the gradient only.
std::optional<Foot> ontoSpline(SplineSampler& sampler, double voxel, const Vec3d& start)
{
    Vec3d y = start;
    Foot foot{y, Vec3d(0.0)};
    for (int i = 0; i < 4; ++i) {
        const Jet jet = sampler.at(y);
        const double slope2 = jet.gradient.lengthSqr();
        if (!(slope2 > 0.01)) return std::nullopt;
        foot = {y, jet.gradient / std::sqrt(slope2)};
        y -= jet.value / slope2 * jet.gradient;
    }
    if ((foot.y - start).lengthSqr() > voxel * voxel) return std::nullopt;
    return foot;
}

/// The normal of a triangle, twice its area long.
Vec3d normalOf(const Mesh& mesh, std::uint32_t triangle)
{
    const auto& t = mesh.triangles[triangle];
    const Vec3d a(mesh.positions[t[0]]);
    return (Vec3d(mesh.positions[t[1]]) - a).cross(Vec3d(mesh.positions[t[2]]) - a);
}

Vec3d unit(const Vec3d& v)
{
    const double length = v.length();
    return length > 0.0 ? v / length : Vec3d(0.0);
}

} // namespace

bool hasInside(const Mesh& mesh, const VertexTriangles& around, const Progress& progress)
{
    constexpr std::size_t chunk = 1024;
    const std::size_t vertices = mesh.positions.size();
    // At each vertex the edges that leave it and those that come to it must have the same ends.
    const auto odd =
        parallelSum<std::size_t>((vertices + chunk - 1) / chunk, progress, [&](std::size_t c) {
            std::vector<std::uint32_t> out, in;
            std::size_t count = 0;
            for (std::size_t v = c * chunk; v < std::min(vertices, (c + 1) * chunk); ++v) {
                out.clear();
                in.clear();
                for (std::uint32_t i = around.begins[v]; i < around.begins[v + 1]; ++i) {
                    const auto& t = mesh.triangles[around.triangles[i]];
                    const int k = t[0] == v ? 0 : t[1] == v ? 1 : 2;
                    out.push_back(t[(k + 1) % 3]);
                    in.push_back(t[(k + 2) % 3]);
                }
                std::sort(out.begin(), out.end());
                std::sort(in.begin(), in.end());
                count += out != in;
            }
            return count;
        });
    return odd == 0 && !mesh.triangles.empty();
}

DistanceTo::DistanceTo(const Surface& surface)
    : surface_(surface), closest_(surface.mesh), around_(vertexTriangles(surface.mesh))
{
}

Vec3d DistanceTo::pseudonormal(const MeshPoint& point) const
{
    const Mesh& mesh = surface_.mesh;
    const auto& t = mesh.triangles[point.triangle];
    std::uint32_t on[3];
    int corners = 0;
    for (int k = 0; k < 3; ++k)
        if (point.weights[k] != 0.0) on[corners++] = t[k];
    if (corners == 3) return normalOf(mesh, point.triangle);

    // On an edge the triangles that share it count alike, at a vertex by their angles.
    Vec3d sum(0.0);
    for (std::uint32_t i = around_.begins[on[0]]; i < around_.begins[on[0] + 1]; ++i) {
        const std::uint32_t other = around_.triangles[i];
        const auto& o = mesh.triangles[other];
        const Vec3d n = unit(normalOf(mesh, other));
        if (corners == 2) {
            if (std::find(o.begin(), o.end(), on[1]) != o.end()) sum += n;
            continue;
        }
        const int k = o[0] == on[0] ? 0 : o[1] == on[0] ? 1 : 2;
        const Vec3d p(mesh.positions[o[k]]);
        const Vec3d e = unit(Vec3d(mesh.positions[o[(k + 1) % 3]]) - p);
        const Vec3d f = unit(Vec3d(mesh.positions[o[(k + 2) % 3]]) - p);
        sum += std::atan2(e.cross(f).length(), e.dot(f)) * n;
    }
    return sum;
}

DistanceTo::Query::Query(const DistanceTo& to) : to_(to)
{
    if (to.surface_.spline) sampler_.emplace(*to.surface_.spline);
}

Distance DistanceTo::Query::at(const Vec3d& x)
{
    const Surface& surface = to_.surface_;
    const MeshPoint near = to_.closest_.at(x);
    if (sampler_) {
        const double voxel = surface.spline->voxelSize();
        const Vec3d local = surface.pose.broughtBack(x),
                    start = surface.pose.broughtBack(near.point);
        // The triangles follow the surface closely: a foot at another distance is not the closest.
        constexpr double leeway = 0.25; // [voxel]
        const double about = (local - start).length();
        const auto good = [&](const std::optional<Foot>& foot) {
            return foot && std::abs((local - foot->y).length() - about) <= leeway * voxel;
        };
        std::optional<Foot> foot = closestOnSpline(*sampler_, voxel, local, start);
        if (!good(foot)) foot = ontoSpline(*sampler_, voxel, start);
        if (good(foot)) {
            const Vec3d way = local - foot->y;
            const double distance = way.length(), height = foot->normal.dot(way);
            // Away from the normal, at an edge of the surface, its sign means little.
            const bool below = std::abs(height) >= 0.5 * distance
                                   ? height < 0.0
                                   : to_.pseudonormal(near).dot(x - near.point) < 0.0;
            return {distance, surface.closed && below, surface.pose.placed(foot->y),
                    surface.pose.turned(foot->normal)};
        }
    }
    const Vec3d way = x - near.point, normal = unit(to_.pseudonormal(near));
    return {way.length(), surface.closed && normal.dot(way) < 0.0, near.point, normal};
}

} // namespace molsurf
