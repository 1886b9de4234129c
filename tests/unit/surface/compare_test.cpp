// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/measures/compare.h"

#include "molsurf/error.h"
#include "molsurf/kernel/pipeline/derived_grids.h"
#include "support/fields.h"
#include "support/runs.h"
#include "support/solids.h"

#include <gtest/gtest.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <cmath>

namespace molsurf
{
namespace
{

using openvdb::FloatGrid;
using openvdb::Vec3d;
using openvdb::Vec3f;

const Vec3d centre(0.13, 0.29, 0.41);

FloatGrid::Ptr sphereGrid(double radius, const Vec3d& at, double voxel, const char* name,
                          double width = 3.0)
{
    auto grid = openvdb::tools::createLevelSetSphere<FloatGrid>(float(radius), Vec3f(at),
                                                                float(voxel), float(width));
    grid->setName(name);
    return grid;
}

std::string errorOf(const openvdb::GridPtrVec& grids)
{
    try {
        operandOf(grids, Progress());
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::Input);
        return e.what();
    }
    return "";
}

#define EXPECT_SAYS(grids, words)                                                                  \
    EXPECT_NE(errorOf(grids).find(words), std::string::npos) << errorOf(grids)

Comparison compared(const Operand& a, const Operand& b)
{
    Progress progress;
    const DistanceTo toA(a.surface), toB(b.surface);
    return compare(a, toA, b, toB, progress);
}

TEST(OperandOfGrids, TwoBallsAreExact)
{
    const Vec3d shift(0.7, -0.2, 0.3);
    const Operand a = operandOf({sphereGrid(4.0, centre, 0.25, "surface")}, Progress());
    const Operand b = operandOf({sphereGrid(3.0, centre + shift, 0.25, "surface")}, Progress());
    EXPECT_EQ(a.kind, "level set");
    EXPECT_EQ(a.voxel, 0.25);
    EXPECT_TRUE(a.surface.closed && a.warnings.empty());
    EXPECT_NEAR(a.size.area, 64.0 * M_PI, 1e-2);
    EXPECT_NEAR(a.size.volume.value(), 256.0 * M_PI / 3.0, 1e-2);
    const Comparison both = compared(a, b);
    for (std::size_t v = 0; v < a.surface.mesh.positions.size(); ++v) {
        const double exact = (Vec3d(a.surface.mesh.positions[v]) - centre - shift).length() - 3.0;
        ASSERT_NEAR(both.aToB.signedDistance[v], exact, 1e-4);
    }
    EXPECT_NEAR(both.hausdorff, 4.0 - 3.0 + shift.length(), 2e-3);
    EXPECT_EQ(both.hausdorff, std::max(both.aToB.max, both.bToA.max));
    EXPECT_LT(compared(a, a).hausdorff, 1e-5);
}

// The spline needs four voxels; what the file lacks is made up for.
TEST(OperandOfGrids, ANarrowBand)
{
    const Operand a = operandOf({sphereGrid(4.0, centre, 0.25, "surface", 2.0)}, Progress());
    for (const Vec3f& p : a.surface.mesh.positions)
        ASSERT_NEAR((Vec3d(p) - centre).length(), 4.0, 2e-3);
}

TEST(OperandOfGrids, ShiftedAndTurned)
{
    const auto grid = sphereGrid(2.0, Vec3d(2.2, 0.3, -1.1), 0.25, "any name");
    grid->transform().postRotate(0.7, openvdb::math::Z_AXIS);
    grid->transform().postTranslate(Vec3d(0.05, 10.0, -7.0));
    const Vec3d at(2.2 * std::cos(0.7) + 0.3 * std::sin(0.7) + 0.05,
                   -2.2 * std::sin(0.7) + 0.3 * std::cos(0.7) + 10.0, -8.1);
    const Operand moved = operandOf({grid}, Progress());
    Vec3d mean(0.0);
    for (const Vec3f& p : moved.surface.mesh.positions)
        mean += Vec3d(p) / double(moved.surface.mesh.positions.size());
    // Whichever way the library turns, the distance from the turned centre is the radius.
    const Vec3d back(2.2 * std::cos(0.7) - 0.3 * std::sin(0.7) + 0.05,
                     2.2 * std::sin(0.7) + 0.3 * std::cos(0.7) + 10.0, -8.1);
    const Vec3d centreNow = (mean - at).length() < (mean - back).length() ? at : back;
    const DistanceTo to(moved.surface);
    DistanceTo::Query query(to);
    for (const Vec3f& p : moved.surface.mesh.positions)
        ASSERT_NEAR((Vec3d(p) - centreNow).length(), 2.0, 1e-4);
    const Distance far = query.at(centreNow + Vec3d(3.0, 4.0, 12.0));
    EXPECT_NEAR(far.value, 11.0, 1e-4);
    EXPECT_FALSE(far.inside);
    for (std::size_t v = 0; v < moved.surface.mesh.positions.size(); ++v)
        ASSERT_GT(moved.surface.mesh.normals[v].dot(
                      (moved.surface.mesh.positions[v] - Vec3f(centreNow)).unit()),
                  0.999f);
}

TEST(OperandOfGrids, WhichGridIsTaken)
{
    const auto one = sphereGrid(2.0, centre, 0.5, "one");
    const auto two = sphereGrid(3.0, centre, 0.5, "surface");
    const auto fog = sphereGrid(4.0, centre, 0.5, "fog");
    fog->setGridClass(openvdb::GRID_FOG_VOLUME);
    EXPECT_NEAR(operandOf({one, fog}, Progress()).size.area, 16.0 * M_PI, 0.1);
    EXPECT_NEAR(operandOf({one, two}, Progress()).size.area, 36.0 * M_PI, 0.1);
    EXPECT_SAYS({fog}, "expected a level set of type float, got none among 1 grids");
    EXPECT_SAYS({}, "got none among 0 grids");
    two->setName("two");
    EXPECT_SAYS((openvdb::GridPtrVec{one, two}), "got 2 level sets");
    fog->setName("surface");
    EXPECT_SAYS((openvdb::GridPtrVec{one, fog}), "expected class level set, got fog volume");
}

TEST(OperandOfGrids, ANameThatSeveralGridsHave)
{
    const auto one = sphereGrid(2.0, centre, 0.5, "surface");
    const auto two = sphereGrid(3.0, centre, 0.5, "surface");
    EXPECT_SAYS((openvdb::GridPtrVec{one, two}),
                "grid 'surface': expected one of this name, got 2");
    one->setName("spline");
    two->setName("spline");
    EXPECT_SAYS((openvdb::GridPtrVec{sphereGrid(2.0, centre, 0.5, "surface"), one, two}),
                "grid 'spline': expected one of this name, got 2");
}

TEST(OperandOfGrids, ASplineOfAnotherSurfaceIsLeftOut)
{
    const auto grid = sphereGrid(3.0, centre, 0.25, "surface");
    for (const auto& other :
         {sphereGrid(2.0, centre, 0.25, "other"), sphereGrid(3.0, Vec3d(9.0), 0.25, "other"),
          sphereGrid(3.0, Vec3d(1.0, 0.0, 0.0), 0.25, "other"),
          sphereGrid(3.03, centre, 0.25, "other"),
          sphereGrid(3.0, centre + Vec3d(0.05, 0.0, 0.0), 0.25, "other")}) {
        const auto spline = splineGrid(splineThrough(*other, Progress()));
        const Operand found = operandOf({grid, spline}, Progress());
        EXPECT_NEAR(found.size.area, 36.0 * M_PI, 0.1);
        ASSERT_EQ(found.warnings.size(), 1u);
        EXPECT_NE(found.warnings[0].find("of another surface than grid 'surface'"),
                  std::string::npos);
    }
    const auto own = splineGrid(splineThrough(*grid, Progress()));
    EXPECT_TRUE(operandOf({grid, own}, Progress()).warnings.empty());
}

TEST(OperandOfGrids, ValuesThatAreNoDistancesAreSaid)
{
    for (const float times : {0.1f, 0.7f, 1.0f, 1.5f, 10.0f}) {
        const auto grid = sphereGrid(3.0, centre, 0.25, "surface");
        for (auto it = grid->beginValueOn(); it; ++it) it.setValue(times * *it);
        const std::vector<std::string> warnings = operandOf({grid}, Progress()).warnings;
        ASSERT_EQ(warnings.size(), times == 1.0f ? 0u : 1u) << times;
        for (const std::string& warning : warnings)
            EXPECT_EQ(warning.find("grid 'surface': expected distances in Å"), 0u) << warning;
    }
}

TEST(OperandOfGrids, FarFromTheOrigin)
{
    for (const double shift : {1e7, 1.1e6}) {
        const auto moved = sphereGrid(5.0, centre, 0.5, "surface");
        moved->transform().postTranslate(Vec3d(0.0, -shift, 0.0));
        EXPECT_SAYS({moved}, "expected voxels within 1e6 Å of the origin, got one at 1");
        // The same by its voxels, in a frame of its own far from the origin.
        const auto own = moved->copy();
        own->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
        own->setTree(std::make_shared<openvdb::FloatTree>(3.0f));
        own->tree().setValue(openvdb::Coord(int(2.0 * shift), 0, 0), 0.5f);
        own->transform().postTranslate(Vec3d(-shift, 0.0, 0.0));
        EXPECT_SAYS({own}, "within 1e6 Å");
    }
    const auto near = sphereGrid(5.0, centre, 0.5, "surface");
    near->transform().postTranslate(Vec3d(9e5, 0.0, 0.0));
    const Operand found = operandOf({near}, Progress());
    EXPECT_NEAR(found.size.area, 100.0 * M_PI, 0.1);
    ASSERT_EQ(found.warnings.size(), 1u);
    EXPECT_NE(found.warnings[0].find("rounded to 0.11 Å"), std::string::npos) << found.warnings[0];
}

TEST(OperandOfGrids, BadGrids)
{
    auto grid = sphereGrid(2.0, centre, 0.5, "surface");
    grid->transform().preScale(Vec3d(1.0, 1.0, 2.0));
    EXPECT_SAYS({grid}, "expected voxels that are cubes");
    grid = sphereGrid(2.0, centre, 0.5, "surface");
    grid->transform().preScale(Vec3d(1.0, 1.0, -1.0));
    EXPECT_SAYS({grid}, "mirrored");
    grid = sphereGrid(2.0, centre, 0.5, "surface");
    grid->tree().clear();
    EXPECT_SAYS({grid}, "expected voxels, got none");
    grid = openvdb::createLevelSet<FloatGrid>(0.5, 3.0f);
    grid->tree().setValueOn(openvdb::Coord(1, 2, 3), 0.5f);
    EXPECT_SAYS({grid}, "got no surface");
    grid = sphereGrid(2.0, centre, 0.5, "surface");
    grid->beginValueOn().setValue(std::nanf(""));
    EXPECT_SAYS({grid}, "not a number");
    grid = sphereGrid(2.0, centre, 0.5, "surface");
    const auto spline = grid->deepCopy();
    spline->setName("spline");
    spline->transform().postTranslate(Vec3d(0.1));
    EXPECT_SAYS((openvdb::GridPtrVec{grid, spline}), "grids 'surface' and 'spline'");
}

// A run and what it leaves in a file are the same surface: exactly with the spline, nearly from the
// level set, which was made a distance again.
/// A tile of a few bytes would become 2^36 voxels.
// Found by fuzzing: the distances to such a surface were no numbers.
TEST(OperandOfGrids, ValuesHaveALimit)
{
    for (const float value : {1e7f, -3e38f}) {
        const auto grid = sphereGrid(3.0, centre, 0.5, "surface");
        grid->beginValueOn().setValue(value);
        EXPECT_SAYS({grid}, "a million voxels");
        const auto good = sphereGrid(3.0, centre, 0.5, "surface");
        const auto spline = sphereGrid(3.0, centre, 0.5, "spline");
        spline->tree().beginLeaf()->setValueOff(7, value);
        EXPECT_SAYS(openvdb::GridPtrVec({good, spline}), "a million voxels");
    }
}

TEST(OperandOfGrids, TilesAreNoBand)
{
    const auto grid = sphereGrid(3.0, centre, 0.5, "surface");
    grid->tree().addTile(3, openvdb::Coord(1 << 20), 0.1f, true);
    EXPECT_SAYS({grid}, "more voxels in tiles");
}

TEST(OperandOfResult, AgreesWithItsGrids)
{
    for (const int level : {0, 1}) {
        SurfaceOptions options;
        options.voxel = 0.5;
        options.splineLevel = level;
        options.fields = {"spline"};
        const std::vector<Ball> balls = {{{0.1f, 0.2f, 0.3f}, 1.7f, 0},
                                         {{1.5f, 0.4f, 0.1f}, 1.55f, 1}};
        MolecularSurface result = test::runOn(balls, options);
        const openvdb::GridPtrVec stored = {result.surface, result.fields.at(0)};
        const Operand structure = operandOf(std::move(result));
        EXPECT_EQ(structure.kind, "structure");
        EXPECT_EQ(structure.atoms, 2u);
        const Operand file = operandOf(stored, Progress());
        EXPECT_LT(compared(structure, file).hausdorff, 1e-5);
        EXPECT_NEAR(file.size.area, structure.size.area, 1e-3);
        const Operand refitted = operandOf({stored[0]}, Progress());
        EXPECT_LT(compared(structure, refitted).hausdorff, 0.02);
    }
}

TEST(OperandOfMesh, ClosedOpenAndInward)
{
    const Operand closed = operandOf(test::box({0, 0, 0}, {1, 2, 3}), Progress());
    EXPECT_EQ(closed.kind, "mesh");
    EXPECT_DOUBLE_EQ(closed.size.area, 22.0);
    EXPECT_DOUBLE_EQ(closed.size.volume.value(), 6.0);
    EXPECT_EQ(closed.surface.mesh.normals.size(), 8u);
    EXPECT_TRUE(closed.warnings.empty());

    Mesh open = test::box({0, 0, 0}, {1, 2, 3});
    open.triangles.pop_back();
    const Operand half = operandOf(open, Progress());
    EXPECT_FALSE(half.surface.closed || half.size.volume);
    ASSERT_EQ(half.warnings.size(), 1u);
    EXPECT_NE(half.warnings[0].find("open"), std::string::npos);

    Mesh inward = test::box({0, 0, 0}, {1, 2, 3});
    for (auto& t : inward.triangles) std::swap(t[0], t[1]);
    const Operand turned = operandOf(inward, Progress());
    EXPECT_DOUBLE_EQ(turned.size.volume.value(), 6.0);
    ASSERT_EQ(turned.warnings.size(), 1u);
    const DistanceTo to(turned.surface);
    EXPECT_TRUE(DistanceTo::Query(to).at(Vec3d(0.5, 0.5, 0.5)).inside);
}

TEST(LevelSetOf, AMesh)
{
    const Operand box = operandOf(test::box({0, 0, 0}, {4, 5, 6}), Progress());
    const auto grid = levelSetOf(box.surface, 0.25);
    EXPECT_EQ(grid->getName(), "surface");
    EXPECT_EQ(grid->getGridClass(), openvdb::GRID_LEVEL_SET);
    EXPECT_NEAR(grid->tree().getValue(openvdb::Coord(8, 8, 2)), -0.5f, 1e-5f);
    EXPECT_NEAR(grid->tree().getValue(openvdb::Coord(8, 8, -1)), 0.25f, 1e-5f);
    Operand open = operandOf(test::box({0, 0, 0}, {4, 5, 6}), Progress());
    open.surface.closed = false;
    EXPECT_THROW(levelSetOf(open.surface, 0.25), Error);
}

} // namespace
} // namespace molsurf
