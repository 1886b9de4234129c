// SPDX-License-Identifier: MPL-2.0
#include "molsurf/mesh/triangle_shape.h"

#include "molsurf/core/simd.h"
#include "molsurf/mesh/topology.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace molsurf
{

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

MOLSURF_KERNEL void splitQuads(const Mesh& mesh,
                               const std::vector<std::array<std::uint32_t, 4>>& quads,
                               std::array<std::uint32_t, 3>* out, std::vector<std::uint32_t>& bad)
{
    for (const auto& q : quads) {
        const Vec3f *p[4], *n[4];
        for (int k = 0; k < 4; ++k) {
            p[k] = &mesh.positions[q[k]];
            n[k] = &mesh.normals[q[k]];
        }
        bool isBad[2];
        const int first = splitQuad(p, n, isBad);
        for (int k = 0; k < 2; ++k, ++out) {
            for (int c = 0; c < 3; ++c) (*out)[c] = q[halves[first + k][c]];
            if (isBad[k]) bad.insert(bad.end(), out->begin(), out->end());
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

/// Sorts indices and drops those that come again.
void makeSet(std::vector<std::uint32_t>& indices)
{
    std::sort(indices.begin(), indices.end());
    indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
}

/// The triangles about some vertices and about their neighbours.
struct Surroundings {
    std::vector<std::uint32_t> vertices; // in ascending order
    VertexTriangles triangles;           // at each of these

    bool hold(const std::vector<std::uint32_t>& some) const
    {
        return std::includes(vertices.begin(), vertices.end(), some.begin(), some.end());
    }

    /// The first and the end of the triangles at one of the vertices.
    std::pair<const std::uint32_t*, const std::uint32_t*> at(std::uint32_t v) const
    {
        const auto place = std::lower_bound(vertices.begin(), vertices.end(), v);
        const auto* begin = triangles.begins.data() + (place - vertices.begin());
        return {triangles.triangles.data() + begin[0], triangles.triangles.data() + begin[1]};
    }

    /// Each pass goes through all triangles: two rings of neighbours are asked for at once, since
    /// the vertices that move next are among them.
    void find(const Mesh& mesh, const std::vector<std::uint32_t>& some, const Progress& progress)
    {
        constexpr int rings = 2;
        vertices = some;
        triangles = vertexTriangles(mesh, vertices, progress);
        for (int ring = 0; ring < rings; ++ring) {
            for (const std::uint32_t i : triangles.triangles)
                vertices.insert(vertices.end(), mesh.triangles[i].begin(), mesh.triangles[i].end());
            makeSet(vertices);
            triangles = vertexTriangles(mesh, vertices, progress);
        }
    }
};

} // namespace

void relax(SurfaceVertices& vertices, const Spline& spline, double voxel,
           std::vector<std::uint32_t> bad, const Progress& progress)
{
    constexpr int rounds = 8;
    Mesh& mesh = vertices.mesh;
    SplineSampler sampler(spline);
    Surroundings around;
    for (int round = 0; round < rounds && !bad.empty(); ++round) {
        makeSet(bad);
        if (!around.hold(bad)) around.find(mesh, bad, progress);
        std::vector<std::uint32_t> still;
        for (const std::uint32_t v : bad) {
            const auto [begin, end] = around.at(v);
            const float before = worstOf(mesh, begin, end);
            if (before >= leastQuality) continue;
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
            if (!moveToSurface(sampler, voxel, 1.0, x, jet)) continue;
            vertices.set(v, x, jet);
            if (worstOf(mesh, begin, end) <= before) {
                vertices.set(v, oldPosition, oldNormal, oldSlope, oldMean, oldGauss);
                continue;
            }
            for (auto i = begin; i != end; ++i) {
                if (worstOf(mesh, i, i + 1) >= leastQuality) continue;
                const auto& t = mesh.triangles[*i];
                still.insert(still.end(), t.begin(), t.end());
            }
        }
        bad = std::move(still);
    }
}

} // namespace molsurf
