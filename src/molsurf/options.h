// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The options of a molecular surface with their defaults: its shape (SurfaceSpec) and products.

#include "molsurf/atoms.h"
#include "molsurf/kernel.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace molsurf
{

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
    Pocket,       ///< the pocket whose wall a point is
    Patch,        ///< the patch that a point is in
    FileGroup     ///< the group of BallLabels::colorGroups
};

/// Products of a surface: its grids, its mesh, and the measures of its report.
struct Products : KernelProducts {
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

    /// Definition of a patch: a connected piece of the mesh where a value is above a level, or
    /// below it.
    struct PatchRule {
        ColorBy by = ColorBy::Value; ///< a curvature, or the value of LabelOptions::patchBy
        bool above = true;           ///< else below
        double level = 0.0;          ///< in the unit of the value
    };

    ColorBy color =
        ColorBy::Nothing; ///< property that colours the mesh's vertices and the grid `Cd`
    bool split = false;   ///< whether every group of atoms gets a surface of its own
    /// Names of groups that get a surface of their own, and the kind of each.
    std::vector<std::pair<std::string, SurfaceKind>> surfaceOf;
    bool interfaces = false; ///< whether the report has the areas that groups bury between them
    bool halfFloats = false; ///< whether the grids' values are saved as 16-bit floats
    bool meshLabels = true;  ///< whether the mesh has the atom, chain and group of its vertices
    std::vector<std::string> measures; ///< names of numbers for Report::measures: "sphericity"
    bool contacts = false;             ///< whether MolecularSurface::contacts is made
    bool pockets = false;              ///< whether the report has pockets
    PocketRule pocket;                 ///< which
    std::optional<PatchRule> patches;  ///< which patches the report has; none: it has none
    /// Radius within which vertices get the mean of the values that colours show and patches are
    /// of, in [0.5, 20] [Å]; 0: they have their own.
    double smoothColors = 0.0;
    bool pocketBodies = false; ///< whether MolecularSurface::pocketBodies is made
    SearchPlaces places;       ///< where pockets, a pore and tunnels are searched for
    double tunnelProbe = 0.9;  ///< tunnels are as wide as this at least, in [0.3, 10] [Å]; they
                               ///< end where a ball of PocketRule::probeOut gets
    /// The kind of surface that ballAreas, contacts and interfaces are of; none: that of `kind`.
    std::optional<SurfaceKind> areasOf;
    /// Whether there is a grid and a mesh of it. Without them the result has what is known in
    /// closed form, of the kinds SolventExcluded, SolventAccessible and VanDerWaals alone, with
    /// none of split, surfaceOf, fields, fillCavities, minThickness and curvatureTotals.
    bool grid = true;

    /// Tells whether parts have surfaces of their own.
    bool ofParts() const { return split || !surfaceOf.empty(); }
};

using Wanted = Products; ///< the name of Products before version 1.1

/// A surface, and what is made of it.
struct SurfaceOptions : SurfaceSpec, Products {
};

/// Returns the word of the command line for a property: chain, element, mean-curvature.
const char* nameOf(ColorBy color);

/// Checks the options.
/// @throws Error(ErrorKind::Usage) if an option is out of its range; the message names its member
void checkOptions(const SurfaceOptions& options);

} // namespace molsurf
