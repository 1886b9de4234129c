// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/interfaces.h"

#include "molsurf/balls/boundary_check.h"
#include "molsurf/balls/contacts.h"
#include "molsurf/selection/subset.h"
#include "molsurf/surface/influence.h"
#include "molsurf/surface/parts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace molsurf
{

namespace
{

double areaOf(const BallSet& atoms, const SurfaceOptions& options, const Progress& progress)
{
    if (options.kind == SurfaceKind::SolventAccessible ||
        options.kind == SurfaceKind::VanDerWaals) {
        const double probe = options.kind == SurfaceKind::SolventAccessible ? options.probe : 0.0;
        double area = 0.0;
        const BallBoundary boundary = ballBoundary(atoms.balls, probe, progress);
        const BoundaryMeasure measure = measureBoundary(boundary, progress);
        checkBoundary(boundary, measure, progress);
        for (const double patch : measure.patchAreas) area += patch;
        return area;
    }
    QuietProgress quiet(progress);
    return makeSurface(atoms, options, &quiet).report.surface.area;
}

constexpr double noticeable = 0.005; // [Å^2]

SurfaceOptions plainOptions(const SurfaceOptions& options)
{
    SurfaceOptions plain = options;
    plain.interfaces = plain.split = false;
    plain.surfaceOf.clear();
    plain.fields.clear();
    plain.color = ColorBy::Nothing;
    plain.curvatureTotals = false;
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
    const SymmetricUnit& unit = *atoms.unit;
    const std::size_t order = unit.inverse.size(), groups = atoms.labels->groups.size();
    const SurfaceOptions plain = plainOptions(options);
    BallSet balls = atoms;
    balls.unit.reset();
    balls.instances.clear();
    // Groups motion by motion: those of the unit come first.
    std::vector<std::int32_t> memberOf(balls.balls.size(), -1);
    std::vector<std::vector<std::size_t>> members(order * groups);
    for (std::size_t i = 0; i < memberOf.size(); ++i) {
        const std::int32_t g = balls.labels->groupOf[i];
        if (g < 0) continue;
        memberOf[i] = unit.motionOf[i] * std::int32_t(groups) + g;
        members[std::size_t(memberOf[i])].push_back(i);
    }
    const auto near = contacts(balls.balls, memberOf, members.size(),
                               Influence(balls, plain).acrossGap(), progress);
    std::size_t runs = 0, done = 0;
    for (std::size_t a = 0; a < groups; ++a) runs += near[a].size();
    std::map<std::size_t, double> alone;
    const auto aloneOf = [&](std::size_t member) {
        const auto [found, isNew] = alone.emplace(member, 0.0);
        if (isNew) found->second = areaOf(subset(balls, members[member]), plain, progress);
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
                areaOf(subset(balls, merged(members[a], members[member])), plain, progress);
            const double area = (aloneOf(a) + aloneOf(member) - both) / 2.0;
            if (std::abs(area) < noticeable) continue;
            const bool mirrored = b == a && back == m;
            std::string name = atoms.labels->groups[b].name;
            if (m != 0) name += " of unit " + atoms.instances[m].name;
            report.interfaces.push_back(
                {atoms.labels->groups[a].name, name, area, mirrored ? order / 2 : order});
        }
    }
}

} // namespace

void measureInterfaces(const BallSet& atoms, const SurfaceOptions& options, Progress& progress,
                       Report& report)
{
    if (atoms.unit) return measureUnitInterfaces(atoms, options, progress, report);
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
    std::vector<double> alone(labels.groups.size(), 0.0);
    for (std::size_t g = 0; g < alone.size(); ++g) {
        tick(1);
        if (balls[g].empty()) continue;
        alone[g] = areaOf(subset(atoms, balls[g]), plain, progress);
        report.groups[g].aloneArea = alone[g];
    }
    for (std::size_t a = 0; a < near.size(); ++a) {
        for (const std::int32_t other : near[a]) {
            const auto b = std::size_t(other);
            if (b <= a) continue;
            tick(2);
            const double both = areaOf(subset(atoms, merged(balls[a], balls[b])), plain, progress);
            const double area = (alone[a] + alone[b] - both) / 2.0;
            if (std::abs(area) < noticeable) continue;
            report.interfaces.push_back({labels.groups[a].name, labels.groups[b].name, area, 1});
        }
    }
}

} // namespace molsurf
