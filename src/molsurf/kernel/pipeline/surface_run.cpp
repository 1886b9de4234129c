// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/pipeline/surface_run.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/memory.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/kernel/flow/equilibrium.h"
#include "molsurf/kernel/flow/initial_surface.h"
#include "molsurf/kernel/flow/interface_energy.h"
#include "molsurf/kernel/flow/refine.h"
#include "molsurf/kernel/levelset/redistance.h"
#include "molsurf/kernel/levelset/reinitialize.h"
#include "molsurf/kernel/levelset/round_ridges.h"
#include "molsurf/kernel/levelset/thicken.h"
#include "molsurf/kernel/levelset/union_distance.h"
#include "molsurf/kernel/mesh/integrate.h"
#include "molsurf/kernel/mesh/measure.h"
#include "molsurf/kernel/mesh/specks.h"
#include "molsurf/kernel/mesh/statistics.h"
#include "molsurf/kernel/mesh/topology.h"
#include "molsurf/kernel/pipeline/carrier_of.h"
#include "molsurf/kernel/pipeline/check_mesh.h"
#include "molsurf/kernel/pipeline/derived_grids.h"
#include "molsurf/kernel/pipeline/fill_cavities.h"
#include "molsurf/kernel/pipeline/pose_error.h"
#include "molsurf/kernel/pipeline/remesh_run.h"
#include "molsurf/kernel/spline/curvature.h"
#include "molsurf/kernel/spline/fit.h"
#include "molsurf/kernel/topology/gaps_of_sum.h"
#include "molsurf/kernel/topology/walls.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace molsurf
{

void Stopwatch::stop(const char* stage)
{
    const auto now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    report_->addSeconds(stage, seconds);
}

SurfaceRun::SurfaceRun(const BallModel& model, const KernelOptions& options, const Scope& scope,
                       Progress& progress)
    : model_(model), options_(options), scope_(scope), progress_(progress),
      influence_(scope.extent ? Influence(*scope.extent, options_) : Influence(model, options_)),
      watch_(result_.report), bumps_(options.voxel)
{
    band_.phi.voxelSize = S_.phi.voxelSize = options.voxel;
}

void SurfaceRun::density()
{
    if (isUnion(options_.kind)) return;
    progress_.update("density", 0.0);
    const bool evolves = hasFlow(options_.kind);
    GaussianOptions gaussian = gaussianOptions(options_);
    gaussian.extent = influence_.extent();
    sum_.emplace(model_.balls, gaussian, evolves ? model_.decays : std::vector<Decay>());
    if (evolves && startsOnCoarserVoxels(flowOptions(options_), options_.voxel)) {
        refineCoarseRest();
        return;
    }
    GaussianSum::BumpsFor decided;
    if (auto rule = gapRuleOf(options_)) {
        rule->countsClosed =
            options_.needs.passages && model_.decays.empty() && scope_.region.whole();
        decided = [this, rule](const SparseField& psi) {
            gaps_ = GapReport();
            DecidedGaps gaps;
            Bumps bumps = bumpsOfGaps(*sum_, psi, *rule, progress_, *gaps_, &gaps);
            if (rule->countsClosed) passages_ = std::move(gaps.passages);
            return bumps;
        };
    }
    SparseField psi =
        sum_->band(psiBandVox(options_), progress_, scope_.region.grown(scope_.flowHalo), decided);
    bumps_ = sum_->bumps();
    if (psi.table.size() == 0 && scope_.region.whole()) {
        failIfTooCoarse("density: no voxel lies inside the surface", model_.balls, options_);
        failNothingLeft("density", options_.kind);
    }
    watch_.stop("density");
    if (restsInClosedForm(options_)) {
        carrier_ = std::move(psi);
        return;
    }

    progress_.update("initial", 0.0);
    const bool shifted = evolves && makesNewtonSteps(options_.evolution);
    band_.phi = initialSurface(psi, bandWidthVox * psi.voxelSize,
                               shifted ? weightsOf(options_.evolution) : Weights{}, progress_);
    band_.psi = std::move(psi.values);
    watch_.stop("initial");
}

SparseField restOnCoarserVoxels(const BallModel& model, const SurfaceSpec& spec, Progress& progress,
                                Report& report)
{
    SurfaceSpec wide = withVoxel(spec, 2.0 * spec.voxel);
    wide.evolution = coarseFlow(spec.evolution);
    SurfaceRun run(model, {wide, measuresAlone()}, Scope(), progress);
    run.density();
    run.flow();
    for (const auto& [stage, seconds] : run.result_.report.seconds)
        report.addSeconds(stage, seconds);
    return std::move(run.band_.phi);
}

void SurfaceRun::refineCoarseRest()
{
    const openvdb::CoordBBox box = scope_.region.grown(scope_.flowHalo);
    if (scope_.coarseRest) {
        band_.phi = refined(*scope_.coarseRest, box, progress_);
    } else {
        const SparseField coarse = restOnCoarserVoxels(model_, options_, progress_, result_.report);
        watch_ = Stopwatch(result_.report);
        band_.phi = refined(coarse, box, progress_);
    }
    SparseField psi = sum_->evaluate(std::move(band_.phi.table), progress_);
    band_.phi.table = std::move(psi.table);
    band_.psi = std::move(psi.values);
    watch_.stop("initial");
}

void SurfaceRun::rest()
{
    const EvolveOptions evolution = flowOptions(options_);
    const Weights weights = weightsOf(evolution);
    progress_.update("evolve", 0.0);
    SparseField& psi = carrier_;
    const SlopeField slope =
        slopeField(model_, options_, scope_.extent, {psi.table, psi.values}, bumps_, progress_);
    const LeafField levels = levelsAtRest(psi, slope, weights, progress_);
    const RestingLevels rest{levels, slope};
    displacements_ = waysToRest(psi, rest, *sum_, weights, scope_.region, progress_);
    EvolutionReport& report = result_.report.evolution.emplace();
    checkConvergence(displacements_, evolution, options_.voxel, report);
    if (scope_.region.whole()) report.gaps = gaps_;
    carryLevels(rest, bandWidthVox * options_.voxel, psi, progress_);
    watch_.stop("evolve");
}

void SurfaceRun::flow()
{
    if (carrier_.table.size() > 0) return rest();
    if (!hasFlow(options_.kind)) return;
    progress_.update("evolve", 0.0);
    const double reach = gaussianOptions(options_).reach;
    const auto source = [&](const openvdb::Coord& origin, float* psi) {
        sum_->evaluate(origin, reach, psi);
    };
    result_.report.evolution = evolve(band_, source, flowOptions(options_), progress_,
                                      scope_.region, scope_.flowHalo, &displacements_);
    if (scope_.region.whole()) result_.report.evolution->gaps = gaps_;
    watch_.stop("evolve");
}

namespace
{

/// Moves the zero set of a level set inward.
void moveInward(SparseField& S, double offset, const Progress& progress)
{
    if (offset <= 0.0) return;
    parallelFor(S.table.size(), progress, [&](std::size_t n) {
        for (int v = 0; v < leafSize; ++v) S.leaf(n)[v] += float(offset);
    });
}

} // namespace

/// Whether the evolved level set is still needed when S is known.
bool SurfaceRun::keepsLevelSet() const
{
    return options_.fillCavities || (hasFlow(options_.kind) && hasField(options_.fields, "sas"));
}

DistanceBand SurfaceRun::distanceToBalls()
{
    const double probe = offsetOf(options_);
    const bool areas = options_.ballAreas && !options_.fillCavities;
    const bool measured = scope_.region.whole() && !scope_.isUnit && isMeasured(options_) &&
                          (areas || probe == 0.0 || options_.closedForm);
    BallUnion set = unionOf(model_.balls, probeOf(options_), progress_);
    if (probe > 0.0) cuspLength_ = cuspLengthOf(set.boundary, probe);
    if (measured)
        exact_ =
            measureClosedForm(set.boundary, options_, areas ? model_.balls.size() : 0, progress_);
    return distanceToUnion(std::move(set), options_.voxel, widthsOf(options_), progress_,
                           scope_.region.grown(scope_.splineHalo),
                           options_.needs.statistics ? Kinks::Found : Kinks::None);
}

/// The carrier of the interface; frees what later stages do not need.
SparseField SurfaceRun::takeCarrier()
{
    const openvdb::CoordBBox near = scope_.region.grown(scope_.distanceHalo);
    SparseField carrier = carrier_.table.size() == 0
                              ? carrierOf(model_, options_, scope_.extent, band_, bumps_, progress_)
                          : keepsLevelSet() ? copied(carrier_)
                                            : std::move(carrier_);
    if (options_.energy && sum_ && result_.report.evolution) {
        result_.report.evolution->finalEnergy = interfaceEnergy(
            carrier, *sum_, weightsOf(options_.evolution), scope_.region, progress_);
    }
    if (!decidesWalls(options_) && !options_.fillCavities) sum_.reset();
    if (!options_.fillCavities) band_.psi = LeafField();
    band_.phi = keepsLevelSet() ? clipped(std::move(band_.phi), near, progress_) : SparseField();
    return clipped(std::move(carrier), near, progress_);
}

/// Decides the walls of the surface, at the thin places that the closest points of voxels show, and
/// reports them. Nothing needs the sum after that.
std::vector<Decision> SurfaceRun::decideWallsOf(const NearestSeeds& near, const SeedKinks& kinks)
{
    if (!decidesWalls(options_)) return {};
    const double offset = offsetOf(options_);
    const PsiJetAt psi = [&](const openvdb::Vec3d& x) { return sum_->jetWithBumps(x); };
    const std::vector<Decision> walls =
        decideWalls(psi, thinPlaces(near, kinks.turns, offset / options_.voxel, progress_), offset,
                    options_.voxel, progress_);
    if (!options_.fillCavities) sum_.reset(); // whose surface is made a second time
    if (scope_.region.whole())
        result_.report.evolution->walls = reportOf(walls, deepestWall * options_.voxel);
    return walls;
}

DistanceBand SurfaceRun::distanceToInterface()
{
    const double offset = offsetOf(options_);
    const BandWidths widths = widthsOf(options_);
    NearestSeeds near = nearestSeeds(takeCarrier(), widths, -offset,
                                     scope_.region.grown(scope_.ridgeHalo), progress_);
    const bool rounds = hasFlow(options_.kind) && ridgeReach(options_.voxel) > 0;
    SeedKinks kinks = rounds || options_.needs.statistics ? kinksOf(near, progress_)
                                                          : SeedKinks{emptied(near.domain), {}};
    const std::vector<Decision> walls = decideWallsOf(near, kinks);
    DistanceBand S =
        distancesBy(std::move(near), std::move(kinks.kinks), widths, -offset, progress_);
    moveInward(S.phi, offset, progress_);
    openWalls(walls, S.phi);
    if (hasFlow(options_.kind)) roundRidges(S, offset, progress_);
    holdWalls(walls, S.phi);
    return S;
}

void SurfaceRun::distance()
{
    progress_.update("redistance", 0.0);
    if (isUnion(options_.kind)) {
        S_ = distanceToBalls();
        moveInward(S_.phi, offsetOf(options_), progress_);
    } else {
        S_ = distanceToInterface();
    }
    if (options_.minThickness > 0.0)
        thickenWalls(S_, options_.minThickness, splineWidthOf(options_), progress_);
    if (!scope_.keepsMemory) trimHeap();
    watch_.stop("redistance");
}

namespace
{

/// Replaces S near its zero set by the values of a coarser spline; only these voxels stay active.
void resample(SparseField& S, const Spline& spline, const Progress& progress)
{
    const float width = float(splineWidthVox * S.voxelSize);
    parallelFor(S.table.size(), progress, [&](std::size_t n) {
        SplineSampler sampler(spline);
        LeafMask near;
        S.table.active(n).forEach([&](int v) {
            float& value = S.leaf(n)[v];
            if (std::abs(value) >= width) return;
            const openvdb::Coord ijk = S.table.origin(n).offsetBy(v >> 6, v >> 3 & 7, v & 7);
            value = float(sampler.at(ijk.asVec3d() * S.voxelSize).value);
            near.set(v);
        });
        S.table.active(n) = near;
    });
}

} // namespace

void SurfaceRun::spline()
{
    progress_.update("spline", 0.0);
    spline_ = fitSpline(S_.phi, options_.splineLevel, progress_);
    if (options_.splineLevel > 0) resample(S_.phi, spline_, progress_);
    countClosedPassages();
    watch_.stop("spline");
}

/// Reports what the field closes, where the surface that was found is closed: once, before cavities
/// are filled.
void SurfaceRun::countClosedPassages()
{
    if (!passages_) return;
    SplineSampler sampler(spline_);
    const auto isClosed = [&](const openvdb::Vec3d& x) {
        const openvdb::Coord voxel = openvdb::Coord::round(x / spline_.voxelSize());
        return spline_.table().find(voxel) == noLeaf || sampler.at(x).value < 0.0;
    };
    countClosed(*passages_, isClosed, *result_.report.evolution->gaps);
    passages_.reset();
}

void SurfaceRun::levelSet()
{
    progress_.update("redistance", 0.6);
    SparseField S = options_.fillCavities ? copied(S_.phi) : std::move(S_.phi);
    const double width = surfaceWidthVox * S.voxelSize;
    parallelFor(S.table.size(), progress_,
                [&](std::size_t n) { S.table.active(n) &= within(S.leaf(n), float(width)); });
    // Four steps of half a voxel: few values are wrong farther from where sheets of S meet. The
    // first one gives voxels beside the surface, which are all that the mesher reads, their values.
    reinitialize(S, width, options_.needs.levelSet ? 4 : 1, progress_);
    // In the outermost leaf of a brick's S, values may differ from those of the whole surface.
    S = clipped(std::move(S), scope_.region.grown(scope_.splineHalo - 1), progress_);
    if (!scope_.keepsMemory) releasePages(); // grids and meshes have memory of their own
    result_.surface = toLevelSet(S, width, progress_);
    result_.surface->setName("surface");
    S = SparseField();
    if (!scope_.keepsMemory) releasePages();
    watch_.stop("redistance");
}

void SurfaceRun::mesh()
{
    progress_.update("mesh", 0.0);
    stats_ = ExtractStats();
    stats_.keepCells = !scope_.region.whole();
    result_.mesh = extractMesh(*result_.surface, spline_, progress_, stats_);
    checkLeft();
}

void SurfaceRun::checkLeft() const
{
    constexpr std::size_t few = 30; // fewer than a ball has whose radius is a voxel
    const std::size_t triangles = result_.mesh.triangles.size();
    if (!scope_.region.whole() || triangles >= few) return;
    failIfTooCoarse(triangles > 0 ? "mesh: a few triangles are no surface of the molecule"
                                  : "mesh: nothing of the molecule is left",
                    model_.balls, options_);
    if (triangles == 0) failNothingLeft("mesh", options_.kind);
}

void SurfaceRun::toDistance()
{
    density();
    flow();
    distance();
}

void SurfaceRun::toMesh()
{
    toDistance();
    makeMesh();
}

void SurfaceRun::makeMesh()
{
    const auto meshed = [&] {
        spline();
        levelSet();
        mesh();
    };
    meshed();
    if (fillCavities()) meshed();
}

bool SurfaceRun::fillCavities()
{
    if (!options_.fillCavities) return false;
    const std::vector<LeafMask> cavities = cavityVoxels(result_.mesh, S_.phi, progress_);
    if (cavities.empty()) return false;
    if (isUnion(options_.kind)) {
        fillInDistance(cavities, S_.phi, progress_);
    } else {
        carrier_.table.size() > 0 ? fillInCarrier(cavities, S_.phi.table, carrier_, progress_)
                                  : fillInLevelSet(cavities, S_.phi.table, band_.phi, progress_);
        distance();
    }
    return true;
}

void SurfaceRun::resume(Mesh mesh, Spline spline, openvdb::FloatGrid::Ptr surface)
{
    result_.mesh = std::move(mesh);
    result_.surface = std::move(surface);
    spline_ = std::move(spline);
    stored_ = true;
}

void SurfaceRun::curvatures()
{
    addCurvature(spline_, options_.fields, result_.mesh, progress_);
}

GradientCounts SurfaceRun::countGradients(const std::vector<float>& slopes)
{
    constexpr int kinkVox = 2;                 // within this of a kink |grad S| need not be 1
    constexpr double gradientTolerance = 0.03; // of |grad S| that counts as 1
    const LeafTable nearKinks = dilated(S_.kinks, kinkVox, Spread::Ball, progress_);

    constexpr std::size_t chunk = 512;
    const std::size_t vertices = slopes.size();
    const auto count = [&](std::size_t c) {
        GradientCounts sum;
        for (std::size_t v = c * chunk; v < std::min(vertices, (c + 1) * chunk); ++v) {
            const openvdb::Vec3d x(result_.mesh.positions[v]);
            const openvdb::Coord near = openvdb::Coord::round(x / options_.voxel);
            const std::int32_t n = nearKinks.find(near);
            const bool kink =
                n != noLeaf &&
                nearKinks.active(n).on(int(openvdb::FloatTree::LeafNodeType::coordToOffset(near)));
            sum += {std::size_t(kink),
                    std::size_t(!kink && std::abs(slopes[v] - 1.0f) < gradientTolerance)};
        }
        return sum;
    };
    return parallelSum<GradientCounts>((vertices + chunk - 1) / chunk, progress_, count);
}

void SurfaceRun::describeSlopes(const std::vector<float>& slopes)
{
    SurfaceReport& surface = result_.report.surface;
    surface.gradientShare = surface.kinkShare = std::nan("");
    if (options_.needs.statistics)
        describeGradients(countGradients(slopes), slopes.size(), surface);
}

MeshPieces SurfaceRun::dropSpecks()
{
    MeshPieces pieces = piecesOf(result_.mesh, progress_);
    if (const auto kept = molsurf::dropSpecks(pieces, *result_.surface, result_.mesh)) {
        keepVertices(*kept, stats_.slopes);
        keepVertices(*kept, stats_.cells);
        keepVertices(*kept, stats_.residuals);
    }
    checkLeft();
    return pieces;
}

void SurfaceRun::measure()
{
    progress_.update("mesh", 0.7);
    SurfaceReport& surface = result_.report.surface;
    const MeshPieces pieces = stored_ ? piecesOf(result_.mesh, progress_) : dropSpecks();
    surface = molsurf::measure(result_.mesh, pieces, progress_);
    if (!surface.manifold && !splitNonManifold(result_.mesh).empty())
        surface = molsurf::measure(result_.mesh, progress_);
    surface.kind = nameOf(options_.kind);
    surface.cuspLength = cuspLength_;
    surface.maxResidual = stats_.maxResidual;
    describeSlopes(stats_.slopes);
    try {
        checkMesh(result_.mesh, surface, options_.voxel, progress_);
    } catch (const Error& e) {
        failIfTooCoarse(e.what(), model_.balls, options_);
        throw;
    }
}

void SurfaceRun::describeCurvature()
{
    if (!options_.needs.statistics) return;
    const Mesh& mesh = result_.mesh;
    SurfaceReport& surface = result_.report.surface;
    const std::vector<float> areas = vertexAreas(mesh, progress_);
    tbb::parallel_invoke(
        [&] { surface.meanCurvature = statistics(mesh.scalars[0].values, areas); },
        [&] { surface.gaussianCurvature = statistics(mesh.scalars[1].values, areas); });
}

void SurfaceRun::integrateCurvature()
{
    if (!options_.curvatureTotals) return;
    SurfaceReport& surface = result_.report.surface;
    constexpr double tolerance = 5.0; // for each unit of the Euler characteristic [sr]
    const int chi = std::max(std::abs(surface.eulerCharacteristic.value_or(0)), 2);
    Mesh& mesh = result_.mesh;
    const IntegratedSurface integrated =
        integrateSurface(mesh, spline_, tolerance * chi, progress_);
    surface.integrals = integrated.sums;
    const double turns = integrated.sums.gaussianCurvature / (2.0 * M_PI);
    if (std::abs(turns - surface.meshEulerCharacteristic) > 0.5)
        result_.report.warnings.push_back(formatted(
            "total_gaussian_curvature: expected 2 pi times the Euler number of the mesh, "
            "%d, got %.4g times: the totals of curvature are not right at creases or gaps "
            "below a voxel",
            surface.meshEulerCharacteristic, turns));

    const std::vector<float> areas = vertexAreas(mesh, progress_);
    const auto average = [&](const std::vector<double>& integrals) {
        std::vector<float> values(areas.size());
        for (std::size_t v = 0; v < areas.size(); ++v)
            values[v] = areas[v] > 0.0f ? float(integrals[v] / areas[v]) : 0.0f;
        return values;
    };
    mesh.scalars.push_back({"mean_curvature_average", average(integrated.meanCurvature)});
    mesh.scalars.push_back({"gaussian_curvature_average", average(integrated.gaussianCurvature)});
}

void describePieces(const ClosedForm& exact, bool fillCavities, SurfaceReport& s)
{
    s.area = s.volume = s.outerArea = s.outerVolume = 0.0;
    s.components = 0;
    int euler = 0;
    s.cavities.clear();
    for (const BoundaryPiece& piece : exact.pieces) {
        if (!piece.outer && fillCavities) continue;
        addPiece(piece.area, piece.volume, !piece.outer, s);
        euler += piece.eulerCharacteristic;
    }
    s.eulerCharacteristic.reset();
    if (exact.topologyKnown) s.eulerCharacteristic = euler;
    sortCavities(s);
}

void SurfaceRun::useClosedForm()
{
    if (!exact_) return;
    // A mesh bridges what is narrower than a voxel: creases and small cavities.
    SurfaceReport& s = result_.report.surface;
    s.meshArea = s.area;
    s.meshVolume = s.volume;
    describePieces(*exact_, options_.fillCavities, s);
    checkMesh(s.area, s.volume, *s.meshArea, *s.meshVolume, exact_->tolerance);
    warnOfMesh(s, options_.voxel, result_.report.warnings);
}

void SurfaceRun::remesh()
{
    if (options_.meshEdge == 0.0) return;
    progress_.update("mesh", 0.8);
    Mesh& mesh = result_.mesh;
    remeshSurface(options_, spline_, progress_, mesh, result_.report);
}

bool SurfaceRun::needsMesh() const
{
    const bool shown = options_.needs.mesh || options_.fillCavities || options_.splineLevel > 0 ||
                       options_.meshEdge > 0.0 || options_.curvatureTotals;
    return shown || dependsOnPose(options_) || maybeTooCoarse(model_.balls, options_) ||
           !isClearOfSpecks(S_.phi, progress_);
}

/// Makes the level set alone, and the spline if a grid is made of it or a passage asks it.
void SurfaceRun::levelSetAlone()
{
    const std::vector<std::string>& names = options_.fields;
    const bool ofSpline = std::any_of(names.begin(), names.end(), [](const std::string& name) {
        return name == "spline" || findCurvatureField(name);
    });
    if (ofSpline || passages_) spline();
    levelSet();
    SurfaceReport& surface = result_.report.surface;
    surface.kind = nameOf(options_.kind);
    surface.cuspLength = cuspLength_;
    surface.piecesKnown = exact_.has_value();
    surface.area = surface.volume = surface.gradientShare = surface.kinkShare = std::nan("");
    if (exact_) describePieces(*exact_, options_.fillCavities, surface);
}

void SurfaceRun::toMeasures()
{
    toDistance();
    if (!needsMesh()) return levelSetAlone();
    makeMesh();
    measure();
    describeCurvature();
    useClosedForm();
}

void SurfaceRun::finishMesh()
{
    if (result_.mesh.triangles.empty()) return;
    remesh();
    curvatures();
    integrateCurvature();
}

openvdb::FloatGrid::Ptr SurfaceRun::sasGrid()
{
    const double width = surfaceWidthVox * options_.voxel;
    SparseField exact; // by closest points; none: fronts moved, and their level set is the grid
    const bool evolved = hasFlow(options_.kind);
    if (!evolved) {
        exact = distanceToUnion(unionOf(model_.balls, options_.probe, progress_), options_.voxel,
                                {width, width}, progress_, scope_.region.owned, Kinks::None)
                    .phi;
    }
    if (carrier_.table.size() > 0)
        exact =
            redistance(copied(carrier_), {width, width}, 0.0, progress_, scope_.region.owned).phi;
    auto grid = toLevelSet(exact.table.size() > 0 ? exact : band_.phi, width, progress_);
    grid->setName("sas");
    return grid;
}

openvdb::GridPtrVec SurfaceRun::fields()
{
    openvdb::GridPtrVec out;
    const auto add = [&](const char* name, const auto& make) {
        if (hasField(options_.fields, name)) out.push_back(make());
    };
    add("sas", [&] { return sasGrid(); });
    add("spline", [&] { return splineGrid(spline_); });
    const openvdb::GridPtrVec curvatures =
        curvatureGrids(*result_.surface, spline_, options_.fields, progress_);
    for (const CurvatureField& field : curvatureFields())
        for (const auto& grid : curvatures)
            if (grid->getName() == field.name) out.push_back(grid);
    add("density", [&] { return densityGrid(*result_.surface); });
    return out;
}

void SurfaceRun::freeFields()
{
    band_ = NarrowBand();
    carrier_ = SparseField();
    S_.phi = SparseField();
    spline_ = Spline();
    if (!scope_.keepsMemory) releasePages();
    watch_.stop("mesh");
}

LevelSetSurface SurfaceRun::finish()
{
    if (exact_) result_.ballAreas = std::move(exact_->ballAreas);
    result_.report.activeVoxels = result_.surface->activeVoxelCount();
    result_.report.gridBytes = result_.surface->memUsage();
    return std::move(result_);
}

} // namespace molsurf
