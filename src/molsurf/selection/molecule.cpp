// SPDX-License-Identifier: MPL-2.0
#include "molsurf/selection/molecule.h"

#include "molsurf/balls/ball_index.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace molsurf
{

namespace
{

/// Names that the Protein Data Bank gives to what is added to a solution, and names of lipids in
/// simulations.
constexpr std::string_view additives[] = {
    // salts and buffers
    "SO4", "SO3", "PO4", "PO3", "2HP", "PI", "NO3", "CO3", "BCT", "NH4", "SCN", "AZI", "CAC", "ACT",
    "ACY", "FMT", "CIT", "FLC", "TLA", "TAR", "MLI", "MLA", "SIN", "OXL", "MLT", "TRS", "BTB",
    "EPE", "MES", "MPO", "NHE", "PIN", "CXS", "IMD", "GAI", "URE",
    // solvents and cryoprotectants
    "GOL", "EDO", "PGO", "PDO", "MPD", "MRD", "DMS", "DMF", "EOH", "MOH", "IPA", "IOH", "TBU",
    "BU1", "BU3", "DIO", "CCN", "ACN", "HEZ", "PEG", "PGE", "PG4", "PG0", "P6G", "P33", "P4G",
    "1PE", "2PE", "7PE", "PE3", "PE4", "PE8", "12P", "15P", "XPE", "BME", "DTT", "DTU", "DTV",
    "TCE",
    // detergents and lipids
    "LDA", "LMT", "BOG", "BNG", "HTG", "DMU", "UMQ", "SDS", "C8E", "HTO", "D10", "D12", "OCT",
    "HEX", "OLA", "OLB", "OLC", "MPG", "DLPC", "DMPC", "DOPC", "DOPE", "DOPG", "DOPS", "DPPC",
    "DPPE", "DPPG", "DSPC", "POPC", "POPE", "POPG", "POPS", "POP", "DPP", "DOP", "DMP", "CHL1",
    "TRIO"};

bool isAdditive(const std::string& name)
{
    return std::find(std::begin(additives), std::end(additives), name) != std::end(additives);
}

/// Whether ions of an element stay in solution: alkali metals and halogens.
bool staysFree(std::uint8_t element)
{
    constexpr std::uint8_t free[] = {3, 9, 11, 17, 19, 35, 37, 53, 55};
    return std::find(std::begin(free), std::end(free), element) != std::end(free);
}

/// Metals and halogens: of one atom alone they are ions.
bool isIonic(std::uint8_t z)
{
    const bool nonmetal = z <= 2 || (z >= 5 && z <= 8) || z == 10 || (z >= 14 && z <= 16) ||
                          z == 18 || (z >= 32 && z <= 34) || z == 36 || z == 52 || z == 54;
    return !nonmetal;
}

struct LigandAtoms {
    std::int32_t residue;
    std::vector<std::size_t> atoms;
};

} // namespace

std::vector<Role> rolesIn(const Structure& structure, const Model& model)
{
    constexpr double ofIon = 3.0, ofLigand = 4.0; // where they touch [Å]
    std::vector<Role> roles(structure.residues.size(), Role::Molecule);
    if (structure.hasRadii || structure.beads != BeadKind::None) return roles;
    std::vector<Ball> near; // atoms of the molecule
    std::vector<LigandAtoms> others;
    for (std::size_t i = model.begin; i < model.end; ++i) {
        const Atom& atom = structure.atoms[i];
        const Residue& residue = residueOf(structure, atom);
        if (residue.water) continue;
        if (!residue.hetero) {
            near.push_back({atom.position, 0.0, std::int32_t(i)});
            continue;
        }
        if (others.empty() || others.back().residue != atom.residue)
            others.push_back({atom.residue, {}});
        others.back().atoms.push_back(i);
    }
    if (near.empty()) return roles;
    std::vector<LigandAtoms> waiting;
    for (LigandAtoms& group : others) {
        const Atom& first = structure.atoms[group.atoms.front()];
        const bool ion = group.atoms.size() == 1 && isIonic(first.element);
        Role& role = roles[std::size_t(group.residue)];
        // Records ATOM are those of polymers, but simulations write everything so.
        const bool hetatm = structure.residues[std::size_t(group.residue)].hetatm;
        role = ion ? Role::FreeIon : hetatm ? Role::Apart : Role::Molecule;
        if (isAdditive(structure.residues[std::size_t(group.residue)].name)) role = Role::Additive;
        if (role == Role::Additive || (ion && staysFree(first.element))) continue;
        waiting.push_back(std::move(group));
    }
    // What touches the molecule belongs to it, and what touches that, and so on.
    while (!near.empty() && !waiting.empty()) {
        const BallIndex index(near, {0.0, ofLigand, ofLigand});
        near.clear();
        const auto joins = [&](const LigandAtoms& group) {
            Role& role = roles[std::size_t(group.residue)];
            const double reach = role == Role::FreeIon ? ofIon : ofLigand;
            bool touches = false;
            for (const std::size_t i : group.atoms) {
                const openvdb::Vec3d& x = structure.atoms[i].position;
                index.forEachNear(x, x, reach, [&](const Ball& other, std::int32_t) {
                    touches = touches || (other.center - x).lengthSqr() <= reach * reach;
                });
            }
            if (!touches) return false;
            role = Role::Molecule;
            for (const std::size_t i : group.atoms)
                near.push_back({structure.atoms[i].position, 0.0, std::int32_t(i)});
            return true;
        };
        waiting.erase(std::remove_if(waiting.begin(), waiting.end(), joins), waiting.end());
    }
    return roles;
}

} // namespace molsurf
