// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/boundary_measure.h"
#include "support/molecules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;
using openvdb::Vec3f;

Ball ballAt(double x, double y, double z, double r)
{
    return {Vec3f(float(x), float(y), float(z)), float(r), 0};
}

struct Totals {
    double area = 0.0, volume = 0.0;
    int euler = 0, outer = 0, cavities = 0;
};

Totals measured(const std::vector<Ball>& balls, double probe = 0.0)
{
    Totals t;
    for (const BoundaryPiece& piece :
         measureBoundary(ballBoundary(balls, probe, Progress()), Progress()).pieces) {
        t.area += piece.area;
        t.volume += piece.volume;
        t.euler += piece.eulerCharacteristic;
        ++(piece.outer ? t.outer : t.cavities);
    }
    return t;
}

/// Spread evenly, and turned, so that points do not lie on symmetry planes.
std::vector<Vec3d> spreadDirections(int count)
{
    std::vector<Vec3d> out;
    for (int k = 0; k < count; ++k) {
        const double z = 1.0 - (2.0 * k + 1.0) / count, a = k * M_PI * (3.0 - std::sqrt(5.0));
        const double s = std::sqrt(1.0 - z * z), x = s * std::cos(a), y = s * std::sin(a);
        out.emplace_back(0.48 * x + 0.6 * y + 0.64 * z, -0.8 * x + 0.6 * z,
                         0.36 * x - 0.8 * y + 0.48 * z);
    }
    return out;
}

/// Area and volume by points in `directions` on every sphere. A point on several spheres counts for
/// the first of equal balls.
Totals sampled(const std::vector<Ball>& all, double probe, const std::vector<Vec3d>& directions)
{
    std::vector<Ball> balls;
    for (const Ball& b : all) {
        if (std::none_of(balls.begin(), balls.end(), [&](const Ball& o) {
                return o.center == b.center && o.radius == b.radius;
            }))
            balls.push_back(b);
    }
    const Vec3d origin(balls[0].center);
    Totals t;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const double R = balls[i].radius + probe;
        const Vec3d c(balls[i].center);
        std::vector<std::array<double, 4>> near; // offset, and the height of the plane
        for (std::size_t j = 0; j < balls.size(); ++j) {
            const Vec3d way = Vec3d(balls[j].center) - c;
            const double other = balls[j].radius + probe, d2 = way.lengthSqr();
            if (j == i || d2 >= (R + other) * (R + other)) continue;
            near.push_back({way.x(), way.y(), way.z(), 0.5 * (d2 + R * R - other * other)});
        }
        for (const Vec3d& u : directions) {
            const bool covered = std::any_of(near.begin(), near.end(), [&](const auto& n) {
                return R * (u.x() * n[0] + u.y() * n[1] + u.z() * n[2]) > n[3];
            });
            if (covered) continue;
            const double dA = 4.0 * M_PI * R * R / double(directions.size());
            t.area += dA;
            t.volume += dA * (c - origin + R * u).dot(u) / 3.0;
        }
    }
    return t;
}

// Table of molecules that have closed forms, or were sampled with 10^5 points a ball.
TEST(SpecialPositions, KnownAreas)
{
    std::vector<Ball> hexagon, square, lattice, salt, doublet;
    for (int k = 0; k < 6; ++k) {
        const double a = k * M_PI / 3.0;
        hexagon.push_back(ballAt(1.42 * std::cos(a), 1.42 * std::sin(a), 0.0, 1.7));
    }
    for (int k = 0; k < 4; ++k) square.push_back(ballAt(2 * (k & 1), 2 * (k >> 1), 0.0, 1.5));
    for (int k = 0; k < 64; ++k) {
        lattice.push_back(ballAt(2 * (k & 3), 2 * (k >> 2 & 3), 2 * (k >> 4), 1.5));
    }
    for (int k = 0; k < 27; ++k) {
        salt.push_back(ballAt(2.8 * (k % 3), 2.8 * (k / 3 % 3), 2.8 * (k / 9), 1.7));
    }
    const std::vector<Ball> three = {ballAt(4, 3, -1, 1.5), ballAt(1, 4, -2, 2.5),
                                     ballAt(2, 2, -3, 1.5)};
    const struct {
        const char* what;
        std::vector<Ball> balls;
        double probe, area, volume;
        int euler, outer, cavities;
    } cases[] = {
        {"hexagon, sas", hexagon, 1.4, 214.5101, 282.7616, 2, 1, 0},
        {"hexagon, vdw", hexagon, 0.0, 93.5, 73.1, 2, 1, 0},
        {"square, sas", square, 1.4, 186.9, 225.9, 2, 1, 0},
        {"square, vdw", square, 0.0, 75.8537, 48.1867, 2, 1, 0},
        {"three, vdw", three, 0.0, 109.7, 86.6, 2, 1, 0},
        {"lattice, vdw", lattice, 0.0, 501.5809, 604.8684, 56, 1, 27},
        {"rock salt, sas", salt, 1.4, 651.2117, 1314.6262, 2, 1, 0},
    };
    for (const auto& c : cases) {
        const Totals got = measured(c.balls, c.probe);
        EXPECT_NEAR(got.area, c.area, 1e-3 * c.area) << c.what;
        EXPECT_NEAR(got.volume, c.volume, 1e-3 * c.volume) << c.what;
        EXPECT_EQ(got.euler, c.euler) << c.what;
        EXPECT_EQ(got.outer, c.outer) << c.what;
        EXPECT_EQ(got.cavities, c.cavities) << c.what;
        const Totals points = sampled(c.balls, c.probe, spreadDirections(100000));
        EXPECT_NEAR(got.area, points.area, 1e-3 * c.area) << c.what;
        EXPECT_NEAR(got.volume, points.volume, 1e-3 * c.volume) << c.what;
    }
}

