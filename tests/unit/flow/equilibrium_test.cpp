// SPDX-License-Identifier: MPL-2.0
#include "support/exact_minimum.h"
#include "support/fields.h"
#include "support/flow.h"
#include "support/molecules.h"

#include "molsurf/kernel/flow/interface_energy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;
using openvdb::Vec3f;

// "Converged" at the default tolerance means at rest: the surface of revolution that minimises the
// energy is known without a level set.

struct Molecule {
    const char* name;
    std::vector<test::AxisBall> balls;
};

const Molecule molecules[] = {{"OneAtom", {{0.0, 3.1}}},
                              {"TwoEqualAtoms", {{-2.0, 3.1}, {2.0, 3.1}}},
                              {"TwoUnequalAtoms", {{-1.75, 3.1}, {1.75, 2.6}}}};

using RestCase = std::tuple<int, Regularizer, double>; // molecule, regulariser, lambda

class Rest : public testing::TestWithParam<RestCase>
{
};

/// Root mean square distance of the evolved surface to the curve along rays, all round.
double errorOf(const test::Evolved& out, const test::PolarCurve& curve, const Vec3d& middle,
               const Vec3d& axis, double voxel)
{
    const Vec3d side = axis.cross(Vec3d(1.0, 0.2, 0.0)).unit(), third = axis.cross(side);
    const int count = 600;
    double sum = 0.0, weights = 0.0;
    for (int i = 0; i < count; ++i) {
        const double theta = M_PI * (i + 0.5) / count, azimuth = 2.399963 * i;
        const Vec3d ray = std::cos(theta) * axis +
                          std::sin(theta) * (std::cos(azimuth) * side + std::sin(azimuth) * third);
        const double rho = curve.at(theta);
        const double t =
            test::zeroOnRay(out.spline, middle, ray, rho - 2.0 * voxel, rho + 2.0 * voxel);
        EXPECT_FALSE(std::isnan(t));
        sum += std::sin(theta) * (t - rho) * (t - rho);
        weights += std::sin(theta);
    }
    return std::sqrt(sum / weights);
}

TEST_P(Rest, IsTheMinimumAtTheDefaultTolerance)
{
    const auto [index, regularizer, lambda] = GetParam();
    const Molecule& molecule = molecules[index];
    const test::Energy energy{0.5, lambda, regularizer};
    const test::PolarCurve curve = test::minimalCurve(molecule.balls, energy, 1500);
    ASSERT_TRUE(curve.stationary);
    const Vec3d middle(0.137, -0.291, 0.443), axis(0.48, -0.36, 0.8);
    std::vector<Ball> balls;
    for (const test::AxisBall& ball : molecule.balls)
        balls.push_back({Vec3f(middle + ball.z * axis), float(ball.R - 1.4), 0});
    EvolveOptions options;
    options.lambda = lambda;
    options.regularizer = regularizer;
    for (const double voxel : {0.5, 0.25, 0.125}) {
        const test::Evolved out = test::evolveBalls(balls, energy.epsilon, voxel, options);
        const double error = errorOf(out, curve, middle, axis, voxel);
        EXPECT_TRUE(out.report.converged) << "h " << voxel;
        EXPECT_LE(out.report.steps, 6) << "h " << voxel;
        EXPECT_LT(error, voxel == 0.5 ? 0.003 : 0.001) << "h " << voxel;
        if (getenv("VERBOSE"))
            printf("%s %s lambda %g h %g: %d steps, rms %.5f\n", molecule.name, nameOf(regularizer),
                   lambda, voxel, out.report.steps, error);
    }
}

// The check of an interface in closed form knows the way to rest, whatever it is.
TEST(ClosedForm, KnowsHowFarRestIs)
{
    const std::vector<Ball> balls = test::balls("1crn.pdb");
    const EvolveOptions options;
    ASSERT_TRUE(restsInClosedForm(options));
    for (const double voxel : {0.5, 0.25}) {
        GaussianOptions gaussian;
        gaussian.voxelSize = voxel;
        gaussian.reach = (bandWidthVox + 1.5) * voxel;
        GaussianSum field(balls, gaussian);
        for (const double offset : {0.0, 0.03, -0.03, 0.1}) {
            Displacements ways;
            const test::Evolved out =
                test::restOf(field, field.band(restBandVox(voxel), Progress()), gaussian.epsilon,
                             options, offset, &ways);
            if (offset == 0.0) {
                EXPECT_LT(ways.rms() * voxel, voxel == 0.5 ? 0.0016 : 0.0005);
                EXPECT_LT(ways.quantile(0.999) * voxel, voxel == 0.5 ? 0.016 : 0.006);
            } else { // psi is steeper than that of a plane in few places, less so in creases
                EXPECT_NEAR(ways.mean() * voxel, std::abs(offset), 0.25 * std::abs(offset));
            }
            EXPECT_EQ(out.report.converged, offset == 0.0) << offset;
            EXPECT_DOUBLE_EQ(out.report.displacementRms, ways.rms() * voxel);
            EXPECT_DOUBLE_EQ(out.report.displacementTail, ways.quantile(0.999) * voxel);
        }
    }
}

