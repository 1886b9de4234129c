// SPDX-License-Identifier: MPL-2.0
#include "molsurf/pockets/find_pore.h"

#include "molsurf/balls/ball_index.h"
#include "molsurf/core/parallel.h"
#include "molsurf/core/words.h"
#include "molsurf/pockets/clearance.h"
#include "molsurf/pockets/pore_grid.h"
#include "molsurf/pockets/pore_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace molsurf
{

namespace
{

using openvdb::Vec3d;
using Pore = Report::Pore;

/// Points of the lattice are so far apart, or farther where there would be too many [Å].
constexpr double finest = 0.3, coarse = 0.5;
constexpr double mostCells = 2e7; // 350 MB with what the search needs

/// Walls that enclose a pore between given ends are no farther from its axis than this [Å].
constexpr double widest = 40.0;

/// A place is near an end within this, or this share of the way [Å].
constexpr double nearEnd = 10.0, nearShare = 0.3;

/// Points of a section are so far apart where it is searched [Å]. Each stands for what is within
/// `reach` of it, which is searched exactly.
constexpr double sectionSpacing = 0.25, reach = 0.7072 * sectionSpacing;

/// A bottleneck is narrower than the way on both sides of it by this at least [Å].
constexpr double leastNeck = 0.1;

/// Balls line a pore within this [Å].
constexpr double liningReach = 1.0;

std::string placeText(const Vec3d& x)
{
    return formatted("(%.2f, %.2f, %.2f)", x[0], x[1], x[2]);
}

/// The points of the way with what decides its sections.
struct Way {
    std::vector<Vec3d> places, tangents;
    std::vector<double> distances; ///< along it [Å]
    std::vector<double> passed;    ///< along the tangents, without what it goes sideways [Å]
};

/// The extent of a lattice along an axis that holds all balls.
PoreGrid::Extent extentOf(const std::vector<Ball>& balls, const Vec3d& axis, double spacing)
{
    const auto frame = PoreGrid::frameOf(axis);
    PoreGrid::Extent out{axis, Vec3d(1e30), Vec3d(-1e30), spacing};
    for (const Ball& ball : balls)
        for (int i = 0; i < 3; ++i) {
            const double at = ball.center.dot(frame[std::size_t(i)]);
            out.low[i] = std::min(out.low[i], at - ball.radius);
            out.high[i] = std::max(out.high[i], at + ball.radius);
        }
    return out;
}

void limitCells(PoreGrid::Extent& extent)
{
    const Vec3d size = extent.high - extent.low;
    extent.spacing = std::max(extent.spacing, std::cbrt(size[0] * size[1] * size[2] / mostCells));
}

/// Ends that are known, and the axis.
struct Ends {
    Vec3d from, to, axis;
    bool alongAxis = false; ///< whether sections are at right angles to it wherever the way goes
};

/// The lattice between two ends.
PoreGrid gridBetween(const std::vector<Ball>& balls, const Ends& ends, const Progress& progress)
{
    constexpr double beyond = 3.0; // the ends, along the axis [Å]
    const auto frame = PoreGrid::frameOf(ends.axis);
    PoreGrid::Extent extent = extentOf(balls, ends.axis, finest);
    for (int i = 0; i < 3; ++i) {
        const double a = ends.from.dot(frame[std::size_t(i)]);
        const double b = ends.to.dot(frame[std::size_t(i)]);
        const double margin = i == 2 ? beyond : widest;
        extent.low[i] =
            std::min(std::max(extent.low[i], std::min(a, b) - margin), std::min(a, b) - beyond);
        extent.high[i] =
            std::max(std::min(extent.high[i], std::max(a, b) + margin), std::max(a, b) + beyond);
    }
    limitCells(extent);
    return PoreGrid(balls, extent, progress);
}

/// The principal axes of the centres, the longest first.
std::vector<Vec3d> principalAxes(const std::vector<Ball>& balls)
{
    Vec3d middle(0.0);
    for (const Ball& ball : balls) middle += ball.center / double(balls.size());
    openvdb::Mat3d spread = openvdb::Mat3d::zero();
    for (const Ball& ball : balls) {
        const Vec3d d = ball.center - middle;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) spread(i, j) += d[i] * d[j];
    }
    openvdb::Mat3d axes;
    Vec3d size;
    openvdb::math::diagonalizeSymmetricMatrix(spread, axes, size);
    std::vector<std::pair<double, Vec3d>> sorted;
    for (int i = 0; i < 3; ++i) sorted.emplace_back(size[i], axes.col(i).unit());
    std::sort(sorted.begin(), sorted.end(),
              [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<Vec3d> out;
    for (const auto& one : sorted) out.push_back(one.second);
    return out;
}

/// The ends of the widest way through the molecule, along an axis or one of the principal ones.
Ends endsThrough(const std::vector<Ball>& balls, const Vec3d& axis, const Progress& progress)
{
    const bool given = axis.lengthSqr() > 0.0;
    const std::vector<Vec3d> axes = given ? std::vector<Vec3d>{axis} : principalAxes(balls);
    std::optional<Ends> best;
    constexpr double beyond = 2.0; // the molecule, where nothing is enclosed [Å]
    double least = 0.5;            // share of the height that a way may lack
    for (const Vec3d& along : axes) {
        PoreGrid::Extent extent = extentOf(balls, along, coarse);
        const double height = extent.high[2] - extent.low[2];
        extent.low[2] -= beyond;
        extent.high[2] += beyond;
        limitCells(extent);
        const PoreGrid grid(balls, extent, progress);
        const auto path = throughPath(grid, progress);
        constexpr double shortest = 0.4; // share of the height, of a way through
        if (!path || path->cost - 2.0 * beyond >= least * height ||
            grid.height(path->cells.back()) - grid.height(path->cells.front()) < shortest * height)
            continue;
        least = (path->cost - 2.0 * beyond) / height;
        best = Ends{grid.place(path->cells.front()), grid.place(path->cells.back()), along, true};
    }
    if (best) return *best;
    const std::string where = given ? "along this axis" : "along a principal axis";
    throw Error(ErrorKind::Input, "`pore`: expected a way through the molecule " + where +
                                      ", found none [hint: its ends, as `pore` 'X,Y,Z -> X,Y,Z', "
                                      "find closed ones, too]");
}

/// The place of an end: that itself if no ball holds it; else, of those within 5 Å, the one with
/// the most room, less 0.2 Å for each Å of way.
/// @throws Error(ErrorKind::Input) if a ball holds an end that is a point
Vec3d placeOf(const BallSet::PoreWay::End& end, const std::vector<Ball>& balls,
              const Clearance& clearance)
{
    const double room = clearance.at(end.place);
    if (room >= 0.0) return end.place;
    if (end.isPoint) {
        const std::size_t ball = std::size_t(clearance.nearest(end.place, 0.0).front());
        throw Error(ErrorKind::Input,
                    formatted("`pore`: expected an end beside the atoms, got %s, %.2f Å inside of "
                              "atom_id %d",
                              placeText(end.place).c_str(), -room, balls[ball].atom));
    }
    constexpr int steps = 10;
    constexpr double apart = 0.5; // [Å]
    Vec3d best = end.place;
    double most = room;
    for (int x = -steps; x <= steps; ++x)
        for (int y = -steps; y <= steps; ++y)
            for (int z = -steps; z <= steps; ++z) {
                const Vec3d way = Vec3d(x, y, z) * apart;
                if (way.length() > steps * apart) continue;
                const double there = clearance.at(end.place + way) - 0.2 * way.length();
                if (there <= most) continue;
                most = there;
                best = end.place + way;
            }
    return best;
}

/// @throws Error(ErrorKind::Input) if an end is far from the balls
void checkNear(const Vec3d& end, const std::vector<Ball>& balls)
{
    // Nothing encloses a way beyond the box, which is refused there when it is found, after a
    // search that takes the longer the farther the ends are.
    // measured: 1grm.pdb.gz --pore '0,D,3 -> 0,-D,3' takes 1.3 s for D = 20, 18 s for 50
    constexpr double farthest = nearEnd + 10.0; // from the box of the balls [Å]
    const openvdb::BBoxd box = boxOf(balls);
    Vec3d away;
    for (int i = 0; i < 3; ++i) away[i] = end[i] - std::clamp(end[i], box.min()[i], box.max()[i]);
    if (away.length() > farthest)
        throw Error(ErrorKind::Input,
                    formatted("`pore`: expected ends within %g Å of the molecule, got %s, %.1f Å "
                              "away",
                              farthest, placeText(end).c_str(), away.length()));
}

Ends endsOf(const BallSet::PoreWay& way, const std::vector<Ball>& balls, const Clearance& clearance,
            const Progress& progress)
{
    if (way.ends.empty()) return endsThrough(balls, way.axis, progress);
    for (const BallSet::PoreWay::End& end : way.ends) checkNear(end.place, balls);
    Ends ends = {placeOf(way.ends[0], balls, clearance), placeOf(way.ends[1], balls, clearance),
                 Vec3d(0.0)};
    ends.axis = (ends.to - ends.from).unit();
    return ends;
}

/// Cosine of the angle by which a way that follows a direction may turn away from it.
constexpr double leastCosine = 0.5;

/// Where a way from an end beside the middle of a pore has come to the middle: as long as it climbs
/// to more room as a way straight to it does.
/// @param[in] distances  of its points from the end [Å]
std::size_t climbFrom(const std::vector<Vec3d>& points, const std::vector<double>& distances,
                      const Clearance& clearance)
{
    constexpr double slack = 0.25; // of room, for points that lie on a lattice [Å]
    const double room = clearance.at(points.front());
    std::size_t end = 0;
    while (end + 1 < points.size() &&
           clearance.at(points[end + 1]) + slack >= room + leastCosine * distances[end + 1])
        ++end;
    return end;
}

/// Gives the points of the first part of a way the direction that it has after it: an end beside
/// the middle of a pore does not turn the sections there.
/// @param[in] distances  of its points from this end [Å]
void turnEnd(const std::vector<Vec3d>& points, const std::vector<double>& distances, double half,
             const Clearance& clearance, std::vector<Vec3d>& tangents)
{
    const double climb = distances[climbFrom(points, distances, clearance)];
    const double till = std::min(climb + half, 0.5 * distances.back());
    std::size_t i = 0;
    while (distances[i] < till) ++i;
    std::fill_n(tangents.begin(), i, tangents[i]);
}

/// Turns the sections at both ends.
void turnEnds(const std::vector<Vec3d>& points, double half, const Clearance& clearance, Way& way)
{
    turnEnd(points, way.distances, half, clearance, way.tangents);
    std::vector<Vec3d> back(points.rbegin(), points.rend());
    std::vector<double> distances;
    for (std::size_t i = points.size(); i-- > 0;)
        distances.push_back(way.distances.back() - way.distances[i]);
    std::reverse(way.tangents.begin(), way.tangents.end());
    turnEnd(back, distances, half, clearance, way.tangents);
    std::reverse(way.tangents.begin(), way.tangents.end());
}

/// A way in even steps, smoothed over 1 Å, with its directions over 4 Å.
Way smoothed(const std::vector<Vec3d>& points, const Clearance& clearance)
{
    constexpr double over = 2.0; // half of what a direction is of [Å]
    Way out;
    out.places = points;
    out.distances = {0.0};
    for (std::size_t i = 1; i < points.size(); ++i)
        out.distances.push_back(out.distances.back() + (points[i] - points[i - 1]).length());
    const auto window = [&](std::size_t i, double half) {
        std::size_t begin = i, end = i;
        while (begin > 0 && out.distances[i] - out.distances[begin - 1] <= half) --begin;
        while (end + 1 < points.size() && out.distances[end + 1] - out.distances[i] <= half) ++end;
        return std::pair(begin, end);
    };
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto [begin, end] = window(i, 1.0);
        Vec3d sum(0.0);
        for (std::size_t k = begin; k <= end; ++k) sum += points[k];
        out.places[i] = sum / double(end - begin + 1);
        const auto [first, last] = window(i, over);
        Vec3d tangent = points[last] - points[first];
        tangent.normalize();
        out.tangents.push_back(tangent);
    }
    turnEnds(points, over, clearance, out);
    out.passed = {0.0};
    for (std::size_t i = 1; i < points.size(); ++i) {
        const Vec3d tangent = (out.tangents[i - 1] + out.tangents[i]) * 0.5;
        out.passed.push_back(out.passed.back() +
                             std::max((out.places[i] - out.places[i - 1]).dot(tangent), 0.0));
    }
    return out;
}

/// The sections, each with the point of the way in it that has the most room. They are at right
/// angles to the axis, at even heights, if the way follows it everywhere; else to the way, at even
/// steps along it.
std::vector<Plane> sectionsOf(const std::vector<Vec3d>& points, const Ends& ends,
                              const Clearance& clearance)
{
    const Way way = smoothed(points, clearance);
    std::vector<Plane> out;
    const auto follows = [&](const Vec3d& t) { return t.dot(ends.axis) > leastCosine; };
    const Vec3d& axis = ends.axis;
    const bool straight =
        ends.alongAxis || std::all_of(way.tangents.begin(), way.tangents.end(), follows);
    const double begin = straight ? points.front().dot(axis) : 0.0;
    const double end = straight ? points.back().dot(axis) : way.passed.back();
    for (double at = begin; at < end + 1e-6; at += stationSpacing) {
        double most = -std::numeric_limits<double>::infinity();
        std::optional<Plane> best;
        for (std::size_t i = 1; i < points.size(); ++i) {
            const double a = straight ? points[i - 1].dot(axis) : way.passed[i - 1];
            const double b = straight ? points[i].dot(axis) : way.passed[i];
            if (std::min(a, b) > at + 1e-6 || std::max(a, b) < at - 1e-6) continue;
            const double share = b == a ? 0.0 : std::clamp((at - a) / (b - a), 0.0, 1.0);
            const std::vector<Vec3d>& on = straight ? points : way.places;
            const Vec3d x = on[i - 1] + (on[i] - on[i - 1]) * share;
            const double room = clearance.at(x);
            if (room <= most) continue;
            most = room;
            best.emplace(x, straight ? axis : way.tangents[i]);
        }
        if (best) out.push_back(*best);
    }
    return out;
}

/// Searches a section.
class SectionSearch
{
public:
    SectionSearch(const Clearance& clearance, const PoreGrid& grid, const Plane& plane)
        : clearance_(clearance), grid_(grid), plane_(plane)
    {
    }

    /// The largest ball that the origin of the plane can go to within it without passing where it
    /// is much narrower: hill climbing to a peak, flood fill down to `level` from there, and the
    /// exact search about each point that may beat the best.
    FittedBall widest()
    {
        constexpr double narrower = 0.5; // [Å]
        Point at{0, 0};
        const double own = room(at);
        limit_ = int((3.0 + 2.0 * std::max(own, 0.0)) / sectionSpacing);
        for (bool climbs = true; climbs;) {
            climbs = false;
            for (const Point& next : around(at))
                if (room(next) > room(at)) {
                    at = next;
                    climbs = true;
                }
        }
        const double level = std::max(own - 0.5 * grid_.spacing(), room(at) - narrower);
        std::vector<std::pair<double, Point>> part = partAbove(level, at);
        FittedBall best{plane_.at(part.front().second.first * sectionSpacing,
                                  part.front().second.second * sectionSpacing),
                        part.front().first};
        bool held = false;
        for (const auto& [value, point] : part) {
            if (held && value + reach <= best.radius) break;
            const Vec3d x = plane_.at(point.first * sectionSpacing, point.second * sectionSpacing);
            const auto found = clearance_.widestIn(plane_, x, reach);
            if (!found || (held && found->radius <= best.radius)) continue;
            best = *found;
            held = true;
        }
        return best;
    }

private:
    using Point = std::pair<int, int>;

    static std::vector<Point> around(const Point& at)
    {
        std::vector<Point> out;
        for (int i = -1; i <= 1; ++i)
            for (int j = -1; j <= 1; ++j)
                if (i != 0 || j != 0) out.emplace_back(at.first + i, at.second + j);
        return out;
    }

    /// Its clearance; without bound below where the search does not go: far away, and farther than
    /// a little outside of what is enclosed.
    double room(const Point& at)
    {
        const auto [found, isNew] = rooms_.emplace(at, 0.0);
        if (!isNew) return found->second;
        const Vec3d x = plane_.at(at.first * sectionSpacing, at.second * sectionSpacing);
        constexpr int little = int(1.0 / sectionSpacing);
        const bool allowed = std::max(std::abs(at.first), std::abs(at.second)) <= little ||
                             (grid_.covers(x) && grid_.isEnclosed(grid_.nearest(x)));
        const bool far = std::abs(at.first) > limit_ || std::abs(at.second) > limit_;
        found->second = allowed && !far ? clearance_.at(x) : -1e30;
        return found->second;
    }

    /// The points above a level that hang together with one, those with the most room first.
    std::vector<std::pair<double, Point>> partAbove(double level, const Point& from)
    {
        std::vector<Point> open = {from};
        std::map<Point, bool> seen = {{from, true}};
        std::vector<std::pair<double, Point>> out;
        while (!open.empty()) {
            const Point at = open.back();
            open.pop_back();
            out.emplace_back(room(at), at);
            for (const Point& next : around(at))
                if (room(next) >= level && seen.emplace(next, true).second) open.push_back(next);
        }
        std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) {
            return a.first != b.first ? a.first > b.first : a.second < b.second;
        });
        return out;
    }

    const Clearance& clearance_;
    const PoreGrid& grid_;
    const Plane& plane_;
    int limit_ = 1;
    std::map<Point, double> rooms_;
};

