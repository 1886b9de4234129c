// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/pockets/find_pore.h"

#include "molsurf/analysis/pockets/clearance.h"
#include "molsurf/error.h"

#include "support/molecules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

constexpr double turn = 6.283185307179586;

/// Rings of balls about an axis, turned and moved: the radius of each by its height.
struct Tube {
    std::function<double(double)> ring;
    int sides = 16;
    double ball = 1.7, half = 9.0;
    Vec3d axis = Vec3d(0.36, -0.48, 0.8), middle = Vec3d(3.1, -2.7, 11.9);

    Vec3d at(double a, double b, double h) const
    {
        const Plane plane(middle, axis);
        return plane.at(a, b) + axis * h;
    }
    std::vector<Ball> balls() const
    {
        std::vector<Ball> out;
        for (double h = -half; h <= half + 1e-9; h += 1.0)
            for (int k = 0; k < sides; ++k) {
                const double angle = turn * (k + 0.5 * (std::lround(h) % 2)) / sides;
                out.push_back({at(ring(h) * std::cos(angle), ring(h) * std::sin(angle), h), ball,
                               std::int32_t(out.size())});
            }
        return out;
    }
    SearchPlaces::PoreWay ends(double reach) const
    {
        return {{{at(0.0, 0.0, -reach), true}, {at(0.0, 0.0, reach), true}}, Vec3d(0.0)};
    }
};

const Report::Pore::Station& narrowestOf(const Report::Pore& pore)
{
    return *std::min_element(pore.stations.begin(), pore.stations.end(),
                             [](auto& a, auto& b) { return a.radius < b.radius; });
}

const Progress nobody;

// A ball in the middle of a ring of radius R touches all of it: R - r.
TEST(FindPore, ARingOfBallsHasTheRadiusOfItsClosedForm)
{
    for (const int sides : {7, 12}) {
        Tube tube{[](double) { return 4.0; }, sides};
        tube.half = 0.0;
        const Report::Pore pore = findPore(tube.balls(), tube.ends(3.0), nobody);
        EXPECT_NEAR(pore.narrowest(), 4.0 - 1.7, 1e-9) << sides;
        EXPECT_NEAR((placeOf(narrowestOf(pore)) - tube.middle).length(), 0.0, 1e-6) << sides;
    }
}

// Of a tube of rings that is narrowest at one of them the bottleneck is that one.
TEST(FindPore, TheBottleneckOfAnHourglassIsExact)
{
    const Tube tube{[](double h) { return 3.5 + 0.02 * (h - 2.0) * (h - 2.0); }};
    const Report::Pore pore = findPore(tube.balls(), tube.ends(8.5), nobody);
    EXPECT_NEAR(pore.narrowest(), 1.8, 1e-9);
    EXPECT_NEAR((placeOf(narrowestOf(pore)) - tube.at(0.0, 0.0, 2.0)).length(), 0.0, 1e-6);
    EXPECT_TRUE(narrowestOf(pore).isBottleneck);
    EXPECT_NEAR(pore.length(), 17.0, 0.2);
    // Found by itself it is the same.
    const Report::Pore found = findPore(tube.balls(), {}, nobody);
    EXPECT_NEAR(found.narrowest(), 1.8, 1e-9);
}

/// f at a place, by all balls.
double roomAmong(const std::vector<Ball>& balls, const Vec3d& x)
{
    double least = 1e30;
    for (const Ball& ball : balls)
        least = std::min(least, (x - ball.center).length() - ball.radius);
    return least;
}

/// A tube of radius 5 with a ball in its middle.
std::vector<Ball> plugged(const Tube& tube, double radius)
{
    std::vector<Ball> balls = tube.balls();
    balls.push_back({tube.middle, radius, 999});
    return balls;
}

