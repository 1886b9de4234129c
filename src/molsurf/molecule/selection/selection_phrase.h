// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A phrase of gemmi's in a selection: /model/chains/residues/atoms;properties.

#include "molsurf/molecule/selection/selection_tree.h"

#include <string>

namespace molsurf
{

/// A phrase.
struct SelectionPhrase {
    SubTree tree;
    int model = 0; ///< 0: any
};

/// Reads a phrase:
///
///     [/model/][chains][/residues[/atoms]][;property]...
///
/// - model: a number, nothing or *.
/// - chains, names of residues and atoms: *, or names joined by commas; ! before them selects the
///   others. A name with one of the letters of the grammar stands in quotes: "A/B", 'O5*'. A chain
///   may have a sign in its name: A-2.
/// - residues: a number, 10-20, -4--2, 10-, *-10 or *, each number with an insertion code (10A or
///   10.A; 10.* is 10 with any) and before or instead of it (ALA,GLY). A number alone is that
///   residue.
/// - atoms: names, [elements] and :alternate locations.
/// - properties: q<0.5, b>40, a kind of residues as kindWord() has it, polymer, solvent, hetero, or
///   several kinds joined by commas, with ! the others.
///
/// Parts at the beginning may be left out: what begins with a digit, a sign or ( is residues; what
/// has [ or : before any / is atoms; anything else is chains.
/// @throws Error(ErrorKind::Usage) that says what was expected where
SelectionPhrase readPhrase(const std::string& text);

} // namespace molsurf
