// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A selection as a tree, and the atoms that it holds for.

#include "molsurf/selection/selection_phrase.h"
#include "molsurf/selection/selection_words.h"

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

/// From a number to another; of residues with their insertion codes.
struct NumberRange {
    SequenceBound from, to;
};

struct ClassTest {
    const ClassWord* word;
};
struct NameTest {
    const PropertyWord* property;
    std::vector<NameGlob> names;
};
struct RangeTest {
    const PropertyWord* property;
    std::vector<NumberRange> ranges;
};
struct NumberTest {
    const PropertyWord* property;
    std::string relation; ///< "<", "<=", ">", ">=", "=", "==" or "!="
    double value;
};
/// A phrase of gemmi's.
struct PatternTest {
    SelectionPattern pattern;
};
struct AllOf {
    std::vector<SubTree> parts;
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
    std::variant<ClassTest, NameTest, RangeTest, NumberTest, PatternTest, AllOf, AnyOf, NotOf,
                 SameAs, NearTo>
        node;
};

/// The atoms that a selection holds for.
/// @throws Error(ErrorKind::Input) if distances are asked for and an atom lies farther than 1e6 Å
/// from the origin
AtomMask atomsOf(const SelectionTree& tree, const SelectionFacts& facts);

/// Whether a selection depends on where atoms lie.
bool asksForPlaces(const SelectionTree& tree);

/// Names in lists that no atom has: one line each.
std::vector<std::string> unknownNames(const SelectionTree& tree, const Structure& structure);

} // namespace molsurf
