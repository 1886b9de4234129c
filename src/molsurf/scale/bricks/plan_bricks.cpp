// SPDX-License-Identifier: MPL-2.0
#include "molsurf/scale/bricks/plan_bricks.h"

#include "molsurf/kernel/balls/ball_index.h"
#include "molsurf/scale/bricks/brick_file.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/cancel.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/kernel/pipeline/check_balls.h"
#include "molsurf/kernel/pipeline/influence.h"
#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/molecule/selection/subset.h"
#include "molsurf/surface/field_table.h"
#include "molsurf/surface/product_cost.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_set>

namespace molsurf
{

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::Vec3d;

namespace
{

// Measured on 280 surfaces of 30 to 545,000 atoms, all kinds, voxels of 0.25 to 2 Å and probes of
// 0.5 to 3 Å, with Debian's OpenVDB: peaks of the resident memory against the leaves that hold
// atoms or lie beside them. A peak is either that of the flow and the distances, or that of the
// mesh. The surface of a larger probe passes fewer balls, and fewer of those leaves.
constexpr double bytesPerAtom = 40.0;           // of the whole molecule, where it is in memory
constexpr double bytesPerNear = 205.0;          // of the balls near a brick: cell lists, copies
constexpr double bytesPerBoundaryBall = 1.55e3; // of those: the boundary of their union
constexpr double bytesPerFlowLeaf = 10e3;       // within the halo of the flow
constexpr double bytesPerCoarseLeaf = 2.2e3;    // of the whole at rest on voxels twice as large
constexpr double bytesPerDistanceLeaf = 2e3;    // within the halo of the spline, beside boundaries
constexpr double bytesPerMeshLeaf = 10e3;       // the same of the mesh
constexpr double bytesPerUnionLeaf = 8.5e3;     // of the mesh of a union
constexpr double bytesPerGaussLeaf = 9.5e3;     // of that of a Gaussian surface
constexpr double morePerGaussVoxel = 2.2e3;     // for each Å of the voxel: it has more triangles
constexpr double sharePerProbe = 0.4; // fewer balls of boundaries, for each Å of the probe
constexpr double bytesPerExcludedBall = 3.4e3; // ses in closed form, which only a whole has
constexpr double fewerPerProbe3 = 0.9;         // of these, for each Å^3 of the probe's cube
constexpr double bytesPerKeptLeaf = 7e3; // of the flow, where these are kept for the next brick
constexpr double bytesPerValueOfLeaf = 2.5e3; // of a grid that goes along with the surface
// On one core of a Xeon of 2.6 GHz: bench/estimates.py.
constexpr double secondsPerAtom = 5.5e-6; // reading, copies, labels
constexpr double secondsPerLeaf = 0.08e-3, secondsPerFlowLeaf = 0.09e-3;
constexpr double secondsPerGaussLeaf = 0.12e-3;
constexpr double timesOfFill = 1.8;   // of all after the flow, where cavities are filled
constexpr double timesOfFronts = 3.5; // of the flow, where fronts move far: 2.5, seldom 6
// measured: build --flow paper of 1CRN, 1UBQ, 4HHB at 0.5 and 1 Å: 0.08 to 0.14.
constexpr double timesPerPaperStep = 0.12; // of the flow
constexpr double secondsPerBoundaryBall = 12e-6;
// Of surfaces that are stored, 1UBQ to 4V5A at 0.2 to 1 Å: the seconds are 0.6 to 1.6 times what
// was measured, the memory 0.9 to 1.4 times.
constexpr double secondsOfStart = 0.03, secondsPerSplineLeaf = 0.05e-3;
constexpr double secondsPerFittedLeaf = 0.15e-3, bytesPerFittedLeaf = 25e3; // without its spline
constexpr double bytesOfPlyPerVoxel = 12.0, bytesPerReadVoxel = 44.0;       // of a mesh
constexpr double secondsPerComparedVoxel = 0.6e-6;                          // more from afar
// measured: convert of sas, 4AT1 and 1CRN at 1 and 0.7 Å, 300 to 2400 pixels: 1.2 to 1.5 times
// the peak.
constexpr double bytesPerPixel = 75.0, secondsPerPixel = 3e-6; // of a square picture
// measured: build --opacity 0.4 --show-behind, or --show pockets, of 1CRN, 4AT1, 1EHZ, 1AOI, 1IGY,
// 1HZH, 4HHB, 1U19: 1.0 to 1.8 times the peak.
constexpr double bytesPerLayeredPixel = 65.0;                              // more
constexpr double bytesPerDrawnVoxel = 94.0, secondsPerDrawnVoxel = 0.5e-6; // rays find triangles
// measured: -o FILE.dx of two molecules 1e6 Å apart on voxels of 3 Å; .mrc takes a fifth.
constexpr double secondsPerMapPoint = 7e-8;
constexpr double bytesToMerge =
    7.0; // an active voxel: leaves without values, statistics of vertices
constexpr double voxelsPerLeaf = 180.0; // active ones of the grid `surface`
constexpr int smallest = 4;             // leaves along the shortest edge of a brick that is cut

/// One of so many places, chosen only by their numbers.
struct Sample {
    unsigned every = 1;

