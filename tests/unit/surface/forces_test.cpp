// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface.h"

#include "molsurf/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;
using openvdb::Vec3f;

BallSet sixBalls()
{
    BallSet atoms;
    const float rows[][4] = {{0, 0, 0, 1.7f},          {2.25f, 0.5f, 0.25f, 1.5f},
                             {1, 2.5f, -0.5f, 1.625f}, {-1, 1.5f, 2, 1.25f},
                             {3.5f, 2, 1.5f, 1.75f},   {0.5f, 4.5f, 1.5f, 1.5f}};
    for (const auto& r : rows)
        atoms.balls.push_back({Vec3f(r[0], r[1], r[2]), r[3], int(atoms.balls.size())});
    return atoms;
}

MolecularSurface made(const BallSet& atoms, const SurfaceSpec& spec)
{
    SurfaceOptions options;
    static_cast<SurfaceSpec&>(options) = spec;
    return makeSurface(atoms, options);
}

MolecularSurface::Gradients gradientsOf(const BallSet& atoms, const SurfaceSpec& spec)
{
    return surfaceGradients(atoms, spec, made(atoms, spec).mesh);
}

double rmsOf(const std::vector<Vec3d>& gradients)
{
    double squares = 0.0;
    for (const Vec3d& g : gradients) squares += g.lengthSqr();
    return std::sqrt(squares / double(3 * gradients.size()));
}

/// Holds the derivatives by one coordinate of each of two balls against differences of 0.05 Å.
void expectDifferences(const BallSet& atoms, const SurfaceSpec& spec, double tolerance)
{
    const MolecularSurface::Gradients found = gradientsOf(atoms, spec);
    for (const auto& [ball, axis] : {std::pair(2, 1), {4, 2}}) {
        double area[2], volume[2];
        for (int side = 0; side < 2; ++side) {
            BallSet moved = atoms;
            moved.balls[std::size_t(ball)].center[axis] += side == 0 ? -0.05f : 0.05f;
            const SurfaceReport report = made(moved, spec).report.surface;
            area[side] = report.area;
            volume[side] = report.volume;
        }
        const std::string where = std::string(1, char('x' + axis)) + std::to_string(ball);
        EXPECT_NEAR(found.area[std::size_t(ball)][axis], (area[1] - area[0]) / 0.1,
                    tolerance * rmsOf(found.area))
            << where;
        EXPECT_NEAR(found.volume[std::size_t(ball)][axis], (volume[1] - volume[0]) / 0.1,
                    tolerance * rmsOf(found.volume))
            << where;
    }
}

TEST(SmoothForces, AreDifferences)
{
    for (const SurfaceKind kind : {SurfaceKind::Variational, SurfaceKind::SmoothAccessible}) {
        SurfaceSpec spec;
        spec.kind = kind;
        spec.voxel = 0.25;
        SCOPED_TRACE(int(kind));
        expectDifferences(sixBalls(), spec, 0.01);
    }
}

// lambda moves the level of psi by a quarter of it here, and the level depends on the balls.
TEST(SmoothForces, FollowTheLevelAtRest)
{
    SurfaceSpec spec;
    spec.voxel = 0.25;
    spec.epsilon = 0.25;
    spec.evolution.lambda = 0.01;
    expectDifferences(sixBalls(), spec, 0.01);
    spec.epsilon = 0.5;
    spec.evolution.regularizer = Regularizer::Area;
    spec.evolution.lambda = 0.005;
    expectDifferences(sixBalls(), spec, 0.01);
}

TEST(SmoothForces, FollowResolutions)
{
    BallSet atoms = sixBalls();
    atoms.decays.resize(atoms.balls.size());
    for (std::size_t i = 0; i < 3; ++i) atoms.decays[i].rate = 0.4f;
    SurfaceSpec spec;
    spec.voxel = 0.25;
    expectDifferences(atoms, spec, 0.02);
}

TEST(SmoothForces, AddUpToNothing)
{
    SurfaceSpec spec;
    const MolecularSurface::Gradients found = gradientsOf(sixBalls(), spec);
    for (const auto* gradients : {&found.area, &found.volume}) {
        Vec3d sum(0.0);
        double lengths = 0.0;
        for (const Vec3d& g : *gradients) {
            sum += g;
            lengths += g.length();
        }
        EXPECT_GT(lengths, 10.0);
        EXPECT_LT(sum.length(), 1e-9 * lengths);
    }
}

TEST(SmoothForces, AreRefusedWhereNothingKnowsThem)
{
    SurfaceSpec fronts, walls, filled, gaussian;
    gaussian.kind = SurfaceKind::Gaussian;
    fronts.evolution.lambda = 0.1;
    walls.minWall = 2.0;
    filled.kind = SurfaceKind::SolventExcluded;
    filled.fillCavities = true;
    for (const SurfaceSpec& spec : {fronts, walls, filled, gaussian}) {
        try {
            surfaceGradients(sixBalls(), spec, Mesh());
            ADD_FAILURE();
        } catch (const Error& e) {
            EXPECT_EQ(e.kind(), ErrorKind::Usage);
        }
    }
    BallSet unit = sixBalls(); // whose neighbours are its images
    unit.placement.instances.resize(2);
    EXPECT_THROW(surfaceGradients(unit, {}, Mesh()), Error);
}

} // namespace
} // namespace molsurf
