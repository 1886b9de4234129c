// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A phrase of gemmi's in a selection: /model/chains/residues/atoms;properties.

#include "molsurf/structure/structure.h"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace molsurf
{

/// Names that are selected, or with a '!' before them all others.
struct NamePattern {
    bool all = true, inverted = false;
    std::vector<std::string> names;

    bool has(const std::string& name) const;
};

/// A number of a residue with its insertion code.
struct SequenceBound {
    int number;
    char insertionCode; ///< '*': any

    /// < 0, 0 or > 0 if the bound lies before, at or behind a residue.
    int compare(const Residue& residue) const;
};

/// A phrase.
struct SelectionPattern {
    /// "b<20": a comparison of occupancy ('q') or B factor ('b').
    struct Inequality {
        char property;
        char relation; ///< '<', '=' or '>'
        double value;
    };

    int model = 0; ///< 0: any
    NamePattern chains, residues, atoms, altlocs;
    SequenceBound from{std::numeric_limits<int>::min(), '*'};
    SequenceBound to{std::numeric_limits<int>::max(), '*'};
    std::vector<char> elements; ///< one an atomic number: 1 if selected; empty: any
    std::uint32_t kinds = ~0u;  ///< bit k: residues of the ResidueKind k
    std::vector<Inequality> inequalities;
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
SelectionPattern readPhrase(const std::string& text);

} // namespace molsurf
