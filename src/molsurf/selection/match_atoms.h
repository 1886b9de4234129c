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
    std::vector<int> models;           ///< that phrases name; 0: any
    std::vector<std::string> warnings; ///< alternatives and names that match nothing,
                                       ///< and where brackets decide
};

/// Evaluates an expression of parseSelection(). All models are searched.
///
/// @throws Error(ErrorKind::Usage) if the expression does not parse
/// @throws Error(ErrorKind::Input) if it matches no atom
AtomMatch matchAtoms(const Structure& structure, const std::string& expression);

/// Makes matchAtoms() give the same atoms for the selections of some options when the atoms move.
/// Models with as many atoms as a given one have its atoms, by their order.
void resolveSelections(const SelectOptions& options, const Model& model, Structure& structure);

} // namespace molsurf
