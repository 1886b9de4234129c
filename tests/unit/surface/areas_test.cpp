// SPDX-License-Identifier: MPL-2.0
// Areas by ball and contacts: closed forms, sampling, and sums that have to agree.

#include "molsurf/error.h"
#include "molsurf/surface.h"
#include "support/molecules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace molsurf::test
{
namespace
{

using openvdb::Vec3d;
using openvdb::Vec3f;

Ball ball(double x, double y, double z, double r)
{
    return {Vec3f(float(x), float(y), float(z)), float(r), 0};
}

double sum(const std::vector<double>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Point k of n, evenly spread over the unit sphere (Fibonacci's lattice).
Vec3d direction(int k, int n)
{
    const double z = 1.0 - (2.0 * k + 1.0) / n, turn = k * M_PI * (3.0 - std::sqrt(5.0));
    const double rim = std::sqrt(1.0 - z * z);
    return {rim * std::cos(turn), rim * std::sin(turn), z};
}

double sampledArea(const std::vector<Ball>& balls, std::size_t i, double probe, int n)
{
    const double r = double(balls[i].radius) + probe;
    std::vector<Ball> near;
    for (std::size_t j = 0; j < balls.size(); ++j) {
        const double reach = r + double(balls[j].radius) + probe;
        if (j != i && Vec3d(balls[j].center - balls[i].center).length() < reach)
            near.push_back(balls[j]);
    }
    int bare = 0;
    for (int k = 0; k < n; ++k) {
        const Vec3d x = Vec3d(balls[i].center) + r * direction(k, n);
        bare += std::none_of(near.begin(), near.end(), [&](const Ball& b) {
            return (x - Vec3d(b.center)).length() < double(b.radius) + probe;
        });
    }
    return 4.0 * M_PI * r * r * bare / n;
}

TEST(ExposedAreas, OneAndTwoBalls)
{
    EXPECT_TRUE(exposedAreas({}, 1.4).empty());
    EXPECT_NEAR(exposedAreas({ball(5, 6, 7, 1.5)}, 1.4)[0], 4 * M_PI * 2.9 * 2.9, 1e-5);
    const double r = 1.7 + 1.4, R = 1.5 + 1.4, d = 3.0;
    const auto areas = exposedAreas({ball(0, 0, 0, 1.7), ball(0, 0, d, 1.5)}, 1.4);
    const double h = (d * d + r * r - R * R) / (2 * d);
    EXPECT_NEAR(areas[0], 2 * M_PI * r * (r + h), 1e-5);
    EXPECT_NEAR(areas[1], 2 * M_PI * R * (R + d - h), 1e-5);
}

TEST(ExposedAreas, TheFirstOfEqualBallsHasTheArea)
{
    const auto areas =
        exposedAreas({ball(1, 2, 3, 1.0), ball(1, 2, 3, 2.0), ball(1, 2, 3, 2.0)}, 0.0);
    EXPECT_EQ(areas[0], 0.0);
    EXPECT_NEAR(areas[1], 16 * M_PI, 1e-6);
    EXPECT_EQ(areas[2], 0.0);
}

TEST(ExposedAreas, OfAProteinByPointsOnSpheres)
{
    const std::vector<Ball> atoms = balls("1crn.pdb");
    for (const double probe : {0.0, 1.4}) {
        const auto areas = exposedAreas(atoms, probe);
        double total = 0.0;
        constexpr int points = 100000;
        for (std::size_t i = 0; i < atoms.size(); ++i) {
            const double sampled = sampledArea(atoms, i, probe, points);
            total += sampled;
            EXPECT_NEAR(areas[i], sampled, 0.04) << i;
        }
        EXPECT_NEAR(sum(areas), total, 0.5);
    }
}

// The order of the balls is the caller's, though they are computed in another one.
TEST(ExposedAreas, FollowTheirBalls)
{
    std::vector<Ball> atoms = randomBalls(60, 9.0, Vec3d(3, -4, 5), 7);
    const auto areas = exposedAreas(atoms, 1.0);
    std::reverse(atoms.begin(), atoms.end());
    auto reversed = exposedAreas(atoms, 1.0);
    std::reverse(reversed.begin(), reversed.end());
    EXPECT_EQ(areas, reversed);
}

TEST(ExposedAreas, RefuseWhatIsNoBall)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const Ball& bad :
         {ball(0, 0, 0, -1.0), ball(0, 0, 0, 0.0), Ball{Vec3f(0, nan, 0), 1, 0}}) {
        EXPECT_THROW(exposedAreas({ball(9, 9, 9, 1), bad}, 1.4), Error);
        EXPECT_THROW(contactAreas({ball(9, 9, 9, 1), bad}, 1.4), Error);
    }
}

TEST(ContactAreas, TwoBallsShareADisk)
{
    EXPECT_TRUE(contactAreas({ball(0, 0, 0, 1.5), ball(0, 0, 6, 1.5)}, 1.4).empty());
    const double r = 1.7 + 1.4, R = 1.5 + 1.4, d = 4.0;
    const auto found = contactAreas({ball(0, 0, 0, 1.7), ball(0, d, 0, 1.5)}, 1.4);
    const double h = (d * d + r * r - R * R) / (2 * d);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].balls, (std::array<std::size_t, 2>{0, 1}));
    EXPECT_NEAR(found[0].area, M_PI * (r * r - h * h), 1e-5);
    EXPECT_NEAR(found[0].distance, d, 1e-6);
}

