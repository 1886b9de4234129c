// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Selections of atoms by an expression.

#include "molsurf/atoms.h"
#include "molsurf/structure/structure.h"

#include <string>
#include <vector>

namespace molsurf
{

/// The atoms that an expression selects.
struct AtomMatch {
    std::vector<char> atoms;           ///< 1 if selected, by index in Structure::atoms
    std::vector<int> models;           ///< model number of each alternative; 0: any
    std::vector<std::string> warnings; ///< alternatives that match nothing, while others do
};

/// Evaluates an expression in one of two languages. That of parseSelection(), alternatives joined
/// by '|', goes first; there chains are named as in Structure::chains, [H] selects deuterium too,
/// and [D] nothing. What it does not read, or reads and finds nothing, is one of parseWords() if
/// that reads it. All models are searched.
///
/// @throws Error(ErrorKind::Usage) if the expression does not parse
/// @throws Error(ErrorKind::Input) if it matches no atom
AtomMatch matchAtoms(const Structure& structure, const std::string& expression);

/// Makes matchAtoms() give the same atoms for the selections of some options when the atoms move.
/// Models with as many atoms as a given one have its atoms, by their order.
void resolveSelections(const SelectOptions& options, const Model& model, Structure& structure);

} // namespace molsurf
