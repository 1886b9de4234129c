// SPDX-License-Identifier: MPL-2.0
#include "molsurf/scale/bricks/brick.h"

#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/mesh/statistics.h"
#include "molsurf/kernel/mesh/topology.h"

#include <algorithm>

namespace molsurf
{

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::Vec3d;

namespace
{

constexpr std::uint32_t none = ~std::uint32_t(0);

/// Some elements of an array, in the order of their indices.
template<typename T>
std::vector<T> chosen(std::vector<T> all, const std::vector<std::uint32_t>& indices,
                      std::size_t count, const Progress& progress)
{
    std::vector<T> out(count);
    parallelFor(count, progress, [&](std::size_t i) { out[i] = all[indices[i]]; });
    return out;
}

/// The key of each vertex of the cells on either side of the brick's border; the others have none.
/// Its last number counts the vertices of a cell in the order of the mesh.
/// @param[out] keyed  the vertices that have a key
/// @return one key for each of them
std::vector<VertexKey> keysOf(const std::vector<Coord>& cells, const CoordBBox& box,
                              std::vector<std::uint32_t>& keyed, const Progress& progress)
{
    // The four cells about an edge of a voxel are its own and those below it.
    const CoordBBox reach(box.min().offsetBy(-1), box.max());
    const CoordBBox inner(box.min(), box.max().offsetBy(-1));
    keyed = parallelCollect<std::uint32_t>(cells.size(), progress, [&](std::size_t v, auto& out) {
        if (reach.isInside(cells[v]) && !inner.isInside(cells[v])) out.push_back(std::uint32_t(v));
    });
    std::stable_sort(keyed.begin(), keyed.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return cells[a] < cells[b]; });
    std::vector<VertexKey> keys(keyed.size());
    for (std::size_t i = 0; i < keyed.size(); ++i) {
        const Coord& cell = cells[keyed[i]];
        const bool again = i > 0 && cell == cells[keyed[i - 1]];
        keys[i] = {cell.x(), cell.y(), cell.z(), again ? keys[i - 1][3] + 1 : 0};
    }
    return keys;
}

/// Gives a brick the triangles whose highest cell lies in its box, and the areas of the vertices
/// that it owns.
/// @param[in,out] mesh  about the brick; its triangles are freed
/// @param[out] place    of each vertex in the brick, or none
/// @return the vertices of the brick; those that it owns come first
std::vector<std::uint32_t> takeTriangles(Mesh& mesh, const std::vector<Coord>& cells,
                                         const CoordBBox& box, BrickMesh& out,
                                         std::vector<std::uint32_t>& place,
                                         const Progress& progress)
{
    auto indices =
        parallelCollect<std::uint32_t>(cells.size(), progress, [&](std::size_t v, auto& mine) {
            if (box.isInside(cells[v])) mine.push_back(std::uint32_t(v));
        });
    out.owned = indices.size();
    place.assign(cells.size(), none);
    parallelFor(indices.size(), progress,
                [&](std::size_t i) { place[indices[i]] = std::uint32_t(i); });
    out.areas = chosen(vertexAreas(mesh, progress), indices, out.owned, progress);

    using Triangle = std::array<std::uint32_t, 3>;
    auto& triangles = out.mesh.triangles;
    triangles =
        parallelCollect<Triangle>(mesh.triangles.size(), progress, [&](std::size_t i, auto& mine) {
            const Triangle& t = mesh.triangles[i];
            const Coord highest =
                Coord::maxComponent(cells[t[0]], Coord::maxComponent(cells[t[1]], cells[t[2]]));
            if (box.isInside(highest)) mine.push_back(t);
        });
    mesh.triangles = {};
    const auto foreign =
        parallelCollect<std::uint32_t>(triangles.size(), progress, [&](std::size_t i, auto& some) {
            for (const std::uint32_t v : triangles[i])
                if (place[v] == none) some.push_back(v);
        });
    for (const std::uint32_t v : foreign) {
        if (place[v] != none) continue;
        place[v] = std::uint32_t(indices.size());
        indices.push_back(v);
    }
    parallelFor(triangles.size(), progress, [&](std::size_t i) {
        for (std::uint32_t& v : triangles[i]) v = place[v];
    });
    return indices;
}

} // namespace

