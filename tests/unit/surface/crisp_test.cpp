// SPDX-License-Identifier: MPL-2.0
// Borders of colours on real surfaces.

#include "molsurf/kernel/mesh/statistics.h"
#include "molsurf/show/color/crisp_borders.h"
#include "molsurf/surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;
using openvdb::Vec3f;

constexpr Color red = {255, 0, 0}, green = {0, 255, 0}, blue = {0, 0, 255};

Mesh surfaceOf(const std::vector<Ball>& balls, SurfaceKind kind)
{
    SurfaceOptions options;
    options.kind = kind;
    options.voxel = 1.0;
    return makeSurface(balls, options).mesh;
}

/// The places of vertices that are there in two colours.
std::map<Vec3f, std::set<Color>> bordersOf(const Mesh& mesh)
{
    std::map<Vec3f, std::set<Color>> all;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        all[mesh.positions[v]].insert(mesh.colors[v]);
    for (auto place = all.begin(); place != all.end();)
        place = place->second.size() < 2 ? all.erase(place) : std::next(place);
    return all;
}

double areaOf(const Mesh& mesh)
{
    double sum = 0.0;
    for (const float area : vertexAreas(mesh, Progress())) sum += double(area);
    return sum;
}

/// The area of triangles that turn away from the normals of their corners [Å^2].
double turnedAreaOf(const Mesh& mesh)
{
    double sum = 0.0;
    for (const auto& t : mesh.triangles) {
        const Vec3d a(mesh.positions[t[0]]);
        const Vec3d twice =
            (Vec3d(mesh.positions[t[1]]) - a).cross(Vec3d(mesh.positions[t[2]]) - a);
        Vec3d normal(0.0);
        for (const std::uint32_t v : t) normal += Vec3d(mesh.normals[v]);
        if (twice.dot(normal) < 0.0) sum += 0.5 * twice.length();
    }
    return sum;
}

TEST(CrispBorders, TwoBallsMeetInACircle)
{
    const std::vector<Ball> balls = {{Vec3f(0.3f, 0.1f, 0.2f), 2.5f, 0},
                                     {Vec3f(2.3f, 1.1f, 0.7f), 1.9f, 1}};
    const Mesh mesh = surfaceOf(balls, SurfaceKind::VanDerWaals);
    const Mesh crisp = withCrispBorders(mesh, colorOwners(balls, {red, blue}), 1.0, "", Progress());
    const Vec3d a(balls[0].center), axis = (Vec3d(balls[1].center) - a).unit();
    const double d = (Vec3d(balls[1].center) - a).length();
    const double along = (d * d + 2.5 * 2.5 - 1.9 * 1.9) / (2.0 * d);
    const double radius = std::sqrt(2.5 * 2.5 - along * along);
    const auto borders = bordersOf(crisp);
    EXPECT_GT(borders.size(), 15u);
    for (const auto& [x, colors] : borders) {
        const Vec3d from = Vec3d(x) - a;
        const double off = from.dot(axis) - along;
        const double out = (from - from.dot(axis) * axis).length() - radius;
        EXPECT_LT(std::hypot(off, out), 1e-3); // of the exact circle [Å]
    }
    for (const auto& t : crisp.triangles) {
        EXPECT_EQ(crisp.colors[t[0]], crisp.colors[t[1]]);
        EXPECT_EQ(crisp.colors[t[0]], crisp.colors[t[2]]);
    }
    EXPECT_NEAR(areaOf(crisp), areaOf(mesh), 5e-3 * areaOf(mesh));
    EXPECT_LT(turnedAreaOf(crisp), 1e-3 * areaOf(mesh));
}