// Three spheres share one circle (sides 3, 4, 5), spheres through another's centre, spheres that
// touch from outside and inside.
TEST(SpecialPositions, CirclesInCommonAndTouching)
{
    const std::vector<Ball> pencil = {ballAt(-1, 0, 0, 1.25), ballAt(0, 0, 0, 0.75),
                                      ballAt(1, 0, 0, 1.25)};
    const Totals shared = measured(pencil);
    const double h = 1.25 - 1.0; // of the caps of the outer two beyond the common plane
    EXPECT_NEAR(shared.area, 2.0 * (4.0 * M_PI * 1.25 * 1.25 - 2.0 * M_PI * 1.25 * h), 1e-7);
    EXPECT_EQ(shared.outer, 1);

    const std::vector<Ball> through = {ballAt(0, 0, 0, 1.5), ballAt(1.5, 0, 0, 1.5),
                                       ballAt(0, 1.5, 0, 1.5), ballAt(0, 0, 1.5, 1.5)};
    EXPECT_NEAR(measured(through).area, sampled(through, 0.0, spreadDirections(100000)).area, 0.05);

    const std::vector<Ball> outside = {ballAt(0, 0, 0, 1.5), ballAt(3, 0, 0, 1.5),
                                       ballAt(0, 3, 0, 1.5)};
    const Totals apart = measured(outside);
    EXPECT_NEAR(apart.area, 3.0 * 4.0 * M_PI * 2.25, 1e-6);
    EXPECT_EQ(apart.outer, 3) << "balls that touch are apart";

    const std::vector<Ball> inside = {ballAt(0, 0, 0, 2.0), ballAt(1, 0, 0, 1.0),
                                      ballAt(0, 0.5, 0, 1.5)};
    const Totals one = measured(inside);
    EXPECT_NEAR(one.area, 4.0 * M_PI * 4.0, 1e-6);
    EXPECT_NEAR(one.volume, 4.0 / 3.0 * M_PI * 8.0, 1e-6);
    EXPECT_EQ(one.outer, 1);

    const std::vector<Ball> nothing = {ballAt(0, 0, 0, 1.0), ballAt(0, 0, 0, 1.0),
                                       ballAt(0, 0, 0, 1.0)};
    EXPECT_NEAR(measured(nothing).area, 4.0 * M_PI, 1e-7);
}

using Random = std::mt19937;

double uniform(Random& random, double low, double high)
{
    return std::uniform_real_distribution<double>(low, high)(random);
}

/// Some balls, each copied about the z axis; one may lie on it.
std::vector<Ball> ring(Random& random, int fold)
{
    std::vector<Ball> out;
    for (int b = 0; b < 12 / fold + 1; ++b) {
        const double r = uniform(random, 0.5, 3.0), phase = uniform(random, 0.0, 6.3);
        const double z = uniform(random, -2.0, 2.0), radius = uniform(random, 1.2, 2.0);
        for (int k = 0; k < fold; ++k) {
            const double a = 2.0 * M_PI * k / fold;
            const double x = r * std::cos(phase), y = r * std::sin(phase);
            // Exact operators where there are any.
            const double c = fold == 4 || fold == 2 ? std::round(std::cos(a)) : std::cos(a);
            const double s = fold == 4 || fold == 2 ? std::round(std::sin(a)) : std::sin(a);
            out.push_back(
                ballAt(c * float(x) - s * float(y), s * float(x) + c * float(y), z, radius));
        }
    }
    if (random() % 2) out.push_back(ballAt(0, 0, uniform(random, -3.0, 3.0), 1.5));
    return out;
}

std::vector<Ball> onLattice(Random& random, double step)
{
    const float radii[] = {1.5f, 1.7f, 2.0f, 2.5f};
    const int span = int(4.0 / step);
    std::vector<Ball> out;
    const auto at = [&] { return step * double(random() % unsigned(span)); };
    for (int b = 0; b < 12; ++b) out.push_back(ballAt(at(), at(), at(), radii[random() % 4]));
    return out;
}

