// SPDX-License-Identifier: MPL-2.0
#include "molsurf/selection/match_atoms.h"

#include "molsurf/error.h"
#include "molsurf/structure/text_fields.h"

#define USE_STD_SNPRINTF // or gemmi asks for stb_sprintf, with a compiler warning
#include <gemmi/select.hpp>

#include <algorithm>
#include <climits>
#include <exception>

namespace molsurf
{
namespace
{

using gemmi::Selection;

gemmi::EntityType entityType(const Residue& residue)
{
    if (residue.water) return gemmi::EntityType::Water;
    return residue.hetero ? gemmi::EntityType::NonPolymer : gemmi::EntityType::Polymer;
}

/// The same as gemmi's compare(), which works on gemmi's own tree only.
int compareNumber(const Selection::SequenceId& bound, const Residue& residue)
{
    if (bound.seqnum != residue.number) return bound.seqnum < residue.number ? -1 : 1;
    if (bound.icode == '*' || bound.icode == residue.insertionCode) return 0;
    return bound.icode < residue.insertionCode ? -1 : 1;
}

bool matches(const Selection& selection, const Residue& residue, const Structure& structure)
{
    return selection.chain_ids.has(structure.chains[std::size_t(residue.chain)]) &&
           (selection.entity_types.all || selection.et_flags[std::size_t(entityType(residue))]) &&
           selection.residue_names.has(residue.name) &&
           compareNumber(selection.from_seqid, residue) <= 0 &&
           compareNumber(selection.to_seqid, residue) >= 0;
}

bool matches(const Selection& selection, const Atom& atom)
{
    auto holds = [&](const Selection::AtomInequality& bound) {
        const double value = bound.property == 'q' ? atom.occupancy : atom.bFactor;
        return bound.relation < 0   ? value < bound.value
               : bound.relation > 0 ? value > bound.value
                                    : value == bound.value;
    };
    const bool element = selection.elements.empty() || selection.elements[atom.element];
    return element && selection.atom_names.has(atom.name) &&
           (selection.altlocs.all ||
            selection.altlocs.has(std::string(atom.altloc ? 1 : 0, atom.altloc))) &&
           std::all_of(selection.atom_inequalities.begin(), selection.atom_inequalities.end(),
                       holds);
}

/// Marks the atoms of one alternative; returns how many it matches.
std::size_t mark(const Selection& selection, const Structure& structure, std::vector<char>& atoms)
{
    std::vector<char> residues(structure.residues.size());
    std::transform(structure.residues.begin(), structure.residues.end(), residues.begin(),
                   [&](const Residue& residue) {
                       return static_cast<char>(matches(selection, residue, structure));
                   });
    std::size_t count = 0;
    for (const Model& model : structure.models) {
        if (selection.mdl != 0 && selection.mdl != model.number) continue;
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

/// A lone number is one residue; gemmi 0.5.7 takes it for the first of all that follow.
Selection parse(const std::string& text)
{
    try {
        Selection selection(text);
        const bool open = selection.to_seqid.seqnum == INT_MAX && selection.to_seqid.icode == '*';
        const auto has = [&](const char* end) { return text.find(end) != std::string::npos; };
        if (open && !selection.from_seqid.empty() && !has("-*") && !has("-.*"))
            selection.to_seqid = selection.from_seqid;
        return selection;
    } catch (const std::exception& error) {
        throw Error(ErrorKind::Usage, "selection " + inQuotes(text) +
                                          ": expected gemmi's syntax, for example /1/A/53-132 or "
                                          "*;polymer, got: " +
                                          error.what());
    }
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
        const Selection selection = parse(text);
        const std::size_t count = mark(selection, structure, match.atoms);
        match.models.push_back(selection.mdl);
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
