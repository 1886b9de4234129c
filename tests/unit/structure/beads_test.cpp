// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/beads.h"

#include "molsurf/molecule/structure/read_structure.h"
#include "unit/structure/temp_file.h"

#include <algorithm>
#include <cstdio>
#include <sstream>

namespace molsurf::test
{
namespace
{

/// PDB records, 3 Å apart: "ALA BB SC1, W W" are two residues.
Structure beads(const std::string& residues, double apart = 3.0)
{
    std::string text;
    int atom = 0, number = 0;
    std::size_t begin = 0;
    while (begin < residues.size()) {
        const std::size_t end = std::min(residues.find(',', begin), residues.size());
        std::istringstream words(residues.substr(begin, end - begin));
        std::string residue, name;
        words >> residue;
        ++number;
        while (words >> name) {
            char line[96];
            ++atom;
            std::snprintf(line, sizeof line,
                          "ATOM  %5d %-4s %-4sA%4d    %8.3f%8.3f%8.3f  1.00  0.00\n", atom,
                          (name.size() < 4 ? " " + name : name).c_str(), residue.c_str(), number,
                          apart * atom, 0.0, 0.0);
            text += line;
        }
        begin = end + 1;
    }
    return readStructure(TempFile("beads.pdb", text).path());
}

TEST(Beads, MartiniByItsNames)
{
    EXPECT_EQ(beads("GLY BB,ALA BB,LYS BB SC1 SC2").beads, BeadKind::Martini2);
    EXPECT_EQ(beads("TRP BB SC1 SC2 SC3 SC4").beads, BeadKind::Martini2);
    EXPECT_EQ(beads("GLY BB,ALA BB SC1,LYS BB SC1 SC2").beads, BeadKind::Martini3);
    EXPECT_EQ(beads("TYR BB SC1 SC2 SC3 SC4").beads, BeadKind::Martini3);
    EXPECT_EQ(beads("LEU BB SC1,LYS BB SC1 SC2").beads, BeadKind::Martini3); // no evidence
    EXPECT_EQ(beads("POP NC3 PO4 GL1 GL2 C1A D2A C3A C4A C1B C2B").beads, BeadKind::Martini3);
}

TEST(Beads, AmongAtomsAreNone)
{
    EXPECT_EQ(beads("GLY BB,ALA BB SC1,LYS BB SC1 SC2 SC3,SER N C O CB OG").beads, BeadKind::None);
}

TEST(Beads, ChargesOfHaddockAreNone)
{
    const Structure s = beads("ASP BB SC1 SCD1,GLN BB SC1 SCD1 SCD2");
    ASSERT_NE(s.beads, BeadKind::None);
    EXPECT_EQ(s.atoms[1].role, AtomRole::Atom);
    for (const std::size_t i : {2u, 5u, 6u}) EXPECT_EQ(s.atoms[i].role, AtomRole::Particle) << i;
}

TEST(Beads, MartiniBeadsHaveNoElementAndKnowWater)
{
    const Structure s = beads("ALA BB,LYS BB SC1 SC2,W W,W W,POP NC3 PO4 GL1");
    ASSERT_EQ(s.beads, BeadKind::Martini2);
    std::size_t waters = 0;
    for (const Atom& atom : s.atoms) EXPECT_EQ(atom.element, 0) << atom.name;
    for (const Residue& residue : s.residues) waters += residue.water();
    EXPECT_EQ(waters, 2u);
    EXPECT_FALSE(s.residues[0].hetero());
    EXPECT_TRUE(s.residues.back().hetero());
}

TEST(Beads, NamedByAtoms)
{
    EXPECT_EQ(beads("MET CA CG,ALA CA,PHE CA CE1 CE2").beads, BeadKind::Unnamed);
    EXPECT_EQ(beads("MET CA CG,ALA CA,PHE CA CE1 CE2").atoms[0].element, 6);
    EXPECT_EQ(beads("MET CA CG,ALA CA", 1.8).beads, BeadKind::None);          // bonded
    EXPECT_EQ(beads("ALA CA,ALA CA,GLY CA,LYS CA").beads, BeadKind::Unnamed); // a trace
    EXPECT_EQ(beads("ALA CA,ALA CA,GLY CA").beads, BeadKind::None);           // too few to tell
    EXPECT_EQ(beads("ALA N CA C,GLY CA").beads, BeadKind::None);              // a backbone
    EXPECT_EQ(beads("MET CA CG,XYZ CA CB").beads, BeadKind::None);            // no amino acid
    EXPECT_EQ(beads("MET CA CG,ALA CB").beads, BeadKind::None);               // without CA
}

TEST(Beads, AtomsAreNone)
{
    for (const char* file : {"1crn.pdb", "1ubq.pdb", "1a8o.cif.gz", "1d3z.pdb.gz", "4at1.ent.gz"})
        EXPECT_EQ(readStructure(dataFile(file)).beads, BeadKind::None) << file;
    // Heme has C1A, C2A, ..., sodium and chloride have their own names.
    EXPECT_EQ(beads("HEM C1A C2A C3A C4A C1B C2B C3B C4B,NA NA,CL CL").beads, BeadKind::None);
    // One bead does not make a file of beads.
    EXPECT_EQ(beads("ALA N CA C O CB,LYS BB SC1").beads, BeadKind::None);
}

} // namespace
} // namespace molsurf::test
