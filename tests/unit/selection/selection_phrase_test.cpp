// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/selection_phrase.h"

#include "molsurf/molecule/selection/match_atoms.h"
#include "molsurf/molecule/structure/read_structure.h"
#include "unit/structure/temp_file.h"

#include <algorithm>
#include <cstdio>

namespace molsurf::test
{
namespace
{

/// Three atoms (N, CA and O5') of residues -5 to 12 and 10A of chain A, of 1 and -1 of chain B, of
/// 3 of the chain without a name, and of 7 of chain A-2.
Structure manyNumbers()
{
    std::string text;
    const auto add = [&](char chain, int number, char code, const char* name) {
        for (const char* atom : {" N  ", " CA ", " O5'"}) {
            char line[100];
            std::snprintf(line, sizeof line,
                          "ATOM      1 %s %3s %c%4d%c   %8.3f   0.000   0.000  1.00  0.00\n", atom,
                          name, chain, number, code, double(number));
            text += line;
        }
    };
    for (int n = -5; n <= 12; ++n) add('A', n, ' ', "ALA");
    add('A', 10, 'A', "GLY");
    add('B', 1, ' ', "SER");
    add('B', -1, ' ', "LEU");
    add(' ', 3, ' ', "LYS");
    add('C', 7, ' ', "ILE");
    Structure s = readStructure(TempFile("a.pdb", text).path());
    *std::find(s.chains.begin(), s.chains.end(), "C") = "A-2";
    return s;
}

std::size_t count(const std::string& expression)
{
    static const Structure structure = manyNumbers();
    try {
        const AtomMatch match = matchAtoms(structure, expression);
        return std::size_t(std::count(match.atoms.begin(), match.atoms.end(), 1));
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Input) << error.what(); // it matches nothing
        return 0;
    }
}

struct Counted {
    const char* expression;
    std::size_t atoms;
};

// What gemmi 0.7.5 selects of the same atoms, without chain A-2 (which it cannot name).
TEST(Selection, SelectsWhatGemmi075Selects)
{
    const Counted all[] = {
        {"A/-1", 3},     {"A/-4--2", 9},   {"-1", 6},       {"-4--2", 9},     {"A/-3-2", 18},
        {"A/-3-", 51},   {"A/3-", 33},     {"A/-2-*", 48},  {"A/10", 3},      {"A/10.A", 3},
        {"A/10A", 3},    {"A/10.", 3},     {"A/10.*", 6},   {"A/9-10A", 9},   {"A/10.A-12", 9},
        {"A/*(GLY)", 3}, {"A/(GLY)", 3},   {"A,B", 63},     {"//", 3},        {"//A//CA", 19},
        {"A//[N]", 19},  {"A//[!N]", 38},  {"A//N,CA", 38}, {"A//!N", 38},    {"A//CA[C]", 19},
        {"A//CA:A", 0},  {"A/-1/CA", 1},   {"A;q>0.5", 57}, {"A/-1(ALA)", 3}, {"/1/A/-1.", 3},
        {"A/2-1", 0},    {":A", 0},        {"A//CA:", 19},  {"B/-1", 3},      {"3", 6},
        {"1-3", 15},     {"(ALA)/CA", 18}, {"1.A", 0},      {"A/10-10.A", 6}, {"A/12-", 3},
        {"(LYS)", 3},    {"A/(!ALA)", 3},  {"A//O5'", 19},  {"/1/A", 57},     {"/2/A", 0}};
    for (const Counted& one : all) EXPECT_EQ(count(one.expression), one.atoms) << one.expression;
}

// What gemmi 0.5.7 selects of them: it has no negative numbers.
TEST(Selection, SelectsWhatGemmi057Selects)
{
    const Counted all[] = {{"A/*-3", 27},  {"A/.-3", 27}, {"A/3-", 33},   {"A/3-5", 9},
                           {"A,B", 63},    {"A//CA", 19}, {"A/10.*", 6},  {"(GLY)", 3},
                           {"A//[N]", 19}, {"A;b<1", 57}, {"A/9-10A", 9}, {"//A/3/N", 1}};
    for (const Counted& one : all) EXPECT_EQ(count(one.expression), one.atoms) << one.expression;
}

TEST(Selection, HasWhatGemmiHasNot)
{
    const Counted all[] = {{"A-2", 3},        {"A-2/7", 3},        {"A-2,B", 9},
                           {"\"A-2\"", 3},    {"'A'/3", 3},        {"A//\"O5'\"", 19},
                           {"A/--3", 9},      {"*;protein", 69},   {"*;nucleic", 0},
                           {"*;!water", 69},  {"*;ion,ligand", 0}, {"A;!protein,water", 0},
                           {"A/3-5(ALA)", 9}, {"!A", 12},          {"!A,A-2", 9}};
    for (const Counted& one : all) EXPECT_EQ(count(one.expression), one.atoms) << one.expression;
}

TEST(Selection, WordsAreThoseOfTheTableOfResidues)
{
    const std::string line = "HETATM    1 %s   %8.3f   0.000   0.000  1.00  0.00          %s\n";
    std::string text;
    int x = 0;
    const auto add = [&](const char* names, const char* element) {
        char out[100];
        std::snprintf(out, sizeof out, line.c_str(), names, 9.0 * ++x, element);
        text += out;
    };
    add(" CA  ALA A   1 ", " C");
    add("ZN    ZN A   2 ", "ZN");
    add(" S   SO4 A   3 ", " S");
    add(" C1  OLA A   4 ", " C");
    add(" C1  NAG A   5 ", " C");
    add(" C1  LIG A   6 ", " C");
    add(" O   HOH A   7 ", " O");
    const Structure s = readStructure(TempFile("a.pdb", text).path());
    const auto chosen = [&](const std::string& word) {
        std::string out;
        const AtomMatch match = matchAtoms(s, "*;" + word);
        for (std::size_t i = 0; i < s.atoms.size(); ++i)
            if (match.atoms[i]) out += std::to_string(i + 1);
        return out;
    };
    EXPECT_EQ(chosen("ion"), "2");
    EXPECT_EQ(chosen("buffer"), "3");
    EXPECT_EQ(chosen("lipid"), "4");
    EXPECT_EQ(chosen("sugar"), "5");
    EXPECT_EQ(chosen("ligand"), "16"); // an amino acid alone
    EXPECT_EQ(chosen("water"), "7");
    EXPECT_EQ(chosen("solvent"), "7");
    EXPECT_EQ(chosen("hetero"), "123456");
    EXPECT_EQ(chosen("ion,buffer"), "23");
    EXPECT_EQ(chosen("!ion,buffer"), "14567");
    EXPECT_EQ(chosen("hetero;!ion"), "13456"); // both hold
}

TEST(Selection, SaysWhatItExpected)
{
    const auto message = [](const char* text) {
        return errorOf(ErrorKind::Usage, [&] { readPhrase(text); });
    };
    EXPECT_HAS(message("A/x"),
               "selection \"A/x\": expected a / or ; behind the residues, got \"x\"");
    EXPECT_HAS(message("A/-"), "a number of a residue");
    EXPECT_HAS(message("A/(ALA"), "a ) behind the names of residues");
    EXPECT_HAS(message("A;within 5"), "a kind of residues (polymer, protein");
    EXPECT_HAS(message("A;b<x"), "q (occupancy) or b (B factor)");
    EXPECT_HAS(message("/x/A"), "the number of a model");
    EXPECT_HAS(message("'A"), "a quote at the end");
    EXPECT_HAS(message("A//C*"), "quotes around names");
    EXPECT_HAS(message("[Zz]"), "the symbol of an element");
    EXPECT_HAS(message("A//CA:AB"), "alternate locations of one letter");
}

} // namespace
} // namespace molsurf::test
