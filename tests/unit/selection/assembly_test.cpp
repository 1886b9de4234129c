// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/select_balls.h"

#include "molsurf/kernel/core/memory.h"
#include "molsurf/molecule/structure/read_structure.h"
#include "unit/structure/temp_file.h"

namespace molsurf::test
{
namespace
{

SelectOptions assembly(const std::string& name)
{
    SelectOptions options;
    options.assembly.name = name;
    return options;
}

/// A structure of one carbon in each of the chains A, B and C, at (1, 2, 3), (1, 2, 4), (1, 2, 5).
Structure threeChains()
{
    Structure s;
    s.source = "made";
    s.chains = s.asyms = {"A", "B", "C"};
    for (std::int32_t i = 0; i < 3; ++i) {
        s.residues.push_back({"GLY", i, i, 1, ' '});
        s.atoms.push_back(
            {openvdb::Vec3d(1, 2, 3 + i), "CA", i, 6, '\0', AtomRole::Atom, 1, 0, -1});
    }
    s.models = {{1, 0, 3}};
    return s;
}

Operator moved(double x)
{
    Operator op{};
    for (std::size_t i = 0; i < 3; ++i) op.rotation[i][i] = 1;
    op.translation = openvdb::Vec3d(x, 0, 0);
    return op;
}

TEST(Assembly, OfTheDimer)
{
    for (const char* name : {"1a8o.cif.gz", "1a8o.pdb.gz"}) {
        const Structure s = readStructure(dataFile(name));
        SelectOptions options = assembly("1");
        const BallSet dry = selectBalls(s, options);
        EXPECT_EQ(dry.balls.size(), 1112u) << name;
        EXPECT_EQ(dry.placement.copies, 2u);
        EXPECT_EQ(dry.placement.begin, (std::vector<std::size_t>{0, 556, 1112}));
        EXPECT_HAS(describeSelection(s, dry),
                   "used 1112 atoms (2 copies of 556 in the file); dropped 88 water");
        options.waters = true;
        EXPECT_EQ(selectBalls(s, options).balls.size(), 1288u) << name;
    }
}

TEST(Assembly, CopiesAreRigidMotions)
{
    const Structure s = readStructure(dataFile("1a8o.cif.gz"));
    const std::vector<Ball> balls = selectBalls(s, assembly("1")).balls;
    for (std::size_t i = 0; i < 556; ++i) {
        const Ball &first = balls[i], &second = balls[556 + i];
        EXPECT_EQ(first.atom, second.atom);
        EXPECT_EQ(first.center, s.atoms[static_cast<std::size_t>(first.atom)].position);
        constexpr double rounding = 1e-12; // 100 Å in double precision
        EXPECT_NEAR((first.center - balls[0].center).length(),
                    (second.center - balls[556].center).length(), rounding);
    }
    const openvdb::Vec3d& x = balls[0].center; // operator 2 of the entry: (a - y, a - x, c - z)
    EXPECT_NEAR(balls[556].center[0], 41.98f - x[1], 1e-3);
    EXPECT_NEAR(balls[556].center[1], 41.98f - x[0], 1e-3);
    EXPECT_NEAR(balls[556].center[2], 44.46f - x[2], 1e-3);
}

TEST(Assembly, CopyByCopyAndOnlyItsChains)
{
    Structure s = threeChains();
    s.assemblies = {
        {"x",
         {{{"A", "B"}, {moved(10), moved(20)}}, {{"Q"}, {moved(99)}}, {{"A"}, {moved(30)}}},
         ""}};
    const BallSet selection = selectBalls(s, assembly("x"));
    ASSERT_EQ(selection.balls.size(), 5u);
    EXPECT_EQ(selection.placement.copies, 3u); // no atom is in chain Q
    EXPECT_EQ(selection.placement.begin, (std::vector<std::size_t>{0, 2, 4, 5}));
    const std::vector<float> x{11, 11, 21, 21, 31};
    const std::vector<std::int32_t> atoms{0, 1, 0, 1, 0};
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(selection.balls[i].center, openvdb::Vec3d(x[i], 2, 3 + atoms[i])) << i;
        EXPECT_EQ(selection.balls[i].atom, atoms[i]) << i;
    }
    ASSERT_EQ(selection.record.drops.size(), 1u);
    EXPECT_EQ(selection.record.drops[0].reason, "not in the assembly");
    EXPECT_EQ(selection.record.drops[0].count, 1u);
}

TEST(Assembly, CopiesInOnePlaceCountOnce)
{
    Structure s = threeChains();
    s.assemblies = {{"1", {{{}, {moved(10), moved(20), moved(10), moved(30)}}}, ""}};
    const BallSet selection = selectBalls(s, assembly("1"));
    EXPECT_EQ(selection.balls.size(), 9u);
    EXPECT_EQ(selection.placement.begin, (std::vector<std::size_t>{0, 3, 6, 6, 9}));
    EXPECT_EQ(selection.balls[6].center, openvdb::Vec3d(31, 2, 3));
    EXPECT_EQ(selection.record.warnings.size(), 1u);
    // Atoms that the file has in one place, and the assembly moves apart, all stay.
    for (Atom& atom : s.atoms) atom.position = openvdb::Vec3d(1, 2, 3);
    s.assemblies = {{"1", {{{"A"}, {moved(10)}}, {{"B"}, {moved(20)}}}, ""}};
    EXPECT_EQ(selectBalls(s, assembly("1")).balls.size(), 2u);
}

/// The atoms of all copies count, before any is made.
TEST(Assembly, OfMoreAtomsThanMemoryHoldsIsRefused)
{
    Structure s = threeChains();
    for (int i = 0; i < 20000; ++i) {
        s.atoms.push_back(s.atoms[0]);
        s.atoms.back().position = openvdb::Vec3d(i % 100, 3 + i / 100, 0);
    }
    s.models = {{1, 0, s.atoms.size()}};
    s.assemblies = {{"1", {{{"A"}, {}}}, ""}};
    for (int k = 0; k < 100; ++k) s.assemblies[0].parts[0].operators.push_back(moved(200 * k));
    SelectOptions options = assembly("1");
    options.limits.memory = 1 << 20;
    while (!hasMemory(80e6, options.limits.memory))
        options.limits.memory += 1 << 20; // 160 MB are needed
    EXPECT_HAS(errorOf(ErrorKind::Input, [&] { selectBalls(s, options); }), "its atoms take about");
}

TEST(Assembly, InstancesAreThePrototypesOnce)
{
    Structure s = threeChains();
    s.assemblies = {{"1",
                     {{{"A"}, {moved(10), moved(20)}},
                      {{"B"}, {moved(10), moved(20), moved(30)}},
                      {{"C", "A"}, {moved(20)}}},
                     ""}};
    SelectOptions options = assembly("1");
    options.assembly.instances = true;
    const BallSet selection = selectBalls(s, options);
    // A and B at 10; A, B and C at 20; B at 30.
    EXPECT_EQ(selection.placement.begin, (std::vector<std::size_t>{0, 2, 5, 6}));
    const std::vector<std::int32_t> atoms{0, 1, 0, 1, 2, 1};
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(selection.balls[i].atom, atoms[i]);
        EXPECT_EQ(selection.balls[i].center, openvdb::Vec3d(1, 2, 3 + atoms[i]));
    }
    ASSERT_EQ(selection.placement.instances.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(selection.placement.instances[i].part, i);
        EXPECT_EQ(selection.placement.instances[i].translation,
                  openvdb::Vec3d(10.0 * double(i + 1), 0, 0));
    }
    s.assemblies = {{"1", {{{}, {moved(10), moved(20), moved(30)}}}, ""}};
    EXPECT_EQ(selectBalls(s, options).placement.begin, (std::vector<std::size_t>{0, 3}));
    EXPECT_EQ(selectBalls(s, options).placement.instances.size(), 3u);
}

