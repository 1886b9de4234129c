// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/interfaces.h"

#include "molsurf/analysis/measures/shape_complementarity.h"
#include "molsurf/kernel/balls/contacts.h"
#include "molsurf/kernel/core/quiet_progress.h"
#include "molsurf/kernel/pipeline/closed_form.h"
#include "molsurf/kernel/pipeline/influence.h"
#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/molecule/selection/subset.h"
#include "molsurf/surface/run.h"
#include "molsurf/surface/whole_run.h"

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

Areas areasOf(const BallSet& atoms, const SurfaceSpec& spec, bool ofBalls, Progress& progress)
{
    if (isClosedForm(spec)) {
        std::vector<double> areas = measureClosedForm(atoms.balls, spec, progress).ballAreas;
        return {std::accumulate(areas.begin(), areas.end(), 0.0), std::move(areas)};
    }
    QuietProgress quiet(progress);
    Products wanted = measuresOfWhole();
    wanted.ballAreas = ofBalls;
    MolecularSurface made = makeUnitSurface(atoms, {spec, wanted}, &quiet);
    return {made.report.surface.area, std::move(made.ballAreas)};
}

/// Areas that two groups bury of each other's balls. As both lists and the balls of `together` are
/// ascending, it steps through the two lists as a merge does.
/// @param[in] groups    indices of their balls, ascending
/// @param[in] alone     areas of each group by itself
/// @param[in] together  of both, the balls in ascending order
/// @param[in] least     change of a ball that counts [Å^2]
std::vector<Report::Interface::Buried>
buriedBalls(const std::array<const std::vector<std::size_t>*, 2>& groups,
            const std::array<const Areas*, 2>& alone, const Areas& together, double least)
{
    std::vector<Report::Interface::Buried> out;
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

std::vector<std::size_t> merged(const std::vector<std::size_t>& a,
                                const std::vector<std::size_t>& b)
{
    std::vector<std::size_t> out;
    std::merge(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
    return out;
}

/// Groups and their images. Group g, moved by motion m of a unit, is the member m * groups + g: the
/// first are the unit's own (motion 0), and without a unit there are no others.
struct Members {
    std::vector<std::int32_t> of;                ///< member of each ball, or -1
    std::vector<std::vector<std::size_t>> balls; ///< of each member
};

Members membersOf(const BallSet& atoms)
{
    const Placement& placement = atoms.placement;
    const std::size_t groups = atoms.labels->groups.size();
    Members out;
    out.of = atoms.labels->groupOf;
    out.balls.resize(placement.order() * groups);
    for (std::size_t i = 0; i < out.of.size(); ++i) {
        if (out.of[i] < 0) continue;
        if (!placement.owns(std::int32_t(i)))
            out.of[i] += placement.motionOf[i] * std::int32_t(groups);
        out.balls[std::size_t(out.of[i])].push_back(i);
    }
    return out;
}

/// The balls without names, which areas do not need: a subset of many groups would copy all.
BallSet withoutNames(const BallSet& atoms)
{
    BallSet bare;
    bare.balls = atoms.balls;
    bare.decays = atoms.decays;
    bare.resolutions = atoms.resolutions;
    bare.resolutionOf = atoms.resolutionOf;
    bare.placement = atoms.placement;
    return bare;
}

} // namespace

void measureInterfaces(const BallSet& atoms, const SurfaceSpec& spec, bool ofBalls,
                       Progress& progress, Report& report)
{
    const Placement& placement = atoms.placement;
    const std::vector<Group>& groups = atoms.labels->groups;
    const std::size_t order = placement.order();
    const Members members = membersOf(atoms);
    const auto near = contacts(atoms.balls, members.of, members.balls.size(),
                               Influence(atoms, spec).acrossGap(), progress);

    std::size_t runs = groups.size(), done = 0;
    for (std::size_t a = 0; a < groups.size(); ++a) runs += near[a].size();
    const auto tick = [&] { progress.update("interfaces", double(done++) / double(runs)); };
    const BallSet bare = withoutNames(atoms);
    const auto measured = [&](const std::vector<std::size_t>& some) {
        return areasOf(subset(bare, some), spec, ofBalls, progress);
    };
    std::map<std::size_t, Areas> alone;
    const auto aloneOf = [&](std::size_t member) -> const Areas& {
        const auto [found, isNew] = alone.emplace(member, Areas());
        if (isNew) found->second = measured(members.balls[member]);
        return found->second;
    };
    for (std::size_t g = 0; g < groups.size(); ++g) {
        tick();
        if (order == 1 && !members.balls[g].empty()) report.groups[g].aloneArea = aloneOf(g).total;
    }
    for (std::size_t a = 0; a < groups.size(); ++a) {
        for (const std::int32_t other : near[a]) {
            tick();
            const std::size_t member = std::size_t(other), m = member / groups.size(),
                              b = member % groups.size();
            // Group a and image m of b are, by the inverse motion, b and image `back` of a: only
            // one of the two counts. If they are the same the pair mirrors itself, and the whole
            // has it half as often.
            const std::size_t back = m == 0 ? 0 : placement.unit->inverse[m];
            if (b < a || (b == a && back < m) || member == a) continue;
            const auto &own = members.balls[a], &its = members.balls[member];
            const Areas both = measured(merged(own, its));
            const double area = (aloneOf(a).total + aloneOf(member).total - both.total) / 2.0;
            if (area < noticeable) continue; // what buries nothing is no interface
            const bool mirrored = b == a && back == m;
            Report::Interface& found = report.interfaces.emplace_back();
            found.first = groups[a].name;
            found.second = groups[b].name;
            if (m != 0) found.second += " of unit " + placement.instances[m].name;
            found.area = area;
            found.count = mirrored ? order / 2 : order;
            found.fit = fitOf(subset(bare, own).balls, subset(bare, its).balls, progress);
            if (ofBalls && order == 1)
                found.buried = buriedBalls({&own, &its}, {&aloneOf(a), &aloneOf(member)}, both,
                                           isClosedForm(spec) ? rounding : noticeable);
        }
    }
}

} // namespace molsurf
