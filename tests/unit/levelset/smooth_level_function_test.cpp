// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/levelset/smooth_level_function.h"

#include "molsurf/kernel/flow/initial_surface.h"
#include "molsurf/kernel/levelset/gaussian_sum.h"
#include "support/fields.h"
#include "support/molecules.h"

#include <gtest/gtest.h>

#include <cmath>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

constexpr double epsilon = 0.5, slope = 2.0 * M_LN2 / epsilon;

/// psi of some balls, phi of psi = 0, and the carrier of that.
struct Fields {
    SparseField psi, phi, carrier;
    const LeafTable& table() const { return phi.table; }
};

Fields fieldsOf(const std::vector<Ball>& balls, double voxel,
                const std::function<void(Fields&)>& change = nullptr)
{
    constexpr int width = 3;
    GaussianOptions options;
    options.voxelSize = voxel;
    options.reach = (width + 1.5) * voxel;
    GaussianSum sum(balls, options);
    Fields f;
    f.psi = sum.band(width, Progress());
    f.phi = initialSurface(f.psi, width * voxel, {}, Progress());
    if (change) change(f);
    f.carrier = smoothCarrier(f.phi, {f.psi.values, SlopeField(slope), false, 0.0}, width * voxel,
                              Progress());
    return f;
}

const std::vector<Ball> pair = {{{-2.13f, 0.2f, 0.1f}, 1.7f, 0}, {{2.21f, -0.1f, 0.3f}, 1.7f, 1}};

// On psi = 0 itself v is 0, and nothing but psi is left.
TEST(SmoothCarrier, IsPsiOverItsSlopeOnPsiZero)
{
    for (const double voxel : {0.5, 0.25}) {
        const Fields f = fieldsOf(pair, voxel);
        double worst = 0.0;
        std::size_t near = 0;
        test::forEachActive(f.table(), voxel, [&](std::size_t n, int v, const Vec3d&) {
            if (std::abs(f.phi.leaf(n)[v]) > voxel) return;
            ++near;
            worst = std::max(worst, std::abs(f.carrier.leaf(n)[v] + f.psi.leaf(n)[v] / slope));
        });
        for (std::size_t n = 0; n < f.table().size(); ++n) // far away psi is much lower
            for (int v = 0; v < leafSize; ++v)
                ASSERT_LE(std::abs(f.carrier.leaf(n)[v]), 6.001 * voxel); // twice the band
        EXPECT_GT(near, 500u);
        EXPECT_LT(worst, 0.02) << voxel; // [Å]
    }
}

// On a sphere that is not psi = 0 the level of psi is that at the feet of the voxels. One ball's
// psi is quadratic, so the expansion of second order is exact. Without a level, as where phi has no
// clear normal, it would be 0.2 Å off.
TEST(SmoothCarrier, HasTheLevelOfPsiAtTheFeet)
{
    constexpr double voxel = 0.5, R = 3.1, radius = 3.3;
    const Vec3d centre(0.137, -0.291, 0.443);
    const Ball ball{openvdb::Vec3f(centre), 1.7f, 0};
    for (const auto& [steep, bound] : {std::pair(1.0, 0.0025), std::pair(0.85, 0.05)}) {
        const Fields f = fieldsOf({ball}, voxel, [&, steep = steep](Fields& fields) {
            test::forEachActive(fields.table(), voxel, [&](std::size_t n, int v, const Vec3d& x) {
                fields.phi.leaf(n)[v] = float(steep * ((x - centre).length() - radius));
            });
        });
        const double decay = M_LN2 / (epsilon * R);
        double worst = 0.0;
        std::size_t near = 0;
        test::forEachActive(f.table(), voxel, [&](std::size_t n, int v, const Vec3d& x) {
            const double r = (x - centre).length();
            if (std::abs(r - radius) > voxel) return;
            ++near;
            const double wanted = decay * (r * r - radius * radius) / slope;
            worst = std::max(worst, std::abs(double(f.carrier.leaf(n)[v]) - wanted));
        });
        EXPECT_GT(near, 500u);
        EXPECT_LT(worst, bound); // [Å]
    }
}

/// All voxels of the eight leaves about the origin.
LeafTable cube()
{
    std::vector<openvdb::Coord> origins;
    for (int i = 0; i < 8; ++i)
        origins.emplace_back(8 * (i / 4) - 8, 8 * (i / 2 % 2) - 8, 8 * (i % 2) - 8);
    LeafTable table(std::move(origins));
    for (std::size_t n = 0; n < table.size(); ++n) table.active(n) = ~LeafMask();
    return table;
}

