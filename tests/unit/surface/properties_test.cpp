// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/pipeline/surface_kind.h"
#include "support/runs.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;
using openvdb::Vec3f;

/// A thousand small molecules, of every kind of place and surface.
constexpr unsigned molecules = 1000;

constexpr SurfaceKind kinds[] = {SurfaceKind::Variational, SurfaceKind::SolventExcluded,
                                 SurfaceKind::SolventAccessible, SurfaceKind::VanDerWaals,
                                 SurfaceKind::Gaussian};

struct Molecule {
    std::vector<Ball> balls;
    SurfaceOptions options;
    std::mt19937 random;

    explicit Molecule(unsigned seed) : random(seed)
    {
        options.kind = kinds[seed % 5];
        options.voxel = seed % 3 == 0 ? 0.4 : seed % 3 == 1 ? 0.5 : 0.75;
        const int places = seed / 5 % 4; // anywhere, on a lattice, in a plane, on a line
        const int count = 1 + int(random() % 12);
        std::uniform_real_distribution<double> place(-3.5, 3.5), radius(1.1, 2.0);
        for (int i = 0; i < count; ++i) {
            Vec3d x{place(random), place(random), place(random)};
            if (places == 1) x = Vec3d(std::round(x[0]), std::round(x[1]), std::round(x[2]));
            if (places >= 2) x[2] = 0.0;
            if (places == 3) x[1] = 0.5 * x[0];
            // Multiples of 2^-12 Å, so that shifts are exact.
            for (int axis = 0; axis < 3; ++axis) x[axis] = std::round(4096.0 * x[axis]) / 4096.0;
            balls.push_back({Vec3f(x), places == 1 ? 1.5f : float(radius(random)), i});
        }
    }
};

/// Areas and volumes of `a` and `b` are the same to a share of theirs.
void expectSame(const SurfaceReport& a, const SurfaceReport& b, double bound, unsigned seed)
{
    EXPECT_NEAR(a.area / b.area, 1.0, bound) << seed;
    EXPECT_NEAR(a.volume / b.volume, 1.0, bound) << seed;
}

void expectSameBits(const MolecularSurface& a, const MolecularSurface& b, unsigned seed)
{
    EXPECT_EQ(a.report.surface.area, b.report.surface.area) << seed;
    EXPECT_EQ(a.report.surface.volume, b.report.surface.volume) << seed;
    EXPECT_EQ(a.mesh.triangles, b.mesh.triangles) << seed;
    EXPECT_TRUE(a.mesh.positions == b.mesh.positions) << seed;
}

std::vector<Ball> moved(std::vector<Ball> balls, const Vec3d& by)
{
    for (Ball& ball : balls) ball.center = Vec3f(Vec3d(ball.center) + by);
    return balls;
}

/// Runs of every `step`-th molecule.
template<typename Check>
void forEachMolecule(unsigned first, unsigned step, const Check& check)
{
    for (unsigned seed = first; seed < molecules; seed += step) check(seed, Molecule(seed));
}

// Each edge belongs to two triangles that pass it in opposite ways; V - E + F is the report's, and
// so is what the triangles enclose, but for the caps between them and the surface: h^2/8 kappa
// thick.
TEST(Properties, MeshIsClosedAndIsTheReports)
{
    forEachMolecule(0, 1, [](unsigned seed, const Molecule& m) {
        const MolecularSurface result = test::runOn(m.balls, m.options);
        const SurfaceReport& surface = result.report.surface;
        ASSERT_TRUE(surface.closed && surface.manifold) << seed;
        std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
        double volume = 0.0;
        for (const auto& t : result.mesh.triangles) {
            for (int i = 0; i < 3; ++i)
                ASSERT_TRUE(edges.insert({t[i], t[(i + 1) % 3]}).second) << seed;
            const auto corner = [&](int i) { return Vec3d(result.mesh.positions[t[i]]); };
            volume += corner(0).dot(corner(1).cross(corner(2))) / 6.0;
        }
        for (const auto& [from, to] : edges) ASSERT_EQ(edges.count({to, from}), 1u) << seed;
        const long euler = long(result.mesh.positions.size()) - long(edges.size()) / 2 +
                           long(result.mesh.triangles.size());
        if (!isClosedForm(m.options)) { // which knows gaps that no mesh of these voxels shows
            EXPECT_EQ(euler, surface.eulerCharacteristic) << seed;
        }
        const double h = m.options.voxel;
        EXPECT_NEAR(volume, surface.volume, surface.area * h * h / 8.0) << seed;
    });
}