TEST(Assembly, TurnsThenShifts)
{
    Operator op{}; // (x, y, z) -> (10 - y, 20 + z, 30 - x), not its own inverse
    op.rotation[0][1] = -1;
    op.rotation[1][2] = 1;
    op.rotation[2][0] = -1;
    op.translation = openvdb::Vec3d(10, 20, 30);
    Structure s = threeChains();
    s.assemblies = {{"1", {{{"A"}, {op}}}, ""}};
    EXPECT_EQ(selectBalls(s, assembly("1")).balls.at(0).center, openvdb::Vec3d(8, 23, 29));
}

TEST(Assembly, WithoutChainsMeansAll)
{
    Structure s = threeChains();
    s.assemblies = {{"1", {{{}, {moved(10)}}}, ""}};
    EXPECT_EQ(selectBalls(s, assembly("1")).balls.size(), 3u);
}

TEST(Assembly, RefusesTheUnknownAndListsTheKnown)
{
    Structure s = threeChains();
    EXPECT_HAS(errorOf(ErrorKind::Input, [&] { selectBalls(s, assembly("1")); }),
               "made: assembly \"1\": expected none: the file describes no assembly");
    s.assemblies = {{"1", {{{"A"}, {moved(0)}}}, ""}, {"PAU", {}, "operator \"P\" is not listed"}};
    EXPECT_HAS(errorOf(ErrorKind::Input, [&] { selectBalls(s, assembly("9")); }),
               "assembly \"9\": expected one of 1, PAU");
    EXPECT_HAS(errorOf(ErrorKind::Input, [&] { selectBalls(s, assembly("PAU")); }),
               "assembly \"PAU\": operator \"P\" is not listed");
    s.assemblies[0].parts[0].chains = {"Q"};
    EXPECT_HAS(errorOf(ErrorKind::Input, [&] { selectBalls(s, assembly("1")); }),
               "nothing is left of 3 atoms: dropped 3 not in the assembly");
}

TEST(Assembly, RefusesOperatorsThatThrowItApart)
{
    Structure s = threeChains();
    s.assemblies = {{"1", {{{"A"}, {moved(0), moved(2e6)}}}, ""}};
    EXPECT_HAS(errorOf(ErrorKind::Input, [&] { selectBalls(s, assembly("1")); }), "extent in x");
    for (const auto& operators : {std::vector{moved(std::nan(""))},
                                  {moved(0), moved(std::nan(""))},
                                  {moved(std::nan("")), moved(0)}}) {
        s.assemblies = {{"1", {{{"A"}, operators}}, ""}};
        EXPECT_HAS(errorOf(ErrorKind::Input, [&] { selectBalls(s, assembly("1")); }),
                   "extent in x: expected at most 1e6 Å, got nan");
    }
}

} // namespace
} // namespace molsurf::test
