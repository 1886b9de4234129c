// SPDX-License-Identifier: MPL-2.0

#include "molsurf/molecule/selection/choose_copies.h"
#include "molsurf/molecule/selection/select_balls.h"
#include "molsurf/molecule/structure/read_structure.h"

#include "unit/structure/temp_file.h"

#include <cstdio>
#include <set>
#include <string>

namespace molsurf::test
{
namespace
{

std::string record(const char* kind, int serial, const char* atom, const char* residue, int number,
                   double x, const char* element)
{
    char line[100];
    std::snprintf(line, sizeof line,
                  "%-6s%5d %-4s %3s A%4d    %8.3f%8.3f%8.3f  1.00  0.00          %2s\n", kind,
                  serial, atom, residue, number, x, 0.0, 0.0, element);
    return line;
}

/// A glycine at 0; all else along x.
const std::string polymer =
    record("ATOM", 1, " N", "GLY", 1, 0.0, "N") + record("ATOM", 2, " CA", "GLY", 1, 1.5, "C");

std::set<std::string> kept(const std::string& text, const SelectOptions& options = {})
{
    const TempFile file("a.pdb", text);
    const Structure s = readStructure(file.path());
    std::set<std::string> names;
    for (const Ball& ball : selectBalls(s, options).balls)
        names.insert(residueOf(s, s.atoms[std::size_t(ball.atom)]).name);
    return names;
}

using Names = std::set<std::string>;

TEST(Molecule, HasLigandsThatTouchItAndWhatTouchesThese)
{
    const std::string chain = record("HETATM", 3, " C1", "NAG", 2, 5.4, "C") +
                              record("HETATM", 4, " C1", "BMA", 3, 9.3, "C") +
                              record("HETATM", 5, " C1", "MAN", 4, 13.4, "C");
    EXPECT_EQ(kept(polymer + chain), (Names{"GLY", "NAG", "BMA"})); // 3.9, 3.9 and 4.1 Å apart
    SelectOptions options;
    options.hetero = Hetero::All;
    EXPECT_EQ(kept(polymer + chain, options), (Names{"GLY", "NAG", "BMA", "MAN"}));
    options.hetero = Hetero::None;
    EXPECT_EQ(kept(polymer + chain, options), Names{"GLY"});
}

TEST(Molecule, HasBoundMetalsAndNoIonsOfTheSolution)
{
    const std::string ions = record("HETATM", 3, "ZN", " ZN", 2, 4.4, "ZN") + // 2.9 Å
                             record("HETATM", 4, "MG", " MG", 3, -3.1, "MG") +
                             record("HETATM", 5, "NA", " NA", 4, -2.4, "NA") +
                             record("HETATM", 6, "CL", " CL", 5, 4.0, "CL");
    EXPECT_EQ(kept(polymer + ions), (Names{"GLY", "ZN"}));
    SelectOptions options;
    options.ions = true;
    EXPECT_EQ(kept(polymer + ions, options), (Names{"GLY", "ZN", "MG", "NA", "CL"}));
}

// An ion is an atom alone; a cluster that begins with a metal is a ligand, as far as ligands reach.
TEST(Molecule, HasClustersOfMetals)
{
    const std::string cluster = record("HETATM", 3, "FE1", "SF4", 2, 5.2, "FE") + // 3.7 Å
                                record("HETATM", 4, " S1", "SF4", 2, 7.4, "S");
    EXPECT_EQ(kept(polymer + cluster), (Names{"GLY", "SF4"}));
}

TEST(Molecule, HasNoBuffersAndTheFirstLineNamesThem)
{
    const std::string content = polymer + record("HETATM", 3, " S", "SO4", 2, 4.9, "S") +
                                record("HETATM", 4, " C1", "GOL", 3, 5.0, "C") +
                                record("HETATM", 5, "CL", " CL", 4, 20.0, "CL");
    EXPECT_EQ(kept(content), Names{"GLY"});
    const TempFile file("a.pdb", content);
    const Structure s = readStructure(file.path());
    EXPECT_HAS(describeSelection(s, selectBalls(s, {})),
               "dropped 1 free ion (CL), 2 buffer (GOL, SO4)");
    SelectOptions options;
    options.ions = true; // buffers stay out
    EXPECT_EQ(kept(content, options), (Names{"GLY", "CL"}));
}

TEST(Molecule, IsAllThereIsWithoutAPolymer)
{
    const std::string text = record("HETATM", 1, "NA", " NA", 1, 0.0, "NA") +
                             record("HETATM", 2, " S", "SO4", 2, 9.0, "S");
    EXPECT_EQ(kept(text), (Names{"NA", "SO4"}));
    SelectOptions options; // what is asked for by name is meant
    options.select = "(NA)";
    EXPECT_EQ(kept(polymer + text, options), Names{"NA"});
}

TEST(Molecule, OfAFileWithRadiiIsAll)
{
    const TempFile file("a.pqr", "ATOM 1 N GLY 1 0.0 0.0 0.0 0.0 1.5\n"
                                 "ATOM 2 NA NA 2 9.0 0.0 0.0 1.0 1.2\n");
    EXPECT_EQ(selectBalls(readStructure(file.path()), {}).balls.size(), 2u);
}

// As OpenMM, Phenix and Biopython write files: TER behind every chain, and ATOM for all.
TEST(Molecule, DoesNotDependOnTerAndRecords)
{
    const std::string rest = record("ATOM", 3, " C1", "LIG", 2, 30.0, "C") +
                             record("ATOM", 4, "CL", " CL", 3, 60.0, "CL") +
                             record("ATOM", 5, " P", "DPP", 4, 90.0, "P");
    EXPECT_EQ(kept(polymer + "TER\n" + rest), Names{"GLY"});
    SelectOptions options;
    options.hetero = Hetero::None;
    EXPECT_EQ(kept(polymer + rest + "TER\n", options), Names{"GLY"});
}

/// A structure of a glycine at 0 and a ligand at x, of which an assembly makes a copy moved by 20
/// Å.
Structure withCopy(double x)
{
    const TempFile file("a.pdb", polymer + record("HETATM", 3, " C1", "LIG", 2, x, "C"));
    Structure s = readStructure(file.path());
    Operator here{Motion::identity(), "1"};
    Operator there = here;
    there.translation = openvdb::Vec3d(20.0, 0.0, 0.0);
    s.assemblies.push_back({"1", {{{}, {here, there}}}, ""});
    return s;
}

// The ligand of copy 1 lies at the glycine of copy 2.
TEST(Molecule, OfAnAssemblyIsDecidedInTheAssembly)
{
    SelectOptions options;
    EXPECT_EQ(selectBalls(withCopy(17.0), options).balls.size(), 2u);
    options.assembly.name = "1";
    EXPECT_EQ(selectBalls(withCopy(17.0), options).balls.size(), 6u);
    EXPECT_EQ(selectBalls(withCopy(10.0), options).balls.size(), 4u);
    options.assembly.copies =
        parseCopies("1"); // what counts does not change with the copies that are used
    EXPECT_EQ(selectBalls(withCopy(17.0), options).balls.size(), 3u);
}

TEST(Molecule, OfUsedAndDroppedAtomsIsTheFile)
{
    const std::string text = polymer + record("HETATM", 3, "CL", " CL", 2, 60.0, "CL") +
                             record("HETATM", 4, " O", "HOH", 3, 90.0, "O") +
                             record("HETATM", 5, " EP", "LIG", 4, 5.0, "EP") +
                             record("HETATM", 6, " C1", "LIG", 4, 5.0, "C") +
                             record("HETATM", 7, " C1", "OLA", 5, 5.0, "C") +
                             record("HETATM", 8, " DUM", "DUM", 6, 5.0, "") +
                             record("HETATM", 9, " C1", "UNL", 7, 50.0, "C") +
                             record("HETATM", 10, " S", "SO4", 8, 5.0, "S");
    const TempFile file("a.pdb", text);
    const Structure s = readStructure(file.path());
    for (const Hetero hetero : {Hetero::None, Hetero::Bound, Hetero::All})
        for (const bool waters : {false, true}) {
            SelectOptions options;
            options.hetero = hetero;
            options.waters = waters;
            const BallSet chosen = selectBalls(s, options);
            std::size_t all = chosen.balls.size();
            for (const Excluded& drop : chosen.record.drops) all += drop.count;
            EXPECT_EQ(all, s.atoms.size()) << describeSelection(s, chosen);
        }
    EXPECT_HAS(describeSelection(s, selectBalls(s, {})), "1 particle that is no atom, 1 water");
}

// 4AT1 holds two zinc ions, each bound by four cysteines, and two ATP.
TEST(Molecule, Of4AT1KeepsZincAndATP)
{
    const Structure s = readStructure(dataFile("4at1.ent.gz"));
    EXPECT_EQ(selectBalls(s, {}).balls.size(), 7170u);
}

} // namespace
} // namespace molsurf::test