TEST(CrispBorders, ThreeBallsMeetInPoints)
{
    const std::vector<Ball> balls = {
        {Vec3f(0, 0, 0), 2.2f, 0}, {Vec3f(2.4f, 0, 0), 2.0f, 1}, {Vec3f(1.1f, 2.1f, 0), 1.8f, 2}};
    const Mesh mesh = surfaceOf(balls, SurfaceKind::SolventExcluded);
    const Mesh crisp =
        withCrispBorders(mesh, colorOwners(balls, {red, green, blue}), 0.0, "", Progress());
    std::size_t meetings = 0;
    for (const auto& [x, colors] : bordersOf(crisp)) {
        std::map<double, Color> powers;
        const Color all[] = {red, green, blue};
        for (std::size_t i = 0; i < 3; ++i) {
            const double r = double(balls[i].radius);
            powers[(Vec3d(x) - Vec3d(balls[i].center)).lengthSqr() - r * r] = all[i];
        }
        const auto first = powers.begin(), second = std::next(first), last = std::next(second);
        EXPECT_NEAR(first->first, second->first, 0.02); // [Å^2]
        EXPECT_TRUE(colors.count(first->second) && colors.count(second->second));
        if (colors.size() < 3) continue;
        ++meetings;
        EXPECT_NEAR(first->first, last->first, 0.05);
    }
    EXPECT_EQ(meetings, 2u); // above and below the plane of the centres
    EXPECT_NEAR(areaOf(crisp), areaOf(mesh), 5e-3 * areaOf(mesh));
    EXPECT_LT(turnedAreaOf(crisp), 1e-3 * areaOf(mesh));
}

TEST(CrispBorders, KeepWhatVerticesHave)
{
    const std::vector<Ball> balls = {{Vec3f(0, 0, 0), 2.0f, 0}, {Vec3f(2.5f, 0, 0), 2.0f, 1}};
    const Mesh mesh = surfaceOf(balls, SurfaceKind::SolventExcluded);
    const Mesh one = withCrispBorders(mesh, colorOwners(balls, {red, red}), 0.0, "", Progress());
    EXPECT_EQ(one.triangles, mesh.triangles);
    EXPECT_EQ(one.colors, std::vector<Color>(mesh.positions.size(), red));
    const Mesh two = withCrispBorders(mesh, colorOwners(balls, {red, blue}), 0.0, "", Progress());
    ASSERT_EQ(two.labels.size(), mesh.labels.size());
    for (std::size_t v = 0; v < two.positions.size(); ++v) {
        if (v < mesh.positions.size()) {
            EXPECT_EQ(two.positions[v], mesh.positions[v]);
        }
        EXPECT_EQ(two.labels[0].values[v], two.colors[v] == red ? 0 : 1); // atom_id
        EXPECT_NEAR(two.normals[v].length(), 1.0f, 1e-5f);
    }
    for (const auto& scalar : two.scalars) EXPECT_EQ(scalar.values.size(), two.positions.size());
}

/// Balls around an axis along z, which passes no vertex of the meshes here.
const Vec3d axis(0.3, 0.05, 0.0);
std::vector<Ball> around(int count)
{
    std::vector<Ball> balls;
    for (int i = 0; i < count; ++i) {
        const double angle = 2.0 * M_PI * i / count + 1.1;
        balls.push_back({axis + 4.0 * Vec3d(std::cos(angle), std::sin(angle), 0.0), 2.0, i});
    }
    return balls;
}

// The arcs that the normals of a sphere imply lie on it, to a quarter of their rise.
TEST(CrispBorders, LieOnTheArcs)
{
    const Mesh mesh = surfaceOf({{Vec3f(0.0f), 3.0f, 0}}, SurfaceKind::VanDerWaals);
    const Color all[] = {red, green, blue};
    for (const int owners : {2, 3}) {
        const Mesh crisp = withCrispBorders(mesh, colorOwners(around(owners), {all, all + owners}),
                                            0.0, "", Progress());
        std::size_t meetings = 0;
        for (const auto& [x, colors] : bordersOf(crisp)) {
            EXPECT_NEAR(x.length(), 3.0, 0.01);
            if (owners == 2) { // the plane between them
                EXPECT_NEAR((Vec3d(x) - axis).dot(around(2)[0].center - axis), 0.0, 1e-3);
            }
            if (colors.size() < 3) continue;
            ++meetings;
            EXPECT_NEAR(std::hypot(x.x() - axis.x(), x.y() - axis.y()), 0.0, 1e-3);
        }
        EXPECT_EQ(meetings, owners == 2 ? 0u : 2u);
    }
}

