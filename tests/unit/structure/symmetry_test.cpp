// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/symmetry.h"

#include "support/groups.h"
#include "unit/structure/temp_file.h"

#include <random>

namespace molsurf::test
{
namespace
{

using openvdb::Vec3d;

const Vec3d atom(31.0, 12.0, 47.0); // near the five-fold axis along (0, 1, golden)

std::vector<int> foldsOf(const Symmetry& symmetry)
{
    std::vector<int> folds;
    for (const RotationAxis& axis : symmetry.axes) folds.push_back(axis.fold);
    return folds;
}

std::vector<int> folds(int fives, int fours, int threes, int twos)
{
    std::vector<int> all(std::size_t(fives), 5);
    all.insert(all.end(), std::size_t(fours), 4);
    all.insert(all.end(), std::size_t(threes), 3);
    all.insert(all.end(), std::size_t(twos), 2);
    return all;
}

/// Every axis takes the copies where its rotations take the atom.
void expectImages(const Assembly& assembly, const Symmetry& symmetry, double tolerance)
{
    const std::vector<Operator> ops = operatorsOf(assembly);
    for (const RotationAxis& axis : symmetry.axes) {
        ASSERT_EQ(axis.images.size(), std::size_t(axis.fold - 1));
        EXPECT_NEAR(axis.direction.length(), 1.0, 1e-9);
        for (const auto& images : axis.images) {
            for (std::size_t i = 0; i < ops.size(); ++i) {
                const Vec3d from = ops[i].placed(atom) - symmetry.centre;
                const Vec3d to = ops[images[i]].placed(atom) - symmetry.centre;
                EXPECT_NEAR(from.dot(axis.direction), to.dot(axis.direction), tolerance);
                EXPECT_NEAR(from.cross(axis.direction).length(), to.cross(axis.direction).length(),
                            tolerance);
            }
        }
    }
}

TEST(Symmetry, PointGroups)
{
    struct Case {
        const char* name;
        std::vector<Operator> operators;
        std::vector<int> folds;
    };
    const std::vector<Case> cases{{"C1", cyclic(1), {}},
                                  {"C2", cyclic(2), {2}},
                                  {"C4", cyclic(4), {4}},
                                  {"C39", cyclic(39), {39}},
                                  {"D2", dihedral(2), {2, 2, 2}},
                                  {"D3", dihedral(3), {3, 2, 2, 2}},
                                  {"D17", dihedral(17),
                                   [] {
                                       std::vector<int> all(18, 2);
                                       all[0] = 17;
                                       return all;
                                   }()},
                                  {"T", tetrahedral(), folds(0, 0, 4, 3)},
                                  {"O", octahedral(), folds(0, 3, 4, 6)},
                                  {"I", icosahedral(), folds(6, 0, 10, 15)}};
    for (const Case& c : cases) {
        const Assembly assembly = assemblyOf(c.operators);
        const Symmetry symmetry = findSymmetry(assembly, atom);
        EXPECT_EQ(symmetry.pointGroup, c.name);
        EXPECT_EQ(symmetry.order, c.operators.size()) << c.name;
        EXPECT_EQ(foldsOf(symmetry), c.folds) << c.name;
        EXPECT_FALSE(symmetry.helix) << c.name;
        expectImages(assembly, symmetry, 1e-9);
    }
}

TEST(Symmetry, AxesOfTheIcosahedronAreWhereTheyAre)
{
    const Symmetry symmetry = findSymmetry(assemblyOf(icosahedral()), atom);
    EXPECT_LT(symmetry.centre.length(), 1e-9);
    auto has = [&](int fold, const Vec3d& direction) {
        return std::any_of(symmetry.axes.begin(), symmetry.axes.end(), [&](const RotationAxis& a) {
            return a.fold == fold && a.direction.cross(direction.unit()).length() < 1e-9;
        });
    };
    EXPECT_TRUE(has(5, {0, 1, golden}));
    EXPECT_TRUE(has(5, {0, -1, golden}));
    EXPECT_TRUE(has(5, {golden, 0, 1}));
    EXPECT_TRUE(has(3, {1, 1, 1}));
    EXPECT_TRUE(has(3, {0, golden, 1 / golden}));
    EXPECT_TRUE(has(2, {1, 0, 0}));
    EXPECT_FALSE(has(2, {0, 1, golden}));
}

// Any order, any place, a crystal's frame on either side, rounding of 1e-3, copies that stand
// twice.
TEST(Symmetry, OfOperatorsAsTheyCome)
{
    std::vector<Operator> operators = icosahedral();
    const Operator frame = turn({3, -1, 2}, 1.234, Vec3d(60, -140, 95));
    const Operator point = turn({1, 5, 2}, 2.1, Vec3d(12, 7, -20));
    for (Operator& op : operators) {
        op = multiplied(multiplied(multiplied(frame, op), inverseOf(frame)), point);
    }
    std::mt19937 random(1);
    std::shuffle(operators.begin(), operators.end(), random);
    operators.insert(operators.begin() + 7, operators[30]);
    operators.push_back(operators[0]);
    std::uniform_real_distribution<double> noise(-1e-3, 1e-3);
    for (Operator& op : operators) {
        for (auto& row : op.rotation) {
            for (double& r : row) r += noise(random);
        }
        for (int i = 0; i < 3; ++i) op.translation[i] += noise(random);
    }
    const Assembly assembly = assemblyOf(operators);
    const Symmetry symmetry = findSymmetry(assembly, inverseOf(point).placed(atom));
    EXPECT_EQ(symmetry.pointGroup, "I");
    EXPECT_EQ(foldsOf(symmetry), folds(6, 0, 10, 15));
    EXPECT_LT((symmetry.centre - frame.translation).length(), 0.1);
}

TEST(Symmetry, OfAPartOfAShell)
{
    const std::vector<Operator> all = icosahedral();
    const Operator fifth = turn({0, 1, golden}, 2 * M_PI / 5);
    std::vector<Operator> pentamer = groupOf({fifth});
    EXPECT_EQ(findSymmetry(assemblyOf(pentamer), atom).pointGroup, "C5");
    pentamer.pop_back();
    EXPECT_EQ(findSymmetry(assemblyOf(pentamer), atom).pointGroup, "C1"); // four of five
}

TEST(Symmetry, OfSeveralCopiesAnAsymmetricUnit)
{
    const Operator second = turn({2, 1, 0}, 1.0, Vec3d(40, 3, 5));
    std::vector<Operator> both;
    for (const Operator& op : octahedral()) {
        both.push_back(op);
        both.push_back(multiplied(op, second));
    }
    const Symmetry symmetry = findSymmetry(assemblyOf(both), atom);
    EXPECT_EQ(symmetry.pointGroup, "O");
    EXPECT_EQ(symmetry.order, 24u);
}

TEST(Symmetry, MustHoldForEveryPart)
{
    Assembly assembly = assemblyOf(cyclic(4));
    assembly.parts.push_back({{"B"}, cyclic(2)});
    EXPECT_EQ(findSymmetry(assembly, atom).pointGroup, "C2");
    assembly.parts[1].operators.pop_back();
    EXPECT_EQ(findSymmetry(assembly, atom).pointGroup, "C1");
}

TEST(Symmetry, OfAHelix)
{
    const double twist = 22.03 * M_PI / 180;
    const Symmetry symmetry = findSymmetry(assemblyOf(helix(49, 1.408, twist)), atom);
    ASSERT_TRUE(symmetry.helix);
    EXPECT_EQ(symmetry.pointGroup, "C1");
    EXPECT_TRUE(symmetry.axes.empty());
    EXPECT_NEAR(symmetry.helix->rise, 1.408, 1e-9);
    EXPECT_NEAR(symmetry.helix->twist, twist, 1e-9);
    EXPECT_LT(symmetry.helix->direction.cross(Vec3d(0, 0, 1)).length(), 1e-9);
    const auto left = findSymmetry(assemblyOf(helix(9, -20, twist)), atom).helix;
    ASSERT_TRUE(left);
    EXPECT_NEAR(left->rise, 20, 1e-9);
    EXPECT_NEAR(left->twist, -twist, 1e-9);
}

TEST(Symmetry, OfAHelixOfThreeStarts)
{
    std::vector<Operator> all;
    for (const Operator& screw : helix(7, 30, 0.5)) {
        for (const Operator& op : cyclic(3)) all.push_back(multiplied(screw, op));
    }
    const Symmetry symmetry = findSymmetry(assemblyOf(all), atom);
    EXPECT_EQ(symmetry.pointGroup, "C3");
    ASSERT_TRUE(symmetry.helix);
    EXPECT_NEAR(symmetry.helix->rise, 30, 1e-9);
    EXPECT_NEAR(symmetry.helix->twist, 0.5, 1e-9);
}

TEST(Symmetry, OfARowAndOfAScrewOfTwo)
{
    const auto row = findSymmetry(assemblyOf(helix(4, 50, 0)), atom);
    ASSERT_TRUE(row.helix);
    EXPECT_NEAR(row.helix->rise, 50, 1e-9);
    EXPECT_EQ(row.helix->twist, 0);
    const auto two = findSymmetry(assemblyOf(helix(2, 5, M_PI)), atom);
    EXPECT_EQ(two.pointGroup, "C1");
    EXPECT_TRUE(two.axes.empty());
}

TEST(Symmetry, RefusesWhatIsNoRotation)
{
    Assembly assembly = assemblyOf(cyclic(4));
    auto& rotation = assembly.parts[0].operators[2].rotation;
    for (double& r : rotation[1]) r = -r;
    EXPECT_HAS(errorOf(ErrorKind::Input, [&] { findSymmetry(assembly, atom); }),
               "operator \"3\": expected a rotation, got a reflection (determinant -1)");
    for (auto& row : rotation) {
        for (double& r : row) r *= 1.1;
    }
    for (double& r : rotation[1]) r = -r;
    EXPECT_HAS(errorOf(ErrorKind::Input, [&] { findSymmetry(assembly, atom); }),
               "operator \"3\": expected a rotation, got a matrix that distorts");
}

TEST(Symmetry, OfNoOperators)
{
    EXPECT_EQ(findSymmetry(Assembly{"1", {}, {}}, atom).pointGroup, "C1");
}

} // namespace
} // namespace molsurf::test
