// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/topology/closed_passages.h"

#include "molsurf/kernel/core/disjoint_sets.h"
#include "molsurf/kernel/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <set>

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
std::vector<std::size_t> poresOf(const std::vector<Closed>& points, const PassageField& field,
                                 const Progress& progress)
{
    constexpr double farthest = 8.0; // points that are tried as neighbours in a pore [Å]
    DisjointSets pores(points.size());
    parallelFor(points.size(), progress, [&](std::size_t i) {
        const Vec3d& x = points[i].gap.place;
        for (std::size_t j = i; j-- > 0;) {
            const Vec3d& y = points[j].gap.place;
            if (x.x() - y.x() > farthest) break;
            const auto a = std::uint32_t(i), b = std::uint32_t(j);
            const double level = std::min(points[i].level, points[j].level);
            if (pores.find(a) == pores.find(b) || (x - y).length() > farthest) continue;
            if (inOnePore(x, y, level, field)) pores.join(a, b);
        }
    });
    std::vector<std::size_t> pore(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) pore[i] = pores.find(std::uint32_t(i));
    return pore;
}

/// How many times smaller the tolerance has to be for a point to be open: bisection of the
/// logarithm between 1 and `most`, to 2 %.
/// @return `most` if the point is closed up to there
double timesToOpen(const Vec3d& place, const PassageField& field, const GapRule& rule)
{
    constexpr double most = 64.0;
    constexpr int bisections = 8;
    const auto isOpen = [&](double times) {
        const auto gap = gapAt(place, field.sharpened(place, times));
        return gap && gap->psi < gap->closedAbove(rule.gradient, rule.area);
    };
    double low = 1.0, high = most;
    for (int i = 0; i < bisections; ++i) {
        const double middle = std::sqrt(low * high);
        (isOpen(middle) ? high : low) = middle;
    }
    return high;
}

} // namespace

std::vector<ClosedPassage> closedPassages(const std::vector<Gap>& gaps, const PassageField& field,
                                          const GapRule& rule, double epsilon,
                                          const Progress& progress)
{
    const auto points =
        parallelCollect<Closed>(gaps.size(), progress, [&](std::size_t i, auto& some) {
            const double level = gaps[i].closedAbove(rule.gradient, rule.area);
            const double room = gaps[i].psi > level ? field.room(gaps[i].place) : 0.0;
            if (room > 0.0) some.push_back({gaps[i], room, level});
        });
    const std::vector<std::size_t> pores = poresOf(points, field, progress);
    std::vector<ClosedPassage> out(points.size());
    parallelFor(points.size(), progress, [&](std::size_t i) {
        const double times = timesToOpen(points[i].gap.place, field, rule);
        out[i] = {points[i].gap.place, points[i].room, epsilon / times, pores[i]};
    });
    return out;
}

void countClosed(const std::vector<ClosedPassage>& passages,
                 const std::function<bool(const Vec3d&)>& isClosed, GapReport& report)
{
    std::vector<ClosedPassage> closed;
    std::copy_if(passages.begin(), passages.end(), std::back_inserter(closed),
                 [&](const ClosedPassage& p) { return isClosed(p.place); });
    std::set<std::size_t> pores;
    for (const ClosedPassage& passage : closed) pores.insert(passage.pore);
    report.closedByField = pores.size();
    if (closed.empty()) return;
    const auto narrower = [](const auto& a, const auto& b) { return a.room < b.room; };
    const ClosedPassage widest = *std::max_element(closed.begin(), closed.end(), narrower);
    report.widestClosed = widest.room;
    constexpr double about = 0.8; // a narrower neck may stay closed
    report.opensBelow = widest.opensBelow;
    for (const ClosedPassage& passage : closed)
        if (passage.pore == widest.pore && passage.room > about * widest.room)
            report.opensBelow = std::min(report.opensBelow, passage.opensBelow);
}

} // namespace molsurf
