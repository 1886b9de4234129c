// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/mesh/measure.h"

#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/core/simd.h"
#include "molsurf/kernel/mesh/topology.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

/// Six points of a triangle with weights, exact for polynomials of degree 4 (Dunavant, High degree
/// efficient symmetrical Gaussian quadrature rules for the triangle, Int. J. Numer. Methods Eng.
/// 21:1129-1148, 1985). Each row: two equal barycentric coordinates, weight.
constexpr float rule[2][2] = {{0.445948490915965f, 0.223381589678011f},
                              {0.091576213509771f, 0.109951743655322f}};

/// A vector in each lane: `along` the axes.
struct Vectors {
    Floats along[3];

    MOLSURF_INLINE Floats& operator[](int axis) { return along[axis]; }
    MOLSURF_INLINE const Floats& operator[](int axis) const { return along[axis]; }
};
struct DoubleVectors {
    Doubles along[3];

    MOLSURF_INLINE Doubles& operator[](int axis) { return along[axis]; }
    MOLSURF_INLINE const Doubles& operator[](int axis) const { return along[axis]; }
};

/// Half of the lanes as numbers of double length.
MOLSURF_INLINE DoubleVectors halfOf(const Vectors& v, int half)
{
    DoubleVectors out;
    for (int a = 0; a < 3; ++a)
        for (int l = 0; l < doubleLanes; ++l) out[a][l] = double(v[a][doubleLanes * half + l]);
    return out;
}

/// Triangles side by side, one a lane.
struct Patches {
    Vectors corner[3], normal[3];
    Floats area;        ///< of the patch [Å^2]
    double volume[8];   ///< of the cone of the patch and the origin [Å^3]
    double flatArea[8]; ///< of the triangle [Å^2]
};
static_assert(floatLanes == 8 && doubleLanes == 4);

template<typename V>
MOLSURF_INLINE V cross(const V& u, const V& v)
{
    V out;
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        out[a] = u[b] * v[c] - u[c] * v[b];
    }
    return out;
}

template<typename V>
MOLSURF_INLINE auto dot(const V& u, const V& v)
{
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

/// Measures quadratic patches through the corners and the midpoints of arcs between them.
/// Positions are taken relative to the first corner: so small that float is enough.
MOLSURF_KERNEL void measurePatches(const Vec3d& origin, Patches& s)
{
    Vectors p[3], mid[3]; // mid: opposite to corner k
    for (int k = 0; k < 3; ++k)
        for (int a = 0; a < 3; ++a) p[k][a] = s.corner[k][a] - s.corner[0][a];
    DoubleVectors bulges[2] = {};
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        Vectors edge, arc; // from the midpoint of the edge to that of the arc
        for (int a = 0; a < 3; ++a) edge[a] = p[j][a] - p[i][a];
        const Floats along = dot(edge, s.normal[j]), against = dot(edge, s.normal[i]);
        for (int a = 0; a < 3; ++a) {
            // along n_j - against n_i, with the same bits from both sides of the edge
            arc[a] = 0.0625f * ((along - against) * (s.normal[j][a] + s.normal[i][a]) +
                                (along + against) * (s.normal[j][a] - s.normal[i][a]));
            mid[k][a] = 0.5f * (p[i][a] + p[j][a]) + arc[a];
        }
        // 3/2 of what the arc over the edge adds to the integral of the normal over the triangle
        const Vectors bulge = cross(arc, edge);
        for (int half = 0; half < 2; ++half) {
            const DoubleVectors b = halfOf(bulge, half);
            for (int a = 0; a < 3; ++a) bulges[half][a] += b[a];
        }
    }
    Floats area{}, volume{};
    for (const auto& [equal, weight] : rule) {
        for (int k = 0; k < 3; ++k) {
            float b[3] = {equal, equal, equal};
            b[k] = 1.0f - 2.0f * equal;
            // x = sum b_k (2 b_k - 1) p_k + sum 4 b_i b_j mid_k, with p_0 = 0; u and v are its
            // derivatives along b_1 and b_2 with b_0 = 1 - b_1 - b_2.
            Vectors x, u, v;
            for (int a = 0; a < 3; ++a) {
                const Floats p1 = p[1][a], p2 = p[2][a];
                const Floats m0 = mid[0][a], m1 = mid[1][a], m2 = mid[2][a];
                x[a] = b[1] * (2.0f * b[1] - 1.0f) * p1 + b[2] * (2.0f * b[2] - 1.0f) * p2 +
                       4.0f * (b[1] * b[2] * m0 + b[2] * b[0] * m1 + b[0] * b[1] * m2);
                const Floats d0 = 4.0f * (b[1] * m2 + b[2] * m1);
                u[a] = (4.0f * b[1] - 1.0f) * p1 + 4.0f * (b[0] * m2 + b[2] * m0) - d0;
                v[a] = (4.0f * b[2] - 1.0f) * p2 + 4.0f * (b[0] * m1 + b[1] * m0) - d0;
            }
            const Vectors normal = cross(u, v); // twice the area element
            area += 0.5f * weight * squareRoot(dot(normal, normal));
            volume += weight / 6.0f * dot(x, normal);
        }
    }
    s.area = area;
    for (int half = 0; half < 2; ++half) {
        // About another point the cone is larger by that of the integral of the normal. That
        // vanishes over closed pieces: what neighbours have in common cancels to the bit.
        const DoubleVectors first = halfOf(s.corner[0], half);
        DoubleVectors u = halfOf(s.corner[1], half), v = halfOf(s.corner[2], half), way, n;
        for (int a = 0; a < 3; ++a) {
            u[a] -= first[a];
            v[a] -= first[a];
            way[a] = first[a] - origin[a];
        }
        const DoubleVectors across = cross(u, v);
        for (int a = 0; a < 3; ++a) n[a] = 0.5 * across[a] + 2.0 / 3.0 * bulges[half][a];
        const Doubles shift = dot(way, n) / 3.0, across2 = dot(across, across);
        for (int l = 0; l < doubleLanes; ++l) {
            const int lane = doubleLanes * half + l;
            s.volume[lane] = double(volume[lane]) + shift[l];
            s.flatArea[lane] = 0.5 * std::sqrt(across2[l]);
        }
    }
}

