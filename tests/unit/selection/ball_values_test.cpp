// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/ball_values.h"

#include "molsurf/molecule/selection/scalar_map.h"
#include "unit/structure/temp_file.h"

#include <cmath>
#include <functional>

namespace molsurf::test
{
namespace
{

/// Residues of as many atoms each, all of chain A.
Structure residuesOf(int residues, int atoms, const std::function<float(int)>& bFactor)
{
    Structure s;
    s.chains = s.asyms = {"A"};
    for (int i = 0; i < residues * atoms; ++i) {
        if (i % atoms == 0) {
            Residue residue{};
            residue.name = "ALA";
            residue.number = i / atoms + 1;
            residue.insertionCode = ' ';
            s.residues.push_back(residue);
        }
        Atom atom{};
        atom.residue = i / atoms;
        atom.bFactor = bFactor(i);
        s.atoms.push_back(atom);
    }
    return s;
}

BallValues valuesOf(const Structure& s, const std::string& by, const Coloring& coloring,
                    std::vector<std::string>& warnings)
{
    std::vector<Ball> balls;
    for (std::size_t i = 0; i < s.atoms.size(); ++i)
        balls.push_back({s.atoms[i].position, 1.7, std::int32_t(i)});
    return ballValues(s, balls, *parseValueBy(by), coloring, {openvdb::Vec3d(0.0), {}}, 0,
                      warnings);
}

BallValues valuesOf(const Structure& s, const std::string& by)
{
    std::vector<std::string> warnings;
    return valuesOf(s, by, Coloring(), warnings);
}

/// Residues of three atoms, the last of which is a hydrogen beside the second.
Structure withHydrogens(float ofHydrogen)
{
    Structure s =
        residuesOf(2, 3, [&](int i) { return i % 3 == 2 ? ofHydrogen : 10.0f * float(i + 1); });
    for (int i = 0; i < 6; ++i) {
        const double along[] = {0.0, 1.5, 2.5};
        Atom& atom = s.atoms[std::size_t(i)];
        atom.position = {along[i % 3] + 20.0 * (i / 3), 0.0, 0.0};
        atom.element = i % 3 == 2 ? 1 : 6;
    }
    return s;
}

TEST(BallValues, HydrogensWithoutOneTakeThatOfTheirAtom)
{
    EXPECT_EQ(valuesOf(withHydrogens(0.0f), "bfactor").valueOf,
              (std::vector<float>{10, 20, 20, 40, 50, 50}));
    EXPECT_EQ(valuesOf(withHydrogens(7.0f), "bfactor").valueOf,
              (std::vector<float>{10, 20, 7, 40, 50, 7}));
}

TEST(BallValues, OfResiduesAreMeans)
{
    Coloring coloring;
    coloring.byResidue = true;
    std::vector<std::string> warnings;
    EXPECT_EQ(valuesOf(withHydrogens(30.0f), "bfactor", coloring, warnings).valueOf,
              (std::vector<float>{20, 20, 20, 40, 40, 40}));
    EXPECT_TRUE(warnings.empty());
}

TEST(BallValues, ThatAreAllTheSameShowNothing)
{
    Coloring coloring;
    std::vector<std::string> warnings;
    const Structure s = residuesOf(3, 1, [](int) { return 12.5f; });
    const BallValues same = valuesOf(s, "bfactor", coloring, warnings);
    EXPECT_EQ(same.low, 12.5);
    EXPECT_EQ(same.high, 12.5);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0], "B factor: all atoms have 12.5, which is grey [hint: `range`]");
    coloring.range = {{0.0, 50.0}};
    EXPECT_EQ(valuesOf(s, "bfactor", coloring, warnings).high, 50.0);
    EXPECT_EQ(warnings.size(), 1u);
    // One atom that differs has a colour, though it is fewer than two of a hundred.
    const Structure one = residuesOf(101, 1, [](int i) { return i == 5 ? 3.0f : 2.0f; });
    EXPECT_EQ(valuesOf(one, "bfactor").high, 3.0);
}

