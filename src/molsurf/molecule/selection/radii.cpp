// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/radii.h"

#include "molsurf/atoms.h"
#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/selection/ball_names.h"
#include "molsurf/molecule/selection/select_balls.h"
#include "molsurf/molecule/structure/guess_element.h"
#include "molsurf/molecule/structure/load_text.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <string_view>
#include <vector>

namespace molsurf
{
namespace
{

using std::string_view;

// A. Bondi, van der Waals volumes and radii, J. Phys. Chem. 68 (1964) 441, doi 10.1021/j100785a001.
constexpr string_view bondi{
    "H 1.20 He 1.40 Li 1.82 C 1.70 N 1.55 O 1.52 F 1.47 Ne 1.54 Na 2.27 Mg 1.73 "
    "Si 2.10 P 1.80 S 1.80 Cl 1.75 Ar 1.88 K 2.75 Ni 1.63 Cu 1.40 Zn 1.39 "
    "Ga 1.87 As 1.85 Se 1.90 Br 1.85 Kr 2.02 Pd 1.63 Ag 1.72 Cd 1.58 In 1.93 "
    "Sn 2.17 Te 2.06 I 1.98 Xe 2.16 Pt 1.75 Au 1.66 Hg 1.55 Tl 1.96 Pb 2.02 "
    "U 1.86"};

// M. Mantina et al., Consistent van der Waals radii for the whole main group, J. Phys. Chem. A 113
// (2009) 5806, doi 10.1021/jp8111556, table 12: only the elements that Bondi lacks.
constexpr string_view mantina{
    "Be 1.53 B 1.92 Al 1.84 Ca 2.31 Ge 2.11 Rb 3.03 Sr 2.49 Sb 2.06 Cs 3.43 "
    "Ba 2.68 Bi 2.07 Po 1.97 At 2.02 Rn 2.20 Fr 3.48 Ra 2.83"};

// S. Alvarez, A cartography of the van der Waals territories, Dalton Trans. 42 (2013) 8617,
// doi 10.1039/c3dt50599e.
constexpr string_view alvarez{
    "H 1.20 He 1.43 Li 2.12 Be 1.98 B 1.91 C 1.77 N 1.66 O 1.50 F 1.46 Ne 1.58 Na 2.50 Mg 2.51 "
    "Al 2.25 Si 2.19 P 1.90 S 1.89 Cl 1.82 Ar 1.83 K 2.73 Ca 2.62 Sc 2.58 Ti 2.46 V 2.42 Cr 2.45 "
    "Mn 2.45 Fe 2.44 Co 2.40 Ni 2.40 Cu 2.38 Zn 2.39 Ga 2.32 Ge 2.29 As 1.88 Se 1.82 Br 1.86 "
    "Kr 2.25 Rb 3.21 Sr 2.84 Y 2.75 Zr 2.52 Nb 2.56 Mo 2.45 Tc 2.44 Ru 2.46 Rh 2.44 Pd 2.15 "
    "Ag 2.53 Cd 2.49 In 2.43 Sn 2.42 Sb 2.47 Te 1.99 I 2.04 Xe 2.06 Cs 3.48 Ba 3.03 La 2.98 "
    "Ce 2.88 Pr 2.92 Nd 2.95 Sm 2.90 Eu 2.87 Gd 2.83 Tb 2.79 Dy 2.87 Ho 2.81 Er 2.83 Tm 2.79 "
    "Yb 2.80 Lu 2.74 Hf 2.63 Ta 2.53 W 2.57 Re 2.49 Os 2.48 Ir 2.41 Pt 2.29 Au 2.32 Hg 2.45 "
    "Tl 2.47 Pb 2.60 Bi 2.54 Ac 2.80 Th 2.93 Pa 2.88 U 2.71 Np 2.82 Pu 2.81 Am 2.83 Cm 3.05 "
    "Bk 3.40 Cf 3.05 Es 2.70"};

/// Beads of a Martini force field by size.
struct Martini {
    const char* name;
    double sigma[3];    ///< of regular, small and tiny beads [Å]
    string_view sizes;  ///< by residue: the sizes R, S, T of BB, SC1, SC2, ...
    string_view others; ///< by bead, in any residue
};

constexpr string_view martiniSizes = "RST";

// L. Monticelli et al., The MARTINI coarse-grained force field: extension to proteins, J. Chem.
// Theory Comput. 4 (2008) 819, doi 10.1021/ct700324x; D. H. de Jong et al., Improved parameters for
// the Martini coarse-grained protein force field, J. Chem. Theory Comput. 9 (2013) 687,
// doi 10.1021/ct300646g: rings are of small beads. Tiny beads are those of nucleic acids, J. J.
// Uusitalo et al., J. Chem. Theory Comput. 11 (2015) 3932, doi 10.1021/acs.jctc.5b00286.
constexpr Martini martini2{"martini2",
                           {4.7, 4.3, 3.2},
                           "HIS RSSS HSD RSSS HSE RSSS HSP RSSS PHE RSSS TYR RSSS TRP RSSSS "
                           "DA RTTTT DC RTTT DG RTTTT DT RTTT A RTTTT C RTTT G RTTTT U RTTT",
                           "ROH S R1 S R2 S R3 S R4 S R5 S BB2 S BB3 S"};

// P. C. T. Souza et al., Martini 3: a general purpose force field for coarse-grained molecular
// dynamics, Nat. Methods 18 (2021) 382, doi 10.1038/s41592-021-01098-3.
constexpr Martini martini3{"martini3",
                           {4.7, 4.1, 3.4},
                           "GLY S ALA ST CYS RT VAL SS LEU RS ILE RS PRO SS ASN RS ASP RS THR RS "
                           "SER RT LYS RSS ARG RSS HIS RTTT HSD RTTT HSE RTTT HSP RTTT HID RTTT "
                           "HIE RTTT HIP RTTT PHE RSTT TYR RTTTT TRP RTTTTT",
                           "SW S TW T GL1 S NA T NA+ T CL T CL- T"};

/// The radius at which two equal beads touch where their Lennard-Jones potential is least:
/// r = 2^(1/6) sigma / 2 [Å].
double beadRadius(const Martini& martini, char size)
{
    return 0.5 * std::pow(2.0, 1.0 / 6.0) * martini.sigma[martiniSizes.find(size)];
}

/// Radii of beads. The n-th letter of a residue is the size of its n-th bead: BB, SC1, SC2, ...
RadiiSet martiniSet(const Martini& martini)
{
    RadiiSet set;
    set.name = martini.name;
    const Fields residues = splitFields(martini.sizes), beads = splitFields(martini.others);
    for (std::size_t i = 0; i + 1 < residues.size(); i += 2) {
        const string_view sizes = residues[i + 1];
        for (std::size_t k = 0; k < sizes.size(); ++k) {
            const std::string bead = k == 0 ? "BB" : "SC" + std::to_string(k);
            set.atoms[{std::string(residues[i]), bead}] = beadRadius(martini, sizes[k]);
        }
    }
    for (std::size_t i = 0; i + 1 < beads.size(); i += 2) {
        set.atoms[{"*", std::string(beads[i])}] = beadRadius(martini, beads[i + 1][0]);
    }
    set.otherwise = beadRadius(martini, 'R');
    return set;
}

/// The types of the heavy atoms of residues, which stand for their hydrogens, too: carbon with
/// three neighbours (c; d with a hydrogen) or four (q), nitrogen (n; l with four neighbours),
/// oxygen with one (o) or two (h), sulfur (s), selenium (e), phosphorus (p). Atom and type in turn.
struct AtomTypes {
    const char* residue;
    string_view types;
};

constexpr string_view proteinBackbone = "N n CA q C c O o OXT h OT1 o OT2 h";
constexpr AtomTypes aminoAcids[] = {
    {"ALA", "CB q"},
    {"ARG", "CB q CG q CD q NE n CZ c NH1 n NH2 n"},
    {"ASN", "CB q CG c OD1 o ND2 n"},
    {"ASP", "CB q CG c OD1 o OD2 h"},
    {"CYS", "CB q SG s"},
    {"GLN", "CB q CG q CD c OE1 o NE2 n"},
    {"GLU", "CB q CG q CD c OE1 o OE2 h"},
    {"GLY", ""},
    {"HIS", "CB q CG c ND1 n CD2 d CE1 d NE2 n"},
    {"ILE", "CB q CG1 q CG2 q CD1 q CD q"},
    {"LEU", "CB q CG q CD1 q CD2 q"},
    {"LYS", "CB q CG q CD q CE q NZ l"},
    {"MET", "CB q CG q SD s CE q"},
    {"PHE", "CB q CG c CD1 d CD2 d CE1 d CE2 d CZ d"},
    {"PRO", "CB q CG q CD q"},
    {"SER", "CB q OG h"},
    {"THR", "CB q OG1 h CG2 q"},
    {"TRP", "CB q CG c CD1 d CD2 c NE1 n CE2 c CE3 d CZ2 d CZ3 d CH2 d"},
    {"TYR", "CB q CG c CD1 d CD2 d CE1 d CE2 d CZ c OH h"},
    {"VAL", "CB q CG1 q CG2 q"},
    {"MSE", "CB q CG q SE e CE q"},
    {"SEC", "CB q SE e"},
};

constexpr string_view nucleicBackbone =
    "P p OP1 o OP2 h OP3 h O1P o O2P h O3P h O5' h C5' q C4' q O4' h C3' q O3' h C2' q C1' q O2' h";
constexpr AtomTypes nucleotides[] = {
    {"A", "N9 n C8 d N7 n C5 c C6 c N6 n N1 n C2 d N3 n C4 c"},
    {"G", "N9 n C8 d N7 n C5 c C6 c O6 o N1 n C2 c N2 n N3 n C4 c"},
    {"C", "N1 n C2 c O2 o N3 n C4 c N4 n C5 d C6 d"},
    {"U", "N1 n C2 c O2 o N3 n C4 c O4 o C5 d C6 d"},
    {"T", "N1 n C2 c O2 o N3 n C4 c O4 o C5 c C7 q C6 d C5M q"},
    {"I", "N9 n C8 d N7 n C5 c C6 c O6 o N1 n C2 d N3 n C4 c"},
};

/// Radii by type [Å], of proteins and of nucleic acids.
struct UnitedAtoms {
    const char* name;
    string_view protein, nucleic;
};

// J. Tsai, R. Taylor, C. Chothia, M. Gerstein, The packing density in proteins: standard radii and
// volumes, J. Mol. Biol. 290 (1999) 253, doi 10.1006/jmbi.1999.2829; nucleotides, selenium and
// phosphorus by the same types as FreeSASA has them (S. Mitternacht, F1000Research 5 (2016) 189).
constexpr UnitedAtoms protor{
    "protor", "c 1.61 d 1.76 q 1.88 n 1.64 l 1.64 o 1.42 h 1.46 s 1.77 e 1.90 p 1.80",
    "c 1.61 d 1.76 q 1.88 n 1.64 l 1.64 o 1.42 h 1.46 s 1.77 e 1.90 p 1.80"};

// S. J. Hubbard, J. M. Thornton, NACCESS, University College London (1993); its proteins are those
// of C. Chothia, The nature of the accessible and buried surfaces in proteins, J. Mol. Biol. 105
// (1976) 1, doi 10.1016/0022-2836(76)90191-1.
constexpr UnitedAtoms naccess{
    "naccess", "c 1.76 d 1.76 q 1.87 n 1.65 l 1.50 o 1.40 h 1.40 s 1.85 e 1.80 p 1.90",
    "c 1.80 d 1.80 q 1.80 n 1.60 l 1.60 o 1.40 h 1.40 s 1.85 e 1.80 p 1.90"};

/// Radii of heavy atoms with their hydrogens, by the types of the atoms of each residue.
RadiiSet unitedSet(const UnitedAtoms& united)
{
    RadiiSet set;
    set.name = united.name;
    const auto add = [&](const std::string& residue, string_view types, string_view radii) {
        const Fields atoms = splitFields(types), known = splitFields(radii);
        for (std::size_t i = 0; i + 1 < atoms.size(); i += 2) {
            double radius = 0;
            for (std::size_t k = 0; k + 1 < known.size(); k += 2)
                if (known[k] == atoms[i + 1]) parseNumber(known[k + 1], radius);
            set.atoms[{residue, std::string(atoms[i])}] = radius;
        }
    };
    for (const AtomTypes& residue : aminoAcids) {
        add(residue.residue, proteinBackbone, united.protein);
        add(residue.residue, residue.types, united.protein);
    }
    for (const AtomTypes& residue : nucleotides) {
        for (const char* sugar : {"", "D"}) {
            add(sugar + std::string(residue.residue), nucleicBackbone, united.nucleic);
            add(sugar + std::string(residue.residue), residue.types, united.nucleic);
        }
    }
    set.elements[1] = -1.0; // hydrogens belong to their heavy atoms
    return set;
}

const std::vector<std::string>& setNames()
{
    static const std::vector<std::string> names =
        splitWords("bondi,alvarez,gemmi,protor,naccess,martini,martini2,martini3");
    return names;
}

/// Sets the radii of a table where there are none yet.
void fill(ElementRadii& radii, string_view table)
{
    const Fields fields = splitFields(table);
    for (std::size_t i = 0; i + 1 < fields.size(); i += 2) {
        double radius = 0;
        parseNumber(fields[i + 1], radius);
        double& entry = radii[elementNumber(std::string(fields[i]))];
        if (entry == 0) entry = radius;
    }
}

/// A set of radii by element; those that a table lacks come from the next one.
RadiiSet elementSet(const char* name, std::initializer_list<string_view> tables)
{
    RadiiSet set;
    set.name = name;
    for (const string_view table : tables) fill(set.elements, table);
    return set;
}

RadiiSet bondiSet()
{
    return elementSet("bondi", {bondi, mantina, alvarez});
}

RadiiSet alvarezSet()
{
    return elementSet("alvarez", {alvarez});
}

RadiiSet gemmiSet()
{
    constexpr std::uint8_t lastMeasured = 103; // gemmi has 1.00 for all heavier elements
    RadiiSet set;
    set.name = "gemmi";
    for (std::uint8_t z = 1; z <= lastMeasured; ++z) set.elements[z] = gemmiRadius(z);
    return set;
}

/// Adds a line ELEMENT RADIUS or RESIDUE ATOM RADIUS of a file.
void addRule(RadiiSet& set, const Fields& fields, const std::string& place)
{
    auto fail = [&](const std::string& what) { throw Error(ErrorKind::Input, place + what); };
    constexpr double largest = 100; // [Å], a coarse bead
    if (fields.size() != 2 && fields.size() != 3) {
        fail("expected ELEMENT RADIUS or RESIDUE ATOM RADIUS, got " +
             std::to_string(fields.size()) + " columns");
    }
    double radius = 0;
    if (!parseNumber(fields.back(), radius) || !(radius >= 0 && radius <= largest)) {
        fail("radius: expected 0 to 100 Å, got " + inQuotes(fields.back()));
    }
    if (fields.size() == 3) {
        set.atoms[{std::string(fields[0]), std::string(fields[1])}] = radius;
        return;
    }
    // A radius of 0 is a rule too: -1, since 0 means that there is none.
    const double stored = radius > 0 ? radius : -1.0;
    const std::uint8_t element = elementNumber(std::string(fields[0]));
    if (fields[0] == "*") {
        set.otherwise = stored;
    } else if (element == 0) {
        fail("element: expected a symbol such as C or ZN, or *, got " + inQuotes(fields[0]));
    } else {
        set.elements[element] = stored;
    }
}

RadiiSet readFile(const std::string& path, std::size_t maxBytes)
{
    const std::string text = loadText(path, maxBytes);
    RadiiSet set;
    set.name = path;
    for (LineReader lines(text); lines.next();) {
        const Fields fields = splitFields(lines.line().substr(0, lines.line().find('#')));
        if (fields.empty()) continue;
        addRule(set, fields, path + ": line " + std::to_string(lines.number()) + ": ");
    }
    return set;
}

std::string describe(const RadiiSet& set, const char* source)
{
    std::string text = set.name + ": " + source;
    constexpr int perLine = 10;
    int column = 0;
    for (std::size_t z = 1; z < set.elements.size(); ++z) {
        if (set.elements[z] == 0) continue;
        const std::string entry = formatted("%2s %.2f", elementSymbol(static_cast<std::uint8_t>(z)),
                                            static_cast<double>(set.elements[z]));
        text += (column++ % perLine == 0 ? "\n  " : "  ");
        text += entry;
    }
    return text + "\n";
}

std::string describe(const UnitedAtoms& united, const char* source)
{
    return std::string(united.name) + ": " + source +
           "\n  c, d, q: carbon with three neighbours, with one hydrogen, with four; n, l:"
           "\n  nitrogen, with four neighbours; o, h: oxygen with one, with two; s, e, p [Å]"
           "\n  protein " +
           std::string(united.protein) + "\n  nucleic acid " + std::string(united.nucleic) + "\n";
}

std::string describe(const Martini& martini, const char* source)
{
    return std::string(martini.name) + ": " + source +
           formatted("\n  regular %.2f  small %.2f  tiny %.2f\n",
                     static_cast<double>(beadRadius(martini, 'R')),
                     static_cast<double>(beadRadius(martini, 'S')),
                     static_cast<double>(beadRadius(martini, 'T')));
}

} // namespace

double RadiiSet::find(const std::string& residue, const std::string& atom,
                      std::uint8_t element) const
{
    constexpr double none = -1.0;
    if (!atoms.empty()) {
        for (const std::string& of : {residue, parentResidue(residue), std::string("*")}) {
            const auto found = atoms.find({of, atom});
            if (found != atoms.end()) return found->second;
        }
    }
    const double radius = element != 0 && elements[element] != 0 ? elements[element] : otherwise;
    if (radius == 0) return none;
    return radius < 0 ? 0 : radius;
}

RadiiSet readRadii(const std::string& name, std::size_t maxBytes)
{
    if (name == "bondi") return bondiSet();
    if (name == "alvarez") return alvarezSet();
    if (name == "gemmi") return gemmiSet();
    if (name == martini2.name) return martiniSet(martini2);
    if (name == martini3.name) return martiniSet(martini3);
    if (name == protor.name) return unitedSet(protor);
    if (name == naccess.name) return unitedSet(naccess);
    std::error_code status;
    if (!std::filesystem::exists(name, status))
        throw Error(ErrorKind::Input, "radii: expected " + joined(setNames()) +
                                          " or a file that exists, got " + inQuotes(name) +
                                          didYouMean(name, setNames()));
    return readFile(name, maxBytes);
}

std::vector<double> atomRadii(const std::vector<std::string>& names,
                              const std::vector<std::string>& residues,
                              const std::vector<std::string>& elements, const std::string& set)
{
    for (const auto* list : {&residues, &elements})
        if (!list->empty() && list->size() != names.size())
            throw Error(ErrorKind::Input, "radii: expected " + std::to_string(names.size()) +
                                              " names of " +
                                              (list == &residues ? "residues" : "elements") +
                                              ", got " + std::to_string(list->size()));
    const RadiiSet known = readRadii(set == "martini" ? "martini2" : set),
                   fallback = readRadii("bondi");
    std::vector<double> out;
    out.reserve(names.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string residue = residues.empty() ? "" : residues[i];
        const std::string symbol = elements.empty() ? "" : elements[i];
        const std::uint8_t element =
            symbol.empty() ? guessElement(names[i], residue) : elementNumber(symbol);
        double radius = known.find(residue, names[i], element);
        if (radius < 0) radius = fallback.find(residue, names[i], element);
        out.push_back(radius < 0 ? std::numeric_limits<double>::quiet_NaN() : radius);
    }
    return out;
}

std::string describeRadii()
{
    return describe(
               bondiSet(),
               "A. Bondi, J. Phys. Chem. 68 (1964) 441; what it lacks from\n"
               "  M. Mantina et al., J. Phys. Chem. A 113 (2009) 5806, then from alvarez [Å]") +
           "\n" + describe(alvarezSet(), "S. Alvarez, Dalton Trans. 42 (2013) 8617 [Å]") + "\n" +
           describe(gemmiSet(), "the table of gemmi: Bondi and Mantina, the others from cctbx;\n"
                                "  metals are much smaller than in the other sets [Å]") +
           "\n" +
           describe(protor, "heavy atoms with their hydrogens, which are dropped; J. Tsai et al.,\n"
                            "  J. Mol. Biol. 290 (1999) 253") +
           "\n" +
           describe(naccess, "the same of NACCESS (1993): C. Chothia, J. Mol. Biol. 105 (1976) 1") +
           "\n" +
           describe(martini2,
                    "beads by name and residue, r = 2^(1/6) sigma / 2; Monticelli et al.,\n"
                    "  J. Chem. Theory Comput. 4 (2008) 819, and later ones [Å]") +
           "\n" + describe(martini3, "Souza et al., Nat. Methods 18 (2021) 382 [Å]") +
           "\nmartini: the one of these two whose beads the file has; taken for such files "
           "anyway\n";
}

bool isRadiiSet(const std::string& name)
{
    return std::find(setNames().begin(), setNames().end(), name) != setNames().end();
}

} // namespace molsurf