/// Each ball touches an earlier one.
std::vector<Ball> touching(Random& random)
{
    std::vector<Ball> out = {ballAt(0, 0, 0, 1.5)};
    const double ways[][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.6, 0.8, 0}, {0, -0.6, 0.8}};
    while (out.size() < 10) {
        const Ball from = out[random() % out.size()];
        const double* way = ways[random() % 5];
        const double sign = random() % 2 ? 1.0 : -1.0;
        const double radius = 0.5 * double(1 + random() % 4), d = sign * (from.radius + radius);
        out.push_back(ballAt(from.center.x() + d * way[0], from.center.y() + d * way[1],
                             from.center.z() + d * way[2], radius));
    }
    return out;
}

std::vector<Ball> duplicated(Random& random)
{
    std::vector<Ball> out = test::randomBalls(6, 5.0, Vec3d(2.0), unsigned(random()));
    for (int k = 0; k < 6; ++k) out.push_back(out[random() % out.size()]);
    return out;
}

/// Spheres that share a circle, along an axis, with some other balls. All have sides of right
/// triangles of integers: doubles alone do not tell where the moved ones cross.
std::vector<Ball> pencil(Random& random)
{
    const double members[][2] = {{-1, 1.25}, {-0.4, 0.85}, {0, 0.75}, {0.4, 0.85}, {1, 1.25}};
    const std::size_t axis = random() % 3;
    const double place[] = {double(random() % 8), double(random() % 8), double(random() % 8)};
    std::vector<Ball> out;
    for (const auto& member : members) {
        if (random() % 3 == 0) continue;
        double x[] = {place[0], place[1], place[2]};
        x[axis] += member[0];
        out.push_back(ballAt(x[0], x[1], x[2], member[1]));
    }
    for (int k = 0; k < 4; ++k) {
        const auto near = [&](std::size_t a) { return place[a] + uniform(random, -1.5, 1.5); };
        const double x = near(0), y = near(1), z = near(2);
        out.push_back(ballAt(x, y, z, uniform(random, 0.4, 0.9)));
    }
    return out;
}

/// Two caps that touch in a point, on a sphere that has other caps; in many places, so that the
/// balls are moved otherwise each time.
std::vector<Ball> touchingCaps(Random& random)
{
    const double x = double(random() % 1000), y = double(random() % 1000), z = 0.5;
    std::vector<Ball> out = {ballAt(x, y, z, 2.5), ballAt(x + 1.5, y, z, 2.0),
                             ballAt(x, y + 2.0, z, 1.5), ballAt(x - 1.5, y, z, 2.0),
                             ballAt(x, y - 2.0, z, 1.5)};
    out.push_back(ballAt(x + uniform(random, -0.5, 0.5), y, z + 2.3, 0.6));
    return out;
}

void expectRight(const char* what, const std::function<std::vector<Ball>(Random&)>& make)
{
    Random random(1);
    const std::vector<Vec3d> directions = spreadDirections(4000);
    for (int n = 0; n < 1000; ++n) {
        const std::vector<Ball> balls = make(random);
        const double probe = n % 2 ? 1.4 : 0.0;
        const Totals got = measured(balls, probe), points = sampled(balls, probe, directions);
        ASSERT_NEAR(got.area, points.area, 0.005 * points.area) << what << " " << n;
        ASSERT_NEAR(got.volume, points.volume, 0.005 * points.volume + 0.1) << what << " " << n;
        ASSERT_GE(got.outer, 1) << what << " " << n;
        ASSERT_EQ(got.euler % 2, 0) << what << " " << n;
    }
}

TEST(SpecialPositions, RingsAgainstSamplesSlow)
{
    for (const int fold : {2, 3, 4, 5, 6}) {
        expectRight("ring", [fold](Random& random) { return ring(random, fold); });
    }
}

TEST(SpecialPositions, LatticesAgainstSamplesSlow)
{
    expectRight("lattice of 1 A", [](Random& random) { return onLattice(random, 1.0); });
    expectRight("lattice of 0.5 A", [](Random& random) { return onLattice(random, 0.5); });
}

TEST(SpecialPositions, TouchingAndEqualAgainstSamplesSlow)
{
    expectRight("touching", touching);
    expectRight("equal", duplicated);
    expectRight("spheres through one circle", pencil);
    expectRight("caps that touch", touchingCaps);
}