// The disk of two of them is cut along a line through the centre of the triangle, which is d / (2
// sqrt 3) from the disk's own.
TEST(ContactAreas, ThreeBallsOfAnEquilateralTriangle)
{
    const double r = 3.0, d = 3.2;
    const auto found = contactAreas(
        {ball(0, 0, 0, 1.6), ball(d, 0, 0, 1.6), ball(d / 2, d * std::sqrt(0.75), 0, 1.6)}, 1.4);
    const double rim = std::sqrt(r * r - d * d / 4), s = d / (2 * std::sqrt(3.0));
    const double area = rim * rim * (M_PI - std::acos(s / rim)) + s * std::sqrt(rim * rim - s * s);
    ASSERT_EQ(found.size(), 3u);
    for (const ContactArea& contact : found) EXPECT_NEAR(contact.area, area, 1e-4);
}

// Where the cells of many balls meet in an edge or a corner, rounding makes no contacts there.
TEST(ContactAreas, OfACubicLattice)
{
    std::vector<Ball> atoms;
    for (int i = 0; i < 27; ++i)
        atoms.push_back(ball(3.0 * (i % 3), 3.0 * (i / 3 % 3), 3.0 * (i / 9), 1.7));
    const auto found = contactAreas(atoms, 1.4);
    ASSERT_EQ(found.size(), 54u);
    for (const ContactArea& contact : found) EXPECT_NEAR(contact.distance, 3.0, 1e-5);
    const auto inside = [&](std::size_t i) { return i % 3 == 1 && i / 3 % 3 == 1; };
    for (const ContactArea& contact : found) {
        if (inside(contact.balls[0]) && contact.balls[1] == contact.balls[0] + 9) {
            EXPECT_NEAR(contact.area, 9.0, 1e-4);
        }
    }
}

