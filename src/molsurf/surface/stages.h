// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The stages that a run of a whole molecule and that of a brick of it have in common.

#include "molsurf/atoms.h"
#include "molsurf/flow/evolve.h"
#include "molsurf/grid/distance_band.h"
#include "molsurf/grid/region.h"
#include "molsurf/levelset/gaussian_sum.h"
#include "molsurf/levelset/union_distance.h"
#include "molsurf/mesh.h"
#include "molsurf/options.h"
#include "molsurf/progress.h"
#include "molsurf/report.h"
#include "molsurf/spline/spline.h"

#include <chrono>
#include <cstddef>
#include <optional>
#include <vector>

namespace molsurf
{

/// Half width of the grid `surface` [voxel].
constexpr double surfaceWidthVox = 3.0;

/// How far from S = 0 the spline needs samples [voxel]: the corners of the 4^3 coefficients about a
/// point are up to 2 sqrt(3) away.
constexpr double splineWidthVox = 4.0;

/// Leaves of the halo for the initial level set and for the way that information takes along the
/// interface during the flow.
constexpr int flowLeaves = 2;

class WarmStart;

/// What a run computes of a molecule: everything, or a brick. The halos, in leaves about the brick,
/// shrink from stage to stage: each stage needs the one before it farther out.
struct Scope {
    Region region;
    std::optional<GaussianExtent> extent; ///< of all balls of the molecule
    int flowHalo = 0;                     ///< of the evolved level set
    int distanceHalo = 0;                 ///< of the part of it that distances are taken to
    int splineHalo = 0;                   ///< of S and its spline; a leaf less of the mesh
};

/// Wall seconds of the stages, in their order; a stage may come more than once.
class Stopwatch
{
public:
    explicit Stopwatch(Report& report) : report_(report) {}
    void stop(const char* stage);

private:
    using Clock = std::chrono::steady_clock;
    Report& report_;
    Clock::time_point start_ = Clock::now();
};

/// How the Gaussians of a run are summed.
GaussianOptions gaussianOptions(const SurfaceOptions& options);

/// How far the Gaussians of a run's balls reach.
GaussianExtent extentOf(const BallSet& atoms, const SurfaceOptions& options);

/// The level set that a smooth surface is offset from; empty for surfaces of a union of balls, and
/// in a region that has none of it.
NarrowBand makeBand(const BallSet& atoms, const SurfaceOptions& options, const Scope& scope,
                    Progress& progress, Report& report, Stopwatch& watch,
                    WarmStart* warm = nullptr);

/// Whether a surface is that of a union of balls.
bool isUnion(SurfaceKind kind);

/// How far the surface lies inside the set whose distance is known [Å].
double offsetOf(const SurfaceOptions& options);

/// The probe that the balls of a union surface are grown by [Å].
double grownBy(const SurfaceOptions& options);

/// How far from the surface of its set the distance is computed.
BandWidths widthsOf(const SurfaceOptions& options);

/// S = Phi + r_b on a band that holds the coefficients of every point of the surface.
/// @param[in] phi  the level set that a smooth surface is offset from
DistanceBand distanceBand(SparseField phi, const SurfaceOptions& options, const Scope& scope,
                          Progress& progress);

/// The same of a surface that is offset from a union of balls.
/// @param[in] set  of balls that are grown by grownBy()
DistanceBand distanceBand(BallUnion set, const SurfaceOptions& options, const Scope& scope,
                          Progress& progress);

/// Replaces S near its zero set by the values of a coarser spline, so that signs and values agree
/// with it.
void resample(SparseField& S, const Spline& spline, Progress& progress);

/// The level set grid: S made a distance on both sides.
openvdb::FloatGrid::Ptr surfaceGrid(SparseField S, const Scope& scope, Progress& progress);

/// Vertices near kinks of the distance, and those of the others with a unit gradient.
struct GradientCounts {
    std::size_t kink = 0, unit = 0;
    GradientCounts& operator+=(const GradientCounts& o)
    {
        kink += o.kink;
        unit += o.unit;
        return *this;
    }
};

/// @param[in] slopes     |grad S| at the first vertices of the mesh, those that are counted
/// @param[in] kinks      of the distance
/// @param[in] voxelSize  edge of their voxels [Å]
GradientCounts countGradients(const Mesh& mesh, const std::vector<float>& slopes,
                              const LeafTable& kinks, double voxelSize, Progress& progress);

/// How far a point of the surface, or of its grid's band, may lie from its ball [Å].
double labelReach(const BallSet& atoms, const SurfaceOptions& options);

} // namespace molsurf
