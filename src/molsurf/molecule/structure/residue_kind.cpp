// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/residue_kind.h"

#include "molsurf/molecule/structure/guess_element.h"
#include "molsurf/molecule/structure/residue_names.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;
using std::string_view;

/// The atoms of one residue, in the order of the file.
class Members
{
public:
    Members(Structure& structure, const std::int32_t* begin, const std::int32_t* end)
        : structure_(structure), begin_(begin), end_(end)
    {
    }

    std::size_t size() const { return std::size_t(end_ - begin_); }
    Atom& operator[](std::size_t i) const { return structure_.atoms[std::size_t(begin_[i])]; }

    /// The first atom of a name; nullptr if there is none.
    const Atom* find(string_view name) const
    {
        for (std::size_t i = 0; i < size(); ++i)
            if ((*this)[i].name == name) return &(*this)[i];
        return nullptr;
    }

    /// Whether an atom has the name of one of a nucleotide's sugar: "C1'", "O3*".
    bool hasPrimed() const
    {
        for (std::size_t i = 0; i < size(); ++i) {
            const std::string& name = (*this)[i].name;
            if (name.size() > 1 && (name.back() == '\'' || name.back() == '*')) return true;
        }
        return false;
    }

    bool has(string_view name) const { return find(name) != nullptr; }
    bool has(string_view name, string_view other) const { return has(name) || has(other); }

private:
    Structure& structure_;
    const std::int32_t *begin_, *end_;
};

/// The atoms of a residue by their elements, without particles and second locations.
struct Composition {
    std::size_t atoms = 0, carbons = 0, oxygens = 0, hydrogens = 0, nitrogens = 0, phosphorus = 0,
                others = 0, ionic = 0, unknown = 0;
    bool oneElement = true;
};

/// Counts of the elements of a residue, in its first alternate location.
Composition compositionOf(const Members& members)
{
    constexpr std::uint8_t hydrogen = 1, carbon = 6, nitrogen = 7, oxygen = 8,
                           phosphorusElement = 15;
    Composition out;
    const Atom* first = nullptr;
    for (std::size_t i = 0; i < members.size(); ++i) {
        const Atom& atom = members[i];
        if (atom.role != AtomRole::Atom) continue;
        if (first && atom.altloc != '\0' && atom.altloc != first->altloc) continue;
        if (!first) first = &atom;
        ++out.atoms;
        out.carbons += atom.element == carbon;
        out.oxygens += atom.element == oxygen;
        out.hydrogens += atom.element == hydrogen;
        out.nitrogens += atom.element == nitrogen;
        out.phosphorus += atom.element == phosphorusElement;
        out.others += atom.element != carbon && atom.element != oxygen && atom.element != hydrogen;
        out.ionic += isIonic(atom.element);
        out.unknown += atom.element == 0;
        out.oneElement = out.oneElement && atom.element == first->element;
    }
    return out;
}

bool areNear(const Atom* a, const Atom* b, double distance)
{
    return a && b && (a->position - b->position).lengthSqr() <= distance * distance;
}

/// Kinds of the residues of one model.
class Classifier
{
public:
    explicit Classifier(Structure& structure) : structure_(structure)
    {
        const std::size_t residues = structure.residues.size();
        begin_.assign(residues + 1, 0);
        for (const Atom& atom : structure.atoms) ++begin_[std::size_t(atom.residue) + 1];
        for (std::size_t r = 0; r < residues; ++r) begin_[r + 1] += begin_[r];
        order_.resize(structure.atoms.size());
        std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
        for (std::size_t i = 0; i < structure.atoms.size(); ++i)
            order_[next[std::size_t(structure.atoms[i].residue)]++] = std::int32_t(i);
        findNeighbours();
    }

