// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/pockets/find_pockets.h"

#include "molsurf/analysis/pockets/clearance.h"
#include "molsurf/analysis/pockets/measure_basins.h"
#include "molsurf/analysis/pockets/mouth_ways.h"
#include "molsurf/analysis/pockets/pocket_extremes.h"
#include "molsurf/analysis/pockets/swept_cavities.h"
#include "molsurf/kernel/balls/nearest_ball.h"
#include "molsurf/kernel/core/disjoint_sets.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace molsurf
{

using openvdb::Vec3d;
using openvdb::Vec3f;

namespace
{

/// The balls of walls with their parts of them, by basin.
std::vector<std::vector<PocketReport::Lining>> liningsOf(const std::vector<Ball>& balls,
                                                         const std::vector<BasinMeasure>& basins,
                                                         double reach, const Progress& progress)
{
    std::vector<Vec3f> places;
    for (const BasinMeasure& basin : basins)
        for (const BasinMeasure::Wall& wall : basin.walls) places.push_back(wall.place);
    const std::vector<std::int32_t> owners = nearestBalls(balls, places, reach, progress);
    std::vector<std::vector<PocketReport::Lining>> out(basins.size());
    std::size_t next = 0;
    for (std::size_t b = 0; b < basins.size(); ++b) {
        std::map<std::int32_t, double> areas;
        for (const BasinMeasure::Wall& wall : basins[b].walls) {
            const std::int32_t owner = owners[next++];
            if (owner >= 0) areas[owner] += wall.area;
        }
        for (const auto& [ball, area] : areas) out[b].push_back({std::size_t(ball), area});
    }
    return out;
}

/// The report of a basin by its own measures.
PocketReport pocketOf(const BasinMeasure& basin)
{
    PocketReport out;
    out.volume = basin.volume;
    out.area = basin.area;
    for (int k = 0; k < 3; ++k) out.centre[std::size_t(k)] = basin.moment[k] / basin.volume;
    return out;
}

/// The mouths of a pocket, the largest first. Where nothing on the way is narrower than the place
/// where it begins the largest ball of the pocket gets out.
/// @param[in] ways  to each mouth: one to which the graph has no way is none. Where it has none at
///                  all those of the voxels count.
std::vector<PocketReport::Mouth> mouthsOf(const BasinMeasure& basin,
                                          const std::vector<MouthWay>& ways, double largest)
{
    const auto isKnown = [](const MouthWay& way) { return way.radius >= 0.0; };
    const bool any = std::any_of(ways.begin(), ways.end(), isKnown);
    std::vector<PocketReport::Mouth> out;
    for (std::size_t m = 0; m < basin.mouths.size(); ++m) {
        const BasinMeasure::Mouth& mouth = basin.mouths[m];
        const bool known = isKnown(ways[m]);
        if (any && !known) continue;
        const openvdb::Vec3d& place = known ? ways[m].place : mouth.narrowest;
        double radius = known ? ways[m].radius : mouth.radius;
        if (known && !ways[m].isNarrower) radius = largest;
        out.push_back({mouth.area, radius, {place[0], place[1], place[2]}});
    }
    std::stable_sort(out.begin(), out.end(),
                     [](const auto& a, const auto& b) { return a.area > b.area; });
    return out;
}

/// The node whose ball a place lies deepest in.
std::int32_t nodeAt(const VoidGraph& graph, const openvdb::Vec3d& x)
{
    std::int32_t best = VoidGraph::outside;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t n = 1; n < graph.nodes.size(); ++n) {
        const double gap = (x - graph.nodes[n].place).length() - graph.nodes[n].clearance;
        if (gap >= least) continue;
        least = gap;
        best = std::int32_t(n);
    }
    return best;
}

/// Which basins the small probe reaches from outside, by the graph of the void.
std::vector<char> openBasins(const RoomBasins& split, const std::vector<BasinMeasure>& measures)
{
    const std::vector<char> leadsOut = leadingOut(split.graph);
    std::vector<char> out;
    for (std::size_t b = 0; b < measures.size(); ++b) {
        const auto& widest = split.widest[b];
        const auto& mouths = measures[b].mouths;
        const std::int32_t node = widest           ? widest->node
                                  : mouths.empty() ? VoidGraph::none
                                                   : nodeAt(split.graph, mouths[0].widestPlace);
        out.push_back(node != VoidGraph::none && leadsOut[std::size_t(node)]);
    }
    return out;
}

/// Leaves out mouths that lead nowhere: those that are narrow, which are edges of the cut, and
/// those of voids that the small probe does not reach from outside, which only touch the cut.
void removeBlindMouths(double probe, const std::vector<char>& isOpen,
                       std::vector<BasinMeasure>& basins)
{
    const double least = 0.5 * probe; // of the clearance, where a mouth is widest [Å]
    for (std::size_t b = 0; b < basins.size(); ++b) {
        auto& mouths = basins[b].mouths;
        mouths.erase(std::remove_if(mouths.begin(), mouths.end(),
                                    [&](const BasinMeasure::Mouth& mouth) {
                                        return !isOpen[b] || mouth.widest < least;
                                    }),
                     mouths.end());
    }
}

/// Basins of closed cavities that belong together, for each the first of its group: a probe passes
/// from one to the other, or its balls on both sides overlap. A basin of no closed cavity, or one
/// that has a part only, is in none: -1.
std::vector<std::int32_t> cavityGroups(const RoomBasins& split, const std::vector<char>& isOpen)
{
    const std::size_t count = isOpen.size();
    DisjointSets sets(count);
    for (const Neck& neck : split.basins.necks)
        sets.join(std::uint32_t(neck.basins[0]), std::uint32_t(neck.basins[1]));
    std::vector<int> sizes(count, 0);
    std::vector<char> isMeasured(count, 1);
    for (std::uint32_t b = 0; b < count; ++b) ++sizes[sets.find(b)];
    for (std::uint32_t b = 0; b < count; ++b) {
        const auto& widest = split.widest[b];
        const std::uint32_t root = sets.find(b);
        // One that is alone is a pocket as a whole, also what of it reaches above the cut.
        if (isOpen[b] || !widest || widest->isExit || (sizes[root] > 1 && split.isCut[b]))
            isMeasured[root] = 0;
    }
    std::vector<std::int32_t> out(count, -1);
    for (std::uint32_t b = 0; b < count; ++b)
        if (isMeasured[sets.find(b)]) out[b] = std::int32_t(sets.find(b));
    return out;
}

/// Gives pockets of closed cavities their exact measures: those of each group are parted by the
/// measures of its basins on voxels.
void takeExact(const SweptCavities& cavities, const RoomBasins& split,
               const std::vector<BasinMeasure>& measures, const std::vector<char>& isOpen,
               const Progress& progress, std::vector<PocketReport>& pockets)
{
    const std::vector<std::int32_t> groupOf = cavityGroups(split, isOpen);
    std::map<std::int32_t, std::vector<std::size_t>> groups;
    for (std::size_t b = 0; b < groupOf.size(); ++b)
        if (groupOf[b] >= 0) groups[groupOf[b]].push_back(b);
    for (const auto& [first, own] : groups) {
        SweptCavities::Query query;
        double volume = 0.0, area = 0.0;
        for (const std::size_t b : own) {
            query.places.push_back(split.widest[b]->ball.place);
            for (const BasinMeasure::Wall& wall : measures[b].walls)
                query.box.expand(Vec3d(wall.place));
            for (const PocketReport::Lining& part : pockets[b].lining)
                query.lining.insert(part.ball);
            volume += measures[b].volume;
            area += measures[b].area;
        }
        const auto swept = cavities.measure(query, progress);
        if (!swept) continue;
        for (const std::size_t b : own) {
            pockets[b].volume *= swept->volume / volume;
            pockets[b].area *= swept->area / area;
        }
    }
}

/// A pocket, and its basin.
using FoundPocket = std::pair<PocketReport, std::size_t>;

/// The basin of the pocket that most of some places are nearest to, the first of several, or -1.
std::int32_t basinAt(const VoidField& space, const Basins& basins,
                     const std::vector<FoundPocket>& found, const std::vector<openvdb::Vec3d>& at)
{
    // measured: atoms of haems, retinals and of residues that line sites, 4hhb, 1u19 and 4at1: the
    // centres of these lie within a radius and a probe of the pocket
    constexpr double reach = 4.0; // [Å]
    std::vector<char> isFound(basins.count(), 0);
    for (const FoundPocket& one : found) isFound[one.second] = 1;
    std::vector<double> least2(at.size(), reach * reach);
    std::vector<std::int32_t> nearest(at.size(), -1);
    for (std::size_t n = 0; n < space.table.size(); ++n) {
        space.table.active(n).forEach([&](int v) {
            const std::int32_t basin = basins.of.leaf(n)[v];
            if (!isFound[std::size_t(basin)]) return;
            const Vec3d x = space.pointOf(VoxelPlace(n * leafSize + std::size_t(v)));
            for (std::size_t i = 0; i < at.size(); ++i) {
                const double square = (at[i] - x).lengthSqr();
                if (square >= least2[i]) continue;
                least2[i] = square;
                nearest[i] = basin;
            }
        });
    }
    std::int32_t best = -1;
    std::ptrdiff_t most = 0;
    for (const FoundPocket& one : found) {
        const auto basin = std::int32_t(one.second);
        const auto count = std::count(nearest.begin(), nearest.end(), basin);
        if (count <= most) continue;
        most = count;
        best = basin;
    }
    return best;
}

/// Gives pockets, the largest first, their ranks, and those of the pockets beyond their necks.
void rank(const Basins& basins, std::vector<FoundPocket>& found)
{
    std::vector<PocketReport*> ofBasin(basins.count(), nullptr);
    for (std::size_t p = 0; p < found.size(); ++p) {
        found[p].first.rank = p + 1;
        ofBasin[found[p].second] = &found[p].first;
    }
    for (const Neck& neck : basins.necks) {
        PocketReport* const a = ofBasin[std::size_t(neck.basins[0])];
        PocketReport* const b = ofBasin[std::size_t(neck.basins[1])];
        if (!a || !b) continue;
        a->neighbours.push_back(b->rank);
        b->neighbours.push_back(a->rank);
    }
    for (FoundPocket& one : found)
        std::sort(one.first.neighbours.begin(), one.first.neighbours.end());
}

/// Makes a grid of the voxels of pockets.
/// @param[in] numbers  of each basin its pocket, from 1, or 0
/// @param[in] of       gives the value of a voxel
template<typename GridT, typename Of>
typename GridT::Ptr voxelGrid(const char* name, const VoidField& space, const Basins& basins,
                              const std::vector<std::int32_t>& numbers, const Of& of)
{
    using Leaf = typename GridT::TreeType::LeafNodeType;
    const auto grid = GridT::create();
    grid->setName(name);
    grid->setTransform(openvdb::math::Transform::createLinearTransform(space.voxelSize));
    for (std::size_t n = 0; n < space.table.size(); ++n) {
        Leaf* leaf = nullptr;
        space.table.active(n).forEach([&](int v) {
            const std::int32_t number = numbers[std::size_t(basins.of.leaf(n)[v])];
            if (number == 0) return;
            if (!leaf) leaf = grid->tree().touchLeaf(space.table.origin(n));
            leaf->setValueOn(openvdb::Index(v), of(n, v, number));
        });
    }
    return grid;
}

/// The room of voxels that have any, and of those about them.
openvdb::FloatGrid::Ptr roomGrid(const VoidField& space)
{
    const auto grid = openvdb::FloatGrid::create(-float(space.voxelSize));
    grid->setName("pocket_room");
    grid->setTransform(openvdb::math::Transform::createLinearTransform(space.voxelSize));
    auto to = grid->getUnsafeAccessor();
    for (std::size_t n = 0; n < space.table.size(); ++n)
        space.table.active(n).forEach([&](int v) {
            const openvdb::Coord voxel = space.table.origin(n).offsetBy(v >> 6, v >> 3 & 7, v & 7);
            for (int k = 0; k < 27; ++k) {
                const openvdb::Coord at = voxel.offsetBy(k / 9 - 1, k / 3 % 3 - 1, k % 3 - 1);
                const auto place = space.find(at);
                if (place && !to.isValueOn(at)) to.setValue(at, space.room(*place));
            }
        });
    return grid;
}

} // namespace

