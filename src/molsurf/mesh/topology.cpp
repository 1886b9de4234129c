// SPDX-License-Identifier: MPL-2.0
#include "molsurf/mesh/topology.h"

#include "molsurf/core/disjoint_sets.h"
#include "molsurf/core/parallel.h"

#include <algorithm>
#include <map>
#include <utility>

namespace molsurf
{

namespace
{

/// The lowest and the highest vertex of some triangles.
struct VertexSpan {
    std::uint32_t first = ~std::uint32_t(0), last = 0;
};

constexpr std::size_t block = 1024; // triangles that share a span

std::vector<VertexSpan> spansOf(const Mesh& mesh, const Progress& progress)
{
    std::vector<VertexSpan> spans((mesh.triangles.size() + block - 1) / block);
    parallelFor(spans.size(), progress, [&](std::size_t b) {
        VertexSpan span;
        const std::size_t end = std::min(mesh.triangles.size(), (b + 1) * block);
        for (std::size_t i = b * block; i < end; ++i) {
            for (const std::uint32_t v : mesh.triangles[i])
                span = {std::min(span.first, v), std::max(span.last, v)};
        }
        spans[b] = span;
    });
    return spans;
}

/// Triangles listed by the places of their corners.
/// @param[in] visit  calls its argument with the place and the triangle of each corner, in order
template<typename F>
VertexTriangles listed(std::size_t places, const F& visit)
{
    VertexTriangles out;
    out.begins.assign(places + 1, 0);
    visit([&](std::uint32_t place, std::uint32_t) { ++out.begins[place + 1]; });
    std::partial_sum(out.begins.begin(), out.begins.end(), out.begins.begin());
    out.triangles.resize(out.begins.back());
    std::vector<std::uint32_t> next(out.begins.begin(), out.begins.end() - 1);
    visit([&](std::uint32_t place, std::uint32_t i) { out.triangles[next[place]++] = i; });
    return out;
}

/// The triangles at the vertices from `first` to `last`: those of v are triangles[begins[v -
/// first]] and so on.
VertexTriangles trianglesAt(const Mesh& mesh, const std::vector<VertexSpan>& spans,
                            std::uint32_t first, std::uint32_t last)
{
    return listed(std::size_t(last - first) + 1, [&](const auto& take) {
        for (std::size_t b = 0; b < spans.size(); ++b) {
            if (spans[b].last < first || spans[b].first > last) continue;
            const std::size_t end = std::min(mesh.triangles.size(), (b + 1) * block);
            for (std::size_t i = b * block; i < end; ++i) {
                for (const std::uint32_t v : mesh.triangles[i])
                    if (v - first <= last - first) take(v - first, std::uint32_t(i));
            }
        }
    });
}

} // namespace

VertexTriangles vertexTriangles(const Mesh& mesh)
{
    if (mesh.positions.empty()) return {{0}, {}};
    return trianglesAt(mesh, spansOf(mesh, Progress()), 0,
                       std::uint32_t(mesh.positions.size() - 1));
}

VertexTriangles vertexTriangles(const Mesh& mesh, const std::vector<std::uint32_t>& some,
                                const Progress& progress)
{
    std::vector<bool> wanted(mesh.positions.size());
    for (const std::uint32_t v : some) wanted[v] = true;
    struct Corner {
        std::uint32_t place, triangle;
    };
    const auto corners =
        parallelCollect<Corner>(mesh.triangles.size(), progress, [&](std::size_t i, auto& found) {
            for (const std::uint32_t v : mesh.triangles[i]) {
                if (!wanted[v]) continue;
                const auto place = std::lower_bound(some.begin(), some.end(), v) - some.begin();
                found.push_back({std::uint32_t(place), std::uint32_t(i)});
            }
        });
    return listed(some.size(), [&](const auto& take) {
        for (const Corner& c : corners) take(c.place, c.triangle);
    });
}

namespace
{

/// The corner of a triangle that is vertex v.
int cornerOf(const std::array<std::uint32_t, 3>& t, std::uint32_t v)
{
    return t[0] == v ? 0 : t[1] == v ? 1 : 2;
}

/// @param[in] begin,end  of the triangles at v
Topology checkVertex(const Mesh& mesh, const std::uint32_t* begin, const std::uint32_t* end,
                     std::uint32_t v)
{
    // Each triangle at v leads from the edge to `out` to the edge to `in`: v -> out -> in -> v.
    std::pair<std::uint32_t, std::uint32_t> wedges[64];
    Topology result;
    const std::size_t n = std::size_t(end - begin);
    if (n == 0 || n > 64) {
        result.manifold = n == 0;
        return result;
    }
    for (std::size_t i = 0; i < n; ++i) {
        const auto& t = mesh.triangles[begin[i]];
        const int c = cornerOf(t, v);
        wedges[i] = {t[(c + 1) % 3], t[(c + 2) % 3]};
    }
    // One turn about v. If it comes back after n triangles, each of these was met once.
    std::size_t steps = 0;
    std::uint32_t at = wedges[0].first;
    do {
        const auto* wedge =
            std::find_if(wedges, wedges + n, [at](const auto& w) { return w.first == at; });
        if (wedge == wedges + n) break;
        at = wedge->second;
        ++steps;
    } while (at != wedges[0].first && steps < n);
    if (steps == n && at == wedges[0].first) return result;
    result.manifold = false;
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

/// @param[in] wanted  tells of a vertex whether to check it
template<typename F>
Topology checkVertices(const Mesh& mesh, const F& wanted, const Progress& progress)
{
    constexpr std::size_t slice = 32768; // their triangles stay in the cache
    const std::size_t vertices = mesh.positions.size();
    const std::vector<VertexSpan> spans = spansOf(mesh, progress);
    const Verdict all =
        parallelSum<Verdict>((vertices + slice - 1) / slice, progress, [&](std::size_t s) {
            const auto first = std::uint32_t(s * slice);
            const auto last = std::uint32_t(std::min(vertices, (s + 1) * slice) - 1);
            const VertexTriangles around = trianglesAt(mesh, spans, first, last);
            Verdict sum;
            for (std::uint32_t v = first; v <= last; ++v) {
                if (!wanted(v)) continue;
                const std::uint32_t* at = around.triangles.data();
                const Topology t = checkVertex(mesh, at + around.begins[v - first],
                                               at + around.begins[v - first + 1], v);
                sum += {!t.closed, !t.oriented, !t.manifold};
            }
            return sum;
        });
    return {!all.open, !all.twisted, !all.pinched};
}

} // namespace

Topology checkTopology(const Mesh& mesh, const Progress& progress)
{
    return checkVertices(
        mesh, [](std::uint32_t) { return true; }, progress);
}

Topology checkTopology(const Mesh& mesh, const std::vector<char>& wanted, const Progress& progress)
{
    return checkVertices(
        mesh, [&](std::uint32_t v) { return wanted[v] != 0; }, progress);
}

std::vector<std::uint32_t> connectedPieces(const Mesh& mesh, std::size_t& count,
                                           const Progress& progress)
{
    DisjointSets sets(mesh.positions.size());
    parallelFor((mesh.triangles.size() + block - 1) / block, progress, [&](std::size_t c) {
        const std::size_t end = std::min(mesh.triangles.size(), (c + 1) * block);
        for (std::size_t i = c * block; i < end; ++i) {
            sets.join(mesh.triangles[i][0], mesh.triangles[i][1]);
            sets.join(mesh.triangles[i][1], mesh.triangles[i][2]);
        }
    });
    return sets.numbers(count);
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
    DisjointSets sets(n);
    std::map<std::uint32_t, std::array<std::vector<std::uint32_t>, 2>> edges; // by the other end
    for (std::uint32_t i = 0; i < n; ++i) {
        const auto& t = mesh.triangles[around.triangles[begin + i]];
        const int c = cornerOf(t, v);
        edges[t[(c + 1) % 3]][0].push_back(i);
        edges[t[(c + 2) % 3]][1].push_back(i);
    }
    for (const auto& [end, sides] : edges) {
        for (std::size_t k = 0; k < std::min(sides[0].size(), sides[1].size()); ++k) {
            sets.join(sides[0][k], sides[1][k]);
        }
    }
    std::vector<std::uint32_t> first(n);
    for (std::uint32_t i = 0; i < n; ++i) first[i] = sets.find(i);
    return first;
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
        const std::uint32_t* at = around.triangles.data();
        if (checkVertex(mesh, at + around.begins[v], at + around.begins[v + 1], v).manifold)
            continue;
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
