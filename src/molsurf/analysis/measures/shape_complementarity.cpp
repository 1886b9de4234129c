// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/measures/shape_complementarity.h"

#include "molsurf/kernel/balls/ball_index.h"
#include "molsurf/kernel/balls/excluded_points.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/pipeline/closed_form.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

// Of Lawrence and Colman.
constexpr double fitProbe = 1.7;  // radius [Å]
constexpr double rimWidth = 1.5;  // [Å]
constexpr double decay = 0.5;     // [1/Å^2]
constexpr double density = 30.0;  // of points [1/Å^2]: twice theirs, for steadiness
constexpr double touching = 1e-6; // of a probe that touches a ball [Å]
constexpr CellSize cells{1.0, fitProbe, 1.0};

/// The balls of a group within fitReach of another one.
std::vector<Ball> nearOnes(const std::vector<Ball>& balls, const BallIndex& other)
{
    std::vector<Ball> near;
    for (const Ball& ball : balls) {
        const double reach = ball.radius + fitReach;
        const auto isNear = [&](const Ball& o) {
            return (o.center - ball.center).lengthSqr() < (o.radius + reach) * (o.radius + reach);
        };
        if (other.anyNear(ball.center, ball.center, reach, isNear)) near.push_back(ball);
    }
    return near;
}

/// Whether the probe that touches a point runs into a ball.
bool isBlocked(const ExcludedPoint& point, const BallIndex& balls)
{
    const Vec3d centre = point.position + fitProbe * point.normal;
    return balls.anyNear(centre, centre, fitProbe, [&](const Ball& ball) {
        const double reach = ball.radius + fitProbe - touching;
        return (ball.center - centre).lengthSqr() < reach * reach;
    });
}

/// Finds points near others.
class PointIndex
{
public:
    explicit PointIndex(const ExcludedPoints& points)
        : points_(points), index_(asBalls(points), {0, 0, 1})
    {
    }

    bool anyWithin(const Vec3d& x, double reach) const
    {
        return index_.anyNear(x, x, reach, [&](const Ball& ball) {
            return (ball.center - x).lengthSqr() < reach * reach;
        });
    }

    /// The nearest; there is one.
    const ExcludedPoint& nearest(const Vec3d& x) const
    {
        for (double reach = 1.0;; reach *= 2.0) {
            double least = reach * reach;
            std::int32_t best = -1;
            index_.forEachNear(x, x, reach, [&](const Ball& ball, std::int32_t i) {
                const double square = (ball.center - x).lengthSqr();
                if (square > least || (square == least && i > best)) return;
                least = square;
                best = i;
            });
            if (best >= 0) return points_[std::size_t(best)];
        }
    }

private:
    static std::vector<Ball> asBalls(const ExcludedPoints& points)
    {
        std::vector<Ball> out;
        for (const ExcludedPoint& point : points) out.push_back({point.position, 0.0, 0});
        return out;
    }

    const ExcludedPoints& points_;
    BallIndex index_;
};

/// The part of a surface that the other group buries, with and without its rim.
struct Side {
    double buriedArea = 0.0; ///< [Å^2]
    ExcludedPoints trimmed;
};

/// Samples the solvent-excluded surface by points, and keeps those that the other group buries.
/// @param[in] boundary  of the balls of this group near the other one. (A probe that would run into
///                      a ball farther away is beyond the rim's width from any buried point.)
Side sideOf(const BallBoundary& boundary, const BallIndex& other, const Progress& progress)
{
    const ExcludedPoints all = excludedPoints(boundary, fitProbe, density, progress);
    std::vector<char> blocked(all.size());
    parallelFor(all.size(), progress,
                [&](std::size_t i) { blocked[i] = isBlocked(all[i], other) ? 1 : 0; });
    ExcludedPoints buried, open;
    for (std::size_t i = 0; i < all.size(); ++i) (blocked[i] ? buried : open).push_back(all[i]);
    const PointIndex rim(open);
    Side side;
    for (const ExcludedPoint& p : buried) side.buriedArea += p.area;
    side.trimmed = parallelCollect<ExcludedPoint>(
        buried.size(), progress, [&](std::size_t i, ExcludedPoints& out) {
            if (!rim.anyWithin(buried[i].position, rimWidth)) out.push_back(buried[i]);
        });
    return side;
}

/// The weighted median: the least value that, with those below it, has half of the weight.
/// @param[in] values  with their weights, at least one
double medianOf(std::vector<std::pair<double, double>> values)
{
    std::sort(values.begin(), values.end());
    double half = 0.0;
    for (const auto& [value, weight] : values) half += 0.5 * weight;
    for (const auto& [value, weight] : values)
        if ((half -= weight) <= 0.0) return value;
    return values.back().first;
}

/// Medians of the value and of the distance of one side's points.
std::pair<double, double> mediansOf(const ExcludedPoints& points, const PointIndex& others,
                                    const Progress& progress)
{
    std::vector<std::pair<double, double>> shapes(points.size()), distances(points.size());
    parallelFor(points.size(), progress, [&](std::size_t i) {
        const ExcludedPoint &point = points[i], &other = others.nearest(point.position);
        const double square = (other.position - point.position).lengthSqr();
        shapes[i] = {-point.normal.dot(other.normal) * std::exp(-decay * square), point.area};
        distances[i] = {std::sqrt(square), point.area};
    });
    return {medianOf(std::move(shapes)), medianOf(std::move(distances))};
}

/// The volume of what no probe reaches [Å^3].
double volumeOf(const BallBoundary& boundary, const Progress& progress)
{
    SurfaceSpec spec;
    spec.kind = SurfaceKind::SolventExcluded;
    spec.probe = fitProbe;
    double volume = 0.0;
    for (const BoundaryPiece& piece : measureClosedForm(boundary, spec, 0, progress).pieces)
        volume += piece.volume;
    return volume;
}

} // namespace

Report::Interface::Fit fitOf(const std::vector<Ball>& first, const std::vector<Ball>& second,
                             const Progress& progress)
{
    const BallIndex firstIndex(first, cells), secondIndex(second, cells);
    const std::vector<Ball> a = nearOnes(first, secondIndex), b = nearOnes(second, firstIndex);
    Report::Interface::Fit fit;
    if (a.empty() || b.empty()) return fit;
    std::vector<Ball> both = a;
    both.insert(both.end(), b.begin(), b.end());
    const BallBoundary ofA = ballBoundary(a, fitProbe, progress),
                       ofB = ballBoundary(b, fitProbe, progress);
    // The gap is inside the surface of both together, and outside that of each by itself.
    fit.gapVolume = volumeOf(ballBoundary(both, fitProbe, progress), progress) -
                    volumeOf(ofA, progress) - volumeOf(ofB, progress);
    const Side sideA = sideOf(ofA, secondIndex, progress),
               sideB = sideOf(ofB, firstIndex, progress);
    const double area = 0.5 * (sideA.buriedArea + sideB.buriedArea);
    if (area > 0.0) fit.gapIndex = fit.gapVolume / area;
    if (sideA.trimmed.empty() || sideB.trimmed.empty()) return fit;
    const auto [shapeA, distanceA] = mediansOf(sideA.trimmed, PointIndex(sideB.trimmed), progress);
    const auto [shapeB, distanceB] = mediansOf(sideB.trimmed, PointIndex(sideA.trimmed), progress);
    fit.shape = 0.5 * (shapeA + shapeB);
    fit.distance = 0.5 * (distanceA + distanceB);
    return fit;
}

} // namespace molsurf
