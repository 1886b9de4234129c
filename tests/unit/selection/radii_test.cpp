// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/radii.h"

#include "molsurf/molecule/selection/select_balls.h"
#include "molsurf/molecule/structure/read_structure.h"
#include "unit/structure/temp_file.h"

#include <cmath>

namespace molsurf::test
{
namespace
{

constexpr std::uint8_t hydrogen = 1, carbon = 6, nitrogen = 7, iron = 26, zinc = 30,
                       promethium = 61;

TEST(Radii, BuiltInSets)
{
    const RadiiSet bondi = readRadii("bondi"), alvarez = readRadii("alvarez"),
                   gemmi = readRadii("gemmi");
    EXPECT_EQ(bondi.find("ALA", "CA", carbon), 1.70);
    EXPECT_EQ(bondi.find("ALA", "H", hydrogen), 1.20);
    EXPECT_EQ(bondi.find("ZN", "ZN", zinc), 1.39);
    EXPECT_EQ(bondi.find("CA", "CA", 20), 2.31);    // Mantina
    EXPECT_EQ(bondi.find("HEM", "FE", iron), 2.44); // Alvarez
    EXPECT_EQ(alvarez.find("ALA", "CA", carbon), 1.77);
    EXPECT_EQ(gemmi.find("HEM", "FE", iron), 1.26);
    EXPECT_LT(bondi.find("PM", "PM", promethium), 0);
    EXPECT_LT(bondi.find("XXX", "X", 0), 0);
}

TEST(Radii, OfAtomsWithoutAFileAreThoseOfTheFile)
{
    for (const char* set : {"bondi", "protor", "gemmi"}) {
        SelectOptions options;
        options.radii = set;
        const BallSet read = readAtoms(dataFile("1crn.pdb"), options);
        std::vector<std::string> names, residues, elements;
        for (std::size_t i = 0; i < read.balls.size(); ++i) {
            names.push_back(read.names->atoms[i].name);
            residues.push_back(read.names->residues[std::size_t(read.names->residueOf[i])].name);
            elements.push_back(elementSymbol(read.names->atoms[i].element));
        }
        const std::vector<double> radii = atomRadii(names, residues, elements, set);
        ASSERT_EQ(radii.size(), read.balls.size());
        for (std::size_t i = 0; i < radii.size(); ++i) EXPECT_EQ(radii[i], read.balls[i].radius);
        EXPECT_EQ(atomRadii(names, residues, {}, set), radii); // names tell elements
    }
}

TEST(Radii, OfAtomsThatNothingIsKnownOfAreNone)
{
    EXPECT_TRUE(std::isnan(atomRadii({"??"}, {}, {"Xx"})[0]));
    EXPECT_EQ(atomRadii({"H"}, {"ALA"}, {"h"}, "protor")[0], 0.0);
    EXPECT_EQ(atomRadii({"ZN"}, {"ZN"}, {""}, "protor")[0], 1.39); // bondi fills the gap
    EXPECT_TRUE(atomRadii({}, {}, {}).empty());
    EXPECT_HAS(errorOf(ErrorKind::Input,
                       [] {
                           atomRadii({"C", "N"}, {"ALA"}, {});
                       }),
               "radii: expected 2 names of residues, got 1");
    EXPECT_HAS(errorOf(ErrorKind::Input, [] { atomRadii({"C"}, {}, {}, "no-such-set"); }),
               "radii: expected bondi");
}

TEST(Radii, AreListedWithTheirSource)
{
    const std::string text = describeRadii();
    for (const char* part : {"bondi: A. Bondi", "441", "alvarez: S. Alvarez", "8617",
                             "gemmi:", "martini2:", "martini3: Souza", "small 2.30", " C 1.70",
                             " C 1.77", "Fe 1.26"}) {
        EXPECT_HAS(text, part);
    }
}

// 2^(1/6) / 2 of 4.7, 4.3 and 3.2 Å, and of 4.7, 4.1 and 3.4 Å.
TEST(Radii, OfMartiniBeads)
{
    const RadiiSet two = readRadii("martini2"), three = readRadii("martini3");
    const auto near = [](float radius, double expected) {
        return std::abs(radius - expected) < 5e-4;
    };
    EXPECT_TRUE(near(two.find("ALA", "BB", 0), 2.638));
    EXPECT_TRUE(near(two.find("LYS", "SC2", 0), 2.638));
    EXPECT_TRUE(near(two.find("PHE", "BB", 0), 2.638));
    EXPECT_TRUE(near(two.find("PHE", "SC3", 0), 2.413));
    EXPECT_TRUE(near(two.find("CHOL", "R3", 0), 2.413));
    EXPECT_TRUE(near(two.find("DG", "SC4", 0), 1.796));
    EXPECT_TRUE(near(two.find("POPC", "C1A", 0), 2.638));
    EXPECT_TRUE(near(three.find("GLY", "BB", 0), 2.301));
    EXPECT_TRUE(near(three.find("ALA", "SC1", 0), 1.908));
    EXPECT_TRUE(near(three.find("TRP", "SC5", 0), 1.908));
    EXPECT_TRUE(near(three.find("PHE", "SC1", 0), 2.301));
    EXPECT_TRUE(near(three.find("W", "W", 0), 2.638));
    EXPECT_TRUE(near(three.find("TW", "TW", 0), 1.908));
    EXPECT_TRUE(near(three.find("ANY", "XYZ", 0), 2.638));
}

TEST(Radii, UnitedAtoms)
{
    const RadiiSet protor = readRadii("protor"), naccess = readRadii("naccess");
    const auto both = [&](const char* residue, const char* atom, std::uint8_t element) {
        return std::pair(protor.find(residue, atom, element), naccess.find(residue, atom, element));
    };
    EXPECT_EQ(both("ALA", "CA", carbon), std::pair(1.88, 1.87));
    EXPECT_EQ(both("TRP", "CE2", carbon), std::pair(1.61, 1.76));
    EXPECT_EQ(both("TRP", "CE3", carbon), std::pair(1.76, 1.76));
    EXPECT_EQ(both("LYS", "NZ", nitrogen), std::pair(1.64, 1.50));
    EXPECT_EQ(both("HIE", "NE2", nitrogen), std::pair(1.64, 1.65)); // a form of HIS
    EXPECT_EQ(both("DG", "C2", carbon), std::pair(1.61, 1.80));
    EXPECT_EQ(both("A", "C2", carbon), std::pair(1.76, 1.80));
    EXPECT_EQ(both("ALA", "HA", hydrogen), std::pair(0.0, 0.0)); // left out
    EXPECT_LT(protor.find("CA", "CA", 20), 0.0);                 // calcium is no carbon
    EXPECT_LT(naccess.find("HEM", "CHA", carbon), 0.0);
}

TEST(Radii, RulesOfAFileByPrecedence)
{
    const TempFile file("my.radii", "# rules\n"
                                    "C        1.70   # an element\n"
                                    "zn       0\n"
                                    "*    CA  1.88\n"
                                    "\n"
                                    "GLY  CA  1.91\n"
                                    "N        1.0\n"
                                    "N        1.5\n"
                                    "*        1.8\n");
    const RadiiSet set = readRadii(file.path());
    EXPECT_EQ(set.find("ALA", "CB", carbon), 1.70);
    EXPECT_EQ(set.find("ALA", "CA", carbon), 1.88);
    EXPECT_EQ(set.find("GLY", "CA", carbon), 1.91);
    EXPECT_EQ(set.find("GLY", "N", nitrogen), 1.5);
    EXPECT_EQ(set.find("ZN", "ZN", zinc), 0);
    EXPECT_EQ(set.find("HEM", "FE", iron), 1.8);
    EXPECT_EQ(set.find("XXX", "Q", 0), 1.8);
}

TEST(Radii, NamesFileAndLineOfAnError)
{
    auto message = [](const std::string& text) {
        const TempFile file("my.radii", "# rules\n" + text + "\n");
        const std::string what = errorOf(ErrorKind::Input, [&] { readRadii(file.path()); });
        EXPECT_HAS(what, file.path() + ": line 2: ");
        return what;
    };
    EXPECT_HAS(message("C"), "expected ELEMENT RADIUS or RESIDUE ATOM RADIUS, got 1 columns");
    EXPECT_HAS(message("ALA CA 1.7 x"), "got 4 columns");
    EXPECT_HAS(message("Zz 1.7"), "element: expected a symbol");
    EXPECT_HAS(message("C -1.7"), "radius: expected 0 to 100 Å, got \"-1.7\"");
    EXPECT_HAS(message("C nan"), "radius: expected");
    EXPECT_HAS(message("C wide"), "radius: expected");
    EXPECT_HAS(errorOf(ErrorKind::Input, [] { readRadii("bondy"); }),
               "expected bondi, alvarez, gemmi, protor, naccess, martini, martini2, martini3 or a "
               "file that exists, "
               "got \"bondy\"");
}

const std::string atoms =
    "ATOM      1  CA  GLY A   1       1.000   2.000   3.000  1.00  0.00           C\n"
    "HETATM    2 PM    PM A   2       5.000   2.000   3.000  1.00  0.00          PM\n"
    "HETATM    3 Q1   UNL A   3       9.000   2.000   3.000  1.00  0.00           X\n";

SelectOptions everything()
{
    SelectOptions options;
    options.hetero = Hetero::All;
    return options;
}

TEST(Radii, UnknownElementsTakeThatOfCarbonWithOneWarning)
{
    const TempFile file("a.pdb", atoms);
    const BallSet selection = selectBalls(readStructure(file.path()), everything());
    ASSERT_EQ(selection.balls.size(), 3u);
    EXPECT_EQ(selection.balls[1].radius, 1.7);
    EXPECT_EQ(selection.balls[2].radius, 1.7);
    ASSERT_EQ(selection.record.warnings.size(), 1u);
    EXPECT_HAS(selection.record.warnings[0],
               "Pm (1 atom), unknown element of atom \"Q1\" (1 atom)");
}

TEST(Radii, WhatAFileLacksComesFromBondi)
{
    const TempFile file("a.pdb", atoms), radii("my.radii", "PM 2.0\n* Q1 3.0\n");
    SelectOptions options = everything();
    options.radii = radii.path();
    const BallSet selection = selectBalls(readStructure(file.path()), options);
    EXPECT_EQ(selection.balls[0].radius, 1.7);
    EXPECT_EQ(selection.balls[1].radius, 2.0);
    EXPECT_EQ(selection.balls[2].radius, 3.0);
    ASSERT_EQ(selection.record.warnings.size(), 1u);
    EXPECT_HAS(selection.record.warnings[0], "lacks C (1 atom): bondi was used");
}

TEST(Radii, AZeroInAFileLeavesTheAtomOut)
{
    const TempFile file("a.pdb", atoms), radii("my.radii", "* 1.9\nC 0\n");
    SelectOptions options = everything();
    options.radii = radii.path();
    const BallSet selection = selectBalls(readStructure(file.path()), options);
    EXPECT_EQ(selection.balls.size(), 2u);
    ASSERT_EQ(selection.record.drops.size(), 1u);
    EXPECT_EQ(selection.record.drops[0].reason, "zero radius");
}

// Every radius of the publications, written once more.
TEST(Radii, AreThosePublished)
{
    const RadiiSet bondi = readRadii("bondi");
    const std::pair<int, double> published[] = {
        {1, 1.20},  {2, 1.40},  {3, 1.82},  {4, 1.53},  {5, 1.92},  {6, 1.70},  {7, 1.55},
        {8, 1.52},  {9, 1.47},  {10, 1.54}, {11, 2.27}, {12, 1.73}, {13, 1.84}, {14, 2.10},
        {15, 1.80}, {16, 1.80}, {17, 1.75}, {18, 1.88}, {19, 2.75}, {20, 2.31}, {28, 1.63},
        {29, 1.40}, {30, 1.39}, {31, 1.87}, {32, 2.11}, {33, 1.85}, {34, 1.90}, {35, 1.85},
        {36, 2.02}, {37, 3.03}, {38, 2.49}, {46, 1.63}, {47, 1.72}, {48, 1.58}, {49, 1.93},
        {50, 2.17}, {51, 2.06}, {52, 2.06}, {53, 1.98}, {54, 2.16}, {55, 3.43}, {56, 2.68},
        {78, 1.75}, {79, 1.66}, {80, 1.55}, {81, 1.96}, {82, 2.02}, {83, 2.07}, {92, 1.86}};
    for (const auto& [element, radius] : published)
        EXPECT_EQ(bondi.find("XXX", "X", std::uint8_t(element)), radius) << element;
}

} // namespace
} // namespace molsurf::test
