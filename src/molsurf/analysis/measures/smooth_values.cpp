// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/measures/smooth_values.h"

#include "molsurf/kernel/balls/ball_index.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/mesh/statistics.h"
#include "molsurf/kernel/mesh/topology.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace molsurf
{

namespace
{

using openvdb::Vec3d;

/// A vertex with a value, in the order of the index.
struct Weighted {
    Vec3d place;
    double area, integral; // of the value over the area
    double width;          // of a square of this area [Å]
    std::uint32_t piece;

    /// The share of the square that is within a radius of a place at a squared distance.
    double shareWithin(double radius, double square) const
    {
        const double inner = std::max(radius - 0.5 * width, 0.0), outer = radius + 0.5 * width;
        if (square <= inner * inner) return 1.0;
        if (square >= outer * outer) return 0.0;
        return std::min((outer - std::sqrt(square)) / width, 1.0);
    }
};

/// The vertices as balls without radius, for an index of them.
BallIndex indexOf(const Mesh& mesh, double radius)
{
    std::vector<Ball> points;
    points.reserve(mesh.positions.size());
    for (const auto& x : mesh.positions) points.push_back({Vec3d(x), 0.0, 0});
    return BallIndex(points, {0.0, 0.0, std::max(1.0, 0.5 * radius)});
}

} // namespace

void smoothValues(const Mesh& mesh, double radius, const Progress& progress,
                  std::vector<float>& values)
{
    const BallIndex index = indexOf(mesh, radius);
    const std::vector<float> areas = vertexAreas(mesh, progress);
    std::size_t count = 0;
    const std::vector<std::uint32_t> pieces = connectedPieces(mesh, count, progress);
    std::vector<Weighted> all;
    all.reserve(index.size());
    for (std::size_t n = 0; n < index.size(); ++n) {
        const auto v = std::size_t(index.indexOf(n));
        const double area = std::isfinite(values[v]) ? double(areas[v]) : 0.0;
        all.push_back({index.ball(n).center, area, area > 0.0 ? area * double(values[v]) : 0.0,
                       std::sqrt(area), pieces[v]});
    }
    constexpr std::size_t chunk = 64;
    double widest = 0.0;
    for (const Weighted& one : all) widest = std::max(widest, one.width);
    const double reach = radius + 0.5 * widest;
    parallelFor((all.size() + chunk - 1) / chunk, progress, [&](std::size_t c) {
        for (std::size_t n = c * chunk; n < std::min(all.size(), (c + 1) * chunk); ++n) {
            const Weighted& own = all[n];
            double area = 0.0, integral = 0.0;
            index.forEachRun(
                own.place, own.place, reach, [&](std::int32_t begin, std::int32_t end) {
                    for (std::int32_t i = begin; i < end; ++i) {
                        const Weighted& other = all[std::size_t(i)];
                        if (other.piece != own.piece) continue;
                        const double share =
                            other.shareWithin(radius, (other.place - own.place).lengthSqr());
                        area += share * other.area;
                        integral += share * other.integral;
                    }
                });
            if (own.area > 0.0) values[std::size_t(index.indexOf(n))] = float(integral / area);
        }
    });
}

} // namespace molsurf
