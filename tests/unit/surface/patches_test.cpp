// SPDX-License-Identifier: MPL-2.0
// Patches: parts of triangles by sampling, and caps of a ball by Archimedes' formula. Means of
// values over caps.
#include "molsurf/analysis/measures/patches.h"

#include "molsurf/analysis/measures/smooth_values.h"

#include "molsurf/error.h"
#include "molsurf/surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace molsurf::test
{
namespace
{

constexpr double radius = 5.0;

Mesh ballMesh(const openvdb::Vec3d& centre)
{
    SurfaceOptions options;
    options.kind = SurfaceKind::VanDerWaals;
    return makeSurface({{centre, radius, 0}}, options).mesh;
}

template<typename Of>
std::vector<float> valuesOf(const Mesh& mesh, const Of& of)
{
    std::vector<float> out;
    for (const auto& x : mesh.positions) out.push_back(float(of(x)));
    return out;
}

FoundPatches found(const Mesh& mesh, const std::vector<float>& values, double level,
                   bool above = true)
{
    return findPatches(mesh, values, {ColorBy::Value, above, level},
                       std::vector<std::int32_t>(mesh.positions.size(), 0));
}

TEST(SharesAbove, AreIntegralsOfBarycentricCoordinates)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    constexpr int n = 600; // rows of equal triangles, each taken at its middle
    for (int k = 0; k < 12; ++k) {
        const std::array<double, 3> v = {any(random), any(random), any(random)};
        const double level = 0.5 * any(random);
        std::array<double, 3> sums = {};
        const auto add = [&](double a, double b) {
            const std::array<double, 3> at = {a, b, 1.0 - a - b};
            if (at[0] * v[0] + at[1] * v[1] + at[2] * v[2] <= level) return;
            for (std::size_t c = 0; c < 3; ++c) sums[c] += at[c] / (n * n);
        };
        for (int i = 0; i < n; ++i) {
            for (int j = 0; i + j < n; ++j) {
                add((i + 1.0 / 3.0) / n, (j + 1.0 / 3.0) / n);
                if (i + j + 1 < n) add((i + 2.0 / 3.0) / n, (j + 2.0 / 3.0) / n);
            }
        }
        const auto shares = sharesAbove(v, level);
        const auto rest = sharesAbove({-v[0], -v[1], -v[2]}, -level);
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(shares[c], sums[c], 2e-3) << k << " " << c;
            EXPECT_NEAR(shares[c] + rest[c], 1.0 / 3.0, 1e-15) << k << " " << c;
        }
    }
}

TEST(Patches, OfABallAreCaps)
{
    const Mesh mesh = ballMesh({0.3, -0.2, 0.1});
    constexpr double level = 2.0;
    const auto height = [](const auto& x) { return x[2] - 0.1; };
    const FoundPatches caps =
        found(mesh, valuesOf(mesh, [&](const auto& x) { return std::abs(height(x)); }), level);
    ASSERT_EQ(caps.list.size(), 2u);
    const double area = 2.0 * M_PI * radius * (radius - level), middle = 0.5 * (radius + level);
    for (const auto& cap : caps.list) {
        EXPECT_NEAR(cap.area, area, 4e-3 * area);
        EXPECT_NEAR(cap.integral, middle * cap.area, 4e-3 * middle * area);
        EXPECT_NEAR(std::abs(cap.centre[2] - 0.1), middle, 0.01);
        EXPECT_NEAR(cap.centre[0], 0.3, 0.01);
        ASSERT_EQ(cap.parts.size(), 1u);
        EXPECT_NEAR(cap.parts[0].area, cap.area, 1e-9);
    }
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        EXPECT_EQ(caps.patchOf[v] > 0, std::abs(float(height(mesh.positions[v]))) > level);
}

TEST(Patches, AboveAndBelowAddUpToTheMesh)
{
    const Mesh mesh = ballMesh(openvdb::Vec3d(0.0));
    const auto values = valuesOf(mesh, [](const auto& x) { return std::sin(2.0 * x[0]) + x[1]; });
    double sum = 0.0, integral = 0.0, area = 0.0, whole = 0.0;
    for (const bool above : {true, false}) {
        for (const auto& patch : found(mesh, values, 0.3, above).list) {
            sum += patch.area;
            integral += patch.integral;
        }
    }
    for (const auto& t : mesh.triangles) {
        const openvdb::Vec3d a(mesh.positions[t[0]]), b(mesh.positions[t[1]]),
            c(mesh.positions[t[2]]);
        const double one = 0.5 * (b - a).cross(c - a).length();
        area += one;
        whole += one * (double(values[t[0]]) + double(values[t[1]]) + double(values[t[2]])) / 3.0;
    }
    EXPECT_NEAR(sum, area, 1e-9 * area);
    EXPECT_NEAR(integral, whole, 1e-9 * area);
}

