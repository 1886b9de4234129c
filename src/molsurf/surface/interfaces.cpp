// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/interfaces.h"

#include "molsurf/analysis/measures/shape_complementarity.h"
#include "molsurf/kernel/balls/ball_index.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/core/quiet_progress.h"
#include "molsurf/kernel/pipeline/closed_form.h"
#include "molsurf/kernel/pipeline/influence.h"
#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/molecule/selection/subset.h"
#include "molsurf/surface/run.h"
#include "molsurf/surface/whole_run.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
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

/// A ball and how far the surface of the nearest ball of another member is from its own [Å].
struct Facing {
    std::size_t ball;
    double gap;
};

/// Of each member, by the other one: its balls that face that one, ascending.
using FacingBalls = std::vector<std::map<std::int32_t, std::vector<Facing>>>;

/// @param[in] reach  the largest gap that counts [Å]
FacingBalls facingBalls(const std::vector<Ball>& balls, const Members& members, double reach,
                        const Progress& progress)
{
    const BallIndex index(balls, {0.5, 0.0, 4.0});
    using Gap = std::pair<std::int32_t, double>; // to another member
    std::vector<std::vector<Gap>> gaps(balls.size());
    parallelFor(balls.size(), progress, [&](std::size_t i) {
        const std::int32_t own = members.of[i];
        if (own < 0) return;
        const openvdb::Vec3d x(balls[i].center);
        index.forEachNear(x, x, balls[i].radius + reach, [&](const Ball& other, std::int32_t j) {
            const std::int32_t its = members.of[std::size_t(j)];
            if (its < 0 || its == own) return;
            const double gap =
                (openvdb::Vec3d(other.center) - x).length() - balls[i].radius - other.radius;
            if (gap >= reach) return;
            const auto known = std::find_if(gaps[i].begin(), gaps[i].end(),
                                            [&](const Gap& one) { return one.first == its; });
            if (known == gaps[i].end())
                gaps[i].emplace_back(its, gap);
            else
                known->second = std::min(known->second, gap);
        });
    });
    FacingBalls out(members.balls.size());
    for (std::size_t i = 0; i < balls.size(); ++i)
        for (const auto& [other, gap] : gaps[i])
            out[std::size_t(members.of[i])][other].push_back({i, gap});
    return out;
}

/// Those within a gap.
std::vector<std::size_t> within(const std::vector<Facing>& facing, double gap)
{
    std::vector<std::size_t> out;
    for (const Facing& one : facing)
        if (one.gap < gap) out.push_back(one.ball);
    return out;
}

/// Areas of two members together, of the balls that may have others than alone.
struct Changed {
    std::vector<std::size_t> balls; ///< ascending
    std::vector<double> areas;
};

/// How wide a gap between two balls may be across which one changes the area of the other [Å]. A
/// point of a solvent-excluded surface belongs to a probe that rests on the ball, and another probe
/// that the other ball stops may cut that one: their centres are two radii apart at most.
double acrossAreas(const SurfaceSpec& spec)
{
    return 2.0 * (probeOf(spec) + offsetOf(spec));
}

/// Areas in closed form of the balls that face another member, from these and the balls that reach
/// them: an area depends on no others.
class ChangedAreas
{
public:
    ChangedAreas(const std::vector<Ball>& balls, const Members& members, const SurfaceSpec& spec)
        : balls_(balls), members_(members), spec_(spec), index_(balls, {0.5, 0.0, 4.0})
    {
    }

