// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/superpose.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/selection/match_atoms.h"
#include "molsurf/molecule/structure/assembly_operators.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <algorithm>
#include <optional>
#include <set>

namespace molsurf
{

namespace
{

using openvdb::Vec3d;

/// One atom stands for each residue of a chain.
bool standsForResidue(const Residue& residue, const Atom& atom)
{
    constexpr std::uint8_t carbon = 6;
    return residue.polymer() && (atom.element == carbon || residue.kind == ResidueKind::Bead) &&
           (atom.name == "CA" || atom.name == "C4'" || atom.name == "C4*" || atom.name == "BB");
}

const Model& modelOf(const Structure& structure, int number)
{
    const auto found = std::find_if(structure.models.begin(), structure.models.end(),
                                    [=](const Model& m) { return m.number == number; });
    return found == structure.models.end() ? structure.models.front() : *found;
}

/// The atoms of a selection; all if it is empty.
std::vector<char> chosen(const Selections& selections, const std::string& select)
{
    if (select.empty() || select == "all")
        return std::vector<char>(selections.structure().atoms.size(), 1);
    return selections.match(select).atoms;
}

/// The only chain; nullopt: there are several.
std::optional<std::string> onlyChain(const Anchors& anchors)
{
    std::set<std::string> chains;
    for (const auto& [key, place] : anchors.atoms) chains.insert(std::get<0>(key));
    if (chains.size() != 1) return std::nullopt;
    return *chains.begin();
}

/// M B M^-1 for a motion M and an operator B.
Operator movedOperator(const Superposition& motion, const Operator& op)
{
    return {motion.after(op).after(motion.inverse()), op.name};
}

} // namespace

std::vector<char> anchorAtoms(const Selections& selections, const AnchorRule& rule)
{
    const Structure& structure = selections.structure();
    std::vector<char> taken = chosen(selections, rule.among);
    if (rule.byResidue()) {
        for (std::size_t i = 0; i < taken.size(); ++i) {
            const Atom& atom = structure.atoms[i];
            taken[i] &= char(standsForResidue(residueOf(structure, atom), atom));
        }
    } else {
        const std::vector<char> anchors = chosen(selections, rule.anchors);
        for (std::size_t i = 0; i < taken.size(); ++i) taken[i] &= anchors[i];
    }
    return taken;
}

Anchors anchorsOf(const Structure& structure, const AnchorRule& rule, int number)
{
    return anchorsOf(structure, rule, anchorAtoms(structure, rule), number);
}

Anchors anchorsOf(const Structure& structure, const AnchorRule& rule,
                  const std::vector<char>& taken, int number)
{
    Anchors found{structure.source, {}};
    std::map<AtomKey, float> occupancies;
    const Model& model = modelOf(structure, number);
    for (std::size_t i = model.begin; i < model.end; ++i) {
        const Atom& atom = structure.atoms[i];
        const Residue& residue = residueOf(structure, atom);
        if (!taken[i] || atom.role != AtomRole::Atom) continue;
        const AtomKey key{structure.chains[std::size_t(residue.chain)], residue.number,
                          residue.insertionCode, atom.name};
        const auto [known, isNew] = occupancies.emplace(key, atom.occupancy);
        if (!isNew && !(atom.occupancy > known->second)) continue; // another location
        known->second = atom.occupancy;
        found.atoms[key] = atom.position;
    }
    if (found.atoms.empty())
        throw Error(ErrorKind::Input,
                    structure.source +
                        (rule.byResidue()
                             ? ": `superpose` auto: there is no CA or C4'"
                             : ": `superpose`: no atom of " + inQuotes(rule.anchors) + " is used"));
    return found;
}

Superposition superpositionOf(const Anchors& moving, const Anchors& fixed)
{
    const std::optional<std::string> one = onlyChain(moving), other = onlyChain(fixed);
    std::vector<Vec3d> points, onto;
    for (const auto& [key, place] : moving.atoms) {
        AtomKey wanted = key;
        if (one && other) std::get<0>(wanted) = *other;
        const auto found = fixed.atoms.find(wanted);
        if (found == fixed.atoms.end()) continue;
        points.push_back(place);
        onto.push_back(found->second);
    }
    const std::optional<Superposition> motion = superposition(points, onto);
    if (motion) return *motion;
    throw Error(
        ErrorKind::Input,
        "`superpose`: expected at least three atoms of the same chain, number and name in " +
            moving.source + " and " + fixed.source + ", not on one line, got " +
            std::to_string(points.size()) +
            (one && other ? "" : " [hint: `select` takes one chain of each]"));
}

void moveBy(const Superposition& motion, const Model& model, Structure& structure)
{
    for (std::size_t i = model.begin; i < model.end; ++i)
        structure.atoms[i].position = motion.placed(structure.atoms[i].position);
}

void moveBy(const Superposition& motion, Structure& structure)
{
    for (Atom& atom : structure.atoms) atom.position = motion.placed(atom.position);
    structure.assemblies = moved(motion, std::move(structure.assemblies));
}

std::vector<Assembly> moved(const Superposition& motion, std::vector<Assembly> assemblies)
{
    for (Assembly& assembly : assemblies)
        for (AssemblyPart& part : assembly.parts)
            for (Operator& op : part.operators) op = movedOperator(motion, op);
    return assemblies;
}

std::string describe(const Superposition& motion)
{
    return "superposed by " + counted(motion.pairs, "atom", "atoms") +
           formatted(", rmsd %.3f Å", motion.rmsd);
}

} // namespace molsurf
