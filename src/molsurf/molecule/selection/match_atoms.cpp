// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/match_atoms.h"
#include "molsurf/molecule/selection/pore_way.h"

#include "molsurf/error.h"
#include "molsurf/molecule/selection/parse_selection.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <algorithm>
#include <memory>

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
    const auto settled = structure.settled.find(expression);
    if (settled != structure.settled.end()) return *settled->second;
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

void resolveSelections(const SelectOptions& options, const Model& model, Structure& structure)
{
    std::vector<std::string> expressions{options.select, options.pocketAt,
                                         tunnelSelection(options.tunnelsFrom)};
    for (const std::string& end : poreSelections(options.pore)) expressions.push_back(end);
    for (const GroupRule& rule : options.groups) expressions.push_back(rule.select);
    for (const ResolutionRule& rule : options.resolutions) expressions.push_back(rule.select);
    for (const CoarseRule& rule : options.coarse) expressions.push_back(rule.select);
    for (const std::string& expression : expressions) {
        if (expression.empty()) continue;
        AtomMatch match;
        try {
            match = matchAtoms(structure, expression);
        } catch (const Error&) { // selectBalls() gives it, with what the selection is for
            continue;
        }
        if (match.byPlace) {
            const auto first = match.atoms.begin() + std::ptrdiff_t(model.begin);
            const std::size_t size = model.end - model.begin;
            for (const Model& other : structure.models)
                if (other.begin != model.begin && other.end - other.begin == size)
                    std::copy(first, first + std::ptrdiff_t(size),
                              match.atoms.begin() + std::ptrdiff_t(other.begin));
            match.models = {0};
            match.warnings.clear();
        }
        structure.settled[expression] = std::make_shared<const AtomMatch>(std::move(match));
    }
}

void forgetPlaces(Structure& structure)
{
    for (auto one = structure.settled.begin(); one != structure.settled.end();)
        one = one->second->byPlace ? structure.settled.erase(one) : std::next(one);
}

} // namespace molsurf
