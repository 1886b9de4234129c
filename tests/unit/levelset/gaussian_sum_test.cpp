// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/levelset/gaussian_sum.h"

#include "support/fields.h"
#include "support/molecules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace molsurf
{
namespace
{

using openvdb::Coord;
using openvdb::Vec3d;

/// psi by the definition, in double, with the largest exponent taken out.
double directPsi(const std::vector<Ball>& balls, const GaussianOptions& o, const Vec3d& x)
{
    std::vector<double> exponents;
    for (const Ball& ball : balls) {
        const double R = double(ball.radius) + o.probe;
        exponents.push_back(-M_LN2 / (o.epsilon * R) *
                            ((x - Vec3d(ball.center)).lengthSqr() - R * R));
    }
    const double top = *std::max_element(exponents.begin(), exponents.end());
    double sum = 0.0;
    for (const double e : exponents) sum += std::exp(e - top);
    return top + std::log(sum);
}

GaussianOptions optionsFor(double epsilon, double voxel)
{
    GaussianOptions options;
    options.epsilon = epsilon;
    options.voxelSize = voxel;
    options.reach = 5.5 * voxel;
    return options;
}

/// Largest error of psi in units of length, eps/(2 ln 2) psi, at the voxels within a voxel of
/// psi = 0.
double errorNearZero(const std::vector<Ball>& balls, const GaussianOptions& options)
{
    GaussianSum sum(balls, options);
    const SparseField psi = sum.band(2, Progress());
    const LeafTable& table = psi.table;
    const double length = options.epsilon / (2.0 * M_LN2);
    double worst = 0.0;
    int k = 0;
    for (std::size_t n = 0; n < table.size(); ++n) {
        for (int v = 0; v < leafSize; ++v) {
            const float value = psi.leaf(n)[v];
            EXPECT_TRUE(std::isfinite(value));
            if (std::abs(value) * length > options.voxelSize || ++k % 7 != 0) continue;
            const Vec3d x =
                table.origin(n).offsetBy(v >> 6, v >> 3 & 7, v & 7).asVec3d() * options.voxelSize;
            worst = std::max(worst, length * std::abs(value - directPsi(balls, options, x)));
        }
    }
    EXPECT_GT(k, 1000);
    return worst;
}

// Balls as dense as atoms in a protein, 0.09 to the Å^3, in general position. The cutoff of the
// reach leaves out more at fine voxels, whose bands are narrow.
TEST(GaussianSum, AgreesWithTheDefinitionNearTheSurface)
{
    const std::vector<Ball> balls = test::randomBalls(60, 9.0, Vec3d(1.3, -2.1, 0.4), 42);
    for (const double epsilon : {0.5, 0.2, 0.1, 0.05}) {
        EXPECT_LT(errorNearZero(balls, optionsFor(epsilon, 0.5)), 2e-5) << "eps " << epsilon;
        EXPECT_LT(errorNearZero(balls, optionsFor(epsilon, 0.25)), 2e-4) << "eps " << epsilon;
    }
}

// Balls beyond R + reach + 2 eps of a leaf are left out whatever their terms: at fine voxels, whose
// bands are narrow, and at a large eps these matter. Measured on 1crn at h 0.125: 2.6e-3 Å at eps
// 0.5, 1.4e-2 Å at eps 1, 3.9e-2 Å at eps 2 (at h 0.5: 5e-7, 2e-5, 6e-4). A cutoff where the term
// itself is negligible, at sqrt(R^2 + 12/C), would not.
TEST(GaussianSum, AgreesWithTheDefinitionAtFineVoxelsAndLargeTolerances)
{
    const std::vector<Ball> balls = test::randomBalls(150, 12.0, Vec3d(1.3, -2.1, 0.4), 42);
    for (const double epsilon : {0.5, 1.0, 2.0})
        EXPECT_LT(errorNearZero(balls, optionsFor(epsilon, 0.125)), 2e-4) << "eps " << epsilon;
}

TEST(GaussianSum, IsAsGoodFarFromTheOrigin)
{
    const std::vector<Ball> balls = test::randomBalls(60, 9.0, Vec3d(5000.0, -4987.3, 5021.9), 42);
    EXPECT_LT(errorNearZero(balls, optionsFor(0.5, 0.5)), 2e-5);
    EXPECT_LT(errorNearZero(balls, optionsFor(0.1, 0.5)), 2e-5);
}

TEST(GaussianSum, IsFiniteAndNegativeFarOutsideAndDeepInsideIsPositive)
{
    const std::vector<Ball> balls = test::randomBalls(60, 6.0, Vec3d(0.0), 1);
    for (const double epsilon : {2.0, 0.5, 0.05, 0.01}) {
        GaussianSum sum(balls, optionsFor(epsilon, 0.5));
        alignas(64) float psi[leafSize];
        for (const Coord& origin : {Coord(800, 0, 0), Coord(16, 16, 16), Coord(0), Coord(-8)}) {
            sum.evaluate(origin, 3.0, psi);
            for (const float value : psi) ASSERT_TRUE(std::isfinite(value)) << epsilon << origin;
        }
        EXPECT_GT(psi[511], 0.0f);
        sum.evaluate(Coord(800, 0, 0), 3.0, psi);
        EXPECT_LT(psi[0], -10.0f);
    }
}

// One ball: psi is -C (r^2 - R^2), also far outside, and gradients are what they should be.
TEST(GaussianSum, OfOneBallIsQuadratic)
{
    const std::vector<Ball> balls = {{openvdb::Vec3f(0.31f, -0.77f, 1.23f), 1.7f, 0}};
    const GaussianOptions options = optionsFor(0.5, 0.25);
    GaussianSum sum(balls, options);
    alignas(64) float psi[leafSize];
    double worst = 0.0;
    for (const Coord& origin : {Coord(-8), Coord(0), Coord(8, 0, -8)}) {
        sum.evaluate(origin, 6.0, psi);
        for (int v = 0; v < leafSize; ++v) {
            const Vec3d x =
                origin.offsetBy(v >> 6, v >> 3 & 7, v & 7).asVec3d() * options.voxelSize;
            worst = std::max(worst, std::abs(psi[v] - directPsi(balls, options, x)));
        }
    }
    EXPECT_LT(worst, 1e-5);
}

// Every voxel that lies within n voxels of an inner voxel with an outer one among its 26
// neighbours; signs by the definition.
TEST(Band, HoldsAllVoxelsWithinItsWidth)
{
    const int n = 4;
    for (const double voxel : {0.5, 0.9}) {
        const std::vector<Ball> balls = test::randomBalls(9, 9.0, Vec3d(-3.1, 0.2, 2.3), 9);
        const GaussianOptions options = optionsFor(0.5, voxel);
        const LeafTable table = GaussianSum(balls, options).band(n, Progress()).table;
        const int N = int(11.0 / voxel);
        const Coord low = Coord::round(Vec3d(-3.1, 0.2, 2.3) / voxel) - Coord(N);
        const int dim = 2 * N + 1;
        std::vector<char> inside(std::size_t(dim) * dim * dim);
        const auto at = [&](int x, int y, int z) -> char& {
            return inside[(std::size_t(x) * dim + y) * dim + z];
        };
        for (int x = 0; x < dim; ++x) {
            for (int y = 0; y < dim; ++y) {
                for (int z = 0; z < dim; ++z) {
                    at(x, y, z) =
                        directPsi(balls, options, low.offsetBy(x, y, z).asVec3d() * voxel) >= 0.0;
                }
            }
        }
        int interface = 0;
        std::set<Coord> wanted;
        for (int x = n; x < dim - n; ++x) {
            for (int y = n; y < dim - n; ++y) {
                for (int z = n; z < dim - n; ++z) {
                    if (!at(x, y, z)) continue;
                    bool next = false;
                    for (int k = 0; k < 27; ++k)
                        next |= !at(x + k / 9 - 1, y + k / 3 % 3 - 1, z + k % 3 - 1);
                    if (!next) continue;
                    ++interface;
                    for (int i = -n; i <= n; ++i) {
                        for (int j = -n; j <= n; ++j) {
                            for (int k = -n; k <= n; ++k) {
                                if (i * i + j * j + k * k <= n * n)
                                    wanted.insert(low.offsetBy(x + i, y + j, z + k));
                            }
                        }
                    }
                }
            }
        }
        ASSERT_GT(interface, 300);
        std::size_t missing = 0;
        for (const Coord& c : wanted) {
            const std::int32_t leaf = table.find(c);
            missing +=
                leaf == noLeaf ||
                !table.active(leaf).on(int(openvdb::FloatTree::LeafNodeType::coordToOffset(c)));
        }
        EXPECT_EQ(missing, 0u) << "of " << wanted.size() << " at h " << voxel;
        EXPECT_LT(table.activeCount(), 2 * wanted.size());
        for (std::size_t i = 0; i < table.size(); ++i) EXPECT_TRUE(table.active(i).any());
    }
}

// Sums that were made to find the band are kept: they have the bits of any others.
TEST(Band, HasThePsiOfEvaluate)
{
    const std::vector<Ball> balls = test::randomBalls(60, 30.0, Vec3d(1.3, -2.1, 0.4), 7);
    for (const double voxel : {0.5, 1.1}) {
        const GaussianOptions options = optionsFor(0.5, voxel);
        GaussianSum sum(balls, options);
        const SparseField psi = sum.band(4, Progress());
        ASSERT_GT(psi.table.size(), 20u);
        std::vector<float> alone(leafSize);
        for (std::size_t n = 0; n < psi.table.size(); ++n) {
            sum.evaluate(psi.table.origin(n), options.reach, alone.data());
            ASSERT_TRUE(std::equal(alone.begin(), alone.end(), psi.leaf(n))) << voxel;
        }
    }
}

// Leaves inside, outside and across the surface of balls of which some lie beyond the leaf.
TEST(GaussianTerms, BoundsHoldTheSum)
{
    const std::vector<Ball> balls = test::randomBalls(2000, 20.0, Vec3d(4.0), 3);
    const double R = 3.1, C = M_LN2 / (0.5 * R), h = 0.5;
    GaussianLists lists;
    lists.resize(balls.size());
    for (std::size_t i = 0; i < balls.size(); ++i) {
        lists.x[i] = balls[i].center.x();
        lists.y[i] = balls[i].center.y();
        lists.z[i] = balls[i].center.z();
        lists.decay[i] = float(C * h * h);
        lists.level[i] = float(C * R * R);
        lists.rim[i] = float(R / h);
    }
    int inside = 0, outside = 0;
    for (int k = -4; k <= 8; ++k) {
        const Coord origin(leafDim * k, leafDim, leafDim * 2);
        GaussianTerms terms;
        GaussianBounds bounds;
        GaussianTables tables;
        addTerms(lists, 0, std::int32_t(balls.size()), GaussianLeaf(origin, h, 6.0), terms);
        boundTerms(terms, bounds);
        alignas(64) float psi[leafSize];
        sumTerms(terms, bounds, tables, psi);
        const auto [least, most] = std::minmax_element(psi, psi + leafSize);
        EXPECT_GE(*least, std::max(bounds.least(), lowestPsi) - 1e-4f) << k;
        EXPECT_LE(*most, std::max(bounds.most(terms.count), lowestPsi) + 1e-4f) << k;
        inside += bounds.least() > 0.0f;
        outside += bounds.most(terms.count) < 0.0f;
    }
    EXPECT_GT(inside, 0);
    EXPECT_GT(outside, 0);
}

TEST(Band, IsEmptyWhereNoVoxelIsInside)
{
    const std::vector<Ball> balls = {{openvdb::Vec3f(5.0f, 5.0f, 5.0f), 1.7f, 0}};
    EXPECT_EQ(GaussianSum(balls, optionsFor(0.5, 10.0)).band(4, Progress()).table.size(), 0u);
}

// Rates and levels of single balls: psi = ln sum exp(level - C (|x - x_i|^2 - R^2)).
TEST(GaussianSum, DecaysOfSingleBalls)
{
    const std::vector<Ball> balls = {{openvdb::Vec3f(0.0f), 1.7f, 0},
                                     {openvdb::Vec3f(3.0f, 1.0f, 0.5f), 1.5f, 1}};
    const std::vector<Decay> decays = {{0.1f, -1.0f}, {0.0f, 0.5f}};
    const GaussianOptions options{1.4, 0.5, 0.0, 0.5, 3.0};
    const GaussianSum field(balls, options, decays);
    std::vector<float> psi(leafSize);
    for (const Coord& origin : {Coord(0), Coord(-8, 0, 8)}) {
        field.evaluate(origin, options.reach, psi.data());
        for (int v = 0; v < leafSize; v += 7) {
            const Vec3d x = origin.offsetBy(v >> 6, v >> 3 & 7, v & 7).asVec3d() * 0.5;
            double sum = 0.0;
            for (int i = 0; i < 2; ++i) {
                const double R = balls[i].radius + 1.4;
                const double C = i == 0 ? 0.1 : M_LN2 / (0.5 * R);
                sum += std::exp(decays[i].level -
                                C * ((x - Vec3d(balls[i].center)).lengthSqr() - R * R));
            }
            EXPECT_NEAR(psi[v], std::log(sum), 2e-5 * (1.0 + std::abs(std::log(sum)))) << x;
        }
    }
    // Beyond the ball that falls off fast only the slow one is left.
    EXPECT_NEAR(field.tolerance(), M_LN2 / (0.1 * (1.7 + 1.4)), 0.01);
}

// A wide bead beside narrow ones is felt as far as its own rate says, whatever the order of balls.
TEST(GaussianSum, OfManyRatesReachesAsFarAsTheSlowest)
{
    constexpr double R = 1.7 + 1.4, wide = 0.1, narrow = 1.0; // [Å], [1/Å^2]
    std::vector<Ball> balls = {{openvdb::Vec3f(0.0f), 1.7f, 0},
                               {openvdb::Vec3f(4.0f, 1.0f, 0.5f), 1.7f, 1},
                               {openvdb::Vec3f(9.0f, 0.0f, 0.0f), 1.7f, 2}};
    const GaussianOptions options{1.4, 0.5, 0.0, 0.5, 3.0};
    for (const int slow : {0, 1}) {
        std::vector<Decay> decays(3, {float(narrow), 0.0f});
        decays[std::size_t(slow)].rate = float(wide);
        const GaussianSum field(balls, options, decays);
        EXPECT_NEAR(field.tolerance(), M_LN2 / (wide * R), 1e-4);
        for (double far = 3.0; far < 7.0; far += 0.5) {
            const Vec3d x(-0.5 * far, far, 0.4);
            double sum = 0.0;
            for (std::size_t i = 0; i < 3; ++i)
                sum += std::exp(-double(decays[i].rate) *
                                ((x - Vec3d(balls[i].center)).lengthSqr() - R * R));
            EXPECT_NEAR(field.jet(x).psi, std::log(sum), 1e-4) << slow << " " << far;
        }
    }
}

// So far within the rim of a ball that is smaller no point lies.
TEST(GaussianSum, SmallBallsCoverNothingBeyondTheirRim)
{
    const std::vector<Ball> balls = {{openvdb::Vec3f(0.0f), 0.3f, 0},
                                     {openvdb::Vec3f(2.0f, 0.0f, 0.0f), 0.5f, 1}};
    const GaussianSum field(balls, {0.0, 0.5, 0.0, 0.5, 3.0});
    for (double x = -0.6; x < 2.6; x += 0.04) {
        for (const double more : {0.0, 0.2, 0.4, 0.6}) {
            const bool covered = std::abs(x) < 0.3 - more || std::abs(x - 2.0) < 0.5 - more;
            EXPECT_EQ(field.isCovered(Vec3d(x, 0.0, 0.0), more), covered) << x << " " << more;
        }
    }
}

// Narrow Gaussians on coarse voxels: the exponents differ so much within a leaf that products
// underflow, and the largest one of each voxel has to be the scale.
TEST(GaussianSum, AgreesWithTheDefinitionWhereProductsUnderflow)
{
    const std::vector<Ball> balls = test::randomBalls(40, 12.0, Vec3d(0.7, -1.1, 0.3), 5);
    GaussianOptions options = optionsFor(0.05, 1.0);
    options.reach = 8.0;
    GaussianSum sum(balls, options);
    const SparseField psi = sum.band(2, Progress());
    const LeafTable& table = psi.table;
    std::size_t low = 0;
    for (std::size_t n = 0; n < table.size(); ++n) {
        for (int v = 0; v < leafSize; ++v) {
            const Vec3d x = table.origin(n).offsetBy(v >> 6, v >> 3 & 7, v & 7).asVec3d();
            const double wanted = std::max(directPsi(balls, options, x), -60.0); // the least psi
            const double got = psi.leaf(n)[v];
            low += wanted > -60.0 && wanted < -30.0;
            EXPECT_NEAR(got, wanted, 0.01 + 1e-4 * std::abs(wanted)) << x;
        }
    }
    EXPECT_GT(low, 100u);
}

} // namespace
} // namespace molsurf
