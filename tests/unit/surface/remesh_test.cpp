// SPDX-License-Identifier: MPL-2.0
#include "support/runs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace molsurf
{
namespace
{

using openvdb::Vec3f;

/// Balls on a sphere, with room for a probe between them and the middle.
std::vector<Ball> shell()
{
    constexpr int count = 60;
    std::vector<Ball> balls;
    for (int i = 0; i < count; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / count, angle = 2.399963 * i;
        const double r = std::sqrt(1.0 - z * z);
        const openvdb::Vec3d x(0.1 + 5.5 * r * std::cos(angle), 0.2 + 5.5 * r * std::sin(angle),
                               0.3 + 5.5 * z);
        balls.push_back({Vec3f(x), 1.7f, i});
    }
    return balls;
}

SurfaceOptions with(double edge, SurfaceKind kind)
{
    SurfaceOptions options;
    options.kind = kind;
    options.meshEdge = edge;
    options.ballAreas = true;
    return options;
}

TEST(RemeshedSurface, KeepsPiecesMeasuresAndAreasOfBalls)
{
    for (const SurfaceKind kind : {SurfaceKind::SolventExcluded, SurfaceKind::Variational}) {
        const MolecularSurface old = test::runOn(shell(), with(0.0, kind));
        const MolecularSurface made = test::runOn(shell(), with(0.6, kind));
        const SurfaceReport &a = old.report.surface, &b = made.report.surface;
        ASSERT_EQ(a.cavities.size(), 1u) << nameOf(kind);
        EXPECT_FALSE(a.shape);
        ASSERT_TRUE(b.shape);
        EXPECT_EQ(b.shape->eulerNumbers, (std::vector<int>{2, 2}));
        EXPECT_EQ(b.shape->keptPieces, 0u);
        EXPECT_GT(b.shape->leastAngle, 30.0);
        EXPECT_EQ(a.area, b.area);
        EXPECT_EQ(a.volume, b.volume);
        EXPECT_EQ(a.meanCurvature.mean, b.meanCurvature.mean);
        EXPECT_EQ(old.ballAreas, made.ballAreas);
        EXPECT_EQ(b.vertices, made.mesh.positions.size());
        EXPECT_EQ(b.triangles, made.mesh.triangles.size());
        EXPECT_LT(b.triangles, a.triangles);
        EXPECT_TRUE(b.closed && b.manifold);
        EXPECT_LT(b.maxResidual, 1e-3);
    }
}

TEST(RemeshedSurface, HasAllAttributesAtItsVertices)
{
    SurfaceOptions options = with(0.6, SurfaceKind::Variational);
    options.fields = {"principal_curvature_1"};
    options.curvatureTotals = true;
    const Mesh mesh = test::runOn(shell(), options).mesh;
    ASSERT_EQ(mesh.scalars.size(), 5u);
    for (const auto& scalar : mesh.scalars)
        EXPECT_EQ(scalar.values.size(), mesh.positions.size()) << scalar.name;
    ASSERT_FALSE(mesh.labels.empty());
    for (const auto& label : mesh.labels)
        EXPECT_EQ(label.values.size(), mesh.positions.size()) << label.name;
    const auto &H = mesh.scalars[0].values, &K = mesh.scalars[1].values,
               &k1 = mesh.scalars[2].values;
    for (std::size_t v = 0; v < H.size(); ++v)
        ASSERT_NEAR(k1[v], H[v] + std::sqrt(std::max(H[v] * H[v] - K[v], 0.0f)), 2e-2);
    // The ball of a vertex is the nearest one.
    const std::vector<Ball> balls = shell();
    for (std::size_t v = 0; v < H.size(); v += 17) {
        const auto gap = [&](const Ball& ball) {
            return (mesh.positions[v] - ball.center).length() - ball.radius;
        };
        const auto nearest = std::min_element(balls.begin(), balls.end(),
                                              [&](auto& a, auto& b) { return gap(a) < gap(b); });
        ASSERT_NEAR(gap(balls[std::size_t(mesh.labels[0].values[v])]), gap(*nearest), 1e-4);
    }
}

TEST(RemeshedSurface, LeavesPiecesThatAreTooSmallAndSaysSo)
{
    std::vector<Ball> balls = shell();
    balls.push_back({Vec3f(14.1f, 0.2f, 0.3f), 1.4f, 60});
    const SurfaceOptions options = with(0.8, SurfaceKind::VanDerWaals);
    const Report report = test::runOn(balls, options).report;
    ASSERT_TRUE(report.surface.shape);
    EXPECT_EQ(report.surface.shape->keptPieces, 1u);
    const auto told = [](const Report& of) {
        std::vector<std::string> lines;
        for (const std::string& line : of.warnings)
            if (line.find("`remesh`") != std::string::npos) lines.push_back(line);
        return lines;
    };
    ASSERT_EQ(told(report).size(), 1u);
    const std::string line = told(report)[0];
    EXPECT_NE(line.find("1 closed piece of "), std::string::npos) << line;
    // Followed, the hint helps.
    const std::size_t at = line.find("[hint: `remesh` ");
    ASSERT_NE(at, std::string::npos);
    const double edge = std::stod(line.substr(at + 16));
    const Report followed = test::runOn(balls, with(edge, SurfaceKind::VanDerWaals)).report;
    EXPECT_EQ(followed.surface.shape->keptPieces, 0u);
    EXPECT_TRUE(told(followed).empty());
}

TEST(RemeshedSurface, OfPartsHasTheWorstOfAll)
{
    BallSet atoms;
    atoms.balls = shell();
    atoms.placement.begin = {0, atoms.balls.size()};
    BallLabels labels;
    labels.chains = {"A"};
    labels.chainOf.assign(60, 0);
    labels.elementOf.assign(60, 6);
    labels.residueClassOf.assign(60, ResidueClass::Other);
    labels.groups = {{"top", 30, {}}, {"bottom", 30, {}}};
    for (int i = 0; i < 60; ++i) labels.groupOf.push_back(i < 30 ? 0 : 1);
    atoms.labels = labels;
    SurfaceOptions options = with(0.6, SurfaceKind::SolventExcluded);
    options.ballAreas = false;
    options.split = true;
    const Report report = makeSurface(atoms, options).report;
    ASSERT_EQ(report.parts.size(), 2u);
    ASSERT_TRUE(report.surface.shape);
    const SurfaceReport::Shape &all = *report.surface.shape, &a = *report.parts[0].surface.shape,
                               &b = *report.parts[1].surface.shape;
    EXPECT_EQ(all.leastAngle, std::min(a.leastAngle, b.leastAngle));
    EXPECT_EQ(all.shortestEdge, std::min(a.shortestEdge, b.shortestEdge));
    EXPECT_EQ(all.longestEdge, std::max(a.longestEdge, b.longestEdge));
    EXPECT_EQ(all.eulerNumbers.size(), a.eulerNumbers.size() + b.eulerNumbers.size());
}

} // namespace
} // namespace molsurf
