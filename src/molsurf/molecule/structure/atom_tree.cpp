// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/atom_tree.h"

#include "molsurf/molecule/structure/element.h"
#include "molsurf/molecule/structure/guess_element.h"
#include "molsurf/molecule/structure/residue_names.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace molsurf
{
namespace
{

/// The residue of atoms that the Protein Data Bank cannot tell: their name UNK is no uranium.
constexpr std::string_view unknownAtoms = "UNX";

/// The molecules that stand in one residue as their numbers and names are the same.
class Molecules
{
public:
    /// @param[in] atoms  of the residue, in the order of the file
    Molecules(const Structure& structure, const std::vector<std::size_t>& atoms)
        : structure_(structure), atoms_(atoms)
    {
    }

    /// Where another molecule begins, in `atoms`: at an atom whose name and alternate location are
    /// those of the first atom of the molecule before, if no bond joins it or what follows to that.
    std::vector<std::size_t> begins()
    {
        if (!firstRepeats()) return {};
        const NameClass kind = nameClass(residueOf(structure_, at(0)).name);
        if (isLink(kind)) return {};
        single_ = kind == NameClass::Water || kind == NameClass::Ion;
        if (structure_.placed) sortIntoCells();
        std::vector<std::size_t> out;
        std::size_t last = 0; // that a bond joins to the molecule
        for (std::size_t i = 0; i < atoms_.size(); ++i) {
            if (labelOf(i) == labelOf(0) && last < i) out.push_back(i);
            last = std::max(last, lastPartner(i));
        }
        return out;
    }

private:
    using Label = std::pair<std::string_view, char>;
    using Cell = std::array<double, 3>;
    static constexpr double tolerance = 0.45; // [Å], beyond covalent radii

    const Atom& at(std::size_t i) const { return structure_.atoms[atoms_[i]]; }
    Label labelOf(std::size_t i) const { return {at(i).name, at(i).altloc}; }

    bool firstRepeats() const
    {
        for (std::size_t i = 1; i < atoms_.size(); ++i)
            if (!at(i).name.empty() && labelOf(i) == labelOf(0)) return true;
        return false;
    }

    Cell cellOf(const Atom& atom) const
    {
        Cell out{};
        for (int a = 0; a < 3; ++a)
            if (std::isfinite(atom.position[a]))
                out[std::size_t(a)] = std::floor(atom.position[a] / edge_);
        return out;
    }

    void sortIntoCells()
    {
        double largest = 0.0;
        for (std::size_t i = 0; i < atoms_.size(); ++i)
            largest = std::max(largest, covalentRadius(at(i).element));
        edge_ = 2.0 * largest + tolerance;
        for (std::size_t i = 0; i < atoms_.size(); ++i) cells_.emplace_back(cellOf(at(i)), i);
        std::sort(cells_.begin(), cells_.end());
    }

    /// Two oxygens of waters, or two ions of a kind, are never bonded.
    bool areBonded(std::size_t i, std::size_t j) const
    {
        const Atom &a = at(i), &b = at(j);
        if (single_ && a.element == b.element) return false;
        const double longest = covalentRadius(a.element) + covalentRadius(b.element) + tolerance;
        return (a.position - b.position).lengthSqr() < longest * longest;
    }

    /// The last atom that a bond joins to one; itself if there is none behind it.
    std::size_t lastPartner(std::size_t i) const
    {
        if (!structure_.placed) return i;
        std::size_t best = i;
        const Cell middle = cellOf(at(i));
        for (int n = 0; n < 27; ++n) {
            const Cell cell{middle[0] + n / 9 - 1, middle[1] + n / 3 % 3 - 1,
                            middle[2] + n % 3 - 1};
            auto next =
                std::upper_bound(cells_.begin(), cells_.end(), std::pair(cell, atoms_.size()));
            while (next != cells_.begin() && (--next)->first == cell && next->second > best)
                if (areBonded(i, next->second)) best = next->second;
        }
        return best;
    }

    const Structure& structure_;
    const std::vector<std::size_t>& atoms_;
    bool single_ = false; ///< whether atoms of one element have no bonds
    double edge_ = 1.0;   ///< of a cell [Å]
    std::vector<std::pair<Cell, std::size_t>> cells_;
};

/// Takes away serial numbers that only count the atoms of each model.
void dropPlainSerials(Structure& structure)
{
    for (const Model& model : structure.models)
        for (std::size_t i = model.begin; i < model.end; ++i)
            if (structure.serials[i] != std::int32_t(i - model.begin + 1)) return;
    structure.serials = {};
}

/// Puts the residues in the order of their first atoms.
/// @param[in] byChain  whether those of a chain, in the order of the chains, come together
void sortResidues(Structure& structure, bool byChain)
{
    std::vector<std::int32_t> order, places(structure.residues.size(), -1);
    for (const Model& model : structure.models) {
        const std::size_t begin = order.size();
        for (std::size_t i = model.begin; i < model.end; ++i) {
            std::int32_t& place = places[std::size_t(structure.atoms[i].residue)];
            if (place < 0) order.push_back(structure.atoms[i].residue);
            place = 0;
        }
        const auto chainOf = [&](std::int32_t r) {
            return structure.residues[std::size_t(r)].chain;
        };
        if (byChain)
            std::stable_sort(order.begin() + std::ptrdiff_t(begin), order.end(),
                             [&](auto a, auto b) { return chainOf(a) < chainOf(b); });
    }
    std::vector<Residue> residues;
    residues.reserve(order.size());
    for (const std::int32_t r : order) {
        places[std::size_t(r)] = std::int32_t(residues.size());
        residues.push_back(std::move(structure.residues[std::size_t(r)]));
    }
    for (Atom& atom : structure.atoms) atom.residue = places[std::size_t(atom.residue)];
    structure.residues = std::move(residues);
}

/// Makes residues of the molecules that stand in one. Those of Open Babel's unknown ligands and of
/// files without residues stay.
/// @return whether there are any
bool separateMolecules(Structure& structure)
{
    const std::size_t count = structure.residues.size();
    std::vector<std::size_t> ends(count + 1, 0), order(structure.atoms.size());
    for (const Atom& atom : structure.atoms) ++ends[std::size_t(atom.residue) + 1];
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    for (std::size_t i = 0; i < order.size(); ++i)
        order[ends[std::size_t(structure.atoms[i].residue)]++] = i;
    std::vector<std::size_t> atoms;
    for (std::size_t r = 0; r < count; ++r) {
        const std::size_t begin = r > 0 ? ends[r - 1] : 0, end = ends[r];
        if (end - begin < 2 || structure.residues[r].name == "UNL") continue;
        atoms.assign(order.begin() + std::ptrdiff_t(begin), order.begin() + std::ptrdiff_t(end));
        std::vector<std::size_t> begins = Molecules(structure, atoms).begins();
        begins.push_back(atoms.size());
        for (std::size_t m = 0; m + 1 < begins.size(); ++m) {
            structure.residues.push_back(structure.residues[r]);
            for (std::size_t i = begins[m]; i < begins[m + 1]; ++i)
                structure.atoms[atoms[i]].residue = std::int32_t(structure.residues.size()) - 1;
        }
    }
    return structure.residues.size() > count;
}

/// A number for what tells residues apart.
std::size_t hashOf(const Residue& residue)
{
    std::size_t hash = std::hash<std::string>()(residue.name);
    for (const std::int32_t part :
         {residue.chain, residue.asym, residue.number, std::int32_t(residue.insertionCode)})
        hash = (hash ^ std::size_t(std::uint32_t(part))) * 0x9e3779b97f4a7c15u;
    return hash;
}

} // namespace

void joinModels(Structure& structure)
{
    std::vector<Model> joined;
    std::unordered_map<int, std::size_t> places;            // in joined, of a number
    std::vector<std::pair<std::size_t, std::size_t>> order; // place of the model, atom
    for (const Model& model : structure.models) {
        const auto [found, isNew] = places.try_emplace(model.number, joined.size());
        if (isNew) joined.push_back({model.number, 0, 0});
        for (std::size_t i = model.begin; i < model.end; ++i) order.emplace_back(found->second, i);
    }
    if (joined.size() == structure.models.size()) return;
    std::stable_sort(order.begin(), order.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Atom> atoms;
    std::vector<std::int32_t> serials;
    for (const auto& [place, i] : order) {
        if (joined[place].end == 0) joined[place].begin = atoms.size();
        atoms.push_back(std::move(structure.atoms[i]));
        if (!structure.serials.empty()) serials.push_back(structure.serials[i]);
        joined[place].end = atoms.size();
    }
    structure.atoms = std::move(atoms);
    structure.serials = std::move(serials);
    structure.models = std::move(joined);
}

void AtomTree::startModel(int number)
{
    endRun();
    std::vector<Model>& models = out_.models;
    if (!models.empty()) models.back().end = out_.atoms.size();
    if (!models.empty() && models.back().begin == models.back().end)
        models.back() = {number, out_.atoms.size(), out_.atoms.size()};
    else
        models.push_back({number, out_.atoms.size(), out_.atoms.size()});
    modelBegin_ = std::int32_t(out_.residues.size());
    runs_.clear();
    likeBefore_.clear();
    lastLike_.clear();
    labels_.clear();
}

bool AtomTree::isSame(const Residue& a, const Residue& b) const
{
    return a.number == b.number && a.insertionCode == b.insertionCode && a.chain == b.chain &&
           a.asym == b.asym && a.name == b.name;
}

Residue AtomTree::residueOf(const AtomLine& atom)
{
    Residue out{};
    out.name = atom.residue;
    out.chain = chains_.index(std::string(atom.chain), out_.chains);
    out.asym = asyms_.index(std::string(atom.asym.empty() ? atom.chain : atom.asym), out_.asyms);
    out.segment =
        atom.segment.empty() ? -1 : segments_.index(std::string(atom.segment), out_.segments);
    out.number = atom.number;
    out.insertionCode = atom.insertionCode;
    out.hetatm = atom.hetatm;
    out.entity = atom.entity;
    return out;
}

void AtomTree::startResidue(Residue residue)
{
    endRun();
    const auto place = std::int32_t(out_.residues.size());
    const auto [like, isNew] = lastLike_.emplace(hashOf(residue), place);
    likeBefore_.push_back(isNew ? -1 : std::exchange(like->second, place));
    runs_.emplace_back(runBegin_, runBegin_);
    out_.residues.push_back(std::move(residue));
}

/// The names of a residue's atoms.
std::set<AtomTree::Label>& AtomTree::labelsOf(std::int32_t residue)
{
    const auto [found, isNew] = labels_.emplace(residue, std::set<Label>());
    const auto [begin, end] = runs_[std::size_t(residue - modelBegin_)];
    for (std::size_t i = begin; isNew && i < end; ++i) found->second.insert(labelOf(i));
    return found->second;
}

/// The residue that the atoms of the present run belong to: the first one like it that has none of
/// their names; its own where a molecule begins anew.
std::int32_t AtomTree::earlierResidue(std::int32_t run)
{
    constexpr int most = 1000; // residues of one name and number
    std::int32_t found = run, like = run;
    const Residue& own = out_.residues[std::size_t(run)];
    for (int n = 0; n < most; ++n) {
        like = likeBefore_[std::size_t(like - modelBegin_)];
        if (like < 0) break;
        if (!isSame(out_.residues[std::size_t(like)], own)) continue;
        if (labelOf(runs_[std::size_t(like - modelBegin_)].first) == labelOf(runBegin_)) break;
        const std::set<Label>& names = labelsOf(like);
        bool free = true;
        for (std::size_t i = runBegin_; i < out_.atoms.size() && free; ++i)
            free = names.count(labelOf(i)) == 0;
        if (free) found = like;
    }
    return found;
}

/// Gives the atoms of the present run to the residue that they belong to.
void AtomTree::endRun()
{
    const std::size_t end = out_.atoms.size();
    if (runBegin_ == end) return;
    const auto run = std::int32_t(out_.residues.size()) - 1;
    const std::int32_t residue = likeBefore_.back() < 0 ? run : earlierResidue(run);
    if (residue == run) {
        runs_.back().second = end;
    } else {
        std::set<Label>& names = labelsOf(residue);
        for (std::size_t i = runBegin_; i < end; ++i) {
            out_.atoms[i].residue = residue;
            names.insert(labelOf(i));
        }
        lastLike_[hashOf(out_.residues.back())] = likeBefore_.back();
        out_.residues.pop_back();
        runs_.pop_back();
        likeBefore_.pop_back();
        joined_ = true;
    }
    runBegin_ = end;
}

std::uint8_t AtomTree::elementOf(const AtomLine& atom)
{
    const auto given = std::uint8_t(atom.element);
    if ((given != 0 && !isMisread(given, atom.name, atom.residue)) || !atom.guess ||
        atom.role != AtomRole::Atom || atom.residue == unknownAtoms)
        return given;
    if (out_.models.size() == 1) ++out_.guessed;
    std::string key(atom.residue);
    key.append(1, atom.inFirstColumn ? '\2' : '\1').append(atom.name);
    if (atom.mass >= 0.0) key.append(1, '\1').append(std::to_string(atom.mass));
    const auto found = guesses_.find(key);
    if (found != guesses_.end()) return found->second;
    const std::uint8_t element =
        guessElement({atom.name, atom.residue, atom.mass, atom.inFirstColumn});
    guesses_.emplace(std::move(key), element);
    return element;
}

void AtomTree::add(const AtomLine& atom)
{
    if (out_.models.empty()) startModel(1);
    Residue residue = residueOf(atom);
    if (runBegin_ == out_.atoms.size() || !isSame(out_.residues.back(), residue) ||
        out_.residues.back().segment != residue.segment)
        startResidue(std::move(residue));
    out_.atoms.push_back({atom.position, std::string(atom.name),
                          std::int32_t(out_.residues.size()) - 1, elementOf(atom), atom.altloc,
                          atom.role, atom.occupancy, atom.bFactor, atom.radius});
    const bool first = out_.models.back().begin + 1 == out_.atoms.size();
    const std::int32_t next = first ? 1 : out_.serials.back() + 1;
    out_.serials.push_back(atom.serial != 0 ? atom.serial : next);
}

Structure AtomTree::finish(bool placed)
{
    endRun();
    out_.placed = placed;
    if (!out_.models.empty()) out_.models.back().end = out_.atoms.size();
    if (!out_.models.empty() && out_.models.back().begin == out_.models.back().end)
        out_.models.pop_back();
    if (separateMolecules(out_) || joined_) sortResidues(out_, joined_);
    dropPlainSerials(out_);
    return std::move(out_);
}

} // namespace molsurf
