// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/read_structure.h"
#include "unit/structure/temp_file.h"

#include <algorithm>
#include <cstdio>

namespace molsurf::test
{
namespace
{

/// A record by its name in columns 13-17, residue and chain in 18-22, number and code in 23-27, x,
/// and columns 73-80.
std::string columnsRecord(const char* name, const char* residue, const char* number, double x,
                          const char* end, double occupancy = 1.0)
{
    char line[100];
    std::snprintf(line, sizeof line,
                  "ATOM      1 %-5s%-5s%-5s   %8.3f   0.000   0.000%6.2f  0.00      %-8s\n", name,
                  residue, number, x, occupancy, end);
    return line;
}

Structure readColumns(const std::string& text)
{
    return readStructure(TempFile("a.pdb", text).path());
}

/// "A/ALA/1:2": chain, name, number and atoms of all residues.
std::string residuesIn(const Structure& s)
{
    std::string out;
    for (std::size_t r = 0; r < s.residues.size(); ++r) {
        const Residue& residue = s.residues[r];
        const auto atoms = std::count_if(s.atoms.begin(), s.atoms.end(), [&](const Atom& a) {
            return std::size_t(a.residue) == r;
        });
        out += (out.empty() ? "" : " ") + s.chains[std::size_t(residue.chain)] + "/" +
               residue.name + "/" + std::to_string(residue.number) + ":" + std::to_string(atoms);
    }
    return out;
}

std::string namesIn(const Structure& s)
{
    std::string out;
    for (const Atom& a : s.atoms) {
        out += (out.empty() ? "" : " ") + a.name;
        if (a.altloc) out += std::string(":") + a.altloc;
    }
    return out;
}

TEST(PdbColumns, SegmentsNameBlankChains)
{
    const Structure s = readColumns(columnsRecord(" CA", "GLY", "   1", 0, "A") +
                                    columnsRecord(" CA", "GLY", "   1", 9, "PROB") +
                                    columnsRecord(" CA", "GLY C", "   1", 18, "PROB"));
    EXPECT_EQ(residuesIn(s), "A/GLY/1:1 PROB/GLY/1:1 C/GLY/1:1");
    EXPECT_EQ(s.segments, (std::vector<std::string>{"A", "PROB"}));
    EXPECT_EQ(s.residues[2].segment, 1);
    // The name of the entry and the number of the line, before 1992.
    EXPECT_EQ(residuesIn(readColumns(columnsRecord(" CA", "GLY", "   1", 0, "1ABC   1"))),
              "/GLY/1:1");
}

TEST(PdbColumns, ElementsThatStandElsewhereAreNoSegments)
{
    const auto read = [](const char* nitrogen, const char* chlorine) {
        const Structure s = readColumns(columnsRecord(" N", "LIG A", "   1", 0, nitrogen) +
                                        columnsRecord("CL1", "LIG A", "   1", 2, chlorine));
        EXPECT_TRUE(s.segments.empty());
        EXPECT_EQ(s.guessed, 0u) << nitrogen;
        return residuesIn(s) + " " + std::to_string(s.atoms[0].element) + " " +
               std::to_string(s.atoms[1].element);
    };
    const std::string right = "A/LIG/1:2 7 17";
    EXPECT_EQ(read("  N", "  CL"), right);       // column 75
    EXPECT_EQ(read("   N", "   Cl"), right);     // 76
    EXPECT_EQ(read("     N", "     CL"), right); // 78 and 78-79, one column late
    EXPECT_EQ(read("     N", "    CL"), right);  // 77-78
    // A segment in column 76 of some atom: all are segments.
    const Structure s = readColumns(columnsRecord(" N", "LIG A", "   1", 0, "   N") +
                                    columnsRecord(" C1", "LIG A", "   1", 2, "   B"));
    EXPECT_EQ(s.segments, (std::vector<std::string>{"N", "B"}));
}

TEST(PdbColumns, NamesMayReachColumn17)
{
    EXPECT_EQ(namesIn(readColumns(columnsRecord(" CL11", "LIG", "   1", 0, "") +
                                  columnsRecord(" CL12", "LIG", "   1", 3, "") +
                                  columnsRecord(" HTER", "LIG", "   1", 6, ""))),
              "CL11 CL12 HTER");
    // A short name in some location, or a part of an atom: these are alternate locations.
    EXPECT_EQ(namesIn(readColumns(columnsRecord(" CG11", "VAL", "   1", 0, "") +
                                  columnsRecord(" CB 2", "VAL", "   1", 3, ""))),
              "CG1:1 CB:2");
    EXPECT_EQ(namesIn(readColumns(columnsRecord(" CG11", "VAL", "   1", 0, "", 0.5))), "CG1:1");
    EXPECT_EQ(namesIn(readColumns(columnsRecord(" OD1A", "ASP", "   1", 0, ""))), "OD1:A");
}

TEST(PdbColumns, NumbersOfFiveDigitsReachTheInsertionCode)
{
    const Structure s = readColumns(columnsRecord(" O", "HOH A", "9999", 0, "") +
                                    columnsRecord(" O", "HOH A", "10000", 9, "") +
                                    columnsRecord(" O", "HOH A", " 1001", 18, "") +
                                    columnsRecord(" O", "HOH A", "1001B", 27, ""));
    ASSERT_EQ(s.residues.size(), 4u);
    EXPECT_EQ(s.residues[1].number, 10000);
    EXPECT_EQ(s.residues[1].insertionCode, ' ');
    EXPECT_EQ(s.residues[2].number, 100);
    EXPECT_EQ(s.residues[2].insertionCode, '1');
    EXPECT_EQ(s.residues[3].number, 1001);
    EXPECT_EQ(s.residues[3].insertionCode, 'B');
}

TEST(ReadPdb, AtomsThatComeLaterBelongToTheirResidue)
{
    const auto atom = [](const char* name, const char* residue, const char* number, double x) {
        return columnsRecord(name, residue, number, x, "");
    };
    const std::string heavy = atom(" N", "ALA A", "   1", 0) + atom(" CA", "ALA A", "   1", 1.5) +
                              atom(" N", "GLY A", "   2", 3) + atom(" CA", "GLY A", "   2", 4.5);
    EXPECT_EQ(residuesIn(readColumns(heavy + atom(" H", "ALA A", "   1", 0.5) +
                                     atom(" H", "GLY A", "   2", 3.5))),
              "A/ALA/1:3 A/GLY/2:3");
    // The same names: another chain of this name. What follows belongs to the first that lacks it.
    EXPECT_EQ(residuesIn(readColumns(heavy + heavy + atom(" H", "ALA A", "   1", 0.5) +
                                     atom(" H", "GLY A", "   2", 3.5) +
                                     atom(" H", "ALA A", "   1", 0.5))),
              "A/ALA/1:3 A/GLY/2:3 A/ALA/1:3 A/GLY/2:2");
    // Chains that alternate stand one behind the other in tables.
    std::string alternating;
    for (const char* name : {" N", " CA", " C"})
        for (const char* residue : {"ALA A", "ALA B"})
            for (const char* number : {"   1", "   2"})
                alternating += atom(name, residue, number, 3.0);
    EXPECT_EQ(residuesIn(readColumns(alternating)), "A/ALA/1:3 A/ALA/2:3 B/ALA/1:3 B/ALA/2:3");
    // Waters that begin anew are others, also where one has fewer atoms.
    EXPECT_EQ(
        residuesIn(readColumns(atom(" O", "HOH A", "   1", 0) + atom(" O", "HOH A", "   2", 3) +
                               atom(" O", "HOH A", "   1", 6) + atom(" H1", "HOH A", "   1", 7))),
        "A/HOH/1:1 A/HOH/2:1 A/HOH/1:2");
}

TEST(PdbColumns, WhatStandsBehindEndIsAFrameOrAnotherMolecule)
{
    const auto chain = [](const char* residue, int atoms) {
        std::string text;
        for (int i = 0; i < atoms; ++i)
            text += columnsRecord((" C" + std::to_string(i)).c_str(), residue, "   1", 1.5 * i, "");
        return text;
    };
    const auto sizes = [](const std::string& text) {
        std::vector<std::size_t> out;
        for (const Model& model : readColumns(text).models) out.push_back(model.end - model.begin);
        return out;
    };
    using Sizes = std::vector<std::size_t>;
    const std::string protein = chain("ALA A", 4), ligand = chain("LIG B", 3);
    EXPECT_EQ(sizes(protein + "END\n" + ligand + "END\n"), Sizes{7});
    EXPECT_EQ(sizes(protein + "END\n" + ligand + "END\n" + protein + "END\n" + ligand),
              (Sizes{7, 7}));
    EXPECT_EQ(sizes(protein + "END\n" + chain("ALA A", 3) + "END\n"), (Sizes{4, 3}))
        << "a frame without its last atom";
    EXPECT_EQ(sizes("MODEL 1\n" + protein + "ENDMDL\nMODEL 2\n" + ligand + "ENDMDL\nEND\n"),
              (Sizes{4, 3}))
        << "MODEL decides";
    const Structure s = readColumns(protein + "END\n" + ligand);
    const Structure models =
        readColumns("MODEL 1\n" + protein + "ENDMDL\nEND\n" + ligand + "END\n");
    ASSERT_EQ(models.warnings.size(), 1u);
    EXPECT_EQ(models.warnings[0], "1 model has other atoms than the first one");
    ASSERT_EQ(s.warnings.size(), 1u);
    EXPECT_EQ(s.warnings[0], "END stands between molecules of other atoms: 2 were read as 1 model");
}

} // namespace
} // namespace molsurf::test
