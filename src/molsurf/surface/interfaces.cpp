// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/interfaces.h"

#include "molsurf/balls/contacts.h"
#include "molsurf/core/quiet_progress.h"
#include "molsurf/selection/subset.h"
#include "molsurf/surface/closed_form.h"
#include "molsurf/surface/influence.h"
#include "molsurf/surface/parts.h"
#include "molsurf/surface/surface_kind.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <vector>

namespace molsurf
{

namespace
{

/// A surface of some balls, by the balls that its parts belong to.
struct Areas {
    double total = 0.0;
    std::vector<double> ofBalls; ///< in closed form, or if the options ask for them; else empty
};

Areas areasOf(const BallSet& atoms, const SurfaceOptions& options, Progress& progress)
{
    if (isClosedForm(options)) {
        std::vector<double> areas = measureClosedForm(atoms.balls, options, progress).ballAreas;
        return {std::accumulate(areas.begin(), areas.end(), 0.0), std::move(areas)};
    }
    QuietProgress quiet(progress);
    MolecularSurface made = makeSurface(atoms, options, &quiet);
    return {made.report.surface.area, std::move(made.ballAreas)};
}

/// What two groups bury of each other's balls.
/// @param[in] groups    indices of their balls, ascending
/// @param[in] alone     areas of each group alone
/// @param[in] together  of both, the balls in ascending order
/// @param[in] least     change of a ball that counts [Å^2]
std::vector<InterfaceReport::Buried>
buriedBalls(const std::array<const std::vector<std::size_t>*, 2>& groups,
            const std::array<const Areas*, 2>& alone, const Areas& together, double least)
{
    std::vector<InterfaceReport::Buried> out;
    std::array<std::size_t, 2> next = {0, 0};
    for (const double area : together.ofBalls) {
        const auto atEnd = [&](std::size_t g) { return next[g] == groups[g]->size(); };
        const std::size_t g =
            atEnd(0) || (!atEnd(1) && (*groups[1])[next[1]] < (*groups[0])[next[0]]) ? 1 : 0;
        const double before = alone[g]->ofBalls[next[g]];
        if (std::abs(before - area) > least)
            out.push_back({(*groups[g])[next[g]], g == 0, before, area});
        ++next[g];
    }
    return out;
}

constexpr double noticeable = 0.005; // [Å^2]
constexpr double rounding = 1e-10;   // of an area in closed form [Å^2]

SurfaceOptions plainOptions(const SurfaceOptions& options)
{
    SurfaceOptions plain = options;
    plain.interfaces = plain.split = false;
    plain.surfaceOf.clear();
    plain.fields.clear();
    plain.color = ColorBy::Nothing;
    plain.curvatureTotals = plain.contacts = false;
    plain.grid = true;
    return plain;
}

std::vector<std::size_t> merged(const std::vector<std::size_t>& a,
                                const std::vector<std::size_t>& b)
{
    std::vector<std::size_t> out;
    std::merge(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
    return out;
}

/// The same of a whole that follows from a unit: the pairs of a group of the unit with another one,
/// or with an image. An image is there as far as the unit feels it; what is missing changes both
/// areas alike.
void measureUnitInterfaces(const BallSet& atoms, const SurfaceOptions& options, Progress& progress,
                           Report& report)
{
    const Placement& placement = atoms.placement;
    const SymmetricUnit& unit = *placement.unit;
    const std::size_t order = placement.order(), groups = atoms.labels->groups.size();
    const SurfaceOptions plain = plainOptions(options);
    BallSet balls = atoms;
    balls.placement = {};
    // Groups motion by motion: those of the unit come first.
    std::vector<std::int32_t> memberOf(balls.balls.size(), -1);
    std::vector<std::vector<std::size_t>> members(order * groups);
    for (std::size_t i = 0; i < memberOf.size(); ++i) {
        const std::int32_t g = balls.labels->groupOf[i];
        if (g < 0) continue;
        memberOf[i] = placement.motionOf[i] * std::int32_t(groups) + g;
        members[std::size_t(memberOf[i])].push_back(i);
    }
    const auto near = contacts(balls.balls, memberOf, members.size(),
                               Influence(balls, plain).acrossGap(), progress);
    std::size_t runs = 0, done = 0;
    for (std::size_t a = 0; a < groups; ++a) runs += near[a].size();
    std::map<std::size_t, double> alone;
    const auto aloneOf = [&](std::size_t member) {
        const auto [found, isNew] = alone.emplace(member, 0.0);
        if (isNew) found->second = areasOf(subset(balls, members[member]), plain, progress).total;
        return found->second;
    };
    for (std::size_t a = 0; a < groups; ++a) {
        for (const std::int32_t other : near[a]) {
            progress.update("interfaces", double(done++) / double(runs));
            const std::size_t member = std::size_t(other), m = member / groups, b = member % groups;
            // The inverse motion makes the same pair of b and a.
            const std::size_t back = unit.inverse[m];
            if (b < a || (b == a && back < m) || member == a) continue;
            const double both =
                areasOf(subset(balls, merged(members[a], members[member])), plain, progress).total;
            const double area = (aloneOf(a) + aloneOf(member) - both) / 2.0;
            if (area < noticeable) continue;
            const bool mirrored = b == a && back == m;
            std::string name = atoms.labels->groups[b].name;
            if (m != 0) name += " of unit " + placement.instances[m].name;
            report.interfaces.push_back(
                {atoms.labels->groups[a].name, name, area, mirrored ? order / 2 : order, {}});
        }
    }
}

} // namespace

void measureInterfaces(const BallSet& atoms, const SurfaceOptions& options, Progress& progress,
                       Report& report)
{
    if (atoms.placement.unit) return measureUnitInterfaces(atoms, options, progress, report);
    const SurfaceOptions plain = plainOptions(options);
    const BallLabels& labels = *atoms.labels;
    const auto near = contacts(atoms.balls, labels.groupOf, labels.groups.size(),
                               Influence(atoms, options).acrossGap(), progress);
    const auto balls = ballsOfGroups(labels);

    std::size_t runs = labels.groups.size(), done = 0;
    for (const auto& n : near) runs += n.size(); // twice the pairs
    const auto tick = [&](std::size_t count) {
        progress.update("interfaces", double(done) / double(runs));
        done += count;
    };
    std::vector<Areas> alone(labels.groups.size());
    for (std::size_t g = 0; g < alone.size(); ++g) {
        tick(1);
        if (balls[g].empty()) continue;
        alone[g] = areasOf(subset(atoms, balls[g]), plain, progress);
        report.groups[g].aloneArea = alone[g].total;
    }
    for (std::size_t a = 0; a < near.size(); ++a) {
        for (const std::int32_t other : near[a]) {
            const auto b = std::size_t(other);
            if (b <= a) continue;
            tick(2);
            const Areas both = areasOf(subset(atoms, merged(balls[a], balls[b])), plain, progress);
            const double area = (alone[a].total + alone[b].total - both.total) / 2.0;
            if (area < noticeable) continue; // what buries nothing is no interface
            InterfaceReport& found = report.interfaces.emplace_back();
            found.first = labels.groups[a].name;
            found.second = labels.groups[b].name;
            found.area = area;
            if (options.ballAreas)
                found.buried = buriedBalls({&balls[a], &balls[b]}, {&alone[a], &alone[b]}, both,
                                           isClosedForm(options) ? rounding : noticeable);
        }
    }
}

} // namespace molsurf
