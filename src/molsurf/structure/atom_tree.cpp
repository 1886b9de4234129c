// SPDX-License-Identifier: MPL-2.0
#include "molsurf/structure/atom_tree.h"

#include "molsurf/structure/element.h"
#include "molsurf/structure/gemmi_model.h"
#include "molsurf/structure/guess_element.h"
#include "molsurf/structure/residue_names.h"

#include <cctype>

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

/// Whether a residue of a name begins again with the atom that it began with: no link of a chain,
/// and no unknown ligand, whose atoms Open Babel names by their elements.
bool mayRepeat(const std::string& name)
{
    if (name == "UNL") return false;
    const NameClass kind = nameClass(name);
    return kind != NameClass::AminoAcid && kind != NameClass::ModifiedAminoAcid &&
           kind != NameClass::Nucleotide && kind != NameClass::ModifiedNucleotide;
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
    const bool repeats = mayRepeat(from.name); // gemmi joins waters whose numbers come again
    for (const gemmi::Atom& atom : from.atoms) {
        const bool first = &atom == &from.atoms[0];
        if (first || (repeats && atom.altloc == '\0' && atom.name == from.atoms[0].name))
            out_.residues.push_back(residue);
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
    if (count > modelBegin_ && isSame(count - 1, atom, chain)) {
        const bool again =
            lastRepeats_ && atom.altloc == '\0' &&
            out_.atoms[std::size_t(firsts_[std::size_t(count - 1)])].name == atom.name;
        if (!again) return count - 1;
    } else {
        for (std::int32_t r = count - 1; r >= modelBegin_; --r) { // alternatives that alternate
            const Residue& before = out_.residues[std::size_t(r)];
            if (before.chain != chain || before.number != atom.number ||
                before.insertionCode != atom.insertionCode || atom.altloc == '\0')
                break;
            if (isSame(r, atom, chain)) return r;
        }
    }
    Residue residue{};
    residue.name = atom.residue;
    residue.chain = residue.asym = chain;
    residue.number = atom.number;
    residue.insertionCode = atom.insertionCode;
    residue.hetatm = atom.hetatm;
    lastRepeats_ = mayRepeat(residue.name) && !atom.name.empty();
    out_.residues.push_back(std::move(residue));
    segments_.push_back(segment_);
    firsts_.push_back(std::int32_t(out_.atoms.size()));
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
    out_.atoms.push_back({atom.position, std::string(atom.name), residue, elementOf(atom),
                          atom.altloc, atom.role, atom.occupancy, atom.bFactor, atom.radius});
    const bool first = out_.models.back().begin + 1 == out_.atoms.size();
    const std::int32_t next = first ? 1 : out_.serials.back() + 1;
    out_.serials.push_back(atom.serial != 0 ? atom.serial : next);
}

Structure AtomTree::finish()
{
    if (!out_.models.empty()) out_.models.back().end = out_.atoms.size();
    if (!out_.models.empty() && out_.models.back().begin == out_.models.back().end)
        out_.models.pop_back();
    out_.asyms = out_.chains;
    dropPlainSerials(out_);
    return std::move(out_);
}

} // namespace molsurf
