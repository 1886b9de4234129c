// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/describe_structure.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/printable.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/selection/choose_copies.h"
#include "molsurf/molecule/selection/residue_roles.h"
#include "molsurf/molecule/selection/select_balls.h"
#include "molsurf/molecule/structure/read_structure.h"
#include "molsurf/molecule/structure/residue_kind.h"
#include "molsurf/molecule/structure/symmetry.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

namespace molsurf
{

namespace
{

/// Atoms of the first model that a part of an assembly copies, and the centre of those that are no
/// water.
struct PartAtoms {
    std::size_t count = 0;
    openvdb::Vec3d centroid{0.0};
};

PartAtoms atomsOf(const Structure& structure, const AssemblyPart& part)
{
    const std::set<std::string> names(part.chains.begin(), part.chains.end());
    PartAtoms atoms;
    std::size_t dry = 0;
    for (std::size_t i = structure.models[0].begin; i < structure.models[0].end; ++i) {
        const Atom& atom = structure.atoms[i];
        const Residue& residue = residueOf(structure, atom);
        if (!names.empty() && !names.count(structure.asyms[std::size_t(residue.asym)])) continue;
        ++atoms.count;
        if (residue.water()) continue;
        atoms.centroid += atom.position;
        ++dry;
    }
    if (dry > 0) atoms.centroid /= double(dry);
    return atoms;
}

std::string vectorText(const openvdb::Vec3d& v, int decimals)
{
    const double unit = std::pow(10.0, -decimals);
    std::string all;
    for (int i = 0; i < 3; ++i) {
        const double shown = std::abs(v[i]) < 0.5 * unit ? 0.0 : v[i]; // no "-0.00"
        all += (i ? ", " : "(") + formatted("%.*f", decimals, shown);
    }
    return all + ")";
}

/// "1-60", "1, 7, 23": ascending numbers, counted from 1.
std::string ranges(const std::vector<std::size_t>& indices)
{
    std::vector<std::string> words;
    for (std::size_t i = 0; i < indices.size();) {
        std::size_t j = i;
        while (j + 1 < indices.size() && indices[j + 1] == indices[j] + 1) ++j;
        words.push_back(std::to_string(indices[i] + 1));
        if (j > i) words.back() += "-" + std::to_string(indices[j] + 1);
        i = j + 1;
    }
    return joined(words);
}

/// The names of chains; "_" for one without, as in tables.
std::string namesOf(const Structure& structure, const std::set<std::int32_t>& chains)
{
    std::vector<std::string> names;
    for (const std::int32_t chain : chains) {
        const std::string& name = structure.chains[std::size_t(chain)];
        names.push_back(name.empty() ? "_" : name);
    }
    return joined(names);
}

/// The chains of a part, by the names that the list of all has.
std::string authorsNames(const Structure& structure, const AssemblyPart& part)
{
    const std::set<std::string> listed(part.chains.begin(), part.chains.end());
    std::set<std::int32_t> chains;
    for (const Residue& residue : structure.residues)
        if (listed.empty() || listed.count(structure.asyms[std::size_t(residue.asym)]) > 0)
            chains.insert(residue.chain);
    return namesOf(structure, chains);
}

std::string describe(const Structure& structure, const Assembly& assembly)
{
    std::string out = infoTitle("  assembly " + assembly.name);
    if (!assembly.problem.empty()) return out + infoLine("problem", assembly.problem);
    std::size_t atoms = 0;
    std::vector<openvdb::Vec3d> centroids;
    for (const AssemblyPart& part : assembly.parts) {
        const PartAtoms of = atomsOf(structure, part);
        atoms += of.count * part.operators.size();
        if (of.count > 0) centroids.push_back(of.centroid);
        out += infoLine("copies", std::to_string(part.operators.size()) + " of chains " +
                                      authorsNames(structure, part));
    }
    out += infoLine("atoms", std::to_string(atoms));
    const std::vector<Operator> operators = operatorsOf(assembly);
    if (operators.empty() || centroids.empty()) return out;
    Symmetry symmetry;
    try {
        symmetry = findSymmetry(assembly, centroids[0]);
    } catch (const Error& error) {
        return out + infoLine("problem", error.what());
    }
    out += infoLine("point group", symmetry.pointGroup.empty() ? "not one of C, D, T, O and I"
                                                               : symmetry.pointGroup);
    out += infoLine("symmetry", describeSymmetry(symmetry));
    if (symmetry.axes.empty()) return out;
    out += infoLine("centre", vectorText(symmetry.centre, 2) + " Å");
    const openvdb::Vec3d home = operators[0].placed(centroids[0]);
    std::set<int> folds;
    for (const RotationAxis& axis : symmetry.axes) folds.insert(-axis.fold);
    for (const int fold : folds) {
        const RotationAxis& axis = *nearestAxis(symmetry, -fold, home);
        CopyChoice choice;
        choice.fold = -fold;
        out += infoLine(("fold:" + std::to_string(-fold)).c_str(),
                        "axis " + vectorText(axis.direction, 4) + ", copies " +
                            ranges(chooseCopies(structure, assembly, choice, centroids[0])));
    }
    return out;
}

/// Counts of one line of the table of residues.
struct KindCount {
    std::size_t atoms = 0;
    std::set<std::int32_t> residues;
    std::map<std::string, std::size_t> names; ///< atoms by the name of their residue
};

/// The line of a table that an atom counts in.
std::string kindOf(const Structure& structure, const Atom& atom, const std::vector<Role>& roles,
                   bool polymer)
{
    const Residue& residue = residueOf(structure, atom);
    if (residue.name == "DUM" || atom.name == "DUM") return "dummy";
    if (atom.role == AtomRole::Particle) return std::string(kindWord(ResidueKind::Particle));
    if (atom.role == AtomRole::CoarserScale) return "coarser scale";
    const bool free = roles[std::size_t(atom.residue)] == Role::FreeIon;
    if (residue.kind == ResidueKind::Ion && polymer) return free ? "free ion" : "bound ion";
    return std::string(kindWord(residue.kind));
}

/// A line for each kind of residues: atoms, residues, and their names.
std::string describeKinds(const Structure& structure, const Model& model)
{
    constexpr const char* order[] = {"protein", "nucleic",   "modified", "bead",          "sugar",
                                     "ligand",  "bound ion", "free ion", "ion",           "buffer",
                                     "lipid",   "water",     "particle", "coarser scale", "dummy"};
    const std::vector<Role> roles = rolesIn(structure, model);
    const bool polymer =
        std::any_of(structure.atoms.begin() + std::ptrdiff_t(model.begin),
                    structure.atoms.begin() + std::ptrdiff_t(model.end),
                    [&](const Atom& atom) { return residueOf(structure, atom).polymer(); });
    std::map<std::string, KindCount> counts;
    for (std::size_t i = model.begin; i < model.end; ++i) {
        const Atom& atom = structure.atoms[i];
        KindCount& count = counts[kindOf(structure, atom, roles, polymer)];
        ++count.atoms;
        count.residues.insert(atom.residue);
        const bool particle = atom.role == AtomRole::Particle;
        ++count.names[particle ? atom.name : residueOf(structure, atom).name];
    }
    std::string out;
    for (const char* const kind : order) {
        const auto found = counts.find(kind);
        if (found == counts.end()) continue;
        constexpr std::size_t most = 6; // names
        std::vector<std::string> names;
        for (const auto& [name, atoms] : found->second.names)
            if (!name.empty()) names.push_back(name);
        const bool listed = !names.empty() && std::string(kind) != "protein";
        out += infoLine(kind, counted(found->second.atoms, "atom", "atoms") + " in " +
                                  counted(found->second.residues.size(), "residue", "residues") +
                                  (listed ? " (" + joined(names, most) + ")" : ""));
    }
    return out;
}

} // namespace

std::string describeStructure(const std::string& path, std::size_t maxInput)
{
    const Structure structure = readStructure(path, maxInput);
    std::string out = infoTitle(path) + infoTitle("  structure");
    out += infoLine("format", structure.format);
    std::vector<std::string> models;
    for (const Model& model : structure.models) models.push_back(std::to_string(model.number));
    out += infoLine("models", std::to_string(models.size()) +
                                  (models.size() > 1 ? " (" + joined(models) + ")" : ""));
    if (structure.beads == BeadKind::Martini2) out += infoLine("beads", "Martini 2");
    if (structure.beads == BeadKind::Martini3) out += infoLine("beads", "Martini 3");
    if (structure.beads == BeadKind::Unnamed) out += infoLine("beads", "one or a few a residue");
    const Model& first = structure.models[0];
    std::size_t hydrogen = 0;
    std::set<std::int32_t> used;
    for (std::size_t i = first.begin; i < first.end; ++i) {
        hydrogen += structure.atoms[i].element == 1;
        used.insert(residueOf(structure, structure.atoms[i]).chain);
    }
    out += infoLine("chains", std::to_string(used.size()) + " (" + namesOf(structure, used) + ")");
    out += infoLine("atoms", std::to_string(first.end - first.begin) + " (" +
                                 std::to_string(hydrogen) + " hydrogen)");
    out += describeKinds(structure, first);
    if (structure.guessed > 0) out += infoLine("elements", describeGuesses(structure));
    for (const std::string& warning : structure.warnings) out += infoLine("warning", warning);
    if (structure.assemblies.empty()) out += infoLine("assemblies", "none");
    for (const Assembly& assembly : structure.assemblies) out += describe(structure, assembly);
    return out;
}

} // namespace molsurf
