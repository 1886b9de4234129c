// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/interfaces.h"

#include "molsurf/balls/boundary_check.h"
#include "molsurf/balls/contacts.h"
#include "molsurf/selection/subset.h"
#include "molsurf/surface/influence.h"
#include "molsurf/surface/parts.h"

#include <algorithm>
#include <cmath>

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

} // namespace

void measureInterfaces(const BallSet& atoms, const SurfaceOptions& options, Progress& progress,
                       Report& report)
{
    SurfaceOptions plain = options;
    plain.interfaces = plain.split = false;
    plain.surfaceOf.clear();
    plain.fields.clear();
    plain.color = ColorBy::Nothing;
    plain.curvatureTotals = false;
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
            std::vector<std::size_t> both;
            std::merge(balls[a].begin(), balls[a].end(), balls[b].begin(), balls[b].end(),
                       std::back_inserter(both));
            const double area =
                (alone[a] + alone[b] - areaOf(subset(atoms, both), plain, progress)) / 2.0;
            constexpr double noticeable = 0.005; // [Å^2]
            if (std::abs(area) < noticeable) continue;
            report.interfaces.push_back({labels.groups[a].name, labels.groups[b].name, area});
        }
    }
}

} // namespace molsurf