    bool has(const Coord& place) const { return every == 1 || mixed(place) % every == 0; }

private:
    static std::uint32_t mixed(const Coord& place)
    {
        std::uint64_t bits = 0;
        for (int axis = 0; axis < 3; ++axis) {
            bits = (bits ^ std::uint32_t(place[axis])) * 0x9e3779b97f4a7c15;
            bits ^= bits >> 29;
        }
        return std::uint32_t((bits * 0xbf58476d1ce4e5b9) >> 32);
    }
};

/// The first voxel of the leaf at a place. (Negative numbers are not shifted.)
Coord originOf(const Coord& place)
{
    return {leafDim * place.x(), leafDim * place.y(), leafDim * place.z()};
}

/// Balls by the leaf of their centres, in blocks of 8^3 leaves.
struct OwnLeaves {
    LeafTable places;                  ///< a voxel is the place of a leaf, and a leaf a block
    std::vector<std::size_t> begin;    ///< of each block: its first leaf among all
    std::vector<std::uint32_t> counts; ///< of balls, one a leaf, in the order of the places

    /// The number of a leaf among all.
    std::size_t indexOf(std::size_t block, int place) const
    {
        return begin[block] + std::size_t(places.active(block).countBelow(place));
    }
};

/// Leaves that may have a part of the surface, with the number of balls whose centres are in each:
/// a list, or of balls that are never in memory together blocks.
struct Occupancy {
    std::vector<Coord> leaves; ///< places among leaves, ascending
    std::vector<std::uint32_t> atoms;
    LeafTable blocks; ///< of the places, if they are not listed
    OwnLeaves own;    ///< of the balls, then
    CoordBBox box;    ///< of the places
    Sample sample;    ///< that the leaves are

    std::size_t size() const { return leaves.size() + blocks.activeCount(); }

