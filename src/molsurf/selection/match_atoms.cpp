// SPDX-License-Identifier: MPL-2.0
#include "molsurf/selection/match_atoms.h"

#include "molsurf/error.h"
#include "molsurf/selection/selection_syntax.h"
#include "molsurf/structure/text_fields.h"

#include <algorithm>

namespace molsurf
{
namespace
{

bool matches(const SelectionPattern& selection, const Residue& residue, const Structure& structure)
{
    return selection.chains.has(structure.chains[std::size_t(residue.chain)]) &&
           (selection.kinds >> unsigned(residue.kind) & 1u) != 0 &&
           selection.residues.has(residue.name) && selection.from.compare(residue) <= 0 &&
           selection.to.compare(residue) >= 0;
}

bool matches(const SelectionPattern& selection, const Atom& atom)
{
    const auto holds = [&](const SelectionPattern::Inequality& bound) {
        const double value = bound.property == 'q' ? atom.occupancy : atom.bFactor;
        return bound.relation == '<'   ? value < bound.value
               : bound.relation == '>' ? value > bound.value
                                       : value == bound.value;
    };
    const bool element = selection.elements.empty() || selection.elements[atom.element];
    return element && selection.atoms.has(atom.name) &&
           selection.altlocs.has(std::string(atom.altloc ? 1 : 0, atom.altloc)) &&
           std::all_of(selection.inequalities.begin(), selection.inequalities.end(), holds);
}

/// Marks the atoms of one alternative; returns how many it matches.
std::size_t mark(const SelectionPattern& selection, const Structure& structure,
                 std::vector<char>& atoms)
{
    std::vector<char> residues(structure.residues.size());
    std::transform(structure.residues.begin(), structure.residues.end(), residues.begin(),
                   [&](const Residue& residue) {
                       return static_cast<char>(matches(selection, residue, structure));
                   });
    std::size_t count = 0;
    for (const Model& model : structure.models) {
        if (selection.model != 0 && selection.model != model.number) continue;
        for (std::size_t i = model.begin; i < model.end; ++i) {
            const Atom& atom = structure.atoms[i];
            if (!residues[std::size_t(atom.residue)]) continue;
            if (!matches(selection, atom)) continue;
            atoms[i] = 1;
            ++count;
        }
    }
    return count;
}

std::string chainHint(const Structure& structure)
{
    constexpr std::size_t longest = 8;
    std::string hint = " [the chains are";
    for (std::size_t i = 0; i < std::min(longest, structure.chains.size()); ++i) {
        const std::string& name = structure.chains[i];
        hint += (i ? ", " : " ") + (name.empty() ? "(blank)" : name);
    }
    if (structure.chains.size() > longest) hint += ", ...";
    return hint + "; syntax: A for a chain, A/53-132 for residues, (HEM) for a residue name, A//CA "
                  "for an atom, *;polymer]";
}

} // namespace

AtomMatch matchAtoms(const Structure& structure, const std::string& expression)
{
    AtomMatch match;
    match.atoms.resize(structure.atoms.size());
    std::size_t matched = 0;
    for (std::size_t begin = 0; begin <= expression.size();) {
        const std::size_t end = std::min(expression.find('|', begin), expression.size());
        const std::string text(trimmed(std::string_view(expression).substr(begin, end - begin)));
        begin = end + 1;
        if (text.empty()) {
            throw Error(ErrorKind::Usage, "selection " + inQuotes(expression) +
                                              ": expected an expression, got nothing" +
                                              (expression.empty() ? "" : " beside a |"));
        }
        const SelectionPattern selection = parseSelection(text);
        const std::size_t count = mark(selection, structure, match.atoms);
        match.models.push_back(selection.model);
        matched += count;
        if (count == 0)
            match.warnings.push_back("selection " + inQuotes(text) + " matches no atom");
    }
    if (matched == 0) {
        throw Error(ErrorKind::Input, structure.source + ": selection " + inQuotes(expression) +
                                          " matches no atom" + chainHint(structure));
    }
    return match;
}

} // namespace molsurf
