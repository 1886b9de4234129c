// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/subset.h"

#include "molsurf/kernel/balls/depth.h"

#include "molsurf/kernel/balls/placed_ball.h"

namespace molsurf
{

namespace
{

/// The values of some indices; none of nothing.
template<typename T>
std::vector<T> gather(const std::vector<T>& from, const std::vector<std::size_t>& which)
{
    std::vector<T> out;
    if (from.empty()) return out;
    out.reserve(which.size());
    for (const std::size_t i : which) out.push_back(from[i]);
    return out;
}

} // namespace

BallSet subset(const BallSet& atoms, const std::vector<std::size_t>& which, Counted counted)
{
    BallSet out;
    out.balls = gather(atoms.balls, which);
    out.decays = gather(atoms.decays, which);
    out.resolutions = atoms.resolutions;
    out.resolutionOf = gather(atoms.resolutionOf, which);
    out.colors = gather(atoms.colors, which);
    out.coloring = atoms.coloring;
    out.record.model = atoms.record.model;
    out.record.membrane = atoms.record.membrane;
    if (counted == Counted::Subset) countBalls(out, out.resolutionOf, out.resolutions);
    if (!atoms.labels) return out;
    const BallLabels& all = *atoms.labels;
    BallLabels& labels = out.labels.emplace();
    labels.chains = all.chains;
    labels.chainPlaces = all.chainPlaces;
    labels.groups = all.groups;
    labels.chainOf = gather(all.chainOf, which);
    labels.groupOf = gather(all.groupOf, which);
    labels.colorGroups = all.colorGroups;
    labels.colorGroupOf = gather(all.colorGroupOf, which);
    labels.elementOf = gather(all.elementOf, which);
    labels.residueClassOf = gather(all.residueClassOf, which);
    labels.values = all.values;
    if (labels.values) labels.values->valueOf = gather(all.values->valueOf, which);
    labels.patchValues = all.patchValues;
    if (labels.patchValues) labels.patchValues->valueOf = gather(all.patchValues->valueOf, which);
    if (counted == Counted::Subset) countBalls(out, labels.groupOf, labels.groups);
    return out;
}

BallSet inSpatialOrder(const BallSet& atoms)
{
    const std::vector<std::int32_t> order = spatialOrder(atoms.balls);
    const std::vector<std::size_t> which(order.begin(), order.end());
    BallSet out = subset(atoms, which, Counted::Whole);
    out.placement = atoms.placement;
    out.placement.motionOf = gather(atoms.placement.motionOf, which);
    return out;
}

WholeBalls ballsOfWhole(const BallSet& atoms)
{
    WholeBalls out;
    const auto add = [&](std::size_t i, const openvdb::Vec3d& center) {
        out.balls.push_back({center, atoms.balls[i].radius, atoms.balls[i].atom});
        out.sources.push_back(i);
    };
    if (atoms.placement.isWhole())
        for (std::size_t i = 0; i < atoms.balls.size(); ++i) add(i, atoms.balls[i].center);
    for (const Instance& copy : atoms.placement.instances) {
        const auto [begin, end] = atoms.prototype(copy.part);
        for (std::size_t i = begin; i < end; ++i) add(i, copy.placed(atoms.balls[i].center));
    }
    return out;
}

RepeatedBalls repeatedBalls(const BallSet& atoms)
{
    if (!atoms.placement.folded) return atoms.balls;
    std::vector<BallCopy> copies;
    for (const Instance& copy : atoms.placement.instances)
        copies.push_back(
            {copy, atoms.placement.begin[copy.part], atoms.placement.begin[copy.part + 1]});
    return {atoms.balls, std::move(copies)};
}

std::vector<double> ballDepths(const BallSet& atoms, double probe, const Progress& progress)
{
    const auto depthsIn = [&](const std::vector<Ball>& whole, const std::vector<Ball>& some) {
        std::vector<openvdb::Vec3d> centres;
        for (const Ball& ball : some) centres.push_back(ball.center);
        return depthsOf(whole, probe, centres, progress);
    };
    if (atoms.placement.unit) return depthsIn(ballsOfWhole(atoms).balls, atoms.balls);
    std::vector<double> out;
    for (std::size_t p = 0; p < atoms.placement.prototypes(); ++p) {
        const auto [begin, end] = atoms.prototype(p);
        const std::vector<Ball> balls(atoms.balls.begin() + std::ptrdiff_t(begin),
                                      atoms.balls.begin() + std::ptrdiff_t(end));
        const std::vector<double> depths = depthsIn(balls, balls);
        out.insert(out.end(), depths.begin(), depths.end());
    }
    return out;
}

} // namespace molsurf
