// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// gemmi's tree of models, chains and residues: how readers make it, and what we make of it.

#include "molsurf/structure/structure.h"

#include <gemmi/model.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace molsurf
{

/// Guesses what belongs to a polymer.
/// @param[in] all  of all residues; otherwise of those of which nothing is known
void guessPolymers(gemmi::Structure& tree, bool all);

/// Copies a tree into the tables of a structure: models, atoms, residues, chains.
///
/// @param[in] numbers        of the models that have chains, in order
/// @param[in] asyms          whether residues have asyms of their own, as in mmCIF; otherwise these
///                           are the chains
/// @param[in] entitiesKnown  whether the file says what belongs to a polymer; otherwise that is
///                           guessed from names and bonds
void copyTree(const gemmi::Structure& tree, const std::vector<int>& numbers, bool asyms,
              bool entitiesKnown, Structure& out);

/// One atom as a reader finds it.
struct AtomLine {
    std::string_view chain, residue, name;
    int number = 0; ///< of the residue
    char insertionCode = ' ';
    bool hetatm = false;
    int element = 0; ///< atomic number; 0 if unknown
    openvdb::Vec3d position{0.0};
};

/// Makes a structure atom by atom. Models, chains and residues begin where their numbers or names
/// change.
class AtomTree
{
public:
    void startModel(int number);
    void add(const AtomLine& atom);

    /// The structure, in which guesses tell what belongs to a polymer.
    Structure finish();

private:
    gemmi::Structure tree_;
    std::vector<int> numbers_;
};

/// True for the amino acids and nucleotides that have no other form.
bool isStandardResidue(const std::string& name);

} // namespace molsurf
