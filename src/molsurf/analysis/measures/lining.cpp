// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/measures/lining.h"

#include "molsurf/molecule/selection/ball_names.h"
#include "molsurf/molecule/selection/ball_values.h"

#include <cmath>
#include <set>

namespace molsurf
{

namespace
{

/// By its own name: force fields call neutral ones ASH, GLH and LYN.
double chargeOf(const std::string& residue)
{
    if (residue == "LYS" || residue == "ARG") return 1.0;
    return residue == "ASP" || residue == "GLU" ? -1.0 : 0.0;
}

void append(const std::string& word, std::string& list)
{
    list += (list.empty() ? "" : " ") + word;
}

} // namespace

Lining liningOf(const BallSet& atoms, const std::vector<std::pair<std::size_t, double>>& parts)
{
    Lining out;
    std::set<std::int32_t> residues;
    double sum = 0.0, all = 0.0, charge = 0.0;
    for (const auto& [ball, weight] : parts) {
        append(std::to_string(atoms.balls[ball].atom), out.atoms);
        if (!atoms.names) continue;
        const std::int32_t residue = atoms.names->residueOf[ball];
        residues.insert(residue);
        const double value = hydrophobicityOf(atoms.names->residues[std::size_t(residue)].name);
        if (!std::isfinite(value)) continue;
        sum += weight * value;
        all += weight;
    }
    for (const std::int32_t residue : residues) {
        const BallNames::Residue& one = atoms.names->residues[std::size_t(residue)];
        if (one.name.empty()) continue; // as in a list of balls
        append(titleOf(one), out.residues);
        charge += chargeOf(one.name);
    }
    if (!(all > 0.0)) return out; // there are no amino acids
    out.hydrophobicity = sum / all;
    out.charge = charge;
    return out;
}

Lining namesOf(const BallSet& atoms, const std::vector<std::size_t>& balls)
{
    Lining out;
    std::set<std::int32_t> seen;
    for (const std::size_t ball : balls) {
        append(std::to_string(atoms.balls[ball].atom), out.atoms);
        if (!atoms.names || !seen.insert(atoms.names->residueOf[ball]).second) continue;
        const BallNames::Residue& residue =
            atoms.names->residues[std::size_t(atoms.names->residueOf[ball])];
        if (!residue.name.empty()) append(titleOf(residue), out.residues);
    }
    return out;
}

} // namespace molsurf