    /// Calls f(place, atoms) for each leaf in a box of places, in no particular order.
    template<typename F>
    void forEach(const CoordBBox& in, const F& f) const
    {
        for (std::size_t n = 0; n < leaves.size(); ++n)
            if (in.isInside(leaves[n])) f(leaves[n], atoms[n]);
        for (std::size_t b = 0; b < blocks.size(); ++b) {
            const Coord& origin = blocks.origin(b);
            if (!in.hasOverlap(CoordBBox::createCube(origin, leafDim))) continue;
            const std::int32_t with = own.places.find(origin);
            blocks.active(b).forEach([&](int v) {
                const Coord place = origin.offsetBy(v >> 6, v >> 3 & 7, v & 7);
                if (!in.isInside(place)) return;
                const bool found = with >= 0 && own.places.active(std::size_t(with)).on(v);
                f(place, found ? own.counts[own.indexOf(std::size_t(with), v)] : 0);
            });
        }
    }
};

/// Adds the leaves that may lie between two spheres about a ball's centre: those whose middles are
/// at most half a diagonal beyond either. Goes column by column along z, and passes over the hole,
/// since most of those in their box lie inside.
/// @param[in] edge  of a leaf [Å], as are inner and outer
void addShell(const Vec3d& centre, double inner, double outer, double edge, const Sample& sample,
              std::vector<Coord>& places)
{
    const double halfLeaf = 0.5 * edge, diagonal = halfLeaf * std::sqrt(3.0);
    const double far = outer + diagonal, near = std::max(inner - diagonal, 0.0);
    const Coord first = Coord::floor((centre - Vec3d(far)) / edge);
    const Coord last = Coord::floor((centre + Vec3d(far)) / edge);
    for (int x = first.x(); x <= last.x(); ++x) {
        for (int y = first.y(); y <= last.y(); ++y) {
            const double u = x * edge + halfLeaf - centre.x(), v = y * edge + halfLeaf - centre.y();
            const double aside2 = u * u + v * v;
            if (aside2 > far * far) continue;
            const double top = std::sqrt(far * far - aside2);
            const double hole = near * near > aside2 ? std::sqrt(near * near - aside2) : -1.0;
            const auto placeAt = [&](double z) { return int(std::floor((centre.z() + z) / edge)); };
            for (int z = placeAt(-top - halfLeaf); z <= placeAt(top + halfLeaf); ++z) {
                const double height = std::abs(z * edge + halfLeaf - centre.z());
                if (height < hole) { // to the other side
                    z = std::max(z, placeAt(hole - halfLeaf) - 1);
                    continue;
                }
                if (sample.has(Coord(x, y, z))) places.emplace_back(x, y, z);
            }
        }
    }
}

/// Whether a ball has so many leaves inside that only its shell is taken.
bool isLarge(const Ball& ball, double edge)
{
    constexpr double many = 4.0;
    return ball.radius > many * edge;
}

/// How many leaves occupancyOf() finds at most, to the factor of a few that a limit needs. Large
/// balls have shells of the area pi across^2, four leaves deep. Small ones fill cubes, or together
/// no more than the box of all, which their radii widen by up to four leaves a side.
double leavesAtMost(const std::vector<Ball>& balls, double voxel, double reach)
{
    const double edge = leafDim * voxel;
    double ofSmall = 0.0, ofShells = 0.0;
    openvdb::BBoxd box;
    for (const Ball& ball : balls) {
        const double across = 2.0 * (ball.radius + reach) / edge + 2.0;
        const bool large = isLarge(ball, edge);
        (large ? ofShells : ofSmall) += large ? M_PI * across * across * 4.0 : std::pow(across, 3);
        if (!large) box.expand(Vec3d(ball.center));
    }
    if (ofSmall == 0.0) return ofShells;
    const Vec3d extents = (box.extents() + Vec3d(2.0 * reach)) / edge + Vec3d(3.0 + 2.0 * 4.0);
    return std::min(ofSmall, extents.product()) + ofShells;
}

/// The voxels on which the whole is estimated: as large as it takes for few leaves.
double grainOf(const std::vector<Ball>& balls, double voxel, double reach)
{
    const double few = std::max(4e6, 2.0 * double(balls.size()));
    // Smaller leaves than an atom lie inside of it, and are not those of its surface.
    while (voxel < 0.5 || leavesAtMost(balls, voxel, reach) > few) voxel *= 2.0;
    return voxel;
}

/// The place of a leaf within its block.
int offsetIn(const Coord& place)
{
    return int(openvdb::FloatTree::LeafNodeType::coordToOffset(place));
}

/// The places within any number of steps along each axis of those of a table.
LeafTable dilatedBy(LeafTable table, int steps, const Progress& progress)
{
    for (; steps > 0; steps -= leafDim)
        table = dilated(table, std::min(steps, leafDim), Spread::Cube, progress);
    return table;
}

/// The places that lie within some steps of others along each axis; far from each other they may
/// come more than once.
/// @param[in]  own     places, ascending
/// @param[in]  most    places that are listed; where more lie far from each other, it is a sample
/// @param[out] sample  which they are
std::vector<Coord> placesNear(const std::vector<Coord>& own, int steps, double most, Sample& sample,
                              const Progress& progress)
{
    std::vector<Coord> near, blocks;
    for (const Coord& place : own) blocks.push_back(place & ~(leafDim - 1));
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    // A list takes less memory than a table where places are few or far from each other.
    constexpr double few = 3e6, perBlock = 300.0;
    const double listed = double(own.size()) * std::pow(2 * steps + 1, 3);
    if (listed < std::max(few, perBlock * double(blocks.size()))) {
        sample.every = unsigned(std::ceil(std::max(listed / most, 1.0)));
        constexpr double margin = 1.1; // of a random number
        near.reserve(std::size_t(std::min(listed, margin * listed / sample.every)));
        for (const Coord& place : own) {
            for (auto ijk = CoordBBox(place, place).expandBy(steps).begin(); ijk; ++ijk)
                if (sample.has(*ijk)) near.push_back(*ijk);
        }
        return near;
    }
    // In this table a voxel is the place of a leaf, and a leaf a block of 8^3 places.
    LeafTable table(std::move(blocks));
    for (const Coord& place : own)
        table.active(std::size_t(table.find(place))).set(offsetIn(place));
    table = dilatedBy(std::move(table), steps, progress);
    for (std::size_t n = 0; n < table.size(); ++n) {
        table.active(n).forEach(
            [&](int v) { near.push_back(table.origin(n).offsetBy(v >> 6, v >> 3 & 7, v & 7)); });
    }
    return near;
}

/// Finds the leaves that may have a part of the surface: those within reach of the largest small
/// ball about each leaf with a centre, and those in the shells of large balls.
/// @param[in] reach  how far the surface may lie from the balls [Å]
/// @param[in] most   leaves that are listed, see placesNear()
Occupancy occupancyOf(const std::vector<Ball>& balls, double voxel, double reach, double most,
                      const Progress& progress)
{
    const double edge = leafDim * voxel;
    double largestSmall = 0.0;
    for (const Ball& ball : balls) {
        if (!isLarge(ball, edge)) largestSmall = std::max(largestSmall, ball.radius);
    }
    std::vector<Coord> places(balls.size());
    for (std::size_t i = 0; i < balls.size(); ++i)
        places[i] = Coord::floor(Vec3d(balls[i].center) / edge);
    tbb::parallel_sort(places.begin(), places.end());
    std::vector<Coord> own;
    std::vector<std::uint32_t> counts;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (i == 0 || places[i] != places[i - 1]) {
            own.push_back(places[i]);
            counts.push_back(0);
        }
        ++counts.back();
    }
    const int steps = int(std::ceil((largestSmall + reach) / edge));
    Occupancy out;
    out.leaves = placesNear(own, steps, most, out.sample, progress);
    const auto sortLeaves = [&] {
        tbb::parallel_sort(out.leaves.begin(), out.leaves.end());
        out.leaves.erase(std::unique(out.leaves.begin(), out.leaves.end()), out.leaves.end());
    };
    std::size_t full = 2 * out.leaves.size() + 1000000; // before equal ones are sorted out
    for (const Ball& ball : balls) {
        if (!isLarge(ball, edge)) continue;
        addShell(Vec3d(ball.center), ball.radius - 2.0 * voxel, ball.radius + reach + 2.0 * voxel,
                 edge, out.sample, out.leaves);
        if (out.leaves.size() < full) continue;
        sortLeaves();
        full = 2 * out.leaves.size() + 1000000;
    }
    sortLeaves();
    for (std::size_t n = 0, m = 0; n < out.leaves.size(); ++n) {
        out.box.expand(out.leaves[n]);
        while (m < own.size() && own[m] < out.leaves[n]) ++m; // not in the sample
        const bool found = m < own.size() && own[m] == out.leaves[n];
        out.atoms.push_back(found ? counts[m++] : 0);
    }
    // The band about the outermost surface may reach into the next leaf.
    out.box.expand(1);
    return out;
}

/// Balls by leaf, in two passes over all of them.
OwnLeaves ownLeaves(const RepeatedBalls& balls, double edge)
{
    const auto placeOf = [&](const Ball& ball) { return Coord::floor(Vec3d(ball.center) / edge); };
    std::unordered_set<Coord> blocks;
    Coord last = Coord::max();
    balls.forEach([&](const Ball& ball, std::size_t) { // most follow another one of their block
        const Coord block = placeOf(ball) & ~(leafDim - 1);
        if (block != last) blocks.insert(block);
        last = block;
    });
    OwnLeaves own{LeafTable({blocks.begin(), blocks.end()}), {}, {}};
    const auto blockOf = [&](const Coord& place) { return std::size_t(own.places.find(place)); };
    balls.forEach([&](const Ball& ball, std::size_t) {
        const Coord place = placeOf(ball);
        own.places.active(blockOf(place)).set(offsetIn(place));
    });
    std::size_t leaves = 0;
    for (std::size_t b = 0; b < own.places.size(); ++b) {
        own.begin.push_back(leaves);
        leaves += std::size_t(own.places.active(b).count());
    }
    own.counts.resize(leaves);
    balls.forEach([&](const Ball& ball, std::size_t) {
        const Coord place = placeOf(ball);
        ++own.counts[own.indexOf(blockOf(place), offsetIn(place))];
    });
    return own;
}

/// As occupancyOf(), of balls that are never in memory together and none of which is large.
Occupancy occupancyInBlocks(const RepeatedBalls& balls, double voxel, double reach,
                            const Progress& progress)
{
    const double edge = leafDim * voxel;
    const int steps = int(std::ceil((largestRadius(balls.distinct()) + reach) / edge));
    Occupancy out;
    out.own = ownLeaves(balls, edge);
    stopIfCancelled(progress);
    out.blocks = dilatedBy(out.own.places, steps, progress);
    for (std::size_t b = 0; b < out.blocks.size(); ++b)
        out.blocks.active(b).forEach([&](int v) {
            out.box.expand(out.blocks.origin(b).offsetBy(v >> 6, v >> 3 & 7, v & 7));
        });
    out.box.expand(1); // as that of a list
    return out;
}

/// The leaves of a whole.
Occupancy occupancyOf(const BallSet& atoms, double voxel, double reach, double most,
                      const Progress& progress)
{
    const RepeatedBalls whole = repeatedBalls(atoms);
    if (!atoms.placement.folded) return occupancyOf(atoms.balls, voxel, reach, most, progress);
    for (const Ball& ball : atoms.balls)
        if (isLarge(ball, leafDim * voxel))
            return occupancyOf(whole.unfolded(), voxel, reach, most, progress);
    return occupancyInBlocks(whole, voxel, reach, progress);
}

/// How many numbers a voxel has in the grids that go along with the surface.
int valuesAlong(const SurfaceOptions& options)
{
    int values = 0;
    for (const std::string& name : options.fields)
        if (const FieldRow* field = findField(name)) values += field->values;
    return values;
}

/// @param[in] leaves  within the halo of the flow
double secondsOfFlow(const SurfaceOptions& options, double leaves)
{
    if (isGaussian(rowOf(options.kind))) return secondsPerGaussLeaf * leaves;
    const EvolveOptions& flow = options.evolution;
    const bool fronts = hasFlow(options.kind) && makesNewtonSteps(flow) && !decidesGaps(flow);
    double times = fronts ? timesOfFronts : 1.0;
    if (hasFlow(options.kind) && flow.flow == Flow::Paper)
        times += timesPerPaperStep * flow.steps.value_or(flow.maxSteps.value_or(defaultPaperSteps));
    return times * secondsPerFlowLeaf * leaves;
}

/// Whether bricks start from the rest of the whole on coarser voxels.
bool startsCoarse(const SurfaceOptions& options)
{
    return hasFlow(options.kind) && startsOnCoarserVoxels(options.evolution, options.voxel);
}

class Planner
{
public:
    /// @param[in] grain  edge of the voxels whose leaves are counted [Å]; above that of the options
    ///                   for estimates of the whole
    /// @param[in] most   leaves that are listed: infinite but for estimates of the whole
    Planner(const BallSet& atoms, const SurfaceOptions& options, const Influence& influence,
            double grain, double most, const Progress& progress)
        : options_(options), influence_(influence), grain_(grain),
          atoms_(repeatedBalls(atoms).size()), atomsHeld_(double(atoms_)),
          occupancy_(occupancyOf(atoms, grain, influence.ofSurface(), most, progress)),
          weight_(occupancy_.sample.every),
          excluded_(options.closedForm && isMeasured(options) && offsetOf(options) > 0.0)
    {
    }

