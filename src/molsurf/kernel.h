// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The kernel: from balls and a SurfaceSpec to a level set, its mesh and their measures. It knows
/// no files, residues or colours; its libraries are OpenVDB and TBB.

#include "molsurf/ball.h"
#include "molsurf/error.h"
#include "molsurf/mesh.h"
#include "molsurf/progress.h"
#include "molsurf/report.h"

#include <openvdb/openvdb.h>

#include <optional>
#include <string>
#include <vector>

namespace molsurf
{

/// The kinds of surfaces. r_i is the radius of ball i, r_b that of the probe.
enum class SurfaceKind {
    Variational,       ///< the minimiser of the energy, offset inward by r_b
    SolventExcluded,   ///< the union of balls of radius r_i + r_b, offset inward by r_b
    SolventAccessible, ///< the union of balls of radius r_i + r_b
    VanDerWaals,       ///< the union of balls of radius r_i
    Gaussian,          ///< sum_i exp(-(d/r_i^2) (|x - x_i|^2 - r_i^2)) = 1
    SmoothAccessible   ///< the minimiser of the energy itself
};

/// The term h that lambda weighs in the energy density w = g^2 + lambda h; section 2 of the paper
/// has both. docs/math.md, section 4.
enum class Regularizer {
    Gradient, ///< h = |grad g|^2
    Area      ///< h = 1
};

/// The ways to bring the interface to rest. docs/math.md, section 4.
enum class Flow {
    Rest,   ///< in closed form where no front moves and no number of steps is given, else Newton
    Newton, ///< solves for the displacement of the whole interface that brings it to rest
    Paper   ///< the scheme of the paper, for comparison: one time step for all voxels
};

/// Options of the flow that minimises the energy of the variational surface.
struct EvolveOptions {
    double lambda = 0.01; ///< weight of the regulariser, in [0, 1e6]; [Å^2] for
                          ///< Regularizer::Gradient, no unit for Regularizer::Area
    Regularizer regularizer = Regularizer::Gradient;
    Flow flow = Flow::Rest;
    std::optional<int> maxSteps; ///< largest number of steps, >= 0; none: 50 for the Newton flow,
                                 ///< which ends earlier where it stalls, and 200 for the paper's
    std::optional<int> steps;    ///< number of steps, >= 0, whether the flow converges or not;
                                 ///< none: until it converges or `maxSteps` is reached
    /// L > 0: the flow takes curvatures from a spline on voxels of edge 2^L h. 0: it takes them
    /// from differences on voxels of edge h.
    int splineLevel = 0;
    /// The flow has converged when the way of the interface in a step has a root mean square below
    /// this, and is below eight times this (or below 0.04) at 99.9 % of the interface [voxel], > 0.
    /// In a first step it counts for a quarter, and for a third where fronts move, with
    /// sqrt(lambda/2) above 0.11 Å. It is never meant for less than 0.001 voxel, (h/0.5 Å)^2 times
    /// that above 0.5 Å. In closed form it is a length, 2 Å times the tolerance:
    /// checkConvergence().
    double tolerance = 0.01;
};

/// The shape of a surface, and how fine it is.
struct SurfaceSpec {
    SurfaceKind kind = SurfaceKind::Variational;
    double blobbiness = 2.3;   ///< d of the Gaussian surface, no unit, in [0.1, 100]
    double probe = 1.4;        ///< probe radius r_b [Å], in [0, 100]
    double voxel = 0.5;        ///< edge h of a voxel [Å], in [0.05, 10]
    double epsilon = 0.5;      ///< tolerance eps of the Gaussian sum [Å], in [0.01, 10]
    EvolveOptions evolution;   ///< options of the flow, for the variational surface
    int splineLevel = 0;       ///< L in 0, 1, 2: the spline lies on voxels of edge 2^L h
    bool fillCavities = false; ///< whether the inner walls of closed cavities are removed
    double minThickness = 0.0; ///< thinner parts are thickened to this [Å], up to 100; 0: none
    double inset = 0.0; ///< how far inside of the place of its kind it lies [Å], >= 0; of kinds
                        ///< that lie inside of a probe's
    /// Whether balls with a resolution enclose the volume that they have without.
    bool matchVolume = false;
};

/// Results that a run leaves out where nobody reads them, and the time that they take.
struct Needs {
    /// The mesh, and what is measured on it. Without it, and where no closed form has them, area
    /// and volume are not numbers, and pieces are not known. A surface that only a mesh can check
    /// has one in any case: on voxels above 0.7 of the largest radius, or with a piece as small as
    /// one.
    bool mesh = true;
    bool levelSet = true;   ///< distances on the voxels of LevelSetSurface::surface; else they have
                            ///< its signs, and makeSurface() gives none
    bool statistics = true; ///< SurfaceReport::gradientShare and kinkShare, else not a number, and
                            ///< the statistics of curvatures
    bool passages = true;   ///< EvolutionReport::Gaps::closedByField
};

/// Products that are made of the level set and of its mesh.
struct KernelProducts {
    /// Names of further grids to make, of the list in docs/options.md: "density", "Cd", or a
    /// curvature as "mean_curvature", which the mesh then has as well. The kernel makes those of
    /// curvatures, "sas", "spline" and "density".
    std::vector<std::string> fields;
    double meshEdge = 0.0;  ///< length of the mesh's edges [Å], in [0.05, 10]; 0: by the voxels
    double meshError = 0.0; ///< how far its triangles may lie from the surface [Å], in [0.001, 1],
                            ///< by shorter edges; 0: it does not matter
    bool energy = true;     ///< whether the report has the energy at rest, 5 to 9 % of the time
    bool closedForm = true; ///< whether the measures of SolventExcluded are those in closed form,
                            ///< a quarter of the time at 1 Å; else they are those of the mesh
    bool curvatureTotals = false; ///< whether the report has the integrals of curvature
    bool ballAreas = false;       ///< whether LevelSetSurface::ballAreas is made; the kernel knows
                                  ///< those of surfaces in closed form
    Needs needs{};                ///< of those who read the result
};

/// A surface as a level set and as a mesh.
struct LevelSetSurface {
    /// Signed distance from the surface [Å], negative inside, on voxels of edge SurfaceSpec::voxel
    /// near it.
    openvdb::FloatGrid::Ptr surface;
    std::vector<openvdb::GridBase::Ptr> fields; ///< the grids that KernelProducts::fields names
    Mesh mesh;                                  ///< closed, with its vertices on the surface
    /// If it was asked for, the part of the surface that belongs to each ball, in the
    /// order of the caller's; they add up to the area of the whole [Å^2]. Solvent-accessible and
    /// van der Waals surfaces have them as exposedAreas() gives them. Of the solvent-excluded
    /// surface they are in closed form, too: where a probe rests on several balls, a point belongs
    /// to that of them for which |x - x_i|^2 - r_i^2 is least. A point of another surface belongs
    /// to the ball whose own surface is nearest.
    std::vector<double> ballAreas;
    Report report; ///< measures of the surface; its caller fills in command, input and the like