Pore::Station stationOf(const FittedBall& ball, const Vec3d& normal)
{
    Pore::Station out;
    for (std::size_t i = 0; i < 3; ++i) {
        out.place[i] = ball.place[int(i)];
        out.normal[i] = normal[int(i)];
    }
    out.radius = ball.radius;
    return out;
}

Vec3d placeOf(const Pore::Station& station)
{
    return {station.place[0], station.place[1], station.place[2]};
}

Vec3d normalOf(const Pore::Station& station)
{
    return {station.normal[0], station.normal[1], station.normal[2]};
}

/// The stations that are narrower than the way on both sides of them, by leastNeck at least, and
/// the narrowest of all.
std::vector<std::size_t> necksOf(const std::vector<Pore::Station>& stations)
{
    std::vector<std::size_t> out;
    const std::size_t n = stations.size();
    for (std::size_t i = 0; i < n; ++i) {
        const double r = stations[i].radius;
        const auto rises = [&](int step) {
            for (std::size_t k = i + std::size_t(step); k < n; k += std::size_t(step)) {
                if (stations[k].radius >= r + leastNeck) return true;
                if (stations[k].radius < r || (step < 0 && stations[k].radius == r)) return false;
            }
            return false;
        };
        if (rises(1) && rises(-1)) out.push_back(i);
    }
    const auto least =
        std::min_element(stations.begin(), stations.end(),
                         [](const auto& a, const auto& b) { return a.radius < b.radius; });
    const std::size_t narrowest = std::size_t(least - stations.begin());
    if (std::count(out.begin(), out.end(), narrowest) == 0) out.push_back(narrowest);
    return out;
}

