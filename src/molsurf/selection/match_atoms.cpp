// SPDX-License-Identifier: MPL-2.0
#include "molsurf/selection/match_atoms.h"
#include "molsurf/selection/pore_way.h"

#include "molsurf/error.h"
#include "molsurf/selection/parse_words.h"
#include "molsurf/selection/selection_syntax.h"
#include "molsurf/structure/text_fields.h"

#include <algorithm>
#include <optional>

namespace molsurf
{
namespace
{

/// An alternative in gemmi's syntax.
struct Phrase {
    std::string text;
    SelectionPattern pattern;
    std::size_t count = 0; ///< of the atoms that it matches
};

std::vector<Phrase> phrasesOf(const std::string& expression)
{
    std::vector<Phrase> out;
    for (std::size_t begin = 0; begin <= expression.size();) {
        const std::size_t end = std::min(expression.find('|', begin), expression.size());
        const std::string text(trimmed(std::string_view(expression).substr(begin, end - begin)));
        begin = end + 1;
        if (text.empty()) {
            throw Error(ErrorKind::Usage, "selection " + inQuotes(expression) +
                                              ": expected an expression, got nothing" +
                                              (expression.empty() ? "" : " beside a |"));
        }
        out.push_back({text, parseSelection(text)});
    }
    return out;
}

/// "A, B, ..." for a hint.
std::string chainNames(const Structure& structure)
{
    constexpr std::size_t longest = 8;
    std::string names;
    for (std::size_t i = 0; i < std::min(longest, structure.chains.size()); ++i) {
        const std::string& name = structure.chains[i];
        names += (i ? ", " : "") + (name.empty() ? "(blank)" : name);
    }
    return names + (structure.chains.size() > longest ? ", ..." : "");
}

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
    throw Error(ErrorKind::Input,
                structure.source + ": selection " + inQuotes(expression) + " matches no atom" +
                    (atoms ? ", the file has no chains and residues" : "") +
                    (!hint.empty() ? hint
                     : atoms ? " [hint: all, element C, name C1, index 0 to 9, within 5 of index 0]"
                             : " [the chains are " + chainNames(structure) +
                                   "; syntax: A for a chain, A/53-132 for residues, (HEM) for a "
                                   "residue name, A//CA for an atom, *;polymer, or words: chain A "
                                   "and resid 53 to 132]"));
}

/// Whether words may be meant: a name of chains has a blank that none in the file has, or the
/// phrase matches nothing.
bool mayBeWords(const Phrase& phrase, const Structure& structure)
{
    const std::vector<std::string>& names = phrase.pattern.chains.names;
    return phrase.count == 0 ||
           std::any_of(names.begin(), names.end(), [&](const std::string& name) {
               return name.find(' ') != std::string::npos &&
                      std::find(structure.chains.begin(), structure.chains.end(), name) ==
                          structure.chains.end();
           });
}

/// Whether a text is a word that stands alone.
bool isClassWord(const std::string& text)
{
    const auto word = selectionWord(text);
    return word && word->isClass && text != "*";
}

AtomMatch matchPhrases(const std::vector<Phrase>& phrases, std::vector<char> atoms)
{
    AtomMatch match;
    match.atoms = std::move(atoms);
    for (const Phrase& phrase : phrases) {
        match.models.push_back(phrase.pattern.model);
        if (phrase.count == 0)
            match.warnings.push_back("selection " + inQuotes(phrase.text) + " matches no atom");
        else if (isClassWord(phrase.text))
            match.warnings.push_back("selection " + phrase.text + " was read as the chain " +
                                     phrase.text + " [hint: (" + phrase.text + ") is the word]");
    }
    return match;
}

AtomMatch matchWords(const Structure& structure, const std::string& expression,
                     const WordSelection& words)
{
    const SelectionFacts facts(structure);
    AtomMatch match;
    match.atoms.resize(structure.atoms.size());
    match.models = words.models;
    match.models.push_back(0);
    std::size_t matched = 0;
    for (const WordSelection::Alternative& one : words.alternatives) {
        const AtomMask atoms = atomsOf(*one.tree, facts);
        const auto count = std::size_t(std::count(atoms.begin(), atoms.end(), 1));
        matched += count;
        for (std::size_t i = 0; i < atoms.size(); ++i) match.atoms[i] |= atoms[i];
        if (count == 0)
            match.warnings.push_back("selection " + inQuotes(one.text) + " matches no atom");
    }
    for (const std::string& note : words.notes) match.warnings.push_back("selection " + note);
    if (matched == 0)
        failEmpty(structure, expression, words.notes.empty() ? "" : ": " + words.notes[0]);
    return match;
}

/// Whether a selection is one in words that depends on where atoms lie.
bool asksForPlaces(const std::string& expression, const Structure& structure)
{
    try {
        const WordSelection words = parseWords(expression, structure);
        return std::any_of(words.alternatives.begin(), words.alternatives.end(),
                           [](const auto& one) { return asksForPlaces(*one.tree); });
    } catch (const Error&) {
        return false;
    }
}

} // namespace

AtomMatch matchAtoms(const Structure& structure, const std::string& expression)
{
    const auto settled = structure.settled.find(expression);
    if (settled != structure.settled.end()) return {settled->second, {0}, {}};
    std::vector<Phrase> phrases;
    std::optional<Error> refusal; // of gemmi's syntax
    try {
        phrases = phrasesOf(expression);
    } catch (const Error& e) {
        if (trimmed(expression).empty()) throw;
        refusal = e;
    }
    std::vector<char> atoms(structure.atoms.size());
    bool words = refusal.has_value(), matched = false;
    for (Phrase& phrase : phrases) {
        phrase.count = markAtoms(phrase.pattern, structure, atoms);
        matched = matched || phrase.count > 0;
        words = words || mayBeWords(phrase, structure);
    }
    const bool sure = hasWords(expression); // else it is of names, which may stand in words too
    if (words && (refusal || sure || expression.find_first_of(" &!<>=") != std::string::npos)) {
        try {
            return matchWords(structure, expression, parseWords(expression, structure));
        } catch (const Error& e) {
            if (sure || (!refusal && !matched && e.kind() == ErrorKind::Usage)) throw;
        }
    }
    if (refusal) throw *refusal;
    if (!matched) {
        const std::string hint = hintOn(expression, structure);
        // A slip of a word is no name of a chain.
        if (hint.find("did you mean") != std::string::npos) parseWords(expression, structure);
        failEmpty(structure, expression, hint);
    }
    return matchPhrases(phrases, std::move(atoms));
}

void resolveSelections(const SelectOptions& options, const Model& model, Structure& structure)
{
    std::vector<std::string> expressions{options.select, options.pocketAt};
    for (const std::string& end : poreSelections(options.pore)) expressions.push_back(end);
    for (const GroupRule& rule : options.groups) expressions.push_back(rule.select);
    for (const ResolutionRule& rule : options.resolutions) expressions.push_back(rule.select);
    for (const CoarseRule& rule : options.coarse) expressions.push_back(rule.select);
    for (const std::string& expression : expressions) {
        if (expression.empty() || !asksForPlaces(expression, structure)) continue;
        std::vector<char> atoms = matchAtoms(structure, expression).atoms;
        const auto first = atoms.begin() + std::ptrdiff_t(model.begin);
        for (const Model& other : structure.models)
            if (other.begin != model.begin && other.end - other.begin == model.end - model.begin)
                std::copy(first, first + std::ptrdiff_t(model.end - model.begin),
                          atoms.begin() + std::ptrdiff_t(other.begin));
        structure.settled[expression] = std::move(atoms);
    }
}

} // namespace molsurf