std::vector<OpenEdge> openEdges(const Mesh& mesh, const std::vector<char>& isBorder,
                                const Progress& progress)
{
    auto edges =
        parallelCollect<OpenEdge>(mesh.triangles.size(), progress, [&](std::size_t i, auto& out) {
            const auto& t = mesh.triangles[i];
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t a = t[k], b = t[(k + 1) % 3];
                if (isBorder[a] && isBorder[b])
                    out.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
            }
        });
    std::sort(edges.begin(), edges.end(), [](const OpenEdge& a, const OpenEdge& b) {
        return a.from != b.from ? a.from < b.from : a.to < b.to;
    });
    std::vector<OpenEdge> open;
    for (std::size_t i = 0; i < edges.size();) {
        OpenEdge edge = edges[i];
        for (++i; i < edges.size() && edges[i].from == edge.from && edges[i].to == edge.to; ++i)
            edge.surplus += edges[i].surplus;
        if (edge.surplus != 0) open.push_back(edge);
    }
    return open;
}

BrickMesh cutBrick(Mesh mesh, std::vector<Coord> cells, const CoordBBox& box, const Vec3d& anchor,
                   std::vector<std::uint32_t>& sources, const Progress& progress)
{
    const auto verticesIn = [&](const CoordBBox& region) {
        std::vector<char> in(cells.size());
        parallelFor(in.size(), progress, [&](std::size_t v) { in[v] = region.isInside(cells[v]); });
        return in;
    };
    // Vertices whose fans of triangles may reach into the brick. Farther out the mesh is cut open.
    const CoordBBox beside(box.min().offsetBy(-2), box.max().offsetBy(2));
    Topology topology = checkTopology(mesh, verticesIn(beside), progress);
    const std::size_t before = cells.size();
    std::vector<std::uint32_t> split;
    if (!topology.manifold) split = splitNonManifold(mesh);
    for (const std::uint32_t v : split) cells.push_back(Coord(cells[v]));
    if (!topology.closed || !topology.oriented || !topology.manifold)
        topology = checkTopology(mesh, verticesIn(box), progress);
    BrickMesh out;
    out.closed = topology.closed;
    out.manifold = topology.manifold && topology.oriented;

    std::vector<std::uint32_t> place;
    std::vector<std::uint32_t> indices = takeTriangles(mesh, cells, box, out, place, progress);
    const std::size_t count = indices.size();
    out.mesh.positions = chosen(std::move(mesh.positions), indices, count, progress);
    out.mesh.normals = chosen(std::move(mesh.normals), indices, count, progress);
    for (auto& a : mesh.scalars)
        out.mesh.scalars.push_back({a.name, chosen(std::move(a.values), indices, count, progress)});
    sources = std::move(indices);
    for (std::uint32_t& v : sources)
        if (v >= before) v = split[v - before];

    std::vector<std::uint32_t> keyed;
    const std::vector<VertexKey> keys = keysOf(cells, box, keyed, progress);
    cells = {};
    std::size_t pieceCount = 0;
    const std::vector<std::uint32_t> pieces = connectedPieces(out.mesh, pieceCount, progress);
    TriangleSums sums;
    out.pieces = measurePieces(out.mesh, pieces, pieceCount, anchor, sums, progress);
    out.flat = sums.flat;
    std::vector<char> isBorder(count);
    for (std::size_t i = 0; i < keyed.size(); ++i) {
        const std::uint32_t v = place[keyed[i]];
        if (v == none) continue;
        out.border.push_back({keys[i], v, pieces[v]});
        isBorder[v] = 1;
    }
    out.openEdges = openEdges(out.mesh, isBorder, progress);
    return out;
}

} // namespace molsurf
