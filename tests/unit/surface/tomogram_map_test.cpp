// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/tomogram_map.h"

#include "molsurf/error.h"
#include "molsurf/surface.h"
#include "support/molecules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

/// Balls in general position, of carbon, nitrogen and an unknown element.
BallSet threeAtoms()
{
    BallSet atoms;
    atoms.balls = {{Vec3d(1.3, -2.1, 0.7), 1.7, 0},
                   {Vec3d(3.9, -1.0, 2.2), 1.5, 1},
                   {Vec3d(-0.4, 1.8, 4.1), 1.8, 2}};
    atoms.names.emplace();
    for (const int element : {6, 7, 0}) {
        atoms.names->atoms.emplace_back();
        atoms.names->atoms.back().element = std::uint8_t(element);
    }
    return atoms;
}

constexpr double weights[] = {6.0, 7.0, 6.0}; // the last one as carbon

TEST(TomogramMap, TheBoxIsEvenAndTurnsAboutTheMeanPlace)
{
    const BallSet atoms = threeAtoms();
    TomogramSettings settings;
    settings.pixel = 1.3;
    settings.maskExtend = 1.0;
    const PixelBox box = tomogramBox(atoms, settings);
    Vec3d mean(0.0);
    for (int i = 0; i < 3; ++i) mean += weights[i] / 19.0 * atoms.balls[std::size_t(i)].center;
    EXPECT_EQ(box.count % 2, 0);
    EXPECT_LT((box.place(box.count / 2, box.count / 2, box.count / 2) - mean).length(), 1e-12);
    // The third atom is farthest along y: 3.9 Å of a pixel for each of 4 of the mask, or of blur.
    double reach = 0.0;
    for (const Ball& ball : atoms.balls)
        for (int a = 0; a < 3; ++a)
            reach = std::max(reach, std::abs(ball.center[a] - mean[a]) +
                                        std::max(ball.radius + 4.0 * 1.3, 3.0 * 1.3));
    EXPECT_GE((box.count / 2 - 1) * box.pixel, reach);
    EXPECT_LT((box.count / 2 - 2) * box.pixel, reach);
    settings.box = 40;
    EXPECT_EQ(tomogramBox(atoms, settings).count, 40);
    EXPECT_LT((tomogramBox(atoms, settings).place(20, 20, 20) - mean).length(), 1e-12);
    settings.box = 8; // 3 pixels on one side are 3.9 Å
    EXPECT_THROW(tomogramBox(atoms, settings), Error);
    settings.box = 0;
    settings.pixel = 0.0;
    EXPECT_THROW(tomogramBox(atoms, settings), Error);
    settings.pixel = 0.001;
    EXPECT_THROW(tomogramBox(atoms, settings), Error);
}

TEST(TomogramMap, TheDensityIsASumOfGaussians)
{
    BallSet atoms = threeAtoms();
    TomogramSettings settings;
    settings.pixel = 0.9;
    const auto check = [&](const std::vector<double>& resolutions) {
        const PixelBox box = tomogramBox(atoms, settings);
        const std::vector<float> values = tomogramDensity(atoms, settings, box, Progress());
        const double sign = settings.invert ? -1.0 : 1.0;
        double sum = 0.0;
        for (const float value : values) sum += double(value);
        EXPECT_NEAR(sign * sum * std::pow(box.pixel, 3), 19.0, 0.01);
        for (int z = 0; z < box.count; ++z)
            for (int y = 0; y < box.count; y += 3)
                for (int x = 0; x < box.count; x += 5) {
                    double exact = 0.0;
                    for (std::size_t i = 0; i < 3; ++i) {
                        const double sigma = resolutions[i] / (M_PI * std::sqrt(2.0));
                        const double away =
                            (box.place(x, y, z) - atoms.balls[i].center).lengthSqr();
                        exact += weights[i] / std::pow(2.0 * M_PI * sigma * sigma, 1.5) *
                                 std::exp(-0.5 * away / (sigma * sigma));
                    }
                    ASSERT_NEAR(sign * values[box.at(x, y, z)], exact, 3e-6);
                }
    };
    check({2.7, 2.7, 2.7}); // three pixels
    atoms.decays.resize(3);
    for (std::size_t i = 0; i < 2; ++i) // and one that keeps the default
        atoms.decays[i].rate = float(M_PI * M_PI / std::pow(4.0 + double(i), 2));
    settings.invert = true;
    check({4.0, 5.0, 2.7});
}

TEST(TomogramMap, TheMaskFallsByACosine)
{
    const BallSet atoms = threeAtoms();
    BallSet one;
    one.balls = {{Vec3d(0.3, -0.2, 0.1), 6.0, 0}};
    SurfaceOptions options;
    options.kind = SurfaceKind::VanDerWaals;
    options.voxel = 0.25;
    const Mesh mesh = makeSurface(one, options).mesh;
    TomogramSettings settings;
    settings.pixel = 0.8;
    for (const double extend : {0.0, 1.5})
        for (const double edge : {0.0, 2.5}) {
            settings.maskExtend = extend;
            settings.maskEdge = edge;
            settings.box = 36; // there are blocks that are wholly 0, and in part outside of the box
            const PixelBox box = tomogramBox(one, settings);
            const std::vector<float> mask = softMask(mesh, settings, box, Progress());
            std::size_t between = 0;
            for (int z = 0; z < box.count; ++z)
                for (int y = 0; y < box.count; ++y)
                    for (int x = 0; x < box.count; ++x) {
                        const double r = (box.place(x, y, z) - one.balls[0].center).length();
                        const double beyond = (r - 6.0) / 0.8 - extend;
                        const float value = mask[box.at(x, y, z)];
                        const double wanted = beyond < 0.0 ? 1.0
                                              : beyond > edge
                                                  ? 0.0
                                                  : 0.5 + 0.5 * std::cos(M_PI * beyond / edge);
                        // The mesh lies 0.005 Å from the ball.
                        const bool atEdge =
                            std::abs(beyond) < 0.02 || std::abs(beyond - edge) < 0.02;
                        if (!atEdge || edge > 0.0) {
                            ASSERT_NEAR(value, wanted, 0.02) << r;
                        }
                        between += value > 0.0f && value < 1.0f;
                    }
            EXPECT_EQ(between > 1000, edge > 0.0);
        }
}

TEST(TomogramMap, CostsGrowWithTheBox)
{
    const BallSet atoms = threeAtoms();
    TomogramSettings settings;
    settings.pixel = 1.0;
    settings.box = 64;
    const Cost density = costOfDensity(atoms, settings), mask = costOfMask(atoms, settings);
    settings.box = 128;
    EXPECT_DOUBLE_EQ(costOfDensity(atoms, settings).bytes, 8.0 * density.bytes);
    EXPECT_DOUBLE_EQ(costOfMask(atoms, settings).seconds, 8.0 * mask.seconds);
    EXPECT_DOUBLE_EQ(density.bytes, 4.0 * 64 * 64 * 64);
    EXPECT_GT(density.seconds, 0.0);
}

} // namespace
} // namespace molsurf
