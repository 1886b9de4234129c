// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/boundary_measure.h"
#include "molsurf/kernel/balls/boundary_point.h"
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
using openvdb::Vec3f;

TEST(BoundaryPoint, OfTwoBallsInClosedForm)
{
    // Spheres of radius 3 about (0, 0, 0) and (4, 0, 0) meet in the circle x = 2, r = sqrt 5.
    const BallBoundary boundary =
        ballBoundary({{Vec3f(0.0f), 1.5f, 0}, {Vec3f(4, 0, 0), 1.5f, 1}}, 1.5, Progress());
    const BoundaryPoints points(boundary);

    const BoundaryPoint patch = points.nearest({-1.2, 0.9, 0.0}, 0.1);
    EXPECT_EQ(patch.part, BoundaryPart::Patch);
    EXPECT_EQ(boundary.balls[std::size_t(boundary.patches[patch.index].ball)].index, 0);
    EXPECT_NEAR(patch.distance, 1.5, 1e-8);
    EXPECT_NEAR((patch.position - Vec3d(-2.4, 1.8, 0.0)).length(), 0.0, 1e-8);

    const BoundaryPoint arc = points.nearest({2.1, 0.0, -1.0}, 10.0);
    EXPECT_EQ(arc.part, BoundaryPart::Arc);
    EXPECT_NEAR((arc.position - Vec3d(2.0, 0.0, -std::sqrt(5.0))).length(), 0.0, 1e-8);
    EXPECT_NEAR(points.nearest({2.0, 0.0, 0.0}, 1.0).distance, std::sqrt(5.0), 1e-8);

    // Outside of the balls the nearest point may lie on either.
    EXPECT_NEAR(points.nearest({9.0, 0.0, 0.0}, 0.5).distance, 2.0, 1e-8);
}

/// The distance from x to the boundary by a search through all balls, pairs and triples.
double byAllBalls(const std::vector<Ball>& balls, double probe, const Vec3d& x)
{
    const auto centre = [&](std::size_t i) { return Vec3d(balls[i].center); };
    const auto radius = [&](std::size_t i) { return double(balls[i].radius) + probe; };
    double best = 1e9;
    const auto offer = [&](const Vec3d& y) {
        if (!((y - x).length() < best)) return;
        for (std::size_t i = 0; i < balls.size(); ++i)
            if ((y - centre(i)).length() < radius(i) - 1e-6) return;
        best = (y - x).length();
    };
    for (std::size_t i = 0; i < balls.size(); ++i) {
        Vec3d u = x - centre(i);
        if (u.normalize()) offer(centre(i) + radius(i) * u);
        for (std::size_t j = 0; j < i; ++j) {
            const Vec3d between = centre(j) - centre(i);
            const double d = between.length();
            const double along =
                (d * d + radius(i) * radius(i) - radius(j) * radius(j)) / (2.0 * d);
            const double square = radius(i) * radius(i) - along * along;
            if (square <= 0.0) continue;
            const Vec3d axis = between / d, middle = centre(i) + along * axis;
            Vec3d across = x - middle;
            across -= across.dot(axis) * axis;
            if (across.normalize()) offer(middle + std::sqrt(square) * across);
            for (std::size_t k = 0; k < j; ++k) {
                // Where the third sphere cuts the circle.
                const Vec3d offset = centre(k) - middle;
                Vec3d e = offset - offset.dot(axis) * axis;
                const double aside = e.length();
                if (aside == 0.0) continue;
                e /= aside;
                const double cosine = (square + offset.lengthSqr() - radius(k) * radius(k)) /
                                      (2.0 * aside * std::sqrt(square));
                if (std::abs(cosine) >= 1.0) continue;
                const double sine = std::sqrt(1.0 - cosine * cosine);
                for (const double sign : {-1.0, 1.0})
                    offer(middle + std::sqrt(square) * (cosine * e + sign * sine * axis.cross(e)));
            }
        }
    }
    return best;
}

TEST(BoundaryPoint, AgreesWithAllBalls)
{
    const std::vector<Ball> balls = test::randomBalls(40, 11.0, Vec3d(3.0), 5);
    const BallBoundary boundary = ballBoundary(balls, 1.4, Progress());
    const BoundaryPoints points(boundary);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-8.0, 8.0);
    int parts[3] = {0, 0, 0};
    for (int n = 0; n < 300; ++n) {
        const Vec3d x = Vec3d(3.0) + Vec3d{place(random), place(random), place(random)};
        const BoundaryPoint point = points.nearest(x, 0.3);
        EXPECT_NEAR(point.distance, byAllBalls(balls, 1.4, x), 1e-5);
        EXPECT_NEAR(point.distance, (point.position - x).length(), 1e-12);
        ++parts[int(point.part)];
        if (point.part == BoundaryPart::Corner) {
            for (const std::int32_t b : boundary.corners[point.index].balls) {
                const PlacedBall& ball = boundary.balls[std::size_t(b)];
                EXPECT_NEAR((point.position - ball.centre()).length(), ball.radius, 1e-6);
            }
        }
    }
    for (const int count : parts) EXPECT_GT(count, 10);
}

TEST(BoundaryFaces, AddUpToThePieces)
{
    const std::vector<Ball> balls = test::balls("1crn.pdb");
    const BallBoundary boundary = ballBoundary(balls, 1.4, Progress());
    const BoundaryMeasure measure = measureBoundary(boundary, Progress());
    std::vector<double> ofPiece(measure.pieces.size(), 0.0);
    std::vector<double> ofPatch(boundary.patches.size(), 0.0);
    for (const BoundaryFace& face : measure.faces) {
        ofPatch[face.patch] += face.area;
        if (face.piece >= 0) ofPiece[std::size_t(face.piece)] += face.area;
    }
    for (std::size_t p = 0; p < ofPiece.size(); ++p)
        EXPECT_NEAR(ofPiece[p], measure.pieces[p].area, 1e-6);
    for (std::size_t p = 0; p < ofPatch.size(); ++p)
        EXPECT_NEAR(ofPatch[p], measure.patchAreas[p], 1e-9);
}

TEST(BoundaryFaces, TellTheWallOfACavity)
{
    // Balls on a sphere enclose a cavity; a ball of its own is apart.
    std::vector<Ball> balls;
    for (int i = 0; i < 200; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / 200.0, turn = 2.399963 * i;
        const double r = std::sqrt(1.0 - z * z);
        balls.push_back({Vec3f(8.0 * Vec3d(r * std::cos(turn), r * std::sin(turn), z)), 2.0f, i});
    }
    balls.push_back({Vec3f(40, 0, 0), 1.0f, 200});
    const BallBoundary boundary = ballBoundary(balls, 0.0, Progress());
    const BoundaryMeasure measure = measureBoundary(boundary, Progress());
    ASSERT_EQ(measure.pieces.size(), 3u);
    ASSERT_EQ(measure.arcPieces.size(), boundary.arcs.size());
    for (std::size_t a = 0; a < boundary.arcs.size(); ++a) {
        const Arc& arc = boundary.arcs[a];
        const bool inside = (arc.centre + arc.radius * arc.middle).length() < 8.0;
        ASSERT_GE(measure.arcPieces[a], 0);
        EXPECT_EQ(measure.pieces[std::size_t(measure.arcPieces[a])].outer, !inside);
    }
    // The balls of the wall have a face on either side.
    EXPECT_EQ(measure.faces.size(), 401u);
}

} // namespace
} // namespace molsurf
