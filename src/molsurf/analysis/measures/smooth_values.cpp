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

/// A vertex with a value, in the order of the index, as a square of the area at it.
class Weighted
{
public:
    /// @param[in] value   not a number: there is none
    /// @param[in] radius  within which squares count [Å]
    Weighted(const Vec3d& place, float value, double area, std::uint32_t piece, double radius)
        : place_(place), area_(std::isfinite(value) ? area : 0.0),
          integral_(area_ > 0.0 ? area_ * double(value) : 0.0), width_(std::sqrt(area_)),
          outer_(radius + 0.5 * width_), none_(outer_ * outer_),
          whole_(std::pow(std::max(radius - 0.5 * width_, 0.0), 2)), piece_(piece)
    {
    }

    double area() const { return area_; }
    double outer() const { return outer_; } ///< how far it counts at most [Å]
    const Vec3d& place() const { return place_; }

    /// Adds the area and the integral of what another one has within the radius.
    void add(const Weighted& other, double& area, double& integral) const
    {
        const double square = (other.place_ - place_).lengthSqr();
        if (square >= other.none_ || other.piece_ != piece_) return;
        const double share = square <= other.whole_
                                 ? 1.0
                                 : std::min((other.outer_ - std::sqrt(square)) / other.width_, 1.0);
        area += share * other.area_;
        integral += share * other.integral_;
    }

private:
    Vec3d place_;
    double area_, integral_; // of the value over the area
    double width_;           // of the square [Å]
    double outer_;           // distance from which on it does not count [Å]
    double none_, whole_;    // squares of that and of the one up to which all of it counts
    std::uint32_t piece_;
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
        all.emplace_back(index.ball(n).center, values[v], double(areas[v]), pieces[v], radius);
    }
    double reach = radius;
    for (const Weighted& one : all) reach = std::max(reach, one.outer());
    constexpr std::size_t chunk = 64;
    parallelFor((all.size() + chunk - 1) / chunk, progress, [&](std::size_t c) {
        for (std::size_t n = c * chunk; n < std::min(all.size(), (c + 1) * chunk); ++n) {
            const Weighted& own = all[n];
            double area = 0.0, integral = 0.0;
            index.forEachRun(own.place(), own.place(), reach,
                             [&](std::int32_t begin, std::int32_t end) {
                                 for (std::int32_t i = begin; i < end; ++i)
                                     own.add(all[std::size_t(i)], area, integral);
                             });
            if (own.area() > 0.0) values[std::size_t(index.indexOf(n))] = float(integral / area);
        }
    });
}

} // namespace molsurf
