// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/read_structure.h"
#include "unit/structure/temp_file.h"

namespace molsurf::test
{
namespace
{

Structure readList(const std::string& name, const std::string& text)
{
    return readStructure(TempFile(name, text).path());
}

std::string listError(const std::string& name, const std::string& text)
{
    return errorOf(ErrorKind::Input, [&] { readList(name, text); });
}

TEST(ReadPqr, ReadsWithAndWithoutChain)
{
    const Structure s = readList("a.pqr", "REMARK   1\n"
                                          "ATOM 1 N   NTER   4  -36.5 -12.0 -13.6  0.185 1.824\n"
                                          "ATOM 2 HT1 NTER   4  -36.4 -11.4 -14.4  0.190 0.000\n"
                                          "TER\nEND\n"
                                          "ATOM 3 CA  ALA B  5A   1.0   2.0   3.0 -0.1   1.9\n"
                                          "HETATM 4 ZN ZN B 99    1.0   2.0   9.0  2.0   1.4\n"
                                          "HETATM 5 OH2 TIP3 B 100 1.0  8.0   9.0 -0.8   1.8\n");
    EXPECT_EQ(s.format, "PQR");
    EXPECT_TRUE(s.hasRadii);
    ASSERT_EQ(s.atoms.size(), 5u);
    EXPECT_FLOAT_EQ(s.atoms[0].radius, 1.824f);
    EXPECT_EQ(s.atoms[0].position, openvdb::Vec3d(-36.5, -12.0, -13.6));
    EXPECT_EQ(s.atoms[1].radius, 0);
    EXPECT_EQ(s.atoms[1].element, 1);
    EXPECT_EQ(s.atoms[2].element, 6);
    EXPECT_EQ(s.atoms[3].element, 30);
    EXPECT_EQ(s.chains, (std::vector<std::string>{"", "B"}));
    ASSERT_EQ(s.residues.size(), 4u);
    EXPECT_EQ(s.residues[0].name, "NTER");
    EXPECT_EQ(s.residues[1].number, 5);
    EXPECT_EQ(s.residues[1].insertionCode, 'A');
    EXPECT_TRUE(s.residues[2].hetero());
    EXPECT_TRUE(s.residues[3].water());
    EXPECT_FALSE(s.residues[3].hetero());
}

TEST(ReadPqr, SplitsNumbersGluedByAMinusSign)
{
    const Structure s =
        readList("a.pqr", "ATOM    1  CL- CL-    -4-136.576-112.088-113.641-0.185 1.8\n"
                          "HETATM12345 N NTE A1234 1.0 2.0 3.0 -1e-2 1.5\n");
    ASSERT_EQ(s.atoms.size(), 2u);
    EXPECT_EQ(s.atoms[0].position, openvdb::Vec3d(-136.576, -112.088, -113.641));
    EXPECT_EQ(s.atoms[0].name, "CL-");
    EXPECT_EQ(s.residues[0].number, -4);
    EXPECT_EQ(s.residues[1].number, 1234);
    EXPECT_EQ(s.chains[1], "A");
}

/// Columns 31-54 have the coordinates where eight characters leave no room between them.
TEST(ReadPqr, SplitsCoordinatesThatTouch)
{
    const Structure s = readStructure(
        TempFile("a.pqr",
                 "ATOM      1  CA  ALA A   7    1009.6762995.631-900.515  -0.1000 1.7000\n"
                 "ATOM      2  CB  ALA A   7    1010.0002995.0003000.500  0.1000 1.5D+00\n")
            .path());
    const std::string two =
        "ATOM      3  CG  ALA A   7    1009.6762995.631 -90.515  -0.1000 1.7000\n"
        "ATOM 4 CD ALA A 7 10.25-2.5 3.75 -0.1000 1.7000\n";
    const Structure t = readStructure(TempFile("b.pqr", two).path());
    EXPECT_EQ(t.atoms[0].position, openvdb::Vec3d(1009.676, 2995.631, -90.515));
    EXPECT_EQ(t.atoms[1].position, openvdb::Vec3d(10.25, -2.5, 3.75)); // free of columns
    ASSERT_EQ(s.atoms.size(), 2u);
    EXPECT_EQ(s.atoms[0].position, openvdb::Vec3d(1009.676, 2995.631, -900.515));
    EXPECT_EQ(s.atoms[1].position.z(), 3000.5);
    EXPECT_EQ(s.atoms[1].name, "CB");
    EXPECT_EQ(s.atoms[1].radius, 1.5);
    EXPECT_EQ(s.residues.size(), 1u);
    EXPECT_EQ(s.residues[0].number, 7);
    EXPECT_FLOAT_EQ(s.charges[0], -0.1f);
}

TEST(ReadPqr, ReadsModels)
{
    const std::string atom = "ATOM 1 N ALA 4 1 2 3 0.1 1.8\n";
    const Structure s = readList("a.pqr", "MODEL 2\n" + atom + "ENDMDL\nMODEL 3\n" + atom + atom);
    ASSERT_EQ(s.models.size(), 2u);
    EXPECT_EQ(s.models[0].number, 2);
    EXPECT_EQ(s.models[1].end - s.models[1].begin, 2u);
}

TEST(ReadPqr, NamesTheLineThatIsWrong)
{
    EXPECT_HAS(listError("a.pqr", "REMARK\nATOM 1 N ALA 4 1 2 3 0.1\n"),
               "a.pqr: line 2: expected 10 or 11 columns");
    EXPECT_HAS(listError("a.pqr", "ATOM 1 N ALA 4 1 2 3 0.1 N\n"),
               "radius: expected a number, got \"N\"");
    EXPECT_HAS(listError("a.pqr", "ATOM 1 N ALA 4 1 2 3 0.1 -1.8\n"),
               "radius: expected 0 to 1e6 Å, got -1.8");
    EXPECT_HAS(listError("a.pqr", "ATOM 1 N ALA 4 1 2 nan 0.1 1.8\n"), "z: expected -1e6 to 1e6");
    EXPECT_HAS(listError("a.pqr", "REMARK\n"), "no atoms");
}

TEST(ReadXyzr, TakesTheLastFourColumns)
{
    const Structure plain = readList("a.xyzr", "# x y z r\n\n1 2 3 1.7\r\n4.5\t5 6e0 +1.5\n");
    EXPECT_EQ(plain.format, "xyzr");
    EXPECT_TRUE(plain.hasRadii);
    ASSERT_EQ(plain.atoms.size(), 2u);
    EXPECT_EQ(plain.atoms[1].position, openvdb::Vec3d(4.5, 5, 6));
    EXPECT_EQ(plain.atoms[1].radius, 1.5f);
    EXPECT_EQ(plain.residues.size(), 1u);

    const Structure named = readList("a.xyzr", "A 1 N 22.4 56.2 12.4 1.7\nB 2 CA 1 2 3 1.9\n");
    ASSERT_EQ(named.atoms.size(), 2u);
    EXPECT_EQ(named.chains, (std::vector<std::string>{"A", "B"}));
    EXPECT_EQ(named.residues[1].number, 2);
    EXPECT_EQ(named.atoms[1].name, "CA");
    EXPECT_EQ(named.atoms[1].element, 6);

    const Structure other = readList("a.xyzr", "bead 22.4 56.2 12.4 1.7\n");
    EXPECT_EQ(other.atoms[0].position, openvdb::Vec3d(22.4, 56.2, 12.4));
}

TEST(ReadXyzr, NamesTheLineThatIsWrong)
{
    EXPECT_HAS(listError("a.xyzr", "1 2 3 1.7\n1 2 3\n"), "line 2: expected x y z radius");
    EXPECT_HAS(listError("a.xyzr", "1 2 3 1.7\n1 2 x 1.7\n"), "line 2: z: expected a number");
    EXPECT_HAS(listError("a.xyzr", "1 2 3 nan\n"), "radius: expected 0 to 1e6");
    EXPECT_HAS(listError("a.xyzr", "1 2 inf 1.7\n"), "atom 1: z: expected -1e6 to 1e6");
    EXPECT_HAS(listError("a.xyzr", "# nothing\n"), "no atoms");
}

TEST(ReadXyzrn, TakesTheNameAsItStands)
{
    const Structure s = readList("a.xyzrn", "# x y z r 1 name\n1 2 3 1.7 1 N_ALA_1\n"
                                            "4 5 6 1.5 1 CA_ALA_2A_B\n"
                                            "4 5 7 1.4 1 C_7_x_HOH_O_Red\n"
                                            "4 5 8 1.3 1 D_8_Q_GLY_CA_Green\n"
                                            "4 5 9 1.2 my_bead\n0 0 0 1\n");
    EXPECT_EQ(s.format, "xyzrn");
    EXPECT_TRUE(s.hasRadii);
    ASSERT_EQ(s.atoms.size(), 6u);
    EXPECT_EQ(s.labels, (std::vector<std::string>{"N_ALA_1", "CA_ALA_2A_B", "C_7_x_HOH_O_Red",
                                                  "D_8_Q_GLY_CA_Green", "my_bead", ""}));
    EXPECT_EQ(s.atoms[1].position, openvdb::Vec3d(4, 5, 6));
    EXPECT_EQ(s.atoms[1].radius, 1.5f);
    EXPECT_EQ(s.atoms[1].name, "CA");
    EXPECT_EQ(s.atoms[1].element, 6);
    const auto residue = [&](std::size_t atom) {
        return s.residues[std::size_t(s.atoms[atom].residue)];
    };
    const auto chain = [&](std::size_t atom) { return s.chains[std::size_t(residue(atom).chain)]; };
    EXPECT_EQ(residue(0).name, "ALA");
    EXPECT_EQ(residue(0).number, 1);
    EXPECT_EQ(chain(0), "");
    EXPECT_EQ(residue(1).number, 2);
    EXPECT_EQ(residue(1).insertionCode, 'A');
    EXPECT_EQ(chain(1), "B");
    EXPECT_TRUE(residue(2).water());
    EXPECT_EQ(residue(2).insertionCode, ' ');
    EXPECT_EQ(chain(2), "C");
    EXPECT_EQ(residue(3).name, "GLY");
    EXPECT_EQ(residue(3).insertionCode, 'Q');
    EXPECT_EQ(s.atoms[4].name, "");
    EXPECT_EQ(residue(5).name, "");
}

TEST(ReadXyzrn, NamesTheLineThatIsWrong)
{
    EXPECT_HAS(listError("a.xyzrn", "1 2 3 1.7 1 A\n1 2 3\n"), "line 2: expected x y z radius");
    EXPECT_HAS(listError("a.xyzrn", "1 2 3 1.7 1 A\n1 2 3 N 1 A\n"),
               "line 2: radius: expected a number");
    EXPECT_HAS(listError("a.xyzrn", "1 2 3 -1 1 A\n"), "radius: expected 0 to 1e6 Å, got -1");
    EXPECT_HAS(listError("a.xyzrn", "# nothing\n"), "no atoms");
}

} // namespace
} // namespace molsurf::test
