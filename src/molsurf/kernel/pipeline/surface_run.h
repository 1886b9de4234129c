// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The stages from balls to a surface, in one place for runs of a whole molecule, of a brick of it,
/// and for stored surfaces.

#include "molsurf/kernel.h"
#include "molsurf/kernel/balls/boundary_measure.h"
#include "molsurf/kernel/flow/evolve.h"
#include "molsurf/kernel/grid/region.h"
#include "molsurf/kernel/levelset/seed_kinks.h"
#include "molsurf/kernel/mesh/extract.h"
#include "molsurf/kernel/mesh/measure.h"
#include "molsurf/kernel/pipeline/closed_form.h"
#include "molsurf/kernel/pipeline/influence.h"
#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/kernel/topology/closed_passages.h"
#include "molsurf/kernel/topology/decision.h"

#include <chrono>
#include <memory>
#include <optional>
#include <vector>

namespace molsurf
{

/// The part of a molecule that a run computes: everything, or a brick. The halos, in leaves about
/// the brick, shrink from stage to stage: each stage needs the one before it farther out.
struct Scope {
    Region region;
    std::optional<GaussianExtent> extent; ///< of all balls of the molecule
    int flowHalo = 0;                     ///< of the evolved level set
    int distanceHalo = 0;                 ///< of the part of it that distances are taken to
    int ridgeHalo = 0;                    ///< of S before its ridges are rounded
    int splineHalo = 0;                   ///< of S and its spline; a leaf less of the mesh
    /// Of a brick: the rest of the whole on voxels twice as large, if its flow starts from there.
    std::shared_ptr<const SparseField> coarseRest{};
    bool keepsMemory = false; ///< pages that are not used stay in the process, for the next brick
    bool isUnit = false; ///< whether motions repeat it, so that its closed form is not the whole's
};

/// The level set at rest on voxels twice as large as those of the options: where the flow starts
/// from, see startsOnCoarserVoxels().
/// @param[in,out] report  the times of its stages are added
SparseField restOnCoarserVoxels(const BallModel& model, const SurfaceSpec& spec, Progress& progress,
                                Report& report);

/// Puts measures in closed form in a report.
/// @param[in] fillCavities  whether cavities do not count
void describePieces(const ClosedForm& exact, bool fillCavities, SurfaceReport& s);

/// Measures the wall time of stages; a stage may come more than once.
class Stopwatch
{
public:
    explicit Stopwatch(Report& report) : report_(&report) {}

    /// Adds the time since the stop before to that of a stage.
    void stop(const char* stage);

private:
    using Clock = std::chrono::steady_clock;
    Report* report_;
    Clock::time_point start_ = Clock::now();
};

/// One run. Each method is a stage and needs those above it, if they are not said to be optional.
/// The results of a stage are kept for later ones until freeFields().
class SurfaceRun
{
public:
    /// @param[in] model  at least one ball, or none and no density(), flow() and distance()
    SurfaceRun(const BallModel& model, const KernelOptions& options, const Scope& scope,
               Progress& progress);
    SurfaceRun(const SurfaceRun&) = delete;
    SurfaceRun& operator=(const SurfaceRun&) = delete;

    /// Sums the Gaussians and takes the level set of psi = 0; does nothing for the surface of a
    /// union of balls.
    /// @throws Error(ErrorKind::Numeric) if a whole molecule has no voxel inside
    void density();

    /// Brings the interface to rest, if the surface is variational.
    void flow();

    /// Computes S, the signed distance to the surface, in a band that holds the coefficients of
    /// every point of it.
    void distance();

    /// Fits the spline to S; where it is coarser, replaces S near its zero set by its values, so
    /// that signs and values agree.
    void spline();

    /// Makes the grid `surface` of S, a distance on both sides.
    void levelSet();

    /// Meshes the zero set of the spline.
    /// @throws Error(ErrorKind::Numeric) if a whole molecule has none
    void mesh();

    /// Closes the cavities in S, if the options say so. Optional.
    /// @return whether there were any: then spline(), levelSet() and mesh() have to follow again
    bool fillCavities();

    /// All stages above, those that follow fillCavities() too.
    void toMesh();

    /// Takes a mesh and its spline from elsewhere, instead of the stages above.
    /// @param[in] surface  the level set that was meshed
    void resume(Mesh mesh, Spline spline, openvdb::FloatGrid::Ptr surface);