// Of places that are as narrow as each other, with nothing wider between, the first is the neck.
TEST(FindPore, ALevelNeckIsOneBottleneck)
{
    std::vector<Ball> balls;
    for (double h = -6.0; h <= 6.0; h += 1.0)
        for (int k = 0; k < 12; ++k) {
            const double angle = turn * k / 12;
            balls.push_back({Vec3d(4.3 * std::cos(angle), 4.3 * std::sin(angle), h), 2.35,
                             std::int32_t(balls.size())});
        }
    const Vec3d end(0.0, 0.0, 8.0);
    const Report::Pore pore = findPore(balls, {{{-end, true}, {end, true}}, Vec3d(0.0)}, nobody);
    EXPECT_EQ(std::count_if(pore.stations.begin(), pore.stations.end(),
                            [](const auto& s) { return s.isBottleneck; }),
              1);
}

// Of a wide tunnel along the longest axis and a narrow one along the shortest it is the wide one.
TEST(FindPore, ByItselfItIsTheWidestWayOfAllAxes)
{
    std::vector<Ball> balls;
    for (double x = -9.0; x <= 9.0; x += 1.0)
        for (double y = -8.0; y <= 8.0; y += 1.0)
            for (double z = -5.0; z <= 5.0; z += 1.0)
                if (std::hypot(y + 3.0, z) > 3.8 && std::hypot(x, y - 4.0) > 2.8)
                    balls.push_back({Vec3d(x, y, z), 1.5, std::int32_t(balls.size())});
    const Report::Pore pore = findPore(balls, {}, nobody);
    EXPECT_GT(std::abs(pore.axis[0]), 0.9);
    EXPECT_NEAR(pore.narrowest(), 4.0 - 1.5, 0.1);
}

// Also where a pore narrows fast: at a ball in it, at its mouths.
TEST(FindPore, EveryRadiusIsTheClearanceOfItsPlace)
{
    const Tube wide{[](double) { return 5.0; }};
    const Tube upright{wide.ring, 16, 1.7, 12.0, Vec3d(0.0, 0.0, 1.0), Vec3d(0.0)};
    const Tube wavy{[](double h) { return 6.5 + 1.5 * std::sin(1.3 * h); }};
    const std::vector<std::pair<Tube, std::vector<Ball>>> cases = {
        {wide, plugged(wide, 3.0)},
        {upright, plugged(upright, 4.0)},
        {upright, plugged(upright, 3.0)},
        {wavy, plugged(wavy, 2.0)},
    };
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const auto& [tube, balls] = cases[i];
        const Report::Pore pore = findPore(balls, tube.ends(12.0), nobody);
        ASSERT_GT(pore.stations.size(), 40u) << i;
        for (const Report::Pore::Station& s : pore.stations)
            EXPECT_NEAR(s.radius, roomAmong(balls, placeOf(s)), 1e-6) << i << " " << placeOf(s);
    }
}

// The gap about a ball that fills a tube is closed, and dents in the outside are no pore.
TEST(FindPore, AClosedTubeIsNotPassedOutside)
{
    const Tube tube{[](double) { return 5.0; }, 16, 1.7, 12.0};
    for (const double reach : {9.0, 12.0, 15.0}) {
        const std::vector<Ball> balls = plugged(tube, 4.5);
        const Report::Pore pore = findPore(balls, tube.ends(reach), nobody);
        EXPECT_LT(pore.narrowest(), 0.0) << reach;
        EXPECT_NEAR(pore.length(), 2.0 * reach, 1.0) << reach;
    }
}

// By Ohm's rule a straight tube of radius r and length l has pi r^2 / (rho l).
TEST(FindPore, AStraightTubeConductsByOhmsRule)
{
    Report::Pore pore;
    for (int i = 0; i <= 40; ++i) {
        pore.stations.emplace_back();
        pore.stations.back().radius = 3.0;
        pore.stations.back().distance = 0.5 * i;
    }
    ASSERT_TRUE(pore.conductance());
    EXPECT_NEAR(*pore.conductance(), 1e12 * 0.5 * turn * 9e-20 / (0.0898 * 20e-10), 1e-6);
    for (const double narrow : {1.14, -0.1}) { // no water passes
        pore.stations[7].radius = narrow;
        EXPECT_FALSE(pore.conductance()) << narrow;
    }
}