// Coarse voxels hold an interface to the sag of a chord and to the diagonal of a cell, fine ones as
// near as it is asked for.
TEST(ClosedForm, IsAtRestAsFarAsCoarseVoxelsHoldIt)
{
    const auto converged = [](double h, double most, double rare, double tolerance) {
        Displacements ways; // a share of 0.5 % is beyond the quantile
        for (int i = 0; i < 2000; ++i) ways.add(float((i < 10 ? rare : most) / h));
        EvolveOptions options;
        options.tolerance = tolerance;
        EvolutionReport report;
        checkConvergence(ways, options, h, report);
        return report.converged;
    };
    EXPECT_TRUE(converged(3.0, 0.3, 5.0, 0.01)); // sag 0.56 Å, diagonal 5.2 Å
    EXPECT_FALSE(converged(3.0, 0.6, 5.0, 0.01));
    EXPECT_FALSE(converged(3.0, 0.3, 6.5, 0.01));
    EXPECT_FALSE(converged(3.0, 0.3, 5.0, 0.009)); // who asks for more is told
    EXPECT_FALSE(converged(0.7, 0.025, 0.5, 0.01));
    EXPECT_TRUE(converged(0.8, 0.025, 0.5, 0.01)); // sag 0.04 Å
    EXPECT_TRUE(converged(0.7, 0.015, 0.1, 0.01));
}

// Of one atom the formula leaves nothing out.
TEST(ClosedForm, IsExactOfOneAtom)
{
    for (const Regularizer regularizer : {Regularizer::Gradient, Regularizer::Area}) {
        EvolveOptions options;
        options.lambda = 0.02;
        options.regularizer = regularizer;
        GaussianOptions gaussian;
        gaussian.voxelSize = 0.25;
        GaussianSum field({{{0.1, 0.2, 0.3}, 1.7, 0}}, gaussian);
        Displacements ways;
        test::restOf(field, field.band(restBandVox(gaussian.voxelSize), Progress()),
                     gaussian.epsilon, options, 0.0, &ways);
        EXPECT_GT(ways.count, 100u);
        EXPECT_LT(ways.rms() * gaussian.voxelSize, 1e-4) << nameOf(regularizer);
    }
}

// One formula, and the flow that it stands for: less energy than after its steps.
TEST(ClosedForm, HasNoMoreEnergyThanTheFlowLeaves)
{
    for (const double lambda : {0.003, 0.01, 0.02}) {
        for (const Regularizer regularizer : {Regularizer::Gradient, Regularizer::Area}) {
            EvolveOptions options;
            options.lambda = lambda;
            options.regularizer = regularizer;
            const double voxel = 0.5;
            const std::vector<Ball> balls = test::balls("1a8o.cif.gz");
            GaussianOptions gaussian;
            gaussian.voxelSize = voxel;
            GaussianSum field(balls, gaussian);
            double energy[2];
            for (const Flow flow : {Flow::Rest, Flow::Newton}) {
                options.flow = flow;
                const test::Evolved out = test::evolveBalls(balls, 0.5, voxel, options);
                energy[flow == Flow::Newton] =
                    interfaceEnergy(out.band.phi, field, weightsOf(options), {}, Progress());
            }
            EXPECT_LT(energy[0], energy[1] * (1.0 + 1e-5)) << lambda << nameOf(regularizer);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, Rest,
                         testing::Combine(testing::Range(0, 3),
                                          testing::Values(Regularizer::Gradient, Regularizer::Area),
                                          testing::Values(0.01, 0.1, 1.0)),
                         [](const auto& info) {
                             const double lambda = std::get<2>(info.param);
                             return std::string(molecules[std::get<0>(info.param)].name) +
                                    nameOf(std::get<1>(info.param)) +
                                    (lambda < 0.05  ? "Small"
                                     : lambda < 0.5 ? "Medium"
                                                    : "Large");
                         });

} // namespace
} // namespace molsurf
