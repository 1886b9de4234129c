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

// Values rise towards the rim, so medians are those of the circle that halves the area.
TEST(Fit, OfTwoBallsIsThatOfTheMiddleCircle)
{
    const double R = 25.0, probe = 1.7, rim = 1.5;
    for (const double gap : {0.2, 1.0}) {
        const double apart = 2.0 * R + gap;
        const auto fit =
            FitMeasure().of({{Vec3d(0.0), R, 0}}, {{Vec3d(0.0, 0.0, apart), R, 1}}, Progress());
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
    }
}

TEST(Fit, OfWhatHardlyTouchesIsUnknown)
{
    const Ball one{Vec3d(0.0), 1.7, 0};
    const auto touching = FitMeasure().of({one}, {{Vec3d(0.0, 0.0, 4.0), 1.7, 1}}, Progress());
    EXPECT_TRUE(std::isnan(touching.shape));
    EXPECT_TRUE(std::isnan(touching.distance));
    EXPECT_GT(touching.gapVolume, 1.0);
    const auto apart = FitMeasure().of({one}, {{Vec3d(0.0, 0.0, 30.0), 1.7, 1}}, Progress());
    EXPECT_TRUE(std::isnan(apart.shape));
    EXPECT_TRUE(std::isnan(apart.gapIndex));
    EXPECT_EQ(apart.gapVolume, 0.0);
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
    const auto first = FitMeasure().of(chains[0], chains[1], Progress());
    EXPECT_NEAR(first.shape, 0.774, 0.02);
    const openvdb::math::Quat<double> turn(Vec3d(1.0, 2.0, -0.5).unit(), 1.2);
    for (std::vector<Ball>& balls : chains)
        for (Ball& ball : balls)
            ball.center = turn.rotateVector(ball.center) + Vec3d(3.3, 1.1, 9.7);
    std::reverse(chains[0].begin(), chains[0].end());
    const auto turned = FitMeasure().of(chains[1], chains[0], Progress());
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