    /// Returns the level set, if there is one, and the fields.
    openvdb::GridPtrVec grids() const
    {
        openvdb::GridPtrVec all = fields;
        if (surface) all.insert(all.begin(), surface);
        return all;
    }
};

/// Makes the surface of balls: the stages of SurfaceRun in their order. Balls without groups,
/// colours and copies; makeSurface() has these.
///
/// One build of the library gives the same bits for every number of threads and order of the balls.
///
/// @param[in] model     at least one ball; positions and radii are finite
/// @param[in] progress  follows the run and may end it; null: nobody does
/// @throws Error(ErrorKind::Input) if a ball cannot be used; the message has its index
/// @throws Error(ErrorKind::Numeric) if there is no surface at this resolution
/// @throws Error(ErrorKind::Check) if the result contradicts itself
/// @throws Cancelled if the progress object says so
LevelSetSurface makeLevelSet(const BallModel& model, const SurfaceSpec& spec,
                             const KernelProducts& products = {}, Progress* progress = nullptr);

/// Returns the probe radius that the surface is made with [Å]. It is 0 for the van der Waals and
/// the Gaussian surface, whatever SurfaceSpec::probe is.
double probeOf(const SurfaceSpec& spec);

/// Returns the word of the command line for a kind: variational, ses, smooth-sas.
const char* nameOf(SurfaceKind kind);

/// Returns the word of the command line for a regulariser: gradient, area.
const char* nameOf(Regularizer regularizer);

/// Returns the word of the command line for a flow: newton, paper.
const char* nameOf(Flow flow);

} // namespace molsurf
