// SPDX-License-Identifier: MPL-2.0
#include "molsurf/structure/atom_tree.h"

#include "molsurf/structure/element.h"
#include "molsurf/structure/gemmi_model.h"
#include "molsurf/structure/name_table.h"
#include "molsurf/structure/residue_kind.h"

#include <gemmi/polyheur.hpp>
#include <gemmi/resinfo.hpp>

#include <cctype>

namespace molsurf
{
namespace
{

/// True if two residues are bonded as neighbours in a protein or a nucleic acid.
bool areBonded(const gemmi::Residue& first, const gemmi::Residue& second)
{
    return gemmi::are_connected(first, second, gemmi::PolymerType::PeptideL) ||
           gemmi::are_connected(first, second, gemmi::PolymerType::Rna);
}

/// True if a residue belongs to a polymer. Where the file names no entities, gemmi guesses, and we
/// add what its guess leaves out: caps, and residues that follow a modified one or a stray TER.
bool isInPolymer(const gemmi::Chain& chain, std::size_t index, bool entitiesKnown)
{
    const gemmi::Residue& residue = chain.residues[index];
    if (residue.entity_type == gemmi::EntityType::Polymer) return true;
    if (entitiesKnown) return false;
    if (residue.het_flag != 'H' && isStandardResidue(residue.name)) return true;
    const bool toPrevious = index > 0 && areBonded(chain.residues[index - 1], residue);
    return toPrevious ||
           (index + 1 < chain.residues.size() && areBonded(residue, chain.residues[index + 1]));
}

/// Whether a residue looks like a link of a polymer by itself.
bool mayBeLink(const gemmi::Residue& residue)
{
    const gemmi::ResidueInfo info = gemmi::find_tabulated_residue(residue.name);
    if (!info.found()) return residue.get_ca() || residue.get_p();
    return (info.is_amino_acid() || info.is_nucleic_acid()) &&
           !(info.is_standard() && residue.het_flag == 'H');
}

/// Atomic number; corrects names such as CA that stand one column too far left in a file without
/// elements, where they read as calcium.
std::uint8_t elementOf(const gemmi::Atom& atom, bool standardResidue)
{
    const int number = atom.element.atomic_number();
    const bool usual = number == 1 || number == 6 || number == 7 || number == 8 || number == 15 ||
                       number == 16 || number == 34;
    if (usual || !standardResidue) return static_cast<std::uint8_t>(number);
    for (const char c : atom.name) {
        if (std::isalpha(static_cast<unsigned char>(c))) {
            return elementNumber(std::string(1, c));
        }
    }
    return static_cast<std::uint8_t>(number);
}

/// Copies gemmi's tree into our tables.
class Converter
{
public:
    Converter(Structure& out, bool asyms, bool entitiesKnown)
        : out_(out), asymsKnown_(asyms), entitiesKnown_(entitiesKnown)
    {
    }

    void add(const gemmi::Model& model, int number)
    {
        const std::size_t begin = out_.atoms.size();
        for (const gemmi::Chain& chain : model.chains) {
            for (std::size_t i = 0; i < chain.residues.size(); ++i) add(chain, i);
        }
        if (out_.atoms.size() > begin) out_.models.push_back({number, begin, out_.atoms.size()});
    }

private:
    void add(const gemmi::Chain& chain, std::size_t index)
    {
        const gemmi::Residue& from = chain.residues[index];
        Residue residue{};
        residue.name = from.name;
        residue.chain = chains_.index(chain.name, out_.chains);
        residue.asym = asyms_.index(asymsKnown_ ? from.subchain : chain.name, out_.asyms);
        residue.number = from.seqid.num ? *from.seqid.num : 0;
        residue.insertionCode = from.seqid.icode;
        residue.water = isWaterName(from.name) || from.entity_type == gemmi::EntityType::Water;
        residue.hetatm = from.het_flag == 'H';
        residue.hetero = !residue.water && !isInPolymer(chain, index, entitiesKnown_);
        const auto residueIndex = static_cast<std::int32_t>(out_.residues.size());
        out_.residues.push_back(std::move(residue));
        const bool standard = isStandardResidue(from.name);
        for (const gemmi::Atom& atom : from.atoms) {
            out_.atoms.push_back({openvdb::Vec3d(atom.pos.x, atom.pos.y, atom.pos.z), atom.name,
                                  residueIndex, elementOf(atom, standard), atom.altloc, atom.occ,
                                  atom.b_iso, -1.0});
        }
    }

    Structure& out_;
    bool asymsKnown_, entitiesKnown_;
    NameTable chains_, asyms_;
};

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

} // namespace

bool isStandardResidue(const std::string& name)
{
    const gemmi::ResidueInfo info = gemmi::find_tabulated_residue(name);
    return (info.is_amino_acid() || info.is_nucleic_acid()) && info.is_standard();
}

void guessPolymers(gemmi::Structure& tree, bool all)
{
    std::vector<gemmi::Residue*> guessed;
    for (gemmi::Model& model : tree.models)
        for (gemmi::Chain& chain : model.chains)
            for (gemmi::Residue& residue : chain.residues)
                if (all || residue.entity_type == gemmi::EntityType::Unknown)
                    guessed.push_back(&residue);
    gemmi::add_entity_types(tree, all);
    for (gemmi::Residue* residue : guessed) { // from 0.6 on short polymers go on with what follows
        if (residue->entity_type != gemmi::EntityType::Polymer || mayBeLink(*residue)) continue;
        residue->entity_type =
            residue->is_water() ? gemmi::EntityType::Water : gemmi::EntityType::NonPolymer;
    }
}

void copyTree(const gemmi::Structure& tree, const std::vector<int>& numbers, bool asyms,
              bool entitiesKnown, Structure& out)
{
    out.atoms.reserve(countAtoms(tree));
    Converter converter(out, asyms, entitiesKnown);
    std::size_t withAtoms = 0;
    for (const gemmi::Model& model : tree.models) {
        if (model.chains.empty()) continue;
        converter.add(model, numbers.at(withAtoms++));
    }
}

void AtomTree::startModel(int number)
{
    if (!tree_.models.empty() && tree_.models.back().chains.empty()) {
        numbers_.back() = number;
        return;
    }
    tree_.models.emplace_back(ModelNumber{number});
    numbers_.push_back(number);
}

void AtomTree::add(const AtomLine& atom)
{
    if (tree_.models.empty()) startModel(1);
    std::vector<gemmi::Chain>& chains = tree_.models.back().chains;
    if (chains.empty() || chains.back().name != atom.chain)
        chains.emplace_back(std::string(atom.chain));
    std::vector<gemmi::Residue>& residues = chains.back().residues;
    const bool same = !residues.empty() && residues.back().name == atom.residue &&
                      residues.back().seqid.num.value == atom.number &&
                      residues.back().seqid.icode == atom.insertionCode;
    if (!same) {
        gemmi::Residue& residue = residues.emplace_back();
        residue.name = atom.residue;
        residue.seqid.num = atom.number;
        residue.seqid.icode = atom.insertionCode;
        residue.het_flag = atom.hetatm ? 'H' : 'A';
    }
    gemmi::Atom& to = residues.back().atoms.emplace_back();
    to.name = atom.name;
    to.element = gemmi::Element(static_cast<gemmi::El>(atom.element));
    to.pos = {atom.position.x(), atom.position.y(), atom.position.z()};
}

Structure AtomTree::finish()
{
    guessPolymers(tree_, false);
    Structure out;
    copyTree(tree_, numbers_, false, false, out);
    return out;
}

} // namespace molsurf
