// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Selections of atoms by an expression.

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

/// Evaluates an expression of parseSelection(), alternatives joined by '|'. Chains are named as in
/// Structure::chains. [H] selects deuterium too, [D] nothing. All models are searched.
///
/// @throws Error(ErrorKind::Usage) if the expression does not parse
/// @throws Error(ErrorKind::Input) if it matches no atom
AtomMatch matchAtoms(const Structure& structure, const std::string& expression);

} // namespace molsurf
