// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/residue_kind.h"

#include "molsurf/molecule/structure/read_structure.h"
#include "molsurf/molecule/structure/residue_names.h"
#include "unit/structure/temp_file.h"

#include <cstdio>
#include <sstream>

namespace molsurf::test
{
namespace
{

/// Records of "LIG C1 O1, ALA N CA": atoms 2 Å apart, residues 20 Å.
std::string records(const std::string& residues, const char* record = "ATOM", bool ters = false)
{
    std::string text;
    std::istringstream list(residues);
    int number = 0;
    for (std::string residue; std::getline(list, residue, ',');) {
        std::istringstream words(residue);
        std::string name, atom;
        words >> name;
        double x = 20.0 * ++number;
        for (; words >> atom; x += 2.0) {
            char line[100];
            std::snprintf(line, sizeof line,
                          "%-6s%5d  %-3s %-4s %4d    %8.3f%8.3f%8.3f  1.00  0.00\n", record, 1,
                          atom.c_str(), name.c_str(), number, x, 0.0, 0.0);
            text += line;
        }
        if (ters) text += "TER\n";
    }
    return text;
}

/// The words of the kinds of all residues.
std::string kinds(const std::string& text)
{
    std::string out;
    for (const Residue& residue : readStructure(TempFile("a.pdb", text).path()).residues)
        out += (out.empty() ? "" : " ") + std::string(kindWord(residue.kind));
    return out;
}

TEST(ResidueKind, IsTheSameWhateverTheRecordAndTer)
{
    const std::string all =
        "POPC N P C1 C2,CLA CLA,SOD SOD,EDO C1 O1,TIP3 OH2 H1 H2,NAG C1 O5,LIG C1 O1,"
        "SO4 S O1 O2,ZN2 ZN";
    const std::string expected = "lipid ion ion buffer water sugar ligand buffer ion";
    for (const char* record : {"ATOM", "HETATM"})
        for (const bool ters : {false, true})
            EXPECT_EQ(kinds(records(all, record, ters)), expected);
}

TEST(ResidueKind, OfAnAminoAcidAloneIsThatOfItsRecord)
{
    EXPECT_EQ(kinds(records("GLU N CA C,HSD N CA,DA P C1'")), "protein protein nucleic");
    EXPECT_EQ(kinds(records("GLU N CA C,DA P C1'", "HETATM")), "ligand ligand");
}

TEST(ResidueKind, OfALinkIsFoundByItsBonds)
{
    const std::string chain =
        "ATOM      1  N   GLY A   1       1.330   0.000   0.000  1.00  0.00           N  \n"
        "ATOM      2  CA  GLY A   1       2.000   1.300   0.000  1.00  0.00           C  \n"
        "ATOM      3  C   GLY A   1       3.400   1.300   0.000  1.00  0.00           C  \n";
    const std::string link =
        "HETATM    4  N   XYZ A   2       4.000   2.500   0.000  1.00  0.00           N  \n"
        "HETATM    5  CA  XYZ A   2       5.400   2.500   0.000  1.00  0.00           C  \n";
    EXPECT_EQ(kinds(chain + link), "protein modified");
    EXPECT_EQ(kinds(chain + "TER\n" + link), "protein modified"); // a stray TER
    std::string far = link;
    for (std::size_t at = 0; (at = far.find("0.000  1.00", at)) != std::string::npos; at += 9)
        far.replace(at, 5, "9.000");
    EXPECT_EQ(kinds(chain + far), "protein ligand");
}

TEST(ResidueKind, OfNamesThatElementsContradict)
{
    EXPECT_EQ(kinds(records("CLA MG NA NB C1 C2 C3", "HETATM")), "ligand"); // chlorophyll
    EXPECT_EQ(kinds(records("POP P1 O1 O2 P2", "HETATM")), "ligand");       // pyrophosphate
    EXPECT_EQ(kinds(records("ADE N9 C8 N7", "HETATM")), "ligand");          // a base alone
    EXPECT_EQ(kinds(records("I I", "HETATM")), "ion");
    EXPECT_EQ(kinds(records("XXX ZN,YYY O H1 H2", "HETATM")), "ion water");
}

TEST(ResidueKind, OfAWaterWithTwoLocationsIsWater)
{
    const std::string water =
        "HETATM    1  O  AHOH A   1       0.000   0.000   0.000  0.50  0.00           O  \n"
        "HETATM    2  O  BHOH A   1       0.800   0.000   0.000  0.50  0.00           O  \n";
    EXPECT_EQ(kinds(water), "water");
}

TEST(ResidueKind, OfOldNamesOfNucleotidesIsNucleic)
{
    EXPECT_EQ(kinds(records("T P C1'")), "nucleic");
}

TEST(ResidueKind, OfLipidsByTheirNames)
{
    for (const char* name :
         {"POPC", "DOPE", "DPPG", "DLPS", "SOPA", "SAPI", "CHL1", "CER1", "TOCL1"})
        EXPECT_EQ(nameClass(name), NameClass::Lipid) << name;
    for (const char* name : {"ASPP", "GLUP", "NALA", "HSPC", "AGLC", "LYSH", "POPX"})
        EXPECT_NE(nameClass(name), NameClass::Lipid) << name;
    EXPECT_EQ(kinds(records("POP P C1 C2 C3 C4 C5")), "ligand");
    EXPECT_EQ(kinds(records("POP P C1 C2 C3 C4 C5 C6")), "lipid");
    EXPECT_EQ(kinds(records("DPP C1 C2 C3 C4 C5 C6 C7 C8 C9 C10")), "lipid");
    EXPECT_EQ(kinds(records("SAP P C1 C2 C3 C4 C5 C6 N1 N2 N3")), "ligand"); // a nucleotide
}

/// " C1 C2 C3" of a symbol and a number.
std::string many(const char* symbol, int count)
{
    std::string out;
    for (int n = 1; n <= count; ++n) out += std::string(" ") + symbol + std::to_string(n);
    return out;
}

/// Names of force fields that name larger or other molecules in the Protein Data Bank.
TEST(ResidueKind, OfNamesOfForceFieldsIsThatOfTheComposition)
{
    EXPECT_EQ(kinds(records("THF" + many("C", 4) + " O" + many("H", 8))), "buffer");
    EXPECT_EQ(kinds(records("THF" + many("C", 20) + many("N", 7) + many("O", 7))), "ligand");
    EXPECT_EQ(kinds(records("GDM" + many("C", 29) + many("N", 2) + many("O", 9))), "ligand");
    EXPECT_EQ(kinds(records("PSM" + many("C", 39) + many("N", 2) + many("O", 6) + " P")), "lipid");
    EXPECT_EQ(kinds(records("PSM" + many("C", 20) + many("N", 5) + many("O", 5))), "ligand");
    EXPECT_EQ(kinds(records("CER" + many("C", 12) + " N1" + many("O", 3))), "ligand");
    EXPECT_EQ(kinds(records("DDM" + many("C", 24) + many("O", 11))), "lipid");
}

/// The names of the particles that are no atoms.
std::string particles(const std::string& text)
{
    std::string out;
    for (const Atom& atom : readStructure(TempFile("a.pdb", text).path()).atoms)
        if (atom.role == AtomRole::Particle) out += (out.empty() ? "" : " ") + atom.name;
    return out;
}

TEST(Particles, AreVirtualSitesOfWaterAndLonePairs)
{
    EXPECT_EQ(particles(records("SOL OW HW1 HW2 MW,TIP5 O H1 H2 LP1 LP2,OPC O H1 H2 EPW")),
              "MW LP1 LP2 EPW");
    EXPECT_EQ(particles(records("SWM4 OH2 H1 H2 OM")), "OM");
    EXPECT_EQ(particles(records("HO4 OW HW1 HW2 MW")), "MW"); // by its elements
    EXPECT_EQ(kinds(records("HO4 OW HW1 HW2 MW")), "water");
    EXPECT_EQ(particles(records("LIG C1 LP1 EP")), "LP1 EP");
    EXPECT_EQ(particles(records("ALA N CA CB MCB,ALA QB CA")), "MCB QB");
    EXPECT_EQ(particles(records("LIG C1 MG,ALA CA OM,MG MG")), "");
}

TEST(Particles, OfDrudeLieNextToTheirAtoms)
{
    const auto pair = [](double x) {
        char line[100];
        std::snprintf(line, sizeof line,
                      "ATOM      2 DCA  ALA A   1    %8.3f   0.000   0.000  1.00  0.00\n", x);
        return "ATOM      1  CA  ALA A   1       0.000   0.000   0.000  1.00  0.00\n" +
               std::string(line);
    };
    EXPECT_EQ(particles(pair(0.1)), "DCA");
    EXPECT_EQ(particles(pair(1.0)), ""); // deuterium
}

TEST(Particles, AreNamedByTheColumnsOfElements)
{
    const std::string line =
        "ATOM      1  X1  LIG A   1       0.000   0.000   0.000  1.00  0.00          ";
    EXPECT_EQ(particles(line + "EP\n"), "X1");
    EXPECT_EQ(particles(line + "VS\n"), "X1");
    EXPECT_EQ(particles(line + " C\n"), "");
    const std::string unknown = "HETATM    1  UNK UNX A   1       0.000   0.000   0.000  1.00  0.00"
                                "           X\n";
    EXPECT_EQ(readStructure(TempFile("a.pdb", unknown).path()).atoms[0].element, 0); // no uranium
}

} // namespace
} // namespace molsurf::test