    const CoordBBox& box() const { return occupancy_.box; }

    /// So many voxels are expected of the whole, which leaves near balls alone do not show.
    /// @param[in] power  of the share of these leaves where it is below 1: a half of bricks, some
    /// of
    ///                   which have more of the surface than others
    void expect(double voxels, double power)
    {
        const double counted = leavesOf(double(occupancy_.size()));
        // The distances from a wide probe's surface fill more than the band of the one inside.
        constexpr double least = 0.35;
        if (voxels <= 0.0 || counted <= 0.0) return;
        const double share = std::max(least, voxels / (voxelsPerLeaf * counted));
        share_ = share < 1.0 ? std::pow(share, power) : share;
    }

    /// Whether estimates are of processes that keep the memory of one brick for the next.
    void setKeeping(bool keeping) { keeping_ = keeping; }

    /// Estimates are of processes that read the balls near a brick from a file.
    void readFromDisk() { atomsHeld_ = 0.0; }

    /// Counts leaves and balls in the box and its halos, and weights them by the constants
    /// above. The memory is the larger of two peaks, the flow's and the mesh's, on top of what
    /// is always there.
    /// @param[in] box  of places
    PlannedBrick estimate(const CoordBBox& box) const
    {
        PlannedBrick brick;
        brick.box = CoordBBox(originOf(box.min()), originOf(box.max()).offsetBy(leafDim - 1));
        Region region;
        region.owned = brick.box;
        const Scope scope = brickScope(options_, region, influence_.extent());
        const int reach = int(std::ceil(influence_.onVoxels() / leafDim / grain_));
        const int widest = std::max(scope.flowHalo, scope.splineHalo);
        CoordBBox splined = box, flowed = box, near = box;
        splined.expand(scope.splineHalo);
        flowed.expand(widest);
        near.expand(widest + reach);
        const double count = leavesOf(1.0) * share_;
        double own = 0, inSpline = 0, inFlow = 0;
        std::size_t balls = 0;
        occupancy_.forEach(near, [&](const Coord& place, std::uint32_t atoms) {
            balls += weight_ * atoms;
            inFlow += count * flowed.isInside(place);
            inSpline += count * splined.isInside(place);
            if (!box.isInside(place)) return;
            brick.atoms += weight_ * atoms;
            own += count;
        });
        // Grids with wider bands may have leaves in a box that holds no other.
        brick.voxels = std::max(std::size_t(voxelsPerLeaf * own), std::size_t(inSpline > 0.0));
        brick.bytes = std::size_t(bytesOf(double(balls), inFlow, inSpline, box == occupancy_.box) +
                                  bytesPerValueOfLeaf * valuesAlong(options_) * own);
        const double filled = options_.fillCavities ? timesOfFill : 1.0;
        brick.seconds = filled * secondsPerLeaf * inSpline + secondsPerAtom * double(balls) +
                        (isUnion(options_.kind) ? secondsPerBoundaryBall * double(balls)
                                                : secondsOfFlow(options_, inFlow));
        return brick;
    }