// A point where three owners meet may lie just outside of the triangle that has all of them.
TEST(CrispBorders, MeetWhereTheirOwnersDo)
{
    const Mesh mesh = surfaceOf({{Vec3f(0.0f), 3.0f, 0}}, SurfaceKind::VanDerWaals);
    double worst = 0.0, sum = 0.0;
    std::size_t meetings = 0;
    for (int n = 0; n < 100; ++n) {
        const Vec3d shift(0.013 * n, 0.007 * (n % 10), 0.0);
        std::vector<Ball> balls = around(3);
        for (Ball& ball : balls) ball.center += shift;
        const Mesh crisp =
            withCrispBorders(mesh, colorOwners(balls, {red, green, blue}), 0.0, "", Progress());
        for (const auto& [x, colors] : bordersOf(crisp)) {
            if (colors.size() < 3) continue;
            const Vec3d off = Vec3d(x) - axis - shift;
            worst = std::max(worst, std::hypot(off.x(), off.y()));
            sum += std::hypot(off.x(), off.y());
            ++meetings;
        }
    }
    EXPECT_GT(meetings, 150u);
    EXPECT_LT(worst, 0.35); // [Å]; the middle of its triangle is 0.7 Å off
    EXPECT_LT(sum / double(meetings), 0.07);
}

TEST(CrispBorders, HaveMeansOfNormalsAndScalarsButStepsOfWhatBelongsToASide)
{
    Mesh mesh = surfaceOf({{Vec3f(0.0f), 3.0f, 0}}, SurfaceKind::VanDerWaals);
    const std::vector<Ball> balls = around(3);
    mesh.scalars = {{"height", {}}, {"side", {}}};
    const auto colored =
        withCrispBorders(mesh, colorOwners(balls, {red, green, blue}), 0.0, "", Progress());
    const auto sideOf = [](const Color& c) { return c == red ? 1.0f : c == green ? 2.0f : 5.0f; };
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        mesh.scalars[0].values.push_back(mesh.positions[v].z());
        mesh.scalars[1].values.push_back(sideOf(colored.colors[v]));
    }
    const Mesh crisp =
        withCrispBorders(mesh, colorOwners(balls, {red, green, blue}), 0.0, "side", Progress());
    EXPECT_GT(crisp.positions.size(), mesh.positions.size() + 30);
    for (std::size_t v = 0; v < crisp.positions.size(); ++v) {
        EXPECT_EQ(crisp.scalars[1].values[v], sideOf(crisp.colors[v]));
        EXPECT_NEAR(crisp.scalars[0].values[v], crisp.positions[v].z(), 0.12); // rise of an arc
        EXPECT_GT(crisp.normals[v].dot(crisp.positions[v].unit()), 0.9995f);
    }
}

// The neck that a probe leaves is far from the circle in which the balls meet.
TEST(CrispBorders, StayWhereNoCreaseIsNear)
{
    const std::vector<Ball> balls = {{Vec3f(0, 0, 0), 2.0f, 0}, {Vec3f(2.5f, 0, 0), 2.0f, 1}};
    const Mesh mesh = surfaceOf(balls, SurfaceKind::SolventExcluded);
    const auto cut = [&](double crease) {
        return withCrispBorders(mesh, colorOwners(balls, {red, blue}), crease, "", Progress())
            .positions;
    };
    EXPECT_EQ(cut(0.02), cut(0.0));
    EXPECT_NE(cut(1.0), cut(0.0));
}

} // namespace
} // namespace molsurf