// A facet by points: those of its disk whose power distance to no third ball is less.
TEST(ContactAreas, OfRandomBallsByPoints)
{
    const std::vector<Ball> atoms = randomBalls(40, 8.0, Vec3d(0.0), 11);
    const double probe = 0.7;
    const auto power = [&](std::size_t i, const Vec3d& x) {
        const double r = double(atoms[i].radius) + probe;
        return (x - Vec3d(atoms[i].center)).lengthSqr() - r * r;
    };
    std::size_t seen = 0;
    for (const ContactArea& contact : contactAreas(atoms, probe)) {
        const auto [i, j] = contact.balls;
        const Vec3d a(atoms[i].center), axis = (Vec3d(atoms[j].center) - a).unit();
        const Vec3d e1 =
            axis.cross(std::abs(axis.x()) < 0.6 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0)).unit();
        const Vec3d e2 = axis.cross(e1);
        const double r = double(atoms[i].radius) + probe, R = double(atoms[j].radius) + probe;
        const double d = contact.distance, away = (d * d + r * r - R * R) / (2 * d);
        const double rim = std::sqrt(std::max(0.0, r * r - away * away));
        constexpr int n = 4000;
        int inside = 0;
        for (int k = 0; k < n; ++k) {
            const double out = rim * std::sqrt((k + 0.5) / n), turn = 2.399963229728653 * k;
            const Vec3d x = a + away * axis + out * (std::cos(turn) * e1 + std::sin(turn) * e2);
            bool own = true;
            for (std::size_t m = 0; m < atoms.size(); ++m)
                own = own && (m == i || m == j || power(m, x) >= power(i, x));
            inside += own;
        }
        EXPECT_NEAR(contact.area, M_PI * rim * rim * inside / n, 0.02 * M_PI * rim * rim);
        ++seen;
    }
    EXPECT_GT(seen, 60u);
}

BallSet groupsOfTwo(const std::vector<Ball>& all)
{
    BallSet atoms;
    atoms.balls = all;
    BallLabels& labels = atoms.labels.emplace();
    labels.chains = {"A", "B"};
    labels.groups = {{"left", 0, {}}, {"right", 0, {}}};
    for (const Ball& b : all) {
        labels.chainOf.push_back(b.center.x() > 0 ? 1 : 0);
        labels.groupOf.push_back(b.center.x() > 0 ? 1 : 0);
        ++labels.groups[std::size_t(labels.groupOf.back())].balls;
        labels.elementOf.push_back(6);
        labels.residueClassOf.push_back(ResidueClass::Other);
    }
    return atoms;
}

TEST(BallAreas, AddUpToTheAreaOfEveryKind)
{
    const std::vector<Ball> all = randomBalls(50, 10.0, Vec3d(0.0), 3);
    for (const SurfaceKind kind :
         {SurfaceKind::SolventAccessible, SurfaceKind::VanDerWaals, SurfaceKind::SolventExcluded,
          SurfaceKind::Variational, SurfaceKind::Gaussian}) {
        SurfaceOptions options;
        options.kind = kind;
        options.ballAreas = true;
        const MolecularSurface made = makeSurface(groupsOfTwo(all), options);
        ASSERT_EQ(made.ballAreas.size(), all.size());
        EXPECT_NEAR(sum(made.ballAreas), made.report.surface.area, 1e-9) << nameOf(kind);
        for (const Report::Group& group : made.report.groups) {
            double own = 0.0;
            for (std::size_t i = 0; i < all.size(); ++i)
                own += (all[i].center.x() > 0) == (group.name == "right") ? made.ballAreas[i] : 0.0;
            EXPECT_NEAR(own, group.area, 0.02 * group.area) << nameOf(kind);
        }
    }
}

