// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Makes a structure atom by atom: the one rule where a residue begins.

#include "molsurf/molecule/structure/name_table.h"
#include "molsurf/molecule/structure/structure.h"

#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace molsurf
{

/// One atom as a reader finds it.
struct AtomLine {
    std::string_view chain, residue, name;
    std::string_view asym;    ///< label_asym_id; empty: the chain
    std::string_view segment; ///< of one chain
    int number = 0;           ///< of the residue
    char insertionCode = ' ';
    bool hetatm = false;
    EntityHint entity = EntityHint::None;
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

/// Joins models of one number, whose places in the order are those of their first atoms.
void joinModels(Structure& structure);

/// Makes a structure atom by atom, in the order of the file. A residue has one chain, number,
/// insertion code and name, and no name of an atom twice in one location:
/// - Atoms that come later in the model, or of another segment, belong to the first residue with
///   these that has none of their names. So do hydrogens at the end of a file, alternatives block
///   by block, and the atoms of chains that alternate.
/// - In molecules other than links of chains another residue begins where an atom like the first
///   one follows that no bond joins to the atoms before.
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
    using Label = std::pair<std::string, char>; ///< name and alternate location

    std::uint8_t elementOf(const AtomLine& atom);
    bool isSame(const Residue& a, const Residue& b) const;
    Residue residueOf(const AtomLine& atom);
    void startResidue(Residue residue);
    void endRun();
    Label labelOf(std::size_t atom) const
    {
        return {out_.atoms[atom].name, out_.atoms[atom].altloc};
    }
    std::set<Label>& labelsOf(std::int32_t residue);
    std::int32_t earlierResidue(std::int32_t run);

    Structure out_;
    NameTable chains_, asyms_, segments_;
    std::unordered_map<std::string, std::uint8_t> guesses_; ///< by names and mass

    // Of the model; a run is what comes without another residue between.
    std::size_t runBegin_ = 0;                               ///< first atom of the present run
    std::vector<std::pair<std::size_t, std::size_t>> runs_;  ///< atoms of each residue's first run
    std::vector<std::int32_t> likeBefore_;                   ///< residue of the same hash; -1: none
    std::unordered_map<std::size_t, std::int32_t> lastLike_; ///< by hash
    std::unordered_map<std::int32_t, std::set<Label>> labels_; ///< of residues of several runs
    std::int32_t modelBegin_ = 0;                              ///< first residue of the model
    bool joined_ = false; ///< whether a residue has several runs in some model
};

} // namespace molsurf