// A ball of radius p in the middle of a ring of n leaves a ball beside it that touches it and two
// of the ring: at the height 0, halfway between them, |x| - p = |x - c| - r.
TEST(FindPore, ABlockedTubeHasANegativeRadiusAndItsPlace)
{
    constexpr double plug = 1.9, ring = 3.4;
    const Tube tube{[](double) { return ring; }, 16};
    std::vector<Ball> balls = tube.balls();
    balls.push_back({tube.middle, plug, 999});
    const Report::Pore pore = findPore(balls, tube.ends(8.0), nobody);
    double low = 0.0, high = ring;
    const double angle = 0.5 * turn / 16;
    while (high - low > 1e-12) {
        const double x = 0.5 * (low + high);
        const double away = std::hypot(x * std::cos(angle) - ring, x * std::sin(angle));
        (x - plug < away - 1.7 ? low : high) = x;
    }
    EXPECT_LT(low - plug, 0.0);
    EXPECT_NEAR(pore.narrowest(), low - plug, 1e-6);
    EXPECT_NEAR((placeOf(narrowestOf(pore)) - tube.middle).length(), low, 1e-4);
    EXPECT_FALSE(pore.conductance());
}

// A bent channel through a block.
TEST(FindPore, ABentWayIsFollowed)
{
    std::vector<Ball> balls;
    const auto isEmpty = [](double x, double y, double z) {
        const bool first = std::hypot(y, z) < 3.2 && x < 3.2;
        const bool second = std::hypot(x, z) < 3.2 && y > -3.2;
        return first || second;
    };
    for (double x = -12.0; x <= 12.0; x += 1.0)
        for (double y = -12.0; y <= 12.0; y += 1.0)
            for (double z = -9.0; z <= 9.0; z += 1.0)
                if (!isEmpty(x, y, z))
                    balls.push_back({Vec3d(x, y, z), 1.5, std::int32_t(balls.size())});
    const Report::Pore pore = findPore(
        balls, {{{Vec3d(-11.0, 0.0, 0.0), true}, {Vec3d(0.0, 11.0, 0.0), true}}, Vec3d(0.0)},
        nobody);
    // The nearest balls of either channel are 2 and 3 Å from its middle.
    EXPECT_NEAR(pore.narrowest(), std::sqrt(13.0) - 1.5, 1e-6);
    EXPECT_NEAR(pore.length(), 18.0, 4.0); // it cuts the corner
    for (const Report::Pore::Station& s : pore.stations) {
        const Vec3d x = placeOf(s);
        EXPECT_LT(std::min(std::hypot(x[1], x[2]), std::hypot(x[0], x[2])), 2.0) << x;
    }
}

// A channel that turns back: its sections lie across it in either arm and between them.
TEST(FindPore, SectionsTurnWithTheWay)
{
    std::vector<Ball> balls;
    const auto isEmpty = [](double x, double y, double z) {
        const bool arm = std::hypot(std::abs(y) - 6.0, z) < 3.2 && x < 3.2;
        return arm || (std::hypot(x, z) < 3.2 && std::abs(y) < 9.2);
    };
    for (double x = -12.0; x <= 7.0; x += 1.0)
        for (double y = -13.0; y <= 13.0; y += 1.0)
            for (double z = -7.0; z <= 7.0; z += 1.0)
                if (!isEmpty(x, y, z))
                    balls.push_back({Vec3d(x, y, z), 1.5, std::int32_t(balls.size())});
    const Report::Pore pore = findPore(
        balls, {{{Vec3d(-11.0, -6.0, 0.0), true}, {Vec3d(-11.0, 6.0, 0.0), true}}, Vec3d(0.0)},
        nobody);
    EXPECT_GT(pore.stations.front().normal[0], 0.95);
    EXPECT_LT(pore.stations.back().normal[0], -0.95);
    EXPECT_GT(pore.stations[pore.stations.size() / 2].normal[1], 0.9);
    EXPECT_GT(pore.length(), 22.0); // there and back
}

