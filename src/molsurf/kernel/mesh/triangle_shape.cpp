// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/mesh/triangle_shape.h"

#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/core/simd.h"
#include "molsurf/kernel/mesh/topology.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

namespace molsurf
{

using openvdb::Coord;
using openvdb::Vec3d;
using openvdb::Vec3f;

namespace
{

constexpr float leastQuality = 0.05f, leastAgreement = 0.0f;

/// A triangle in each lane.
struct Triangles {
    Floats4 corner[3][3] = {}, normal[3][3] = {}; // [corner][axis]

    /// Twice the area over the square of the longest edge: sqrt(3)/2 at best, near 0 for a needle
    /// or a cap.
    Floats4 quality{};
    /// The cosine of the largest angle between the triangle's normal and those at its corners; -1
    /// for a triangle without area, which is the worst there is.
    Floats4 agreement{};

    MOLSURF_INLINE void measure()
    {
        Floats4 edge[3][3], longest2{}; // from the corner of this number to the next
        for (int k = 0; k < 3; ++k) {
            Floats4 length2{};
            for (int a = 0; a < 3; ++a) {
                edge[k][a] = corner[(k + 1) % 3][a] - corner[k][a];
                length2 += edge[k][a] * edge[k][a];
            }
            longest2 = length2 > longest2 ? length2 : longest2;
        }
        Floats4 across[3], across2{};
        for (int a = 0; a < 3; ++a) {
            const int b = (a + 1) % 3, c = (a + 2) % 3;
            across[a] = edge[2][b] * edge[0][c] - edge[2][c] * edge[0][b];
            across2 += across[a] * across[a];
        }
        Floats4 least{};
        for (int k = 0; k < 3; ++k) {
            Floats4 dot{};
            for (int a = 0; a < 3; ++a) dot += across[a] * normal[k][a];
            least = k == 0 || dot < least ? dot : least;
        }
        Floats4 length{};
        for (int l = 0; l < 4; ++l) length[l] = std::sqrt(across2[l]);
        quality = longest2 > 0.0f ? length / longest2 : Floats4{};
        agreement = length > 0.0f ? least / length : Floats4{} - 1.0f;
    }
};

/// Puts a triangle into a lane.
MOLSURF_INLINE void put(const Mesh& mesh, const std::array<std::uint32_t, 3>& t, int lane,
                        Triangles& out)
{
    for (int k = 0; k < 3; ++k) {
        for (int a = 0; a < 3; ++a) {
            out.corner[k][a][lane] = mesh.positions[t[k]][a];
            out.normal[k][a][lane] = mesh.normals[t[k]][a];
        }
    }
}

/// The triangles of a quad, by their corners: two beside diagonal 0-2, then two beside 1-3.
constexpr int halves[4][3] = {{0, 1, 2}, {0, 2, 3}, {1, 2, 3}, {1, 3, 0}};

/// Splits a quad of four positions and normals.
/// @param[out] bad  whether the two triangles are
/// @return the first of the two
MOLSURF_INLINE int splitQuad(const Vec3f* const* p, const Vec3f* const* n, bool* bad)
{
    Triangles t;
    for (int k = 0; k < 3; ++k) {
        for (int a = 0; a < 3; ++a) {
            t.corner[k][a] = Floats4{(*p[halves[0][k]])[a], (*p[halves[1][k]])[a],
                                     (*p[halves[2][k]])[a], (*p[halves[3][k]])[a]};
            t.normal[k][a] = Floats4{(*n[halves[0][k]])[a], (*n[halves[1][k]])[a],
                                     (*n[halves[2][k]])[a], (*n[halves[3][k]])[a]};
        }
    }
    t.measure();
    const float first = smaller(t.agreement[0], t.agreement[1]);
    const float second = smaller(t.agreement[2], t.agreement[3]);
    const bool shorter = (*p[0] - *p[2]).lengthSqr() <= (*p[1] - *p[3]).lengthSqr();
    const int at = (std::abs(first - second) > 0.2f ? first > second : shorter) ? 0 : 2;
    for (int k = 0; k < 2; ++k) {
        bad[k] = t.quality[at + k] < leastQuality || t.agreement[at + k] < leastAgreement;
    }
    return at;
}

} // namespace

MOLSURF_KERNEL void splitQuads(std::size_t first, std::size_t end, Mesh& mesh, VertexSet& bad)
{
    for (std::size_t i = first; i < end; i += 2) {
        std::array<std::uint32_t, 3>* const t = mesh.triangles.data() + i;
        const std::uint32_t q[4] = {t[0][0], t[0][1], t[0][2], t[1][2]};
        const Vec3f *p[4], *n[4];
        for (int k = 0; k < 4; ++k) {
            p[k] = &mesh.positions[q[k]];
            n[k] = &mesh.normals[q[k]];
        }
        bool isBad[2];
        const int half = splitQuad(p, n, isBad);
        for (int k = 0; k < 2; ++k) {
            for (int c = 0; c < 3; ++c) t[k][c] = q[halves[half + k][c]];
            if (!isBad[k]) continue;
            for (const std::uint32_t v : t[k]) bad.add(v);
        }
    }
}

namespace
{

/// How bad the worst of some triangles is: at least leastQuality if none is bad.
float worstOf(const Mesh& mesh, const std::uint32_t* begin, const std::uint32_t* end)
{
    float worst = 1.0f;
    for (const std::uint32_t* i = begin; i < end; i += 4) {
        Triangles t;
        for (int l = 0; l < 4; ++l) put(mesh, mesh.triangles[i + l < end ? i[l] : *begin], l, t);
        t.measure();
        for (int l = 0; l < 4; ++l)
            worst = smaller(worst, smaller(t.quality[l], t.agreement[l] + leastQuality));
    }
    return worst;
}

/// The triangles at some vertices and at their neighbours.
struct Surroundings {
    VertexSet vertices;
    VertexTriangles triangles; // at each of these

