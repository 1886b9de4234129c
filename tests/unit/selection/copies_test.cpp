// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/choose_copies.h"
#include "molsurf/molecule/selection/select_balls.h"

#include "support/groups.h"
#include "unit/structure/temp_file.h"

namespace molsurf::test
{
namespace
{

using openvdb::Vec3d;

SelectOptions copies(const std::string& text)
{
    SelectOptions options;
    options.assembly.name = "1";
    options.assembly.copies = parseCopies(text);
    return options;
}

/// A carbon and an oxygen in chain A, near the five-fold axis along (0, 1, golden).
Structure withAssembly(std::vector<Operator> operators)
{
    Structure s;
    s.source = "made";
    s.chains = s.asyms = {"A"};
    s.residues.push_back({"GLY", 0, 0, 1, ' '});
    s.atoms.push_back({Vec3d(6, 50, 70), "C", 0, 6, '\0', AtomRole::Atom, 1, 0, -1});
    s.atoms.push_back({Vec3d(8, 51, 71), "O", 0, 8, '\0', AtomRole::Atom, 1, 0, -1});
    s.models = {{1, 0, 2}};
    s.assemblies = {assemblyOf(std::move(operators))};
    return s;
}

/// The copies lie on circles about a line through the origin, evenly.
void expectRing(const std::vector<Ball>& balls, int fold, const Vec3d& direction)
{
    ASSERT_EQ(balls.size(), 2 * std::size_t(fold));
    const Vec3d u = direction.unit();
    const double chord = std::sin(M_PI / fold);
    for (std::size_t atom = 0; atom < 2; ++atom) {
        const Vec3d first(balls[atom].center);
        const Vec3d radius = first - u.dot(first) * u;
        double nearest = 1e9;
        for (std::size_t i = 1; i < std::size_t(fold); ++i) {
            const Vec3d other(balls[2 * i + atom].center);
            EXPECT_NEAR(u.dot(other), u.dot(first), 1e-4);
            EXPECT_NEAR(other.cross(u).length(), radius.length(), 1e-4);
            nearest = std::min(nearest, (other - first).length());
        }
        EXPECT_NEAR(nearest, 2 * radius.length() * chord, 1e-4);
    }
}

// Of axes that are as near, to 0.01 Å, it is the first.
TEST(Copies, AboutTheNearestAxis)
{
    Symmetry symmetry;
    symmetry.centre = Vec3d(1.0, 2.0, 3.0);
    symmetry.axes = {{2, Vec3d(0.0, 0.0, 1.0), {}},
                     {2, Vec3d(1.0, 0.0, 0.0), {}},
                     {3, Vec3d(0.0, 1.0, 0.0), {}}};
    const auto nearest = [&](int fold, double x, double z) {
        const RotationAxis* found = nearestAxis(symmetry, fold, symmetry.centre + Vec3d(x, 0.0, z));
        return found ? found - symmetry.axes.data() : -1;
    };
    EXPECT_EQ(nearest(2, 5.0, 5.0), 0);   // 5 Å from both
    EXPECT_EQ(nearest(2, 5.0, 4.995), 0); // 5 and 4.995 Å
    EXPECT_EQ(nearest(2, 5.0, 4.98), 1);
    EXPECT_EQ(nearest(2, 4.9, 5.0), 0);
    EXPECT_EQ(nearest(3, 5.0, 4.0), 2);
    EXPECT_EQ(nearest(4, 5.0, 4.0), -1);
}

TEST(Copies, AboutTheAxesOfTheIcosahedron)
{
    const Structure s = withAssembly(icosahedral());
    expectRing(selectBalls(s, copies("fold:5")).balls, 5, {0, 1, golden});
    expectRing(selectBalls(s, copies("fold:3")).balls, 3, {1, 1, 1});
    expectRing(selectBalls(s, copies("fold:2")).balls, 2, {1, golden * golden, golden});
    EXPECT_EQ(selectBalls(s, copies("fold:5")).placement.numbers[0], 1);
    EXPECT_EQ(selectBalls(s, copies("")).placement.copies, 60u);
}

// The other copies are all but those that are chosen, by number or by fold.
TEST(Copies, OthersAreTheRest)
{
    const Structure s = withAssembly(icosahedral());
    for (const char* text : {"fold:5", "2,7-9"}) {
        SelectOptions options = copies(text);
        std::vector<int> all = selectBalls(s, options).placement.numbers;
        const std::size_t chosen = all.size();
        options.assembly.copies.others = true;
        const std::vector<int> rest = selectBalls(s, options).placement.numbers;
        EXPECT_EQ(rest.size(), 60 - chosen) << text;
        all.insert(all.end(), rest.begin(), rest.end());
        std::sort(all.begin(), all.end());
        for (int i = 0; i < 60; ++i) EXPECT_EQ(all[std::size_t(i)], i + 1) << text;
    }
    SelectOptions options = copies("1-60");
    options.assembly.copies.others = true;
    EXPECT_HAS(errorOf(ErrorKind::Input, [&] { selectBalls(s, options); }),
               "others: expected copies that `copies` leaves out, got all 60 chosen");
}

TEST(Copies, AreThoseOfTheFirstOperatorWhereverItIs)
{
    std::vector<Operator> operators = icosahedral();
    std::rotate(operators.begin(), operators.begin() + 17, operators.end());
    const Operator home = inverseOf(operators[0]);
    const BallSet five = selectBalls(withAssembly(operators), copies("fold:5"));
    ASSERT_EQ(five.placement.copies, 5u);
    // In the frame of copy 1 it is the ring of the copy that the identity makes.
    std::vector<Ball> balls = five.balls;
    for (Ball& ball : balls) ball.center = home.placed(ball.center);
    expectRing(balls, 5, {0, 1, golden});
}

TEST(Copies, OfCyclicAndDihedralAssemblies)
{
    const Structure ring = withAssembly(cyclic(4));
    expectRing(selectBalls(ring, copies("fold:4")).balls, 4, {0, 0, 1});
    EXPECT_HAS(errorOf(ErrorKind::Input, [&] { selectBalls(ring, copies("fold:2")); }),
               "made: assembly \"1\": copies: expected the fold of one of its axes, got fold:2 "
               "[1 four-fold axis]");
    const Structure d3 = withAssembly(dihedral(3));
    expectRing(selectBalls(d3, copies("fold:3")).balls, 3, {0, 0, 1});
    EXPECT_EQ(selectBalls(d3, copies("fold:2")).placement.copies, 2u);
    EXPECT_HAS(errorOf(ErrorKind::Input, [&] { selectBalls(d3, copies("fold:7")); }),
               "[1 three-fold, 3 two-fold axes]");
    EXPECT_HAS(
        errorOf(ErrorKind::Input, [&] { selectBalls(withAssembly(cyclic(1)), copies("fold:3")); }),
        "[no rotation axis]");
}

TEST(Copies, OfAHelixAreRefusedByItsName)
{
    const Structure s = withAssembly(helix(20, 2.5, 0.4));
    EXPECT_HAS(errorOf(ErrorKind::Input, [&] { selectBalls(s, copies("fold:3")); }),
               "got fold:3 [helical, rise 2.50 Å, twist 22.92 degrees, no rotation axis]");
    EXPECT_EQ(selectBalls(s, copies("3-7")).placement.copies, 5u);
}

TEST(Copies, DuplicatesAreLeftOutOfARing)
{
    std::vector<Operator> operators = icosahedral();
    const std::vector<Operator> once = operators;
    operators.insert(operators.end(), once.begin(), once.end());
    const BallSet five = selectBalls(withAssembly(operators), copies("fold:5"));
    expectRing(five.balls, 5, {0, 1, golden});
    EXPECT_LE(five.placement.numbers.back(), 60);
}

TEST(Copies, ByNumber)
{
    const Structure s = withAssembly(icosahedral());
    const BallSet some = selectBalls(s, copies("7, 1,23-25,24"));
    EXPECT_EQ(some.placement.numbers, (std::vector<int>{1, 7, 23, 24, 25}));
    EXPECT_EQ(some.placement.begin, (std::vector<std::size_t>{0, 2, 4, 6, 8, 10}));
    const BallSet all = selectBalls(s, copies(""));
    EXPECT_EQ(some.balls[2].center, all.balls[12].center); // copy 7
    EXPECT_EQ(some.balls[9].center, all.balls[49].center); // copy 25
    EXPECT_HAS(errorOf(ErrorKind::Input, [&] { selectBalls(s, copies("3,61")); }),
               "copies: expected numbers from 1 to 60, got 61");
}

TEST(Copies, OfAPartWithItsOwnOperatorsComeAlong)
{
    Structure s = withAssembly(cyclic(4));
    s.chains = s.asyms = {"A", "B"};
    s.residues.push_back({"GLY", 1, 1, 2, ' '});
    s.atoms[1].residue = 1;
    s.assemblies[0].parts[0].chains = {"A"};
    std::vector<Operator> others = cyclic(4);
    std::rotate(others.begin(), others.begin() + 1, others.end()); // the identity comes last
    s.assemblies[0].parts.push_back({{"B"}, others});
    const BallSet ring = selectBalls(s, copies("fold:4"));
    EXPECT_EQ(ring.placement.numbers, (std::vector<int>{1, 2, 3, 4, 5, 6, 7, 8}));
    EXPECT_EQ(selectBalls(s, copies("8")).balls.at(0).center, openvdb::Vec3d(8, 51, 71));
}

TEST(Copies, BadWords)
{
    for (const char* text : {"x", "0", "-1", "3-1", "1,,2", "1-", ",", "fold:", "fold:1", "fold:x",
                             "fold:-3", "1.5", "fold:5,1"}) {
        EXPECT_HAS(errorOf(ErrorKind::Usage, [&] { parseCopies(text); }), "`copies`: expected");
    }
    EXPECT_TRUE(parseCopies("").ranges.empty());
}

TEST(Copies, AMirrorImageIsNotBuilt)
{
    Structure s = withAssembly(cyclic(3));
    for (double& r : s.assemblies[0].parts[0].operators[1].rotation[2]) r = -r;
    EXPECT_HAS(errorOf(ErrorKind::Input, [&] { selectBalls(s, copies("")); }),
               "made: assembly \"1\": operator \"2\": expected a rotation, got a reflection");
    EXPECT_EQ(selectBalls(s, copies("1,3")).placement.copies, 2u);
}

} // namespace
} // namespace molsurf::test