// Wherever in a tube the ends lie, its sections lie across it.
TEST(FindPore, EndsBesideTheMiddleDoNotNarrowATube)
{
    const Tube tube{[](double) { return 4.7; }, 16, 1.7, 7.0};
    for (const Vec3d& side : {Vec3d(2.0, 0.0, -6.0), Vec3d(0.0, 2.5, -6.0)}) {
        const Vec3d from = tube.at(side[0], side[1], side[2]),
                    to = tube.at(-side[0], side[1], -side[2]);
        const Report::Pore pore =
            findPore(tube.balls(), {{{from, true}, {to, true}}, Vec3d(0.0)}, nobody);
        EXPECT_NEAR(pore.narrowest(), 3.0, 1e-4) << side;
        EXPECT_NEAR(pore.length(), (to - from).length(), 0.3) << side;
    }
}

// The narrowest place is a bottleneck, also where the saddle nearest to it is another one's.
TEST(FindPore, TheNarrowestPlaceIsABottleneck)
{
    const std::vector<Ball> balls = test::balls("1ubq.pdb");
    const auto middleOf = [&](std::size_t begin, std::size_t end) {
        Vec3d sum(0.0);
        for (std::size_t i = begin; i < end; ++i) sum += balls[i].center / double(end - begin);
        return SearchPlaces::End{sum, false};
    };
    const Report::Pore pore =
        findPore(balls, {{middleOf(20, 28), middleOf(330, 338)}, Vec3d(0.0)}, nobody);
    EXPECT_TRUE(narrowestOf(pore).isBottleneck);
}

void expectError(const std::vector<Ball>& balls, const SearchPlaces::PoreWay& way, ErrorKind kind,
                 const char* text)
{
    try {
        findPore(balls, way, nobody);
        FAIL() << "expected an Error about " << text;
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), kind);
        EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
}

TEST(FindPore, RefusesWhatHasNoWay)
{
    const Tube tube{[](double) { return 4.0; }};
    const std::vector<Ball> balls = tube.balls();
    const Vec3d inside = balls[40].center, middle = tube.middle;
    expectError(balls, {{{inside, true}, {middle, true}}, Vec3d(0.0)}, ErrorKind::Input, "inside");
    // Beside the tube there is only the outside.
    expectError(balls,
                {{{tube.at(25.0, 0.0, -9.0), true}, {tube.at(25.0, 0.0, 9.0), true}}, Vec3d(0.0)},
                ErrorKind::Input, "found none that is not outside");
    expectError(balls,
                {{{tube.at(0.0, 0.0, -9.0), true}, {tube.at(0.0, 0.0, 90.0), true}}, Vec3d(0.0)},
                ErrorKind::Input, "expected ends within");
    // One ball encloses nothing.
    expectError({{Vec3d(0.0), 1.7, 0}},
                {{{Vec3d(2.0, 0.0, 0.0), true}, {Vec3d(6.0, 0.0, 0.0), true}}, Vec3d(0.0)},
                ErrorKind::Input, "found none that is not outside");
    const Vec3d across = Plane(Vec3d(0.0), tube.axis).along[0];
    expectError(balls, {{}, across}, ErrorKind::Input, "found none");
    expectError({balls[0]}, {}, ErrorKind::Input, "found none");
    // An end that only has to be near is moved out of its ball.
    EXPECT_NEAR(
        findPore(balls, {{{tube.at(2.9, 0.0, -6.0), false}, {middle, true}}, Vec3d(0.0)}, nobody)
            .narrowest(),
        2.3, 0.05);
}