    /// Each pass goes through all triangles: two rings of neighbours are asked for at once, since
    /// the vertices that move next are among them.
    Surroundings(const Mesh& mesh, const VertexSet& some, const Progress& progress)
        : vertices(withNeighbours(mesh, withNeighbours(mesh, some, progress), progress))
    {
        vertices.count();
        triangles = vertexTriangles(mesh, vertices, progress);
    }

    /// The first and the end of the triangles at one of the vertices.
    std::pair<const std::uint32_t*, const std::uint32_t*> at(std::uint32_t v) const
    {
        const auto* begin = triangles.begins.data() + vertices.place(v);
        return {triangles.triangles.data() + begin[0], triangles.triangles.data() + begin[1]};
    }
};

/// When a vertex is moved in a round: blocks of space take turns by the parity of their places.
/// Edges are shorter than blocks, so no triangle has corners in two blocks of a turn.
struct PlaceInBlock {
    int turn; // 0 to 7
    Coord block;
    std::uint32_t vertex;

    bool operator<(const PlaceInBlock& other) const
    {
        return std::tie(turn, block, vertex) < std::tie(other.turn, other.block, other.vertex);
    }
};

std::vector<PlaceInBlock> placesOf(const Mesh& mesh, const std::vector<std::uint32_t>& some,
                                   double voxel, const Progress& progress)
{
    constexpr double blockVox = 8.0;
    std::vector<PlaceInBlock> places(some.size());
    parallelFor(some.size(), progress, [&](std::size_t n) {
        const Coord block = Coord::floor(Vec3d(mesh.positions[some[n]]) / (blockVox * voxel));
        const int turn = (block.x() & 1) << 2 | (block.y() & 1) << 1 | (block.z() & 1);
        places[n] = {turn, block, some[n]};
    });
    tbb::parallel_sort(places.begin(), places.end());
    return places;
}

/// Moves a vertex to the centroid of its neighbours if that mends its triangles.
/// @param[out] bad  the corners of those that stay bad are added to it
void relaxOne(SurfaceVertices& vertices, std::uint32_t v, const Surroundings& around, double voxel,
              SplineSampler& sampler, VertexSet& bad)
{
    Mesh& mesh = vertices.mesh;
    const auto [begin, end] = around.at(v);
    const float before = worstOf(mesh, begin, end);
    if (before >= leastQuality) return;
    Vec3d centroid(0.0);
    for (auto i = begin; i != end; ++i) {
        for (const std::uint32_t w : mesh.triangles[*i]) {
            if (w != v) centroid += Vec3d(mesh.positions[w]);
        }
    }
    centroid /= 2.0 * double(end - begin); // each neighbour lies on two triangles
    const Vec3f oldPosition = mesh.positions[v], oldNormal = mesh.normals[v];
    const float oldSlope = vertices.slopes[v];
    const float oldMean = mesh.scalars[0].values[v], oldGauss = mesh.scalars[1].values[v];
    Vec3d x = centroid;
    Jet jet;
    if (!moveToSurface(sampler, voxel, 1.0, x, jet)) return;
    vertices.set(v, x, jet);
    if (worstOf(mesh, begin, end) <= before) {
        vertices.set(v, oldPosition, oldNormal, oldSlope, oldMean, oldGauss);
        return;
    }
    for (auto i = begin; i != end; ++i) {
        if (worstOf(mesh, i, i + 1) >= leastQuality) continue;
        for (const std::uint32_t w : mesh.triangles[*i]) bad.add(w);
    }
}

} // namespace

void relax(SurfaceVertices& vertices, const Spline& spline, double voxel, VertexSet bad,
           const Progress& progress)
{
    constexpr int rounds = 8;
    const Mesh& mesh = vertices.mesh;
    std::optional<Surroundings> around;
    for (int round = 0; round < rounds; ++round) {
        bad.count();
        const std::vector<std::uint32_t> listed = bad.list();
        if (listed.empty()) break;
        const auto known = [&](std::uint32_t v) { return around->vertices.has(v); };
        if (!around || !std::all_of(listed.begin(), listed.end(), known))
            around.emplace(mesh, bad, progress);
        VertexSet still(mesh.positions.size());
        const std::vector<PlaceInBlock> places = placesOf(mesh, listed, voxel, progress);
        std::vector<std::size_t> begins; // of blocks, and the end
        for (std::size_t n = 0; n < places.size(); ++n)
            if (n == 0 || places[n].block != places[n - 1].block) begins.push_back(n);
        begins.push_back(places.size());
        for (std::size_t b = 0, end; b + 1 < begins.size(); b = end) {
            const int turn = places[begins[b]].turn;
            for (end = b; end + 1 < begins.size() && places[begins[end]].turn == turn;) ++end;
            parallelFor(end - b, progress, [&](std::size_t k) {
                SplineSampler sampler(spline);
                for (std::size_t n = begins[b + k]; n < begins[b + k + 1]; ++n)
                    relaxOne(vertices, places[n].vertex, *around, voxel, sampler, still);
            });
        }
        bad = std::move(still);
    }
}

} // namespace molsurf
