// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Reads selections in the words of PyMOL, VMD and MDAnalysis.

#include "molsurf/selection/selection_tree.h"

#include <string>
#include <vector>

namespace molsurf
{

/// A selection in words.
struct WordSelection {
    /// One of what stands between `or` outside of brackets.
    struct Alternative {
        SubTree tree;
        std::string text;
    };
    std::vector<Alternative> alternatives;
    std::vector<int> models; ///< that phrases in gemmi's syntax name; 0: any
    /// Where brackets would help: one line each, for a phrase that programs read in two ways.
    std::vector<std::string> notes;
};

/// Reads an expression of this grammar, its words in any case:
///
///     expression:  [byres | bychain | same PROPERTY as] expression
///                  either { around D | expand D | (within | exwithin | beyond) D of either }
///     either:      both { or both }
///     both:        operand { and operand }
///     operand:     not operand | ( expression ) | (within | exwithin | beyond | around) D [of]
///                  expression | CLASS | PROPERTY values | PROPERTY < number | a phrase of gemmi's
///
/// docs/selections.md has the words. A phrase of gemmi's is what parseSelection() reads; a name
/// alone is one if the structure has a chain of that name.
///
/// @throws Error(ErrorKind::Usage) with the place, what was expected there and the nearest word
WordSelection parseWords(const std::string& text, const Structure& structure);

/// Whether a text has one of the words, between blanks, brackets and signs.
bool hasWords(const std::string& text);

/// " [hint: ...]" on what an unknown word may stand for: a word near to it, or a name of the
/// structure; empty if there is nothing.
std::string hintOn(const std::string& word, const Structure& structure);

} // namespace molsurf
