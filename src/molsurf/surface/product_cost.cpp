// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/product_cost.h"

#include "molsurf/analysis/measures/shape_complementarity.h"
#include "molsurf/kernel/balls/ball_index.h"
#include "molsurf/kernel/balls/sampled_union.h"
#include "molsurf/kernel/grid/leaf_mask.h"
#include "molsurf/kernel/pipeline/influence.h"
#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/molecule/selection/subset.h"
#include "molsurf/surface/field_table.h"
#include "molsurf/surface/pockets.h"
#include "molsurf/surface/product_table.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace molsurf
{

namespace
{

// All constants are of one core of a Xeon of 2.6 GHz and of the runs of bench/estimates.py.
constexpr double bytesPerKeptVoxel = 45.0; // of the grid, the spline and the mesh

// The area of a kind by that of the spheres on which it lies, of 1A8O, 4AT1, 1AOI, 2BUK, 1F2N and
// 4V5A on voxels of 0.5 to 2 Å: ses 0.9 to 1.15; variational and smooth-sas 0.73 to 0.8 (1.0 with
// an epsilon of 0.1), gaussian 0.6 to 0.79, both of which tolerances of about 0.5 Å smooth.
constexpr double excludedArea = 1.05, lessPerTolerance = 0.7;

// measured: build --pockets of 1A8O, 4AT1, 1AOI, voxels of 0.25 to 1 Å, --probe-out 4 to 50
constexpr double secondsOfGraph = 1.5e-4, secondsOfRooms = 4.7e-5; // a ball; at 1 Å
constexpr double secondsOfHull = 7e-6; // for each Å of the large probe above 4
constexpr double bytesOfGraph = 1.1e3, bytesOfRooms = 2.8e3; // a ball; at 1 Å
constexpr double bytesOfHull = 95.0; // for each Å^2 of that, of balls^0.83: the outside counts

// measured: build --patches hydrophobicity>0 and mean-curvature<-0.1 of 4AT1
constexpr double secondsPerPatched = 4e-7, bytesPerPatched = 10.0; // a voxel

// measured: build --color mean-curvature --smooth-colors 1 to 20 of 4AT1, voxels of 0.5 and 1 Å
constexpr double secondsPerMean = 7e-7, bytesPerMean = 50.0; // a vertex
constexpr double secondsPerPairOfMeans = 8e-9;               // of vertices within the radius
constexpr double verticesPerVoxel = 1.5;                     // of h^2 of a surface

// measured: build --pore auto of 1A8O, 4AT1, 1AOI, 1IGY, 2BUK
constexpr double secondsOfPore = 1.2e-4, bytesOfPore = 4.3e3; // a ball
// measured: --tunnels-from of 1ACJ and 4AT1, --tunnel-probe 0.3 to 1.4
constexpr double secondsOfTunnels = 1.2e-4, bytesOfTunnels = 4.3e3; // a ball

// measured: build -o NAME.atoms.csv, .contacts.csv, --fields depth of 1A8O, 4AT1, 1AOI, 2BUK, 4V5A
constexpr double secondsPerArea = 3e-6, bytesPerArea = 300.0;
constexpr double secondsPerContact = 3.2e-5, bytesPerContact = 3.0e3;
constexpr double secondsPerDepth = 2e-5, bytesPerDepth = 900.0;
// measured: build --interfaces of 4AT1, 1AOI, both kinds in closed form, and 400 to 20,000
// chains of one bead
constexpr double secondsPerAlone = 1.5e-5;                          // a ball
constexpr double secondsPerFacing = 1.5e-4, bytesPerFacing = 1.4e4; // a ball of a pair of groups
constexpr double secondsPerSphere = 1.2e-5;                         // that is its group
constexpr double bytesPerPair = 1.35e3;                             // of groups, its rows

// measured: build --remesh of 1CRN and 4AT1 on voxels of 0.5 and 1 Å, 0.12 to 2 Å, and --adapt
constexpr double secondsPerMeshed = 1.4e-6;                             // voxel of the mesh before
constexpr double secondsPerTriangle = 6.7e-6, bytesPerTriangle = 130.0; // of that after
constexpr double timesOfAdapt = 2.7, bytesOfAdapt = 2.0;                // of the time
constexpr double bend = 1.5;         // radius [Å] that triangles of --adapt follow
constexpr double morePerEdge = 1.18; // triangles than equal ones of this edge would be

// measured: build --min-thickness of 1CRN and 4AT1, walls of 2 to 100 Å on voxels of 0.5 and 1 Å
constexpr double secondsPerWallLeaf = 2.5e-4, bytesPerWallLeaf = 6e3;

// measured: build --resolution 5 or 10 --match-volume of 1A8O, 4AT1, 1AOI
constexpr double runsOfMatch = 5.0, secondsPerMatched = 1e-6, secondsPerMatchedBall = 5e-6;

constexpr double secondsPerBent = 1.5e-6;   // voxel, where curvature is integrated
constexpr double secondsPerValue = 8e-8;    // of a voxel of a grid beside `surface`
constexpr double secondsPerMeasured = 2e-8; // voxel

/// The area of a surface by that of the spheres on which it lies. A tolerance smooths these, but no
/// surface has less area than a ball of its volume.
double areaOf(const BallSet& atoms, const SurfaceSpec& spec)
{
    const double grown = probeOf(spec), spheres = sampledArea(repeatedBalls(atoms), grown);
    if (isUnion(spec.kind)) return offsetOf(spec) > 0.0 ? excludedArea * spheres : spheres;
    const double tolerance = Influence(atoms, spec).extent().maxTolerance;
    const double ofBall =
        std::cbrt(36.0 * M_PI * std::pow(sampledVolume(repeatedBalls(atoms), grown), 2));
    return std::max(excludedArea * spheres / (1.0 + lessPerTolerance * tolerance), ofBall);
}

Cost perBall(const SurfaceSize& size, double seconds, double bytes)
{
    return {seconds * size.balls, bytes * size.balls};
}

/// How many balls face other groups that bury some of their own, each counted for every such group.
struct Facings {
    double all = 0.0, spheres = 0.0; ///< spheres: those of groups of one ball
    double ofPair = 0.0;             ///< of the two groups that have most
    double pairs = 0.0;              ///< of groups
};

/// The groups that a ball faces, and how wide the gaps to them are [Å].
std::map<std::int32_t, double> facedBy(const BallSet& atoms, std::size_t i, const BallIndex& index)
{
    const std::vector<std::int32_t>& groups = atoms.labels->groupOf;
    const Ball& ball = atoms.balls[i];
    std::map<std::int32_t, double> out;
    index.forEachNear(
        ball.center, ball.center, ball.radius + fitReach, [&](const Ball& other, std::int32_t j) {
            const std::int32_t group = groups[std::size_t(j)];
            if (group < 0 || group == groups[i]) return;
            const double gap = (other.center - ball.center).length() - ball.radius - other.radius;
            if (gap >= fitReach) return;
            double& least = out.emplace(group, gap).first->second;
            least = std::min(least, gap);
        });
    return out;
}

/// From a sample of balls.
Facings facingsOf(const BallSet& atoms, const SurfaceSpec& spec)
{
    constexpr std::size_t sampled = 2000;
    if (!atoms.labels) return {};
    struct Pair {
        double faces = 0.0, spheres = 0.0;
        bool buries = false;
    };
    const std::vector<std::int32_t>& groups = atoms.labels->groupOf;
    const BallIndex index(atoms.balls, {0.5, 0.0, 4.0});
    const std::size_t step = std::max<std::size_t>(groups.size() / sampled, 1);
    std::vector<std::size_t> members(atoms.labels->groups.size());
    for (const std::int32_t group : groups)
        if (group >= 0) ++members[std::size_t(group)];
    std::map<std::pair<std::int32_t, std::int32_t>, Pair> pairs;
    for (std::size_t i = 0; i < groups.size(); i += step) {
        if (groups[i] < 0) continue;
        const bool isSphere = members[std::size_t(groups[i])] == 1;
        for (const auto& [other, gap] : facedBy(atoms, i, index)) {
            Pair& pair = pairs[std::minmax(groups[i], other)];
            pair.faces += double(step);
            pair.spheres += isSphere ? double(step) : 0.0;
            pair.buries = pair.buries || gap < 2.0 * probeOf(spec);
        }
    }
    Facings out;
    for (const auto& [names, pair] : pairs) {
        if (!pair.buries) continue;
        out.all += pair.faces;
        out.spheres += pair.spheres;
        out.pairs += std::max(0.5 * pair.spheres, 1.0); // two spheres make one, sampled or not
        out.ofPair = std::max(out.ofPair, pair.faces);
    }
    return out;
}

} // namespace

#ifdef OPENVDB_STATICLIB          // the names of libopenvdb.so take 28 MB
const double processBytes = 32e6; // program, libraries, buffers
#else
const double processBytes = 60e6;
#endif

SurfaceSize sizeOf(const BallSet& atoms, const SurfaceOptions& options)
{
    SurfaceSize size;
    const double h = options.voxel;
    size.balls = double(repeatedBalls(atoms).size());
    size.area = areaOf(atoms, options);
    if (!options.grid) return size;
    // The band is so wide on either side, and lies so far from the balls at most.
    const double width = surfaceWidthVox * h;
    const double ofArea = 2.0 * width * size.area / (h * h * h);
    const double room =
        sampledVolume(repeatedBalls(atoms), growthOf(options) + width) / (h * h * h);
    constexpr double sharp = 4.0; // how fast sheets of a band come to overlap
    if (room > 0.0)
        size.voxels = ofArea / std::pow(1.0 + std::pow(ofArea / room, sharp), 1.0 / sharp);
    return size;
}

SurfaceSize mostOf(const BallSet& atoms, const SurfaceOptions& options, double voxels)
{
    SurfaceSize size;
    size.balls = double(atoms.balls.size());
    size.voxels = voxels;
    const double grown = probeOf(options);
    for (const Ball& ball : atoms.balls)
        size.area += 4.0 * M_PI * (ball.radius + grown) * (ball.radius + grown);
    return size;
}

double keptBytes(const SurfaceSize& size)
{
    return bytesPerKeptVoxel * size.voxels;
}

Cost costOfPockets(const BallSet&, const SurfaceOptions& options, const SurfaceSize& size)
{
    const double h = options.voxel, n = size.balls;
    const double wider = std::max(options.pocket.probeOut - 4.0, 0.0);
    return {
        n * (secondsOfGraph + secondsOfRooms / (h * h) + secondsOfHull * wider * std::pow(h, -2.3)),
        n * (bytesOfGraph + bytesOfRooms / (h * h)) +
            bytesOfHull * std::pow(n, 0.83) * wider * wider * std::pow(h, -2.7)};
}

Cost costOfPatches(const BallSet&, const SurfaceOptions&, const SurfaceSize& size)
{
    return {secondsPerPatched * size.voxels, bytesPerPatched * size.voxels};
}

Cost costOfSmoothing(const BallSet&, const SurfaceOptions& options, const SurfaceSize& size)
{
    const double edge = options.meshEdge > 0.0 ? options.meshEdge : options.voxel;
    const double density = verticesPerVoxel / (edge * edge), vertices = density * size.area;
    const double within = M_PI * options.smoothColors * options.smoothColors * density;
    return {(secondsPerMean + secondsPerPairOfMeans * within) * vertices, bytesPerMean * vertices};
}

Cost costOfPore(const BallSet&, const SurfaceOptions&, const SurfaceSize& size)
{
    return perBall(size, secondsOfPore, bytesOfPore);
}

Cost costOfTunnels(const BallSet&, const SurfaceOptions&, const SurfaceSize& size)
{
    return perBall(size, secondsOfTunnels, bytesOfTunnels);
}

Cost costOfInterfaces(const BallSet& atoms, const SurfaceOptions& options, const SurfaceSize& size)
{
    const Facings facings = facingsOf(atoms, options);
    return {secondsPerAlone * size.balls + secondsPerFacing * (facings.all - facings.spheres) +
                secondsPerSphere * facings.spheres,
            bytesPerFacing * facings.ofPair + bytesPerPair * facings.pairs};
}

Cost costOfAreas(const BallSet&, const SurfaceOptions&, const SurfaceSize& size)
{
    return perBall(size, secondsPerArea, bytesPerArea);
}

Cost costOfContacts(const BallSet&, const SurfaceOptions&, const SurfaceSize& size)
{
    return perBall(size, secondsPerContact, bytesPerContact);
}

Cost costOfDepths(const BallSet&, const SurfaceOptions&, const SurfaceSize& size)
{
    return perBall(size, secondsPerDepth, bytesPerDepth);
}

Cost costOfMeasures(const BallSet&, const SurfaceOptions&, const SurfaceSize& size)
{
    return {secondsPerMeasured * size.voxels, 0.0};
}

Cost costOfWall(const BallSet&, const SurfaceOptions& options, const SurfaceSize& size)
{
    // The room within half a wall of a body: Steiner's formula, of a ball of the same area but for
    // the first term.
    const double t = 0.5 * options.minThickness, h = options.voxel;
    const double room = 2.0 * t * size.area + std::sqrt(4.0 * M_PI * size.area) * t * t +
                        4.0 / 3.0 * M_PI * t * t * t;
    const double leaves = room / std::pow(leafDim * h, 3);
    return {secondsPerWallLeaf * leaves, bytesPerWallLeaf * leaves};
}

Cost costOfCurvature(const BallSet&, const SurfaceOptions&, const SurfaceSize& size)
{
    return {secondsPerBent * size.voxels, 0.0};
}

Cost costOfMatch(const BallSet& atoms, const SurfaceOptions& options, const SurfaceSize& size)
{
    // Runs of their own for each resolution, on voxels of 1 Å at the least.
    const double coarser = std::max(options.voxel, 1.0) / options.voxel;
    return {runsOfMatch * double(atoms.resolutions.size()) *
                (secondsPerMatched * size.voxels / (coarser * coarser) +
                 secondsPerMatchedBall * size.balls),
            0.0};
}

Cost costOfRemesh(const BallSet&, const SurfaceOptions& options, const SurfaceSize& size)
{
    // An edge of length L lies L^2 / 8R from an arc of radius R.
    const bool adapts = options.meshError > 0.0;
    const double edge = adapts
                            ? std::min(options.meshEdge, std::sqrt(8.0 * bend * options.meshError))
                            : options.meshEdge;
    const double triangles = morePerEdge * size.area / (0.25 * std::sqrt(3.0) * edge * edge);
    return {secondsPerMeshed * size.voxels +
                (adapts ? timesOfAdapt : 1.0) * secondsPerTriangle * triangles,
            (adapts ? bytesOfAdapt : 1.0) * bytesPerTriangle * triangles};
}

Cost costOfProducts(const BallSet& atoms, const SurfaceOptions& options, const SurfaceSize& size)
{
    Cost all;
    for (const ProductRow& row : productTable()) {
        if (!row.cost || !row.asked(atoms, options)) continue;
        const Cost one = row.cost(atoms, options, size);
        all.seconds += one.seconds;
        all.bytes = std::max(all.bytes, one.bytes);
    }
    for (const FieldRow& row : fieldTable())
        if (hasField(options.fields, row.name))
            all.seconds += secondsPerValue * row.values * size.voxels;
    return all;
}

} // namespace molsurf
