// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/flow/newton_step.h"

#include "molsurf/kernel/levelset/gaussian_sum.h"

#include <gtest/gtest.h>

#include <cmath>

namespace molsurf
{
namespace
{

constexpr float h = 0.5f;

float extended(float u, float lastU, float lastStep)
{
    return extendedStep(u, lastU, lastStep, h);
}

// What is solved for is a share of the way to rest, the same in every step: then the next step is
// all that is left, however far the one before went.
TEST(ExtendedStep, GoesToRestWhereDisplacementsAreAShareOfTheWay)
{
    for (const float sign : {1.0f, -1.0f}) {
        for (const float share : {0.4f, 0.6f, 0.9f}) {
            const float way = 0.2f * sign, lastU = share * way;
            for (const float lastStep : {0.5f * way, 0.7f * way}) {
                const float left = way - lastStep;
                EXPECT_NEAR(extended(share * left, lastU, lastStep), left, 1e-5f) << share;
            }
        }
    }
}

TEST(ExtendedStep, IsTheDisplacementWhereThatTurnsOrIsShort)
{
    EXPECT_FLOAT_EQ(extended(-0.05f, 0.06f, 0.06f), -0.05f);
    EXPECT_FLOAT_EQ(extended(0.05f, 0.0f, 0.0f), 0.05f); // the first step
    EXPECT_FLOAT_EQ(extended(0.005f, 0.02f, 0.02f), 0.005f);
}

TEST(ExtendedStep, HasItsLimits)
{
    EXPECT_FLOAT_EQ(extended(0.013f, 0.0131f, 0.013f), 3.0f * 0.013f);
    EXPECT_FLOAT_EQ(extended(0.05f, 0.051f, 0.05f), 5.0f * 0.05f);
}

// Rest lies between two places where displacements have opposite signs: steps become shorter until
// they have one sign, and then longer again, but never longer than whole.
TEST(ShareOfStep, FallsWhereDisplacementsAlternate)
{
    float share = 1.0f, sign = 1.0f;
    for (const float expected : {0.5f, 0.25f, 0.125f, 0.1f, 0.1f}) {
        share = shareOfStep(-0.1f * sign, sign * share);
        EXPECT_FLOAT_EQ(share, expected);
        sign = -sign;
    }
    for (const float expected : {0.12f, 0.144f}) {
        share = shareOfStep(0.1f * sign, sign * share);
        EXPECT_FLOAT_EQ(share, expected);
    }
    EXPECT_FLOAT_EQ(shareOfStep(0.1f, 0.9f), 1.0f);
    EXPECT_FLOAT_EQ(shareOfStep(0.1f, 0.0f), 1.0f); // the first step
}

/// A ball of the flow's field, and the sphere about it that the interface is.
struct SphereCase {
    double R;      ///< of the ball, grown by the probe [Å]
    double radius; ///< of the interface [Å]
    double lambda; ///< of the area
    double slope;  ///< of phi
};

// About one ball the step is the same everywhere, and known: psi = C (R^2 - r^2). The first sweep
// makes it F / (P + 6 w / h^2), and all of the band moves by it, whatever its feet have about them,
// by no more than the slope.
void expectStep(const SphereCase& c)
{
    constexpr double h = 0.5, leastStiffness = 0.1;
    const openvdb::Vec3d centre(0.13, -0.29, 0.44);
    GaussianOptions gaussian;
    GaussianSum field({{openvdb::Vec3f(centre), float(c.R - gaussian.probe), 0}}, gaussian);
    Progress progress;
    NarrowBand band;
    band.phi = field.band(2 * bandWidthVox, progress); // with leaves beside the sphere's
    band.psi = copied(band.phi.values);
    SparseField& phi = band.phi;
    for (std::size_t n = 0; n < phi.table.size(); ++n) {
        for (int v = 0; v < leafSize; ++v) {
            const openvdb::Coord x = phi.table.origin(n) + openvdb::Coord(v / 64, v / 8 % 8, v % 8);
            phi.leaf(n)[v] = float(c.slope * ((h * x.asVec3d() - centre).length() - c.radius));
        }
        phi.table.active(n) = within(phi.leaf(n), float(2.0 * h));
    }
    NewtonSteps newton({Weights{0.0f, float(c.lambda)}, 1, false, 0});
    LeafField before;
    newton.step(band, {}, before, progress);

    const double r = c.radius, C = M_LN2 / (0.5 * c.R), psi = C * (c.R * c.R - r * r);
    const double e = std::exp(psi), g = 1.0 - e, steep = 2.0 * C * r, w = g * g + c.lambda;
    const double F = 2.0 * w / r + 2.0 * g * e * steep;
    const double valley = 2.0 * steep * steep * e;
    const double secant = (e - 1.0) / psi, tangent = std::min(2.0 * e - 1.0, secant);
    const double stiffness = valley * (F < 0.0 ? tangent : secant);
    const double bend = 6.0 * w / (r * r);
    const double u = F / (stiffness - bend + leastStiffness + 6.0 * w / (h * h));
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t n = 0; n < phi.table.size(); ++n) {
        phi.table.active(n).forEach([&](int v) {
            const double share =
                double(phi.leaf(n)[v] - before.leaf(n)[v]) / (std::min(c.slope, 1.0) * u);
            EXPECT_NEAR(share, 1.0, 0.1) << "at " << before.leaf(n)[v] / c.slope / h << " voxels";
            sum += share;
            ++count;
        });
    }
    EXPECT_NEAR(sum / double(count), 1.0, 0.013);
}

TEST(NewtonStep, OfABallIsThatOfItsFormula)
{
    for (const double slope : {1.0, 1.1, 0.9}) {
        expectStep({3.1, 3.0, 0.03, slope});
        expectStep({3.1, 3.2, 0.03, slope});
        expectStep({2.3, 2.35, 3.0, slope});
    }
}

} // namespace
} // namespace molsurf