/// Pillars about an axis with windows between them, and a closed ring.
std::vector<Ball> windowed(int pillars, const Vec3d& axis)
{
    const Plane plane(Vec3d(1.0, 2.0, 3.0), axis);
    std::vector<Ball> balls;
    const auto add = [&](double a, double b, double h) {
        balls.push_back({plane.at(a, b) + axis * h, 1.7, std::int32_t(balls.size())});
    };
    for (int k = 0; k < 24; ++k)
        add(5.5 * std::cos(turn * k / 24), 5.5 * std::sin(turn * k / 24), 0.0);
    for (int k = 0; k < pillars; ++k) {
        const double angle = turn * (k + 0.5) / pillars, c = std::cos(angle), s = std::sin(angle);
        for (int i = -8; i <= 8; ++i)
            for (const double along : {-2.0, 0.0, 2.0})
                for (const double r : {9.0, 11.5})
                    add(r * c - along * s, r * s + along * c, 2.5 * i);
    }
    return balls;
}

// Windows, which are wider than the ring, lead sideways: the way through is that by the ring.
TEST(FindPore, WindowsAreNoWayThrough)
{
    const Vec3d axis(0.36, -0.48, 0.8);
    for (const int pillars : {4, 5})
        for (const bool given : {true, false}) {
            const Report::Pore pore =
                findPore(windowed(pillars, axis), {{}, given ? axis : Vec3d(0.0)}, nobody);
            EXPECT_NEAR(pore.narrowest(), 5.5 - 1.7, 1e-6) << pillars << given;
            EXPECT_GT(pore.length(), 35.0) << pillars << given;
        }
}

// The wider of two tubes is the pore, the other one another way; two that are as wide are a bundle.
TEST(FindPore, TheWiderOfTwoTubesIsThePore)
{
    for (const double other : {3.2, 4.0, 4.6}) {
        std::vector<Ball> balls;
        for (double z = -9.0; z <= 9.0; z += 1.5)
            for (double x = -17.0; x <= 17.0; x += 1.5)
                for (double y = -9.0; y <= 9.0; y += 1.5)
                    if (std::hypot(x - 8.0, y) > 4.7 + 1.7 &&
                        std::hypot(x + 8.0, y) > other + 1.7 &&
                        std::max(std::hypot(x - 8.0, y), 0.0) > 0.0)
                        balls.push_back({Vec3d(x, y, z), 1.7, std::int32_t(balls.size())});
        const Report::Pore pore = findPore(balls, {{}, Vec3d(0.0, 0.0, 1.0)}, nobody);
        EXPECT_GT(pore.narrowest(), 4.6) << other;
        EXPECT_EQ(pore.bundle.size() + pore.others.size(), 1u) << other;
        double narrowest[2] = {1e9, 1e9}; // of both tubes, on their axes
        for (double z = -9.0; z <= 9.0; z += 0.05)
            for (const int k : {0, 1})
                narrowest[k] = std::min(narrowest[k], roomAmong(balls, {k ? -8.0 : 8.0, 0.0, z}));
        EXPECT_EQ(pore.bundle.size(), narrowest[1] > 0.95 * narrowest[0] ? 1u : 0u) << other;
        for (const auto& one : pore.others) EXPECT_NEAR(one.radius, narrowest[1], 0.1) << other;
    }
}

// An end in an atom goes to the room beside it, not 3 Å along a tube whose radius grows there by
// 0.09 Å: of two places the one with more room, less 0.2 Å for each Å of way, counts.
TEST(FindPore, AnEndInAnAtomStaysNearIt)
{
    const Tube tube{[](double h) { return 3.9 + 0.03 * (h + 4.0); }};
    const std::vector<Ball> balls = tube.balls();
    const Vec3d first = balls[5 * 16].center; // of the ring at -4 Å
    const Report::Pore pore =
        findPore(balls, {{{first, false}, {tube.at(0.0, 0.0, 6.0), true}}, Vec3d(0.0)}, nobody);
    const Vec3d start = placeOf(pore.stations.front());
    EXPECT_NEAR((start - tube.middle).dot(tube.axis), -4.0, 1.5);
    EXPECT_GT(pore.stations.front().radius, 2.0); // in the middle of the tube
}