/// Puts a triangle into a lane.
MOLSURF_INLINE void put(const Mesh& mesh, const std::array<std::uint32_t, 3>& t, int lane,
                        Patches& patches)
{
    for (int k = 0; k < 3; ++k) {
        for (int a = 0; a < 3; ++a) {
            patches.corner[k][a][lane] = mesh.positions[t[k]][a];
            patches.normal[k][a][lane] = mesh.normals[t[k]][a];
        }
    }
}

} // namespace

std::vector<PieceMeasure> measurePieces(const Mesh& mesh, const std::vector<std::uint32_t>& pieces,
                                        std::size_t count, const Vec3d& origin, TriangleSums& sums,
                                        const Progress& progress)
{
    constexpr std::size_t chunk = 2048;
    const std::size_t chunks = (mesh.triangles.size() + chunk - 1) / chunk;
    std::vector<std::map<std::uint32_t, PieceMeasure>> partial(chunks);
    std::vector<TriangleSums> triangles(chunks);
    parallelFor(chunks, progress, [&](std::size_t c) {
        const std::size_t end = std::min(mesh.triangles.size(), (c + 1) * chunk);
        Patches patches{};
        std::uint32_t piece = 0; // the last that was met, and its sum
        PieceMeasure* sum = nullptr;
        for (std::size_t first = c * chunk; first < end; first += floatLanes) {
            const int used = int(std::min<std::size_t>(floatLanes, end - first));
            for (int l = 0; l < used; ++l) put(mesh, mesh.triangles[first + l], l, patches);
            measurePatches(origin, patches);
            for (int l = 0; l < used; ++l) {
                const std::uint32_t p = pieces[mesh.triangles[first + l][0]];
                if (!sum || p != piece) sum = &partial[c][piece = p];
                *sum += {double(patches.area[l]), patches.volume[l]};
                triangles[c] += {patches.flatArea[l], std::size_t(patches.flatArea[l] == 0.0)};
            }
        }
    });
    std::vector<PieceMeasure> out(count);
    for (std::size_t c = 0; c < chunks; ++c) {
        for (const auto& [piece, s] : partial[c]) out[piece] += s;
        sums += triangles[c];
    }
    return out;
}

void addPiece(double area, double volume, bool cavity, SurfaceReport& report)
{
    report.area += area;
    report.volume += volume;
    if (cavity) {
        report.cavities.push_back({area, -volume});
    } else {
        ++report.components;
        report.outerArea += area;
        report.outerVolume += volume;
    }
}

void dropTopology(SurfaceReport& report)
{
    report.eulerCharacteristic.reset();
    report.piecesKnown = false;
    report.components = 0;
    report.cavities.clear();
    report.outerArea = report.outerVolume = 0.0;
}

void sortCavities(SurfaceReport& report)
{
    std::stable_sort(report.cavities.begin(), report.cavities.end(),
                     [](const SurfaceReport::Cavity& a, const SurfaceReport::Cavity& b) {
                         return a.volume > b.volume;
                     });
}

void countPieces(const std::vector<PieceMeasure>& pieces, SurfaceReport& report)
{
    report.meshComponents += int(pieces.size());
    for (const PieceMeasure& s : pieces) addPiece(s.area, s.volume, s.volume < 0.0, report);
    sortCavities(report);
}

void describeGradients(const GradientCounts& counts, std::size_t vertices, SurfaceReport& report)
{
    report.kinkShare = vertices ? double(counts.kink) / double(vertices) : 0.0;
    report.gradientShare = double(counts.unit) / double(vertices - counts.kink); // or 0/0
}

MeshPieces piecesOf(const Mesh& mesh, const Progress& progress)
{
    if (mesh.triangles.empty()) return {};
    return piecesOf(mesh, Vec3d(mesh.positions[0]), progress);
}

MeshPieces piecesOf(const Mesh& mesh, const Vec3d& origin, const Progress& progress)
{
    MeshPieces pieces;
    std::size_t count = 0;
    pieces.of = connectedPieces(mesh, count, progress);
    pieces.measures = measurePieces(mesh, pieces.of, count, origin, pieces.triangles, progress);
    return pieces;
}

SurfaceReport measure(const Mesh& mesh, const MeshPieces& pieces, const Progress& progress)
{
    SurfaceReport report;
    report.vertices = mesh.positions.size();
    report.triangles = mesh.triangles.size();
    if (mesh.triangles.empty()) return report;

    const Topology topology = checkTopology(mesh, progress);
    report.closed = topology.closed;
    report.manifold = topology.manifold && topology.oriented;
    report.degenerateTriangles = pieces.triangles.flat;
    report.eulerCharacteristic = report.meshEulerCharacteristic =
        int(std::int64_t(mesh.positions.size()) - std::int64_t(mesh.triangles.size() * 3 / 2) +
            std::int64_t(mesh.triangles.size()));
    countPieces(pieces.measures, report);
    report.triangleArea = pieces.triangles.area;
    return report;
}

SurfaceReport measure(const Mesh& mesh, const Progress& progress)
{
    return measure(mesh, piecesOf(mesh, progress), progress);
}

} // namespace molsurf
