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
    return checkTopology(mesh, around, {}, progress);
}

Topology checkTopology(const Mesh& mesh, const VertexTriangles& around,
                       const std::vector<std::uint32_t>& some, const Progress& progress)
{
    constexpr std::size_t chunk = 1024;
    const std::size_t vertices = some.empty() ? mesh.positions.size() : some.size();
    const Verdict all =
        parallelSum<Verdict>((vertices + chunk - 1) / chunk, progress, [&](std::size_t c) {
            Verdict sum;
            for (std::size_t v = c * chunk; v < std::min(vertices, (c + 1) * chunk); ++v) {
                const Topology t =
                    checkVertex(mesh, around, some.empty() ? std::uint32_t(v) : some[v]);
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

namespace
{

/// The fans of triangles about a vertex: for each of its triangles, in their order, the first one
/// of the same fan. Of an edge that more than two triangles share, the first that runs out along it
/// is paired with the first that runs in, and so on.
std::vector<std::uint32_t> fansOf(const Mesh& mesh, const VertexTriangles& around, std::uint32_t v)
{
    const std::uint32_t begin = around.begins[v], n = around.begins[v + 1] - begin;
    std::vector<std::uint32_t> parent(n);
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    std::map<std::uint32_t, std::array<std::vector<std::uint32_t>, 2>> edges; // by the other end
    for (std::uint32_t i = 0; i < n; ++i) {
        const auto& t = mesh.triangles[around.triangles[begin + i]];
        const int c = cornerOf(t, v);
        edges[t[(c + 1) % 3]][0].push_back(i);
        edges[t[(c + 2) % 3]][1].push_back(i);
    }
    for (const auto& [end, sides] : edges) {
        for (std::size_t k = 0; k < std::min(sides[0].size(), sides[1].size()); ++k) {
            const std::uint32_t a = root(sides[0][k]), b = root(sides[1][k]);
            parent[std::max(a, b)] = std::min(a, b);
        }
    }
    for (std::uint32_t i = 0; i < n; ++i) parent[i] = root(i);
    return parent;
}

} // namespace

std::vector<std::uint32_t> splitNonManifold(Mesh& mesh)
{
    const VertexTriangles around = vertexTriangles(mesh);
    struct Fan {
        std::uint32_t triangle, vertex; // its first triangle, and what it turns about
        std::vector<std::uint32_t> triangles;
    };
    std::vector<Fan> fans; // that need a vertex of their own
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
        if (checkVertex(mesh, around, v).manifold) continue;
        const std::vector<std::uint32_t> first = fansOf(mesh, around, v);
        for (std::uint32_t i = 1; i < first.size(); ++i) {
            if (first[i] != i) continue;
            Fan fan{around.triangles[around.begins[v] + i], v, {}};
            for (std::uint32_t j = i; j < first.size(); ++j) {
                if (first[j] == i) fan.triangles.push_back(around.triangles[around.begins[v] + j]);
            }
            fans.push_back(std::move(fan));
        }
    }
    const auto place = [&](const Fan& fan) {
        return std::pair(fan.triangle, cornerOf(mesh.triangles[fan.triangle], fan.vertex));
    };
    std::sort(fans.begin(), fans.end(),
              [&](const Fan& a, const Fan& b) { return place(a) < place(b); });
    std::vector<std::uint32_t> sources;
    std::vector<std::array<std::uint32_t, 3>> triangles = mesh.triangles;
    for (const Fan& fan : fans) {
        const std::uint32_t v = fan.vertex, copy = std::uint32_t(mesh.positions.size());
        for (const std::uint32_t t : fan.triangles)
            triangles[t][cornerOf(mesh.triangles[t], v)] = copy;
        mesh.positions.push_back(openvdb::Vec3f(mesh.positions[v]));
        if (!mesh.normals.empty()) mesh.normals.push_back(openvdb::Vec3f(mesh.normals[v]));
        for (auto& a : mesh.scalars) a.values.push_back(float(a.values[v]));
        for (auto& a : mesh.labels) a.values.push_back(std::int32_t(a.values[v]));
        sources.push_back(v);
    }
    mesh.triangles = std::move(triangles);
    return sources;
}

} // namespace molsurf