    /// Leaves of the whole on voxels twice as large.
    double coarseLeaves() const
    {
        constexpr double share = 0.3; // a fourth for a surface, and its band is wider
        return share * share_ * leavesOf(double(occupancy_.size()));
    }

    /// Peak memory of the flow of the whole on voxels twice as large [byte].
    double coarseBytes() const
    {
        return processBytes + (bytesPerAtom + bytesPerNear) * double(atoms_) +
               bytesPerFlowLeaf * coarseLeaves();
    }

    /// Cuts a box in two across its longest axis, `share` of the leaves in the first. False if it
    /// is too small.
    bool cut(const CoordBBox& box, double share, CoordBBox& first, CoordBBox& second) const
    {
        const int axis = int(box.extents().maxIndex());
        const int length = box.dim()[axis];
        if (length < 2 * smallest) return false;
        std::vector<std::size_t> counts(std::size_t(length), 0);
        std::size_t total = 0;
        occupancy_.forEach(box, [&](const Coord& place, std::uint32_t) {
            ++counts[std::size_t(place[axis] - box.min()[axis])];
            ++total;
        });
        int best = smallest;
        double least = 1e300;
        std::size_t below = 0;
        for (int i = 0; i < length; ++i) {
            if (i >= smallest && i <= length - smallest) {
                const double off = std::abs(double(below) - share * double(total));
                if (off < least) {
                    least = off;
                    best = i;
                }
            }
            below += counts[std::size_t(i)];
        }
        first = second = box;
        first.max()[axis] = box.min()[axis] + best - 1;
        second.min()[axis] = box.min()[axis] + best;
        return true;
    }

    /// Cuts a box into parts, up to the first one that takes more than a memory [byte].
    /// @return whether none does
    bool cutInto(std::size_t parts, const CoordBBox& box, std::size_t memory,
                 std::vector<PlannedBrick>& out) const
    {
        CoordBBox first, second;
        const std::size_t half = parts / 2;
        if (parts < 2 || !cut(box, double(half) / double(parts), first, second)) {
            const PlannedBrick brick = estimate(box);
            keep(brick, out);
            return brick.voxels == 0 || memoryFor(brick) <= memory;
        }
        return cutInto(half, first, memory, out) && cutInto(parts - half, second, memory, out);
    }

    /// As few bricks as fit, since they overlap; none if those of one size do not.
    std::vector<PlannedBrick> cutEvenly(std::size_t memory, const CoordBBox& box) const
    {
        std::vector<PlannedBrick> out;
        const std::size_t least = memoryFor(estimate(box)) / memory + 1;
        for (std::size_t parts = least; parts <= 2 * least + 1; ++parts) {
            out.clear();
            if (cutInto(parts, box, memory, out)) return out;
        }
        return {};
    }

    /// @param[in,out] most  what a brick that cannot be cut takes [byte]
    void halve(std::size_t memory, const CoordBBox& box, std::vector<PlannedBrick>& out,
               std::size_t& most) const
    {
        const PlannedBrick brick = estimate(box);
        CoordBBox first, second;
        if (memoryFor(brick) <= memory) {
            keep(brick, out);
        } else if (cut(box, 0.5, first, second)) {
            halve(memory, first, out, most);
            halve(memory, second, out, most);
        } else {
            most = std::max(most, memoryFor(brick));
        }
    }

    /// @throws Error(ErrorKind::Input) if a brick that cannot be cut takes more
    void halve(std::size_t memory, const CoordBBox& box, std::vector<PlannedBrick>& out) const
    {
        std::size_t most = 0;
        halve(memory, box, out, most);
        if (most > memory) tooLittle("the smallest brick", double(most), memory);
    }

    [[noreturn]] static void tooLittle(const char* what, double bytes, std::size_t memory)
    {
        throw Error(
            ErrorKind::Input,
            formatted("`memory`: %s needs %s, and there are %s [hint: `memory` %.0fM, or a larger "
                      "`voxel`]",
                      what, sizeText(bytes).c_str(), sizeText(double(memory)).c_str(),
                      std::ceil(1.1 * bytes / double(1 << 20))));
    }

private:
    /// Leaves of the options' voxels for those that are listed: a surface's grow by the square.
    double leavesOf(double listed) const
    {
        return listed * weight_ * std::pow(grain_ / options_.voxel, 2);
    }