// A belt without a value parts two caps, and no area of it counts.
TEST(Patches, EndWhereThereIsNoValue)
{
    const Mesh mesh = ballMesh(openvdb::Vec3d(0.0));
    const auto values = valuesOf(mesh, [](const auto& x) {
        return std::abs(x[2]) < 1.0 ? std::numeric_limits<double>::quiet_NaN() : 1.0;
    });
    const FoundPatches caps = found(mesh, values, 0.0);
    ASSERT_EQ(caps.list.size(), 2u);
    const double most = 2.0 * M_PI * radius * (radius - 1.0);
    for (const auto& cap : caps.list) {
        EXPECT_LT(cap.area, most);
        EXPECT_GT(cap.area, 0.85 * most);
        EXPECT_NEAR(cap.integral, cap.area, 1e-9);
    }
    EXPECT_TRUE(found(mesh, values, 0.0, false).list.empty());
}

// A cap of a chord D has the height h = D^2 / 2R, and its mean height is R - h/2 from the centre.
TEST(SmoothValues, AreMeansOfCaps)
{
    const Mesh mesh = ballMesh(openvdb::Vec3d(0.0));
    for (const double within : {1.0, 2.0, 4.0}) {
        auto values = valuesOf(mesh, [](const auto& x) { return x[2]; });
        smoothValues(mesh, within, Progress(), values);
        const double share = 1.0 - within * within / (4.0 * radius * radius);
        for (std::size_t v = 0; v < values.size(); ++v)
            ASSERT_NEAR(values[v], share * double(mesh.positions[v][2]), 0.06) << within;
    }
}

TEST(SmoothValues, StayOnTheirPieceAndWhereThereAreSome)
{
    Mesh mesh = ballMesh(openvdb::Vec3d(0.0));
    const Mesh other = ballMesh({2.0 * radius + 0.2, 0.0, 0.0});
    const auto first = std::uint32_t(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
    for (auto t : other.triangles)
        mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    std::vector<float> values(first, 1.0f);
    values.resize(mesh.positions.size(), 3.0f);
    values[7] = std::numeric_limits<float>::quiet_NaN();
    smoothValues(mesh, 3.0, Progress(), values);
    for (std::size_t v = 0; v < values.size(); ++v) {
        if (v == 7)
            EXPECT_TRUE(std::isnan(values[v]));
        else
            ASSERT_FLOAT_EQ(values[v], v < first ? 1.0f : 3.0f) << v;
    }
}

TEST(SmoothValues, AreThoseOfColoursAndPatches)
{
    BallSet atoms;
    atoms.balls = {{openvdb::Vec3d(0.0), 3.0, 0}, {{4.0, 0.0, 0.0}, 2.0, 1}};
    SurfaceOptions options;
    options.color = ColorBy::GaussianCurvature;
    options.patches = {ColorBy::GaussianCurvature, false, 0.0};
    const MolecularSurface rough = makeSurface(atoms, options);
    options.smoothColors = 3.0;
    const MolecularSurface made = makeSurface(atoms, options);
    const auto range = [](const MolecularSurface& of) {
        const auto& values = of.mesh.scalars[1].values;
        const auto [low, high] = std::minmax_element(values.begin(), values.end());
        return *high - *low;
    };
    EXPECT_LT(range(made), 0.6f * range(rough));
    EXPECT_EQ(made.report.surface.gaussianCurvature.min,
              rough.report.surface.gaussianCurvature.min);
    EXPECT_EQ(rough.report.patches->list.size(), 1u);
    EXPECT_TRUE(made.report.patches->list.empty()); // the neck is narrow
    options.color = ColorBy::Nothing;
    EXPECT_TRUE(makeSurface(atoms, options).report.patches->list.empty());
    options.smoothColors = 0.4;
    EXPECT_THROW(makeSurface(atoms, options), Error);
    options.smoothColors = 3.0;
    options.color = ColorBy::GaussianCurvature;
    options.fields = {"Cd"};
    EXPECT_THROW(makeSurface(atoms, options), Error);
}

TEST(Patches, NeedARuleAndValues)
{
    BallSet atoms;
    atoms.balls = {{openvdb::Vec3d(0.0), 1.5, 0}};
    SurfaceOptions options;
    options.color = ColorBy::Patch;
    EXPECT_THROW(makeSurface(atoms, options), Error);
    options.patches = Products::PatchRule();
    EXPECT_THROW(makeSurface(atoms, options), Error);
    options.patches = {ColorBy::MeanCurvature, true, 0.1};
    const MolecularSurface made = makeSurface(atoms, options);
    ASSERT_EQ(made.report.patches->list.size(), 1u);
    EXPECT_NEAR(made.report.patches->list[0].integral, 4.0 * M_PI * 1.5, 0.5);
    EXPECT_EQ(made.mesh.labels.back().name, "patch");
}

} // namespace
} // namespace molsurf::test