    Changed of(std::size_t a, std::size_t b, std::vector<std::size_t> changed,
               const Progress& progress) const
    {
        std::vector<std::size_t> all = changed;
        for (const std::size_t i : changed) {
            const openvdb::Vec3d x(balls_[i].center);
            const double reach = balls_[i].radius + acrossAreas(spec_);
            index_.forEachNear(x, x, reach, [&](const Ball& other, std::int32_t j) {
                const std::int32_t member = members_.of[std::size_t(j)];
                if (member != std::int32_t(a) && member != std::int32_t(b)) return;
                const double touch = reach + other.radius;
                if ((openvdb::Vec3d(other.center) - x).lengthSqr() < touch * touch)
                    all.push_back(std::size_t(j));
            });
        }
        std::sort(all.begin(), all.end());
        all.erase(std::unique(all.begin(), all.end()), all.end());
        std::vector<Ball> near;
        for (const std::size_t i : all) near.push_back(balls_[i]);
        const std::vector<double> areas = measureClosedForm(near, spec_, progress).ballAreas;
        Changed out{std::move(changed), {}};
        for (const std::size_t i : out.balls) {
            const auto at = std::lower_bound(all.begin(), all.end(), i) - all.begin();
            out.areas.push_back(areas[std::size_t(at)]);
        }
        return out;
    }

private:
    const std::vector<Ball>& balls_;
    const Members& members_;
    const SurfaceSpec& spec_;
    BallIndex index_;
};

/// Measures pairs of members.
class Pairs
{
public:
    Pairs(const BallSet& atoms, const SurfaceSpec& spec, bool ofBalls, Progress& progress)
        : bare_(withoutNames(atoms)), spec_(spec), ofBalls_(ofBalls), progress_(progress),
          members_(membersOf(atoms)), gap_(Influence(atoms, spec).acrossGap()),
          facing_(facingBalls(bare_.balls, members_,
                              std::max(fitReach, isClosedForm(spec) ? acrossAreas(spec) : gap_),
                              progress)),
          changed_(bare_.balls, members_, spec_), alone_(members_.balls.size()),
          wholes_(members_.balls.size())
    {
    }

    const Members& members() const { return members_; }

    /// The others of which a ball is near enough to change areas of a member.
    std::vector<std::size_t> near(std::size_t member) const
    {
        std::vector<std::size_t> out;
        for (const auto& [other, facing] : facing_[member])
            if (std::any_of(facing.begin(), facing.end(),
                            [&](const Facing& f) { return f.gap < gap_; }))
                out.push_back(std::size_t(other));
        return out;
    }

    /// The surface of a member by itself.
    const Areas& alone(std::size_t member)
    {
        std::optional<Areas>& areas = alone_[member];
        if (!areas)
            areas = areasOf(subset(bare_, members_.balls[member]), spec_, ofBalls_, progress_);
        return *areas;
    }

    /// The area that two members bury [Å^2], and their areas together where balls have some.
    double buried(std::size_t a, std::size_t b, Changed& together)
    {
        if (!isClosedForm(spec_)) return buriedOfWhole(a, b, together);
        together = changed_.of(a, b, facing(a, b, acrossAreas(spec_)), progress_);
        double sum = 0.0;
        for (std::size_t k = 0; k < together.balls.size(); ++k)
            sum += aloneOf(together.balls[k]) - together.areas[k];
        return 0.5 * sum;
    }

    /// Areas that two members bury of each other's balls.
    /// @param[in] least  change of a ball that counts [Å^2]
    std::vector<Report::Interface::Buried> buriedBalls(std::size_t a, const Changed& together,
                                                       double least)
    {
        std::vector<Report::Interface::Buried> out;
        for (std::size_t k = 0; k < together.balls.size(); ++k) {
            const std::size_t i = together.balls[k];
            const double before = aloneOf(i), area = together.areas[k];
            if (std::abs(before - area) > least)
                out.push_back({i, members_.of[i] == std::int32_t(a), before, area});
        }
        return out;
    }

    Report::Interface::Fit fit(std::size_t a, std::size_t b)
    {
        std::optional<FitSurface> part[2];
        const FitSurface &first = surface(a, b, part[0]), &second = surface(b, a, part[1]);
        return fits_.of(first, second, progress_);
    }

private:
    double buriedOfWhole(std::size_t a, std::size_t b, Changed& together)
    {
        std::vector<std::size_t> all = merged(members_.balls[a], members_.balls[b]);
        Areas both = areasOf(subset(bare_, all), spec_, ofBalls_, progress_);
        together.areas = std::move(both.ofBalls);
        if (!together.areas.empty()) together.balls = std::move(all);
        return (alone(a).total + alone(b).total - both.total) / 2.0;
    }

