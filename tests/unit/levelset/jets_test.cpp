// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/levelset/jets.h"

#include "molsurf/kernel/spline/spline.h"

#include <gtest/gtest.h>

#include <random>

namespace molsurf
{
namespace
{

using openvdb::Coord;
using openvdb::Vec3d;
using openvdb::Vec3f;

// Random coefficients on 3^3 leaves about one, less those of a corner.
struct Field : testing::Test {
    Field()
    {
        std::vector<Coord> origins;
        for (int k = 0; k < 27; ++k) {
            if (k != 26)
                origins.emplace_back(8 * (k / 9 - 1), 8 * (k / 3 % 3 - 1), 8 * (k % 3 - 1));
        }
        c.table = LeafTable(origins);
        c.values = LeafField(c.table.size());
        c.voxelSize = 0.5;
        std::uniform_real_distribution<float> value(-1.0f, 1.0f);
        for (std::size_t n = 0; n < c.table.size(); ++n) {
            for (int v = 0; v < leafSize; ++v) c.values.leaf(n)[v] = value(random);
        }
        leaf = c.table.find(Coord(0));
        block.gather(c, std::size_t(leaf));
    }

    Vec3f point(float low, float high)
    {
        std::uniform_real_distribution<float> place(low, high);
        return {place(random), place(random), place(random)};
    }

    // The sum over all coefficients, those that are absent being 0.
    Jet sumAt(const Vec3f& y) const
    {
        const Coord cell = Coord::floor(Vec3d(y));
        float near[64];
        for (int k = 0; k < 64; ++k) {
            const Coord q = cell.offsetBy((k >> 4) - 1, (k >> 2 & 3) - 1, (k & 3) - 1);
            const std::int32_t n = c.table.find(q & ~7);
            near[k] =
                n == noLeaf ? 0.0f : c.leaf(n)[64 * (q.x() & 7) + 8 * (q.y() & 7) + (q.z() & 7)];
        }
        return evaluateSpline(near + 21, 16, 4, Vec3d(y) - cell.asVec3d());
    }

    static void expectSame(const Jet& jet, const Jet& expected, double factor)
    {
        EXPECT_NEAR(jet.value, factor * expected.value, 1e-5);
        for (int a = 0; a < 3; ++a) {
            EXPECT_NEAR(jet.gradient[a], factor * expected.gradient[a], 1e-5);
            for (int b = 0; b < 3; ++b)
                EXPECT_NEAR(jet.hessian(a, b), factor * expected.hessian(a, b), 3e-5);
        }
    }

    std::mt19937 random{5};
    SparseField c;
    std::int32_t leaf = noLeaf;
    LeafBlock<float, 3> block;
};

using Jets = Field;

TEST_F(Jets, BesideALeafAreThoseOfTheSumOverAllCoefficients)
{
    for (int i = 0; i < 2000; ++i) {
        const Vec3f y = point(-6.0f, 13.0f);
        JetLanes jets;
        jetBeside(c, leaf, y, i % lanes, jets);
        expectSame(jets.at(i % lanes), sumAt(y), 2.0);
    }
}

// Where curvatures are sharp a step may lead anywhere.
TEST_F(Jets, FartherAwayAreZero)
{
    for (const Vec3f& y : {Vec3f(30, 0, 0), Vec3f(0, -40, 3), Vec3f(3, 0, 17.5f), Vec3f(0, 1e9f, 0),
                           Vec3f(-1e30f, 0, 0)}) {
        JetLanes jets;
        jetBeside(c, leaf, y, 0, jets);
        expectSame(jets.at(0), Jet(), 1.0);
    }
}

TEST_F(Jets, InABlockAreThoseOfTheChosenLanes)
{
    for (int i = 0; i < 100; ++i) {
        FootPoints::Lanes y[3];
        bool which[lanes];
        std::vector<Vec3f> points;
        JetLanes jets{};
        for (int l = 0; l < lanes; ++l) {
            points.push_back(point(-2.0f, 9.0f));
            points.back().z() *= 0.6f; // the corner that is absent is not reached
            for (int a = 0; a < 3; ++a) y[a][l] = points.back()[a];
            which[l] = (l + i) % 3 != 0;
        }
        jetsIn(block, y, which, jets);
        for (int l = 0; l < lanes; ++l) {
            if (which[l]) {
                expectSame(jets.at(l), sumAt(points[std::size_t(l)]), 1.0);
            } else {
                EXPECT_EQ(jets.value[l], 0.0f);
            }
        }
    }
}

} // namespace
} // namespace molsurf
