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
constexpr double rimCell = 1.0, nearCell = 0.5; // where points are sought [Å]
constexpr std::size_t run = 32; // points that follow each other and share what is near them

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

Vec3d probeOf(const ExcludedPoint& point)
{
    return point.position + fitProbe * point.normal;
}

/// Of each point, whether the probe that touches it runs into a ball.
std::vector<char> blockedBy(const BallIndex& balls, const ExcludedPoints& points,
                            const Progress& progress)
{
    std::vector<char> blocked(points.size());
    parallelFor((points.size() + run - 1) / run, progress, [&](std::size_t c) {
        const std::size_t begin = c * run, end = std::min(points.size(), begin + run);
        openvdb::BBoxd box;
        for (std::size_t i = begin; i < end; ++i) box.expand(probeOf(points[i]));
        std::vector<Ball> near;
        balls.forEachNear(box.min(), box.max(), fitProbe,
                          [&](const Ball& ball, std::int32_t) { near.push_back(ball); });
        for (std::size_t i = begin; i < end; ++i) {
            const Vec3d centre = probeOf(points[i]);
            blocked[i] = std::any_of(near.begin(), near.end(), [&](const Ball& ball) {
                const double reach = ball.radius + fitProbe - touching;
                return (ball.center - centre).lengthSqr() < reach * reach;
            });
        }
    });
    return blocked;
}

/// Finds points near others.
class PointIndex
{
public:
    /// @param[in] cell  edge of the cells that hold them: a half or more of what is searched [Å]
    PointIndex(const ExcludedPoints& points, double cell)
        : points_(points), scale_(1.0 / cell), index_(asBalls(points, scale_), {0, 0, 1})
    {
    }

    bool anyWithin(const Vec3d& x, double reach) const
    {
        const Vec3d at = scale_ * x;
        return index_.anyNear(at, at, scale_ * reach, [&](const Ball& ball) {
            return (ball.center - at).lengthSqr() < scale_ * scale_ * reach * reach;
        });
    }

    /// The nearest; there is one.
    const ExcludedPoint& nearest(const Vec3d& x) const
    {
        const Vec3d at = scale_ * x;
        for (double reach = 0.5;; reach *= 1.5) {
            double least = scale_ * scale_ * reach * reach;
            std::int32_t best = -1;
            index_.forEachNear(at, at, scale_ * reach, [&](const Ball& ball, std::int32_t i) {
                const double square = (ball.center - at).lengthSqr();
                if (square > least || (square == least && i > best)) return;
                least = square;
                best = i;
            });
            if (best >= 0) return points_[std::size_t(best)];
        }
    }

private:
    /// An index has cells of 1 at least.
    static std::vector<Ball> asBalls(const ExcludedPoints& points, double scale)
    {
        std::vector<Ball> out;
        for (const ExcludedPoint& point : points) out.push_back({scale * point.position, 0.0, 0});
        return out;
    }

    const ExcludedPoints& points_;
    double scale_;
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
    // A probe that a ball of radius R blocks is within R + fitProbe of it, its point within
    // fitProbe of the probe, and the points of its rim within rimWidth of that.
    const auto counts = [&](const Vec3d& centre, double radius) {
        const double beyond = radius + 2.0 * fitProbe + rimWidth;
        return other.anyNear(centre, centre, beyond, [&](const Ball& ball) {
            const double reach = ball.radius + beyond;
            return (ball.center - centre).lengthSqr() < reach * reach;
        });
    };
    const ExcludedPoints all = excludedPoints(boundary, fitProbe, density, progress, counts);
    const std::vector<char> blocked = blockedBy(other, all, progress);
    ExcludedPoints buried, open;
    for (std::size_t i = 0; i < all.size(); ++i) (blocked[i] ? buried : open).push_back(all[i]);
    const PointIndex rim(open, rimCell);
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
    const auto [shapeA, distanceA] =
        mediansOf(sideA.trimmed, PointIndex(sideB.trimmed, nearCell), progress);
    const auto [shapeB, distanceB] =
        mediansOf(sideB.trimmed, PointIndex(sideA.trimmed, nearCell), progress);
    fit.shape = 0.5 * (shapeA + shapeB);
    fit.distance = 0.5 * (distanceA + distanceB);
    return fit;
}

} // namespace molsurf
