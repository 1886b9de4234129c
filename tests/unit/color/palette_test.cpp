// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/color/palette.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

/// CIE L*a*b* of a colour, white point D65.
Vec3d labOf(const Color& color)
{
    const openvdb::Vec3f l = linearLight(color);
    const double rows[3][3] = {{0.4124564, 0.3575761, 0.1804375},
                               {0.2126729, 0.7151522, 0.0721750},
                               {0.0193339, 0.1191920, 0.9503041}};
    Vec3d f;
    for (int i = 0; i < 3; ++i) {
        const double* m = rows[i];
        const double t = (m[0] * double(l[0]) + m[1] * double(l[1]) + m[2] * double(l[2])) /
                         (m[0] + m[1] + m[2]);
        f[i] = t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
    }
    return {116.0 * f[1] - 16.0, 500.0 * (f[0] - f[1]), 200.0 * (f[1] - f[2])};
}

/// The difference of two colours, CIEDE2000 (Sharma, Wu and Dalal, Color Res. Appl. 30:21, 2005).
double differenceOf(const Vec3d& p, const Vec3d& q)
{
    const auto rad = [](double degrees) { return degrees * M_PI / 180.0; };
    const auto bent = [](double c) {
        return std::sqrt(std::pow(c, 7) / (std::pow(c, 7) + std::pow(25.0, 7)));
    };
    const double mean = 0.5 * (std::hypot(p[1], p[2]) + std::hypot(q[1], q[2]));
    const double g = 1.5 - 0.5 * bent(mean);
    const double a1 = g * p[1], a2 = g * q[1], c1 = std::hypot(a1, p[2]), c2 = std::hypot(a2, q[2]);
    const auto hue = [&](double a, double b) {
        const double h = std::atan2(b, a) * 180.0 / M_PI;
        return h < 0.0 ? h + 360.0 : h;
    };
    const double h1 = hue(a1, p[2]), h2 = hue(a2, q[2]);
    double turn = c1 * c2 == 0.0 ? 0.0 : h2 - h1, h = h1 + h2;
    if (std::abs(turn) > 180.0) {
        turn += turn > 0.0 ? -360.0 : 360.0;
        h += h < 360.0 ? 360.0 : -360.0;
    }
    if (c1 * c2 != 0.0) h *= 0.5;
    const double l = 0.5 * (p[0] + q[0]) - 50.0, c = 0.5 * (c1 + c2);
    const double t = 1.0 - 0.17 * std::cos(rad(h - 30.0)) + 0.24 * std::cos(rad(2.0 * h)) +
                     0.32 * std::cos(rad(3.0 * h + 6.0)) - 0.2 * std::cos(rad(4.0 * h - 63.0));
    const double dl = (q[0] - p[0]) / (1.0 + 0.015 * l * l / std::sqrt(20.0 + l * l));
    const double dc = (c2 - c1) / (1.0 + 0.045 * c);
    const double dh = 2.0 * std::sqrt(c1 * c2) * std::sin(rad(0.5 * turn)) / (1.0 + 0.015 * c * t);
    const double x = (h - 275.0) / 25.0;
    const double r = -2.0 * bent(c) * std::sin(rad(60.0 * std::exp(-x * x)));
    return std::sqrt(dl * dl + dc * dc + dh * dh + r * dc * dh);
}

TEST(Palette, TheDifferenceIsThatOfItsPaper)
{
    EXPECT_NEAR(differenceOf({50, 2.6772, -79.7751}, {50, 0, -82.7485}), 2.0425, 1e-4);
    EXPECT_NEAR(differenceOf({50, 2.5, 0}, {73, 25, -18}), 27.1492, 1e-4);
    EXPECT_NEAR(differenceOf({2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}), 0.9082, 1e-4);
}