/// Adds the exact balls of bottlenecks where they lie between stations.
void addNecks(const Clearance& clearance, std::vector<Pore::Station>& stations)
{
    constexpr double within = 0.5;                // of a station [Å]
    constexpr double most = 0.5 * stationSpacing; // narrower than it: f changes as the way does
    std::vector<std::size_t> necks = necksOf(stations);
    std::sort(necks.rbegin(), necks.rend());
    for (const std::size_t i : necks) {
        Pore::Station& station = stations[i];
        const auto neck = clearance.neckNear(placeOf(station), within, station.radius + 1e-9);
        station.isBottleneck = true;
        if (!neck || neck->radius < station.radius - most) continue;
        const Vec3d normal = normalOf(station);
        const double ahead = (neck->place - placeOf(station)).dot(normal);
        if (std::abs(ahead) >= stationSpacing) continue; // another station's
        Pore::Station exact = stationOf(*neck, normal);
        exact.isBottleneck = true;
        if (std::abs(ahead) < 1e-6) {
            station = exact;
            continue;
        }
        station.isBottleneck = false;
        const bool after = ahead > 0.0;
        stations.insert(stations.begin() + std::ptrdiff_t(i + after), exact);
    }
}

/// @throws Error(ErrorKind::Input) if a way is none through the molecule
void checkEnclosed(const PoreGrid& grid, const PorePath& path)
{
    constexpr double mostOutside = 2.0; // [Å]
    const std::string expected = "`pore`: expected a way through the molecule between these ends, ";
    const std::string hint = " [hint: ends where atoms are on all sides]";
    if (path.outside > mostOutside)
        throw Error(ErrorKind::Input, expected + "but the widest leaves it at " +
                                          placeText(grid.place(path.leaves)) + hint);
    const auto isEnclosed = [&](std::size_t cell) { return grid.isEnclosed(cell); };
    if (std::none_of(path.cells.begin(), path.cells.end(), isEnclosed))
        throw Error(ErrorKind::Input, expected + "but atoms enclose no place of it" + hint);
}

} // namespace

