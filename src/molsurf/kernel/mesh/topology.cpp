// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/mesh/topology.h"

#include "molsurf/kernel/core/disjoint_sets.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/core/simd.h"
#include "molsurf/kernel/mesh/vertex_slices.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <numeric>
#include <utility>

namespace molsurf
{

namespace
{

constexpr std::size_t perBlock = 1024; // triangles that a thread takes at once

/// Calls f(i) for the numbers below count, by all threads at once.
template<typename F>
void forEach(std::size_t count, const Progress& progress, const F& f)
{
    parallelFor((count + perBlock - 1) / perBlock, progress, [&](std::size_t b) {
        const std::size_t end = std::min(count, (b + 1) * perBlock);
        for (std::size_t i = b * perBlock; i < end; ++i) f(std::uint32_t(i));
    });
}

/// The triangles that have a corner in a set, in ascending order.
std::vector<std::uint32_t> trianglesAt(const Mesh& mesh, const VertexSet& some,
                                       const Progress& progress)
{
    return parallelCollect<std::uint32_t>(mesh.triangles.size(), progress,
                                          [&](std::size_t i, std::vector<std::uint32_t>& found) {
                                              const auto& t = mesh.triangles[i];
                                              if (some.has(t[0]) | some.has(t[1]) | some.has(t[2]))
                                                  found.push_back(std::uint32_t(i));
                                          });
}

/// Counting sort of triangles by the places of their corners, by all threads at once.
/// @param[in] count  of the triangles
/// @param[in] visit  visit(n, take) calls take(place, triangle) for corners of the n-th of them
template<typename F>
VertexTriangles listed(std::size_t count, std::size_t places, const Progress& progress,
                       const F& visit)
{
    constexpr auto relaxed = std::memory_order_relaxed;
    std::vector<std::atomic<std::uint32_t>> next(places); // place in the list
    forEach(count, progress, [&](std::uint32_t n) {
        visit(n, [&](std::uint32_t place, std::uint32_t) { next[place].fetch_add(1, relaxed); });
    });
    VertexTriangles out;
    out.begins.resize(places + 1, 0);
    for (std::size_t n = 0; n < places; ++n) {
        out.begins[n + 1] = out.begins[n] + next[n].load(relaxed);
        next[n].store(out.begins[n], relaxed);
    }
    out.triangles.resize(out.begins.back());
    forEach(count, progress, [&](std::uint32_t n) {
        visit(n, [&](std::uint32_t place, std::uint32_t triangle) {
            out.triangles[next[place].fetch_add(1, relaxed)] = triangle;
        });
    });
    // Threads come in any order.
    parallelFor(places, progress, [&](std::size_t n) {
        std::sort(out.triangles.begin() + out.begins[n], out.triangles.begin() + out.begins[n + 1]);
    });
    return out;
}

} // namespace

VertexTriangles vertexTriangles(const Mesh& mesh)
{
    return listed(mesh.triangles.size(), mesh.positions.size(), Progress(),
                  [&](std::uint32_t i, const auto& take) {
                      for (const std::uint32_t v : mesh.triangles[i]) take(v, i);
                  });
}

VertexTriangles vertexTriangles(const Mesh& mesh, const VertexSet& some, const Progress& progress)
{
    const std::vector<std::uint32_t> at = trianglesAt(mesh, some, progress);
    return listed(at.size(), some.size(), progress, [&](std::uint32_t n, const auto& take) {
        for (const std::uint32_t v : mesh.triangles[at[n]])
            if (some.has(v)) take(some.place(v), at[n]);
    });
}

VertexSet withNeighbours(const Mesh& mesh, const VertexSet& some, const Progress& progress)
{
    VertexSet all(mesh.positions.size());
    for (const std::uint32_t i : trianglesAt(mesh, some, progress))
        for (const std::uint32_t v : mesh.triangles[i]) all.add(v);
    return all;
}

namespace
{

/// The corner of a triangle that is vertex v.
int cornerOf(const std::array<std::uint32_t, 3>& t, std::uint32_t v)
{
    return t[0] == v ? 0 : t[1] == v ? 1 : 2;
}

/// The triangles at some vertices, as they are seen from these: each leads from the edge to `out`
/// to the edge to `in`, v -> out -> in -> v. Eight more numbers can be read at the end.
struct Fans {
    std::vector<std::uint32_t> begins; // of the vertices
    std::vector<std::int32_t> out, in;

    /// @param[in] visit  calls its argument with the place of a vertex, `out` and `in`, for each
    template<typename F>
    Fans(std::size_t vertices, const F& visit) : begins(vertices + 1, 0)
    {
        visit([&](std::size_t place, std::uint32_t, std::uint32_t) { ++begins[place + 1]; });
        std::partial_sum(begins.begin(), begins.end(), begins.begin());
        out.resize(begins.back() + floatLanes);
        in.resize(begins.back() + floatLanes);
        std::vector<std::uint32_t> next(begins.begin(), begins.end() - 1);
        visit([&](std::size_t place, std::uint32_t o, std::uint32_t i) {
            out[next[place]] = std::int32_t(o);
            in[next[place]++] = std::int32_t(i);
        });
    }

