// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The grammar of selections: words of PyMOL, VMD and MDAnalysis, and phrases of gemmi's.

#include "molsurf/molecule/selection/selection_tree.h"

#include <string>
#include <vector>

namespace molsurf
{

/// A selection that is read.
struct Selection {
    /// One of what stands between `or` outside of brackets.
    struct Alternative {
        SubTree tree;
        std::string text;
    };
    std::vector<Alternative> alternatives;
    std::vector<int> models; ///< that phrases of gemmi's name; 0: any
    /// Where brackets would help: one line each, for a phrase that programs read in two ways.
    std::vector<std::string> notes;
    std::string hint; ///< on a name alone that is no chain, " [hint: resname LIG]"; may be empty
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
/// docs/selections.md has the words. A phrase of gemmi's is what readPhrase() reads, up to a blank.
/// It is one by its shape: it has one of / [ ( ; : , * and quotes, begins with a digit or a sign,
/// or is the name of a chain. A name alone that is none stands for a chain that the file lacks,
/// where nothing but | is beside it.
///
/// @throws Error(ErrorKind::Usage) with the place, what was expected there, and the nearest word,
/// or what to write for a word of another program
Selection parseSelection(const std::string& text, const Structure& structure);

} // namespace molsurf
