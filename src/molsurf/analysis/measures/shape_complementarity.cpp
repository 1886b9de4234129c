// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/measures/shape_complementarity.h"

#include "molsurf/kernel/balls/ball_index.h"
#include "molsurf/kernel/balls/box_tree.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/core/simd.h"
#include "molsurf/kernel/pipeline/closed_form.h"

#include <algorithm>
#include <cmath>
#include <cstring>
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
constexpr std::size_t run = 32; // points that follow each other and share what is near them

Vec3d probeOf(const ExcludedPoint& point)
{
    return point.position + fitProbe * point.normal;
}

/// Calls f(begin, end) for each run of some points.
template<typename F>
void forEachRun(std::size_t points, const Progress& progress, const F& f)
{
    parallelFor((points + run - 1) / run, progress,
                [&](std::size_t c) { f(c * run, std::min(points, (c + 1) * run)); });
}

/// Of each point, whether the probe that touches it runs into a ball.
std::vector<char> blockedBy(const BallIndex& balls, const ExcludedPoints& points,
                            const Progress& progress)
{
    std::vector<char> blocked(points.size());
    forEachRun(points.size(), progress, [&](std::size_t begin, std::size_t end) {
        openvdb::BBoxd box;
        for (std::size_t i = begin; i < end; ++i) box.expand(probeOf(points[i]));
        thread_local std::vector<Ball> near;
        near.clear();
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

/// The coordinates of a run of points, the last one repeated where it has fewer.
struct Run {
    double x[run], y[run], z[run];
};

/// Squares of the distances from a point to those of a run [Å^2].
/// @return the least
MOLSURF_KERNEL double squaresTo(const Run& points, double x, double y, double z, double* out)
{
    Doubles least = {HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL};
    for (std::size_t k = 0; k < run; k += doubleLanes) {
        const Doubles dx = load(points.x + k) - x, dy = load(points.y + k) - y,
                      dz = load(points.z + k) - z, square = dx * dx + dy * dy + dz * dz;
        std::memcpy(out + k, &square, sizeof square);
        least = square < least ? square : least;
    }
    return std::min(std::min(least[0], least[1]), std::min(least[2], least[3]));
}

/// Finds points near others. Those that follow each other should be near each other.
class PointRuns
{
public:
    explicit PointRuns(const std::vector<Vec3d>& points)
        : runs_((points.size() + run - 1) / run), boxes_(boxesOf(points)), tree_(boxes_)
    {
        for (std::size_t i = 0; i < runs_.size() * run; ++i) {
            const Vec3d& x = points[std::min(i, points.size() - 1)];
            Run& own = runs_[i / run];
            own.x[i % run] = x.x();
            own.y[i % run] = x.y();
            own.z[i % run] = x.z();
        }
    }

    /// Whether any is nearer to a point than a reach.
    /// @param[in,out] first  the run to look at first; then the one that has such a point
    bool anyWithin(const Vec3d& x, double reach, std::size_t& first) const
    {
        const double square = reach * reach;
        const auto isIn = [&](std::size_t n) {
            double unused[run];
            return boxes_[n].squareTo(x) < square &&
                   squaresTo(runs_[n], x.x(), x.y(), x.z(), unused) < square;
        };
        if (first < runs_.size() && isIn(first)) return true;
        bool found = false;
        forEachNear(x, reach, [&](std::size_t n) {
            if (found || !isIn(n)) return;
            found = true;
            first = n;
        });
        return found;
    }

    /// Finds the nearest point if one is nearer than a reach.
    /// @param[in] most  square of the reach [Å^2]
    /// @return its number, or -1
    std::ptrdiff_t nearest(const Vec3d& x, double most) const
    {
        std::ptrdiff_t best = -1;
        forEachNear(x, std::sqrt(most), [&](std::size_t n) {
            if (boxes_[n].squareTo(x) > most) return;
            double squares[run];
            const double square = squaresTo(runs_[n], x.x(), x.y(), x.z(), squares);
            if (square >= most) return;
            most = square;
            best = std::ptrdiff_t(n * run) + (std::find(squares, squares + run, square) - squares);
        });
        return best;
    }

private:
    static std::vector<Box> boxesOf(const std::vector<Vec3d>& points)
    {
        std::vector<Box> boxes;
        for (std::size_t begin = 0; begin < points.size(); begin += run) {
            openvdb::BBoxd box;
            for (std::size_t i = begin; i < std::min(begin + run, points.size()); ++i)
                box.expand(points[i]);
            boxes.push_back({box.min(), box.max()});
        }
        return boxes;
    }

    /// Calls f(n) for the runs that may have a point within a reach, ascending.
    template<typename F>
    void forEachNear(const Vec3d& x, double reach, const F& f) const
    {
        const auto inGroup = [&](std::size_t g) {
            const std::size_t end = std::min((g + 1) * BoxTree::group, runs_.size());
            for (std::size_t n = g * BoxTree::group; n < end; ++n) f(n);
        };
        if (runs_.size() <= BoxTree::group) return inGroup(0); // in less time than the tree takes
        tree_.forEachNear(Box::about(x, reach), inGroup);
    }

    std::vector<Run> runs_;
    std::vector<Box> boxes_;
    BoxTree tree_;
};

/// Buried points, less those within a rim's width of an open one.
ExcludedPoints withoutRim(const ExcludedPoints& buried, const PointRuns& open,
                          const Progress& progress)
{
    std::vector<char> isInside(buried.size());
    forEachRun(buried.size(), progress, [&](std::size_t begin, std::size_t end) {
        std::size_t first = 0;
        for (std::size_t i = begin; i < end; ++i)
            isInside[i] = !open.anyWithin(buried[i].position, rimWidth, first);
    });
    ExcludedPoints out;
    for (std::size_t i = 0; i < buried.size(); ++i)
        if (isInside[i]) out.push_back(buried[i]);
    return out;
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

/// Of each point the number of the nearest among others.
/// @param[in] others  at least one
std::vector<std::ptrdiff_t> nearestOf(const ExcludedPoints& points, const ExcludedPoints& others,
                                      const Progress& progress)
{
    std::vector<Vec3d> places;
    for (const ExcludedPoint& other : others) places.push_back(other.position);
    const PointRuns runs(places);
    std::vector<std::ptrdiff_t> nearest(points.size());
    forEachRun(points.size(), progress, [&](std::size_t begin, std::size_t end) {
        std::ptrdiff_t best = -1;
        for (double reach = 0.5; best < 0; reach *= 1.5)
            best = runs.nearest(points[begin].position, reach * reach);
        for (std::size_t i = begin; i < end; ++i) { // the nearest to the point before is a bound
            const Vec3d& x = points[i].position;
            const double most = (places[std::size_t(best)] - x).lengthSqr();
            const std::ptrdiff_t nearer = runs.nearest(x, most);
            nearest[i] = best = nearer < 0 ? best : nearer;
        }
    });
    return nearest;
}

/// Medians of the value and of the distance of one side's points.
std::pair<double, double> mediansOf(const ExcludedPoints& points, const ExcludedPoints& others,
                                    const Progress& progress)
{
    const std::vector<std::ptrdiff_t> nearest = nearestOf(points, others, progress);
    std::vector<std::pair<double, double>> shapes(points.size()), distances(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const ExcludedPoint &point = points[i], &other = others[std::size_t(nearest[i])];
        const double square = (other.position - point.position).lengthSqr();
        shapes[i] = {-point.normal.dot(other.normal) * std::exp(-decay * square), point.area};
        distances[i] = {std::sqrt(square), point.area};
    }
    return {medianOf(std::move(shapes)), medianOf(std::move(distances))};
}

/// Whether the balls of a group touch each other with no probe, so that their surfaces are spheres
/// more than two probes apart, which is more than the width of a rim; and whether these are so
/// small that looking through all points for those near one takes no time.
bool areSmallSpheres(const BallBoundary& boundary)
{
    constexpr double largest = 8.0; // radius [Å]
    return boundary.arcs.empty() &&
           std::all_of(boundary.patches.begin(), boundary.patches.end(),
                       [](const Patch& patch) { return patch.radius - fitProbe <= largest; });
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

FitSurface::FitSurface(std::vector<Ball> balls, const Progress& progress)
    : balls_(std::move(balls)), index_(balls_, cells),
      boundary_(ballBoundary(balls_, fitProbe, progress)), volume_(volumeOf(boundary_, progress))
{
}

FitMeasure::FitMeasure() : sampler_(fitProbe, density) {}

/// @param[in] own  the balls of this group near the other one. (A probe that would run into a ball
///                 farther away is beyond the rim's width from any buried point.)
FitMeasure::Side FitMeasure::sideOf(const FitSurface& own, const FitSurface& other,
                                    const Progress& progress)
{
    if (areSmallSpheres(own.boundary())) return sideOfSpheres(own, other);
    // A probe that a ball of radius R blocks is within R + fitProbe of it, its point within
    // fitProbe of the probe, and the points of its rim within rimWidth of that.
    const auto counts = [&](const Vec3d& centre, double radius) {
        const double beyond = radius + 2.0 * fitProbe + rimWidth;
        return other.index().anyNear(centre, centre, beyond, [&](const Ball& ball) {
            const double reach = ball.radius + beyond;
            return (ball.center - centre).lengthSqr() < reach * reach;
        });
    };
    const ExcludedPoints all = sampler_.of(own.boundary(), progress, counts);
    const std::vector<char> blocked = blockedBy(other.index(), all, progress);
    ExcludedPoints buried;
    std::vector<Vec3d> open;
    Side side;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (!blocked[i]) {
            open.push_back(all[i].position);
            continue;
        }
        buried.push_back(all[i]);
        side.buriedArea += all[i].area;
    }
    side.trimmed = withoutRim(buried, PointRuns(open), progress);
    return side;
}

/// The same of areSmallSpheres(): all that is near a point lies on its own sphere.
FitMeasure::Side FitMeasure::sideOfSpheres(const FitSurface& own, const FitSurface& other)
{
    Side side;
    for (const Patch& patch : own.boundary().patches) {
        const double R = patch.radius, r = R - fitProbe;
        SpherePoints& points = pointsOf(r);
        SpherePoints::Set buried = points.none();
        other.index().forEachNear(
            patch.centre, patch.centre, R + fitProbe, [&](const Ball& ball, std::int32_t) {
                // The probe at R u from the centre is nearer than `reach` to the ball.
                const Vec3d way = ball.center - patch.centre;
                const double reach = ball.radius + fitProbe - touching;
                points.addCap(way, (way.lengthSqr() + R * R - reach * reach) / (2.0 * R), buried);
            });
        const ExcludedSampler::Spread& spread = sampler_.spreadOver(r);
        const double area = 4.0 * M_PI * r * r / double(spread.directions.size());
        side.buriedArea += area * double(points.count(buried));
        points.forEach(points.eroded(buried), [&](std::size_t k) {
            const Vec3d& u = spread.directions[k];
            side.trimmed.push_back({patch.centre + r * u, u, area});
        });
    }
    return side;
}

SpherePoints& FitMeasure::pointsOf(double radius)
{
    constexpr std::size_t most = 16; // that are kept
    const auto known = points_.find(radius);
    if (known != points_.end()) return known->second;
    if (points_.size() >= most) points_.clear();
    return points_.try_emplace(radius, sampler_.spreadOver(radius), rimWidth / radius)
        .first->second;
}

Report::Interface::Fit FitMeasure::of(const FitSurface& first, const FitSurface& second,
                                      const Progress& progress)
{
    Report::Interface::Fit fit;
    if (first.balls().empty() || second.balls().empty()) return fit;
    std::vector<Ball> both = first.balls();
    both.insert(both.end(), second.balls().begin(), second.balls().end());
    // The gap is inside the surface of both together, and outside that of each by itself.
    fit.gapVolume = volumeOf(ballBoundary(both, fitProbe, progress), progress) - first.volume() -
                    second.volume();
    const Side a = sideOf(first, second, progress), b = sideOf(second, first, progress);
    const double area = 0.5 * (a.buriedArea + b.buriedArea);
    if (area > 0.0) fit.gapIndex = fit.gapVolume / area;
    if (a.trimmed.empty() || b.trimmed.empty()) return fit;
    const auto [shapeA, distanceA] = mediansOf(a.trimmed, b.trimmed, progress);
    const auto [shapeB, distanceB] = mediansOf(b.trimmed, a.trimmed, progress);
    fit.shape = 0.5 * (shapeA + shapeB);
    fit.distance = 0.5 * (distanceA + distanceB);
    return fit;
}

} // namespace molsurf