// No voxel is nearer to this front than half a voxel, and psi has another level there than 0.
TEST(SmoothCarrier, KnowsTheLevelOfAFrontBetweenVoxels)
{
    constexpr double voxel = 0.5, front = 0.25, level = -0.4;
    const LeafTable table = cube();
    const SparseField phi =
        test::filled(table, voxel, [](const Vec3d& x) { return x.x() - front; });
    const SparseField psi =
        test::filled(table, voxel, [](const Vec3d& x) { return level - slope * (x.x() - front); });
    const SparseField carrier =
        smoothCarrier(phi, {psi.values, SlopeField(slope), false, 0.0}, 3.0 * voxel, Progress());
    test::forEachActive(table, voxel, [&](std::size_t n, int v, const Vec3d& x) {
        if (std::abs(x.x() - front) < voxel) {
            ASSERT_NEAR(carrier.leaf(n)[v], x.x() - front, 1e-4) << x;
        }
    });
}

// At the bottom of the valley of the metric, (1 + lambda |grad psi|^2) e^psi = 1, the carrier has
// the shape of psi, and that of the distance where the front has left the valley on either side.
TEST(SmoothCarrier, HasTheShapeOfPsiInTheValleyAlone)
{
    constexpr double voxel = 0.5, front = 0.1, share = 0.5;
    const LeafTable table = cube();
    const SparseField phi =
        test::filled(table, voxel, [](const Vec3d& x) { return x.x() - front; });
    for (const double lambda : {0.0, 0.1, 1.0}) {
        const double bottom = -std::log(1.0 + lambda * slope * slope);
        for (const double above : {-1.4, -0.4, 0.0, 0.4, 1.4}) {
            const SparseField psi = test::filled(table, voxel, [&](const Vec3d& x) {
                return bottom + above - share * slope * (x.x() - front);
            });
            const SparseField carrier = smoothCarrier(
                phi, {psi.values, SlopeField(slope), false, lambda}, 3.0 * voxel, Progress());
            const double shape = std::abs(above) > 1.0 ? 1.0 : share;
            test::forEachActive(table, voxel, [&](std::size_t n, int v, const Vec3d& x) {
                const double d = x.x() - front;
                if (std::abs(d) > voxel) return;
                ASSERT_NEAR(carrier.leaf(n)[v], shape * d, 2e-3) << lambda << ' ' << above;
            });
        }
    }
}

// A sheet thinner than a voxel has no normal in its middle.
TEST(SmoothCarrier, IsThatOfPsiInAThinSheet)
{
    constexpr double voxel = 0.5, half = 0.25;
    const LeafTable table = cube();
    const auto distance = [](const Vec3d& x) { return std::abs(x.x()) - half; };
    const SparseField phi = test::filled(table, voxel, distance);
    const SparseField psi =
        test::filled(table, voxel, [&](const Vec3d& x) { return -slope * distance(x); });
    const SparseField carrier =
        smoothCarrier(phi, {psi.values, SlopeField(slope), false, 0.0}, 3.0 * voxel, Progress());
    test::forEachActive(table, voxel, [&](std::size_t n, int v, const Vec3d& x) {
        if (std::abs(x.x()) <= 4.0 * voxel) {
            ASSERT_NEAR(carrier.leaf(n)[v], distance(x), 0.1) << x;
        }
    });
}

// The third difference along an axis across the crease between the balls: that of the distance
// does not fall with the voxel, since it has a ridge there.
TEST(SmoothCarrier, HasNoRidgeOutsideACrease)
{
    constexpr double voxel = 0.25;
    const Fields f = fieldsOf(pair, voxel);
    const auto rough = [&](const SparseField& field) {
        double worst = 0.0;
        for (std::size_t n = 0; n < f.table().size(); ++n) {
            for (int v = 0; v < leafSize; ++v) {
                const int x = v >> 6;
                if (x > 4 || std::abs(f.phi.leaf(n)[v + 64]) > 1.5 * voxel ||
                    std::abs(f.phi.leaf(n)[v + 128]) > 1.5 * voxel)
                    continue;
                const float* p = field.leaf(n) + v;
                worst =
                    std::max(worst, double(std::abs(p[192] - 3.0f * p[128] + 3.0f * p[64] - p[0])));
            }
        }
        return worst / voxel;
    };
    EXPECT_LT(rough(f.carrier), 0.5 * rough(f.phi)) << rough(f.phi);
}