    void run()
    {
        const auto count = std::int32_t(structure_.residues.size());
        names_.resize(std::size_t(count));
        for (std::int32_t r = 0; r < count; ++r) names_[std::size_t(r)] = classOf(at(r).name);
        for (std::int32_t r = 0; r < count; ++r) markParticles(r);
        for (std::int32_t r = 0; r < count; ++r)
            if (at(r).kind != ResidueKind::Bead) at(r).kind = kindOf(r);
    }

private:
    Residue& at(std::int32_t r) { return structure_.residues[std::size_t(r)]; }

    Members membersOf(std::int32_t r)
    {
        const std::int32_t* all = order_.data();
        return {structure_, all + begin_[std::size_t(r)], all + begin_[std::size_t(r) + 1]};
    }

    NameClass classOf(const std::string& name)
    {
        const auto found = known_.find(name);
        return found != known_.end() ? found->second
                                     : known_.emplace(name, nameClass(name)).first->second;
    }

    /// The residues before and behind each one in its chain and model. The atoms of a residue are
    /// those of one model.
    void findNeighbours()
    {
        const std::size_t count = structure_.residues.size();
        previous_.assign(count, -1);
        next_.assign(count, -1);
        std::vector<char> met(count, 0);
        std::vector<std::int32_t> last(structure_.chains.size(), -1);
        std::vector<const Model*> modelOf(structure_.chains.size(), nullptr); // of `last`
        for (const Model& model : structure_.models) {
            std::int32_t seen = -1;
            for (std::size_t i = model.begin; i < model.end; ++i) {
                const std::int32_t r = structure_.atoms[i].residue;
                if (r == seen) continue;
                seen = r;
                const auto chain = std::size_t(at(r).chain);
                std::int32_t& before = last[chain];
                if (modelOf[chain] != &model) before = -1;
                modelOf[chain] = &model;
                if (met[std::size_t(r)]) continue;
                met[std::size_t(r)] = 1;
                previous_[std::size_t(r)] = before;
                if (before >= 0) next_[std::size_t(before)] = r;
                before = r;
            }
        }
    }

    /// Marks what is in the place of an atom without being one: virtual sites, lone pairs, centres.
    void markParticles(std::int32_t r)
    {
        const NameClass kind = names_[std::size_t(r)];
        const Members members = membersOf(r);
        const bool polymer = kind == NameClass::AminoAcid || kind == NameClass::Nucleotide;
        const bool water = !polymer && isWaterWithSites(members);
        for (std::size_t i = 0; i < members.size(); ++i) {
            Atom& atom = members[i];
            if (atom.name.empty() || atom.radius >= 0.0 || atom.role != AtomRole::Atom) continue;
            bool particle =
                (atom.element == 0 && isParticleName(atom.name)) || isMark(at(r).name, atom.name);
            if (kind == NameClass::Water)
                particle = particle || atom.name == "OM" || atom.name == "MW" ||
                           (atom.element == 0 && members.size() > 1);
            particle = particle || (water && atom.element == 0);
            if (polymer) // dummy masses of GROMACS, pseudo-atoms of NMR
                particle =
                    particle || (atom.element == 0 && (atom.name[0] == 'M' || atom.name[0] == 'Q'));
            if (atom.name[0] == 'D' && atom.name.size() > 1 && atom.element <= 1)
                particle = particle || isDrude(members, atom);
            if (!particle) continue;
            atom.role = AtomRole::Particle;
            atom.element = 0;
        }
    }

    /// Whether what has an element is one oxygen and two hydrogens.
    static bool isWaterWithSites(const Members& members)
    {
        constexpr std::size_t most = 7; // atoms and sites of any model
        if (members.size() > most) return false;
        const Composition all = compositionOf(members);
        return all.oxygens == 1 && all.hydrogens == 2 && all.carbons == 0 &&
               all.others == all.unknown;
    }

    /// A Drude particle lies next to its atom, whose name it has behind a D. (Deuterium is bonded.)
    bool isDrude(const Members& members, const Atom& atom) const
    {
        constexpr double farthest = 0.5; // [Å]
        const Atom* core = members.find(string_view(atom.name).substr(1));
        if (!core) return false;
        return structure_.placed ? areNear(core, &atom, farthest) : atom.element == 0;
    }