    std::size_t size() const { return begins.size() - 1; }
};

/// The first fan from number v on that is not one turn about its vertex, or has more triangles than
/// there are lanes.
/// @return the number of fans if there is none
MOLSURF_KERNEL std::size_t firstDoubtful(const Fans& fans, std::size_t v)
{
    const Ints lane = laneNumbers(), bit = splat(1) << lane;
    for (; v < fans.size(); ++v) {
        const std::uint32_t begin = fans.begins[v], n = fans.begins[v + 1] - begin;
        if (n == 0 || n > floatLanes) return v;
        const Ints out = load(fans.out.data() + begin),
                   used = (lane < splat(std::int32_t(n))) & bit;
        int next[floatLanes];
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t found = bitsOf((out == splat(fans.in[begin + i])) & used);
            if (found == 0) return v;
            next[i] = __builtin_ctz(found);
        }
        // If the way from triangle to triangle comes back after n of them, each was met once.
        std::uint32_t steps = 1;
        int at = next[0];
        for (; at != 0 && steps < n; at = next[at]) ++steps;
        if (at != 0 || steps < n) return v;
    }
    return v;
}

/// How many numbers of a sorted list equal one.
std::size_t countOf(const std::vector<std::int32_t>& sorted, std::int32_t number)
{
    const auto [first, end] = std::equal_range(sorted.begin(), sorted.end(), number);
    return std::size_t(end - first);
}

/// Checks a fan by walking about its vertex from triangle to triangle; if that is no one turn, by
/// counting the triangles that run out and in along each edge.
/// @param[in] k  number of the fan
Topology checkFan(const Fans& fans, std::size_t k)
{
    const std::uint32_t begin = fans.begins[k], end = fans.begins[k + 1], n = end - begin;
    Topology result;
    if (n == 0) return result;
    std::vector<std::pair<std::int32_t, std::int32_t>> sides; // (out, in), by `out`
    for (std::uint32_t i = begin; i < end; ++i) sides.emplace_back(fans.out[i], fans.in[i]);
    std::sort(sides.begin(), sides.end());
    // One turn about v, as above.
    const std::int32_t start = sides[0].first;
    std::uint32_t steps = 0;
    std::int32_t at = start;
    do {
        const auto here =
            std::lower_bound(sides.begin(), sides.end(), at,
                             [](const auto& side, std::int32_t out) { return side.first < out; });
        if (here == sides.end() || here->first != at) break;
        at = here->second;
        ++steps;
    } while (at != start && steps < n);
    if (steps == n && at == start) return result;
    result.manifold = false;
    std::vector<std::int32_t> outs, ins;
    for (const auto& [out, in] : sides) {
        outs.push_back(out);
        ins.push_back(in);
    }
    std::sort(ins.begin(), ins.end());
    for (const auto& [out, in] : sides) {
        const std::size_t insOfOut = countOf(ins, out), sameOut = countOf(outs, out);
        if (insOfOut + sameOut != 2) result.closed = false;
        if (insOfOut != 1 || countOf(outs, in) != 1 || sameOut != 1) result.oriented = false;
    }
    return result;
}

/// Calls take(place, out, in) for each corner of a triangle whose vertex is one of `count` from
/// `first` on; the place is the vertex's number among them.
template<typename F>
void visitCorners(const std::array<std::uint32_t, 3>& t, std::uint32_t first, std::uint32_t count,
                  const F& take)
{
    for (int k = 0; k < 3; ++k)
        if (t[k] - first < count) take(t[k] - first, t[(k + 1) % 3], t[(k + 2) % 3]);
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

/// Checks the triangles about each wanted vertex, slice by slice: firstDoubtful() passes those that
/// make one turn, and checkFan() decides the others.
/// @param[in] wanted  whether to check a vertex, by its index
template<typename F>
Topology checkVertices(const Mesh& mesh, const F& wanted, const Progress& progress)
{
    const VertexSlices slices(mesh, progress);
    const Verdict all = parallelSum<Verdict>(slices.size(), progress, [&](std::size_t s) {
        const std::uint32_t first = slices.first(s), count = slices.first(s + 1) - first;
        const Fans fans(count, [&](const auto& take) {
            slices.forEachTriangle(
                s, [&](std::size_t i) { visitCorners(mesh.triangles[i], first, count, take); });
        });
        Verdict sum;
        for (std::size_t v = 0; (v = firstDoubtful(fans, v)) < count; ++v) {
            if (!wanted(first + std::uint32_t(v))) continue;
            const Topology t = checkFan(fans, v);
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
    forEach(mesh.triangles.size(), progress, [&](std::uint32_t i) {
        sets.join(mesh.triangles[i][0], mesh.triangles[i][1]);
        sets.join(mesh.triangles[i][1], mesh.triangles[i][2]);
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
    const Fans turns(mesh.positions.size(), [&](const auto& take) {
        for (const auto& t : mesh.triangles)
            visitCorners(t, 0, std::uint32_t(mesh.positions.size()), take);
    });
    struct Fan {
        std::uint32_t triangle, vertex; // its first triangle, and what it turns about
        std::vector<std::uint32_t> triangles;
    };
    std::vector<Fan> fans; // that need a vertex of their own
    for (std::uint32_t v = 0; (v = std::uint32_t(firstDoubtful(turns, v))) < turns.size(); ++v) {
        if (checkFan(turns, v).manifold) continue;
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
