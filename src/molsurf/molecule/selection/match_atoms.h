// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Selections of atoms by an expression.

#include "molsurf/atoms.h"
#include "molsurf/molecule/structure/structure.h"

#include <cstdint>
#include <map>
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
    bool byPlace = false;              ///< whether they change when atoms move
};

/// Evaluates an expression of parseSelection(). All models are searched.
///
/// @throws Error(ErrorKind::Usage) if the expression does not parse
/// @throws Error(ErrorKind::Input) if it matches no atom
AtomMatch matchAtoms(const Structure& structure, const std::string& expression);

/// The selections of a structure: matched when they are asked for, or kept from an earlier place of
/// its atoms. A structure alone keeps none.
class Selections
{
public:
    /// @param[in] structure  has to outlive it
    Selections(const Structure& structure) : structure_(structure) {}

    const Structure& structure() const { return structure_; }

    /// Evaluates an expression, or gives what was kept of it.
    /// @throws Error as matchAtoms()
    AtomMatch match(const std::string& expression) const;

    /// Matches expressions once for all frames. Those that ask for places keep their atoms when
    /// these move: models with as many atoms as a given one have its atoms, by their order.
    void keep(const std::vector<std::string>& expressions, const Model& model);

    /// Lets those that ask for places be matched anew.
    void forgetPlaces();

    /// For each atom the last of some rules whose selection has it, or -1; an empty one has all.
    template<typename Rule>
    std::vector<std::int32_t> lastRules(const std::vector<Rule>& rules,
                                        std::vector<std::string>& warnings) const
    {
        std::vector<std::int32_t> out(structure_.atoms.size(), -1);
        for (std::size_t r = 0; r < rules.size(); ++r) {
            const std::string& select = rules[r].select;
            const AtomMatch found = select.empty() ? AtomMatch() : match(select);
            for (std::size_t i = 0; i < out.size(); ++i)
                if (select.empty() || found.atoms[i]) out[i] = std::int32_t(r);
            warnings.insert(warnings.end(), found.warnings.begin(), found.warnings.end());
        }
        return out;
    }

private:
    const Structure& structure_;
    std::map<std::string, AtomMatch> kept_; ///< by expression
};

} // namespace molsurf
