// SPDX-License-Identifier: MPL-2.0
#include "molsurf/selection/choose_locations.h"

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

/// Mean occupancy of the atoms that share a label or a residue.
struct Mean {
    double sum = 0;
    int count = 0;
    std::size_t order = 0; ///< of first appearance
};

template<typename Key>
void addTo(std::map<Key, Mean>& means, const Key& key, float occupancy)
{
    Mean& mean = means.emplace(key, Mean{0, 0, means.size()}).first->second;
    mean.sum += occupancy;
    ++mean.count;
}

/// In steps of the last decimal that files have, so that rounding does not decide.
long roundedMean(const Mean& mean)
{
    constexpr double steps = 1e4;
    return std::lround(steps * mean.sum / mean.count);
}

/// Keys by descending mean occupancy, then by order of appearance.
template<typename Key>
std::map<Key, std::size_t> ranked(const std::map<Key, Mean>& means)
{
    std::vector<std::pair<Key, Mean>> sorted(means.begin(), means.end());
    std::sort(sorted.begin(), sorted.end(),
              [](const auto& a, const auto& b) { return a.second.order < b.second.order; });
    std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
        return roundedMean(a.second) > roundedMean(b.second);
    });
    std::map<Key, std::size_t> ranks;
    for (std::size_t i = 0; i < sorted.size(); ++i) ranks[sorted[i].first] = i;
    return ranks;
}

/// The alternatives of a residue.
struct Site {
    std::map<char, Mean> labels;
    std::map<std::int32_t, Mean> residues;
    std::map<std::string, std::map<char, std::size_t>> byName; ///< positions of atoms with a label
};

Site siteOf(const Structure& structure, const Indices& atoms)
{
    Site site;
    for (const auto i : atoms) {
        const Atom& atom = atomAt(structure, i);
        if (atom.altloc == '\0') continue;
        addTo(site.labels, atom.altloc, atom.occupancy);
        addTo(site.residues, atom.residue, atom.occupancy);
    }
    return site;
}

/// Labels of a site that share the name of an atom, and whether their names are the same.
struct Rivals {
    std::set<std::pair<char, char>> pairs; ///< that share a name
    bool different = false;                ///< whether the names of a pair differ
};

Rivals rivalsIn(const Site& site)
{
    Rivals out;
    std::map<std::pair<char, char>, std::size_t> shared;
    std::map<char, std::size_t> names;
    for (const auto& [name, locations] : site.byName)
        for (const auto& [label, i] : locations) {
            ++names[label];
            for (const auto& [other, k] : locations)
                if (label != other) ++shared[{label, other}];
        }
    for (const auto& [pair, count] : shared) {
        out.pairs.insert(pair);
        out.different = out.different || names[pair.first] != count || names[pair.second] != count;
    }
    return out;
}

/// The marks of the atoms of one site that are kept. Where the readings have different atoms, one
/// of them is kept as a whole, or atoms of one would lie beside those of another.
std::vector<char> chooseInResidue(const Structure& structure, const Indices& atoms)
{
    std::vector<char> keep(atoms.size(), 0);
    Site site = siteOf(structure, atoms);
    const auto labelRank = ranked(site.labels);
    const auto residueRank = ranked(site.residues);
    char first = '\0'; // label of the best rank in the residue that is kept
    for (std::size_t i = 0; i < atoms.size(); ++i) {
        const Atom& atom = atomAt(structure, atoms[i]);
        keep[i] = atom.altloc == '\0';
        if (keep[i] || residueRank.at(atom.residue) != 0) continue;
        site.byName[atom.name].emplace(atom.altloc, i);
        if (first == '\0' || labelRank.at(atom.altloc) < labelRank.at(first)) first = atom.altloc;
    }
    const Rivals rivals = rivalsIn(site);
    for (const auto& [name, locations] : site.byName) {
        const auto better = [&](const auto& a, const auto& b) {
            const float mine = atomAt(structure, atoms[a.second]).occupancy;
            const float other = atomAt(structure, atoms[b.second]).occupancy;
            if (!rivals.different && mine != other) return mine > other;
            return labelRank.at(a.first) < labelRank.at(b.first);
        };
        const auto best = std::min_element(locations.begin(), locations.end(), better);
        keep[best->second] = !rivals.different || rivals.pairs.count({first, best->first}) == 0;
    }
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
