// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/measures/shape_complementarity.h"

#include "molsurf/kernel/balls/ball_index.h"
#include "molsurf/kernel/balls/box_tree.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/core/simd.h"
#include "molsurf/kernel/pipeline/closed_form.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

namespace molsurf
{

using openvdb::Vec2d;
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

/// The weighted median: the least value that, with those below it, has half of the weight. Halves
/// the values until one is left, as quickselect does.
/// @param[in] values  with their weights, at least one
double medianOf(std::vector<std::pair<double, double>> values)
{
    double left = 0.0; // of the weight that the median has to reach
    for (const auto& [value, weight] : values) left += 0.5 * weight;
    auto begin = values.begin(), end = values.end();
    while (end - begin > 1) {
        const auto middle = begin + (end - begin) / 2;
        std::nth_element(begin, middle, end);
        double below = 0.0;
        for (auto value = begin; value != middle; ++value) below += value->second;
        if (below >= left) {
            end = middle;
        } else {
            left -= below;
            begin = middle;
        }
    }
    return begin->first;
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

/// Area of one side's points, times exp(-decay d^2), d being the distance of the nearest of others.
double contactOf(const ExcludedPoints& points, const ExcludedPoints& others,
                 const Progress& progress)
{
    if (points.empty() || others.empty()) return 0.0;
    const std::vector<std::ptrdiff_t> nearest = nearestOf(points, others, progress);
    double sum = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3d& other = others[std::size_t(nearest[i])].position;
        sum += points[i].area * std::exp(-decay * (other - points[i].position).lengthSqr());
    }
    return sum;
}

/// What one of two balls buries of the other's sphere: a cap about the way between their centres.
struct BuriedCap {
    double radius;  ///< of the sphere [Å]
    double cosine;  ///< of the angle at which it ends; 1: nothing is buried
    double trimmed; ///< angle at which it ends without the rim
};

BuriedCap buriedCap(double radius, double other, double apart)
{
    // The probe at R u from the centre is nearer than `reach` to the other ball where u.way > most.
    const double R = radius + fitProbe, reach = other + fitProbe - touching;
    const double most = (R * R + apart * apart - reach * reach) / (2.0 * R);
    if (most >= apart) return {radius, 1.0, 0.0};
    if (most <= -apart) return {radius, -1.0, M_PI}; // without an end, thus without a rim
    const double end = std::acos(most / apart);
    const double rim = 2.0 * std::asin(std::min(0.5 * rimWidth / radius, 1.0));
    return {radius, most / apart, std::max(end - rim, 0.0)};
}

/// The mean of the two values in the middle.
template<std::size_t size>
double middleOf(std::array<double, size>& values)
{
    static_assert(size % 2 == 0);
    const auto middle = values.begin() + size / 2;
    std::nth_element(values.begin(), middle, values.end());
    return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

constexpr std::size_t rings = 128;   // of equal area on a cap, for a median
constexpr std::size_t fewRings = 32; // for an integral, to 2e-4 of it

/// Calls f(k, shape, square) for the rings of a cap up to an angle: the cosine of their normals
/// and those of the nearest points of the other's cap up to one, and the squares of the distances.
/// @param[in] ends  the angles of both
template<std::size_t count, typename F>
void forEachRing(const BuriedCap& own, const BuriedCap& other, const std::array<double, 2>& ends,
                 double apart, const F& f)
{
    const double step = (1.0 - std::cos(ends[0])) / double(count);
    const Vec2d end(std::sin(ends[1]), std::cos(ends[1]));
    for (std::size_t k = 0; k < count; ++k) {
        // In the half plane of the point, the axis leading from the other's centre to this one.
        const double u = 1.0 - (double(k) + 0.5) * step;
        const Vec2d normal(std::sqrt((1.0 - u) * (1.0 + u)), -u);
        const Vec2d x(own.radius * normal.x(), apart + own.radius * normal.y());
        const double length = x.length();
        Vec2d nearest = length > 0.0 ? x / length : end; // a normal of the other sphere
        if (nearest.y() < end.y()) nearest = end;
        f(k, -normal.dot(nearest), (x - other.radius * nearest).lengthSqr());
    }
}

/// mediansOf() the cap of one ball and that of the other.
std::pair<double, double> mediansOf(const BuriedCap& own, const BuriedCap& other, double apart)
{
    std::array<double, rings> shapes, distances;
    forEachRing<rings>(own, other, {own.trimmed, other.trimmed}, apart,
                       [&](std::size_t k, double shape, double square) {
                           shapes[k] = shape * std::exp(-decay * square);
                           distances[k] = std::sqrt(square);
                       });
    return {middleOf(shapes), middleOf(distances)};
}

/// [Å^2]
double areaOf(const BuriedCap& cap)
{
    return 2.0 * M_PI * cap.radius * cap.radius * (1.0 - cap.cosine);
}

/// contactOf() the cap of one ball and that of the other.
double contactOf(const BuriedCap& own, const BuriedCap& other, double apart)
{
    if (own.cosine == 1.0 || other.cosine == 1.0) return 0.0;
    double sum = 0.0;
    forEachRing<fewRings>(
        own, other, {std::acos(own.cosine), std::acos(other.cosine)}, apart,
        [&](std::size_t, double, double square) { sum += std::exp(-decay * square); });
    return areaOf(own) * sum / double(fewRings);
}

void setMeans(const std::pair<double, double>& a, const std::pair<double, double>& b,
              Report::Interface::Fit& fit)
{
    fit.shape = 0.5 * (a.first + b.first);
    fit.distance = 0.5 * (a.second + b.second);
}

/// FitMeasure::sidesOf() two groups of one ball: beads, ions, waters.
double sidesOfSpheres(const Ball& first, const Ball& second, Report::Interface::Fit& fit)
{
    const double apart = (second.center - first.center).length();
    const BuriedCap a = buriedCap(first.radius, second.radius, apart),
                    b = buriedCap(second.radius, first.radius, apart);
    if (a.trimmed > 0.0 && b.trimmed > 0.0)
        setMeans(mediansOf(a, b, apart), mediansOf(b, a, apart), fit);
    fit.contact = {contactOf(a, b, apart), contactOf(b, a, apart)};
    return 0.5 * (areaOf(a) + areaOf(b));
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
    std::vector<Vec3d> open;
    Side side;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (!blocked[i]) {
            open.push_back(all[i].position);
            continue;
        }
        side.buried.push_back(all[i]);
        side.buriedArea += all[i].area;
    }
    side.trimmed = withoutRim(side.buried, PointRuns(open), progress);
    return side;
}

double FitMeasure::sidesOf(const FitSurface& first, const FitSurface& second,
                           const Progress& progress, Report::Interface::Fit& fit)
{
    if (first.balls().size() == 1 && second.balls().size() == 1)
        return sidesOfSpheres(first.balls()[0], second.balls()[0], fit);
    const Side a = sideOf(first, second, progress), b = sideOf(second, first, progress);
    if (!a.trimmed.empty() && !b.trimmed.empty())
        setMeans(mediansOf(a.trimmed, b.trimmed, progress),
                 mediansOf(b.trimmed, a.trimmed, progress), fit);
    fit.contact = {contactOf(a.buried, b.buried, progress),
                   contactOf(b.buried, a.buried, progress)};
    return 0.5 * (a.buriedArea + b.buriedArea);
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
    const double area = sidesOf(first, second, progress, fit);
    if (area > 0.0) fit.gapIndex = fit.gapVolume / area;
    return fit;
}

} // namespace molsurf
