// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/measures/shape_complementarity.h"

#include "molsurf/molecule/selection/groups.h"
#include "molsurf/surface.h"
#include "support/molecules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

/// The volume of the neck that a probe leaves between two equal balls, by Simpson's rule.
double neckVolume(double radius, double gap, double probe)
{
    const double half = 0.5 * gap + radius, rolled = radius + probe;
    const double ring = std::sqrt(rolled * rolled - half * half), end = probe * half / rolled;
    const auto area = [&](double z) {
        const double neck = ring - std::sqrt(probe * probe - z * z);
        const double ball = z > 0.5 * gap ? radius * radius - (half - z) * (half - z) : 0.0;
        return M_PI * (neck * neck - ball);
    };
    constexpr int steps = 20000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) sum += area(end * (i + 0.5) / steps);
    return 2.0 * sum * end / steps;
}

Report::Interface::Fit fitOf(const std::vector<Ball>& first, const std::vector<Ball>& second)
{
    const Progress nobody;
    return FitMeasure().of(FitSurface(first, nobody), FitSurface(second, nobody), nobody);
}

// Values rise towards the rim, so medians are those of the circle that halves the area.
TEST(Fit, OfTwoBallsIsThatOfTheMiddleCircle)
{
    const double R = 25.0, probe = 1.7, rim = 1.5;
    for (const double gap : {0.2, 1.0}) {
        const double apart = 2.0 * R + gap;
        const auto fit = fitOf({{Vec3d(0.0), R, 0}}, {{Vec3d(0.0, 0.0, apart), R, 1}});
        const double most = std::acos(0.5 * apart / (R + probe));
        const double trimmed = most - 2.0 * std::asin(0.5 * rim / R);
        const double middle = std::acos(0.5 * (1.0 + std::cos(trimmed)));
        const Vec3d normal(std::sin(middle), 0.0, std::cos(middle));
        const Vec3d way = R * normal - Vec3d(0.0, 0.0, apart);
        const double d = way.length() - R;
        EXPECT_NEAR(fit.distance, d, 0.02) << gap;
        EXPECT_NEAR(fit.shape, -normal.dot(way) / way.length() * std::exp(-0.5 * d * d), 0.01);
        const double volume = neckVolume(R, gap, probe);
        EXPECT_NEAR(fit.gapVolume, volume, 1e-5 * volume);
        const double buried = 2.0 * M_PI * R * R * (1.0 - std::cos(most));
        EXPECT_NEAR(fit.gapIndex, volume / buried, 0.01 * volume / buried);
        // The way from a point of one ball to the other leads to that one's centre, or to the end
        // of its cap.
        double contact = 0.0;
        constexpr int steps = 4000;
        for (int i = 0; i < steps; ++i) {
            const double angle = most * (i + 0.5) / steps;
            const Vec3d x(R * std::sin(angle), 0.0, R * std::cos(angle)), b(0.0, 0.0, apart);
            Vec3d foot = b + R * (x - b).unit();
            if (std::acos((b - foot).z() / R) > most)
                foot = b + R * Vec3d(std::sin(most), 0.0, -std::cos(most));
            contact += 2.0 * M_PI * R * R * std::sin(angle) * most / steps *
                       std::exp(-0.5 * (x - foot).lengthSqr());
        }
        for (const double one : fit.contact) EXPECT_NEAR(one, contact, 1e-3 * contact) << gap;
    }
}

TEST(Fit, OfWhatHardlyTouchesIsUnknown)
{
    const Ball one{Vec3d(0.0), 1.7, 0};
    const auto touching = fitOf({one}, {{Vec3d(0.0, 0.0, 4.2), 1.7, 1}});
    EXPECT_TRUE(std::isnan(touching.shape));
    EXPECT_TRUE(std::isnan(touching.distance));
    EXPECT_GT(touching.gapVolume, 1.0);
    const auto apart = fitOf({one}, {{Vec3d(0.0, 0.0, 30.0), 1.7, 1}});
    EXPECT_TRUE(std::isnan(apart.shape));
    EXPECT_TRUE(std::isnan(apart.gapIndex));
    EXPECT_EQ(apart.gapVolume, 0.0);
    EXPECT_EQ(apart.contact[0], 0.0);
    EXPECT_GT(touching.contact[0], 0.0);
}