    /// The surface of a member's balls that matter for its fit with another one. If these are all
    /// its balls it is kept: a small member faces many others so.
    /// @param[out] part  where it is made if they are not
    const FitSurface& surface(std::size_t own, std::size_t other, std::optional<FitSurface>& part)
    {
        const std::vector<std::size_t> near =
            within(facing_[own].at(std::int32_t(other)), fitReach);
        const bool isWhole = near.size() == members_.balls[own].size();
        std::optional<FitSurface>& out = isWhole ? wholes_[own] : part;
        if (out) return *out;
        std::vector<Ball> balls;
        for (const std::size_t i : near) balls.push_back(bare_.balls[i]);
        return out.emplace(std::move(balls), progress_);
    }

    /// Balls of both that face the other member within a gap, ascending.
    std::vector<std::size_t> facing(std::size_t a, std::size_t b, double gap) const
    {
        return merged(within(facing_[a].at(std::int32_t(b)), gap),
                      within(facing_[b].at(std::int32_t(a)), gap));
    }

    /// The area of a ball where its member is alone.
    double aloneOf(std::size_t ball)
    {
        const auto member = std::size_t(members_.of[ball]);
        const std::vector<std::size_t>& own = members_.balls[member];
        const auto at = std::lower_bound(own.begin(), own.end(), ball) - own.begin();
        return alone(member).ofBalls[std::size_t(at)];
    }

    BallSet bare_;
    SurfaceSpec spec_;
    bool ofBalls_;
    Progress& progress_;
    Members members_;
    double gap_; // across which balls change each other's surface [Å]
    FacingBalls facing_;
    ChangedAreas changed_;
    FitMeasure fits_;
    std::vector<std::optional<Areas>> alone_;
    std::vector<std::optional<FitSurface>> wholes_;
};

} // namespace

void measureInterfaces(const BallSet& atoms, const SurfaceSpec& spec, bool ofBalls,
                       Progress& progress, Report& report)
{
    const Placement& placement = atoms.placement;
    const std::vector<Group>& groups = atoms.labels->groups;
    const std::size_t order = placement.order();
    Pairs pairs(atoms, spec, ofBalls, progress);
    std::vector<std::vector<std::size_t>> near;
    std::size_t runs = groups.size(), done = 0;
    for (std::size_t a = 0; a < groups.size(); ++a) runs += near.emplace_back(pairs.near(a)).size();
    const auto tick = [&] { progress.update("interfaces", double(done++) / double(runs)); };
    for (std::size_t g = 0; g < groups.size(); ++g) {
        tick();
        if (order == 1 && !pairs.members().balls[g].empty())
            report.groups[g].aloneArea = pairs.alone(g).total;
    }
    for (std::size_t a = 0; a < groups.size(); ++a) {
        for (const std::size_t member : near[a]) {
            tick();
            const std::size_t m = member / groups.size(), b = member % groups.size();
            // Group a and image m of b are, by the inverse motion, b and image `back` of a: only
            // one of the two counts. If they are the same the pair mirrors itself, and the whole
            // has it half as often.
            const std::size_t back = m == 0 ? 0 : placement.unit->inverse[m];
            if (b < a || (b == a && back < m)) continue;
            Changed together;
            const double area = pairs.buried(a, member, together);
            if (area < noticeable) continue; // what buries nothing is no interface
            const bool mirrored = b == a && back == m;
            Report::Interface& found = report.interfaces.emplace_back();
            found.first = groups[a].name;
            found.second = groups[b].name;
            if (m != 0) found.second += " of unit " + placement.instances[m].name;
            found.area = area;
            found.count = mirrored ? order / 2 : order;
            found.fit = pairs.fit(a, member);
            if (ofBalls && order == 1)
                found.buried =
                    pairs.buriedBalls(a, together, isClosedForm(spec) ? rounding : noticeable);
        }
    }
}

} // namespace molsurf
