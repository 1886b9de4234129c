// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/select_balls.h"

#include "molsurf/molecule/structure/read_structure.h"
#include "unit/structure/temp_file.h"

#include <cstdio>

namespace molsurf::test
{
namespace
{

/// One line of a PDB file.
std::string atom(const char* name, char altloc, const char* residue, int number, double occupancy)
{
    static int count = 0; // no two atoms lie in one place
    char line[96];
    std::snprintf(line, sizeof line,
                  "ATOM      1  %-3s%c%3s A%4d    %8.3f   2.000   3.000%6.2f  0.00           C\n",
                  name, altloc, residue, number, 0.1 * ++count, occupancy);
    return line;
}

/// The chosen atoms as "name altloc" of each.
std::string chosen(const std::string& text, const std::string& altloc = "")
{
    const TempFile file("a.pdb", text);
    const Structure s = readStructure(file.path());
    SelectOptions options;
    options.altloc = altloc;
    std::string names;
    for (const Ball& ball : selectBalls(s, options).balls) {
        const Atom& a = s.atoms[static_cast<std::size_t>(ball.atom)];
        names += (names.empty() ? "" : " ") + a.name;
        if (a.altloc) names += std::string(":") + a.altloc;
    }
    return names;
}

TEST(Altloc, KeepsTheReadingOfTheLargestSum)
{
    EXPECT_EQ(chosen(atom("N", ' ', "SER", 1, 1) + atom("CA", 'A', "SER", 1, 0.3) +
                     atom("CA", 'B', "SER", 1, 0.7) + atom("CB", 'A', "SER", 1, 0.6) +
                     atom("CB", 'B', "SER", 1, 0.4)),
              "N CA:B CB:B");
}

// A location without a letter is a reading beside those of the same atoms with one.
TEST(Altloc, ABlankLocationIsAReading)
{
    const std::string blank = atom("CA", ' ', "SER", 1, 0.6) + atom("CB", ' ', "SER", 1, 0.6),
                      other = atom("CA", 'B', "SER", 1, 0.4) + atom("CB", 'B', "SER", 1, 0.4),
                      alone = atom("N", ' ', "SER", 1, 1);
    EXPECT_EQ(chosen(alone + blank + other), "N CA CB");
    EXPECT_EQ(chosen(alone + blank + other, "B"), "N CA:B CB:B");
    EXPECT_EQ(chosen(alone + blank + other, "all"), "N CA CB CA:B CB:B");
    EXPECT_EQ(chosen(alone + atom("CA", ' ', "SER", 1, 0.3) + atom("CA", 'B', "SER", 1, 0.7)),
              "N CA:B");
}

// Occupancies of the names that readings share decide, not those of their own.
TEST(Altloc, AtomsOfItsOwnGiveAReadingNoWeight)
{
    EXPECT_EQ(chosen(atom("CB", 'A', "SER", 1, 0.6) + atom("CB", 'B', "SER", 1, 0.4) +
                     atom("OG", 'B', "SER", 1, 0.4)),
              "CB:A");
}

TEST(Altloc, ATieKeepsOneConformer)
{
    EXPECT_EQ(chosen(atom("CA", 'A', "SER", 1, 0.5) + atom("CA", 'B', "SER", 1, 0.5) +
                     atom("CB", 'B', "SER", 1, 0.5) + atom("CB", 'A', "SER", 1, 0.5)),
              "CA:A CB:A");
    EXPECT_EQ(chosen(atom("CA", 'A', "SER", 1, 0.5) + atom("CA", 'B', "SER", 1, 0.5) +
                     atom("CB", 'A', "SER", 1, 0.4) + atom("CB", 'B', "SER", 1, 0.6)),
              "CA:B CB:B");
}

TEST(Altloc, AnAtomWithOneLocationStays)
{
    EXPECT_EQ(chosen(atom("CA", 'B', "SER", 1, 0.2) + atom("CB", 'A', "SER", 1, 0.5)), "CA:B CB:A");
}

// Atoms of one reading beside those of another would be bonded to none.
TEST(Altloc, ReadingsWithAtomsOfTheirOwnStayWhole)
{
    const std::string a = atom("CB", 'A', "SER", 8, 0.5) + atom("OG", 'A', "SER", 8, 0.5);
    const std::string b = atom("CB", 'B', "SER", 8, 0.5) + atom("OG", 'B', "SER", 8, 0.5) +
                          atom("HG", 'B', "SER", 8, 0.43);
    EXPECT_EQ(chosen(atom("N", ' ', "SER", 8, 1) + a + b), "N CB:A OG:A");
    EXPECT_EQ(chosen(atom("CB", 'A', "SER", 8, 0.4) + atom("OG", 'A', "SER", 8, 0.4) + b),
              "CB:B OG:B HG:B");
    // A label that shares no atom with another stays beside it.
    EXPECT_EQ(chosen(a + b + atom("N", 'C', "SER", 8, 0.3)), "CB:A OG:A N:C");
}

TEST(Altloc, OfDifferentResiduesOneStays)
{
    const std::string text = atom("N", 'A', "SER", 22, 0.2) + atom("N", 'B', "SER", 22, 0.2) +
                             atom("OG", 'A', "SER", 22, 0.2) + atom("OG", 'B', "SER", 22, 0.2) +
                             atom("N", 'C', "PRO", 22, 0.6) + atom("CG", 'C', "PRO", 22, 0.6);
    EXPECT_EQ(chosen(text), "N:C CG:C");
    EXPECT_EQ(chosen(text, "A"), "N:A OG:A");
    EXPECT_EQ(chosen(text, "all"), "N:A N:B OG:A OG:B N:C CG:C");
}

TEST(Altloc, OfDifferentResiduesOneStaysEvenIfTheyShareNoName)
{
    EXPECT_EQ(chosen(atom("N", 'A', "SER", 22, 0.6) + atom("OG", 'A', "SER", 22, 0.6) +
                     atom("C7", 'B', "LIG", 22, 0.4)),
              "N:A OG:A");
}

// 0.1 and 0.2 are no less than 0.3, as they are in floats.
TEST(Altloc, RoundingDecidesNothing)
{
    EXPECT_EQ(chosen(atom("CA", 'A', "SER", 1, 0.1) + atom("CB", 'A', "SER", 1, 0.2) +
                     atom("CA", 'B', "SER", 1, 0.3) + atom("CB", 'B', "SER", 1, 0.0)),
              "CA:A CB:A");
}

TEST(Altloc, ResiduesWithInsertionCodesAreSitesOfTheirOwn)
{
    std::string inserted = atom("CA", 'A', "SER", 52, 0.3) + atom("CB", ' ', "SER", 52, 1) +
                           atom("CA", 'B', "SER", 52, 0.7);
    constexpr std::size_t code = 26; // column
    const std::size_t length = inserted.size() / 3;
    for (std::size_t line = 0; line < 3; ++line) inserted[line * length + code] = 'A';
    const std::string before = atom("CA", 'A', "SER", 52, 0.6) + atom("CA", 'B', "SER", 52, 0.4);
    EXPECT_EQ(chosen(before + inserted), "CA:A CB CA:B");
}

/// One reading of several residues may come behind the other.
TEST(Altloc, OfBlocksOneStays)
{
    std::string text = atom("CA", ' ', "GLY", 2, 1);
    for (const char label : {'A', 'B'})
        for (const int number : {3, 4})
            text += atom("CA", label, "SER", number, 0.5) + atom("CB", label, "SER", number, 0.5);
    EXPECT_EQ(chosen(text + atom("CA", ' ', "GLY", 5, 1)), "CA CA:A CB:A CA:A CB:A CA");
}

TEST(Altloc, ALabelKeepsTheBlankOnesToo)
{
    const std::string text = atom("N", ' ', "SER", 1, 1) + atom("CA", 'A', "SER", 1, 0.7) +
                             atom("CA", 'B', "SER", 1, 0.3);
    EXPECT_EQ(chosen(text, "B"), "N CA:B");
    EXPECT_HAS(errorOf(ErrorKind::Input, [&] { chosen(text, "C"); }),
               "alternate location \"C\": expected one of A, B");
    EXPECT_HAS(errorOf(ErrorKind::Usage, [&] { chosen(text, "AB"); }), "expected one character");
}

TEST(Altloc, WarnsIfThereAreNone)
{
    SelectOptions options;
    options.altloc = "A";
    const BallSet selection = selectBalls(readStructure(dataFile("1crn.pdb")), options);
    EXPECT_EQ(selection.balls.size(), 327u);
    ASSERT_EQ(selection.record.warnings.size(), 1u);
    EXPECT_HAS(selection.record.warnings[0], "have no alternate locations");
}

} // namespace
} // namespace molsurf::test
