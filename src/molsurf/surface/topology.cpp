// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/topology.h"

#include "molsurf/core/parallel.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace molsurf
{

VertexTriangles vertexTriangles(const Mesh& mesh)
{
    VertexTriangles out;
    out.begins.assign(mesh.positions.size() + 1, 0);
    for (const auto& t : mesh.triangles) {
        for (const std::uint32_t v : t) ++out.begins[v + 1];
    }
    std::partial_sum(out.begins.begin(), out.begins.end(), out.begins.begin());
    out.triangles.resize(out.begins.back());
    std::vector<std::uint32_t> next(out.begins.begin(), out.begins.end() - 1);
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        for (const std::uint32_t v : mesh.triangles[i]) out.triangles[next[v]++] = i;
    }
    return out;
}

namespace
{

/// The corner of a triangle that is vertex v.
int cornerOf(const std::array<std::uint32_t, 3>& t, std::uint32_t v)
{
    return t[0] == v ? 0 : t[1] == v ? 1 : 2;
}

Topology checkVertex(const Mesh& mesh, const VertexTriangles& around, std::uint32_t v)
{
    // Each triangle at v leads from the edge to `out` to the edge to `in`: v -> out -> in -> v.
    std::pair<std::uint32_t, std::uint32_t> wedges[64];
    Topology result;
    const std::uint32_t begin = around.begins[v], end = around.begins[v + 1];
    const std::size_t n = end - begin;
    if (n == 0 || n > 64) {
        result.manifold = n == 0;
        return result;
    }
    for (std::uint32_t i = begin; i < end; ++i) {
        const auto& t = mesh.triangles[around.triangles[i]];
        const int c = cornerOf(t, v);
        wedges[i - begin] = {t[(c + 1) % 3], t[(c + 2) % 3]};
    }
    for (std::size_t i = 0; i < n; ++i) {
        std::size_t outs = 0, ins = 0, sameOut = 0;
        for (std::size_t j = 0; j < n; ++j) {
            ins += wedges[j].second == wedges[i].first;
            outs += wedges[j].first == wedges[i].second;
            sameOut += wedges[j].first == wedges[i].first;
        }
        if (ins + sameOut != 2) result.closed = false;
        if (ins != 1 || outs != 1 || sameOut != 1) result.oriented = false;
    }
    result.manifold = result.closed && result.oriented;
    if (!result.manifold) return result;
    std::size_t steps = 0;
    std::uint32_t at = wedges[0].first;
    do {
        const auto* wedge =
            std::find_if(wedges, wedges + n, [at](const auto& w) { return w.first == at; });
        at = wedge->second;
        ++steps;
    } while (at != wedges[0].first && steps < n);
    result.manifold = steps == n && at == wedges[0].first;
    return result;
}

struct Verdict {
    bool open = false, twisted = false, pinched = false;

    Verdict& operator+=(const Verdict& other)
    {
        open |= other.open;
        twisted |= other.twisted;
        pinched |= other.pinched;
        return *this;
    }
};

} // namespace

Topology checkTopology(const Mesh& mesh, const VertexTriangles& around, const Progress& progress)
{
    constexpr std::size_t chunk = 1024;
    const std::size_t vertices = mesh.positions.size();
    const Verdict all =
        parallelSum<Verdict>((vertices + chunk - 1) / chunk, progress, [&](std::size_t c) {
            Verdict sum;
            for (std::size_t v = c * chunk; v < std::min(vertices, (c + 1) * chunk); ++v) {
                const Topology t = checkVertex(mesh, around, std::uint32_t(v));
                sum += {!t.closed, !t.oriented, !t.manifold};
            }
            return sum;
        });
    return {!all.open, !all.twisted, !all.pinched};
}

std::vector<std::uint32_t> connectedPieces(const Mesh& mesh, std::size_t& count)
{
    std::vector<std::uint32_t> parent(mesh.positions.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t v) {
        while (parent[v] != v) v = parent[v] = parent[parent[v]];
        return v;
    };
    for (const auto& t : mesh.triangles) {
        std::uint32_t a = root(t[0]);
        for (const std::uint32_t v : {t[1], t[2]}) {
            const std::uint32_t b = root(v);
            parent[std::max(a, b)] = std::min(a, b);
            a = std::min(a, b);
        }
    }
    // Roots are the smallest vertices of their pieces, so they come first.
    count = 0;
    std::vector<std::uint32_t> piece(parent.size());
    for (std::uint32_t v = 0; v < parent.size(); ++v) {
        const std::uint32_t r = root(v);
        piece[v] = r == v ? std::uint32_t(count++) : piece[r];
    }
    return piece;
}

std::vector<double> pieceVolumes(const Mesh& mesh, const std::vector<std::uint32_t>& pieces,
                                 std::size_t count)
{
    std::vector<double> volumes(count, 0.0);
    if (mesh.positions.empty()) return volumes;
    const openvdb::Vec3d origin(mesh.positions[0]);
    for (const auto& t : mesh.triangles) {
        const openvdb::Vec3d a = openvdb::Vec3d(mesh.positions[t[0]]) - origin;
        const openvdb::Vec3d b = openvdb::Vec3d(mesh.positions[t[1]]) - origin;
        const openvdb::Vec3d c = openvdb::Vec3d(mesh.positions[t[2]]) - origin;
        volumes[pieces[t[0]]] += a.dot(b.cross(c)) / 6.0;
    }
    return volumes;
}

std::size_t splitNonManifold(Mesh& mesh)
{
    // Half edges (a, b) of triangles, by undirected edge; those of one edge are paired in order.
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::array<std::vector<std::uint32_t>, 2>>
        edges;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = mesh.triangles[i][k], b = mesh.triangles[i][(k + 1) % 3];
            edges[std::minmax(a, b)][a < b].push_back(3 * i + k);
        }
    }
    // Corners joined across paired edges are one vertex.
    std::vector<std::uint32_t> parent(3 * mesh.triangles.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t c) {
        while (parent[c] != c) c = parent[c] = parent[parent[c]];
        return c;
    };
    const auto join = [&](std::uint32_t a, std::uint32_t b) { parent[root(a)] = root(b); };
    for (const auto& [edge, sides] : edges) {
        for (std::size_t i = 0; i < std::min(sides[0].size(), sides[1].size()); ++i) {
            const std::uint32_t p = sides[0][i], q = sides[1][i];
            join(p, q / 3 * 3 + (q + 1) % 3);
            join(p / 3 * 3 + (p + 1) % 3, q);
        }
    }
    const std::size_t before = mesh.positions.size();
    std::vector<std::int64_t> owner(before, -1);
    std::map<std::uint32_t, std::uint32_t> copies; // of the corners' roots that need a new vertex
    for (std::uint32_t c = 0; c < parent.size(); ++c) {
        std::uint32_t& v = mesh.triangles[c / 3][c % 3];
        const std::uint32_t r = root(c);
        if (owner[v] < 0) owner[v] = r;
        if (owner[v] == r) continue;
        const auto [it, added] = copies.try_emplace(r, std::uint32_t(mesh.positions.size()));
        if (added) {
            mesh.positions.push_back(openvdb::Vec3f(mesh.positions[v]));
            if (!mesh.normals.empty()) mesh.normals.push_back(openvdb::Vec3f(mesh.normals[v]));
            for (auto& a : mesh.scalars) a.values.push_back(float(a.values[v]));
            for (auto& a : mesh.labels) a.values.push_back(std::int32_t(a.values[v]));
        }
        v = it->second;
    }
    return mesh.positions.size() - before;
}

} // namespace molsurf
