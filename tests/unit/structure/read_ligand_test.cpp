// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/structure/read_structure.h"
#include "molsurf/molecule/structure/readers.h"
#include "molsurf/molecule/structure/residue_bonds.h"
#include "unit/structure/temp_file.h"

namespace molsurf::test
{
namespace
{

Structure readLigand(const std::string& text, const std::string& name = "a.txt")
{
    return readStructure(TempFile(name, text).path());
}

std::string ligandError(const std::string& text, const std::string& name = "a.sdf")
{
    return errorOf(ErrorKind::Input, [&] { readLigand(text, name); });
}

const std::string head = "a title\n     program        3D\na comment\n";
const std::string v2000 = head + "  3  2  0  0  0  0            999 V2000\n"
                                 "    1.2500   -0.5000    2.0000 C   0  0\n"
                                 "   -3.0000    0.0000    0.1250 Cl  0  0\n"
                                 "    0.0000    4.5000    0.0000 D   0  0\n"
                                 "  1  2  1  0\n  1  3  1  0\nM  END\n";
const std::string v3000 = head + "  0  0  0     0  0            999 V3000\n"
                                 "M  V30 BEGIN CTAB\nM  V30 COUNTS 3 2 0 0 0\nM  V30 BEGIN ATOM\n"
                                 "M  V30 1 C 1.25 -0.5 2 0\n"
                                 "M  V30 7 Cl -3 0 -\nM  V30 0.125 0 CHG=-1\n"
                                 "M  V30 3 D 0 4.5 0 0\n"
                                 "M  V30 END ATOM\nM  V30 END CTAB\nM  END\n";
const std::string mol2 = "# made by hand\n@<TRIPOS>MOLECULE\na name\n 4 2 2 0 0\nSMALL\nUSER\n\n"
                         "@<TRIPOS>ATOM\n"
                         "  1 CA   1.25 -0.5 2.0  C.3  1 ALA-5A 0.25\n"
                         "  2 CL1 -3.0   0.0 0.125 Cl  2 ATP501 -1.0\n"
                         "  3 D1   0.0   4.5 0.0  D    2 ATP501 0.75\n"
                         "  4 LP1  0.0   4.5 9.0  LP   2 ATP501 0.00\n"
                         "@<TRIPOS>BOND\n 1 1 2 1\n"
                         "@<TRIPOS>SUBSTRUCTURE\n 1 ALA-5A 1 RESIDUE 1 B ALA\n";

void expectAtoms(const Structure& s)
{
    const std::vector<openvdb::Vec3d> positions{{1.25, -0.5, 2.0}, {-3.0, 0.0, 0.125}, {0, 4.5, 0}};
    const std::vector<int> elements{6, 17, 1};
    ASSERT_GE(s.atoms.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(s.atoms[i].position, positions[i]) << i;
        EXPECT_EQ(s.atoms[i].element, elements[i]) << i;
    }
}

TEST(ReadSdf, ReadsBothVersions)
{
    for (const std::string& text : {v2000, v3000}) {
        const Structure s = readLigand(text);
        EXPECT_EQ(s.format, "sdf");
        expectAtoms(s);
        EXPECT_EQ(s.atoms[1].name, "Cl1");
        ASSERT_EQ(s.residues.size(), 1u);
        EXPECT_TRUE(s.residues[0].hetero());
    }
}

TEST(ReadSdf, MoleculesAreModels)
{
    const std::string data = "> <score>\n-7.5\n\n$$$$\n";
    const Structure s = readLigand(v2000 + data + v3000 + data + "\n");
    ASSERT_EQ(s.models.size(), 2u);
    EXPECT_EQ(s.models[1].number, 2);
    EXPECT_EQ(s.models[1].begin, 3u);
    EXPECT_EQ(s.models[1].end, 6u);
    EXPECT_EQ(s.atoms[3].name, "C1");
}

TEST(ReadSdf, RefusesDrawings)
{
    std::string flat = v2000;
    flat.replace(flat.find("3D"), 2, "2D");
    expectAtoms(readLigand(flat)); // whatever it says
    for (const char* z : {"2.0000 C", "0.1250 Cl"}) flat.replace(flat.find(z), 6, "0.0000");
    EXPECT_HAS(ligandError(flat), "line 4: the molecule is drawn in two dimensions");
}

TEST(ReadSdf, NamesTheLineThatIsWrong)
{
    const auto cutAt = [](const std::string& text, const std::string& word) {
        return text.substr(0, text.find(word));
    };
    std::string letter = v2000;
    letter.replace(letter.find("4.5000"), 6, "4.50x0");
    EXPECT_HAS(ligandError(letter), "line 7: expected y in columns 11-20");
    EXPECT_HAS(ligandError(cutAt(v2000, "   -3.0000")), "cut short after line 5: expected an atom");
    EXPECT_HAS(ligandError(cutAt(v3000, "M  V30 3")), "cut short after line 10");
    EXPECT_HAS(ligandError(head + "abc  0  0     0  0            999 V2000\n"),
               "line 4: expected the number of atoms");
    std::string lost = v3000;
    lost.replace(lost.find("M  V30 0.125"), 6, "M  V20");
    EXPECT_HAS(ligandError(lost), "line 10: expected a line that begins M  V30");
    EXPECT_HAS(ligandError("title\n\n\n"), "cut short after line 3");
}

TEST(ReadMol2, ReadsAtomsResiduesChainsAndCharges)
{
    const Structure s = readLigand(mol2);
    EXPECT_EQ(s.format, "mol2");
    expectAtoms(s);
    EXPECT_EQ(s.atoms[0].name, "CA");
    ASSERT_EQ(s.residues.size(), 2u);
    EXPECT_EQ(s.residues[0].name, "ALA");
    EXPECT_EQ(s.residues[0].number, -5);
    EXPECT_EQ(s.residues[0].insertionCode, 'A');
    EXPECT_FALSE(s.residues[0].hetero());
    EXPECT_EQ(s.residues[1].name, "ATP");
    EXPECT_EQ(s.residues[1].number, 501);
    EXPECT_TRUE(s.residues[1].hetero());
    EXPECT_EQ(s.chains, (std::vector<std::string>{"B", ""}));
    EXPECT_EQ(s.charges, (std::vector<float>{0.25f, -1.0f, 0.75f, 0.0f}));
    ASSERT_EQ(s.atoms.size(), 4u);
    EXPECT_EQ(s.atoms[3].role, AtomRole::Particle); // a lone pair
}

/// Substructures are those of their molecule, and charges are known if all atoms have one.
TEST(ReadMol2, KeepsMoleculesApart)
{
    std::string other = mol2;
    other.replace(other.find(" B ALA"), 6, " C ALA");
    const Structure s = readLigand(mol2 + other);
    ASSERT_EQ(s.models.size(), 2u);
    const auto chainOf = [&](std::size_t model) {
        const Atom& first = s.atoms[s.models[model].begin];
        return s.chains[std::size_t(residueOf(s, first).chain)];
    };
    EXPECT_EQ(chainOf(0), "B");
    EXPECT_EQ(chainOf(1), "C");
    EXPECT_EQ(s.charges.size(), 8u);
    other.replace(other.find("ATP501 0.75"), 11, "ATP501     ");
    EXPECT_TRUE(readLigand(mol2 + other).charges.empty());
}

/// Elements of atoms X1, X2, ... of a molecule by their types.
std::vector<int> elementsOf(const std::vector<std::string>& types, const std::string& names = "")
{
    std::string text = "@<TRIPOS>MOLECULE\nname\n";
    text += "@<TRIPOS>ATOM\n";
    for (std::size_t i = 0; i < types.size(); ++i)
        text += std::to_string(i + 1) + " " +
                (names.empty() ? "X" + std::to_string(i + 1) : names) + " " + std::to_string(i) +
                " 0 0 " + types[i] + " 1 LIG 0.0\n";
    std::vector<int> out;
    for (const Atom& atom : readLigand(text).atoms) out.push_back(atom.element);
    return out;
}

TEST(ReadMol2, TypesOfForceFieldsAreNoElements)
{
    EXPECT_EQ(elementsOf({"ca", "os", "ho", "nb", "nh", "cl", "br", "c3", "sh", "p5", "i", "f"}),
              (std::vector<int>{6, 8, 1, 7, 7, 17, 35, 6, 16, 15, 53, 9}));
    EXPECT_EQ(elementsOf({"CT", "CA", "OS", "HO", "NB", "CL", "SH", "C0", "MG"}),
              (std::vector<int>{6, 6, 8, 1, 7, 17, 16, 20, 12}));
    EXPECT_EQ(elementsOf({"CG2R61", "HGA1", "OG311", "NG2S1", "CLGR1", "BRGR1", "SG311"}),
              (std::vector<int>{6, 1, 8, 7, 17, 35, 16}));
    EXPECT_EQ(elementsOf({"C.ar", "Ca", "Os", "Ho", "O.co2", "Cl"}),
              (std::vector<int>{6, 20, 76, 67, 8, 17})); // those of SYBYL
    EXPECT_EQ(elementsOf({"opls_800"}, "CL1"), (std::vector<int>{8}));
}

TEST(ReadMol2, NamesOfResiduesMayEndWithDigits)
{
    const auto residue = [](const std::string& name, const std::string& line) {
        const Structure s = readLigand("@<TRIPOS>MOLECULE\nname\n@<TRIPOS>ATOM\n1 C 0 0 0 C.3 1 " +
                                       name + " 0.0\n" + line);
        return s.residues[0].name + " " + std::to_string(s.residues[0].number);
    };
    const std::string section = "@<TRIPOS>SUBSTRUCTURE\n";
    EXPECT_EQ(residue("PG4501", section + "1 PG4501 1 RESIDUE 1 A PG4\n"), "PG4 501");
    EXPECT_EQ(residue("X12345", section + "1 X12345 1 RESIDUE 1 A X12\n"), "X12 345");
    EXPECT_EQ(residue("SO4404", ""), "SO4 404");
    EXPECT_EQ(residue("ALA12", ""), "ALA 12");
    EXPECT_EQ(residue("LIG1", ""), "LIG 1");
    EXPECT_EQ(residue("CYS16", ""), "CYS 16"); // no 6 of GROMACS' CYS1
    EXPECT_EQ(residue("CL20", ""), "CL 20");
    EXPECT_EQ(residue("PO412", ""), "PO4 12");
}

/// A .mol2 file of carbons with these fields behind the type.
std::string carbons(const std::vector<std::string>& ends)
{
    std::string text = "@<TRIPOS>MOLECULE\nname\n\n@<TRIPOS>ATOM\n";
    for (std::size_t i = 0; i < ends.size(); ++i)
        text += std::to_string(i + 1) + " C" + std::to_string(i + 1) + " " +
                std::to_string(1.5 * double(i)) + " 0 0 C.3 " + ends[i] + "\n";
    return text;
}

TEST(ReadMol2, NamesOfAmbersEndsHaveDigits)
{
    const auto residues = [](const std::vector<std::string>& ends) {
        std::string out;
        for (const Residue& r : readLigand(carbons(ends)).residues)
            out += r.name + " " + std::to_string(r.number) + ", ";
        return out;
    };
    EXPECT_EQ(residues({"1 DA5", "2 DC", "3 DT3"}), "DA5 1, DC 2, DT3 3, ");
    EXPECT_EQ(residues({"1 DA5", "2 DT3"}), "DA5 1, DT3 2, ");
    EXPECT_EQ(residues({"1 DA5", "2 DC6", "3 HOH7"}), "DA 5, DC 6, HOH 7, ");
    EXPECT_EQ(residues({"1 ALA", "2 LIG2"}), "ALA 1, LIG2 2, ");
}

TEST(ReadMol2, SubstructuresMayHaveNoNames)
{
    for (const char* end : {"7 -0.25", "-0.25"}) { // of GOLD and of DOCK 3.7
        const Structure s = readLigand(carbons({end, end}));
        ASSERT_EQ(s.residues.size(), 1u) << end;
        EXPECT_EQ(s.residues[0].name, "");
        EXPECT_EQ(s.residues[0].number, end[0] == '7' ? 7 : 0);
        EXPECT_EQ(s.charges, (std::vector<float>{-0.25f, -0.25f}));
    }
    EXPECT_EQ(readLigand(carbons({"1 LIG 0.5"})).charges, std::vector<float>{0.5f});
}

// Orders as files write them: 1, 2, 3, ar or 4; am and others are single.
TEST(ReadMol2, BondsHaveTheirOrders)
{
    std::string text = "@<TRIPOS>MOLECULE\na name\n 7 6 1 0 0\nSMALL\nUSER\n\n@<TRIPOS>ATOM\n";
    for (int i = 1; i <= 7; ++i)
        text += std::to_string(i) + " C" + std::to_string(i) + " " + std::to_string(i) +
                ".4 0 0 C.3 1 LIG1 0\n";
    text += "@<TRIPOS>BOND\n";
    const char* const words[] = {"1", "2", "3", "ar", "4", "am"};
    for (int i = 1; i <= 6; ++i)
        text += std::to_string(i) + " " + std::to_string(i) + " " + std::to_string(i + 1) + " " +
                words[i - 1] + "\n";
    const Structure s = readLigand(text);
    ASSERT_TRUE(s.bonds);
    ASSERT_EQ(s.bonds->links.size(), 6u);
    const BondOrder expected[] = {BondOrder::Single,   BondOrder::Double,   BondOrder::Triple,
                                  BondOrder::Aromatic, BondOrder::Aromatic, BondOrder::Single};
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(s.bonds->links[i].order, expected[i]) << i;
}

// Bonds are those of all molecules of a file, if they are the same.
TEST(ReadSdf, ConformersOfOtherBondsHaveNone)
{
    const auto molecule = [](const std::string& bonds) {
        return "name\n  made    01010100003D\n\n  3" +
               formatted("%3d", int(std::count(bonds.begin(), bonds.end(), '\n'))) +
               "  0  0  0  0            999 V2000\n"
               "    0.0000    0.0000    0.0000 C   0  0\n"
               "    1.4000    0.0000    0.5000 O   0  0\n"
               "    2.4000    0.0000    0.5000 N   0  0\n" +
               bonds + "M  END\n$$$$\n";
    };
    const std::string both = "  1  2  1  0\n  2  3  1  0\n", one = "  1  2  1  0\n";
    EXPECT_TRUE(readLigand(molecule(both) + molecule(both)).bonds);
    EXPECT_FALSE(readLigand(molecule(both) + molecule(one)).bonds);
    EXPECT_FALSE(readLigand(molecule(one) + molecule(both)).bonds);
}

TEST(ReadSdf, ADrawingBesideConformersIsRefusedWhereItIsAskedFor)
{
    const std::string head =
        "name\n  made    01010100003D\n\n  2  1  0  0  0  0            999 V2000\n";
    const std::string rest = "    0.0000    0.0000    0.0000 C   0  0\n"
                             "    1.4000    0.0000    0.5000 O   0  0\nM  END\n$$$$\n";
    std::string drawn = head + rest;
    drawn.replace(drawn.find("3D"), 2, "2D").replace(drawn.find("0.5000"), 6, "0.0000");
    const Structure s = readLigand(head + rest + drawn);
    ASSERT_EQ(s.models.size(), 2u);
    EXPECT_EQ(s.models[0].problem, "");
    EXPECT_HAS(s.models[1].problem, "drawn in two dimensions");
    EXPECT_HAS(ligandError(drawn), "drawn in two dimensions");
}

TEST(ReadXyz, ReadsFramesAndColumns)
{
    const Structure s =
        readLigand("2\nwater\nO 0 0 0\nH 0.9 0 0\n3\nProperties=id:I:1:species:S:1:pos:R:3\n"
                   "1 Cl 1 2 3\n2 CA 4 5 6\n3 17 7 8 9\n\n");
    EXPECT_EQ(s.format, "xyz");
    ASSERT_EQ(s.models.size(), 2u);
    const std::vector<int> elements{8, 1, 17, 20, 17};
    ASSERT_EQ(s.atoms.size(), elements.size());
    for (std::size_t i = 0; i < elements.size(); ++i)
        EXPECT_EQ(s.atoms[i].element, elements[i]) << i;
    EXPECT_EQ(s.atoms[4].position, openvdb::Vec3d(7, 8, 9));
    EXPECT_EQ(s.atoms[4].name, "Cl2");
    EXPECT_EQ(s.residues[0].name, "UNL");
    const Structure named = readLigand("4\n\nCA 0 0 0\nCB 2 0 0\nNE 4 0 0\nCL 6 0 0\n");
    const std::vector<int> byName{6, 6, 7, 17};
    for (std::size_t i = 0; i < byName.size(); ++i)
        EXPECT_EQ(named.atoms[i].element, byName[i]) << i;
    const Structure ghost = readLigand("2\n\nCo 0 0 0\nBq 2 0 0\n");
    EXPECT_EQ(ghost.atoms[0].element, 27);
    EXPECT_EQ(ghost.atoms[1].role, AtomRole::Particle);
    EXPECT_HAS(ligandError("2\n\nO 0 0 0\nH 0 x 0\n", "a.xyz"),
               "line 4: expected element, x, y and z");
    EXPECT_HAS(ligandError("2\n\nO 0 0 0\n", "a.xyz"),
               "cut short after line 3: expected atom 2 of 2");
    EXPECT_HAS(ligandError("two\n\nO 0 0 0\n", "a.xyz"), "expected");
}

// Columns are found by their names, in quotes or not, wherever they lie; what is damaged is not
// followed.
TEST(ReadXyz, ColumnsAreFoundByTheirNames)
{
    const auto first = [](const std::string& properties, const std::string& line) {
        const Structure s =
            readXyz("1\nenergy=1 " + properties + " pbc=\"F F F\"\n" + line + "\n", "a.xyz");
        return std::pair(int(s.atoms[0].element), s.atoms[0].position);
    };
    const auto nitrogen = std::pair(7, openvdb::Vec3d(1, 2, 3));
    for (const char* quote : {"", "\""}) {
        const auto quoted = [&](const std::string& list) {
            return "Properties=" + (quote + list) + quote;
        };
        EXPECT_EQ(first(quoted("species:S:1:pos:R:3"), "N 1 2 3"), nitrogen);
        EXPECT_EQ(first(quoted("pos:R:3:species:S:1"), "1 2 3 N"), nitrogen);
        EXPECT_EQ(first(quoted("forces:R:3:element:S:1:q:R:1:pos:R:3"), "9 9 9 N 8 1 2 3"),
                  nitrogen);
        EXPECT_EQ(first(quoted("q:R:0:species:S:1:pos:R:3"), "N 1 2 3"), nitrogen);
        EXPECT_EQ(first(quoted("q:R:x:species:S:1:pos:R:3"), "N 1 2 3"), nitrogen);
    }
}

TEST(ReadMol2, MoleculesAreModelsAndWrongLinesAreNamed)
{
    EXPECT_EQ(readLigand(mol2 + mol2).models.size(), 2u);
    std::string letter = mol2;
    letter.replace(letter.find("0.125"), 5, "0,125");
    EXPECT_HAS(ligandError(letter, "a.mol2"), "line 10: expected number, name, x, y, z and type");
    EXPECT_HAS(ligandError("@<TRIPOS>MOLECULE\nname\n", "a.mol2"), "no atoms");
}

} // namespace
} // namespace molsurf::test