// A pore that narrows up to its end is narrowest there, and is crossed as far as it lies in the
// molecule.
TEST(FindPore, AnEndMayBeTheNeck)
{
    std::vector<Report::Pore::Station> narrowing(4);
    for (std::size_t i = 0; i < 4; ++i) narrowing[i].radius = 4.0 - 0.5 * double(i);
    EXPECT_EQ(necksOf(narrowing), std::vector<std::size_t>{3});
    narrowing[1].radius = 2.7; // a neck, though no narrower than the end
    narrowing[3].radius = 2.5;
    EXPECT_EQ(necksOf(narrowing), (std::vector<std::size_t>{1, 3}));
    narrowing[1].radius = 2.95; // which is not 0.1 Å narrower than what follows
    EXPECT_EQ(necksOf(narrowing), std::vector<std::size_t>{3});
}

TEST(FindPore, IsCrossedAsFarAsItLiesInTheMolecule)
{
    const Tube tube{[](double) { return 4.0; }}; // from -10.7 to 10.7 Å
    const auto crossed = [&](double from, double to) {
        return findPore(
                   tube.balls(),
                   {{{tube.at(0.0, 0.0, from), true}, {tube.at(0.0, 0.0, to), true}}, Vec3d(0.0)},
                   nobody)
            .crossed;
    };
    EXPECT_NEAR(crossed(-15.0, 0.0), 0.5, 0.02);
    EXPECT_NEAR(crossed(0.0, 15.0), 0.5, 0.02);
    EXPECT_NEAR(crossed(-5.35, 5.35), 0.5, 0.02);
    EXPECT_NEAR(crossed(-15.0, 15.0), 1.0, 1e-9);
}

// A bay of 5 Å beside a tube of 3.7 Å, behind a strait that is an Å narrower than the tube, is not
// of its sections. (Of balls of 3 Å nothing passes between those of a lattice.)
TEST(FindPore, ABayBehindAStraitIsNotOfTheSection)
{
    std::vector<Ball> balls;
    for (double x = -9.0; x <= 17.0; x += 1.0)
        for (double y = -10.0; y <= 10.0; y += 1.0)
            for (double z = -10.0; z <= 10.0; z += 1.0) {
                const double ofTube = std::hypot(x, y) - 6.5,
                             ofBay = Vec3d(x - 7.0, y, z).length() - 8.0;
                const double outside = std::min(ofTube, ofBay);
                if (outside >= 0.0 && outside < 2.0)
                    balls.push_back({{x, y, z}, 3.0, int(balls.size())});
            }
    for (double z = -7.0; z <= 7.0; z += 1.0)
        for (const double y : {-5.5, 5.5}) balls.push_back({{3.2, y, z}, 3.0, int(balls.size())});
    const Vec3d from(-0.2, 0.0, -8.0), to(-0.2, 0.0, 8.0);
    const Report::Pore pore = findPore(balls, {{{from, true}, {to, true}}, Vec3d(0.0)}, nobody);
    const Clearance clearance(balls);
    std::size_t seen = 0;
    for (const Report::Pore::Station& station : pore.stations) {
        const Vec3d x = placeOf(station);
        if (std::abs(x[2]) > 0.5) continue;
        ++seen;
        EXPECT_LT(x[0], 2.0);
        double widest = 0.0; // of the section on this side of the strait
        for (double a = -2.0; a <= 2.0; a += 0.05)
            for (double b = -1.5; b <= 1.5; b += 0.05)
                widest = std::max(widest, clearance.at({a, b, x[2]}));
        EXPECT_NEAR(station.radius, widest, 0.02) << x;
        EXPECT_NEAR(clearance.at({3.2, 0.0, x[2]}), 2.5, 0.05);   // the strait is narrower
        EXPECT_GT(clearance.at({7.8, 0.0, x[2]}), widest + 0.25); // the bay is wider
    }
    EXPECT_GT(seen, 2u);
}

