// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// From a structure to the balls whose surface is wanted.

#include "molsurf/atoms.h"
#include "molsurf/molecule/selection/match_atoms.h"

#include <string>

namespace molsurf
{

/// Chooses atoms, gives them radii, applies the operators of the assembly, and labels the balls.
///
/// The order of the balls is that of the file, copy by copy: a copy is one operator applied to the
/// chains that share it. Every ball's `atom` is the index of its atom in Structure::atoms.
///
/// Of alternate locations, by default, a residue keeps one reading as a whole: that of the largest
/// sum of occupancies over the atoms that readings share, of equal ones the first in the file. A
/// location without a label is a reading beside those of the same atoms with one. Where the
/// alternatives are different residues, one of them is kept, by the same rule.
///
/// A resolution d makes the Gaussians of its atoms fall off at the rate C = pi^2/d^2, as
/// ResolutionRule says.
///
/// Coarse rules put beads in the place of atoms before the assembly is built, see coarseGrain(). A
/// bead goes as its representative atom: for groups, labels and resolutions.
///
/// Beads of a coarse-grained file (Structure::beads) have the radii of martini2 or martini3 unless
/// options.radii names others; "martini" is the set of their force field.
///
/// Radii of .pqr, .xyzr and .xyzrn come from the file; options.radii must then be "bondi", its
/// default.
///
/// @param[in] probe  of the surface: radii of beads depend on it, see sizeBeads() [Å]
/// @throws Error(ErrorKind::Input) if nothing is selected or nothing is left, if the model, the
///         alternate location, the assembly or the radii file does not exist, or if the molecule is
///         larger than 1e6 Å
/// @throws Error(ErrorKind::Usage) if the selection cannot be parsed or names another model than
///         options.model, if options.altloc is no label, or if radii are asked for a file that has
///         its own
BallSet selectBalls(const Selections& selections, const SelectOptions& options,
                    const LabelOptions& labels = {}, double probe = 0.0,
                    const Progress& progress = Progress());

/// One line that says what was read, used and dropped, by kind and count:
/// "1a8o.cif.gz: mmCIF, 1 model, 644 atoms; used 1112 atoms (2 copies of 556 in the file); dropped
/// 88 water". The atoms of the file that are used and those that are dropped add up to the model.
std::string describeSelection(const Structure& structure, const BallSet& selection);

/// One line on the elements that a file does not name:
/// "elements of 152 atoms were told by names; 2 unknown: X1, X2".
std::string describeGuesses(const Structure& structure);

/// The built-in radii sets, one paragraph each: name, source, and the radii by element [Å].
std::string describeRadii();

} // namespace molsurf
