// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Every option of a run with its default, in one place.

#include "molsurf/error.h"

#include <string>
#include <utility>
#include <vector>

namespace molsurf
{

/// The surfaces that can be built.
enum class SurfaceKind {
    Variational,       ///< the minimiser of the energy, offset inward by the probe radius
    SolventExcluded,   ///< the union of balls of radius r_i + r_b, offset inward by r_b
    SolventAccessible, ///< the union of balls of radius r_i + r_b
    VanDerWaals,       ///< the union of balls of radius r_i
    Gaussian           ///< sum_i exp(-(d/r_i^2) (|x - x_i|^2 - r_i^2)) = 1
};

/// What the colours of the surface tell.
enum class ColorBy { Nothing, Chain, Group, Element, Residue, MeanCurvature, GaussianCurvature };

/// The term that lambda weighs in the energy density  w = g^2 + lambda h  (the paper's
/// equations 2.6 and 2.7): h = |grad g|^2 or h = 1.
enum class Regularizer { Gradient, Area };

/// How the speed is scaled: by the paper's own time step, or by an approximate second derivative of
/// the energy (docs/math.md, section 4).
enum class Flow { Preconditioned, Plain };

/// SurfaceOptions of evolve().
struct EvolveOptions {
    double lambda = 0.01; ///< weight of the regulariser; [Å^2] for Gradient, no unit for Area; >= 0
    Regularizer regularizer = Regularizer::Gradient;
    Flow flow = Flow::Preconditioned;
    int maxSteps = -1; ///< < 0: 50 for the preconditioned flow, fewer where it stalls; 2000 for the
                       ///< plain one
    int steps = -1;    ///< >= 0: so many, whether it has converged or not
    int splineLevel =
        0; ///< curvature by the spline on voxels of edge 2^level h; 0: on h, by differences
    double energyTolerance = 1e-4;       ///< relative change of the energy in a step
    double displacementTolerance = 0.01; ///< area-weighted mean displacement in a step [voxel]
};

/// What surface is wanted, and how fine.
struct SurfaceOptions {
    SurfaceKind kind = SurfaceKind::Variational;
    double blobbiness = 2.3;          ///< d of the Gaussian surface, in [0.1, 100]
    double probe = 1.4;               ///< probe radius r_b [Å], >= 0
    double voxel = 0.5;               ///< edge h of a voxel [Å], in [0.05, 10]
    double epsilon = 0.5;             ///< tolerance eps of the Gaussian sum [Å], > 0
    ColorBy color = ColorBy::Nothing; ///< colours of the mesh's vertices and of the grid Cd
    bool split = false;               ///< a surface for every group of atoms
    /// Groups that have a surface of their own, and its kind.
    std::vector<std::pair<std::string, SurfaceKind>> surfaceOf;
    bool interfaces = false;   ///< buried areas between groups, for the report
    bool matchVolume = false;  ///< resolution rules keep the enclosed volume, see matchVolumes()
    EvolveOptions evolution;   ///< lambda, regulariser, flow, stopping rule
    int splineLevel = 0;       ///< the spline lives on voxels of edge 2^level h; 0, 1 or 2
    bool fillCavities = false; ///< drop the inner walls
    double minWall = 0.0;      ///< thicken what is thinner [Å], see thickenWalls(); 0: nothing
    /// Further grids to keep, of fieldNames(); curvatures are then vertex attributes, too.
    std::vector<std::string> fields;
    bool meshLabels = true;       ///< tell atom, chain and group of the mesh's vertices
    bool curvatureTotals = false; ///< integrate curvature over the surface, for the report
};

/// The smallest and largest voxel edge that is taken, and the one above which a surface of atoms is
/// no longer one [Å].
constexpr double minVoxel = 0.05, maxVoxel = 10.0, coarseVoxel = 1.0;

/// The probe radius that the surface is made with [Å]; 0 for the van der Waals and the Gaussian
/// surface.
double probeOf(const SurfaceOptions& options);

/// A user's word: variational, ses, sas, vdw, gaussian.
const char* nameOf(SurfaceKind kind);

/// A user's word: none, chain, group, element, residue, mean-curvature, gaussian-curvature.
const char* nameOf(ColorBy color);

/// A user's word: gradient, area.
const char* nameOf(Regularizer regularizer);

/// A user's word: preconditioned, plain.
const char* nameOf(Flow flow);

/// @throws Error(ErrorKind::Usage) for an option out of its range; names the member
void checkOptions(const SurfaceOptions& options);

} // namespace molsurf
