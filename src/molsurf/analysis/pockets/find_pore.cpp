// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/pockets/find_pore.h"

#include "molsurf/analysis/pockets/clearance.h"
#include "molsurf/analysis/pockets/pore_ways.h"
#include "molsurf/analysis/pockets/void_graph.h"
#include "molsurf/kernel/balls/ball_index.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/core/strings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace molsurf
{

namespace
{

using openvdb::Vec3d;
using Pore = Report::Pore;

/// Points of a section are so far apart where it is searched [Å]. Each stands for what is within
/// `reach` of it, which is searched exactly.
constexpr double sectionSpacing = 0.25, reach = 0.7072 * sectionSpacing;

/// The points of the way with what decides its sections.
struct Way {
    std::vector<Vec3d> places, tangents;
    std::vector<double> distances; ///< along it [Å]
    std::vector<double> passed;    ///< along the tangents, without what it goes sideways [Å]
};

/// Ends that are known, and the axis.
struct Ends {
    Vec3d from, to, axis;
    bool alongAxis = false; ///< whether sections are at right angles to it wherever the way goes
};

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

/// The place of an end: that itself if no ball holds it; else, of those within 5 Å, the one with
/// the most room, less 0.2 Å for each Å of way.
/// @throws Error(ErrorKind::Input) if a ball holds an end that is a point
Vec3d placeOf(const SearchPlaces::End& end, const std::vector<Ball>& balls,
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
    constexpr double farthest = 20.0; // from the box of the balls: what is beyond is no pore [Å]
    const openvdb::BBoxd box = boxOf(balls);
    Vec3d away;
    for (int i = 0; i < 3; ++i) away[i] = end[i] - std::clamp(end[i], box.min()[i], box.max()[i]);
    if (away.length() > farthest)
        throw Error(ErrorKind::Input,
                    formatted("`pore`: expected ends within %g Å of the molecule, got %s, %.1f Å "
                              "away",
                              farthest, placeText(end).c_str(), away.length()));
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
        // Where the way comes to a height more than once its narrowest place there counts, since
        // the whole way is passed; else that with the most room.
        const double sign = straight ? -1.0 : 1.0;
        double most = -std::numeric_limits<double>::infinity();
        std::optional<Plane> best;
        for (std::size_t i = 1; i < points.size(); ++i) {
            const double a = straight ? points[i - 1].dot(axis) : way.passed[i - 1];
            const double b = straight ? points[i].dot(axis) : way.passed[i];
            if (std::min(a, b) > at + 1e-6 || std::max(a, b) < at - 1e-6) continue;
            const double share = b == a ? 0.0 : std::clamp((at - a) / (b - a), 0.0, 1.0);
            const std::vector<Vec3d>& on = straight ? points : way.places;
            const Vec3d x = on[i - 1] + (on[i] - on[i - 1]) * share;
            const double room = sign * clearance.at(x);
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
    SectionSearch(const Clearance& clearance, const Plane& plane)
        : clearance_(clearance), plane_(plane)
    {
    }

    /// The largest ball that the origin of the plane can go to within it without passing where it
    /// is much narrower: hill climbing to a peak, flood fill down to `level` from there, and the
    /// exact search about each point that may beat the best. That at the origin if it gets away
    /// from all balls so.
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
        std::vector<std::pair<double, Point>> part =
            partAbove(std::max(own, room(at) - narrower), at);
        if (isOpen_) return {plane_.origin, own};
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

    /// Whether it got away from all balls.
    bool isOpen() const { return isOpen_; }

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

    /// Its clearance; without bound below where the search does not go, which is far away.
    double room(const Point& at)
    {
        const auto [found, isNew] = rooms_.emplace(at, 0.0);
        if (!isNew) return found->second;
        const bool far = std::abs(at.first) > limit_ || std::abs(at.second) > limit_;
        found->second =
            far ? -1e30
                : clearance_.at(plane_.at(at.first * sectionSpacing, at.second * sectionSpacing));
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
            isOpen_ = isOpen_ || std::max(std::abs(at.first), std::abs(at.second)) >= limit_;
            for (const Point& next : around(at))
                if (room(next) >= level && seen.emplace(next, true).second) open.push_back(next);
        }
        std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) {
            return a.first != b.first ? a.first > b.first : a.second < b.second;
        });
        return out;
    }

    const Clearance& clearance_;
    const Plane& plane_;
    int limit_ = 1;
    bool isOpen_ = false;
    std::map<Point, double> rooms_;
};