// A far ball makes the group one of two, so that its points are sampled: 30 points in an Å^2.
TEST(Fit, OfTwoSpheresIsThatOfSampledPoints)
{
    const auto check = [](double a, double b, double apart) {
        const std::vector<Ball> one = {{Vec3d(0.1, 0.2, 0.3), a, 0}};
        const Vec3d way(2.0, -1.0, 0.5);
        std::vector<Ball> other = {{one[0].center + apart * way.unit(), b, 1}};
        const auto exact = fitOf(one, other), swapped = fitOf(other, one);
        other.push_back({Vec3d(60.0, 0.0, 0.0), 1.5, 2});
        const auto sampled = fitOf(one, other);
        EXPECT_EQ(exact.shape, swapped.shape) << apart;
        EXPECT_EQ(exact.distance, swapped.distance) << apart;
        EXPECT_NEAR(exact.shape, sampled.shape, 0.03) << a << " " << b << " " << apart;
        EXPECT_NEAR(exact.distance, sampled.distance, 0.03 * std::max(exact.distance, 1.0))
            << a << " " << b << " " << apart;
        EXPECT_NEAR(exact.gapVolume, sampled.gapVolume, 1e-6);
        EXPECT_NEAR(exact.gapIndex, sampled.gapIndex, 0.02 * std::abs(sampled.gapIndex));
        for (std::size_t k = 0; k < 2; ++k) {
            EXPECT_EQ(exact.contact[k], swapped.contact[1 - k]) << apart;
            EXPECT_NEAR(exact.contact[k], sampled.contact[k], 0.05 * exact.contact[k] + 0.02)
                << a << " " << b << " " << apart;
        }
    };
    check(2.64, 2.64, 3.0); // overlapping
    check(2.64, 2.64, 5.3); // hardly touching
    check(2.64, 1.9, 3.6);
    check(8.0, 1.7, 7.0); // the centre of the small one is inside of the large one
    check(8.0, 7.0, 1.5); // more than a hemisphere of the smaller one
    check(25.0, 20.0, 45.6);
    const auto swallowed = fitOf({{Vec3d(0.0), 6.0, 0}}, {{Vec3d(0.0, 2.0, 0.0), 1.0, 1}});
    EXPECT_TRUE(std::isnan(swallowed.shape));
    const double own = -4.0 / 3.0 * M_PI; // its volume is counted twice
    EXPECT_NEAR(swallowed.gapVolume, own, 1e-6);
    EXPECT_NEAR(swallowed.gapIndex, own / (2.0 * M_PI), 1e-6);
}

// Sc of arpeggia 0.10.1 for these radii: 0.774.
TEST(Fit, OfTwoChainsIsTheSameInEveryPose)
{
    SelectOptions options;
    options.hetero = Hetero::None;
    const Structure structure = readStructure(std::string(MOLSURF_TEST_DATA) + "/4at1.ent.gz");
    std::vector<Ball> chains[2];
    for (const int c : {0, 1}) {
        options.select = c == 0 ? "A" : "B";
        chains[c] = selectBalls(structure, options).balls;
        for (Ball& ball : chains[c]) {
            const std::uint8_t element = structure.atoms[std::size_t(ball.atom)].element;
            ball.radius = element == 7 ? 1.7 : element == 8 ? 1.5 : 1.9;
        }
    }
    const auto first = fitOf(chains[0], chains[1]);
    EXPECT_NEAR(first.shape, 0.774, 0.02);
    const openvdb::math::Quat<double> turn(Vec3d(1.0, 2.0, -0.5).unit(), 1.2);
    for (std::vector<Ball>& balls : chains)
        for (Ball& ball : balls)
            ball.center = turn.rotateVector(ball.center) + Vec3d(3.3, 1.1, 9.7);
    std::reverse(chains[0].begin(), chains[0].end());
    const auto turned = fitOf(chains[1], chains[0]);
    EXPECT_NEAR(turned.shape, first.shape, 0.005);
    EXPECT_NEAR(turned.distance, first.distance, 0.005);
    EXPECT_NEAR(turned.gapVolume, first.gapVolume, 1e-3);
    EXPECT_NEAR(turned.gapIndex, first.gapIndex, 0.003);
}

// Groups of one surface have it in the report; a unit has it as the whole.
TEST(Fit, IsInTheReport)
{
    SelectOptions select;
    select.assembly.name = "1";
    LabelOptions labels;
    labels.groupBy = parseGroupBy("copy");
    SurfaceOptions options;
    options.kind = SurfaceKind::SolventAccessible;
    options.grid = false;
    options.interfaces = true;
    const std::string path = std::string(MOLSURF_TEST_DATA) + "/1a8o.cif.gz";
    const Report whole =
        makeSurface(Molecule(path).balls(select, labels, options.probe), options).report;
    ASSERT_EQ(whole.interfaces.size(), 1u);
    const Report::Interface::Fit& fit = whole.interfaces[0].fit;
    EXPECT_GT(fit.shape, 0.5);
    EXPECT_LT(fit.shape, 0.8);
    select.assembly.bySymmetry = true;
    select.assembly.surroundings = surroundingsOf(options);
    const Report unit =
        makeSurface(Molecule(path).balls(select, labels, options.probe), options).report;
    ASSERT_EQ(unit.interfaces.size(), 1u);
    EXPECT_NEAR(unit.interfaces[0].fit.shape, fit.shape, 0.005);
    EXPECT_NEAR(unit.interfaces[0].fit.gapVolume, fit.gapVolume, 0.1);
}

} // namespace
} // namespace molsurf
