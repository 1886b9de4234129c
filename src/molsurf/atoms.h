// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Atoms as balls: which ones of a file, how large, and what is known of them.

#include "molsurf/ball.h"
#include "molsurf/progress.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace molsurf
{

/// What becomes of some or all atoms.
struct CoarseRule {
    enum class Level { Atom, Residue, Cluster };
    std::string select; ///< gemmi selections joined by '|'; empty: all
    Level level = Level::Atom;
    int atoms = 1; ///< Cluster: about how many share a bead, >= 2
};

/// A group as asked for.
struct GroupRule {
    std::string name;
    std::string select;                               ///< gemmi selections joined by '|'
    std::optional<std::array<std::uint8_t, 3>> color; ///< sRGB
    std::string copies{}; ///< in these copies of the assembly, see parseCopies(); empty: all
    std::vector<int> copyNumbers{}; ///< what `copies` comes to; empty: all
};

/// A group as found.
struct Group {
    std::string name;
    std::size_t balls = 0;
    std::optional<std::array<std::uint8_t, 3>> color; ///< sRGB
};

/// Kinds of residues that are coloured alike.
enum class ResidueClass : std::uint8_t {
    Hydrophobic,
    Aromatic,
    Polar,
    Positive,
    Negative,
    Special, ///< glycine, proline, cysteine
    Nucleic,
    Other
};

/// What is known of every ball, by its index.
struct BallLabels {
    std::vector<std::int32_t> chainOf;        ///< index into chains
    std::vector<std::string> chains;          ///< "A", in an assembly's second copy "A-2"
    std::vector<std::int32_t> groupOf;        ///< index into groups, or -1
    std::vector<Group> groups;                ///< those asked for, in their order
    std::vector<std::uint8_t> elementOf;      ///< atomic number; 0: unknown
    std::vector<ResidueClass> residueClassOf; ///< by the residue's name
    std::vector<std::string> warnings;        ///< groups that lost atoms to later ones, ...
    /// sRGB, one a chain; empty: chosen by contacts, see chainColors().
    std::vector<std::array<std::uint8_t, 3>> chainColors{};
};

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
struct Excluded {
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
struct BallSet {
    std::vector<Ball> balls;
    std::vector<Decay> decays;                ///< one a ball; empty without resolution rules
    std::vector<ResolutionGroup> resolutions; ///< one a rule
    std::vector<std::int32_t> resolutionOf;   ///< rule of each ball, or -1; empty without rules
    std::vector<Excluded> drops;        ///< counted in one model, before the assembly is expanded
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

/// @throws Error(ErrorKind::Usage) for an option that is wrong whatever the file holds
void checkOptions(const SelectOptions& options);

/// Reads atoms from a file: .pdb, .ent, .cif, .mmcif, .pqr or .xyzr, each also .gz. The content
/// says which it is, not the name.
///
/// @param[in] path   a file, or "-" for standard input
/// @param[in] probe  that the surface is made with: radii of beads depend on it [Å]
/// @throws Error(ErrorKind::Input) if the file cannot be read, or nothing of it is left
/// @throws Error(ErrorKind::Usage) if an option does not suit the file
BallSet readAtoms(const std::string& path, const SelectOptions& options = {}, double probe = 0.0,
                  const Progress& progress = Progress());

} // namespace molsurf