Pore findPore(const std::vector<Ball>& balls, const BallSet::PoreWay& asked,
              const Progress& progress)
{
    const Clearance clearance(balls);
    const Ends ends = endsOf(asked, balls, clearance, progress);
    // Ends that are found are enclosed themselves.
    const double near =
        asked.ends.empty() ? 0.0 : std::min(nearEnd, nearShare * (ends.to - ends.from).length());
    const PoreGrid grid = gridBetween(balls, ends, progress);
    const PorePath path = widestPath(grid, grid.nearest(ends.from), grid.nearest(ends.to),
                                     {near, ends.alongAxis}, progress);
    checkEnclosed(grid, path);
    std::vector<Vec3d> points;
    for (const std::size_t cell : path.cells) points.push_back(grid.place(cell));
    points.front() = ends.from;
    points.back() = ends.to;
    const std::vector<Plane> planes = sectionsOf(points, ends, clearance);
    Pore out;
    for (std::size_t i = 0; i < 3; ++i) out.axis[i] = ends.axis[int(i)];
    out.stations.resize(planes.size());
    parallelFor(planes.size(), progress, [&](std::size_t i) {
        SectionSearch search(clearance, grid, planes[i]);
        out.stations[i] = stationOf(search.widest(), planes[i].normal);
    });
    addNecks(clearance, out.stations);
    for (std::size_t i = 0; i < out.stations.size(); ++i) {
        Pore::Station& station = out.stations[i];
        if (i > 0) {
            const Pore::Station& last = out.stations[i - 1];
            station.distance =
                last.distance +
                std::abs(
                    (placeOf(station) - placeOf(last)).dot(normalOf(station) + normalOf(last))) *
                    0.5;
        }
        for (const std::int32_t ball : clearance.nearest(placeOf(station), liningReach))
            station.lining.push_back(std::size_t(ball));
    }
    return out;
}

} // namespace molsurf