// However far the nearest ball is, and whatever the class of its radius.
TEST(Clearance, IsThatOfAllBalls)
{
    const Tube tube{[](double) { return 9.0; }, 24};
    const std::vector<Ball> balls = plugged(tube, 4.0);
    const Clearance clearance(balls);
    for (double h = -20.0; h <= 20.0; h += 0.5)
        for (double a = -15.0; a <= 15.0; a += 0.5) {
            const Vec3d x = tube.at(a, 0.3 * a, h);
            EXPECT_NEAR(clearance.at(x), roomAmong(balls, x), 1e-12) << x;
        }
}

// The largest ball of a plane among random balls is that of a search with many starts.
TEST(Clearance, TheWidestPlaceOfASectionIsExact)
{
    const Tube tube{[](double h) { return 4.0 + 0.5 * std::sin(2.1 * h); }, 9};
    const Clearance clearance(tube.balls());
    const Plane plane(tube.at(0.0, 0.0, 0.37), tube.axis);
    const auto found = clearance.widestIn(plane, plane.origin, 1.0);
    ASSERT_TRUE(found);
    EXPECT_NEAR(clearance.at(found->place), found->radius, 1e-9);
    double best = 0.0;
    for (int i = -500; i <= 500; ++i)
        for (int k = -500; k <= 500; ++k)
            best = std::max(best, clearance.at(plane.at(0.002 * i, 0.002 * k)));
    EXPECT_LE(best, found->radius + 1e-9);
    EXPECT_NEAR(best, found->radius, 0.002);
}

/// Three balls of 1 Å about a place, 3 Å from it, at some angles [degree].
std::vector<Ball> threeAbout(const Vec3d& middle, const std::array<double, 3>& angles)
{
    std::vector<Ball> out;
    for (const double angle : angles) {
        const double a = angle * M_PI / 180.0;
        out.push_back({middle + 3.0 * Vec3d(std::cos(a), std::sin(a), 0.0), 1.0f, int(out.size())});
    }
    return out;
}

// A ball that touches three others is the largest only if they hold it from all sides.
TEST(Clearance, AHeldBallTouchesThreeFromAllSides)
{
    const Vec3d middle(10.0, 20.0, 5.0);
    const Plane plane(middle, Vec3d(0.0, 0.0, 1.0));
    for (const bool held : {true, false}) {
        const Clearance clearance(threeAbout(middle, held ? std::array{0.0, 130.0, 250.0}
                                                          : std::array{-50.0, 10.0, 60.0}));
        const auto widest = clearance.widestIn(plane, middle + Vec3d(0.1, -0.2, 0.0), 0.5);
        const auto neck = clearance.neckNear(middle + Vec3d(0.1, -0.2, 0.3), 0.5, 5.0);
        EXPECT_EQ(bool(widest), held);
        EXPECT_EQ(bool(neck), held);
        EXPECT_FALSE(clearance.neckNear(middle + Vec3d(0.1, -0.2, 0.3), 0.5, 1.9)); // it has 2 Å
        EXPECT_FALSE(clearance.neckNear(middle + Vec3d(0.1, -0.2, 0.6), 0.5, 5.0)); // too far
        for (const auto& found : {widest, neck}) {
            if (!found) continue;
            EXPECT_LT((found->place - middle).length(), 1e-9);
            EXPECT_NEAR(found->radius, 2.0, 1e-9);
        }
    }
}

} // namespace
} // namespace molsurf
