// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/pocket_meshes.h"

#include "molsurf/analysis/proximity/deviation.h"
#include "molsurf/kernel/core/cancel.h"
#include "molsurf/kernel/mesh/volume_mesher.h"
#include "molsurf/surface/pockets.h"

#include <cmath>

namespace molsurf
{

namespace
{

using openvdb::Coord;

/// The voxels of each pocket.
std::vector<std::vector<Coord>> voxelsOf(const openvdb::Int32Grid& ids, std::size_t count)
{
    std::vector<std::vector<Coord>> out(count);
    for (auto voxel = ids.cbeginValueOn(); voxel; ++voxel)
        out.at(std::size_t(*voxel) - 1).push_back(voxel.getCoord());
    return out;
}

/// A field whose zero set is the boundary of one pocket: minus the room at its voxels, and the size
/// of the room at their 26 neighbours. It is 0 at the wall, where the room is, and between voxels
/// of two pockets, at a place by the ratio of their rooms.
openvdb::FloatGrid::Ptr insideOf(const std::vector<Coord>& own, std::int32_t id,
                                 const openvdb::Int32Grid& ids, const openvdb::FloatGrid& rooms)
{
    const auto out = openvdb::FloatGrid::create(float(rooms.voxelSize()[0]));
    out->setTransform(rooms.transform().copy());
    out->setGridClass(openvdb::GRID_LEVEL_SET); // else triangles are seen from inside
    const auto idAt = ids.getConstUnsafeAccessor();
    const auto roomAt = rooms.getConstUnsafeAccessor();
    auto to = out->getUnsafeAccessor();
    for (const Coord& voxel : own)
        for (int k = 0; k < 27; ++k) {
            const Coord at = voxel.offsetBy(k / 9 - 1, k / 3 % 3 - 1, k % 3 - 1);
            const float room = roomAt.getValue(at);
            to.setValue(at, idAt.getValue(at) == id ? -room : std::abs(room));
        }
    return out;
}

/// Meshes the zero set of a field, and adds it. Quads are cut along their shorter diagonal.
void addBody(const openvdb::FloatGrid& field, Mesh& mesh)
{
    openvdb::tools::VolumeToMesh mesher;
    meshVolume(field, mesher);
    const auto first = std::uint32_t(mesh.positions.size());
    for (std::size_t i = 0; i < mesher.pointListSize(); ++i)
        mesh.positions.emplace_back(mesher.pointList()[i]);
    const auto squared = [&](std::uint32_t a, std::uint32_t b) {
        return (mesh.positions[a] - mesh.positions[b]).lengthSqr();
    };
    for (std::size_t n = 0; n < mesher.polygonPoolListSize(); ++n) {
        const auto& pool = mesher.polygonPoolList()[n];
        for (std::size_t i = 0; i < pool.numQuads(); ++i) {
            // OpenVDB's polygons run clockwise seen from outside.
            const auto& q = pool.quad(i);
            const std::uint32_t a = first + q[3], b = first + q[2], c = first + q[1],
                                d = first + q[0];
            const bool byAC = squared(a, c) <= squared(b, d);
            mesh.triangles.push_back(byAC ? std::array{a, b, c} : std::array{a, b, d});
            mesh.triangles.push_back(byAC ? std::array{a, c, d} : std::array{b, c, d});
        }
    }
}

} // namespace

Mesh pocketBodies(const Pockets& pockets, const Progress& progress)
{
    const std::vector<PocketReport>& list = pockets.list;
    const std::vector<std::vector<Coord>> voxels = voxelsOf(*pockets.ids, list.size());
    Mesh mesh;
    for (std::size_t p = 0; p < list.size(); ++p) {
        stopIfCancelled(progress);
        mesh.parts.push_back({pocketName(p + 1, list[p].volume), mesh.triangles.size()});
        addBody(*insideOf(voxels[p], std::int32_t(p + 1), *pockets.ids, *pockets.rooms), mesh);
        mesh.colors.resize(mesh.positions.size(), pocketColor(p + 1));
    }
    mesh.normals = vertexNormals(mesh);
    return mesh;
}

} // namespace molsurf
