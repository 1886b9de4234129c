// SPDX-License-Identifier: MPL-2.0
#include "molsurf/mesh/measure.h"

#include "molsurf/core/parallel.h"
#include "molsurf/core/simd.h"
#include "molsurf/mesh/topology.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

using Sums = PieceMeasure;

/// Six points of a triangle with weights, exact for polynomials of degree 4 (Dunavant, High degree
/// efficient symmetrical Gaussian quadrature rules for the triangle, Int. J. Numer. Methods Eng.
/// 21:1129-1148, 1985). Each row: two equal barycentric coordinates, weight.
constexpr double rule[2][2] = {{0.445948490915965, 0.223381589678011},
                               {0.091576213509771, 0.109951743655322}};

/// The vectors of as many triangles as there are lanes.
struct Vectors {
    Doubles along[3]; ///< by axis

    MOLSURF_INLINE Doubles& operator[](int axis) { return along[axis]; }
    MOLSURF_INLINE const Doubles& operator[](int axis) const { return along[axis]; }
};

/// Triangles side by side, one a lane.
struct Patches {
    Vectors p[3];   ///< positions of the corners [Å]
    Vectors n[3];   ///< unit normals there
    Doubles area;   ///< of the patch [Å^2]
    Doubles volume; ///< of the cone of the patch and the origin [Å^3]
    Doubles flat;   ///< twice the area of the triangle, squared
};

MOLSURF_INLINE Vectors cross(const Vectors& u, const Vectors& v)
{
    Vectors out;
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        out[a] = u[b] * v[c] - u[c] * v[b];
    }
    return out;
}

MOLSURF_INLINE Doubles dot(const Vectors& u, const Vectors& v)
{
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

/// Areas and volumes of quadratic patches through the corners and the midpoints of arcs between
/// them.
MOLSURF_KERNEL void measurePatches(Patches& s)
{
    Vectors mid[3]; // opposite to corner k
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        Vectors edge;
        for (int a = 0; a < 3; ++a) edge[a] = s.p[j][a] - s.p[i][a];
        const Doubles along = dot(edge, s.n[j]), against = dot(edge, s.n[i]);
        for (int a = 0; a < 3; ++a) {
            mid[k][a] =
                0.5 * (s.p[i][a] + s.p[j][a]) + 0.125 * (along * s.n[j][a] - against * s.n[i][a]);
        }
    }
    s.area = s.volume = Doubles{};
    for (const auto& [equal, weight] : rule) {
        for (int k = 0; k < 3; ++k) {
            double b[3] = {equal, equal, equal};
            b[k] = 1.0 - 2.0 * equal;
            // x = sum b_k (2 b_k - 1) p_k + sum 4 b_i b_j mid_k; derivatives along b_1 and b_2 with
            // b_0 = 1 - b_1 - b_2
            Vectors x, u, v;
            for (int a = 0; a < 3; ++a) {
                Doubles d[3];
                x[a] = Doubles{};
                for (int c = 0; c < 3; ++c) {
                    const int i = (c + 1) % 3, j = (c + 2) % 3;
                    x[a] += b[c] * (2.0 * b[c] - 1.0) * s.p[c][a] + 4.0 * b[i] * b[j] * mid[c][a];
                    d[c] = (4.0 * b[c] - 1.0) * s.p[c][a] +
                           4.0 * (b[i] * mid[j][a] + b[j] * mid[i][a]);
                }
                u[a] = d[1] - d[0];
                v[a] = d[2] - d[0];
            }
            const Vectors normal = cross(u, v); // twice the area element
            s.area += 0.5 * weight * squareRoot(dot(normal, normal));
            s.volume += weight / 6.0 * dot(x, normal);
        }
    }
    Vectors u, v;
    for (int a = 0; a < 3; ++a) {
        u[a] = s.p[1][a] - s.p[0][a];
        v[a] = s.p[2][a] - s.p[0][a];
    }
    const Vectors normal = cross(u, v);
    s.flat = dot(normal, normal);
}

/// Puts a triangle into a lane, with positions about an origin.
void load(const Mesh& mesh, const std::array<std::uint32_t, 3>& t, const Vec3d& origin, int lane,
          Patches& patches)
{
    for (int k = 0; k < 3; ++k) {
        for (int a = 0; a < 3; ++a) {
            patches.p[k][a][lane] = double(mesh.positions[t[k]][a]) - origin[a];
            patches.n[k][a][lane] = mesh.normals[t[k]][a];
        }
    }
}

} // namespace

std::vector<PieceMeasure> measurePieces(const Mesh& mesh, const std::vector<std::uint32_t>& pieces,
                                        std::size_t count, const Vec3d& origin, std::size_t& flat,
                                        const Progress& progress)
{
    constexpr std::size_t chunk = 2048;
    const std::size_t chunks = (mesh.triangles.size() + chunk - 1) / chunk;
    std::vector<std::map<std::uint32_t, Sums>> partial(chunks);
    std::vector<std::size_t> flats(chunks, 0);
    parallelFor(chunks, progress, [&](std::size_t c) {
        const std::size_t end = std::min(mesh.triangles.size(), (c + 1) * chunk);
        Patches patches{};
        for (std::size_t first = c * chunk; first < end; first += doubleLanes) {
            const int used = int(std::min<std::size_t>(doubleLanes, end - first));
            for (int l = 0; l < used; ++l)
                load(mesh, mesh.triangles[first + l], origin, l, patches);
            measurePatches(patches);
            for (int l = 0; l < used; ++l) {
                partial[c][pieces[mesh.triangles[first + l][0]]] +=
                    {patches.area[l], patches.volume[l]};
                flats[c] += patches.flat[l] == 0.0;
            }
        }
    });
    std::vector<Sums> sums(count);
    for (std::size_t c = 0; c < chunks; ++c) {
        for (const auto& [piece, s] : partial[c]) sums[piece] += s;
        flat += flats[c];
    }
    return sums;
}

void countPieces(const std::vector<PieceMeasure>& pieces, SurfaceReport& report)
{
    for (const PieceMeasure& s : pieces) {
        report.area += s.area;
        report.volume += s.volume;
        if (s.volume < 0.0) {
            report.cavities.push_back({s.area, -s.volume});
        } else {
            ++report.components;
            report.outerArea += s.area;
            report.outerVolume += s.volume;
        }
    }
    std::stable_sort(report.cavities.begin(), report.cavities.end(),
                     [](const Cavity& a, const Cavity& b) { return a.volume > b.volume; });
}

SurfaceReport measure(const Mesh& mesh, const Progress& progress)
{
    SurfaceReport report;
    report.vertices = mesh.positions.size();
    report.triangles = mesh.triangles.size();
    if (mesh.triangles.empty()) return report;

    const Topology topology = checkTopology(mesh, progress);
    std::size_t count = 0;
    const std::vector<std::uint32_t> pieces = connectedPieces(mesh, count, progress);
    report.closed = topology.closed;
    report.manifold = topology.manifold && topology.oriented;
    report.eulerCharacteristic =
        int(std::int64_t(mesh.positions.size()) - std::int64_t(mesh.triangles.size() * 3 / 2) +
            std::int64_t(mesh.triangles.size()));

    // Volumes are taken about a vertex, so that they do not cancel far from the origin.
    const std::vector<Sums> sums = measurePieces(mesh, pieces, count, Vec3d(mesh.positions[0]),
                                                 report.degenerateTriangles, progress);
    countPieces(sums, report);
    return report;
}

} // namespace molsurf
