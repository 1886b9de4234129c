// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/alternate_locations.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>

namespace molsurf
{
namespace
{

using Indices = std::vector<std::int32_t>;

const Atom& atomAt(const Structure& structure, std::int32_t index)
{
    return structure.atoms[std::size_t(index)];
}

/// True for the alternatives of one residue, which may have different names.
bool isSameSite(const Residue& a, const Residue& b)
{
    return a.chain == b.chain && a.number == b.number && a.insertionCode == b.insertionCode;
}

/// A reading of a site: a residue and a label; the label of an atom without one is ' ' if another
/// atom of its residue has its name and a label.
using Reading = std::pair<std::int32_t, char>;

/// The readings that the atoms of a site are of; a label of '\0' is that of all of them.
std::vector<Reading> readingsOf(const Structure& structure, const Indices& atoms)
{
    std::set<std::pair<std::int32_t, std::string>> labelled;
    for (const auto i : atoms) {
        const Atom& atom = atomAt(structure, i);
        if (atom.altloc != '\0') labelled.emplace(atom.residue, atom.name);
    }
    std::vector<Reading> out;
    for (const auto i : atoms) {
        const Atom& atom = atomAt(structure, i);
        const bool rival = atom.altloc == '\0' && labelled.count({atom.residue, atom.name}) > 0;
        out.emplace_back(atom.residue, rival ? ' ' : atom.altloc);
    }
    return out;
}

/// How readings compare.
struct Rivals {
    std::map<Reading, std::size_t> rank;         ///< 0: the best one
    std::set<std::pair<Reading, Reading>> pairs; ///< that share the name of an atom
};

/// Ranks readings by the sum of occupancies of those atoms whose names others have, too; of equal
/// ones the first.
Rivals rivalsIn(const Structure& structure, const Indices& atoms,
                const std::vector<Reading>& readings)
{
    std::map<std::string, std::map<Reading, float>> byName;
    std::vector<Reading> order;
    for (std::size_t i = 0; i < atoms.size(); ++i) {
        if (readings[i].second == '\0') continue;
        const Atom& atom = atomAt(structure, atoms[i]);
        byName[atom.name].emplace(readings[i], atom.occupancy);
        if (std::find(order.begin(), order.end(), readings[i]) == order.end())
            order.push_back(readings[i]);
    }
    Rivals out;
    std::map<Reading, double> sums;
    for (const auto& [name, occupancies] : byName)
        for (const auto& [reading, occupancy] : occupancies) {
            if (occupancies.size() > 1) sums[reading] += double(occupancy);
            for (const auto& [other, ignored] : occupancies)
                if (other != reading) out.pairs.emplace(reading, other);
        }
    // In steps of the last decimal that files have, so that rounding does not decide.
    const auto rounded = [&](const Reading& reading) { return std::lround(1e4 * sums[reading]); };
    std::stable_sort(order.begin(), order.end(),
                     [&](const Reading& a, const Reading& b) { return rounded(a) > rounded(b); });
    for (std::size_t n = 0; n < order.size(); ++n) out.rank[order[n]] = n;
    return out;
}

/// The marks of the atoms of one site that are kept: those of the best reading, and of others that
/// share no name with it, of which again the best one is kept. So no atom of one reading lies
/// beside those of another.
std::vector<char> chooseInResidue(const Structure& structure, const Indices& atoms)
{
    const std::vector<Reading> readings = readingsOf(structure, atoms);
    const Rivals rivals = rivalsIn(structure, atoms, readings);
    std::vector<Reading> chosen, all(rivals.rank.size());
    for (const auto& [reading, rank] : rivals.rank) all[rank] = reading;
    for (const Reading& reading : all) {
        const bool other = !chosen.empty() && chosen[0].first != reading.first;
        const bool rival = std::any_of(chosen.begin(), chosen.end(), [&](const Reading& better) {
            return rivals.pairs.count({better, reading}) > 0;
        });
        if (!other && !rival) chosen.push_back(reading);
    }
    std::vector<char> keep;
    for (const Reading& reading : readings)
        keep.push_back(reading.second == '\0' ||
                       std::find(chosen.begin(), chosen.end(), reading) != chosen.end());
    return keep;
}

/// For each atom the number of its site: of its residue and those next to it that have its number
/// and other names, which are its alternatives.
std::vector<std::int32_t> sitesOf(const Structure& structure, const Indices& atoms)
{
    std::vector<std::int32_t> out, ofResidue(structure.residues.size(), -1);
    out.reserve(atoms.size());
    std::int32_t site = -1;
    const Residue* first = nullptr; // of the site
    std::set<std::string> names;    // of its residues
    for (const auto i : atoms) {
        const Atom& atom = atomAt(structure, i);
        std::int32_t& known = ofResidue[std::size_t(atom.residue)];
        if (known < 0) {
            const Residue& residue = residueOf(structure, atom);
            const bool other = first && isSameSite(*first, residue) && !names.count(residue.name);
            if (!other) {
                ++site;
                first = &residue;
                names.clear();
            }
            names.insert(residue.name);
            known = site;
        }
        out.push_back(known);
    }
    return out;
}

} // namespace

std::size_t keepHighestOccupancy(const Structure& structure, Indices& atoms)
{
    const std::vector<std::int32_t> sites = sitesOf(structure, atoms);
    std::vector<std::size_t> order(atoms.size()); // site by site
    std::iota(order.begin(), order.end(), std::size_t(0));
    const auto isBefore = [&](std::size_t a, std::size_t b) { return sites[a] < sites[b]; };
    if (!std::is_sorted(sites.begin(), sites.end()))
        std::stable_sort(order.begin(), order.end(), isBefore);
    std::vector<char> keep(atoms.size(), 1);
    Indices site;
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
        bool alternatives = false;
        site.clear();
        for (; end < order.size() && sites[order[end]] == sites[order[begin]]; ++end) {
            site.push_back(atoms[order[end]]);
            alternatives = alternatives || atomAt(structure, site.back()).altloc != '\0';
        }
        if (!alternatives) continue;
        const std::vector<char> ofSite = chooseInResidue(structure, site);
        for (std::size_t i = begin; i < end; ++i) keep[order[i]] = ofSite[i - begin];
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < atoms.size(); ++i) {
        if (keep[i]) atoms[kept++] = atoms[i];
    }
    const std::size_t dropped = atoms.size() - kept;
    atoms.resize(kept);
    return dropped;
}

} // namespace molsurf
