// SPDX-License-Identifier: MPL-2.0

#include "molsurf/kernel/mesh/specks.h"

#include "molsurf/kernel/mesh/topology.h"
#include <openvdb/tools/LevelSetSphere.h>
#include <openvdb/tools/VolumeToMesh.h>

#include <cmath>

namespace molsurf::test
{
namespace
{

using openvdb::Coord;
using openvdb::Vec3d;
using openvdb::Vec3f;

constexpr double voxel = 0.5;

/// The mesh of a level set, with normals by its gradient.
Mesh meshOf(const openvdb::FloatGrid& grid)
{
    openvdb::tools::VolumeToMesh mesher;
    mesher(grid);
    Mesh mesh;
    for (std::size_t i = 0; i < mesher.pointListSize(); ++i)
        mesh.positions.emplace_back(mesher.pointList()[i]);
    for (std::size_t n = 0; n < mesher.polygonPoolListSize(); ++n) {
        const auto& pool = mesher.polygonPoolList()[n];
        for (std::size_t i = 0; i < pool.numQuads(); ++i) {
            const auto& q = pool.quad(i);
            mesh.triangles.push_back({q[3], q[2], q[1]});
            mesh.triangles.push_back({q[3], q[1], q[0]});
        }
    }
    mesh.normals.resize(mesh.positions.size(), Vec3f(0.0f));
    for (const auto& t : mesh.triangles) {
        const Vec3f a = mesh.positions[t[0]];
        for (const std::uint32_t v : t)
            mesh.normals[v] += (mesh.positions[t[1]] - a).cross(mesh.positions[t[2]] - a);
    }
    for (Vec3f& n : mesh.normals) n.normalize();
    return mesh;
}

openvdb::FloatGrid::Ptr ball()
{
    return openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(4.0f, Vec3f(0.0f), voxel, 6.0f);
}

MeshPieces piecesOf(const Mesh& mesh)
{
    return molsurf::piecesOf(mesh, Progress());
}

bool isClear(const openvdb::FloatGrid& grid)
{
    return isClearOfSpecks(fromGrid(grid), Progress());
}

TEST(Specks, NothingGoesWhereThereIsNone)
{
    const auto grid = ball();
    Mesh mesh = meshOf(*grid);
    MeshPieces pieces = piecesOf(mesh);
    const std::size_t before = mesh.triangles.size();
    EXPECT_FALSE(dropSpecks(pieces, *grid, mesh).has_value());
    EXPECT_EQ(mesh.triangles.size(), before);
    EXPECT_TRUE(isClear(*grid));
}

TEST(Specks, AreSeenWithoutAMesh)
{
    for (const int place : {4, 12}) {
        for (const float depth :
             {0.01f, 0.29f, 0.31f}) { // of one voxel [Å], below 0.6 of it or not
            const auto grid = ball();
            const Coord at(place, 1, 0);
            const float side = grid->getConstAccessor().getValue(at) < 0.0f ? 1.0f : -1.0f;
            grid->getAccessor().setValue(at, side * depth);
            EXPECT_EQ(isClear(*grid), depth > 0.3f) << place << " " << depth;
            grid->getAccessor().setValue(Coord(place, 2, 0), side * 0.02f); // beside it
            EXPECT_EQ(isClear(*grid), depth > 0.3f) << place << " " << depth;
        }
    }
    // As deep as a piece has to be, but of a few triangles.
    const auto grid = ball();
    for (auto value = grid->beginValueOn(); value; ++value) value.setValue(0.5f);
    grid->getAccessor().setValue(Coord(4, 1, 0), -0.4f);
    EXPECT_FALSE(isClear(*grid));
}

// One voxel of the other sign, inside and outside of a ball, with values that leave a speck.
TEST(Specks, GoFromMeshAndLevelSet)
{
    for (const int place : {4, 12}) {
        const auto grid = ball();
        const Coord at(place, 1, 0);
        const float side = grid->getConstAccessor().getValue(at) < 0.0f ? 1.0f : -1.0f;
        const std::size_t clean = meshOf(*grid).triangles.size();
        grid->getAccessor().setValue(at, side * 0.01f);
        Mesh mesh = meshOf(*grid);
        MeshPieces pieces = piecesOf(mesh);
        ASSERT_EQ(pieces.measures.size(), 2u) << place;
        ASSERT_LT(std::abs(pieces.measures[1].volume), 0.1 * std::pow(voxel, 3));
        const std::size_t vertices = mesh.positions.size();
        const auto stays = dropSpecks(pieces, *grid, mesh);
        ASSERT_TRUE(stays.has_value());
        EXPECT_EQ(stays->size(), vertices);
        EXPECT_EQ(std::count(stays->begin(), stays->end(), 1), long(mesh.positions.size()));
        EXPECT_LT(mesh.positions.size(), vertices);
        EXPECT_EQ(pieces.measures.size(), 1u);
        EXPECT_EQ(pieces.of.size(), mesh.positions.size());
        const double area = piecesOf(mesh).triangles.area;
        EXPECT_NEAR(pieces.triangles.area, area, 1e-9 * area);
        EXPECT_EQ(mesh.triangles.size(), clean) << place;
        EXPECT_TRUE(checkTopology(mesh, Progress()).closed);
        // The level set alone gives the same mesh.
        EXPECT_LT(side * grid->getConstAccessor().getValue(at), 0.0f);
        EXPECT_EQ(meshOf(*grid).triangles.size(), clean) << place;
    }
}

// As in an accessible surface on coarse voxels: the mesh of the file would lack the cavity.
TEST(Specks, LeaveACavityBesideThem)
{
    const auto grid = ball();
    grid->getAccessor().setValue(Coord(4, 1, 0), 0.01f);
    for (const Coord& at : {Coord(6, 1, 0), Coord(6, 2, 0)}) grid->getAccessor().setValue(at, 0.4f);
    Mesh mesh = meshOf(*grid);
    MeshPieces pieces = piecesOf(mesh);
    ASSERT_EQ(pieces.measures.size(), 3u);
    // Vertices slide along the surface: those of the speck come near the cavity.
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        Vec3f& x = mesh.positions[v];
        if ((x / float(voxel) - Vec3f(4, 1, 0)).length() < 1.0f) x[0] += 0.4f * float(voxel);
    }
    ASSERT_TRUE(dropSpecks(pieces, *grid, mesh).has_value());
    EXPECT_EQ(pieces.measures.size(), 2u);
    EXPECT_EQ(meshOf(*grid).triangles.size(), mesh.triangles.size());
}

TEST(Specks, NothingIsLeftOfASpeckAlone)
{
    const auto grid = ball();
    for (auto value = grid->beginValueAll(); value; ++value) value.setValue(0.5f);
    grid->getAccessor().setValue(Coord(0), -0.01f);
    Mesh mesh = meshOf(*grid);
    MeshPieces pieces = piecesOf(mesh);
    ASSERT_EQ(pieces.measures.size(), 1u);
    const auto stays = dropSpecks(pieces, *grid, mesh);
    ASSERT_TRUE(stays.has_value());
    EXPECT_EQ(std::count(stays->begin(), stays->end(), 1), 0);
    EXPECT_TRUE(mesh.positions.empty() && mesh.triangles.empty() && pieces.measures.empty());
}

TEST(Specks, ACavityOfSomeVoxelsStays)
{
    const auto grid = ball();
    for (auto ijk = openvdb::CoordBBox(Coord(-1), Coord(1)).begin(); ijk; ++ijk)
        grid->getAccessor().setValue(*ijk, 0.4f);
    Mesh mesh = meshOf(*grid);
    MeshPieces pieces = piecesOf(mesh);
    ASSERT_EQ(pieces.measures.size(), 2u);
    EXPECT_FALSE(dropSpecks(pieces, *grid, mesh).has_value());
}

TEST(Specks, APieceThatIsCutOpenStays)
{
    const auto grid = ball();
    Mesh mesh = meshOf(*grid);
    mesh.triangles.resize(1); // a triangle alone has no volume about its corner
    mesh.positions.resize(
        std::size_t(std::max({mesh.triangles[0][0], mesh.triangles[0][1], mesh.triangles[0][2]})) +
        1);
    mesh.normals.resize(mesh.positions.size());
    MeshPieces pieces = piecesOf(mesh);
    dropSpecks(pieces, *grid, mesh);
    EXPECT_EQ(mesh.triangles.size(), 1u);
}

// Three tetrahedra, a part each: what stays keeps its values, its part and its corners.
TEST(RemovePieces, LeavesPartsAndValuesOfOthers)
{
    Mesh mesh;
    for (std::uint32_t k = 0; k < 3; ++k) {
        mesh.parts.push_back({std::string(1, char('a' + k)), mesh.triangles.size()});
        const std::uint32_t v = 4 * k;
        for (const Vec3f& x : {Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 1, 0), Vec3f(0, 0, 1)})
            mesh.positions.push_back(x + Vec3f(3.0f * float(k), 0.0f, 0.0f));
        mesh.triangles.insert(
            mesh.triangles.end(),
            {{v, v + 2, v + 1}, {v, v + 1, v + 3}, {v, v + 3, v + 2}, {v + 1, v + 2, v + 3}});
    }
    mesh.normals = mesh.positions;
    mesh.scalars.push_back({"x", {}});
    for (const Vec3f& p : mesh.positions) mesh.scalars[0].values.push_back(p[0]);
    const MeshPieces pieces = piecesOf(mesh);
    ASSERT_EQ(pieces.measures.size(), 3u);
    for (std::uint32_t away = 0; away < 3; ++away) {
        Mesh left = mesh;
        std::vector<char> gone(3, 0);
        gone[pieces.of[4 * away]] = 1;
        const std::vector<char> stays = removePieces(pieces, gone, left);
        EXPECT_EQ(std::count(stays.begin(), stays.end(), 1), 8);
        ASSERT_EQ(left.positions.size(), 8u);
        ASSERT_EQ(left.triangles.size(), 8u);
        ASSERT_EQ(left.parts.size(), 3u);
        for (std::uint32_t k = 0; k < 3; ++k) {
            EXPECT_EQ(left.parts[k].firstTriangle, 4 * (k - (k > away))) << away;
            if (k == away) continue;
            const std::uint32_t first = left.triangles[left.parts[k].firstTriangle][0];
            EXPECT_EQ(left.positions[first][0], 3.0f * float(k));
            EXPECT_EQ(left.scalars[0].values[first], 3.0f * float(k));
        }
    }
}

} // namespace
} // namespace molsurf::test
