// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/selection_words.h"

#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/structure/element.h"
#include "molsurf/molecule/structure/residue_names.h"

#include <algorithm>
#include <limits>
#include <unordered_map>

namespace molsurf
{
namespace
{

using std::string_view;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Kind of a residue by its name, for one that is modified or a bead.
std::optional<ResidueKind> kindByName(const std::string& name)
{
    switch (nameClass(name)) {
    case NameClass::AminoAcid:
    case NameClass::ModifiedAminoAcid:
    case NameClass::Cap:
        return ResidueKind::Protein;
    case NameClass::Nucleotide:
    case NameClass::ModifiedNucleotide:
        return ResidueKind::Nucleic;
    case NameClass::Ion:
        return ResidueKind::Ion;
    case NameClass::Lipid:
    case NameClass::LongLipid:
    case NameClass::CutLipid:
        return ResidueKind::Lipid;
    case NameClass::Sugar:
        return ResidueKind::Sugar;
    default:
        return {};
    }
}

/// Whether an atom is one that nucleotides alone have.
bool isOfNucleotide(const std::string& name)
{
    return name == "P" ||
           (name.size() == 3 && name.substr(0, 2) == "C1" && (name[2] == '\'' || name[2] == '*'));
}

template<std::size_t count>
bool isOneOf(string_view name, const char* const (&names)[count])
{
    return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

bool isProtein(const SelectionFacts& facts, const Atom& atom)
{
    return facts.kindOf(atom) == ResidueKind::Protein;
}

bool isNucleic(const SelectionFacts& facts, const Atom& atom)
{
    return facts.kindOf(atom) == ResidueKind::Nucleic;
}

bool isPolymer(const SelectionFacts& facts, const Atom& atom)
{
    return isProtein(facts, atom) || isNucleic(facts, atom) ||
           facts.kindOf(atom) == ResidueKind::Bead;
}

template<ResidueKind kind>
bool isKind(const SelectionFacts& facts, const Atom& atom)
{
    return facts.kindOf(atom) == kind;
}

bool isHydrogen(const SelectionFacts&, const Atom& atom)
{
    return atom.element == 1;
}

bool isOther(const SelectionFacts& facts, const Atom& atom)
{
    return !isPolymer(facts, atom) && facts.kindOf(atom) != ResidueKind::Water;
}

bool isBackbone(const SelectionFacts& facts, const Atom& atom)
{
    static constexpr const char* protein[] = {"N", "CA", "C", "O", "BB"};
    static constexpr const char* nucleic[] = {"P",   "OP1", "OP2", "OP3", "O1P", "O2P",
                                              "O3P", "O5'", "C5'", "C4'", "C3'", "O3'",
                                              "O5*", "C5*", "C4*", "C3*", "O3*"};
    return (isProtein(facts, atom) && isOneOf(atom.name, protein)) ||
           (isNucleic(facts, atom) && isOneOf(atom.name, nucleic));
}

bool isSidechain(const SelectionFacts& facts, const Atom& atom)
{
    static constexpr const char* ends[] = {"OXT", "H", "HN", "H1", "H2", "H3", "HT1", "HT2", "HT3"};
    return isProtein(facts, atom) && !isBackbone(facts, atom) && !isOneOf(atom.name, ends);
}

const ClassWord classWords[] = {
    {"all *", [](const SelectionFacts&, const Atom&) { return true; }},
    {"none", [](const SelectionFacts&, const Atom&) { return false; }},
    {"protein polymer.protein", isProtein},
    {"nucleic polymer.nucleic", isNucleic},
    {"polymer pol.", isPolymer},
    {"backbone bb.", isBackbone},
    {"sidechain sc.", isSidechain},
    {"calpha", [](const SelectionFacts& facts,
                  const Atom& atom) { return isProtein(facts, atom) && atom.name == "CA"; }},
    {"water waters solvent sol.", isKind<ResidueKind::Water>},
    {"ion ions", isKind<ResidueKind::Ion>},
    {"ligand ligands", isKind<ResidueKind::Ligand>},
    {"sugar sugars", isKind<ResidueKind::Sugar>},
    {"lipid lipids", isKind<ResidueKind::Lipid>},
    {"buffer buffers", isKind<ResidueKind::Buffer>},
    {"modified",
     [](const SelectionFacts& facts, const Atom& atom) {
         return residueOf(facts.structure(), atom).kind == ResidueKind::Modified;
     }},
    {"organic org.",
     [](const SelectionFacts& facts, const Atom& atom) {
         return isOther(facts, atom) && facts.hasCarbon(atom);
     }},
    {"inorganic ino.",
     [](const SelectionFacts& facts, const Atom& atom) {
         return isOther(facts, atom) && !facts.hasCarbon(atom);
     }},
    {"hetatm het", [](const SelectionFacts& facts,
                      const Atom& atom) { return residueOf(facts.structure(), atom).hetatm; }},
    {"hydrogen hydrogens hydro h.", isHydrogen},
    {"heavy noh", [](const SelectionFacts& facts, const Atom& atom) {
         return !isHydrogen(facts, atom) && atom.role == AtomRole::Atom;
     }}};

string_view chainOf(const Structure& s, const Atom& atom)
{
    return s.chains[std::size_t(residueOf(s, atom).chain)];
}

/// Columns 73-76 of a PDB file and segments of a .psf; empty: there are none.
string_view segmentOf(const Structure& s, const Atom& atom)
{
    const std::int32_t segment = residueOf(s, atom).segment;
    return segment < 0 ? string_view() : string_view(s.segments[std::size_t(segment)]);
}

string_view segidOf(const Structure& s, const Atom& atom)
{
    const string_view segment = segmentOf(s, atom);
    return segment.empty() ? chainOf(s, atom) : segment;
}

string_view asymOf(const Structure& s, const Atom& atom)
{
    const string_view segment = segmentOf(s, atom);
    return segment.empty() ? string_view(s.asyms[std::size_t(residueOf(s, atom).asym)]) : segment;
}

string_view altlocOf(const Structure&, const Atom& atom)
{
    return string_view(&atom.altloc, atom.altloc == '\0' ? 0 : 1);
}

const Atom& atomAt(const SelectionFacts& facts, std::size_t i)
{
    return facts.structure().atoms[i];
}

double serialOf(const SelectionFacts& facts, std::size_t i)
{
    const auto& serials = facts.structure().serials;
    return serials.empty() ? facts.indexOf(i) + 1 : serials[i];
}

double chargeOf(const SelectionFacts& facts, std::size_t i)
{
    const auto& charges = facts.structure().charges;
    return charges.empty() ? nan : double(charges[i]);
}

template<int axis>
double coordinateOf(const SelectionFacts& facts, std::size_t i)
{
    return double(float(atomAt(facts, i).position[axis]));
}

const PropertyWord propertyWords[] = {
    {"chain chainid c.", "the name of a chain", true, chainOf, nullptr},
    {"segid segname segment", "the name of a segment or chain", true, segidOf, nullptr},
    {"segi s.", "the name of a segment", true, asymOf, nullptr},
    {"resname resn r.", "the name of a residue", true,
     [](const Structure& s, const Atom& atom) -> string_view { return residueOf(s, atom).name; },
     nullptr},
    {"name atomname n.", "the name of an atom", true,
     [](const Structure&, const Atom& atom) -> string_view { return atom.name; }, nullptr},
    {"element elem e.", "the symbol of an element", true,
     [](const Structure&, const Atom& atom) -> string_view { return elementSymbol(atom.element); },
     nullptr, true},
    {"alt altloc", "an alternate location", true, altlocOf, nullptr},
    {"resid resi resnum i.", "the number of a residue", true, nullptr,
     [](const SelectionFacts& f, std::size_t i) {
         return double(residueOf(f.structure(), atomAt(f, i)).number);
     },
     false, true},
    {"index", "the place of an atom from 0", true, nullptr,
     [](const SelectionFacts& f, std::size_t i) { return double(f.indexOf(i)); }},
    {"bynum", "the place of an atom from 1", true, nullptr,
     [](const SelectionFacts& f, std::size_t i) { return f.indexOf(i) + 1.0; }},
    {"serial id", "the number of an atom in the file", true, nullptr, serialOf},
    {"b beta bfactor tempfactor", "a B factor", false, nullptr,
     [](const SelectionFacts& f, std::size_t i) { return double(atomAt(f, i).bFactor); }},
    {"q occupancy occ", "an occupancy", false, nullptr,
     [](const SelectionFacts& f, std::size_t i) { return double(atomAt(f, i).occupancy); }},
    {"charge partial_charge pc.", "a charge", false, nullptr, chargeOf},
    {"x", "a coordinate", false, nullptr, coordinateOf<0>, false, false, true},
    {"y", "a coordinate", false, nullptr, coordinateOf<1>, false, false, true},
    {"z", "a coordinate", false, nullptr, coordinateOf<2>, false, false, true}};

using Does = SelectionOperator;

const OperatorWord operatorWords[] = {{"and & &&", Does::And},
                                      {"or | ||", Does::Or},
                                      {"not !", Does::Not},
                                      {"prop", Does::Value},
                                      {"same", Does::SameAs},
                                      {"byres byresidue byresi br.", Does::SameAs, "residue"},
                                      {"bychain bc.", Does::SameAs, "chain"},
                                      {"bysegment byseg bs.", Does::SameAs, "segi"},
                                      {"within w.", Does::Within, nullptr, true},
                                      {"exwithin near_to nto.", Does::Within},
                                      {"beyond be.", Does::Beyond, nullptr, true},
                                      {"around a.", Does::Around},
                                      {"expand x.", Does::Around, nullptr, true}};

/// Calls f(word) for each form of a row.
template<typename F>
void forEachForm(string_view words, const F& f)
{
    while (!words.empty()) {
        const std::size_t end = std::min(words.find(' '), words.size());
        f(words.substr(0, end));
        words.remove_prefix(std::min(end + 1, words.size()));
    }
}

using Words = std::unordered_map<std::string, SelectionWord>;

Words allWords()
{
    Words out;
    for (const ClassWord& row : classWords)
        forEachForm(row.words, [&](string_view w) { out[std::string(w)].isClass = &row; });
    for (const PropertyWord& row : propertyWords)
        forEachForm(row.words, [&](string_view w) { out[std::string(w)].isProperty = &row; });
    for (const OperatorWord& row : operatorWords)
        forEachForm(row.words, [&](string_view w) { out[std::string(w)].isOperator = &row; });
    return out;
}

const Words& words()
{
    static const Words all = allWords();
    return all;
}

} // namespace

SelectionFacts::SelectionFacts(const Structure& structure) : structure_(structure)
{
    const std::size_t residues = structure.residues.size();
    std::vector<char> nucleotides(residues);
    carbons_.resize(residues);
    for (const Atom& atom : structure.atoms) {
        carbons_[std::size_t(atom.residue)] |= char(atom.element == carbonElement);
        nucleotides[std::size_t(atom.residue)] |= char(isOfNucleotide(atom.name));
    }
    for (std::size_t r = 0; r < residues; ++r) {
        const Residue& residue = structure.residues[r];
        ResidueKind kind = residue.kind;
        if (kind == ResidueKind::Bead) kind = kindByName(residue.name).value_or(kind);
        if (kind == ResidueKind::Modified) {
            const auto named = kindByName(residue.name);
            const bool link = named == ResidueKind::Protein || named == ResidueKind::Nucleic;
            kind = link ? *named : nucleotides[r] ? ResidueKind::Nucleic : ResidueKind::Protein;
        }
        kinds_.push_back(kind);
    }
}

const Model& SelectionFacts::modelOf(std::size_t atom) const
{
    const auto& models = structure_.models;
    return *std::prev(
        std::upper_bound(models.begin(), models.end(), atom,
                         [](std::size_t i, const Model& model) { return i < model.begin; }));
}

std::optional<SelectionWord> selectionWord(string_view text)
{
    const auto found = words().find(lowered(std::string(text)));
    if (found == words().end()) return {};
    return found->second;
}

std::string foreignWord(string_view text)
{
    static const std::vector<Synonyms> words = {
#include "molsurf/molecule/selection/foreign_words.inc"
    };
    return meaningOf(std::string(text), words);
}

const std::vector<std::string>& selectionWords()
{
    static const std::vector<std::string> names = [] {
        std::vector<std::string> out;
        for (const auto& [word, row] : words())
            if (word.size() > 1 && word.find_first_of(".&|") == std::string::npos)
                out.push_back(word);
        std::sort(out.begin(), out.end());
        return out;
    }();
    return names;
}

} // namespace molsurf
