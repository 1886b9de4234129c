// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// From a structure to the balls whose surface is wanted.

#include "molsurf/balls/ball.h"
#include "molsurf/selection/coarse_grain.h"
#include "molsurf/selection/groups.h"
#include "molsurf/structure/structure.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace molsurf
{

/// A resolution, for some or all atoms.
struct ResolutionRule {
    std::string select; ///< gemmi selections joined by '|'; empty: all
    double resolution;  ///< d [Å], in [minResolution, maxResolution]
};
constexpr double minResolution = 1.0, maxResolution = 50.0;

/// Which atoms are used, and how large they are.
struct SelectOptions {
    std::string select;            ///< gemmi selections joined by '|', see matchAtoms(); empty: all
    int model = 0;                 ///< number in the file; 0: that of the selection, or the first
    std::string assembly = "none"; ///< name in the file, or "none": the coordinates as they stand
    std::string copies;            ///< "1,7,20-25" or "fold:5", see parseCopies(); empty: all
    std::string altloc;            ///< "": the highest occupancy; "A": blank and that label; "all"
    bool hydrogens = true;         ///< keep the hydrogens (and deuterium) of the file
    bool hetero = true;            ///< keep ligands and ions
    bool waters = false;           ///< keep waters
    std::string radii = "bondi";   ///< name of a set, or the path of a radii file, see readRadii()
    std::vector<CoarseRule> coarse;          ///< later ones win
    std::vector<ResolutionRule> resolutions; ///< later ones win
    std::vector<GroupRule> groups;           ///< later ones win
    std::string groupBy;                     ///< groups by chain, entity, ...; see labelBalls()
    bool labels = false;                     ///< label the balls, also without groups
};

/// Atoms left out for one reason.
struct Drop {
    std::string reason; ///< "not selected", "water", "ligand or ion", "hydrogen", "dummy",
                        ///< "alternate location", "zero radius", "not in the assembly"
    std::size_t count;
};

/// The balls that a resolution rule applies to.
struct ResolutionGroup {
    ResolutionRule rule;
    std::size_t balls = 0; ///< those that no later rule has
    double level = 0.0;    ///< of their Gaussians, see Decay
};

/// The balls, and what was done to get them.
struct BallSelection {
    std::vector<Ball> balls;
    std::vector<Decay> decays;                ///< one a ball; empty without resolution rules
    std::vector<ResolutionGroup> resolutions; ///< one a rule
    std::vector<std::int32_t> resolutionOf;   ///< rule of each ball, or -1; empty without rules
    std::vector<Drop> drops;            ///< counted in one model, before the assembly is expanded
    std::size_t copies = 1;             ///< assembly operators applied, 1 without an assembly
    std::vector<std::size_t> copyBegin; ///< copy i is balls [copyBegin[i], copyBegin[i + 1])
    std::vector<int> copyNumbers;       ///< of copy i in the whole assembly, from 1
    std::size_t beads = 0;              ///< balls that a coarse rule made
    std::size_t beadAtoms = 0;          ///< atoms that these stand for
    std::optional<BallLabels> labels;   ///< if asked for, or with groups
    std::vector<std::array<std::uint8_t, 3>> colors; ///< sRGB, one a ball; empty: not chosen
    int model = 0;                                   ///< number of the model that was used
    std::vector<std::string> warnings; ///< one line each: unknown elements, missing altloc, ...
};

/// Chooses atoms, gives them radii, and applies the operators of the assembly.
///
/// The order of the balls is that of the file, copy by copy: a copy is one operator applied to the
/// chains that share it. Every ball's `atom` is the index of its atom in Structure::atoms.
///
/// Of alternate locations, by default, each atom of a residue keeps the one of highest occupancy.
/// On a tie the label with the highest mean occupancy in that residue wins, then the first in the
/// file, so a residue with equal alternatives keeps one conformer. Where the alternatives are
/// different residues, one of them is kept, by the same rule.
///
/// A resolution d makes the Gaussians of its atoms fall off at the rate C = pi^2/d^2: blurred at
/// the resolution d, after Bajaj, Xu and Zhang 2009.
///
/// Coarse rules put beads in the place of atoms before the assembly is built, see coarseGrain(). A
/// bead goes as its representative atom: for groups, labels and resolutions.
///
/// Beads of a coarse-grained file (Structure::beads) have the radii of martini2 or martini3 unless
/// options.radii names others; "martini" is the set of their force field.
///
/// Radii of .pqr and .xyzr come from the file; options.radii must then be "bondi", its default.
///
/// @param[in] probe  that the surface is made with: radii of beads depend on it, see sizeBeads()
/// [Å]
/// @throws Error(ErrorKind::Input) if nothing is selected or nothing is left, if the model, the
///         alternate location, the assembly or the radii file does not exist, or if the molecule is
///         larger than 1e6 Å
/// @throws Error(ErrorKind::Usage) if the selection cannot be parsed or names another model than
///         options.model, if options.altloc is no label, or if radii are asked for a file that has
///         its own
BallSelection selectBalls(const Structure& structure, const SelectOptions& options,
                          double probe = 0.0, const Progress& progress = Progress());

/// One line that says what was read, used and dropped, by kind and count:
/// "1a8o.cif.gz: mmCIF, 1 model, 644 atoms; used 1112 balls (2 copies); dropped 88 water".
std::string describeSelection(const Structure& structure, const BallSelection& selection);

/// The built-in radii sets, one paragraph each: name, source, and the radii by element [Å].
std::string describeRadii();

} // namespace molsurf
