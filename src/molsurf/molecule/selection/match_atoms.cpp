// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/match_atoms.h"

#include "molsurf/error.h"
#include "molsurf/molecule/selection/parse_selection.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace molsurf
{
namespace
{

/// Whether a file has atoms alone, as an .xyz or .sdf.
bool hasNoResidues(const Structure& structure)
{
    return structure.chains.size() == 1 && structure.chains[0].empty() &&
           std::all_of(structure.residues.begin(), structure.residues.end(),
                       [](const Residue& r) { return r.name == "UNL" || r.name.empty(); });
}

/// Refuses a selection that matches nothing, with the chains of the file.
[[noreturn]] void failEmpty(const Structure& structure, const std::string& expression,
                            const std::string& hint)
{
    const bool atoms = hasNoResidues(structure);
    std::vector<std::string> chains = structure.chains;
    std::replace(chains.begin(), chains.end(), std::string(), std::string("(blank)"));
    throw Error(ErrorKind::Input,
                structure.source + ": selection " + inQuotes(expression) + " matches no atom" +
                    (atoms ? ", the file has no chains and residues" : "") +
                    (!hint.empty() ? hint
                     : atoms ? " [hint: all, element C, name C1, index 0 to 9, within 5 of index 0]"
                             : " [the chains are " + joined(chains, 8) +
                                   "; syntax: A for a chain, A/53-132 for residues, (HEM) for a "
                                   "residue name, A//CA for an atom, *;polymer, or words: chain A "
                                   "and resid 53 to 132]"));
}

} // namespace

AtomMatch matchAtoms(const Structure& structure, const std::string& expression)
{
    const Selection selection = parseSelection(expression, structure);
    const SelectionFacts facts(structure);
    AtomMatch match;
    match.atoms.resize(structure.atoms.size());
    match.models = selection.models;
    bool matched = false;
    std::vector<std::string> notes = selection.notes;
    for (const Selection::Alternative& one : selection.alternatives) {
        const AtomMask atoms = atomsOf(*one.tree, facts);
        match.byPlace = match.byPlace || asksForPlaces(*one.tree);
        const bool some = std::find(atoms.begin(), atoms.end(), 1) != atoms.end();
        matched = matched || some;
        for (std::size_t i = 0; i < atoms.size(); ++i) match.atoms[i] |= atoms[i];
        std::vector<std::string> unknown = unknownNames(*one.tree, structure);
        if (!some && selection.alternatives.size() > 1)
            unknown = {inQuotes(one.text) + " matches no atom"};
        notes.insert(notes.end(), unknown.begin(), unknown.end());
    }
    if (!matched) {
        const auto hinted = std::find_if(notes.begin(), notes.end(), [](const std::string& note) {
            return note.find("hint: ") != std::string::npos;
        });
        const std::string note = hinted == notes.end() ? "" : ": " + *hinted;
        failEmpty(structure, expression, selection.hint.empty() ? note : selection.hint);
    }
    for (const std::string& note : notes) match.warnings.push_back("selection " + note);
    return match;
}

AtomMatch Selections::match(const std::string& expression) const
{
    const auto known = kept_.find(expression);
    return known != kept_.end() ? known->second : matchAtoms(structure_, expression);
}

void Selections::keep(const std::vector<std::string>& expressions, const Model& model)
{
    for (const std::string& expression : expressions) {
        if (expression.empty()) continue;
        AtomMatch found;
        try {
            found = match(expression);
        } catch (const Error&) { // selectBalls() gives it, with what the selection is for
            continue;
        }
        if (found.byPlace) {
            const auto first = found.atoms.begin() + std::ptrdiff_t(model.begin);
            const std::size_t size = model.end - model.begin;
            for (const Model& other : structure_.models)
                if (other.begin != model.begin && other.end - other.begin == size)
                    std::copy(first, first + std::ptrdiff_t(size),
                              found.atoms.begin() + std::ptrdiff_t(other.begin));
            found.models = {0};
            found.warnings.clear();
        }
        kept_[expression] = std::move(found);
    }
}

void Selections::forgetPlaces()
{
    for (auto one = kept_.begin(); one != kept_.end();)
        one = one->second.byPlace ? kept_.erase(one) : std::next(one);
}

} // namespace molsurf