Pockets findPockets(const std::vector<Ball>& balls, const PocketOptions& options, double voxelSize,
                    const std::vector<openvdb::Vec3d>& at, const Progress& progress)
{
    const VoidField space = voidField(balls, options, voxelSize, progress);
    const double nearCut = options.probeOut + options.cut + 1.0; // a guess [Å]
    const BelowCut below = [&](const openvdb::Vec3d& x, double room) {
        OuterDepth::Depth depth = space.outer->at(x, room >= options.probeOut, nearCut);
        depth.value -= options.cut;
        return depth;
    };
    const RoomBasins split =
        splitAtRooms(balls, options.probeIn, space, options.neck, below, progress);
    const Basins& basins = split.basins;
    std::vector<BasinMeasure> measures = measureBasins(space, basins, progress);
    const std::vector<char> isOpen = openBasins(split, measures);
    removeBlindMouths(options.probeIn, isOpen, measures);
    // A point of a wall is on a probe that touches balls.
    std::vector<std::vector<PocketReport::Lining>> linings =
        liningsOf(balls, measures, 2.0 * options.probeIn + voxelSize, progress);
    std::vector<PocketReport> pockets;
    for (std::size_t b = 0; b < basins.count(); ++b) {
        pockets.push_back(pocketOf(measures[b]));
        pockets[b].open = isOpen[b];
        pockets[b].lining = std::move(linings[b]);
    }
    takeExact(SweptCavities(balls, options.probeIn), split, measures, isOpen, progress, pockets);
    const Clearance clearance(balls);
    const auto isWithin = [&](const openvdb::Vec3d& x) {
        return below(x, clearance.at(x)).value >= 0.0;
    };
    const std::vector<std::vector<MouthWay>> ways = mouthWays(space, split, measures);
    const DeepestPlaces deepest(space, options.probeIn, clearance);
    std::vector<FoundPocket> found;
    for (std::size_t b = 0; b < basins.count(); ++b) {
        PocketReport& pocket = pockets[b];
        const std::optional<WidestPlace>& widest = split.widest[b];
        if (pocket.volume < leastPocket) continue;
        pocket.radius = widest ? widest->ball.clearance
                               : largestBall(measures[b].widest, voxelSize, clearance, isWithin);
        pocket.depth = deepest.depthNear(measures[b].deepest);
        pocket.mouths = mouthsOf(measures[b], ways[b], pocket.radius);
        found.emplace_back(std::move(pocket), b);
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first.volume > b.first.volume; });
    rank(basins, found);
    if (!at.empty()) {
        const std::int32_t kept = basinAt(space, basins, found, at);
        found.erase(
            std::remove_if(found.begin(), found.end(),
                           [=](const auto& one) { return std::int32_t(one.second) != kept; }),
            found.end());
    }
    Pockets out;
    std::vector<std::int32_t> numbers(basins.count(), 0);
    for (auto& [pocket, basin] : found) {
        out.list.push_back(std::move(pocket));
        numbers[basin] = std::int32_t(out.list.size());
    }
    out.ids =
        voxelGrid<openvdb::Int32Grid>("pocket_id", space, basins, numbers,
                                      [](std::size_t, int, std::int32_t number) { return number; });
    out.rooms = roomGrid(space);
    out.depths = voxelGrid<openvdb::FloatGrid>(
        "pocket_depth", space, basins, numbers, [&](std::size_t n, int v, std::int32_t) {
            return space.below.leaf(n)[v] + float(options.cut);
        });
    return out;
}

} // namespace molsurf
