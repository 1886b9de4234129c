// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Every option of a run with its default, in one place.

#include "molsurf/color/color_by.h"
#include "molsurf/flow/options.h"
#include "molsurf/selection/select_balls.h"

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

/// What surface is wanted, and how fine.
struct Options {
    SelectOptions atoms;
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
    bool meshLabels = true;          ///< tell atom, chain and group of the mesh's vertices
    bool curvatureIntegrals = false; ///< integrate curvature over the surface, for the report
};

/// The smallest and largest voxel edge that is taken, and the one above which a surface of atoms is
/// no longer one [Å].
constexpr double minVoxel = 0.05, maxVoxel = 10.0, coarseVoxel = 1.0;

/// The probe radius that the surface is made with [Å]; 0 for the van der Waals and the Gaussian
/// surface.
double probeOf(const Options& options);

/// The command line's word for a surface: variational, ses, sas, vdw, gaussian.
const char* nameOf(SurfaceKind kind);

/// @throws Error(ErrorKind::Usage) for an option out of its range; names the option as the command
///         line does
void checkOptions(const Options& options);

} // namespace molsurf
