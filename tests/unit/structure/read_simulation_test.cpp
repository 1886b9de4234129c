// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/read_structure.h"
#include "unit/structure/temp_file.h"

namespace molsurf::test
{
namespace
{

Structure readAs(const std::string& name, const std::string& text)
{
    return readStructure(TempFile(name, text).path());
}

std::string errorAs(const std::string& name, const std::string& text)
{
    return errorOf(ErrorKind::Input, [&] { readAs(name, text); });
}

const std::string groFrame =
    "ATOM is a word, t= 0.0\n    5\n"
    "    1ALA      N    1   1.234  -0.500   2.000  0.1000 -0.2000  0.3000\n"
    "    1ALA     CA    2   1.300  -0.400   2.100\n"
    "    2NA      NA    3   0.000   0.000   0.000\n"
    "    3SOD    SOD    4   0.100   0.000   0.000\n"
    "    4SOL    HW1    5   0.200   0.000   0.000\n"
    "   5.00000   5.00000   5.00000\n";

TEST(ReadGro, ReadsNanometresAndNames)
{
    const Structure s = readAs("a.txt", groFrame);
    EXPECT_EQ(s.format, "gro");
    ASSERT_EQ(s.atoms.size(), 5u);
    EXPECT_NEAR(s.atoms[0].position.x(), 12.34, 1e-12);
    EXPECT_NEAR(s.atoms[0].position.y(), -5.0, 1e-12);
    EXPECT_NEAR(s.atoms[1].position.z(), 21.0, 1e-12);
    EXPECT_EQ(s.atoms[1].name, "CA");
    const std::vector<int> elements{7, 6, 11, 11, 1};
    for (std::size_t i = 0; i < elements.size(); ++i)
        EXPECT_EQ(s.atoms[i].element, elements[i]) << i;
    ASSERT_EQ(s.residues.size(), 4u);
    EXPECT_EQ(s.residues[0].name, "ALA");
    EXPECT_FALSE(s.residues[0].hetero());
    EXPECT_TRUE(s.residues[1].hetero());
    EXPECT_TRUE(s.residues[3].water());
    EXPECT_FALSE(s.hasRadii);
}

TEST(ReadGro, FramesAreModelsAndColumnsAreAsWideAsTheirDigitsSay)
{
    const std::string wide = "second\n    1\n"
                             "    1ALA      N    1    1.234567   -0.500000    2.000001\n"
                             "   1.0 1.0 1.0 0 0 0 0 0 0\n\n";
    const Structure s = readAs("a.gro", groFrame + wide);
    ASSERT_EQ(s.models.size(), 2u);
    EXPECT_EQ(s.models[1].number, 2);
    EXPECT_EQ(s.models[1].end - s.models[1].begin, 1u);
    EXPECT_NEAR(s.atoms[5].position.x(), 12.34567, 1e-12);
    EXPECT_NEAR(s.atoms[5].position.z(), 20.00001, 1e-12);
}

TEST(ReadGro, TakesABoxOfWholeNumbers)
{
    std::string text = groFrame;
    text.replace(text.find("   5.00000"), std::string::npos, "2 2 2\n");
    EXPECT_EQ(readAs("a.gro", text).atoms.size(), 5u);
    std::string glued = text; // of 40,000 nm
    glued.replace(glued.find("2 2 2"), 5, "40000.0000040000.0000040000.00000");
    EXPECT_EQ(readAs("a.gro", glued).atoms.size(), 5u);
    text.replace(text.find("2 2 2"), 5, "2 2");
    EXPECT_HAS(errorAs("a.gro", text), "expected the box after 5 atoms, got \"2 2\"");
}

TEST(ReadGro, NamesTheLineThatIsWrong)
{
    const auto replaced = [](std::string from, const std::string& to) {
        std::string text = groFrame;
        return text.replace(text.find(from), from.size(), to);
    };
    EXPECT_HAS(errorAs("a.gro", "title\nmany\n"), "line 2: expected the number of atoms");
    EXPECT_HAS(errorAs("a.gro", replaced("  -0.400", "  0.4e0z")), "line 4: y: expected a number");
    EXPECT_HAS(errorAs("a.gro", replaced("    2NA ", "    xNA ")), "line 5: expected a residue");
    EXPECT_HAS(errorAs("a.gro", replaced("    5\n", "    4\n")),
               "line 7: expected the box after 4 atoms");
    EXPECT_HAS(errorAs("a.gro", replaced("    5\n", "    6\n")), "line 8");
    EXPECT_HAS(errorAs("a.gro", groFrame.substr(0, groFrame.find("    3SOD"))),
               "is cut short after line 5: expected atom 4 of 5");
    EXPECT_HAS(errorAs("a.gro", groFrame.substr(0, groFrame.find("   5.00000"))), "the box");
}

const std::string psf = "PSF EXT CMAP\n\n       1 !NTITLE\n REMARKS none\n\n       6 !NATOM\n"
                        "  1 PROA 1    ALA  N    NH3  -0.30 14.0070 0\n"
                        "  2 PROA 1    ALA  CA   CT1   0.21 12.0110 0\n"
                        "  3 PROA 2A   GLY  CB   CH2   0.21 14.0270 0\n"
                        "  4 LIG  7    LIG  X1   CLX   0.21 35.4500 0\n"
                        "  5 ION  8    SOD  SOD  SOD   1.00 22.9898 0\n"
                        "  6 WAT  9    TIP3 H1   HT    0.41  1.0080 0\n\n       0 !NBOND\n";

TEST(ReadPsf, ReadsAtomsWithoutPlaces)
{
    const Structure s = readAs("a.txt", psf);
    EXPECT_EQ(s.format, "psf");
    EXPECT_FALSE(s.placed);
    ASSERT_EQ(s.atoms.size(), 6u);
    const std::vector<int> elements{7, 6, 6, 17, 11, 1};
    for (std::size_t i = 0; i < elements.size(); ++i)
        EXPECT_EQ(s.atoms[i].element, elements[i]) << i;
    EXPECT_EQ(s.chains, (std::vector<std::string>{"PROA", "LIG", "ION", "WAT"}));
    ASSERT_EQ(s.residues.size(), 5u);
    EXPECT_EQ(s.residues[1].number, 2);
    EXPECT_EQ(s.residues[1].insertionCode, 'A');
    EXPECT_FALSE(s.residues[1].hetero());
    EXPECT_TRUE(s.residues[2].hetero());
    EXPECT_TRUE(s.residues[4].water());
}

// Lone pairs have no mass, Drude particles 0.4 u; the lightest atoms have 1.
TEST(ReadPsf, ParticlesHaveNearlyNoMass)
{
    for (const char* mass : {"0.0000", "0.4000", "0.6000"}) {
        std::string text = psf;
        text.replace(text.find("1.0080"), 6, mass);
        EXPECT_EQ(readAs("a.psf", text).atoms.back().role,
                  mass[2] == '6' ? AtomRole::Atom : AtomRole::Particle)
            << mass;
    }
}

TEST(ReadPsf, NamesTheLineThatIsWrong)
{
    EXPECT_HAS(errorAs("a.psf", "PSF\n\n 1 !NTITLE\n"), "expected the section !NATOM");
    EXPECT_HAS(errorAs("a.psf", psf.substr(0, psf.find("  4 LIG"))), "expected atom 4 of 6");
    EXPECT_HAS(errorAs("a.psf", "PSF\n 1 !NATOM\n 1 A 1 ALA N NH3 0.1\n"), "line 3: expected");
    EXPECT_HAS(errorAs("a.psf", "PSF\n 1 !NATOM\n 1 A x1 ALA N NH3 0.1 14\n"),
               "line 3: expected a residue number");
    EXPECT_HAS(errorAs("a.psf", "PSF\n x !NATOM\n"), "line 2: expected the number of atoms");
}

/// A topology of Amber: a glycine without hydrogens, an ion, and water with an extra point.
std::string parm7(bool elements)
{
    std::string out =
        "%VERSION  VERSION_STAMP = V0001.000\n%FLAG TITLE\n%FORMAT(20a4)\ndefault_name\n"
        "%FLAG POINTERS\n%FORMAT(10I8)\n"
        "       8       0       0       0       0       0       0       0       0       0\n"
        "       0       3\n"
        "%FLAG ATOM_NAME\n%FORMAT(20a4)\nN   CA  C   O   CL- O   H1  EPW \n"
        "%FLAG CHARGE\n%COMMENT in units of the electron charge times 18.2223\n"
        "%FORMAT(5E16.8)\n -7.57501011E+00  0.00000000E+00  0.00000000E+00  0.00000000E+00"
        " -1.82223000E+01\n  0.00000000E+00  9.47559600E+00 -9.47559600E+00\n";
    if (elements)
        out += "%FLAG ATOMIC_NUMBER\n%FORMAT(10I8)\n"
               "       7       6       6       8      17       8       1       0\n";
    return out +
           "%FLAG MASS\n%FORMAT(5E16.8)\n  1.40100000E+01  1.20100000E+01  1.20100000E+01"
           "  1.60000000E+01  3.54500000E+01\n  1.60000000E+01  1.00800000E+00  0.00000000E+00\n"
           "%FLAG RESIDUE_LABEL\n%FORMAT(20a4)\nGLY Cl- WAT \n"
           "%FLAG RESIDUE_POINTER\n%FORMAT(10I8)\n       1       5       6\n";
}

TEST(ReadParm7, ReadsAtomsWithoutPlaces)
{
    for (const bool elements : {true, false}) {
        const Structure s = readAs("a.txt", parm7(elements));
        EXPECT_EQ(s.format, "parm7");
        EXPECT_FALSE(s.placed);
        ASSERT_EQ(s.atoms.size(), 8u);
        const std::vector<int> expected{7, 6, 6, 8, 17, 8, 1};
        for (std::size_t i = 0; i < expected.size(); ++i)
            EXPECT_EQ(s.atoms[i].element, expected[i]) << i;
        EXPECT_EQ(s.atoms[7].role, AtomRole::Particle);
        ASSERT_EQ(s.residues.size(), 3u);
        EXPECT_EQ(s.residues[0].name, "GLY");
        EXPECT_EQ(s.residues[2].number, 3);
        EXPECT_TRUE(s.residues[2].water());
        ASSERT_EQ(s.charges.size(), 8u);
        EXPECT_NEAR(s.charges[0], -0.4157, 1e-5);
        EXPECT_NEAR(s.charges[4], -1.0, 1e-6);
    }
}

TEST(ReadParm7, NamesTheSectionThatIsWrong)
{
    const auto without = [](const std::string& begin, std::size_t count) {
        std::string text = parm7(true);
        return text.erase(text.find(begin), count);
    };
    EXPECT_HAS(errorAs("a.parm7", "%VERSION\n"), "expected 12 fields of POINTERS, got 0");
    EXPECT_HAS(errorAs("a.parm7", without("  1.60000000E+01  1.00800000E+00", 49)),
               "expected 8 fields of MASS, got 5");
    EXPECT_HAS(errorAs("a.parm7", without("%FLAG RESIDUE_LABEL", 20)), "of RESIDUE_LABEL, got 0");
    std::string wrong = parm7(true);
    wrong.replace(wrong.find("1.40100000E+01"), 14, "1.4010000xE+01");
    EXPECT_HAS(errorAs("a.parm7", wrong), "expected numbers in MASS");
    wrong = parm7(true);
    wrong.replace(wrong.find("(5E16.8)"), 8, "(5X16.8)");
    EXPECT_HAS(errorAs("a.parm7", wrong), "expected a format as (20a4)");
}

} // namespace
} // namespace molsurf::test
