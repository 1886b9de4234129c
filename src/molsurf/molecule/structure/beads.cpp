// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/beads.h"

#include <gemmi/resinfo.hpp>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>

namespace molsurf
{
namespace
{

using std::string_view;

bool isOneOf(string_view name, std::initializer_list<string_view> names)
{
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// A word and one digit: SC1.
bool isNumbered(string_view name, string_view word)
{
    return name.size() == word.size() + 1 && name.substr(0, word.size()) == word &&
           name.back() >= '0' && name.back() <= '9';
}

bool isWaterBead(string_view name)
{
    return isOneOf(name, {"W", "WF", "SW", "TW", "PW"});
}

/// Charges beside the beads of polarizable Martini: of amino acids and of water, and those of
/// HADDOCK. They have no size.
bool isDummyCharge(string_view name)
{
    return isOneOf(name, {"SCP", "SCN", "WP", "WM"}) || isNumbered(name, "SCD");
}

/// Names of beads that no atom has.
bool isCertainBead(string_view name)
{
    return name == "BB" || name == "PO4" || isNumbered(name, "BB") || isNumbered(name, "SC") ||
           isNumbered(name, "GL") || isWaterBead(name);
}

/// C1A, D2B, T1A: beads of lipid tails.
bool isTailBead(string_view name)
{
    return name.size() == 3 && isOneOf(name.substr(0, 1), {"C", "D", "T"}) && name[1] >= '1' &&
           name[1] <= '9' && name[2] >= 'A' && name[2] <= 'F';
}

bool isBead(string_view name)
{
    return isCertainBead(name) || isTailBead(name) || isNumbered(name, "R") ||
           isNumbered(name, "AM") || isNumbered(name, "C") || isNumbered(name, "P") ||
           isOneOf(name, {"NC3", "NH3", "CNO", "ROH", "COH", "COO", "NA", "NA+", "CL", "CL-", "CA",
                          "CA+", "ION"});
}

/// The atoms of the first model, residue by residue.
std::map<std::int32_t, std::vector<const Atom*>> residuesOf(const Structure& structure)
{
    std::map<std::int32_t, std::vector<const Atom*>> out;
    const Model& model = structure.models.front();
    for (std::size_t i = model.begin; i < model.end; ++i) {
        out[structure.atoms[i].residue].push_back(&structure.atoms[i]);
    }
    return out;
}

bool has(const std::vector<const Atom*>& atoms, string_view name)
{
    return std::any_of(atoms.begin(), atoms.end(), [&](const Atom* a) { return a->name == name; });
}

/// The sites of a Go model lie where the beads of the backbone lie, and have no size. (Proteins
/// have one for each BB, by the name CA.)
bool isGoSite(const Atom& atom, const std::vector<const Atom*>& residue)
{
    constexpr double same = 0.1; // [Å]
    if (isCertainBead(atom.name)) return false;
    return std::any_of(residue.begin(), residue.end(), [&](const Atom* other) {
        return other->name.substr(0, 2) == "BB" &&
               (other->position - atom.position).length() < same;
    });
}

/// The particles of a file of beads that are none.
std::vector<std::size_t> extrasOf(const Structure& structure)
{
    const auto residues = residuesOf(structure);
    std::vector<std::size_t> out;
    const Model& model = structure.models.front();
    for (std::size_t i = model.begin; i < model.end; ++i) {
        const Atom& atom = structure.atoms[i];
        if (isDummyCharge(atom.name) || isGoSite(atom, residues.at(atom.residue))) out.push_back(i);
    }
    return out;
}

bool isMartini(const Structure& structure)
{
    const Model& model = structure.models.front();
    std::unordered_map<string_view, std::size_t> names;
    for (std::size_t i = model.begin; i < model.end; ++i) ++names[structure.atoms[i].name];
    std::size_t beads = 0, certain = 0;
    for (const auto& [name, count] : names) {
        if (isBead(name) || isDummyCharge(name)) beads += count;
        if (isCertainBead(name)) certain += count;
    }
    if (certain == 0) return false;
    const std::size_t atoms = model.end - model.begin;
    if (10 * beads >= 9 * atoms) return true;
    return 10 * (2 * beads) >= 9 * atoms && 10 * (beads + extrasOf(structure).size()) >= 9 * atoms;
}

bool isMartini2(const Structure& structure)
{
    struct Last {
        string_view residue, bead; // of Martini 3
    };
    constexpr std::array<Last, 3> lasts{{{"ALA", "SC1"}, {"TYR", "SC4"}, {"TRP", "SC5"}}};
    for (const auto& [index, atoms] : residuesOf(structure)) {
        const std::string& name = structure.residues[std::size_t(index)].name;
        for (const Last& last : lasts) {
            if (name == last.residue) return !has(atoms, last.bead);
        }
    }
    return false;
}

bool isUnnamed(const Structure& structure)
{
    constexpr double longestBond = 1.9;      // [Å], of heavy atoms in amino acids: C-S 1.8
    constexpr std::size_t shortestTrace = 4; // fewer CA alone may be a part of anything
    const Model& model = structure.models.front();
    std::size_t waters = 0;
    for (std::size_t i = model.begin; i < model.end; ++i) {
        const Atom& atom = structure.atoms[i];
        if (residueOf(structure, atom).water())
            ++waters;
        else if (atom.name == "N" || atom.name == "C")
            return false;
    }
    if (waters == model.end - model.begin) return false;
    bool sideChain = false;
    std::size_t residues = 0;
    for (const auto& [index, atoms] : residuesOf(structure)) {
        const Residue& residue = structure.residues[std::size_t(index)];
        if (residue.water()) continue;
        if (!gemmi::find_tabulated_residue(residue.name).is_amino_acid() || !has(atoms, "CA"))
            return false;
        ++residues;
        sideChain = sideChain || atoms.size() > 1;
        for (const Atom* a : atoms) {
            for (const Atom* b : atoms) {
                if (a < b && (a->position - b->position).length() < longestBond) return false;
            }
        }
    }
    return sideChain || residues >= shortestTrace;
}

/// The kind of the atoms of a structure, by the criteria of markBeads().
BeadKind findBeads(const Structure& structure)
{
    if (structure.models.empty()) return BeadKind::None;
    if (isMartini(structure)) {
        return isMartini2(structure) ? BeadKind::Martini2 : BeadKind::Martini3;
    }
    return isUnnamed(structure) ? BeadKind::Unnamed : BeadKind::None;
}

} // namespace

void markBeads(Structure& structure)
{
    structure.beads = findBeads(structure);
    if (structure.beads != BeadKind::Martini2 && structure.beads != BeadKind::Martini3) return;
    const std::vector<std::size_t> extras = extrasOf(structure);
    const std::size_t first = structure.models.front().begin;
    for (const Model& model : structure.models)
        for (const std::size_t i : extras)
            if (model.begin + i - first < model.end)
                structure.atoms[model.begin + i - first].role = AtomRole::Particle;
    for (Atom& atom : structure.atoms) {
        atom.element = 0;
        if (!isWaterBead(atom.name)) continue;
        Residue& residue = structure.residues[std::size_t(atom.residue)];
        residue.kind = ResidueKind::Water;
    }
}

} // namespace molsurf
