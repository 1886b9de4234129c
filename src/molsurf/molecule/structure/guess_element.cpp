// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/guess_element.h"

#include "molsurf/molecule/structure/element.h"
#include "molsurf/molecule/structure/residue_names.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <gemmi/elem.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace molsurf
{
namespace
{

using std::string_view;

bool isCapital(char c)
{
    return std::isupper(static_cast<unsigned char>(c)) != 0;
}

/// The first letters of a name, without digits before them: "1HB" -> "HB".
string_view lettersOf(string_view name)
{
    std::size_t begin = 0;
    while (begin < name.size() && !isLetter(name[begin])) ++begin;
    std::size_t end = begin;
    while (end < name.size() && isLetter(name[end])) ++end;
    return name.substr(begin, end - begin);
}

std::uint8_t firstLetter(string_view letters)
{
    return letters.empty() ? 0 : elementNumber(std::string(letters.substr(0, 1)));
}

/// Whether a word, in capitals, is one of a list that blanks separate.
bool isIn(string_view list, string_view word)
{
    std::string padded = " ";
    for (const char c : word) padded += char(std::toupper(static_cast<unsigned char>(c)));
    return list.find(padded + " ") != string_view::npos;
}

/// Residues with a metal in a ring of four nitrogens, which are named NA to ND.
bool isPorphyrin(string_view residue)
{
    return isIn(" HEM HEME HEMO HEMC HEA HEB HEC HED HEO HAS HDD HDE HDM HEV HNI HCO HIF FDE VEA "
                "VER ZNH MNH MNR COH CLA CHL BCL BCB PHO BPH CL0 CLB B12 CNC COB F43 ",
                residue);
}

/// Elements of amino acids, nucleotides and waters: the first letter, and selenium.
std::uint8_t ofPolymer(string_view letters)
{
    if (letters.substr(0, 2) == "SE") return elementNumber("Se");
    switch (letters.empty() ? ' ' : letters[0]) {
    case 'C':
    case 'N':
    case 'O':
    case 'S':
    case 'P':
    case 'H':
    case 'D':
        return firstLetter(letters);
    default:
        return 0;
    }
}

/// The element of an ion: that of its residue, or in the residue ION that of its name.
std::uint8_t ofIon(const ElementEvidence& evidence)
{
    const string_view residue = evidence.residue, atom = evidence.atom;
    if (nameClass(residue) != NameClass::Ion) return 0;
    const std::uint8_t ofName = ionElement(atom);
    if (residue == "ION" || residue == "IB") return ofName;
    const std::uint8_t ofResidue = ionElement(residue);
    const string_view letters = lettersOf(atom);
    const bool agree = ofName == ofResidue || atom == residue || firstLetter(letters) == ofResidue;
    return agree ? ofResidue : 0;
}

/// Symbols of two letters that are read as such in any molecule. Those that name another atom more
/// often (CA, CD, HG, NA, OS, ...) are not among them.
bool isPlainSymbol(string_view letters)
{
    return isIn(" CL BR FE ZN MG MN SI SE AS AL AG AU LI LA LU RB RH RU RE PT TI TL TB TE TM GA GD "
                "GE ZR MO IR XE KR EU ER YB CU AR NI TH ",
                letters);
}

/// Symbols of two letters that are read as such only if the name's place says so.
bool isPossibleSymbol(string_view letters)
{
    return isIn(" CA CD CE CO CS NA NB ND NE HG HO HF OS PB PD BA BE BI IN SB SM SN SR SC CR ",
                letters);
}

std::uint8_t ofTwoLetters(const ElementEvidence& evidence)
{
    const string_view letters = lettersOf(evidence.atom);
    const bool first = !evidence.atom.empty() && isLetter(evidence.atom[0]);
    if (letters.size() != 2 || !first) return 0;
    const std::string symbol(letters);
    if (isPlainSymbol(letters)) return elementNumber(symbol);
    if (evidence.inFirstColumn && isPossibleSymbol(letters)) return elementNumber(symbol);
    // A molecule that is named by its metal: "CO" of CO3, "CD" of CD1.
    const bool named = evidence.residue.substr(0, 2) == letters &&
                       (evidence.residue.size() == 2 || !isLetter(evidence.residue[2]));
    return named ? elementNumber(symbol) : 0;
}

std::uint8_t ofMass(double mass)
{
    constexpr double tolerance = 1e-3;
    if (!(mass > 0.5)) return 0;
    for (int z = 1; z <= maxElement; ++z) {
        const double weight = gemmi::molecular_weight(static_cast<gemmi::El>(z));
        if (weight > 0.0 && std::abs(mass - weight) < tolerance * weight) return std::uint8_t(z);
    }
    constexpr double deuterium = 2.014;
    return std::abs(mass - deuterium) < tolerance * deuterium ? 1 : 0;
}

/// Whether a mass can be that of the element that it is next to. It cannot be, as simulations move
/// mass from heavy atoms to their hydrogens, where the name begins with another common element.
bool agree(std::uint8_t ofMass, string_view atom)
{
    const string_view letters = lettersOf(atom);
    const std::uint8_t first = ofPolymer(letters);
    if (first == 0 || ofMass == first || ofMass == ionElement(atom)) return true;
    constexpr std::uint8_t helium = 2;
    return elementSymbol(ofMass)[0] == char(std::toupper(static_cast<unsigned char>(letters[0]))) &&
           ofMass != helium;
}

} // namespace

std::uint8_t guessElement(const ElementEvidence& evidence)
{
    const string_view letters = lettersOf(evidence.atom);
    if (letters.empty()) return ofMass(evidence.mass);
    if (const std::uint8_t ion = ofIon(evidence)) return ion;
    const NameClass kind = nameClass(evidence.residue);
    if (kind == NameClass::AminoAcid || kind == NameClass::ModifiedAminoAcid ||
        kind == NameClass::Nucleotide || kind == NameClass::Cap || kind == NameClass::Water) {
        if (const std::uint8_t element = ofPolymer(letters)) return element;
    }
    if (isPorphyrin(evidence.residue) && isIn(" NA NB NC ND ", letters))
        return firstLetter(letters);
    if (isPorphyrin(evidence.residue) && letters == "CO") return elementNumber("Co");
    const std::uint8_t weighed = ofMass(evidence.mass);
    if (weighed != 0 && agree(weighed, evidence.atom)) return weighed;
    if (const std::uint8_t element = ofTwoLetters(evidence)) return element;
    if (const std::uint8_t element = firstLetter(letters)) return element;
    const string_view two = letters.substr(0, 2); // "ZND"
    return isPlainSymbol(two) ? elementNumber(std::string(two)) : 0;
}

std::uint8_t guessElement(const std::string& atomName, const std::string& residueName)
{
    return guessElement(ElementEvidence{atomName, residueName});
}

bool isMisread(std::uint8_t element, string_view atom, string_view residue)
{
    const string_view symbol = elementSymbol(element);
    if (symbol.size() != 2 || element == elementNumber("Se") || isPlainSymbol(symbol)) return false;
    const string_view two = lettersOf(atom).substr(0, 2);
    return isStandardResidue(residue) && elementNumber(std::string(two)) == element &&
           ofPolymer(two) != 0;
}

std::uint8_t elementOfForceFieldType(string_view type)
{
    if (type.empty() || !isLetter(type[0])) return 0;
    if (type == "cl" || type == "br") return elementNumber(std::string(type)); // GAFF
    if (type.substr(0, 3) == "CLG" || type.substr(0, 3) == "BRG" || type.substr(0, 3) == "ALG")
        return elementNumber(std::string(type.substr(0, 2))); // CGenFF
    struct AmberType {
        string_view type;
        const char* symbol;
    };
    constexpr AmberType amber[] = {{"C0", "Ca"},  {"IM", "Cl"},  {"IP", "Na"},  {"IB", "I"},
                                   {"MG", "Mg"},  {"FE", "Fe"},  {"ZN", "Zn"},  {"CU", "Cu"},
                                   {"CL", "Cl"},  {"BR", "Br"},  {"Na+", "Na"}, {"K+", "K"},
                                   {"Li+", "Li"}, {"Cs+", "Cs"}, {"Rb+", "Rb"}, {"Cl-", "Cl"}};
    for (const AmberType& row : amber)
        if (type == row.type) return elementNumber(row.symbol);
    constexpr string_view light = "HCNOSPFI";
    const char first = char(std::toupper(static_cast<unsigned char>(type[0])));
    if (light.find(first) == string_view::npos) return 0;
    // Types of GAFF are of small letters, Amber's of capitals and digits; "Ca" is SYBYL's calcium.
    if (isCapital(type[0]) && type.size() > 1 && isLetter(type[1]) && !isCapital(type[1])) return 0;
    return elementNumber(std::string(1, first));
}

std::uint8_t elementOfAutoDockType(string_view type)
{
    const bool symbol = type.size() == 2 && isCapital(type[0]) && !isCapital(type[1]);
    const std::uint8_t ofSymbol = symbol ? elementNumber(std::string(type)) : 0;
    if (ofSymbol != 0) return ofSymbol; // "Na" is no acceptor
    std::string capitals;
    for (const char c : type) capitals += char(std::toupper(static_cast<unsigned char>(c)));
    struct Type {
        string_view name;
        const char* symbol;
    };
    constexpr Type types[] = {{"A", "C"},   {"OA", "O"},  {"OS", "O"}, {"NA", "N"},  {"NS", "N"},
                              {"SA", "S"},  {"HD", "H"},  {"HS", "H"}, {"CG0", "C"}, {"CG1", "C"},
                              {"CG2", "C"}, {"CG3", "C"}, {"CX", "C"}, {"OX", "O"},  {"NX", "N"},
                              {"SX", "S"},  {"HX", "H"}};
    for (const Type& row : types)
        if (capitals == row.name) return elementNumber(row.symbol);
    return elementNumber(capitals);
}

bool isParticleSymbol(string_view symbol)
{
    return isIn(" EP LP VS DU XP MW BQ ", symbol);
}

bool isParticleName(string_view atom)
{
    const string_view letters = lettersOf(atom);
    if (letters.empty() || letters.data() != atom.data()) return false;
    return isIn(" EP EPW LP LPA LPB LPX VS ", letters) || atom.substr(0, 3) == "LPO" ||
           atom.substr(0, 3) == "LPN" || atom.substr(0, 3) == "LPS";
}

bool isMark(string_view residue, string_view atom)
{
    if (atom == "QSS") return true;                                               // HOLE
    if (residue == "STP") return isIn(" POL APOL H C O ", atom);                  // fpocket, P2Rank
    if (residue == "FIL" || residue == "TUN") return isIn(" H X FIL TUN ", atom); // CAVER, MOLE
    return residue == "SPH" && isIn(" QC1 QC2 ", atom);                           // HOLE
}

} // namespace molsurf