TEST(Palette, FortyColoursDifferByTen)
{
    std::vector<Color> colors =
        distinctColors(std::vector<std::vector<std::int32_t>>(mostDistinct));
    ASSERT_EQ(colors.size(), 40u);
    EXPECT_EQ(colors[0], (Color{86, 180, 233}));
    for (const Color& color : colors) EXPECT_GE(labOf(color)[0], 35.0);
    colors.push_back(neutralColor);
    colors.push_back(noValueColor);
    for (std::size_t i = 0; i < colors.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_GE(differenceOf(labOf(colors[i]), labOf(colors[j])), 10.0) << i << " " << j;
}

TEST(Palette, NoPaletteOfValuesHasTheColourOfNoValue)
{
    for (const Palette& palette : paletteTable()) {
        const ColorScale scale = scaleOf(palette.word, 0.0, 1.0);
        for (int i = 0; i <= 100; ++i)
            for (int j = 3; j <= 20; ++j) {
                const openvdb::Vec3f light = linearLight(scale.at(0.01 * i));
                Color shaded;
                for (int c = 0; c < 3; ++c) shaded[c] = fromLinearLight(0.05 * j * light[c]);
                ASSERT_GE(differenceOf(labOf(shaded), labOf(noValueColor)), 10.0)
                    << palette.word << " " << i << " " << j;
            }
    }
}

TEST(Palette, ChainsHaveTheColoursOfTheirPlaces)
{
    const std::vector<Color> all =
        distinctColors(std::vector<std::vector<std::int32_t>>(mostDistinct));
    BallSet atoms;
    BallLabels& labels = atoms.labels.emplace();
    labels.chains = {"C", "A"};
    labels.chainPlaces = {2, 0};
    EXPECT_EQ(chainColors(atoms, Progress()), (std::vector<Color>{all[2], all[0]}));
    labels.chainPlaces = {2, 40}; // which has none of its own
    EXPECT_EQ(chainColors(atoms, Progress()), (std::vector<Color>{all[0], all[1]}));
    labels.groups = {{"entity 4", 0, {}, 3}, {"own", 0, Color{1, 2, 3}, 5}, {"first", 0, {}, 0}};
    EXPECT_EQ(groupColors(atoms, Progress()), (std::vector<Color>{all[3], {1, 2, 3}, all[0]}));
}

TEST(Palette, OneMoreSharesAndSaysSo)
{
    BallSet atoms;
    BallLabels& labels = atoms.labels.emplace();
    labels.chains.resize(40);
    EXPECT_TRUE(colorWarnings(atoms, ColorBy::Chain).empty());
    labels.chains.resize(41);
    ASSERT_EQ(colorWarnings(atoms, ColorBy::Chain).size(), 1u);
    EXPECT_NE(colorWarnings(atoms, ColorBy::Hetero)[0].find("41 chains share"), std::string::npos);
    EXPECT_TRUE(colorWarnings(atoms, ColorBy::Group).empty());
    EXPECT_TRUE(colorWarnings(atoms, ColorBy::Element).empty());
    const std::vector<Color> shared = distinctColors(std::vector<std::vector<std::int32_t>>(41));
    EXPECT_EQ(std::set<Color>(shared.begin(), shared.end()).size(), 8u);
}

/// Copies of a cube of four atoms, with an edge of 10 Å.
BallSet cubesAt(const std::vector<Vec3d>& places)
{
    BallSet atoms;
    for (const Vec3d& corner :
         {Vec3d(5, 5, 5), Vec3d(-5, -5, 5), Vec3d(-5, 5, -5), Vec3d(5, -5, -5)})
        atoms.balls.push_back({corner, 1.5, std::int32_t(atoms.balls.size())});
    atoms.placement.begin = {0, 4};
    atoms.placement.numbers = {1};
    for (const Vec3d& place : places) {
        Instance copy{Motion::identity(), 0, ""};
        copy.translation = place;
        atoms.placement.instances.push_back(copy);
    }
    return atoms;
}

// Of more copies than there are colours those beside each other differ: cubes that touch by faces,
// as far as 0.7 of their diagonals, 12.1 Å, go.
TEST(Palette, CopiesBesideEachOtherDiffer)
{
    for (const double apart : {10.0, 12.0, 12.3}) {
        std::vector<Vec3d> places;
        for (int i = 0; i < 45; ++i) places.emplace_back(1000.0 * i, 0.0, 0.0);
        const std::vector<Color> alone = instanceColors(cubesAt(places), Progress());
        EXPECT_EQ(alone[0], alone[8]); // eight colours in turn
        places[8] = Vec3d(0.0, apart, 0.0);
        const std::vector<Color> beside = instanceColors(cubesAt(places), Progress());
        EXPECT_EQ(beside[0] != beside[8], apart < 12.1) << apart;
    }
}

} // namespace
} // namespace molsurf