// A front between two balls that are far from each other, where psi is low and falls to both sides
// of the plane through the middle: the carrier has its zero set at the front and nowhere else.
TEST(SmoothCarrier, KeepsTheSidesOfAFrontThatSpansAGap)
{
    const std::vector<Ball> apart = {{{-4.4, 0.2, 0.1}, 1.7, 0}, {{4.4, -0.1, 0.3}, 1.7, 1}};
    constexpr double voxel = 0.5, front = 0.3, width = 3.0 * voxel;
    const auto span = [&](Fields& f) {
        // A slab of the gap, all of it in the table, on one side of y = front.
        std::vector<openvdb::Coord> origins;
        for (int x = -16; x <= 8; x += leafDim)
            for (int y = -8; y <= 0; y += leafDim)
                for (int z = -8; z <= 0; z += leafDim) origins.emplace_back(x, y, z);
        GaussianOptions options;
        options.voxelSize = voxel;
        options.reach = 20.0;
        f.psi = GaussianSum(apart, options).evaluate(LeafTable(std::move(origins)), Progress());
        f.phi = SparseField{f.psi.table, LeafField(f.psi.table.size()), voxel};
        for (std::size_t n = 0; n < f.table().size(); ++n) {
            f.phi.table.active(n) = ~LeafMask();
            for (int v = 0; v < leafSize; ++v) {
                const openvdb::Coord c = f.table().origin(n).offsetBy(v >> 6, v >> 3 & 7, v & 7);
                f.phi.leaf(n)[v] =
                    float(std::clamp(c.asVec3d().y() * voxel - front, -width, width));
            }
        }
    };
    const Fields f = fieldsOf(apart, voxel, span);
    std::size_t low = 0;
    for (std::size_t n = 0; n < f.table().size(); ++n) {
        for (int v = 0; v < leafSize; ++v) {
            const float d = f.phi.leaf(n)[v], carried = f.carrier.leaf(n)[v];
            low += f.psi.leaf(n)[v] < -2.0f;
            if (std::abs(d) <= float(voxel)) continue;
            ASSERT_GE(carried * (d < 0.0f ? -1.0f : 1.0f), 0.199f * (std::abs(d) - float(voxel)))
                << f.table().origin(n) << ' ' << v;
        }
    }
    EXPECT_GT(low, 1000u);
}

// A hollow that was filled has no interface any more: psi alone would bring it back.
TEST(SmoothCarrier, KeepsFilledHollowsFilled)
{
    std::vector<Ball> shell;
    for (int i = 0; i < 60; ++i) { // a Fibonacci lattice
        const double z = 1.0 - (2.0 * i + 1.0) / 60, angle = 2.399963229728653 * i;
        const Vec3d c(std::sqrt(1.0 - z * z) * Vec3d(std::cos(angle), std::sin(angle), 0.0) +
                      Vec3d(0.0, 0.0, z));
        shell.push_back({openvdb::Vec3f(6.0 * c), 1.7f, i});
    }
    constexpr double voxel = 0.5, width = 3.0 * voxel;
    const auto fill = [&](Fields& f) {
        for (std::size_t n = 0; n < f.table().size(); ++n) {
            for (int v = 0; v < leafSize; ++v) {
                const openvdb::Coord c = f.table().origin(n).offsetBy(v >> 6, v >> 3 & 7, v & 7);
                if ((c.asVec3d() * voxel).length() < 5.0) f.phi.leaf(n)[v] = -float(width);
            }
        }
    };
    std::size_t hollow = 0, wrong = 0;
    const Fields f = fieldsOf(shell, voxel, fill);
    for (std::size_t n = 0; n < f.table().size(); ++n) {
        for (int v = 0; v < leafSize; ++v) {
            const openvdb::Coord c = f.table().origin(n).offsetBy(v >> 6, v >> 3 & 7, v & 7);
            if ((c.asVec3d() * voxel).length() > 4.5) continue;
            hollow += f.psi.leaf(n)[v] < -0.5f;
            wrong += f.carrier.leaf(n)[v] >= 0.0f;
        }
    }
    EXPECT_GT(hollow, 100u);
    EXPECT_EQ(wrong, 0u);
}

} // namespace
} // namespace molsurf
