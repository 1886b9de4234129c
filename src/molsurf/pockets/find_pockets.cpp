// SPDX-License-Identifier: MPL-2.0
#include "molsurf/pockets/find_pockets.h"

#include "molsurf/balls/ball_index.h"
#include "molsurf/balls/excluded_measure.h"
#include "molsurf/balls/nearest_ball.h"
#include "molsurf/core/disjoint_sets.h"
#include "molsurf/pockets/clearance.h"
#include "molsurf/pockets/measure_basins.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <utility>

namespace molsurf
{

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

/// The radius of the largest ball that gets to a mouth: exactly, where it is a neck between balls
/// that it just passes, and not the mouth itself.
double passingRadius(const BasinMeasure::Mouth& mouth, const Clearance& clearance, double voxelSize)
{
    const double most = 0.87 * voxelSize; // half of the diagonal, which the clearance is off by
    const auto neck = clearance.neckNear(mouth.narrowest, most, mouth.radius + most);
    const bool between = neck && neck->radius > mouth.radius - 0.25 * voxelSize; // two voxels
    return between ? neck->radius : mouth.radius;
}

/// The report of a basin by its own measures.
/// @param[in] leastMouth  mouths that are narrower at their widest do not count [Å]
PocketReport pocketOf(const BasinMeasure& basin, double peak, double leastMouth,
                      const OuterDepth& outer,
                      const std::function<double(const BasinMeasure::Mouth&)>& passing)
{
    constexpr double guess = 10.0; // of a pocket's depth and the probe [Å]
    PocketReport out;
    out.volume = basin.volume;
    out.area = basin.area;
    out.depth = outer.at(basin.deepest, false, guess).value;
    out.radius = peak;
    for (int k = 0; k < 3; ++k) out.centre[std::size_t(k)] = basin.moment[k] / basin.volume;
    for (const BasinMeasure::Mouth& mouth : basin.mouths)
        if (mouth.widest >= leastMouth) out.mouths.push_back({mouth.area, passing(mouth)});
    std::stable_sort(out.mouths.begin(), out.mouths.end(),
                     [](const auto& a, const auto& b) { return a.area > b.area; });
    return out;
}

/// Takes the exact measures of a pocket that is a whole cavity: those of the piece of the
/// solvent-excluded surface of the balls about it that has the nearest volume, if one is near.
void takeExact(const BallIndex& balls, double probe, const BasinMeasure& basin,
               const Progress& progress, PocketReport& pocket)
{
    // measured: a void of 16 Å^3 on voxels of 0.5 Å, 6 % too small
    constexpr double same = 0.15; // of the volume, by which cavities are told from each other
    openvdb::BBoxd box;
    for (const BasinMeasure::Wall& wall : basin.walls) box.expand(openvdb::Vec3d(wall.place));
    std::vector<Ball> near;
    balls.forEachNear(box.min(), box.max(), 2.5 * probe,
                      [&](const Ball& ball, std::int32_t) { near.push_back(ball); });
    const BallBoundary boundary = ballBoundary(near, probe, progress);
    const ExcludedMeasure exact =
        measureExcluded(boundary, measureBoundary(boundary, progress), probe, false, progress);
    double least = same * basin.volume;
    for (const BoundaryPiece& piece : exact.pieces) {
        if (std::abs(-piece.volume - basin.volume) >= least) continue;
        least = std::abs(-piece.volume - basin.volume);
        pocket.volume = -piece.volume;
        pocket.area = piece.area;
    }
}

/// Union-find of basins by their necks: whether a way leads out of each.
std::vector<char> opened(const Basins& basins, const std::vector<BasinMeasure>& measures,
                         double leastMouth)
{
    DisjointSets sets(basins.count());
    for (const Neck& neck : basins.necks)
        sets.join(std::uint32_t(neck.basins[0]), std::uint32_t(neck.basins[1]));
    std::vector<char> roots(basins.count(), 0), out;
    for (std::uint32_t b = 0; b < measures.size(); ++b)
        for (const BasinMeasure::Mouth& mouth : measures[b].mouths)
            if (mouth.widest >= leastMouth) roots[sets.find(b)] = 1;
    for (std::uint32_t b = 0; b < measures.size(); ++b) out.push_back(roots[sets.find(b)]);
    return out;
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
            const openvdb::Vec3d x =
                space.table.origin(n).offsetBy(v >> 6, v >> 3 & 7, v & 7).asVec3d() *
                space.voxelSize;
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

/// @param[in] numbers  of each basin its pocket, from 1, or 0
void addNeighbours(const Basins& basins, const std::vector<std::int32_t>& numbers,
                   std::vector<PocketReport>& pockets)
{
    for (const Neck& neck : basins.necks) {
        const std::int32_t a = numbers[std::size_t(neck.basins[0])],
                           b = numbers[std::size_t(neck.basins[1])];
        if (a == 0 || b == 0) continue;
        pockets[std::size_t(a - 1)].neighbours.push_back(std::size_t(b - 1));
        pockets[std::size_t(b - 1)].neighbours.push_back(std::size_t(a - 1));
    }
    for (PocketReport& pocket : pockets)
        std::sort(pocket.neighbours.begin(), pocket.neighbours.end());
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
                const std::int32_t leaf = space.table.find(at);
                if (leaf < 0 || to.isValueOn(at)) continue;
                const int place = (at[0] & 7) << 6 | (at[1] & 7) << 3 | (at[2] & 7);
                to.setValue(at, space.room(std::size_t(leaf), place));
            }
        });
    return grid;
}

} // namespace

Pockets findPockets(const std::vector<Ball>& balls, const PocketOptions& options, double voxelSize,
                    const std::vector<openvdb::Vec3d>& at, const Progress& progress)
{
    const VoidField space = voidField(balls, options, voxelSize, progress);
    const double voxelVolume = voxelSize * voxelSize * voxelSize;
    const Basins basins = splitAtNecks(space, options.neck, leastPocket / voxelVolume);
    const std::vector<BasinMeasure> measures = measureBasins(space, basins, progress);
    const double leastMouth = 0.5 * options.probeIn; // narrower ones are edges of the cut
    const std::vector<char> isOpen = opened(basins, measures, leastMouth);
    // A point of a wall is on a probe that touches balls.
    std::vector<std::vector<PocketReport::Lining>> linings =
        liningsOf(balls, measures, 2.0 * options.probeIn + voxelSize, progress);
    const BallIndex index(balls, {1.0, options.probeIn, 1.0});
    const Clearance clearance(balls);
    const auto passing = [&](const BasinMeasure::Mouth& mouth) {
        return passingRadius(mouth, clearance, voxelSize);
    };
    std::vector<char> hasNeck(basins.count(), 0);
    for (const Neck& neck : basins.necks)
        for (const std::int32_t basin : neck.basins) hasNeck[std::size_t(basin)] = 1;
    std::vector<FoundPocket> found;
    for (std::size_t b = 0; b < basins.count(); ++b) {
        PocketReport pocket =
            pocketOf(measures[b], double(basins.peaks[b]), leastMouth, *space.outer, passing);
        pocket.open = isOpen[b];
        pocket.lining = std::move(linings[b]);
        if (measures[b].mouths.empty() && !hasNeck[b])
            takeExact(index, options.probeIn, measures[b], progress, pocket);
        if (pocket.volume >= leastPocket) found.emplace_back(std::move(pocket), b);
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first.volume > b.first.volume; });
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
    addNeighbours(basins, numbers, out.list);
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