    /// Adds the curvatures that the options ask for to the mesh. Optional.
    void curvatures();

    /// Takes the pieces out of mesh and level set that the voxels cannot hold. Part of measure().
    /// @return the pieces that are left
    /// @throws Error(ErrorKind::Numeric) if a whole molecule has none
    MeshPieces dropSpecks();

    /// Measures the mesh, and how well it fits S; splits vertices at which it is not a manifold.
    /// @throws Error(ErrorKind::Check) if the mesh does not keep what checkMesh() says
    void measure();

    /// Adds statistics of the curvatures to the measures. Optional.
    void describeCurvature();

    /// Adds their integrals, if they are asked for; the mesh is closed. Optional.
    void integrateCurvature();

    /// Replaces measures of the mesh by those in closed form, if there are any. Optional.
    /// @throws Error(ErrorKind::Check) if they are too far from those of the mesh
    void useClosedForm();

    /// All stages to the measures of a whole molecule; to the level set, if nothing needs a mesh.
    void toMeasures();

    /// Makes the triangles anew, if the options ask for their size. Measures of the surface stay.
    /// Optional.
    void remesh();

    /// The stages of the mesh behind toMeasures(): remesh(), curvatures(), integrateCurvature().
    void finishMesh();

    /// Makes the grids that the options ask for and that the stages leave: `sas`, `spline`, those
    /// of curvatures and `density`, in this order.
    openvdb::GridPtrVec fields();

    /// Makes the grid `sas`: the evolved level set, or that of the solvent-accessible surface.
    openvdb::FloatGrid::Ptr sasGrid();

    /// Frees the fields of the stages up to here.
    void freeFields();

    /// Completes the report.
    /// @return the surface, with the areas of balls that are known in closed form
    LevelSetSurface finish();

    /// Whether the areas of balls are known in closed form.
    bool knowsAreas() const { return exact_ && !exact_->ballAreas.empty(); }

    /// How far from the balls a point of the surface may lie [Å].
    double labelReach() const { return influence_.ofLabel(); }

    /// The surface so far.
    LevelSetSurface& result() { return result_; }
    ExtractStats& stats() { return stats_; }
    const Spline& currentSpline() const { return spline_; }

    /// The displacements of the last step of the flow, or the ways to rest.
    const Displacements& displacements() const { return displacements_; }

    /// Counts vertices by the gradient there.
    /// @param[in] slopes  |grad S| at the first vertices of the mesh, those that are counted
    GradientCounts countGradients(const std::vector<float>& slopes);

    /// Puts their shares into the report, if they are asked for.
    void describeSlopes(const std::vector<float>& slopes);

private:
    friend SparseField restOnCoarserVoxels(const BallModel&, const SurfaceSpec&, Progress&,
                                           Report&);
    void toDistance();
    void makeMesh();
    bool needsMesh() const;
    void levelSetAlone();
    void refineCoarseRest();
    void rest();
    void checkLeft() const;
    bool keepsLevelSet() const;
    void countClosedPassages();
    SparseField takeCarrier();
    DistanceBand distanceToBalls();
    DistanceBand distanceToInterface();
    std::vector<Decision> decideWallsOf(const NearestSeeds& near, const SeedKinks& kinks);

    const BallModel& model_;
    const KernelOptions options_;
    const Scope scope_;
    Progress& progress_;
    const Influence influence_;
    LevelSetSurface result_;
    Stopwatch watch_;
    std::optional<GaussianSum> sum_;
    std::optional<GapReport> gaps_;                      ///< how they were decided
    std::optional<std::vector<ClosedPassage>> passages_; ///< that were not counted yet
    Bumps bumps_;                                        ///< that the sum adds to psi
    NarrowBand band_;     ///< the level set that a smooth surface is offset from
    SparseField carrier_; ///< psi, then the interface, where it rests in closed form
    Displacements displacements_;
    DistanceBand S_;
    Spline spline_;
    ExtractStats stats_;
    bool stored_ = false;              ///< mesh and level set come from elsewhere
    std::optional<ClosedForm> exact_;  ///< of surfaces in closed form
    std::optional<double> cuspLength_; ///< SurfaceReport::cuspLength
};

} // namespace molsurf
