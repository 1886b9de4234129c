// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/ball_names.h"

#include <map>

namespace molsurf
{

std::string titleOf(const BallNames::Residue& residue)
{
    return (residue.chain.empty() ? "_" : residue.chain) + "/" + residue.name + numberText(residue);
}

std::string numberText(const BallNames::Residue& residue)
{
    std::string text = std::to_string(residue.number);
    if (residue.insertionCode != ' ') text += residue.insertionCode;
    return text;
}

BallNames ballNames(const Structure& structure, const BallSet& atoms)
{
    BallNames out;
    out.residueOf.reserve(atoms.balls.size());
    out.atoms.reserve(atoms.balls.size());
    const Placement& placement = atoms.placement;
    for (std::size_t c = 0; c < placement.numbers.size(); ++c) {
        const std::string suffix = chainSuffix(placement.numbers[c]);
        std::map<std::int32_t, std::int32_t> known; // of this copy, by their place in the file
        for (std::size_t i = placement.begin[c]; i < placement.begin[c + 1]; ++i)
            known[structure.atoms[std::size_t(atoms.balls[i].atom)].residue] = 0;
        for (auto& [residue, place] : known) {
            place = std::int32_t(out.residues.size());
            const Residue& r = structure.residues[std::size_t(residue)];
            out.residues.push_back({structure.chains[std::size_t(r.chain)] + suffix,
                                    structure.asyms[std::size_t(r.asym)] + suffix, r.name, r.number,
                                    r.insertionCode, r.hetatm});
        }
        for (std::size_t i = placement.begin[c]; i < placement.begin[c + 1]; ++i) {
            const Atom& atom = structure.atoms[std::size_t(atoms.balls[i].atom)];
            out.residueOf.push_back(known[atom.residue]);
            out.atoms.push_back({atom.name, atom.altloc, atom.element, atom.occupancy});
        }
    }
    return out;
}

std::string parentResidue(const std::string& name)
{
    static const std::map<std::string, std::string> parents = {
        {"HID", "HIS"}, {"HIE", "HIS"}, {"HIP", "HIS"}, {"HSD", "HIS"},
        {"HSE", "HIS"}, {"HSP", "HIS"}, {"CYX", "CYS"}, {"CYM", "CYS"},
        {"ASH", "ASP"}, {"GLH", "GLU"}, {"LYN", "LYS"}, {"MSE", "MET"}};
    const auto found = parents.find(name);
    return found == parents.end() ? name : found->second;
}

std::optional<double> largestAccessibleArea(const std::string& residue)
{
    static const std::map<std::string, double> areas = {
        {"ALA", 129.0}, {"ARG", 274.0}, {"ASN", 195.0}, {"ASP", 193.0}, {"CYS", 167.0},
        {"GLN", 225.0}, {"GLU", 223.0}, {"GLY", 104.0}, {"HIS", 224.0}, {"ILE", 197.0},
        {"LEU", 201.0}, {"LYS", 236.0}, {"MET", 224.0}, {"PHE", 240.0}, {"PRO", 159.0},
        {"SER", 155.0}, {"THR", 172.0}, {"TRP", 285.0}, {"TYR", 263.0}, {"VAL", 174.0}};
    const auto found = areas.find(parentResidue(residue));
    return found == areas.end() ? std::optional<double>() : found->second;
}

} // namespace molsurf
