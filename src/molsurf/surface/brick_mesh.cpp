// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/brick_mesh.h"

#include "molsurf/surface/statistics.h"
#include "molsurf/surface/topology.h"

#include <algorithm>
#include <numeric>

namespace molsurf
{

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::Vec3d;
using openvdb::Vec3f;

namespace
{

constexpr std::uint32_t none = ~std::uint32_t(0);

/// Some elements of an array, in the order of their indices.
template<typename T>
std::vector<T> chosen(const std::vector<T>& all, const std::vector<std::uint32_t>& indices)
{
    std::vector<T> out;
    out.reserve(indices.size());
    for (const std::uint32_t i : indices) out.push_back(T(all[i]));
    return out;
}

/// Splits pinched vertices among some; their starts and sources go along.
void splitPinched(Mesh& mesh, std::vector<Vec3f>& starts, std::vector<std::uint32_t>& origins,
                  const std::vector<std::uint32_t>& some, const Progress& progress)
{
    origins.resize(mesh.positions.size());
    std::iota(origins.begin(), origins.end(), 0u);
    if (some.empty() || checkTopology(mesh, some, progress).manifold) return;
    for (const std::uint32_t v : splitNonManifold(mesh)) {
        starts.push_back(Vec3f(starts[v]));
        origins.push_back(v);
    }
}

/// The key of each vertex of the cells on either side of the brick's border; the others have none.
/// @param[out] keyed  the vertices that have a key
std::vector<VertexKey> keysOf(const std::vector<Coord>& cells, const CoordBBox& box,
                              std::vector<std::uint32_t>& keyed)
{
    // The four cells about an edge of a voxel are its own and those below it.
    const CoordBBox reach(box.min().offsetBy(-1), box.max());
    const CoordBBox inner(box.min(), box.max().offsetBy(-1));
    for (std::uint32_t v = 0; v < cells.size(); ++v) {
        if (reach.isInside(cells[v]) && !inner.isInside(cells[v])) keyed.push_back(v);
    }
    std::vector<std::uint32_t> order = keyed;
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return cells[a] != cells[b] ? cells[a] < cells[b] : a < b;
    });
    std::vector<VertexKey> keys(cells.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const Coord& cell = cells[order[i]];
        const bool again = i > 0 && cell == cells[order[i - 1]];
        keys[order[i]] = {cell.x(), cell.y(), cell.z(), again ? keys[order[i - 1]][3] + 1 : 0};
    }
    return keys;
}

/// Edges of border vertices whose triangles are not paired.
std::vector<OpenEdge> openEdges(const Mesh& mesh, const std::vector<char>& isBorder)
{
    std::vector<OpenEdge> edges;
    for (const auto& t : mesh.triangles) {
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k], b = t[(k + 1) % 3];
            if (isBorder[a] && isBorder[b])
                edges.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
        }
    }
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

} // namespace

BrickMesh cutBrick(Mesh& mesh, std::vector<Vec3f> starts, const CoordBBox& box, double voxel,
                   const Vec3d& anchor, std::vector<std::uint32_t>& sources,
                   const Progress& progress)
{
    const auto cellsOf = [&] {
        std::vector<Coord> cells(starts.size());
        for (std::size_t v = 0; v < cells.size(); ++v)
            cells[v] = Coord::floor(Vec3d(starts[v]) / voxel);
        return cells;
    };
    std::vector<Coord> cells = cellsOf();
    std::vector<std::uint32_t> near; // vertices whose fans decide what the brick gets
    const CoordBBox beside(box.min().offsetBy(-2), box.max().offsetBy(2));
    for (std::uint32_t v = 0; v < cells.size(); ++v) {
        if (beside.isInside(cells[v])) near.push_back(v);
    }
    std::vector<std::uint32_t> origins;
    splitPinched(mesh, starts, origins, near, progress);
    cells = cellsOf();

    const auto owns = [&](const std::array<std::uint32_t, 3>& t) {
        return box.isInside(
            Coord::maxComponent(cells[t[0]], Coord::maxComponent(cells[t[1]], cells[t[2]])));
    };
    BrickMesh out;
    std::vector<std::uint32_t> place(starts.size(), none), indices;
    for (std::uint32_t v = 0; v < cells.size(); ++v) {
        if (!box.isInside(cells[v])) continue;
        place[v] = std::uint32_t(indices.size());
        indices.push_back(v);
    }
    out.owned = indices.size();
    for (const auto& t : mesh.triangles) {
        if (!owns(t)) continue;
        for (const std::uint32_t v : t) {
            if (place[v] != none) continue;
            place[v] = std::uint32_t(indices.size());
            indices.push_back(v);
        }
        out.mesh.triangles.push_back({place[t[0]], place[t[1]], place[t[2]]});
    }
    out.mesh.positions = chosen(mesh.positions, indices);
    out.mesh.normals = chosen(mesh.normals, indices);
    for (const auto& a : mesh.scalars)
        out.mesh.scalars.push_back({a.name, chosen(a.values, indices)});
    sources = chosen(origins, indices);
    const std::vector<std::uint32_t> mine(indices.begin(),
                                          indices.begin() + std::ptrdiff_t(out.owned));
    out.areas = chosen(vertexAreas(mesh), mine);
    if (!mine.empty()) {
        const Topology topology = checkTopology(mesh, mine, progress);
        out.closed = topology.closed;
        out.manifold = topology.manifold && topology.oriented;
    }

    std::size_t count = 0;
    const std::vector<std::uint32_t> pieces = connectedPieces(out.mesh, count, progress);
    out.pieces = measurePieces(out.mesh, pieces, count, anchor, out.flat, progress);
    std::vector<std::uint32_t> keyed;
    const std::vector<VertexKey> keys = keysOf(cells, box, keyed);
    std::vector<char> isBorder(indices.size());
    for (const std::uint32_t v : keyed) {
        if (place[v] == none) continue;
        out.border.push_back({keys[v], place[v], pieces[place[v]]});
        isBorder[place[v]] = 1;
    }
    out.openEdges = openEdges(out.mesh, isBorder);
    return out;
}

} // namespace molsurf
