// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A molecule as it stands in its file: the atoms of all models, and the operators that build its
/// biological assemblies.

#include "molsurf/ball.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace molsurf
{

struct FileBonds;

/// Kind of a residue; classifyResidues() decides. docs/structures.md has the table.
enum class ResidueKind : std::uint8_t {
    Protein,  ///< a standard amino acid of a chain
    Nucleic,  ///< a standard nucleotide of a chain
    Modified, ///< another link or the cap of a chain
    Water,
    Ion,    ///< an atom alone; rolesIn() tells free ones from bound ones
    Buffer, ///< salts, buffers, solvents, cryoprotectants, by name
    Lipid,  ///< lipids and detergents
    Sugar,
    Ligand,   ///< any other molecule
    Particle, ///< has no atoms: virtual sites, Drude particles, lone pairs
    Bead      ///< stands for several atoms, and its name says no more
};

/// Entity of a residue, by its file.
enum class EntityHint : std::uint8_t { None, Polymer, Water, Other };

/// A residue's identity, and what decides whether its atoms are kept.
struct Residue {
    std::string name;    ///< "ALA", "HOH"
    std::int32_t chain;  ///< index into Structure::chains: the author's name
    std::int32_t asym;   ///< index into Structure::asyms: the name that assemblies use
    std::int32_t number; ///< sequence number in the file
    char insertionCode;  ///< ' ' if none
    bool hetatm = false; ///< whether its record in the file is HETATM
    ResidueKind kind = ResidueKind::Protein;
    EntityHint entity = EntityHint::None;
    std::int32_t segment = -1; ///< index into Structure::segments; -1: none

    bool water() const { return kind == ResidueKind::Water; }
    /// A link of a chain, or a bead.
    bool polymer() const { return kind <= ResidueKind::Modified || kind == ResidueKind::Bead; }
    /// Ligands, ions and what else is neither water nor of a chain.
    bool hetero() const { return !water() && !polymer(); }
};

/// Role of a record in the place of an atom.
enum class AtomRole : std::uint8_t {
    Atom,        ///< or a bead
    Particle,    ///< none: a virtual site, a Drude particle, a lone pair
    CoarserScale ///< a sphere of residues for which the model has finer ones
};

/// One atom.
struct Atom {
    openvdb::Vec3d position; ///< [Å]
    std::string name;        ///< "CA"
    std::int32_t residue;    ///< index into Structure::residues
    std::uint8_t element;    ///< atomic number; 0 if unknown; hydrogen and deuterium are 1
    char altloc;             ///< '\0' if the atom has no alternate location
    AtomRole role;           ///< what it is if it is no atom
    float occupancy;         ///< in [0, 1]
    float bFactor;           ///< [Å^2]
    double radius;           ///< the file's own [Å]; < 0 if it gives none
};

/// A motion of an assembly.
struct Operator : Motion {
    std::string name; ///< "7"; of a product "(1)(61)"; may be empty
};

/// Some chains and the operators that make their copies.
struct AssemblyPart {
    std::vector<std::string> chains; ///< as in Structure::asyms; empty: all
    std::vector<Operator> operators; ///< products already multiplied out
};

/// A biological assembly, or with the name "ncs" what the non-crystallographic symmetry of the file
/// makes of its coordinates.
struct Assembly {
    std::string name; ///< "1"
    std::vector<AssemblyPart> parts;
    std::string problem; ///< why it cannot be built; empty if it can
};

/// Atoms [begin, end) of one model.
struct Model {
    int number; ///< as in the file
    std::size_t begin, end;
    std::string problem = {}; ///< why no surface can be made of it; empty if one can
};

/// The kind of particles that the atoms of a file are: atoms or beads, see markBeads().
enum class BeadKind : std::uint8_t {
    None,     ///< atoms
    Martini2, ///< beads of Martini 2, by name
    Martini3, ///< beads of Martini 3, by name
    Unnamed   ///< beads that are named by atoms
};

/// A file's content.
struct Structure {
    std::string source; ///< file name without folder, or "-" for standard input
    std::string format; ///< as formatName() has it: "PDB"
    std::vector<Model> models;
    std::vector<Atom> atoms;
    std::vector<Residue> residues;
    std::vector<std::string> chains;   ///< author's names (auth_asym_id in mmCIF)
    std::vector<std::string> asyms;    ///< label_asym_id in mmCIF; elsewhere the same as chains
    std::vector<std::string> segments; ///< columns 73-76 of a PDB file, segments of a .psf
    std::vector<Assembly> assemblies;
    BeadKind beads = BeadKind::None;
    std::vector<std::int32_t> serials; ///< of the atoms, as the file numbers them; empty: from 1 in
                                       ///< each model
    std::vector<float> charges;        ///< of the atoms of a PQR or .mol2 file [e]; else empty
    std::vector<std::string> labels;   ///< of the atoms of an xyzrn file: the last column as it
                                       ///< stands there; else empty
    bool hasRadii = false;             ///< true if every atom has the file's own radius
    bool placed = true;                ///< false if the atoms have no places yet, which then are
                                       ///< all 0
    bool plddt = false;      ///< whether the file says that B factors are the pLDDT of a prediction
    std::size_t guessed = 0; ///< atoms of the first model whose elements come from names or masses
    std::shared_ptr<const FileBonds> bonds; ///< that the file gives; null: it gives none
    std::vector<std::string> warnings;      ///< one line each: parts of the file that were ignored
};

/// The residue that an atom belongs to.
inline const Residue& residueOf(const Structure& structure, const Atom& atom)
{
    return structure.residues[std::size_t(atom.residue)];
}

} // namespace molsurf