void expectSameWithoutGrid(SurfaceKind kind)
{
    const std::vector<Ball> all = balls("1crn.pdb");
    SurfaceOptions options;
    options.kind = kind;
    options.ballAreas = options.contacts = true;
    const MolecularSurface meshed = makeSurface(groupsOfTwo(all), options);
    options.grid = false;
    const MolecularSurface bare = makeSurface(groupsOfTwo(all), options);
    EXPECT_FALSE(bare.surface);
    EXPECT_EQ(bare.mesh.positions.size(), 0u);
    EXPECT_EQ(bare.report.voxel, options.voxel);
    EXPECT_NEAR(bare.report.surface.area, meshed.report.surface.area, 1e-9);
    EXPECT_NEAR(bare.report.surface.volume, meshed.report.surface.volume, 1e-8);
    EXPECT_EQ(bare.report.surface.eulerCharacteristic, meshed.report.surface.eulerCharacteristic);
    EXPECT_EQ(bare.report.surface.cavities.size(), meshed.report.surface.cavities.size());
    EXPECT_EQ(bare.contacts.size(), meshed.contacts.size());
    ASSERT_EQ(bare.report.groups.size(), 2u);
    for (int g : {0, 1})
        EXPECT_NEAR(bare.report.groups[g].area, meshed.report.groups[g].area, 1e-9);
    for (std::size_t i = 0; i < all.size(); ++i)
        EXPECT_NEAR(bare.ballAreas[i], meshed.ballAreas[i], 1e-9);
    EXPECT_FALSE(bare.report.surface.meshArea);
    EXPECT_EQ(bare.report.surface.cuspLength, meshed.report.surface.cuspLength);
    ASSERT_TRUE(meshed.report.surface.meshArea && meshed.report.surface.meshVolume);
    EXPECT_NEAR(*meshed.report.surface.meshArea, bare.report.surface.area,
                0.1 * bare.report.surface.area);
}

TEST(BallAreas, WithoutAGridAreThoseWithOne)
{
    for (const SurfaceKind kind :
         {SurfaceKind::SolventAccessible, SurfaceKind::VanDerWaals, SurfaceKind::SolventExcluded}) {
        SCOPED_TRACE(nameOf(kind));
        expectSameWithoutGrid(kind);
    }
    SurfaceOptions options;
    options.kind = SurfaceKind::Gaussian;
    options.grid = false;
    EXPECT_THROW(makeSurface(groupsOfTwo(balls("1crn.pdb")), options), Error);
}

// Half of what the balls lose is the interface.
TEST(BallAreas, OfAnInterface)
{
    const std::vector<Ball> all = randomBalls(60, 9.0, Vec3d(0.0), 5);
    SurfaceOptions options;
    options.ballAreas = options.interfaces = true;
    for (const SurfaceKind kind : {SurfaceKind::SolventAccessible, SurfaceKind::SolventExcluded}) {
        options.kind = kind;
        const MolecularSurface made = makeSurface(groupsOfTwo(all), options);
        ASSERT_EQ(made.report.interfaces.size(), 1u);
        const Report::Interface& interface = made.report.interfaces[0];
        double lost = 0.0;
        for (const Report::Interface::Buried& b : interface.buried) {
            EXPECT_EQ(b.ofFirst, all[b.ball].center.x() <= 0);
            lost += 0.5 * (b.alone - b.together);
        }
        const bool exact = kind == SurfaceKind::SolventAccessible;
        EXPECT_NEAR(lost, interface.area, exact ? 1e-9 : 0.2);
        EXPECT_GT(interface.area, 20.0);
        EXPECT_LT(interface.buried.size(), all.size());
    }
}

// Where a probe rolls about two balls on a circle smaller than itself, its paths meet in a cusp.
TEST(Areas, TheCuspOfTwoBallsIsTheCircleOfTheProbe)
{
    SurfaceOptions options;
    options.kind = SurfaceKind::SolventExcluded;
    options.grid = false;
    const double radius = 1.7, R = radius + options.probe;
    for (const double apart : {5.8, 5.0}) {
        const auto report =
            makeSurface({{{0.1, 0.2, 0.3}, radius, 0}, {{0.1, 0.2, 0.3 + apart}, radius, 1}},
                        options)
                .report.surface;
        const double circle = std::sqrt(R * R - 0.25 * apart * apart);
        ASSERT_TRUE(report.cuspLength);
        EXPECT_NEAR(*report.cuspLength, circle < options.probe ? 2.0 * M_PI * circle : 0.0, 1e-6)
            << apart;
    }
}

} // namespace
} // namespace molsurf::test
