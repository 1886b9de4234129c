// SPDX-License-Identifier: MPL-2.0
#include "molsurf/topology/closed_passages.h"

#include "molsurf/core/disjoint_sets.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

/// A critical point that the field closes.
struct Closed {
    Gap gap;
    double room;  ///< [Å], > 0
    double level; ///< psi is above it: Gap::closedAbove()
};

/// Whether a gap that the field closes is open in a surface that lies `inset` inside of the
/// interface: this is within so much of it.
/// @param[in] level  the interface may lie that low where tension closes the gap
bool isOpenInside(const Gap& gap, double level, double inset, const PassageField& field)
{
    if (inset <= 0.0) return false;
    const double interface = gap.psi > 0.0 ? 0.0 : level; // psi of it
    constexpr int directions = 64;                        // 0.5 Å apart at 1.4 Å
    const double turn = M_PI * (3.0 - std::sqrt(5.0));    // the golden angle
    for (int i = 0; i < directions; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / directions, r = std::sqrt(1.0 - z * z);
        const Vec3d way(r * std::cos(turn * i), r * std::sin(turn * i), z);
        for (const double share : {1.0, 0.6})
            if (field.jet(gap.place + share * inset * way).psi <= interface) return true;
    }
    return false;
}

/// Whether no ball lies between two points, and psi is above a level there.
bool inOnePore(const Vec3d& a, const Vec3d& b, double level, const PassageField& field)
{
    constexpr double step = 0.1; // [Å]
    const int steps = int(std::ceil((b - a).length() / step));
    for (int i = 1; i < steps; ++i) {
        const Vec3d x = a + (b - a) * (double(i) / steps);
        if (field.room(x) <= 0.0 || field.jet(x).psi <= level) return false;
    }
    return true;
}

/// Union-find of points in one pore: of each point the first of its pore.
/// @param[in] points  ascending by x
std::vector<std::size_t> poresOf(const std::vector<Closed>& points, const PassageField& field)
{
    constexpr double farthest = 8.0; // points that are tried as neighbours in a pore [Å]
    DisjointSets pores(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3d& x = points[i].gap.place;
        for (std::size_t j = i; j-- > 0;) {
            const Vec3d& y = points[j].gap.place;
            if (x.x() - y.x() > farthest) break;
            const auto a = std::uint32_t(i), b = std::uint32_t(j);
            const double level = std::min(points[i].level, points[j].level);
            if (pores.find(a) == pores.find(b) || (x - y).length() > farthest) continue;
            if (inOnePore(x, y, level, field)) pores.join(a, b);
        }
    }
    std::vector<std::size_t> pore(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) pore[i] = pores.find(std::uint32_t(i));
    return pore;
}

/// How many times smaller the tolerance has to be for a point to be open: bisection of the
/// logarithm between 1 and `most` to a ratio of `finest`.
/// @return about `most` if the point is closed up to there
double timesToOpen(const Vec3d& place, const PassageField& field, const GapRule& rule)
{
    constexpr double most = 64.0, finest = 1.02;
    const auto isOpen = [&](double times) {
        const auto gap = gapAt(place, field.sharpened(place, times));
        return gap && gap->psi < gap->closedAbove(rule.gradient, rule.area);
    };
    double low = 1.0, high = most;
    while (high / low > finest) {
        const double middle = std::sqrt(low * high);
        (isOpen(middle) ? high : low) = middle;
    }
    return high;
}

} // namespace

void countClosedByField(const std::vector<Gap>& gaps, const PassageField& field,
                        const GapRule& rule, double epsilon, GapReport& report)
{
    std::vector<Closed> points;
    for (const Gap& gap : gaps) {
        const double level = gap.closedAbove(rule.gradient, rule.area);
        const double room = gap.psi > level ? field.room(gap.place) : 0.0;
        if (room <= 0.0 || isOpenInside(gap, level, rule.inset, field)) continue;
        points.push_back({gap, room, level});
    }
    const std::vector<std::size_t> pores = poresOf(points, field);
    std::size_t count = 0, widest = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        count += pores[i] == i;
        if (points[i].room > points[widest].room) widest = i;
    }
    report.closedByField = count;
    if (count == 0) return;
    report.widestClosed = points[widest].room;
    constexpr double about = 0.8; // a narrower neck may stay closed
    double times = 1.0;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (pores[i] == pores[widest] && points[i].room > about * points[widest].room)
            times = std::max(times, timesToOpen(points[i].gap.place, field, rule));
    report.opensBelow = epsilon / times;
}

} // namespace molsurf
