// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Makes a structure: atom by atom, or of gemmi's tree of models, chains and residues.

#include "molsurf/structure/name_table.h"
#include "molsurf/structure/structure.h"

#include <gemmi/model.hpp>

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace molsurf
{

/// Copies gemmi's trees into the tables of a structure: models, atoms, residues, chains. A tree may
/// be a piece of what another began, with chains of its own.
class TreeCopier
{
public:
    /// @param[in] entitiesKnown  whether the file says what the entities are
    TreeCopier(Structure& out, bool entitiesKnown) : out_(out), entitiesKnown_(entitiesKnown) {}

    /// @param[in] goesOn  whether the first model goes on with the last one, if its number is that
    void add(const gemmi::Structure& tree, bool goesOn);

    /// Separates molecules that gemmi joined as their numbers and names are the same.
    void finish();

private:
    void add(const gemmi::Chain& chain, const gemmi::Residue& from);

    Structure& out_;
    bool entitiesKnown_;
    NameTable chains_, asyms_;
};

/// Takes away Structure::serials that only count the atoms of each model.
void dropPlainSerials(Structure& structure);

/// One atom as a reader finds it.
struct AtomLine {
    std::string_view chain, residue, name;
    std::string_view segment; ///< of one chain; residues of two segments are different ones
    int number = 0;           ///< of the residue
    char insertionCode = ' ';
    bool hetatm = false;
    char altloc = '\0';
    int element = 0;            ///< atomic number; 0 if unknown
    bool guess = true;          ///< whether guessElement() finds an element that is unknown
    bool inFirstColumn = false; ///< see ElementEvidence
    AtomRole role = AtomRole::Atom;
    double mass = -1.0; ///< [u]; < 0: unknown
    openvdb::Vec3d position{0.0};
    float occupancy = 1.0f, bFactor = 0.0f;
    double radius = -1.0; ///< [Å]; < 0: the file has none
    int serial = 0;       ///< the number of the atom in the file; 0: one more than before
};

/// An atom of a file without residues: it is of UNL, as the Protein Data Bank calls an unknown
/// ligand.
inline AtomLine unknownLigandAtom(const openvdb::Vec3d& position)
{
    AtomLine atom;
    atom.residue = "UNL";
    atom.number = 1;
    atom.hetatm = true;
    atom.position = position;
    return atom;
}

/// Makes a structure atom by atom, in the order of the file. A residue begins where its chain,
/// number or names change, and in molecules other than links of chains where one like its first
/// atom comes again that no bond joins to the residue before. Alternatives of one residue may
/// alternate, and those of several may come one after the other.
class AtomTree
{
public:
    void startModel(int number);
    void add(const AtomLine& atom);
    void reserve(std::size_t atoms) { out_.atoms.reserve(atoms); }

    /// Says why no surface can be made of the current model.
    void spoil(const std::string& problem) { out_.models.back().problem = problem; }

    /// @param[in] placed  whether the atoms have places
    Structure finish(bool placed = true);

private:
    std::uint8_t elementOf(const AtomLine& atom);
    bool isSame(std::int32_t residue, const AtomLine& atom, std::int32_t chain) const;
    std::int32_t residueOf(const AtomLine& atom);

    Structure out_;
    NameTable chains_;
    NameTable segmentTable_;
    std::vector<std::string> segmentNames_;
    std::int32_t segment_ = 0;                              ///< of the atom that is added
    std::vector<std::int32_t> segments_;                    ///< one a residue
    std::vector<char> altlocs_;                             ///< one a residue: of its last atom
    std::int32_t modelBegin_ = 0;                           ///< first residue of the model
    std::unordered_map<std::string, std::uint8_t> guesses_; ///< by names and mass
};

} // namespace molsurf
