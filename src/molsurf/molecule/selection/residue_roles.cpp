// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/residue_roles.h"

#include "molsurf/kernel/balls/ball_index.h"
#include "molsurf/molecule/structure/symmetry.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>

namespace molsurf
{

namespace
{

/// Whether ions of an element stay in solution: alkali metals and halogens.
bool staysFree(std::uint8_t element)
{
    constexpr std::uint8_t free[] = {3, 9, 11, 17, 19, 35, 37, 53, 55};
    return std::find(std::begin(free), std::end(free), element) != std::end(free);
}

struct LigandAtoms {
    std::int32_t residue;
    std::vector<std::size_t> atoms;
};

/// The places of atoms: in the file, or in all copies of an assembly.
class MoleculeCopies
{
public:
    MoleculeCopies(const Structure& structure, const Assembly* assembly)
        : structure_(structure), assembly_(assembly), partsOf_(structure.asyms.size())
    {
        if (!assembly) return;
        for (const AssemblyPart& part : assembly->parts) {
            const std::set<std::string> names(part.chains.begin(), part.chains.end());
            for (std::size_t a = 0; a < partsOf_.size(); ++a)
                if (names.empty() || names.count(structure.asyms[a]) > 0)
                    partsOf_[a].push_back(&part);
        }
    }

    bool has(const Residue& residue) const
    {
        return !assembly_ || !partsOf_[std::size_t(residue.asym)].empty();
    }

    /// Calls with every place that an atom has.
    template<typename CommandLine>
    void forEach(std::size_t atom, const CommandLine& call) const
    {
        const Atom& from = structure_.atoms[atom];
        if (!assembly_) return call(from.position);
        constexpr double farthest = 1e6; // [Å], as far as an index reaches
        for (const AssemblyPart* part : partsOf_[std::size_t(residueOf(structure_, from).asym)])
            for (const Operator& op : part->operators) {
                const openvdb::Vec3d x = op.placed(from.position);
                if (std::abs(x.x()) < farthest && std::abs(x.y()) < farthest &&
                    std::abs(x.z()) < farthest)
                    call(x);
            }
    }

private:
    const Structure& structure_;
    const Assembly* assembly_;
    std::vector<std::vector<const AssemblyPart*>> partsOf_; ///< of each asym
};

/// The role of what touches nothing.
Role roleAlone(ResidueKind kind)
{
    switch (kind) {
    case ResidueKind::Ion:
        return Role::FreeIon;
    case ResidueKind::Buffer:
        return Role::Buffer;
    case ResidueKind::Lipid:
        return Role::Lipid;
    default:
        return Role::Apart;
    }
}

/// The molecules of a model that may be a part of the molecule, and the atoms of its polymers.
/// @param[out] roles  of those that are looked at
std::vector<LigandAtoms> waitingIn(const Structure& structure, const Model& model,
                                   const MoleculeCopies& copies, std::vector<Role>& roles,
                                   std::vector<std::size_t>& polymer)
{
    std::vector<LigandAtoms> out;
    for (std::size_t i = model.begin; i < model.end; ++i) {
        const Atom& atom = structure.atoms[i];
        const Residue& residue = residueOf(structure, atom);
        if (residue.water() || atom.role != AtomRole::Atom || !copies.has(residue)) continue;
        if (residue.polymer()) {
            polymer.push_back(i);
            continue;
        }
        Role& role = roles[std::size_t(atom.residue)];
        role = roleAlone(residue.kind);
        if (role == Role::Buffer || role == Role::Lipid) continue;
        if (role == Role::FreeIon && staysFree(atom.element)) continue;
        if (out.empty() || out.back().residue != atom.residue) out.push_back({atom.residue, {}});
        out.back().atoms.push_back(i);
    }
    if (polymer.empty()) std::fill(roles.begin(), roles.end(), Role::Molecule);
    return out;
}

/// Flood fill: lets the molecules that wait join what touches them. There are few of them, so that
/// an index of them takes less than one of the polymers and their copies.
class Joining
{
public:
    Joining(const MoleculeCopies& copies, const std::vector<LigandAtoms>& groups,
            std::vector<Role>& roles)
        : copies_(copies), groups_(groups), roles_(roles), joined_(groups.size()),
          index_(placesOf(copies, groups), {0.0, ofLigand, ofLigand})
    {
    }

    /// Lets in what touches these atoms, and what touches that, and so on.
    void run(const std::vector<std::size_t>& atoms)
    {
        for (const std::size_t i : atoms) {
            if (count_ == groups_.size()) return;
            touch(i);
        }
        while (!queue_.empty()) {
            const std::size_t group = queue_.back();
            queue_.pop_back();
            for (const std::size_t i : groups_[group].atoms) touch(i);
        }
    }

private:
    static constexpr double ofIon = 3.0, ofLigand = 4.0; // where they touch [Å]

    /// Balls whose `atom` is the index of their group.
    static std::vector<Ball> placesOf(const MoleculeCopies& copies,
                                      const std::vector<LigandAtoms>& groups)
    {
        std::vector<Ball> out;
        for (std::size_t g = 0; g < groups.size(); ++g)
            for (const std::size_t i : groups[g].atoms)
                copies.forEach(i, [&](const openvdb::Vec3d& x) {
                    out.push_back({x, 0.0, std::int32_t(g)});
                });
        return out;
    }

    /// Makes ligands and ions within reach of an atom parts of the molecule, and queues them, for
    /// what they touch.
    void touch(std::size_t atom)
    {
        copies_.forEach(atom, [&](const openvdb::Vec3d& x) {
            index_.forEachNear(x, x, ofLigand, [&](const Ball& other, std::int32_t) {
                const auto group = std::size_t(other.atom);
                if (joined_[group]) return;
                Role& role = roles_[std::size_t(groups_[group].residue)];
                const double reach = role == Role::FreeIon ? ofIon : ofLigand;
                if ((other.center - x).lengthSqr() > reach * reach) return;
                role = Role::Molecule;
                joined_[group] = 1;
                ++count_;
                queue_.push_back(group);
            });
        });
    }

    const MoleculeCopies& copies_;
    const std::vector<LigandAtoms>& groups_;
    std::vector<Role>& roles_;
    std::vector<char> joined_; ///< one a group
    std::size_t count_ = 0;    ///< of groups that have joined
    std::vector<std::size_t> queue_;
    BallIndex index_;
};

} // namespace

std::vector<Role> rolesIn(const Structure& structure, const Model& model, const Assembly* assembly)
{
    std::vector<Role> roles(structure.residues.size(), Role::Molecule);
    if (structure.hasRadii || structure.beads != BeadKind::None) return roles;
    const MoleculeCopies copies(structure, assembly);
    std::vector<std::size_t> polymer;
    const std::vector<LigandAtoms> waiting = waitingIn(structure, model, copies, roles, polymer);
    if (!polymer.empty() && !waiting.empty()) Joining(copies, waiting, roles).run(polymer);
    return roles;
}

} // namespace molsurf
