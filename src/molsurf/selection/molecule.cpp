// SPDX-License-Identifier: MPL-2.0
#include "molsurf/selection/molecule.h"

#include "molsurf/balls/ball_index.h"
#include "molsurf/structure/symmetry.h"

#include <algorithm>
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

/// The motions of each asym in an assembly; without one the identity.
class MoleculeCopies
{
public:
    MoleculeCopies(const Structure& structure, const Assembly* assembly)
        : structure_(structure), ofAsym_(structure.asyms.size()), whole_(assembly == nullptr)
    {
        if (!assembly) return;
        for (const AssemblyPart& part : assembly->parts) {
            const std::set<std::string> names(part.chains.begin(), part.chains.end());
            for (std::size_t a = 0; a < ofAsym_.size(); ++a)
                if (names.empty() || names.count(structure.asyms[a]) > 0)
                    for (const Operator& op : part.operators) ofAsym_[a].push_back(&op);
        }
    }

    bool has(const Residue& residue) const
    {
        return whole_ || !ofAsym_[std::size_t(residue.asym)].empty();
    }

    /// Calls with every place that an atom has.
    template<typename Call>
    void forEach(std::size_t atom, const Call& call) const
    {
        const Atom& from = structure_.atoms[atom];
        if (whole_) return call(from.position);
        for (const Operator* op : ofAsym_[std::size_t(residueOf(structure_, from).asym)])
            call(moved(*op, from.position));
    }

private:
    const Structure& structure_;
    std::vector<std::vector<const Operator*>> ofAsym_;
    bool whole_;
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

/// The molecules of a model that may be a part of the molecule, and the places of its polymers.
/// @param[out] roles  of those that are looked at
std::vector<LigandAtoms> waitingIn(const Structure& structure, const Model& model,
                                   const MoleculeCopies& copies, std::vector<Role>& roles,
                                   std::vector<Ball>& near)
{
    std::vector<LigandAtoms> out;
    std::vector<std::size_t> polymer;
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
    if (polymer.empty() || out.empty()) return {};
    for (const std::size_t i : polymer)
        copies.forEach(i, [&](const openvdb::Vec3d& x) {
            near.push_back({x, 0.0, std::int32_t(i)});
        });
    return out;
}

} // namespace

std::vector<Role> rolesIn(const Structure& structure, const Model& model, const Assembly* assembly)
{
    constexpr double ofIon = 3.0, ofLigand = 4.0; // where they touch [Å]
    std::vector<Role> roles(structure.residues.size(), Role::Molecule);
    if (structure.hasRadii || structure.beads != BeadKind::None) return roles;
    const MoleculeCopies copies(structure, assembly);
    std::vector<Ball> near; // atoms of the molecule
    std::vector<LigandAtoms> waiting = waitingIn(structure, model, copies, roles, near);
    // What touches the molecule belongs to it, and what touches that, and so on.
    while (!near.empty() && !waiting.empty()) {
        const BallIndex index(near, {0.0, ofLigand, ofLigand});
        near.clear();
        const auto joins = [&](const LigandAtoms& group) {
            Role& role = roles[std::size_t(group.residue)];
            const double reach = role == Role::FreeIon ? ofIon : ofLigand;
            bool touches = false;
            for (const std::size_t i : group.atoms)
                copies.forEach(i, [&](const openvdb::Vec3d& x) {
                    if (touches) return;
                    index.forEachNear(x, x, reach, [&](const Ball& other, std::int32_t) {
                        touches = touches || (other.center - x).lengthSqr() <= reach * reach;
                    });
                });
            if (!touches) return false;
            role = Role::Molecule;
            for (const std::size_t i : group.atoms)
                copies.forEach(i, [&](const openvdb::Vec3d& x) {
                    near.push_back({x, 0.0, std::int32_t(i)});
                });
            return true;
        };
        waiting.erase(std::remove_if(waiting.begin(), waiting.end(), joins), waiting.end());
    }
    return roles;
}

} // namespace molsurf