    /// Whether a peptide bond or a phosphodiester joins two residues.
    bool areBonded(std::int32_t first, std::int32_t second)
    {
        if (first < 0 || second < 0 || !structure_.placed) return false;
        constexpr double peptide = 2.0, phosphodiester = 2.4; // gemmi's: 1.5 of the ideal lengths
        const Members a = membersOf(first), b = membersOf(second);
        if (areNear(a.find("C"), b.find("N"), peptide)) return true;
        const Atom* const phosphorus = b.find("P");
        return areNear(a.find("O3'"), phosphorus, phosphodiester) ||
               areNear(a.find("O3*"), phosphorus, phosphodiester);
    }

    bool isBonded(std::int32_t r)
    {
        return areBonded(previous_[std::size_t(r)], r) || areBonded(r, next_[std::size_t(r)]);
    }

    /// Whether a residue lies between two standard ones, looks like a link, and is numbered so.
    bool isFlanked(std::int32_t r)
    {
        const std::int32_t before = previous_[std::size_t(r)], behind = next_[std::size_t(r)];
        if (before < 0 || behind < 0) return false;
        const auto standard = [&](std::int32_t n) {
            const NameClass kind = names_[std::size_t(n)];
            return kind == NameClass::AminoAcid || kind == NameClass::Nucleotide;
        };
        const Members members = membersOf(r);
        const bool link = (members.has("CA") && (members.size() == 1 || members.has("N", "C"))) ||
                          (members.has("P") && (members.size() == 1 || members.has("C1'", "C1*")));
        return link && standard(before) && standard(behind) && at(before).number <= at(r).number &&
               at(r).number <= at(behind).number;
    }

    /// A link of a chain whose name is a standard one or not; Ligand if it is none.
    ResidueKind linkKind(std::int32_t r, ResidueKind asLink)
    {
        const Residue& residue = at(r);
        if (residue.entity == EntityHint::Polymer) return asLink;
        if (residue.entity == EntityHint::Other) return ResidueKind::Ligand;
        const bool link = !residue.hetatm || isBonded(r) || isFlanked(r);
        return link ? asLink : ResidueKind::Ligand;
    }

    ResidueKind kindOf(std::int32_t r)
    {
        const Members members = membersOf(r);
        const NameClass name = names_[std::size_t(r)];
        if (at(r).name.empty() && structure_.hasRadii) return ResidueKind::Bead;
        if (name == NameClass::AminoAcid) return linkKind(r, ResidueKind::Protein);
        const Composition all = compositionOf(members);
        if (all.atoms == 0 && members.size() > 0) return ResidueKind::Particle;
        const bool chainName = at(r).name.size() < 3 && !at(r).hetatm && all.ionic == 0;
        if (name == NameClass::Nucleotide && (chainName || members.has("P") || members.hasPrimed()))
            return linkKind(r, ResidueKind::Nucleic);
        const bool waterName = name == NameClass::Water || at(r).entity == EntityHint::Water;
        if (waterName && all.carbons == 0 && all.oxygens <= 1 && all.others == 0)
            return ResidueKind::Water;
        if (all.ionic == all.atoms && all.oneElement && (all.atoms == 1 || name == NameClass::Ion))
            return ResidueKind::Ion;
        if (at(r).entity != EntityHint::Other && isBonded(r)) return ResidueKind::Modified;
        if (name == NameClass::ModifiedAminoAcid || name == NameClass::ModifiedNucleotide ||
            name == NameClass::Cap)
            return linkKind(r, ResidueKind::Modified);
        const ResidueKind known = moleculeKind(name, members, all);
        // Glycans are polymers in files of before July 2020.
        if (at(r).entity == EntityHint::Polymer && known != ResidueKind::Sugar)
            return ResidueKind::Modified;
        if (known != ResidueKind::Ligand) return known;
        const bool link = at(r).entity == EntityHint::None && isFlanked(r);
        return link ? ResidueKind::Modified : ResidueKind::Ligand;
    }