    /// The larger of three peaks on top of what is always there: the boundaries of balls with the
    /// distances from them, the flow, and the mesh.
    /// @param[in] balls  near the brick
    double bytesOf(double balls, double inFlow, double inSpline, bool whole) const
    {
        const double h = options_.voxel, probe = probeOf(options_);
        const double always = processBytes + bytesPerAtom * atomsHeld_ + bytesPerNear * balls +
                              (startsCoarse(options_) ? bytesPerCoarseLeaf * coarseLeaves() : 0.0);
        const double ofBoundary =
            isUnion(options_.kind) ? bytesPerBoundaryBall / (1.0 + sharePerProbe * probe) : 0.0;
        const double ofClosedForm =
            excluded_ && whole
                ? bytesPerExcludedBall / (1.0 + fewerPerProbe3 * probe * probe * probe)
                : 0.0;
        const double forBalls =
            (ofBoundary + ofClosedForm) * balls + bytesPerDistanceLeaf * inSpline;
        const double perLeaf = hasFlow(options_.kind)   ? bytesPerMeshLeaf
                               : isUnion(options_.kind) ? bytesPerUnionLeaf
                                                        : bytesPerGaussLeaf + morePerGaussVoxel * h;
        // The stages after the flow run twice, the second time beside the first level set.
        const double filled = options_.fillCavities ? timesOfFill : 1.0;
        const double forMesh = std::max(filled * perLeaf * inSpline, forBalls);
        const double forFlow = isUnion(options_.kind) ? 0.0 : bytesPerFlowLeaf * inFlow;
        return always +
               (keeping_ ? bytesPerKeptLeaf * inFlow + forMesh : std::max(forFlow, forMesh));
    }

    static void keep(const PlannedBrick& brick, std::vector<PlannedBrick>& out)
    {
        if (brick.voxels > 0) out.push_back(brick);
    }

    const SurfaceOptions& options_;
    const Influence& influence_;
    bool keeping_ = false;
    double grain_;
    std::size_t atoms_;
    double atomsHeld_; // by the process of a brick
    Occupancy occupancy_;
    double share_ = 1.0; // of the leaves that are counted, those that are expected
    unsigned weight_;    // leaves for which one of the sample stands
    bool excluded_;      // whether the whole has the closed form of a solvent-excluded surface
};

double secondsOf(const std::vector<PlannedBrick>& bricks)
{
    double seconds = 0.0;
    for (const PlannedBrick& brick : bricks) seconds += brick.seconds;
    return seconds;
}

/// The number of steps that all bricks make.
int stepsOf(const SurfaceOptions& options)
{
    if (restsInClosedForm(options)) return 0;
    if (options.evolution.steps) return *options.evolution.steps;
    return startsCoarse(options) ? BrickPlan::defaultFrontSteps : BrickPlan::defaultSteps;
}

/// How the leaves of a plan are counted.
struct Counting {
    double grain;        ///< see Planner
    double most;         ///< see Planner
    double voxels = 0.0; ///< that are expected; 0: those of the leaves that are counted
    double power = 1.0;  ///< see Planner::expect()
};

/// Cuts by the limits; without any the whole is one brick.
BrickPlan makePlan(const BallSet& atoms, const SurfaceOptions& options, const Influence& influence,
                   const BrickLimits& limits, const Counting& counting, const Progress& progress)
{
    checkBalls(atoms.balls, options, Pieces::Bricks,
               limits.memory > 0 ? limits.memory : availableMemory());
    BrickPlan plan;
    plan.maxRadius = influence.extent().maxRadius;
    plan.maxGrownRadius = influence.extent().maxGrownRadius;
    plan.maxTolerance = influence.extent().maxTolerance;
    plan.atoms = repeatedBalls(atoms).size();
    plan.steps = stepsOf(options);
    Planner planner(atoms, options, influence, counting.grain, counting.most, progress);
    planner.expect(counting.voxels, counting.power);
    if (limits.atomsOnDisk) planner.readFromDisk();
    const CoordBBox& box = planner.box();
    if (limits.memory > 0) {
        plan.bricks = planner.cutEvenly(limits.memory, box);
        if (plan.bricks.empty()) {
            planner.halve(limits.memory, box, plan.bricks);
        } else if (limits.oneProcess) {
            planner.setKeeping(true);
            constexpr double worth = 1.1; // of the time: what asking anew takes
            auto kept = planner.cutEvenly(limits.memory, box);
            plan.keepsMemory = !kept.empty() && secondsOf(kept) < worth * secondsOf(plan.bricks);
            if (plan.keepsMemory) plan.bricks = std::move(kept);
        }
        if (startsCoarse(options)) {
            const double coarse = planner.coarseBytes();
            if (coarse > double(limits.memory))
                Planner::tooLittle("the flow on coarser voxels", coarse, limits.memory);
        }
        double voxels = 0.0;
        for (const PlannedBrick& brick : plan.bricks) voxels += double(brick.voxels);
        const double merge = processBytes + bytesToMerge * voxels;
        if (merge > double(limits.memory)) Planner::tooLittle("the merge", merge, limits.memory);
    } else {
        constexpr auto any = std::numeric_limits<std::size_t>::max();
        planner.cutInto(std::max<std::size_t>(limits.bricks, 1), box, any, plan.bricks);
    }
    plan.anchor = Coord::floor(0.5 * leafDim * (box.min() + box.max()).asVec3d());
    return plan;
}

/// Memory of the upper nodes of OpenVDB's trees beyond those of a compact molecule, for the grid
/// and for the mesher's own: atoms far from each other have nodes of their own.
double bytesOfNodes(const std::vector<Ball>& balls, double voxel)
{
    constexpr double ofBoth = 1.03e6; // two levels; 2,000 atoms took 2.8 GB, 0.7 were estimated
    constexpr double edge = 4096.0;   // of the upper one [voxel]
    constexpr std::size_t compact = 8;
    std::vector<Coord> nodes;
    for (const Ball& ball : balls) nodes.push_back(Coord::floor(ball.center / (edge * voxel)));
    tbb::parallel_sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes.size() > compact ? ofBoth * double(nodes.size() - compact) : 0.0;
}

/// Adds what products take beside the level set and the mesh that are kept for them.
void addProducts(const BallSet& atoms, const SurfaceOptions& options, const SurfaceSize& size,
                 PlannedBrick& whole)
{
    const Cost cost = costOfProducts(atoms, options, size);
    const double held = processBytes + bytesPerAtom * size.balls + keptBytes(size) +
                        bytesPerValueOfLeaf * valuesAlong(options) * size.voxels / voxelsPerLeaf;
    if (cost.bytes > 0.0) whole.bytes = std::max(whole.bytes, std::size_t(held + cost.bytes));
    whole.seconds += cost.seconds;
}

} // namespace