TEST(BallValues, RangeLeavesOutTwoOfAHundredAtEachEnd)
{
    // 0 to 100, in another order: 37 has no factor in common with 101.
    const Structure s = residuesOf(101, 1, [](int i) { return float(37 * i % 101); });
    const BallValues values = valuesOf(s, "bfactor");
    EXPECT_EQ(values.low, 2.0);
    EXPECT_EQ(values.high, 98.0);
    EXPECT_EQ(values.valueOf[3], 10.0f);
}

TEST(BallValues, APredictionHasOneValueAResidueAndMoreThanOneInAll)
{
    const auto paletteOf = [](const std::function<float(int)>& bFactor) {
        return valuesOf(residuesOf(3, 2, bFactor), "bfactor").palette;
    };
    EXPECT_EQ(paletteOf([](int i) { return 20.0f * float(i / 2); }), "plddt");
    EXPECT_EQ(paletteOf([](int) { return 20.0f; }), "viridis");
    EXPECT_EQ(paletteOf([](int i) { return float(i); }), "viridis");
    EXPECT_EQ(paletteOf([](int i) { return 60.0f * float(i / 2); }), "viridis"); // above 100
}

TEST(BallValues, ChargesAreColouredAlikeToBothSides)
{
    Structure s = residuesOf(2, 1, [](int) { return 0.0f; });
    for (const float sign : {1.0f, -1.0f}) {
        s.charges = {-3.0f * sign, 1.0f * sign};
        const BallValues values = valuesOf(s, "charge");
        EXPECT_EQ(values.low, -3.0);
        EXPECT_EQ(values.high, 3.0);
    }
}

TEST(BallValues, ATableHasTextAboveItsValuesAlone)
{
    const Structure s = residuesOf(2, 1, [](int) { return 0.0f; });
    const TempFile good("t", "chain residue value\nA 1 0.5\n# more\nA 2 0.75\n");
    EXPECT_EQ(valuesOf(s, "table=" + good.path()).valueOf, (std::vector<float>{0.5f, 0.75f}));
    const TempFile bad("t", "A 1 0.5\nA 2 much\n");
    EXPECT_HAS(errorOf(ErrorKind::Input, [&] { valuesOf(s, "table=" + bad.path()); }), ":2: ");
    const TempFile longest("long.csv", "A 1 1.5\nA 2 0.5" + std::string(80, '0') + "x\n");
    EXPECT_HAS(errorOf(ErrorKind::Input, [&] { valuesOf(s, "table=" + longest.path()); }), ":2: ");
}

TEST(ScalarMap, HasItsPlaceAndThreeStepsAlongTheAxes)
{
    const std::string counts = "object 1 class gridpositions counts 2 2 2\n",
                      origin = "origin 1 2 3\n", x = "delta 2 0 0\n", y = "delta 0 4 0\n",
                      z = "delta 0 0 8\n",
                      values = "object 3 class array type double rank 0 items 8 data follows\n"
                               "0 1 2 3 4 5 6 7\n";
    const TempFile good("m.dx", counts + origin + x + y + z + values);
    const ScalarMap map = readDx(good.path());
    EXPECT_EQ(map.at({1, 2, 3}), 0.0f); // z runs fastest
    EXPECT_EQ(map.at({1, 2, 11}), 1.0f);
    EXPECT_EQ(map.at({1, 6, 3}), 2.0f);
    EXPECT_EQ(map.at({3, 2, 3}), 4.0f);
    EXPECT_FLOAT_EQ(map.at({1.5, 3, 5}), 0.25f * 4 + 0.25f * 2 + 0.25f);
    EXPECT_TRUE(std::isnan(map.at({0.99, 2, 3})) && std::isnan(map.at({3.01, 2, 3})));
    const auto refusal = [](const std::string& text) {
        const TempFile bad("m.dx", text);
        return errorOf(ErrorKind::Input, [&] { readDx(bad.path()); });
    };
    for (const std::string& head :
         {origin + x + y + z, counts + x + y + z, counts + origin + x + y})
        EXPECT_HAS(refusal(head + values), "expected counts, origin and three deltas before");
    EXPECT_HAS(refusal(counts + origin + "delta 2 0.5 0\n"), ":3: expected a step along the axis");
    EXPECT_HAS(refusal(counts + origin + "delta -2 0 0\n"), ":3: expected a step along the axis");
}

} // namespace
} // namespace molsurf::test