Vec3d normalOf(const Pore::Station& station)
{
    return {station.normal[0], station.normal[1], station.normal[2]};
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

/// The ways along an axis.
struct FoundWays {
    std::vector<VoidWay> ways;
    Ends ends;
};

/// The ways along the axis that has the largest, by sizeOf(): a principal axis, or that of a way
/// from the outside to the outside if it is twice as large. A molecule without symmetry need not
/// have its pore along a principal axis.
FoundWays waysAlongBest(const VoidGraph& graph, const Rooms& rooms, const std::vector<Vec3d>& axes)
{
    constexpr std::size_t others = 3;
    constexpr double advantage = 2.0;
    FoundWays out;
    double best = 0.0;
    const auto tryAxis = [&](const Vec3d& along, double factor) {
        std::vector<VoidWay> ways = waysThrough(graph, rooms, along, Pore::leastWater);
        if (ways.empty()) return;
        const double size = sizeOf(ways.front().clearance, ways.front().length) / factor;
        if (size <= best) return;
        best = size;
        out.ends = {Vec3d(0.0), Vec3d(0.0), along, true};
        out.ways = std::move(ways);
    };
    for (const Vec3d& axis : axes) tryAxis(axis, 1.0);
    for (const Vec3d& axis : likelyAxes(graph, others)) tryAxis(axis, advantage);
    return out;
}

/// The ways through the molecule along an axis; along the best of the principal ones if it is 0.
FoundWays waysAlong(const std::vector<Ball>& balls, const Vec3d& axis, const Progress& progress)
{
    const bool given = axis.lengthSqr() > 0.0;
    constexpr double narrow = 0.5; // what is narrower are gaps between atoms that touch [Å]
    const VoidGraph graph = voidGraph(balls, narrow, {}, progress);
    const Rooms rooms = roomsOf(graph);
    FoundWays out;
    if (given) {
        out.ways = waysThrough(graph, rooms, axis, Pore::leastWater);
        out.ends = {Vec3d(0.0), Vec3d(0.0), axis, true};
    } else {
        out = waysAlongBest(graph, rooms, principalAxes(balls));
    }
    if (!out.ways.empty()) return out;
    const std::string where = given ? "along this axis" : "along any axis";
    throw Error(ErrorKind::Input, "`pore`: expected a way through the molecule " + where +
                                      ", found none [hint: its ends, as `pore` 'X,Y,Z -> X,Y,Z', "
                                      "find closed ones, too]");
}

/// The way between two ends, the graph being made as far below 0 as it needs.
FoundWays waysBetweenEnds(const std::vector<Ball>& balls, const std::array<Vec3d, 2>& ends,
                          const Progress& progress)
{
    constexpr double step = 0.5; // [Å]
    double least = std::numeric_limits<double>::infinity();
    for (const Ball& ball : balls) least = std::min(least, ball.radius);
    FoundWays out{{}, {ends[0], ends[1], (ends[1] - ends[0]).unit(), false}};
    // Between ends in clefts of the outside it is a way along these.
    for (const bool alongClefts : {false, true})
        for (double floor = 0.0; floor > -least; floor -= step) {
            const VoidGraph graph = voidGraph(balls, floor, {ends[0], ends[1]}, progress);
            out.ways = waysBetween(graph, alongClefts ? everyNode(graph) : roomsOf(graph), ends);
            if (!out.ways.empty()) return out;
        }
    throw Error(ErrorKind::Input, "`pore`: expected a way through the molecule from " +
                                      placeText(ends[0]) + " to " + placeText(ends[1]) +
                                      ", found none that is not outside [hint: ends where atoms "
                                      "are on all sides, or in front of the mouths]");
}

/// Adds the narrowest place of a way if no station is as narrow: the way may cross a section there
/// at an angle.
void addNarrowest(const Clearance& clearance, const VoidWay& way, std::vector<Pore::Station>& to)
{
    if (!std::isfinite(way.clearance)) return;
    const auto neck = clearance.neckNear(way.narrowest, 1e-3, way.clearance + 1e-3);
    const FittedBall ball = neck ? *neck : FittedBall{way.narrowest, way.clearance};
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < to.size(); ++i) {
        if (to[i].radius <= ball.radius + 1e-6) return;
        if ((placeOf(to[i]) - ball.place).length() < (placeOf(to[nearest]) - ball.place).length())
            nearest = i;
    }
    Pore::Station station = stationOf(ball, normalOf(to[nearest]));
    const bool after = (ball.place - placeOf(to[nearest])).dot(normalOf(to[nearest])) > 0.0;
    to.insert(to.begin() + std::ptrdiff_t(nearest + after), station);
}

