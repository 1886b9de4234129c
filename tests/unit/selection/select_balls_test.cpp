// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/select_balls.h"

#include "molsurf/molecule/selection/subset.h"
#include "molsurf/molecule/structure/read_structure.h"
#include "unit/structure/temp_file.h"

#include <map>

namespace molsurf::test
{
namespace
{

Structure readText(const std::string& name, const std::string& text)
{
    return readStructure(TempFile(name, text).path());
}

std::map<std::string, std::size_t> dropsOf(const BallSet& selection)
{
    std::map<std::string, std::size_t> drops;
    for (const Excluded& drop : selection.record.drops) drops[drop.reason] = drop.count;
    return drops;
}

using Drops = std::map<std::string, std::size_t>;

TEST(SelectBalls, GivesEveryAtomItsBall)
{
    const Structure s = readStructure(dataFile("1crn.pdb"));
    const BallSet selection = selectBalls(s, {});
    ASSERT_EQ(selection.balls.size(), 327u);
    EXPECT_TRUE(selection.record.drops.empty());
    EXPECT_TRUE(selection.record.warnings.empty());
    EXPECT_EQ(selection.placement.begin, (std::vector<std::size_t>{0, 327}));
    for (std::size_t i = 0; i < 327; ++i) {
        EXPECT_EQ(selection.balls[i].atom, static_cast<std::int32_t>(i));
        EXPECT_EQ(selection.balls[i].center, s.atoms[i].position);
    }
    EXPECT_EQ(selection.balls[0].radius, 1.55);
    EXPECT_EQ(selection.balls[1].radius, 1.70);
}

TEST(SelectBalls, DropsWatersUnlessAsked)
{
    const Structure s = readStructure(dataFile("1ubq.pdb"));
    EXPECT_EQ(dropsOf(selectBalls(s, {})), (Drops{{"water", 58}}));
    SelectOptions options;
    options.waters = true;
    EXPECT_EQ(selectBalls(s, options).balls.size(), 660u);
    EXPECT_EQ(describeSelection(s, selectBalls(s, {})),
              "1ubq.pdb: PDB, 1 model, 660 atoms; used 602 atoms; dropped 58 water");
}

TEST(SelectBalls, DropsExactDuplicatesAndWarns)
{
    std::string text = "1 2 3 1.5\n1 2 3 1.7\n1 2 3 1.5\n-0.0 2 3 1.5\n0 2 3 1.5\n1 2 3 1.5\n";
    const Structure s = readText("twice.xyzr", text);
    const BallSet selection = selectBalls(s, {});
    EXPECT_EQ(dropsOf(selection), (Drops{{"duplicate", 3}}));
    ASSERT_EQ(selection.balls.size(), 3u);
    EXPECT_EQ(selection.balls[0].atom, 0);
    EXPECT_EQ(selection.balls[1].atom, 1); // another radius
    EXPECT_EQ(selection.balls[2].atom, 3);
    ASSERT_EQ(selection.record.warnings.size(), 1u);
    EXPECT_EQ(selection.record.warnings[0],
              "3 atoms lie exactly where another of the same radius lies: "
              "dropped; the first is atom 3");
}

TEST(SelectBalls, DropsLigandsAndHydrogensOnRequest)
{
    SelectOptions options;
    options.hetero = Hetero::None;
    const Structure old = readStructure(dataFile("4at1.ent.gz"));
    EXPECT_EQ(dropsOf(selectBalls(old, options)), (Drops{{"ligand or ion", 64}}));
    EXPECT_EQ(selectBalls(readStructure(dataFile("1a8o.pdb.gz")), options).balls.size(), 556u);
    EXPECT_EQ(selectBalls(readStructure(dataFile("1a8o.cif.gz")), options).balls.size(), 556u);
    options.hydrogens = false;
    const Structure nmr = readStructure(dataFile("1d3z.pdb.gz"));
    EXPECT_EQ(dropsOf(selectBalls(nmr, options)), (Drops{{"hydrogen", 629}}));
}

TEST(SelectBalls, UsesOneModel)
{
    const Structure s = readStructure(dataFile("1d3z.pdb.gz"));
    SelectOptions options;
    EXPECT_EQ(selectBalls(s, options).record.model, 1);
    options.model = 4;
    const BallSet selection = selectBalls(s, options);
    EXPECT_EQ(selection.record.model, 4);
    EXPECT_EQ(selection.balls[0].atom, 3 * 1231);
    EXPECT_EQ(subset(selection, {0, 2}).record.model, 4);
    EXPECT_EQ(describeSelection(s, selection),
              "1d3z.pdb.gz: PDB, 10 models, 1231 atoms in model 4; used 1231 atoms");
    options.model = 11;
    EXPECT_HAS(errorOf(ErrorKind::Input, [&] { selectBalls(s, options); }),
               "model 11: expected one of 1, 2, 3");
}

TEST(SelectBalls, TheSelectionsModelMustAgree)
{
    const Structure s = readStructure(dataFile("1d3z.pdb.gz"));
    SelectOptions options;
    options.select = "/2/A/1-10";
    EXPECT_EQ(selectBalls(s, options).record.model, 2);
    options.model = 1;
    EXPECT_HAS(errorOf(ErrorKind::Usage, [&] { selectBalls(s, options); }), "names model 2");
    options.model = 0;
    options.select = "/2/A/1-10|/3/A";
    EXPECT_HAS(errorOf(ErrorKind::Usage, [&] { selectBalls(s, options); }), "names model 3");
}

TEST(SelectBalls, SaysWhyNothingIsLeft)
{
    SelectOptions options;
    options.select = "*;solvent";
    const Structure s = readStructure(dataFile("1ubq.pdb"));
    EXPECT_HAS(errorOf(ErrorKind::Input, [&] { selectBalls(s, options); }),
               "nothing is left of 660 atoms: dropped 602 not selected, 58 water [hint: `waters` "
               "keeps it]");
}

TEST(SelectBalls, DropsDummiesAndZeroRadii)
{
    const Structure membrane = readText(
        "a.pdb", "ATOM      1  CA  GLY A   1       1.000   2.000   3.000  1.00  0.00           C\n"
                 "HETATM    2  N   DUM  4325     -40.000   0.000  15.200                      \n"
                 "HETATM    3 DUM  MEM  4326     -40.000   0.000  15.200                      \n");
    EXPECT_EQ(dropsOf(selectBalls(membrane, {})), (Drops{{"dummy", 2}}));
    const Structure balls = readText("a.xyzr", "0 0 0 1.5\n1 0 0 0\n2 0 0 0.0\n");
    EXPECT_EQ(dropsOf(selectBalls(balls, {})), (Drops{{"zero radius", 2}}));
    SelectOptions withHydrogens;
    withHydrogens.radii = "protor";
    const Structure amine = readText(
        "a.pdb",
        "ATOM      1  N   GLY A   1       1.000   2.000   3.000  1.00  0.00           N\n"
        "ATOM      2  H   GLY A   1       1.000   2.000   4.000  1.00  0.00           H\n");
    EXPECT_EQ(dropsOf(selectBalls(amine, withHydrogens)),
              (Drops{{"hydrogen in radii of heavy atoms", 1}}));
    const Structure none = readText("a.xyzr", "0 0 0 0\n");
    EXPECT_HAS(errorOf(ErrorKind::Input, [&] { selectBalls(none, {}); }), "1 zero radius");
}

TEST(SelectBalls, KeepsTheRadiiOfTheFile)
{
    const Structure s = readText("a.xyzr", "0 0 0 1.25\n5 0 0 2.5\n");
    EXPECT_EQ(selectBalls(s, {}).balls[1].radius, 2.5f);
    SelectOptions options;
    options.radii = "alvarez";
    EXPECT_HAS(errorOf(ErrorKind::Usage, [&] { selectBalls(s, options); }), "a.xyzr has its own");
}

TEST(SelectBalls, RefusesAMoleculeLargerThanAnyGrid)
{
    const Structure s = readText("a.xyzr", "-600000 0 0 1\n600000 0 0 1\n");
    EXPECT_HAS(errorOf(ErrorKind::Input, [&] { selectBalls(s, {}); }),
               "extent in x: expected at most 1e6 Å, got 1200000");
}

TEST(SelectBalls, TellsHowFarPlacesAreRounded)
{
    EXPECT_TRUE(selectBalls(readText("a.xyzr", "9000 0 0 1\n"), {}).record.warnings.empty());
    const BallSet far = selectBalls(readText("a.xyzr", "0 -800000.11 0 1\n"), {});
    ASSERT_EQ(far.record.warnings.size(), 1u);
    EXPECT_HAS(far.record.warnings[0], "rounded to 0.1 Å");
}

TEST(SelectBalls, PassesOnTheWarningsOfTheFile)
{
    const std::string atom =
        "ATOM      1  CA  GLY A   1       1.000   2.000   3.000  1.00  0.00           C\n";
    const BallSet selection =
        selectBalls(readText("a.pdb", "MTRIX1   2  0.000000 what\n" + atom), {});
    ASSERT_EQ(selection.record.warnings.size(), 1u);
}

// Cancelled at each question that a reading asks: between all of its stages.
TEST(ReadAtoms, EndsWhenCancelled)
{
    struct StopAfter : Progress {
        explicit StopAfter(int n) : left(n) {}
        mutable int left;
        bool cancelled() const override { return --left < 0; }
    };
    for (const char* name : {"1a8o.cif.gz", "1a8o.bcif.gz", "1a8o.pdb.gz"}) {
        StopAfter count(1000);
        readAtoms(dataFile(name), {}, 0.0, count);
        const int questions = 1000 - count.left;
        EXPECT_GE(questions, 7) << name;
        for (int k = 0; k < questions; ++k)
            EXPECT_THROW(readAtoms(dataFile(name), {}, 0.0, StopAfter(k)), Cancelled) << name << k;
    }
}

} // namespace
} // namespace molsurf::test
