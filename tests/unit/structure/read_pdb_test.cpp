// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/read_structure.h"
#include "molsurf/molecule/structure/residue_bonds.h"
#include "unit/structure/temp_file.h"

#include <algorithm>
#include <cstdio>
#include <sstream>

namespace molsurf::test
{
namespace
{

Structure readPdb(const std::string& text, const std::string& name = "a.pdb")
{
    return readStructure(TempFile(name, text).path());
}

std::string pdbError(const std::string& text, const std::string& name = "a.pdb")
{
    return errorOf(ErrorKind::Input, [&] { readPdb(text, name); });
}

std::size_t countResidues(const Structure& s, bool (Residue::*flag)() const)
{
    return static_cast<std::size_t>(std::count_if(s.residues.begin(), s.residues.end(),
                                                  [&](const Residue& r) { return (r.*flag)(); }));
}

std::size_t countElement(const Structure& s, int element)
{
    return static_cast<std::size_t>(std::count_if(
        s.atoms.begin(), s.atoms.end(), [&](const Atom& a) { return a.element == element; }));
}

TEST(ReadPdb, ReadsAtomsAndResidues)
{
    const Structure s = readStructure(dataFile("1crn.pdb"));
    EXPECT_EQ(s.source, "1crn.pdb");
    EXPECT_EQ(s.format, "PDB");
    ASSERT_EQ(s.atoms.size(), 327u);
    EXPECT_EQ(s.residues.size(), 46u);
    EXPECT_EQ(s.chains, (std::vector<std::string>{"A"}));
    EXPECT_FALSE(s.hasRadii);
    EXPECT_EQ(s.atoms[1].name, "CA");
    EXPECT_EQ(s.atoms[1].element, 6);
    EXPECT_EQ(s.atoms[1].position, openvdb::Vec3d(16.967, 12.784, 4.338));
    EXPECT_FLOAT_EQ(s.atoms[1].bFactor, 10.80f);
    EXPECT_EQ(countElement(s, 16), 6u); // three disulphide bridges
    EXPECT_EQ(s.residues[45].name, "ASN");
    EXPECT_EQ(s.residues[45].number, 46);
}

/// "C 1.4 0 0" of each line: the atoms of residue 1, named by their elements.
std::string byElements(const char* residue, const std::string& atoms)
{
    std::string text;
    std::istringstream lines(atoms);
    std::string element;
    for (double x = 0, y = 0, z = 0; lines >> element >> x >> y >> z;) {
        char line[100];
        std::snprintf(line, sizeof line,
                      "HETATM    1  %-3s %3s A   1    %8.3f%8.3f%8.3f  1.00  0.00          %2s\n",
                      element.c_str(), residue, x, y, z, element.c_str());
        text += line;
    }
    return text;
}

/// A molecule is what bonds join, whatever its atoms are named.
TEST(ReadPdb, AResidueBeginsAgainWhereNoBondJoinsIt)
{
    const auto sizes = [](const std::string& text) {
        const Structure s = readPdb(text);
        std::vector<int> out(s.residues.size(), 0);
        for (const Atom& a : s.atoms) ++out[std::size_t(a.residue)];
        return out;
    };
    using Sizes = std::vector<int>;
    const std::string glycol = "O 0 0 0 C 1.41 0 0 C 1.92 1.42 0 O 3.33 1.42 0 H 3.65 2.33 0 "
                               "H -0.32 -0.91 0 ";
    EXPECT_EQ(sizes(byElements("LIG", glycol)), Sizes{6});
    EXPECT_EQ(sizes(byElements("LIG", glycol + "O 9 0 0 C 10.4 0 0 ")), (Sizes{6, 2}));
    EXPECT_EQ(sizes(byElements("UNL", glycol + "O 9 0 0 C 10.4 0 0 ")), Sizes{8});
    EXPECT_EQ(sizes(byElements("LIG", "C 0 0 0 O 9 0 0 C 8 0 0 N 1 0 0 ")), Sizes{4});
    const std::string water = "O 0 0 0 H 0.96 0 0 H -0.24 0.93 0 ";
    EXPECT_EQ(sizes(byElements("HOH", water + "O 2.7 0 0 H 3.6 0 0 H 2.4 0.9 0 ")), (Sizes{3, 3}));
    EXPECT_EQ(sizes(byElements("HOH", "O 0 0 0 O 1.2 0 0 O 5 0 0 ")), (Sizes{1, 1, 1}));
    EXPECT_EQ(sizes(byElements("HOH", "H 0.96 0 0 O 0 0 0 H -0.24 0.93 0 H 4 0 0 O 5 0 0 ")),
              (Sizes{3, 2}));
    EXPECT_EQ(sizes(byElements("HOH", "O 0 0 0 H 0.96 0 0 H 14.2 0.93 0 ")), Sizes{3})
        << "a box cuts it";
    EXPECT_EQ(sizes(byElements("NA", "NA 0 0 0 NA 3 0 0 ")), (Sizes{1, 1}));
    EXPECT_EQ(sizes(byElements("ALA", "N 0 0 0 C 1.4 0 0 N 9 0 0 C 10.4 0 0 ")),
              Sizes{4}); // a link
}

/// PDB and mmCIF correct what cannot be, and nothing else.
TEST(ReadPdb, ElementsAreThoseOfMmcif)
{
    const struct {
        const char *residue, *name, *symbol;
        int element;
    } rows[] = {{"ALA", "CA", "CA", 6},   {"MET", "SD", "SD", 16}, {"UNK", "CL1", "CL", 17},
                {"ASH", "BR1", "BR", 35}, {"RU", "RU", "RU", 44},  {"ALA", "2HB", "X", 1},
                {"UNX", "UNK", "X", 0},   {"DT", "HO5'", "HO", 1}, {"UNK", "FE", "FE", 26},
                {"CYS", "SG", "SG", 16},  {"DA5", "I1", "I", 53}};
    const std::string columns = "id type_symbol label_atom_id label_comp_id label_asym_id Cartn_x "
                                "Cartn_y Cartn_z auth_seq_id";
    for (const auto& row : rows) {
        char line[100];
        std::snprintf(line, sizeof line,
                      "HETATM    1 %4s %3s A   1       1.000   2.000   3.000  1.00  0.00        "
                      "  %2s\n",
                      row.name, row.residue, row.symbol);
        EXPECT_EQ(readPdb(line).atoms[0].element, row.element) << row.residue;
        std::string cif = "data_a\nloop_\n";
        std::istringstream names(columns);
        for (std::string name; names >> name;) cif += "_atom_site." + name + "\n";
        cif += std::string("1 ") + row.symbol + " \"" + row.name + "\" " + row.residue +
               " A 1 2 3 1\n";
        EXPECT_EQ(readPdb(cif, "a.cif").atoms[0].element, row.element) << row.residue;
    }
}

/// Open Babel names the atoms of a ligand by their elements.
TEST(ReadPdb, AnUnknownLigandStaysOneResidue)
{
    const Structure s =
        readPdb("HETATM    1  C   UNL     1       0.983   0.061   0.037  1.00  0.00           C\n"
                "HETATM    2  C   UNL     1       2.503   0.061   0.037  1.00  0.00           C\n"
                "HETATM    3  O   UNL     1       3.003   1.393   0.037  1.00  0.00           O\n"
                "HETATM    4  C   UNL     1       4.423   1.393   0.037  1.00  0.00           C\n");
    EXPECT_EQ(s.atoms.size(), 4u);
    EXPECT_EQ(s.residues.size(), 1u);
}

TEST(ReadPdb, TellsWatersAndLigands)
{
    const Structure s = readStructure(dataFile("1ubq.pdb"));
    EXPECT_EQ(s.atoms.size(), 660u);
    EXPECT_EQ(countResidues(s, &Residue::water), 58u);
    EXPECT_EQ(countResidues(s, &Residue::hetero), 0u);
}

TEST(ReadPdb, SelenomethionineIsNoLigand)
{
    const Structure s = readStructure(dataFile("1a8o.pdb.gz"));
    EXPECT_EQ(s.atoms.size(), 644u);
    EXPECT_EQ(countResidues(s, &Residue::water), 88u);
    EXPECT_EQ(countResidues(s, &Residue::hetero), 0u);
    EXPECT_EQ(countElement(s, 34), 4u);
}

TEST(ReadPdb, ReadsLineNumbersOf1990)
{
    const Structure s = readStructure(dataFile("4at1.ent.gz"));
    EXPECT_EQ(s.atoms.size(), 7170u);
    EXPECT_EQ(s.chains.size(), 4u);
    EXPECT_EQ(countResidues(s, &Residue::hetero), 4u); // 2 ATP and 2 zinc
    EXPECT_EQ(countElement(s, 30), 2u);
    EXPECT_EQ(countElement(s, 0), 0u);
}

TEST(ReadPdb, ReadsModels)
{
    const Structure s = readStructure(dataFile("1d3z.pdb.gz"));
    ASSERT_EQ(s.models.size(), 10u);
    for (int i = 0; i < 10; ++i) {
        const Model& model = s.models[static_cast<std::size_t>(i)];
        EXPECT_EQ(model.number, i + 1);
        EXPECT_EQ(model.end - model.begin, 1231u);
    }
}

const std::string atom =
    "ATOM      1  CA  GLY A   1       1.000   2.000   3.000  1.00  0.00           C  \n";

TEST(ReadPdb, KeepsModelNumbersOfTheFile)
{
    const Structure s = readPdb("MODEL        7\n" + atom + "ENDMDL\nMODEL    12345\n" + atom +
                                "ENDMDL\nMODEL\nENDMDL\n" + atom + "ENDMDL\n" + atom);
    ASSERT_EQ(s.models.size(), 4u);
    EXPECT_EQ(s.models[0].number, 7);
    EXPECT_EQ(s.models[1].number, 12345);
    EXPECT_EQ(s.models[2].number, 12346);
    EXPECT_EQ(s.models[3].number, 12347);
}

TEST(ReadPdb, RefusesModelsWithoutAtoms)
{
    EXPECT_HAS(pdbError("MODEL        1\nENDMDL\n"), "no atoms: read as PDB");
    EXPECT_HAS(pdbError("Dear Sir,\n"), "no atoms");
    EXPECT_HAS(pdbError("HEADER    HEADER ONLY\n"), "no atoms");
}

TEST(ReadPdb, RefusesBadCoordinatesAndSaysWhere)
{
    auto withX = [](const std::string& x) {
        return "REMARK\n" + atom.substr(0, 30) + x + atom.substr(38);
    };
    EXPECT_HAS(pdbError(withX("     nan")), "atom 1 (CA of GLY 1): x: expected -1e6 to 1e6");
    EXPECT_HAS(pdbError(withX("     inf")), "expected -1e6 to 1e6");
    EXPECT_HAS(pdbError(withX(" 1000001")), "got 1000001");
    EXPECT_EQ(readPdb(withX(" 1000000")).atoms[0].position[0], 1e6);
    EXPECT_HAS(pdbError(withX("********")),
               "line 2: x: expected a number in columns 31-38, got \"********\"");
    EXPECT_HAS(pdbError(withX("        ")), "got \"\"");
    EXPECT_HAS(pdbError(atom.substr(0, 40)), "line 1: y: expected a number in columns 39-46");
}

TEST(ReadPdb, ReadsShortLinesAndGuessesElements)
{
    const Structure s =
        readPdb("ATOM      1  O       X   1       0.417   8.303  11.737  0.00  0.00\n"
                "ATOM      2  H       X   1       1.320   8.480  12.003\n"
                "ATOM      3 HG11 VAL X   2       1.320   8.480  12.003  1.00  0.00\n"
                "ATOM      4 CA   VAL X   2       1.320   8.480  12.003  1.00  0.00\n"
                "HETATM    5 CA    CA X   3       1.320   8.480  12.003  1.00  0.00");
    ASSERT_EQ(s.atoms.size(), 5u);
    const std::vector<int> elements{8, 1, 1, 6, 20};
    for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(s.atoms[i].element, elements[i]) << i;
}

TEST(ReadPdb, ReadsOddChargeColumns)
{
    const std::string head = atom.substr(0, 72);
    const Structure s = readPdb(head + "4AT1  83\n" + head + "4AT1   8\n" + head + "4AT11234\n" +
                                head + "1ABCA 12\n" + head + "     C1+\n" + head + "     C+1\n" +
                                head + "SEGA C1 \n" + head + "           A\n");
    ASSERT_EQ(s.atoms.size(), 8u);
    for (const Atom& a : s.atoms) EXPECT_EQ(a.element, 6);
}

TEST(ReadPdb, ReadsHybrid36Numbers)
{
    const Structure s = readPdb(
        "HETATM99999  O   HOH WZZZZ       1.000   2.000   3.000  1.00  0.00           O  \n"
        "HETATMA0000  O   HOH WA000       4.000   2.000   3.000  1.00  0.00           O  \n"
        "HETATMA0001  O   HOH WA001       7.000   2.000   3.000  1.00  0.00           O  \n"
        "HETATMa0000  O   HOH Wa000       9.000   2.000   3.000  1.00  0.00           O  \n");
    ASSERT_EQ(s.residues.size(), 4u);
    EXPECT_EQ(s.residues[0].number, 1223055);
    EXPECT_EQ(s.residues[1].number, 10000);
    EXPECT_EQ(s.residues[2].number, 10001);
    EXPECT_EQ(s.residues[3].number, 1223056);
}

TEST(ReadPdb, KeepsInsertionCodes)
{
    const Structure s =
        readPdb("ATOM      1 A    XXX X   1a      1.000   2.000   3.000  1.00  0.00           A\n"
                "ATOM      2 B    XXX X   2c      1.000   2.000   3.000  1.00  0.00           B\n"
                "ATOM      4 D    XXX X   4       1.000   2.000   3.000  1.00  0.00           D\n");
    ASSERT_EQ(s.residues.size(), 3u);
    EXPECT_EQ(s.residues[0].insertionCode, 'a');
    EXPECT_EQ(s.residues[1].number, 2);
    EXPECT_EQ(s.residues[2].insertionCode, ' ');
    EXPECT_EQ(s.atoms[2].element, 1); // deuterium is hydrogen
}

TEST(ReadPdb, TellsCapsAndIonsFromTheChain)
{
    const Structure s = readPdb(
        "HETATM    1  C   ACE A   0       0.000   0.000   0.000  1.00  0.00           C  \n"
        "ATOM      2  N   GLY A   1       1.330   0.000   0.000  1.00  0.00           N  \n"
        "ATOM      3  CA  GLY A   1       2.000   1.300   0.000  1.00  0.00           C  \n"
        "ATOM      4  C   GLY A   1       3.400   1.300   0.000  1.00  0.00           C  \n"
        "HETATM    5  N   XYZ A   2       4.000   2.500   0.000  1.00  0.00           N  \n"
        "HETATM    6 ZN    ZN A 101       9.000   9.000   9.000  1.00  0.00          ZN  \n"
        "HETATM    7  O   HOH A 201       9.000   9.000   0.000  1.00  0.00           O  \n");
    ASSERT_EQ(s.residues.size(), 5u);
    const std::vector<bool> hetero{false, false, false, true, false};
    for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(s.residues[i].hetero(), hetero[i]) << i;
    EXPECT_TRUE(s.residues[4].water());
}

TEST(ReadPdb, AStrayTerMakesNoLigands)
{
    const std::string second = "ATOM      2  CA  ALA A   2       9.000   2.000   3.000  1.00  0.00"
                               "           C  \n";
    const Structure s = readPdb(atom + "TER\n" + second);
    EXPECT_EQ(countResidues(s, &Residue::hetero), 0u);
}

// VMD writes frames so.
TEST(ReadPdb, EndEndsAFrame)
{
    EXPECT_EQ(readPdb(atom + "END\n\n").models.size(), 1u);
    const Structure s = readPdb("CRYST1\n" + atom + "END\nCRYST1\n" + atom + "TER\nEND\n" + atom);
    ASSERT_EQ(s.models.size(), 3u);
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(s.models[std::size_t(i)].number, i + 1);
        EXPECT_EQ(s.models[std::size_t(i)].end, std::size_t(i) + 1);
    }
    EXPECT_EQ(readPdb("MODEL 4\n" + atom + "ENDMDL\nEND\n").models[0].number, 4);
}

TEST(ReadPdb, RefusesAMisspeltAtom)
{
    for (const char* record :
         {"ATAM  ", "ATMO  ", "ATON  ", "ATM   ", "Atom  ", "HETATN", "HETTAM", "hetatm"})
        EXPECT_HAS(pdbError(atom + record + atom.substr(6)), "line 2: expected ATOM or HETATM")
            << record;
    for (const char* record : {"SIGATM", "ANISOU", "REMARK", "CONECT"})
        EXPECT_EQ(readPdb(atom + record + atom.substr(6)).atoms.size(), 1u) << record;
}

// Bonds of a record CONECT: twice from one end is a double one; numbers without an atom are none.
TEST(ReadPdb, BondsOfConect)
{
    const auto line = [](int serial, const char* name, int number) {
        char text[100];
        std::snprintf(text, sizeof text,
                      "HETATM%5d  %-3s XXX B%4dA   %8.3f   0.000   0.000  1.00  0.00           C\n",
                      serial, name, number, 1.5 * serial);
        return std::string(text);
    };
    const std::string atoms = line(11, "C1", 7) + line(12, "C2", 7) + line(13, "C3", 8);
    const Structure s = readPdb(atoms + "CONECT   11   12   12   99\nCONECT   12   11   11   13\n"
                                        "CONECT   13   12\nCONECT   xx   12\nCONECT   11   11\n");
    ASSERT_TRUE(s.bonds);
    ASSERT_EQ(s.bonds->links.size(), 2u);
    const FileBonds::Link &first = s.bonds->links[0], &second = s.bonds->links[1];
    EXPECT_EQ(first.a.atom + first.b.atom + second.a.atom + second.b.atom, "C1C2C2C3");
    EXPECT_EQ(first.order, BondOrder::Double);
    EXPECT_EQ(second.order, BondOrder::Single);
    EXPECT_EQ(second.b.chain, "B");
    EXPECT_EQ(second.b.number, 8);
    EXPECT_EQ(second.b.insertionCode, 'A');
    EXPECT_FALSE(readPdb(atoms).bonds);
}

/// A record whose residue's name and chain stand in columns 18 to 22.
std::string wide(const std::string& name, int number, const std::string& atomName = " C1 ")
{
    char line[100];
    std::snprintf(line, sizeof line, "ATOM      1 %s %s%4d    %8.3f   0.000   0.000  1.00  0.00\n",
                  atomName.c_str(), name.c_str(), number, 10.0 * number);
    return line;
}

/// "M/POPC W/TIP3": chains and names of all residues.
std::string residuesOf(const Structure& s)
{
    std::string out;
    for (const Residue& r : s.residues)
        out += (out.empty() ? "" : " ") + s.chains[std::size_t(r.chain)] + "/" + r.name;
    return out;
}

TEST(ReadPdb, NamesOfFourLettersReachIntoColumn21)
{
    EXPECT_EQ(residuesOf(readPdb(wide("POPCM", 1) + wide("DOPEM", 2) + wide("PIPXM", 3) +
                                 wide("HSD A", 4))),
              "M/POPC M/DOPE M/PIPX A/HSD");
    EXPECT_EQ(residuesOf(readPdb(wide("XYZQ ", 1))), "/XYZQ");
    EXPECT_EQ(residuesOf(readPdb(wide("NALAA", 1) + wide("CGLYA", 2))), "A/NALA A/CGLY");
}

TEST(ReadPdb, ChainsOfTwoLettersBeginInColumn21)
{
    EXPECT_EQ(residuesOf(readPdb(wide("ALAAB", 1) + wide("HOHAB", 2) + wide("LIGAB", 3))),
              "AB/ALA AB/HOH AB/LIG");
    // TIP in chain 3W and ALA in chain 3W: the second one decides.
    EXPECT_EQ(residuesOf(readPdb(wide("ALA3W", 1) + wide("TIP3W", 2))), "3W/ALA 3W/TIP");
    EXPECT_EQ(residuesOf(readPdb(wide("LIGAB", 3))), "AB/LIG");
}

TEST(ReadPdb, AtomsStayInTheOrderOfTheFile)
{
    const Structure s = readPdb(wide("ALA A", 1) + wide("ALA B", 2) + wide("HOH A", 3));
    ASSERT_EQ(s.atoms.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(s.atoms[i].position.x(), 10.0 * double(i + 1));
    EXPECT_EQ(s.chains.size(), 2u);
}

TEST(ReadPdb, SegmentsKeepResiduesApart)
{
    const std::string head = atom.substr(0, 72);
    EXPECT_EQ(readPdb(head + "PROA    \n" + head + "PROB    \n").residues.size(), 2u);
    EXPECT_EQ(readPdb(head + "PROA\n" + head + "PROB\n").residues.size(), 2u);
    const std::string other = head.substr(0, 13) + "CB" + head.substr(15);
    EXPECT_EQ(readPdb(head + "1\n" + other + "2\n").residues.size(), 1u) << "no name comes again";
    EXPECT_EQ(readPdb(head + "1ABC   8\n" + head + "1ABD   9\n").residues.size(), 1u);
}

TEST(ReadPdb, EqualNumbersOfMoleculesAreResiduesOfTheirOwn)
{
    EXPECT_EQ(readPdb(wide("CLA A", 1, " CLA") + wide("CLA A", 1, " CLA")).residues.size(), 2u);
    EXPECT_EQ(readPdb(wide("ALA A", 1, " N  ") + wide("ALA A", 1, " N  ")).residues.size(), 1u);
}

// AutoDock's types begin in column 78.
TEST(ReadPdbqt, TypesTellElementsAndChargesAreRead)
{
    const char* types[] = {"A ", "OA", "NA", "HD", "Cl", "Br", "SA", "CG0", "G0", "Zn"};
    std::string text = "ROOT\n";
    for (const char* type : types) {
        const std::string line =
            "ATOM      1  X1  LIG A   1       0.000   0.000   0.000  1.00  0.00  "
            "  -0.250 ";
        text += line + type + "\n";
    }
    const Structure s = readPdb(text + "ENDROOT\nTORSDOF 0\n", "a.txt");
    EXPECT_EQ(s.format, "PDBQT");
    const std::vector<int> elements{6, 8, 7, 1, 17, 35, 16, 6, 0, 30};
    ASSERT_EQ(s.atoms.size(), elements.size());
    for (std::size_t i = 0; i < elements.size(); ++i)
        EXPECT_EQ(s.atoms[i].element, elements[i]) << types[i];
    EXPECT_EQ(s.atoms[8].role, AtomRole::Particle); // glue of an open ring
    ASSERT_EQ(s.charges.size(), elements.size());
    EXPECT_FLOAT_EQ(s.charges[0], -0.25f);
}

TEST(ReadPdbqt, ChargesAreNoSegmentsAndSodiumIsNoAcceptor)
{
    const auto line = [](const std::string& residue, const char* charge, const char* type) {
        return "ATOM      1  NA  " + residue +
               " A   1       0.000   0.000   0.000  1.00  0.00    " + charge + " " + type + "\n";
    };
    const Structure s = readPdb(line("LIG", "-0.450", "NA") + line("LIG", " 0.120", "N ") +
                                    line(" NA", " 1.000", "Na") + line(" NA", " 0.000", "NA"),
                                "a.pdbqt");
    ASSERT_EQ(s.atoms.size(), 4u);
    EXPECT_EQ(s.residues.size(), 3u); // the ligand and two ions
    EXPECT_EQ(s.atoms[0].element, 7);
    EXPECT_EQ(s.atoms[2].element, 11);
    EXPECT_EQ(s.atoms[3].element, 11);
    EXPECT_FLOAT_EQ(s.charges[0], -0.45f);
}

TEST(ReadPdb, ReadsAssembly)
{
    const Structure s = readStructure(dataFile("1a8o.pdb.gz"));
    ASSERT_EQ(s.assemblies.size(), 1u);
    ASSERT_EQ(s.assemblies[0].parts.size(), 1u);
    EXPECT_EQ(s.assemblies[0].parts[0].operators.size(), 2u);
    EXPECT_EQ(s.asyms, s.chains);
}

TEST(ReadPdb, ReadsNonCrystallographicSymmetry)
{
    const std::string given =
        "MTRIX1   1  1.000000  0.000000  0.000000        0.00000    1                    \n"
        "MTRIX2   1  0.000000  1.000000  0.000000        0.00000    1                    \n"
        "MTRIX3   1  0.000000  0.000000  1.000000        0.00000    1                    \n";
    const std::string missing = "MTRIX1   2  0.000000 -1.000000  0.000000      100.00000\n"
                                "MTRIX2   2  1.000000  0.000000  0.000000      -20.50000\n"
                                "MTRIX3   2  0.000000  0.000000  1.000000        3.00000\n";
    const std::string atom =
        "ATOM      1  CA  ALA A   1       1.000   2.000   3.000  1.00  0.00           C  \n";
    EXPECT_TRUE(readPdb(given + atom).assemblies.empty());
    const Structure s = readPdb(given + missing + atom);
    ASSERT_EQ(s.assemblies.size(), 1u);
    EXPECT_EQ(s.assemblies[0].name, "ncs");
    ASSERT_EQ(s.assemblies[0].parts.size(), 1u);
    EXPECT_TRUE(s.assemblies[0].parts[0].chains.empty());
    const auto& operators = s.assemblies[0].parts[0].operators;
    ASSERT_EQ(operators.size(), 2u);
    EXPECT_EQ(operators[0].rotation[0][0], 1);
    EXPECT_EQ(operators[1].name, "2");
    EXPECT_EQ(operators[1].rotation[0], (std::array<double, 3>{0, -1, 0}));
    EXPECT_EQ(operators[1].rotation[1], (std::array<double, 3>{1, 0, 0}));
    EXPECT_EQ(operators[1].translation, openvdb::Vec3d(100, -20.5, 3));
    const Structure bad = readPdb("MTRIX1   2  0.000000 what\n" + atom);
    EXPECT_TRUE(bad.assemblies.empty());
    ASSERT_EQ(bad.warnings.size(), 1u);
    EXPECT_HAS(bad.warnings[0], "MTRIX");
}

TEST(ReadPdb, ANameThatEndsInVdbMeansNothing)
{
    const std::string text = contentOf(dataFile("1crn.pdb"));
    const Structure s = readPdb(text, "1crn_full.vdb");
    EXPECT_EQ(s.format, "PDB");
    EXPECT_EQ(s.atoms.size(), 327u);
}

// A line may be of any length, and hold what would be a record by itself.
TEST(ReadPdb, TakesNoPartOfALongLineForALine)
{
    const std::string atom =
        "HETATM    1  C1  LIG A   1       1.000   2.000   3.000  1.00  0.00           C  ";
    for (std::size_t size = 70; size < 300; ++size) {
        const std::string text = atom + "\nENDMDL" + std::string(size, '\xbb') + atom + "\nEND\n";
        EXPECT_EQ(readStructure(TempFile("a.pdb", text).path()).atoms.size(), 1u) << size;
    }
}

} // namespace
} // namespace molsurf::test