/// The sections of a way.
/// @param[in] ends  those of the way; with Ends::alongAxis what opens at both ends is left out
Pore poreOf(const Clearance& clearance, const VoidWay& way, const Ends& ends,
            const Progress& progress)
{
    std::vector<Vec3d> points;
    for (const VoidPoint& point : way.points) points.push_back(point.place);
    const std::vector<Plane> planes = sectionsOf(points, ends, clearance);
    std::vector<Pore::Station> stations(planes.size());
    std::vector<char> open(planes.size(), 0);
    parallelFor(planes.size(), progress, [&](std::size_t i) {
        SectionSearch search(clearance, planes[i]);
        stations[i] = stationOf(search.widest(), planes[i].normal);
        open[i] = search.isOpen();
    });
    const auto isClosed = [](char o) { return o == 0; };
    if (ends.alongAxis && std::any_of(open.begin(), open.end(), isClosed)) {
        const auto first = std::find(open.begin(), open.end(), 0) - open.begin(),
                   last = std::find(open.rbegin(), open.rend(), 0) - open.rbegin();
        stations.erase(stations.end() - last, stations.end());
        stations.erase(stations.begin(), stations.begin() + first);
    }
    addNarrowest(clearance, way, stations);
    addNecks(clearance, stations);
    Pore out;
    out.stations = std::move(stations);
    for (std::size_t i = 0; i < 3; ++i) out.axis[i] = ends.axis[int(i)];
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
        addLining(clearance, station);
    }
    return out;
}

/// The share of the height of the molecule along the axis between the ends of a pore.
double crossedBy(const std::vector<Ball>& balls, const Pore& pore)
{
    const Vec3d axis(pore.axis[0], pore.axis[1], pore.axis[2]);
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Ball& ball : balls) {
        low = std::min(low, ball.center.dot(axis) - ball.radius);
        high = std::max(high, ball.center.dot(axis) + ball.radius);
    }
    const double from = placeOf(pore.stations.front()).dot(axis),
                 to = placeOf(pore.stations.back()).dot(axis);
    return std::clamp((std::min(to, high) - std::max(from, low)) / (high - low), 0.0, 1.0);
}

} // namespace

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

std::string placeText(const Vec3d& x)
{
    return formatted("(%.2f, %.2f, %.2f)", x[0], x[1], x[2]);
}

std::vector<std::size_t> necksOf(const std::vector<Pore::Station>& stations)
{
    constexpr double leastNeck = 0.1; // [Å]
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

void addLining(const Clearance& clearance, Pore::Station& station)
{
    for (const std::int32_t ball : clearance.nearest(placeOf(station), liningReach))
        station.lining.push_back(std::size_t(ball));
}

Pore findPore(const std::vector<Ball>& balls, const SearchPlaces::PoreWay& asked,
              const Progress& progress)
{
    const Clearance clearance(balls);
    FoundWays found;
    if (asked.ends.empty()) {
        found = waysAlong(balls, asked.axis, progress);
    } else {
        for (const SearchPlaces::End& end : asked.ends) checkNear(end.place, balls);
        found = waysBetweenEnds(
            balls,
            {placeOf(asked.ends[0], balls, clearance), placeOf(asked.ends[1], balls, clearance)},
            progress);
    }
    Pore out = poreOf(clearance, found.ways.front(), found.ends, progress);
    out.crossed = crossedBy(balls, out);
    constexpr double asWide = 0.95; // the pores of an oligomer, which are not quite the same
    for (std::size_t i = 1; i < found.ways.size(); ++i) {
        const VoidWay& way = found.ways[i];
        if (way.clearance < asWide * found.ways.front().clearance) {
            out.others.push_back(
                {way.clearance, {way.narrowest[0], way.narrowest[1], way.narrowest[2]}});
            continue;
        }
        out.bundle.push_back(poreOf(clearance, way, found.ends, progress));
        out.bundle.back().crossed = crossedBy(balls, out.bundle.back());
    }
    return out;
}

} // namespace molsurf
