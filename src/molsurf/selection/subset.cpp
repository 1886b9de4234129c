// SPDX-License-Identifier: MPL-2.0
#include "molsurf/selection/subset.h"

#include "molsurf/balls/placed_ball.h"

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

/// Sets the number of balls of each group or rule.
/// @param[in] memberOf  index of its group for each ball, or -1
template<typename T>
void count(const std::vector<std::int32_t>& memberOf, std::vector<T>& groups)
{
    for (T& group : groups) group.balls = 0;
    for (const std::int32_t g : memberOf) {
        if (g >= 0) ++groups[std::size_t(g)].balls;
    }
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
    out.copyBegin = {0, out.balls.size()};
    out.model = atoms.model;
    out.instances = atoms.instances;
    out.unit = atoms.unit;
    if (out.unit) out.unit->motionOf = gather(atoms.unit->motionOf, which);
    if (counted == Counted::Subset) count(out.resolutionOf, out.resolutions);
    if (!atoms.labels) return out;
    const BallLabels& all = *atoms.labels;
    BallLabels& labels = out.labels.emplace();
    labels.chains = all.chains;
    labels.groups = all.groups;
    labels.chainOf = gather(all.chainOf, which);
    labels.groupOf = gather(all.groupOf, which);
    labels.elementOf = gather(all.elementOf, which);
    labels.residueClassOf = gather(all.residueClassOf, which);
    labels.values = all.values;
    if (labels.values) labels.values->valueOf = gather(all.values->valueOf, which);
    if (counted == Counted::Subset) count(labels.groupOf, labels.groups);
    return out;
}

BallSet inSpatialOrder(const BallSet& atoms)
{
    const std::vector<std::int32_t> order = spatialOrder(atoms.balls);
    return subset(atoms, {order.begin(), order.end()}, Counted::Whole);
}

} // namespace molsurf
