// SPDX-License-Identifier: MPL-2.0
#include "molsurf/structure/atom_tree.h"

#include "molsurf/structure/element.h"
#include "molsurf/structure/gemmi_model.h"
#include "molsurf/structure/guess_element.h"
#include "molsurf/structure/residue_names.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace molsurf
{
namespace
{

/// The residue of atoms that the Protein Data Bank cannot tell: their name UNK is no uranium.
constexpr std::string_view unknownAtoms = "UNX";

EntityHint hintOf(const gemmi::Residue& residue)
{
    switch (residue.entity_type) {
    case gemmi::EntityType::Polymer:
        return EntityHint::Polymer;
    case gemmi::EntityType::Water:
        return EntityHint::Water;
    default:
        return EntityHint::Other;
    }
}

std::size_t countAtoms(const gemmi::Structure& structure)
{
    std::size_t atoms = 0;
    for (const gemmi::Model& model : structure.models) {
        for (const gemmi::Chain& chain : model.chains) {
            for (const gemmi::Residue& residue : chain.residues) atoms += residue.atoms.size();
        }
    }
    return atoms;
}

/// The molecules that stand in one residue as their numbers and names are the same.
class Molecules
{
public:
    /// @param[in] atoms  of the residue, in the order of the file
    /// @param[in] links  whether links of chains may have been joined, too
    Molecules(const Structure& structure, const std::vector<std::size_t>& atoms, bool links)
        : structure_(structure), atoms_(atoms), links_(links)
    {
    }

    /// Where another molecule begins, in `atoms`: at an atom whose name and alternate location are
    /// those of the first atom of the molecule before, if no bond joins it or what follows to that.
    std::vector<std::size_t> begins()
    {
        if (!firstRepeats()) return {};
        const NameClass kind = nameClass(residueOf(structure_, at(0)).name);
        if (!links_ && isLink(kind)) return {};
        single_ = kind == NameClass::Water || kind == NameClass::Ion;
        if (structure_.placed && !single_) sortIntoCells();
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
        constexpr std::size_t sites = 8; // of a water, at most
        if (single_) {
            std::size_t last = std::min(i + sites, atoms_.size() - 1);
            while (last > i && !areBonded(i, last)) --last;
            return last;
        }
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
    bool links_;
    bool single_ = false; ///< whether atoms of one element have no bonds
    double edge_ = 1.0;   ///< of a cell [Å]
    std::vector<std::pair<Cell, std::size_t>> cells_;
};

/// Puts the atoms of each model in the order of their serials, if these differ.
void sortBySerials(Structure& structure)
{
    std::vector<std::size_t> order(structure.atoms.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    const auto& serials = structure.serials;
    for (const Model& model : structure.models) {
        const auto begin = order.begin() + std::ptrdiff_t(model.begin);
        const auto end = order.begin() + std::ptrdiff_t(model.end);
        std::sort(begin, end, [&](auto a, auto b) { return serials[a] < serials[b]; });
        if (std::adjacent_find(begin, end,
                               [&](auto a, auto b) { return serials[a] == serials[b]; }) != end)
            return;
    }
    std::vector<Atom> atoms;
    std::vector<std::int32_t> sorted;
    atoms.reserve(order.size());
    sorted.reserve(order.size());
    for (const std::size_t i : order) {
        atoms.push_back(std::move(structure.atoms[i]));
        sorted.push_back(serials[i]);
    }
    structure.atoms = std::move(atoms);
    structure.serials = std::move(sorted);
}

/// Puts the residues in the order of their first atoms.
void sortResidues(Structure& structure)
{
    std::vector<std::int32_t> places(structure.residues.size(), -1);
    std::vector<Residue> residues;
    residues.reserve(places.size());
    for (Atom& atom : structure.atoms) {
        std::int32_t& place = places[std::size_t(atom.residue)];
        if (place < 0) {
            place = std::int32_t(residues.size());
            residues.push_back(std::move(structure.residues[std::size_t(atom.residue)]));
        }
        atom.residue = place;
    }
    structure.residues = std::move(residues);
}

/// Makes residues of the molecules that stand in one. Those of Open Babel's unknown ligands and of
/// files without residues stay.
/// @param[in] links  whether links of chains may have been joined, too
/// @return whether there are any
bool separateMolecules(Structure& structure, bool links)
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
        std::vector<std::size_t> begins = Molecules(structure, atoms, links).begins();
        begins.push_back(atoms.size());
        for (std::size_t m = 0; m + 1 < begins.size(); ++m) {
            structure.residues.push_back(structure.residues[r]);
            for (std::size_t i = begins[m]; i < begins[m + 1]; ++i)
                structure.atoms[atoms[i]].residue = std::int32_t(structure.residues.size()) - 1;
        }
    }
    return structure.residues.size() > count;
}

} // namespace

void TreeCopier::add(const gemmi::Structure& tree, bool goesOn)
{
    if (out_.atoms.empty()) out_.atoms.reserve(countAtoms(tree));
    std::vector<Model>& models = out_.models;
    for (const gemmi::Model& model : tree.models) {
        if (model.chains.empty()) continue;
        int number = models.empty() ? 1 : models.back().number + 1;
        setNumber(number, model);
        if (!goesOn || models.empty() || models.back().number != number)
            models.push_back({number, out_.atoms.size(), out_.atoms.size()});
        goesOn = false;
        for (const gemmi::Chain& chain : model.chains)
            for (const gemmi::Residue& residue : chain.residues) add(chain, residue);
        models.back().end = out_.atoms.size();
    }
}

void TreeCopier::add(const gemmi::Chain& chain, const gemmi::Residue& from)
{
    Residue residue{};
    residue.name = from.name;
    residue.chain = chains_.index(chain.name, out_.chains);
    residue.asym = asyms_.index(from.subchain, out_.asyms);
    residue.number = from.seqid.num ? *from.seqid.num : 0;
    residue.insertionCode = from.seqid.icode;
    residue.hetatm = from.het_flag == 'H';
    if (entitiesKnown_) residue.entity = hintOf(from);
    if (!from.atoms.empty()) out_.residues.push_back(residue);
    for (const gemmi::Atom& atom : from.atoms) {
        auto element = std::uint8_t(atom.element.atomic_number());
        if (isMisread(element, atom.name, from.name)) element = 0;
        if (element == 0 && from.name != unknownAtoms) {
            element = guessElement(atom.name, from.name);
            if (out_.models.size() == 1) ++out_.guessed;
        }
        out_.atoms.push_back({openvdb::Vec3d(atom.pos.x, atom.pos.y, atom.pos.z), atom.name,
                              std::int32_t(out_.residues.size()) - 1, element, atom.altloc,
                              AtomRole::Atom, atom.occ, atom.b_iso, -1.0});
        out_.serials.push_back(atom.serial);
    }
}

void TreeCopier::finish()
{
    if (!separateMolecules(out_, true)) return;
    sortBySerials(out_);
    sortResidues(out_);
}

void dropPlainSerials(Structure& structure)
{
    if (structure.serials.empty()) return;
    for (const Model& model : structure.models)
        for (std::size_t i = model.begin; i < model.end; ++i)
            if (structure.serials[i] != std::int32_t(i - model.begin + 1)) return;
    structure.serials = {};
}

void AtomTree::startModel(int number)
{
    std::vector<Model>& models = out_.models;
    if (!models.empty()) models.back().end = out_.atoms.size();
    if (!models.empty() && models.back().begin == models.back().end)
        models.back() = {number, out_.atoms.size(), out_.atoms.size()};
    else
        models.push_back({number, out_.atoms.size(), out_.atoms.size()});
    modelBegin_ = std::int32_t(out_.residues.size());
}

bool AtomTree::isSame(std::int32_t residue, const AtomLine& atom, std::int32_t chain) const
{
    const Residue& at = out_.residues[std::size_t(residue)];
    return at.number == atom.number && at.insertionCode == atom.insertionCode &&
           at.chain == chain && at.name == atom.residue &&
           segments_[std::size_t(residue)] == segment_;
}

std::int32_t AtomTree::residueOf(const AtomLine& atom)
{
    const std::int32_t chain = chains_.index(std::string(atom.chain), out_.chains);
    segment_ = segmentTable_.index(std::string(atom.segment), segmentNames_);
    const auto count = std::int32_t(out_.residues.size());
    if (count > modelBegin_ && isSame(count - 1, atom, chain)) return count - 1;
    for (std::int32_t r = count - 1; r >= modelBegin_; --r) { // alternatives
        const Residue& before = out_.residues[std::size_t(r)];
        const bool sameNumber =
            before.number == atom.number && before.insertionCode == atom.insertionCode;
        const char other = altlocs_[std::size_t(r)]; // of the block before that of the atom
        const bool inBlock = other != '\0' && other != atom.altloc;
        if (atom.altloc == '\0' || before.chain != chain || !(sameNumber || inBlock)) break;
        if (isSame(r, atom, chain)) return r;
    }
    Residue residue{};
    residue.name = atom.residue;
    residue.chain = residue.asym = chain;
    residue.number = atom.number;
    residue.insertionCode = atom.insertionCode;
    residue.hetatm = atom.hetatm;
    out_.residues.push_back(std::move(residue));
    segments_.push_back(segment_);
    altlocs_.push_back(atom.altloc);
    return count;
}

std::uint8_t AtomTree::elementOf(const AtomLine& atom)
{
    if (atom.element != 0 || !atom.guess || atom.role != AtomRole::Atom ||
        atom.residue == unknownAtoms)
        return std::uint8_t(atom.element);
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
    const std::int32_t residue = residueOf(atom);
    altlocs_[std::size_t(residue)] = atom.altloc;
    out_.atoms.push_back({atom.position, std::string(atom.name), residue, elementOf(atom),
                          atom.altloc, atom.role, atom.occupancy, atom.bFactor, atom.radius});
    const bool first = out_.models.back().begin + 1 == out_.atoms.size();
    const std::int32_t next = first ? 1 : out_.serials.back() + 1;
    out_.serials.push_back(atom.serial != 0 ? atom.serial : next);
}

Structure AtomTree::finish(bool placed)
{
    out_.placed = placed;
    if (!out_.models.empty()) out_.models.back().end = out_.atoms.size();
    if (!out_.models.empty() && out_.models.back().begin == out_.models.back().end)
        out_.models.pop_back();
    out_.asyms = out_.chains;
    if (separateMolecules(out_, false)) sortResidues(out_);
    dropPlainSerials(out_);
    return std::move(out_);
}

} // namespace molsurf
