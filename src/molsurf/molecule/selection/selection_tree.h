// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A selection as a tree, and the atoms that it holds for.

#include "molsurf/molecule/selection/selection_words.h"

#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace molsurf
{

/// One char an atom of a structure: 1 if it is selected.
using AtomMask = std::vector<char>;

struct SelectionTree;
using SubTree = std::shared_ptr<const SelectionTree>;

/// A name, or a pattern in which * is any letters and ? is one.
struct NameGlob {
    std::string text;
    bool pattern = false, quoted = false;

    bool matches(std::string_view name) const;
};

/// A number of a residue with its insertion code.
struct SequenceBound {
    int number;
    char insertionCode; ///< '*': any

    /// < 0, 0 or > 0 if the bound lies before, at or behind a residue.
    int compare(const Residue& residue) const;
};

/// From a number to another; of residues with their insertion codes.
struct NumberRange {
    SequenceBound from, to;
};

/// A test of an atom, given by its index.
struct AtomTest {
    std::function<bool(const SelectionFacts& facts, std::size_t atom)> holds;
    bool place = false; ///< whether it changes when atoms move
};
struct NameTest {
    const PropertyWord* property;
    std::vector<NameGlob> names;
    bool inverted = false; ///< whether all other names are selected
};
struct AllOf {
    std::vector<SubTree> parts;
};
/// What a phrase of gemmi's asks for.
struct PhraseOf : AllOf {
};
struct AnyOf {
    std::vector<SubTree> parts;
};
struct NotOf {
    SubTree of;
};
/// Atoms that share something with some of a selection, in any model.
struct SameAs {
    const PropertyWord* property; ///< null: the residue
    SubTree of;
};
/// Atoms of a model within a distance of some of a selection.
struct NearTo {
    double distance; ///< [Å]
    bool itself;     ///< whether those of the selection are of them
    SubTree of;
};

/// A selection: a test, or an operator and what it is for.
struct SelectionTree {
    std::variant<AtomTest, NameTest, AllOf, PhraseOf, AnyOf, NotOf, SameAs, NearTo> node;
};

SubTree treeOf(decltype(SelectionTree::node) node);

/// Atoms whose number of a property is in one of some ranges.
SubTree inRanges(const PropertyWord& property, std::vector<NumberRange> ranges);

/// Atoms whose number of a property stands to another: "<", "<=", ">", ">=", "=", "==" or "!=".
SubTree compared(const PropertyWord& property, const std::string& relation, double value);

/// The atoms that a selection holds for.
/// @throws Error(ErrorKind::Input) if distances are asked for and an atom lies farther than 1e6 Å
/// from the origin
AtomMask atomsOf(const SelectionTree& tree, const SelectionFacts& facts);

/// Whether a selection depends on where atoms lie.
bool asksForPlaces(const SelectionTree& tree);

/// Names in lists that no atom has: one line each.
std::vector<std::string> unknownNames(const SelectionTree& tree, const Structure& structure);

} // namespace molsurf