BrickPlan planBricks(const BallSet& atoms, const SurfaceOptions& options, const BrickLimits& limits,
                     const Progress& progress)
{
    checkWay(InBricks, options);
    constexpr double all = std::numeric_limits<double>::infinity();
    return makePlan(atoms, options, Influence(atoms, options), limits,
                    {options.voxel, all, sizeOf(atoms, options).voxels, 0.5}, progress);
}

BrickPlan planWhole(const BallSet& atoms, const SurfaceOptions& options, const Progress& progress)
{
    const Influence influence(atoms, options);
    const double grain = grainOf(atoms.balls, options.voxel, influence.ofSurface());
    constexpr double most = 1.5e6; // leaves, in 18 MB
    const SurfaceSize size = sizeOf(atoms, options);
    BrickPlan plan =
        makePlan(atoms, options, influence, {1, 0}, {grain, most, size.voxels}, progress);
    plan.bricks[0].bytes += std::size_t(bytesOfNodes(atoms.balls, options.voxel));
    addProducts(atoms, options, size, plan.bricks[0]);
    return plan;
}

std::size_t memoryFor(const PlannedBrick& brick)
{
    constexpr double margin = 1.15; // two of 280 peaks were above that times their estimate
    return std::size_t(processBytes + margin * (double(brick.bytes) - processBytes));
}

void checkCost(const PlannedBrick& surface, const RunLimits& limits)
{
    PlannedBrick cost = surface;
    cost.bytes += limits.besides.bytes;
    cost.seconds += limits.besides.seconds;
    if (cost.bytes > limits.memory) {
        const std::string text = "the surface takes about " + sizeText(double(cost.bytes)) +
                                 " of memory, and there are " + sizeText(double(limits.memory));
        std::string hint = limits.hint;
        if (limits.bricks && bytesToMerge * double(cost.voxels) < 0.5 * double(limits.memory)) {
            hint += formatted(", or `memory` %.2gG, which makes it in bricks",
                              0.8 * double(limits.memory) / (1 << 30));
        }
        throw Error(ErrorKind::Input, text + hint + "]", true);
    }
    const double hours = cost.seconds / limits.threads / 3600.0;
    if (hours <= limits.hours) return;
    const std::string threads = counted(std::size_t(limits.threads), "thread", "threads");
    throw Error(ErrorKind::Input,
                formatted("the surface takes about %.3g hours on %s, expected at most %g%s, or "
                          "`maxHours` %.0f]",
                          hours, threads.c_str(), limits.hours, limits.hint,
                          std::ceil(1.1 * hours)));
}

double checkCost(const BallSet& atoms, const SurfaceOptions& options, const RunLimits& limits,
                 const Progress& progress)
{
    checkBalls(atoms.balls, options, options.grid ? Pieces::One : Pieces::NoGrid, limits.memory);
    // Bounds first, with a factor of 2 to spare: most surfaces are far below the limits, and need
    // no plan.
    constexpr double mostPerLeaf = 512.0, bytesAtMost = 60e3;
    const double leaves = options.grid ? leavesAtMost(atoms.balls, options.voxel,
                                                      Influence(atoms, options).ofSurface())
                                       : 0.0;
    const double balls = double(atoms.balls.size());
    const Cost products =
        costOfProducts(atoms, options, mostOf(atoms, options, mostPerLeaf * leaves));
    const double bytes = processBytes + double(limits.besides.bytes) + products.bytes +
                         (bytesPerAtom + bytesPerNear + bytesPerBoundaryBall +
                          (options.closedForm ? bytesPerExcludedBall : 0.0)) *
                             balls +
                         (bytesAtMost + 3.0 * bytesPerValueOfLeaf * valuesAlong(options)) * leaves;
    const double seconds = limits.besides.seconds + products.seconds +
                           3.0 * (secondsPerLeaf * leaves + secondsOfFlow(options, leaves)) +
                           (secondsPerAtom + secondsPerBoundaryBall) * balls;
    if (bytes < double(limits.memory) && seconds < 3600.0 * limits.hours * limits.threads)
        return seconds;
    const PlannedBrick cost =
        (options.grid ? planWhole(atoms, options, progress) : planWithoutGrid(atoms, options))
            .bricks[0];
    checkCost(cost, limits);
    return cost.seconds + limits.besides.seconds;
}

void checkMemory(const BallSet& atoms, const SurfaceOptions& options, std::size_t memory,
                 const Progress& progress)
{
    constexpr double anyHours = std::numeric_limits<double>::infinity();
    if (options.grid)
        checkCost(atoms, options, {memory > 0 ? memory : availableMemory(), anyHours, 1}, progress);
}

PlannedBrick costOfStored(const VdbContent& content)
{
    const double leaves = double(content.leaves);
    PlannedBrick cost;
    cost.voxels = std::size_t(voxelsPerLeaf * leaves);
    cost.bytes = std::size_t(processBytes + double(content.bytes) +
                             (content.spline ? bytesPerMeshLeaf : bytesPerFittedLeaf) * leaves);
    cost.seconds =
        secondsOfStart + (content.spline ? secondsPerSplineLeaf : secondsPerFittedLeaf) * leaves;
    return cost;
}