// Moved by whole numbers, far from the origin, too.
TEST(SpecialPositions, DoNotDependOnThePlace)
{
    Random random(3);
    for (int n = 0; n < 20; ++n) {
        std::vector<Ball> balls = onLattice(random, 1.0);
        const Totals here = measured(balls, 1.4);
        for (Ball& b : balls) b.center += Vec3f(-70000.0f, 900000.0f, 1234.0f);
        const Totals there = measured(balls, 1.4);
        EXPECT_NEAR(there.area, here.area, 1e-6 * here.area);
        EXPECT_NEAR(there.volume, here.volume, 1e-6 * here.volume);
        EXPECT_EQ(there.euler, here.euler);
        EXPECT_EQ(there.outer, here.outer);
    }
}

// Balls that touch are apart, whatever their coordinates round to in single precision.
TEST(SpecialPositions, BallsThatTouchAreApart)
{
    Random random(7);
    for (int n = 0; n < 2000; ++n) {
        const auto decimal = [&] { return double(random() % 100000) / 1000.0; };
        const Vec3d x(decimal(), decimal(), decimal());
        const double r = 1.0 + double(random() % 100) / 100.0;
        const double R = 1.0 + double(random() % 100) / 100.0;
        const std::vector<Ball> balls = {{x, r, 0}, {x + Vec3d(r + R, 0.0, 0.0), R, 1}};
        ASSERT_EQ(measured(balls).outer, 2) << x << ' ' << r << ' ' << R;
        ASSERT_EQ(measured(balls).euler, 4);
    }
}

// A molecule that lies far from the origin has the area that it has there.
TEST(SpecialPositions, AreExactFarFromTheOrigin)
{
    std::vector<Ball> balls = {{{0.123, 0.456, 0.789}, 1.7, 0}, {{1.654, 0.321, 0.987}, 1.55, 1}};
    const Totals here = measured(balls, 1.4);
    for (Ball& b : balls) b.center += Vec3d(654321.0, -123456.0, 98765.0);
    const Totals there = measured(balls, 1.4);
    EXPECT_NEAR(there.area, here.area, 1e-7 * here.area);
    EXPECT_NEAR(there.volume, here.volume, 1e-7 * here.volume);
}

TEST(SpecialPositions, SameBitsInAnyOrder)
{
    Random random(5);
    for (int n = 0; n < 20; ++n) {
        std::vector<Ball> balls = n % 2 ? onLattice(random, 0.5) : ring(random, 2 + n / 2 % 5);
        const Totals first = measured(balls, 1.4);
        for (int s = 0; s < 10; ++s) {
            std::shuffle(balls.begin(), balls.end(), random);
            const Totals again = measured(balls, 1.4);
            ASSERT_EQ(again.area, first.area) << n;
            ASSERT_EQ(again.volume, first.volume) << n;
            ASSERT_EQ(again.euler, first.euler) << n;
        }
    }
}

// Very many balls on each other: all but those of their convex hull are hidden.
TEST(SpecialPositions, ManyInOnePlace)
{
    for (const double size : {0.01, 1.0}) {
        Random random(7);
        std::vector<Ball> balls;
        for (int k = 0; k < 2000; ++k) {
            const auto at = [&] { return uniform(random, 0.0, size); };
            const double x = at(), y = at(), z = at();
            balls.push_back(ballAt(x, y, z, 1.7));
        }
        const Totals got = measured(balls), points = sampled(balls, 0.0, spreadDirections(4000));
        EXPECT_NEAR(got.area, points.area, 0.005 * points.area);
        EXPECT_NEAR(got.volume, points.volume, 0.005 * points.volume);
        EXPECT_EQ(got.outer, 1);
        EXPECT_EQ(got.euler, 2);
    }
}

// A hole that a probe just fits has no boundary, wherever it is: the moves of the balls do not
// decide. One that is a thousandth larger has.
TEST(SpecialPositions, AHoleThatAProbeJustFitsIsNone)
{
    const double probe = 1.4, touching = double(1.6f) + probe;
    for (const double larger : {0.0, 1e-9, 1e-3}) {
        for (int place = 0; place < 16; ++place) {
            std::vector<Ball> balls;
            for (int k = 0; k < 6; ++k) { // an octahedron
                Vec3d x(0.37 * place, 0.21 * place, -0.13 * place);
                x[k / 2] += (k % 2 ? touching : -touching) * (1.0 + larger);
                balls.push_back({x, 1.6f, k});
            }
            const Vec3d middle(0.37 * place, 0.21 * place, -0.13 * place);
            const BallBoundary boundary = ballBoundary(balls, probe, Progress());
            const auto inside = std::count_if(
                boundary.corners.begin(), boundary.corners.end(),
                [&](const Corner& corner) { return (corner.position - middle).length() < 1.0; });
            EXPECT_EQ(inside, larger < 1e-6 ? 0 : 8) << larger << " " << place;
            EXPECT_EQ(measured(balls, probe).cavities, larger < 1e-6 ? 0 : 1) << place;
        }
    }
}

} // namespace
} // namespace molsurf
