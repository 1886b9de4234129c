// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Reads atoms from a file and makes balls of them: which atoms, how large, and with which labels.

#include "molsurf/ball.h"
#include "molsurf/progress.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace molsurf
{

/// A rule by which beads stand for some or all of the atoms.
struct CoarseRule {
    enum class Level {
        Atom,    ///< Every atom is a ball of its own.
        Residue, ///< An amino acid becomes two beads, a nucleotide three.
        Cluster  ///< About as many neighbouring atoms as `atoms` says become a bead.
    };
    std::string select; ///< atoms that the rule is for, as SelectOptions::select; empty: all
    Level level = Level::Atom;
    int atoms = 1; ///< atoms in a bead of Level::Cluster, about; >= 2 there, unused elsewhere
};

/// Some of the copies of an assembly.
struct CopyChoice {
    std::vector<std::pair<int, int>> ranges; ///< first and last number, from 1; empty: see fold
    int fold = 0; ///< those about the nearest axis of so many folds, with copy 1; 0 without ranges:
                  ///< all
    bool others = false; ///< whether those are used that are not chosen

    bool all() const { return ranges.empty() && fold == 0; }
};

/// A group of atoms that the caller asks for.
struct GroupRule {
    std::string name;
    std::string select;                               ///< its atoms, as SelectOptions::select
    std::optional<std::array<std::uint8_t, 3>> color; ///< red, green, blue (sRGB), if one is wanted
    CopyChoice copies{};                              ///< copies of the assembly that it is in
    std::vector<int> copyNumbers{}; ///< the numbers that `copies` stands for, which readAtoms()
                                    ///< finds; empty: all
};

/// How groups are made without rules.
struct GroupBy {
    enum class Kind {
        Chain,
        Entity,  ///< chains of the same residues
        Class,   ///< a chain of the file with all its copies
        Copy,    ///< a copy of the assembly
        Residues ///< so many residues of a chain as `residues` says
    };
    Kind kind = Kind::Chain;
    int residues = 0; ///< >= 1 for Kind::Residues, unused elsewhere
};

/// Values of atoms that colours can show. docs/colors.md.
struct ValueBy {
    enum class Kind {
        BFactor,
        Occupancy,
        Charge,         ///< of a PQR file
        Hydrophobicity, ///< of the amino acid
        Rainbow,        ///< the place of the residue in its chain
        Radius,         ///< the distance from the centre
        Depth,          ///< below the solvent-excluded surface
        Table,          ///< of a file: chain, residue number, perhaps the atom, value
        Potential       ///< of a map in the format OpenDX
    };
    Kind kind = Kind::BFactor;
    std::string file{}; ///< its path, for the last two

    /// Whether points have values of their own, and not those of balls.
    bool byPoint() const { return kind == Kind::Radius || kind == Kind::Potential; }
};

/// A group of balls that was found.
struct Group {
    std::string name;
    std::size_t balls = 0;                            ///< number of its balls
    std::optional<std::array<std::uint8_t, 3>> color; ///< red, green, blue (sRGB), if it has one
    /// Among all that the file has, whatever is selected: it decides the colour. -1: not known.
    std::int32_t place = -1;
};

/// Kinds of residues. Those of one kind have one colour with ColorBy::Residue, which takes all
/// nucleotides for one kind.
enum class ResidueClass : std::uint8_t {
    Hydrophobic,
    Aromatic,
    Polar,
    Positive,
    Negative,
    Special, ///< glycine, proline, cysteine
    Nucleic, ///< a nucleotide with another base than the following
    Adenine,
    Cytosine,
    Guanine,
    Thymine, ///< or uracil
    Other
};

struct ScalarMap;
struct PointCharges;

/// A value of every ball, and how colours show it.
struct BallValues {
    std::string name;                     ///< of the vertex attribute: "bfactor"
    std::string title;                    ///< for people: "B factor"
    std::string unit;                     ///< or the name of the scale; empty: none
    std::string palette = "viridis";      ///< colours, low values first
    double low = 0.0, high = 1.0;         ///< values at the ends of the colours; if they are equal
                                          ///< all values are, and there is nothing to show
    std::optional<openvdb::Vec3d> centre; ///< the value of a point is its distance from here [Å]
    std::shared_ptr<const ScalarMap> field{}; ///< the value of a point is taken from here
    std::vector<float> valueOf{};             ///< one a ball; not a number: it has none
    bool flat = false; ///< whether a point has the value of one ball, and not a blend

    /// Whether points have values of their own, and not those of balls.
    bool byPoint() const { return centre || field; }
};

/// Labels of the balls: vectors whose names end in "Of" have one entry for every ball.
struct BallLabels {
    std::vector<std::int32_t> chainOf; ///< index into `chains`
    std::vector<std::string>
        chains; ///< name of each chain: "A", in an assembly's second copy "A-2"
    std::vector<std::int32_t> groupOf;        ///< index into `groups`; -1: the ball is in no group
    std::vector<Group> groups;                ///< the groups that were asked for, in their order
    std::vector<Group> colorGroups;           ///< those that ColorBy::FileGroup shows
    std::vector<std::int32_t> colorGroupOf;   ///< index into them; -1: none; empty: there are none
    std::vector<std::uint8_t> elementOf;      ///< atomic number; 0: the element is unknown
    std::vector<ResidueClass> residueClassOf; ///< the kind of the ball's residue
    std::optional<BallValues> values;         ///< if there are any
    std::optional<BallValues> patchValues;    ///< those that patches are of, if there are any
    std::vector<std::string>
        warnings; ///< one line each, as of groups that lost atoms to later ones
    /// Red, green, blue (sRGB) of each chain. If it is empty the library chooses colours of which
    /// chains that touch have different ones.
    std::vector<std::array<std::uint8_t, 3>> chainColors{};
    /// The place of each chain among those of the file and of all copies, whatever is selected: it
    /// decides the colour. Empty: not known.
    std::vector<std::int32_t> chainPlaces{};
};

/// The names of balls. Without copies of an assembly a residue is one of the file.
struct BallNames {
    /// A residue, as people name it.
    struct Residue {
        std::string chain;        ///< the author's name; in an assembly's second copy "A-2"
        std::string labelChain;   ///< label_asym_id of mmCIF, elsewhere the same as `chain`
        std::string name;         ///< "ALA"
        int number = 0;           ///< the author's sequence number
        char insertionCode = ' '; ///< ' ' if it has none
        bool hetatm = false;      ///< whether its record in the file is HETATM
    };

    /// An atom, as people name it.
    struct Atom {
        std::string name;         ///< "CA"
        char altloc = '\0';       ///< '\0' if it has no alternate location
        std::uint8_t element = 0; ///< atomic number; 0: unknown
        float occupancy = 1.0f;   ///< in [0, 1]
    };

    std::vector<Residue> residues;       ///< in the order of their first balls
    std::vector<std::int32_t> residueOf; ///< index into `residues`, one a ball
    std::vector<Atom> atoms;             ///< one a ball
};

/// A rule by which the Gaussians of some or all atoms are blurred to a resolution d: they fall off
/// at the rate pi^2 / d^2, as those of the command molmap of ChimeraX, whose standard deviation is
/// d / (pi sqrt(2)).
struct ResolutionRule {
    std::string select; ///< atoms that the rule is for, as SelectOptions::select; empty: all
    double resolution;  ///< d [Å], in [1, 50]
};

/// The ligands and ions that count as molecule. docs/structural_biology.md, Which atoms.
enum class Hetero {
    None,  ///< polymers alone
    Bound, ///< what touches a polymer, but for buffers, lipids, detergents, and ions of alkali
           ///< metals and halogens; all if the selected atoms have no polymer
    All    ///< whatever is in the file
};

/// The assembly that is made of the chains of a file.
struct AssemblyChoice {
    std::optional<std::string> name; ///< in the file; none: the atoms stay where they stand there
    CopyChoice copies{};             ///< the copies to use
    bool instances = false; ///< whether the balls are those of each prototype of the assembly once,
                            ///< in the coordinates of the file
    /// Whether the balls are those of a unit, of which the rotations of the assembly make the
    /// whole, and those around it, as Placement::unit says. Not beside `instances` and `copies`.
    bool bySymmetry = false;
    double surroundings = 20.0; ///< how far around a unit the balls lie [Å], see surroundingsOf()
    /// Whether the balls may be those of each part of the assembly once, as Placement::folded says:
    /// for planBricks() alone. They are if nothing but places and radii is asked for, and no atom
    /// lies exactly where another of the same radius lies.
    bool folded = false;

    /// Tells whether motions repeat the balls that are made.
    bool repeats() const { return instances || bySymmetry; }
};

/// Bounds of reading [byte].
struct ReadLimits {
    /// Size of a file's text, unpacked; 0: 4 GiB, and no more than 200 times its packed size.
    std::size_t maxInput = 0;
    /// Memory of the process while it reads; 0: what the machine, its control group and the process
    /// may have.
    std::size_t memory = 0;
};

/// Options that say which atoms are used and how large they are.
struct SelectOptions {
    /// The atoms to use: in words of PyMOL, VMD and MDAnalysis, as "chain A and resid 10 to 20", or
    /// gemmi selections joined by '|', as "A" or "A/10-20|B"; empty: all. docs/selections.md.
    std::string select;
    int model = 0; ///< number of the model in the file; 0: the one that `select` names, or the
                   ///< first
    AssemblyChoice assembly;
    /// The alternate locations to use: those of this label and those without one, or "all"; empty:
    /// those of the highest occupancy.
    std::string altloc;
    bool hydrogens = true; ///< whether hydrogen and deuterium of the file are used
    /// The ligands and ions that are used.
    Hetero hetero = Hetero::Bound;
    bool ions = false;   ///< whether free ions are used, too
    bool waters = false; ///< whether waters are used
    /// The radii of the atoms: "bondi", "alvarez", "gemmi", of heavy atoms with their hydrogens
    /// "protor" or "naccess", for beads of a coarse-grained file "martini2" or "martini3", or the
    /// path of a file with a rule on each line: "C 1.70", "ALA CB 1.90", or with "*" for any
    /// element or residue.
    std::string radii = "bondi";
    std::vector<CoarseRule> coarse;          ///< beads; of two rules for an atom the later one wins
    std::vector<ResolutionRule> resolutions; ///< resolutions; the later rule wins
    ReadLimits limits;
};

/// How values and curvatures are shown as colours.
struct Coloring {
    std::optional<std::array<double, 2>> range; ///< values at the ends of the colours; none: most
                                                ///< of the values lie between them
    std::string palette;    ///< "viridis", for example; empty: that of the kind of values
    bool byResidue = false; ///< whether a residue's atoms have the mean of their values
    bool flat = false;      ///< whether a point has the value of one atom, and not a blend
    std::optional<double> potentialOffset; ///< how far outside of the surface a potential is taken
                                           ///< [Å]; none: the probe radius, of a surface that is a
                                           ///< probe radius out itself 0
};

/// Labels, values and colours of balls, which products and files ask for.
struct LabelOptions {
    std::vector<GroupRule> groups;      ///< groups; the later rule wins
    std::optional<GroupBy> groupBy;     ///< makes the groups instead of `groups`
    std::vector<GroupRule> colorGroups; ///< the groups that ColorBy::FileGroup shows, whatever
                                        ///< `groups` are; the later rule wins
    std::optional<ValueBy> valueBy;     ///< the values that ColorBy::Value shows
    std::optional<ValueBy> patchBy;     ///< the values that PatchRule::by Value is about
    Coloring coloring;                  ///< how values and curvatures are shown
    std::optional<std::array<std::uint8_t, 3>>
        plainColor;       ///< red, green, blue (sRGB) that all balls get, if it is given
    bool labels = true;   ///< whether the balls are labelled even if there are neither groups nor
                          ///< values
    bool names = true;    ///< whether the balls have names
    bool charges = false; ///< whether the charges of all atoms come along, those without radius too
};

/// Where products are searched for, in words. Molecule::places() finds it.
struct PlaceOptions {
    std::string pocketAt; ///< atoms of the file, used or not, whose pocket is the only one that is
                          ///< wanted; empty: all are
    /// The pore that is wanted: "auto", an axis as "z" or "0,0,1", or its ends with " -> " between,
    /// each a point as "1,2,3" or atoms of the file. docs/pores.md. Empty: none.
    std::string pore;
    std::string tunnelsFrom; ///< where tunnels begin: a point as "1,2,3" or atoms of the file, used
                             ///< or not; empty: none are wanted
};

/// Where products are searched for.
struct SearchPlaces {
    /// An end of a pore.
    struct End {
        openvdb::Vec3d place; ///< [Å]
        bool isPoint;         ///< whether it is that point; else somewhere near it
    };
    /// The course of a pore.
    struct PoreWay {
        std::vector<End> ends{};  ///< two, or none: it leads through the molecule
        openvdb::Vec3d axis{0.0}; ///< along which it leads then, a unit vector; 0: to be found
    };

    std::vector<openvdb::Vec3d> pocketAt; ///< atoms whose pocket is wanted [Å]; empty: all are
    std::optional<PoreWay> pore;          ///< none: no pore is wanted
    std::optional<End> tunnelsFrom;       ///< where tunnels begin; none: no tunnels are wanted
};

/// A number of atoms that are left out for one reason.
struct Excluded {
    /// "not selected", "water", "ligand or ion", "free ion (CL, NA)", "buffer (GOL)", "lipid
    /// (POPC)", "ligand apart (NAG)", "particle that is no atom", "sphere of a coarser scale",
    /// "hydrogen", "hydrogen in radii of heavy atoms", "dummy", "alternate location", "zero
    /// radius", "duplicate", "not in the assembly"
    std::string reason;
    std::size_t count;
};

/// The balls that have the resolution of one rule.
struct ResolutionGroup {
    ResolutionRule rule;
    std::size_t balls = 0; ///< number of its balls, without those of later rules
    double level = 0.0;    ///< Decay::level of all of them
};

/// A copy of a prototype, that is of balls that an assembly moves together.
struct Instance : Motion {
    std::size_t part = 0; ///< index of the prototype
    std::string name;     ///< of the operator
};

/// How the balls of a set stand for a whole. There are five ways: the balls of a file, or of all
/// copies of an assembly, are the whole themselves; prototypes have a surface each, and instances
/// repeat it; rotations repeat a unit, whose neighbours are among the balls; and instances repeat
/// the balls of parts, but the surface is of all of them together.
struct Placement {
    /// A unit of an assembly, of which rotations about a point make the whole: the motions of
    /// `instances`, of which the first is the identity. They are a group.
    struct Unit {
        std::string pointGroup; ///< Schoenflies: "C5", "D3", "T", "O", "I"; "" if other
        openvdb::Vec3d centre;  ///< the point [Å]
        std::size_t copies = 0; ///< copies of the assembly in the unit
        double deviation = 0.0; ///< largest distance of a copy from where a motion brings it [Å]
        std::vector<std::vector<std::size_t>> product; ///< motion k after motion l is product[k][l]
        std::vector<std::size_t> inverse;              ///< of each motion
    };

    std::size_t copies = 1; ///< copies that the assembly makes; its prototypes, if instances repeat
                            ///< them; 1 without an assembly
    std::vector<std::size_t> begin;     ///< copy or prototype i is balls [begin[i], begin[i + 1])
    std::vector<int> numbers;           ///< of copy i in the whole assembly, from 1
    std::vector<Instance> instances;    ///< that make the whole; empty: the balls are the whole
    std::optional<Unit> unit;           ///< if the instances are its rotations
    std::size_t around = 0;             ///< balls around a unit; they come last
    std::vector<std::int32_t> motionOf; ///< of each ball of a unit and around it: the motion that
                                        ///< made it; 0: the unit's
    bool folded = false; ///< whether the balls are those of parts, and the whole what the instances
                         ///< make of them, in their order; `copies` counts the parts

    /// Tells whether the balls are the whole themselves.
    bool isWhole() const { return instances.empty(); }

    /// Tells whether a ball belongs to what the surface is of; -1 is that of a point without one.
    bool owns(std::int32_t ball) const
    {
        return motionOf.empty() || (ball >= 0 && motionOf[std::size_t(ball)] == 0);
    }

    /// Returns how many prototypes have surfaces of their own.
    std::size_t prototypes() const { return isWhole() ? 1 : copies; }

    /// Returns how often the whole has each ball that a surface is of.
    std::size_t order() const { return unit ? instances.size() : 1; }
};

/// How balls were chosen from a file.
struct SelectionRecord {
    /// The options that Molecule::balls() and Molecule::places() got.
    struct Asked {
        SelectOptions options;
        LabelOptions labels;
        PlaceOptions places;
    };

    std::string input;   ///< the path of the file, as it was given; empty: there is none
    bool isFile = false; ///< whether that can be read again: no stream, and no text in memory
    std::optional<Asked> asked;  ///< none: the balls are of no file
    std::vector<Excluded> drops; ///< atoms left out of the model, before the assembly is made
    std::size_t beads = 0;       ///< balls that coarse rules made
    std::size_t beadAtoms = 0;   ///< atoms that these balls stand for
    std::string radii; ///< the name of the set, or of the file, that the radii are from; empty: the
                       ///< structure's own
    int model = 0;     ///< number of the model that was used
    std::optional<openvdb::Vec3d> membrane; ///< its normal in the file, a unit vector, which is up
                                            ///< in pictures
    std::vector<std::string> warnings;      ///< one line each, as of unknown elements
};

/// Balls with their labels, and a record of how they were chosen.
struct BallSet : BallModel {
    std::vector<ResolutionGroup> resolutions; ///< one for each rule, in their order
    std::vector<std::int32_t> resolutionOf;   ///< index of each ball's rule, or -1; empty if there
                                              ///< are no rules
    Placement placement;                      ///< how the balls stand for the whole
    std::optional<BallLabels> labels;         ///< present unless they were not asked for
    std::optional<BallNames> names;           ///< the same
    std::shared_ptr<const PointCharges> charges; ///< of the atoms of the file; null: not asked for
    std::vector<std::array<std::uint8_t, 3>> colors; ///< red, green, blue (sRGB), one a ball; empty
                                                     ///< if the caller chose none
    Coloring coloring; ///< of values and curvatures, as LabelOptions::coloring
    SelectionRecord record;

    /// Returns the number of balls that the surface is of, which are the first ones: without those
    /// around a unit.
    std::size_t own() const { return balls.size() - placement.around; }

    /// Returns the first ball of a prototype and that behind its last, if the whole has any.
    std::pair<std::size_t, std::size_t> prototype(std::size_t p) const
    {
        if (placement.prototypes() == 1) return {0, own()};
        return {placement.begin[p], placement.begin[p + 1]};
    }

    /// Returns the number of balls of the whole that a unit stands for, or of these.
    std::size_t whole() const { return own() * placement.order(); }
};

/// Checks the options.
/// @throws Error(ErrorKind::Usage) if one of them is wrong whatever the file holds
void checkOptions(const SelectOptions& options);
void checkOptions(const LabelOptions& options);
void checkOptions(const PlaceOptions& options);

/// Reads atoms from a file of the format PDB, mmCIF, BinaryCIF, gro, sdf, mol2, PQR, xyzr or xyzrn,
/// which may be compressed by gzip. The content tells the format; the name does not matter.
///
/// @param[in] path      the path of the file, or "-" for standard input
/// @param[in] options   which atoms are used and how large they are
/// @param[in] probe     the probe radius of the surface that will be made [Å], see probeOf(); the
///                      radii of beads depend on it
/// @param[in] progress  may end the reading
/// @return at least one ball, in the order of the file, copy by copy of the assembly
/// @throws Error(ErrorKind::Input) if the file cannot be read, or nothing of it is left
/// @throws Error(ErrorKind::Usage) if an option does not suit the file
/// @throws Cancelled if the progress object says so
BallSet readAtoms(const std::string& path, const SelectOptions& options = {}, double probe = 0.0,
                  const Progress& progress = Progress());

/// A file that is in memory.
struct FileContent {
    std::string name;  ///< stands for it in messages; its extension decides between formats where
                       ///< the content leaves a choice
    std::string bytes; ///< as they would lie on the disk, gzip too
};

/// Reads atoms from a file in memory; otherwise as above.
BallSet readAtoms(FileContent file, const SelectOptions& options = {}, double probe = 0.0,
                  const Progress& progress = Progress());

struct Structure;

/// What a file holds: atoms, residues, chains, models, assemblies, bonds and charges. Copies share
/// it; it does not change.
class Molecule
{
public:
    /// Reads a file; parameters and errors as of readAtoms().
    explicit Molecule(const std::string& path, const Progress& progress = Progress(),
                      const ReadLimits& limits = {});

    /// Reads a file in memory; otherwise as above.
    explicit Molecule(FileContent file, const Progress& progress = Progress(),
                      const ReadLimits& limits = {});

    /// Makes balls of atoms, as readAtoms() does, with labels, values and colours.
    /// @throws Error(ErrorKind::Input) if the file lacks what a label is of
    BallSet balls(const SelectOptions& options = {}, const LabelOptions& labels = {},
                  double probe = 0.0, const Progress& progress = Progress()) const;

    /// Finds the places where products are searched for.
    /// @param[in,out] atoms  balls of the molecule; their record gets warnings
    /// @throws Error(ErrorKind::Usage) if the words are wrong, or match no atom of the model
    SearchPlaces places(const PlaceOptions& options, BallSet& atoms) const;

    /// Finds the atoms that a selection takes, used or not.
    /// @param[in] selection  as SelectOptions::select; empty: all
    /// @return their places in the file, counted from 0 over all models, as Ball::atom; ascending
    /// @throws Error(ErrorKind::Usage) if it cannot be parsed
    /// @throws Error(ErrorKind::Input) if it matches no atom
    std::vector<std::size_t> select(const std::string& selection) const;

    /// Returns the molecule with atoms at other places.
    /// @param[in] atoms   their places in the file
    /// @param[in] places  one an atom [Å]
    Molecule moved(const std::vector<std::int32_t>& atoms,
                   const std::vector<openvdb::Vec3d>& places) const;

private:
    Molecule(std::shared_ptr<const Structure> structure, std::string input);
    std::shared_ptr<const Structure> structure_;
    std::string input_; ///< SelectionRecord::input
    bool isFile_ = false;
};

/// Radii of atoms that were not read from a file [Å]: as readAtoms() gives them, but for atoms of
/// which nothing is known.
///
/// @param[in] names     of the atoms: "CA"
/// @param[in] residues  their names: "ALA"; one an atom, or none at all
/// @param[in] elements  symbols in any case, "" where the name has to tell; one an atom, or none
/// @param[in] set       see SelectOptions::radii
/// @return one an atom; 0: it is to be left out, as hydrogens of a set of heavy atoms with theirs;
///         not a number: nothing tells its radius
/// @throws Error(ErrorKind::Input) if the set is none, or the lists differ in length
std::vector<double> atomRadii(const std::vector<std::string>& names,
                              const std::vector<std::string>& residues,
                              const std::vector<std::string>& elements,
                              const std::string& set = "bondi");

} // namespace molsurf
