// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The options of a surface with their defaults.

#include "molsurf/error.h"

#include <optional>
#include <string>
#include <utility>
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

/// Properties that the colours of a surface may show.
enum class ColorBy {
    Nothing,
    Chain,
    Group,
    Element,
    Residue,    ///< ResidueClass, nucleotides as one
    Nucleotide, ///< the base; what is no nucleotide is grey
    Plain,      ///< one that all balls have
    MeanCurvature,
    GaussianCurvature,
    Value,        ///< values of the balls
    Illustrative, ///< the chain, lighter at carbon
    Hetero,       ///< the chain at carbon, else the element
    Pocket        ///< the pocket whose wall a point is
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
    /// that above 0.5 Å. In closed form it is a length, 2 Å times the tolerance: judgeRest().
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
    double minWall = 0.0;      ///< thinner parts are thickened to this [Å], >= 0; 0: none is
    double inset = 0.0; ///< how far inside of the place of its kind it lies [Å], >= 0; of kinds
                        ///< that lie inside of a probe's
    /// Whether balls with a resolution enclose the volume that they have without.
    bool matchVolume = false;
};

/// Products of a surface: its grids, its mesh, and the measures of its report.
struct Wanted {
    /// Definition of a pocket: the space that a small probe reaches and a large one, from outside,
    /// does not. Lengths in Å.
    struct PocketRule {
        double probeIn = 1.4;  ///< radius of the small probe, in [0.5, 10]
        double probeOut = 4.0; ///< of the large one, above `probeIn`, at most 50
        double cut = 2.4;      ///< how far below the surface of the large probe pockets begin, >= 0
        /// Parts are two where the largest ball that passes between them has less than this share
        /// of the radius of the smaller of the largest balls in them, in [0, 1].
        // measured: the haems of 4hhb, each a pocket from 0.4 to 0.68, with Bondi's radii and
        // pyKVFinder's; the site of chain A of 4at1 whole up to 0.6, lysozyme's up to 0.55 in 5
        // poses
        double neck = 0.55;
    };

    ColorBy color =
        ColorBy::Nothing; ///< property that colours the mesh's vertices and the grid `Cd`
    bool split = false;   ///< whether every group of atoms gets a surface of its own
    /// Names of groups that get a surface of their own, and the kind of each.
    std::vector<std::pair<std::string, SurfaceKind>> surfaceOf;
    bool interfaces = false; ///< whether the report has the areas that groups bury between them
    /// Names of further grids to make, of the list in docs/options.md: "density", "Cd", or a
    /// curvature as "mean_curvature", which the mesh then has as well.
    std::vector<std::string> fields;
    double meshEdge = 0.0;  ///< length of the mesh's edges [Å], in [0.05, 10]; 0: by the voxels
    double meshError = 0.0; ///< how far its triangles may lie from the surface [Å], in [0.001, 1],
                            ///< by shorter edges; 0: it does not matter
    bool halfFloats = false; ///< whether the grids' values are saved as 16-bit floats
    bool meshLabels = true;  ///< whether the mesh has the atom, chain and group of its vertices
    bool energy = true;      ///< whether the report has the energy at rest, 5 to 9 % of the time
    bool closedForm = true;  ///< whether the measures of SolventExcluded are those in closed form,
                             ///< a quarter of the time at 1 Å; else they are those of the mesh
    bool curvatureTotals = false; ///< whether the report has the integrals of curvature
    bool ballAreas = false;       ///< whether MolecularSurface::ballAreas is made
    bool contacts = false;        ///< whether MolecularSurface::contacts is made
    bool pockets = false;         ///< whether the report has pockets
    PocketRule pocket;            ///< which
    double tunnelProbe = 0.9;     ///< tunnels are as wide as this at least, in [0.3, 10] [Å]; they
                                  ///< end where a ball of PocketRule::probeOut gets
    /// The kind of surface that ballAreas, contacts and interfaces are of; none: that of `kind`.
    std::optional<SurfaceKind> areasOf;
    /// Whether there is a grid and a mesh of it. Without them the result has what is known in
    /// closed form, of the kinds SolventExcluded, SolventAccessible and VanDerWaals alone, with
    /// none of split, surfaceOf, fields, fillCavities, minWall and curvatureTotals.
    bool grid = true;

    /// Tells whether parts have surfaces of their own.
    bool ofParts() const { return split || !surfaceOf.empty(); }
};

/// A surface, and what is made of it.
struct SurfaceOptions : SurfaceSpec, Wanted {
};

/// Returns the probe radius that the surface is made with [Å]. It is 0 for the van der Waals and
/// the Gaussian surface, whatever SurfaceSpec::probe is.
double probeOf(const SurfaceSpec& spec);

/// Returns the word of the command line for a kind: variational, ses, smooth-sas.
const char* nameOf(SurfaceKind kind);

/// Returns the word of the command line for a property: chain, element, mean-curvature.
const char* nameOf(ColorBy color);

/// Returns the word of the command line for a regulariser: gradient, area.
const char* nameOf(Regularizer regularizer);

/// Returns the word of the command line for a flow: newton, paper.
const char* nameOf(Flow flow);

/// Checks the options.
/// @throws Error(ErrorKind::Usage) if an option is out of its range; the message names its member
void checkOptions(const SurfaceOptions& options);

} // namespace molsurf