PlannedBrick costOfMesh(std::size_t bytes, bool flat)
{
    PlannedBrick cost;
    cost.voxels = std::size_t(double(bytes) * (flat ? 1.0 : 0.5) / bytesOfPlyPerVoxel);
    cost.bytes = std::size_t(processBytes + bytesPerReadVoxel * double(cost.voxels));
    cost.seconds = secondsOfStart;
    return cost;
}

PlannedBrick costOfComparison(const PlannedBrick& a, const PlannedBrick& b)
{
    PlannedBrick cost;
    cost.voxels = a.voxels + b.voxels;
    cost.bytes = a.bytes + b.bytes - std::size_t(processBytes);
    cost.seconds = a.seconds + b.seconds + secondsPerComparedVoxel * double(cost.voxels);
    return cost;
}

PlannedBrick costOfMap(const BallSet& atoms, const SurfaceOptions& options)
{
    const openvdb::BBoxd box = boxOf(atoms.balls, Influence(atoms, options).ofLabel());
    PlannedBrick cost;
    if (!box.empty())
        cost.seconds = secondsPerMapPoint * (box.extents() / options.voxel + 1.0).product();
    return cost;
}

BrickPlan planWithoutGrid(const BallSet& atoms, const SurfaceOptions& options)
{
    BrickPlan plan;
    plan.atoms = atoms.balls.size();
    PlannedBrick& one = plan.bricks.emplace_back();
    const SurfaceSize size = sizeOf(atoms, options);
    const double probe = probeOf(options), probe3 = probe * probe * probe;
    double perBall =
        bytesPerAtom + bytesPerNear + bytesPerBoundaryBall / (1.0 + sharePerProbe * probe);
    if (offsetOf(options) > 0.0) perBall += bytesPerExcludedBall / (1.0 + fewerPerProbe3 * probe3);
    one.bytes = std::size_t(processBytes + perBall * size.balls);
    one.seconds = secondsOfStart + (secondsPerAtom + secondsPerBoundaryBall) * size.balls;
    addProducts(atoms, options, size, one);
    return plan;
}

PlannedBrick costOfPicture(std::size_t voxels, int width, bool isLayered)
{
    const double pixels = double(width) * double(width);
    PlannedBrick cost;
    cost.bytes = std::size_t((bytesPerPixel + (isLayered ? bytesPerLayeredPixel : 0.0)) * pixels +
                             bytesPerDrawnVoxel * double(voxels));
    cost.seconds = secondsPerPixel * pixels + secondsPerDrawnVoxel * double(voxels);
    return cost;
}

void checkPlan(const BrickPlan& plan, const SurfaceOptions& options)
{
    const auto check = [](bool good, const char* what) {
        if (!good) throw Error(ErrorKind::Input, std::string("the plan is damaged: ") + what);
    };
    check(plan.steps == stepsOf(options), "its steps are not those of its options");
    const CoordBBox space = anySpace();
    check(space.isInside(plan.anchor), "its anchor is far away");
    check(!plan.bricks.empty(), "it has no bricks");
    for (const PlannedBrick& brick : plan.bricks) {
        const Coord &min = brick.box.min(), &max = brick.box.max();
        check(!brick.box.empty() && space.isInside(min) && space.isInside(max) &&
                  (min & (leafDim - 1)) == Coord(0) && (max & (leafDim - 1)) == Coord(leafDim - 1),
              "a brick is no box of whole leaves");
    }
}

void checkExtent(const BrickPlan& plan, const GaussianExtent& extent)
{
    const auto equal = [](double a, double b) { return std::abs(a - b) <= 1e-6 * std::abs(b); };
    if (equal(plan.maxRadius, extent.maxRadius) &&
        equal(plan.maxGrownRadius, extent.maxGrownRadius) &&
        equal(plan.maxTolerance, extent.maxTolerance))
        return;
    throw Error(ErrorKind::Input, "the plan is damaged: its largest ball is not that of the atoms");
}

GaussianExtent extentOf(const BrickPlan& plan)
{
    return {plan.maxRadius, plan.maxGrownRadius, plan.maxTolerance};
}

Scope scopeOf(const BrickPlan& plan, std::size_t k, const SurfaceOptions& options)
{
    Scope scope = brickScope(options, {plan.bricks[k].box, plan.anchor}, extentOf(plan));
    scope.keepsMemory = plan.keepsMemory;
    return scope;
}

void computeBrick(const BallSource& balls, const SurfaceOptions& options, const BrickPlan& plan,
                  std::size_t number, const std::string& id, const std::string& path, bool meshed,
                  std::shared_ptr<const SparseField>& coarse, Progress& progress)
{
    SurfaceOptions fixed = options;
    if (!restsInClosedForm(fixed)) fixed.evolution.steps = plan.steps;
    Scope scope = scopeOf(plan, number - 1, fixed);
    if (!coarse && startsCoarse(fixed)) {
        Report ofCoarse;
        coarse = std::make_shared<SparseField>(
            restOnCoarserVoxels(inSpatialOrder(balls(everywhere())), fixed, progress, ofCoarse));
    }
    scope.coarseRest = coarse;
    const BallSet near = inSpatialOrder(balls(spaceNear(fixed, scope))); // as in a run of the whole
    const Brick brick = runBrick(near, fixed, scope, progress);
    progress.update("write", 0.0);
    OutputFile file(path, true);
    writeBrick(brick, id, number, meshed, file, progress);
    file.commit();
}

} // namespace molsurf