TEST(Properties, OrderAndThreadsDoNotChangeABit)
{
    forEachMolecule(1, 7, [](unsigned seed, Molecule m) {
        const MolecularSurface result = test::runOn(m.balls, m.options);
        std::shuffle(m.balls.begin(), m.balls.end(), m.random);
        {
            const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
            expectSameBits(result, test::runOn(m.balls, m.options), seed);
        }
        const tbb::global_control four(tbb::global_control::max_allowed_parallelism, 4);
        expectSameBits(result, test::runOn(m.balls, m.options), seed);
    });
}

// Bits of places, and where leaves begin, enter by rounding alone. Here and there it decides which
// of two ways a vertex takes, at a crease of a symmetric molecule also which sides a cell has.
TEST(Properties, AShiftByWholeVoxelsIsLostInRounding)
{
    std::vector<double> changes, variational;
    forEachMolecule(2, 5, [&](unsigned seed, Molecule m) {
        m.options.kind = kinds[seed / 5 % 5];
        m.options.voxel = 0.5;
        const SurfaceReport at = test::runOn(m.balls, m.options).report.surface;
        std::uniform_int_distribution<int> voxels(-40, 40);
        const Vec3d by = 0.5 * Vec3d(voxels(m.random), voxels(m.random), voxels(m.random));
        const SurfaceReport there = test::runOn(moved(m.balls, by), m.options).report.surface;
        expectSame(at, there, isClosedForm(m.options) ? 1e-9 : 2e-3, seed);
        if (isClosedForm(m.options)) return;
        changes.push_back(std::abs(at.area / there.area - 1.0));
        if (hasFlow(m.options.kind)) variational.push_back(changes.back());
    });
    std::sort(changes.begin(), changes.end());
    EXPECT_LT(changes[changes.size() / 2], 1e-5);
    EXPECT_LT(changes[changes.size() * 95 / 100], 2e-4);
    // Rounding of psi shows in its second differences, and these in the level at rest.
    EXPECT_LT(*std::max_element(variational.begin(), variational.end()), 2e-4);
}

// Where the molecule lies against the voxels changes what is measured on a mesh.
TEST(Properties, AnyShiftStaysWithinTheVoxelsError)
{
    forEachMolecule(3, 5, [](unsigned seed, Molecule m) {
        m.options.kind = kinds[seed / 5 % 5];
        const SurfaceReport at = test::runOn(m.balls, m.options).report.surface;
        std::uniform_real_distribution<double> way(-20.0, 20.0);
        const Vec3d by(way(m.random), way(m.random), way(m.random));
        const SurfaceReport there = test::runOn(moved(m.balls, by), m.options).report.surface;
        const double h = m.options.voxel;
        expectSame(at, there, isClosedForm(m.options) ? 1e-5 : 0.05 * h * h, seed);
    });
}

// But for the variational surface, whose ridges are rounded and walls opened by lengths in Å.
TEST(Properties, LengthsScale)
{
    forEachMolecule(4, 13, [](unsigned seed, Molecule m) {
        m.options.evolution.steps = 4; // the tolerance of rest depends on the voxel in Å
        const double bound = m.options.kind == SurfaceKind::Variational ? 0.015 : 1e-4;
        const SurfaceReport small = test::runOn(m.balls, m.options).report.surface;
        m.options.voxel *= 2.0;
        m.options.probe *= 2.0;
        m.options.epsilon *= 2.0;
        m.options.evolution.lambda *= 4.0;
        for (Ball& ball : m.balls) {
            ball.center *= 2.0f;
            ball.radius *= 2.0f;
        }
        const SurfaceReport large = test::runOn(m.balls, m.options).report.surface;
        EXPECT_NEAR(large.area / small.area, 4.0, 4.0 * bound) << seed;
        EXPECT_NEAR(large.volume / small.volume, 8.0, 8.0 * bound) << seed;
    });
}

TEST(Properties, AnAtomFarAwayAddsItsOwnSurface)
{
    forEachMolecule(5, 11, [](unsigned seed, Molecule m) {
        const Ball far{Vec3f(37.3f, -41.1f, 29.7f), 1.7f, 99};
        const SurfaceReport own = test::runOn({far}, m.options).report.surface;
        const SurfaceReport alone = test::runOn(m.balls, m.options).report.surface;
        m.balls.push_back(far);
        const SurfaceReport both = test::runOn(m.balls, m.options).report.surface;
        EXPECT_NEAR(both.area / (alone.area + own.area), 1.0, 3e-5) << seed;
        EXPECT_NEAR(both.volume / (alone.volume + own.volume), 1.0, 3e-5) << seed;
        EXPECT_EQ(both.components, alone.components + 1) << seed;
    });
}

} // namespace
} // namespace molsurf