    /// The kind of what is no link of a chain.
    static ResidueKind moleculeKind(NameClass name, const Members& members, const Composition& all)
    {
        constexpr std::size_t largestSolvent = 7; // heavy atoms
        if (name == NameClass::Buffer ||
            (name == NameClass::Solvent && all.atoms - all.hydrogens <= largestSolvent))
            return ResidueKind::Buffer;
        if (name == NameClass::Lipid) return ResidueKind::Lipid;
        if (name == NameClass::LongLipid && isLongLipid(all)) return ResidueKind::Lipid;
        if (name == NameClass::CutLipid && isCutLipid(all)) return ResidueKind::Lipid;
        if (name == NameClass::AmberLipid && (members.has("P31") || isTail(members, all)))
            return ResidueKind::Lipid;
        if (name == NameClass::Sugar) return ResidueKind::Sugar;
        if (all.oxygens == 1 && all.hydrogens == 2 && all.atoms == 3) return ResidueKind::Water;
        const bool ring = members.has("C1") && members.has("C2") && members.has("C3") &&
                          members.has("C4") && members.has("C5") && members.has("O5") &&
                          members.has("O3", "O4");
        if (name == NameClass::Unknown && ring && all.carbons <= 12 &&
            2 * all.oxygens >= all.carbons)
            return ResidueKind::Sugar;
        return ResidueKind::Ligand;
    }

    /// Whether a molecule with the cut name of a lipid is one: it has no metal or halogen, at most
    /// one nitrogen and phosphorus, and a tail.
    static bool isCutLipid(const Composition& all)
    {
        constexpr std::size_t least = 6, withoutPhosphate = 10; // carbons
        return all.ionic == 0 && all.nitrogens <= 1 && all.phosphorus <= 1 &&
               all.carbons >= (all.phosphorus > 0 ? least : withoutPhosphate);
    }

    /// Whether a molecule with the name of a lipid of long tails is one: it is mostly carbon, up to
    /// the head of a ganglioside.
    static bool isLongLipid(const Composition& all)
    {
        constexpr std::size_t least = 20, mostNitrogens = 3;
        const std::size_t polar = all.atoms - all.hydrogens - all.carbons;
        return all.ionic == 0 && all.nitrogens <= mostNitrogens && all.carbons >= least &&
               all.carbons >= 2 * polar;
    }

    /// A tail of Amber's lipids: hydrocarbon, or an acyl group.
    static bool isTail(const Members& members, const Composition& all)
    {
        constexpr std::size_t least = 11;
        return all.carbons >= least && all.others == 0 && all.oxygens <= 1 && members.has("C12");
    }

    Structure& structure_;
    std::vector<std::size_t> begin_;            ///< of the atoms of each residue in `order_`
    std::vector<std::int32_t> order_;           ///< atoms by residue
    std::vector<NameClass> names_;              ///< one a residue
    std::vector<std::int32_t> previous_, next_; ///< one a residue; -1: none
    std::unordered_map<std::string, NameClass> known_;
};

} // namespace

bool isIonic(std::uint8_t z)
{
    const bool nonmetal = z <= 2 || (z >= 5 && z <= 8) || z == 10 || (z >= 14 && z <= 16) ||
                          z == 18 || (z >= 32 && z <= 34) || z == 36 || z == 52 || z == 54;
    return !nonmetal;
}

string_view kindWord(ResidueKind kind)
{
    constexpr string_view words[] = {"protein", "nucleic", "modified", "water",    "ion", "buffer",
                                     "lipid",   "sugar",   "ligand",   "particle", "bead"};
    return words[std::size_t(kind)];
}

void classifyResidues(Structure& structure)
{
    Classifier(structure).run();
}

} // namespace molsurf
