// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/measure.h"

#include "molsurf/core/parallel.h"
#include "molsurf/surface/topology.h"

#include <algorithm>
#include <map>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

using Sums = PieceMeasure;

/// Midpoint of the arc between two points with normals.
Vec3d arcMidpoint(const Vec3d& p, const Vec3d& m, const Vec3d& q, const Vec3d& n)
{
    const Vec3d e = q - p;
    return 0.5 * (p + q) + 0.125 * (e.dot(n) * n - e.dot(m) * m);
}

/// Six points of a triangle with weights, exact for polynomials of degree 4 (Dunavant, High degree
/// efficient symmetrical Gaussian quadrature rules for the triangle, Int. J. Numer. Methods Eng.
/// 21:1129-1148, 1985). Each row: two equal barycentric coordinates, weight.
constexpr double rule[2][2] = {{0.445948490915965, 0.223381589678011},
                               {0.091576213509771, 0.109951743655322}};

Sums measurePatch(const Mesh& mesh, const std::array<std::uint32_t, 3>& t, const Vec3d& origin)
{
    Vec3d p[3], n[3];
    for (int k = 0; k < 3; ++k) {
        p[k] = Vec3d(mesh.positions[t[k]]) - origin;
        n[k] = Vec3d(mesh.normals[t[k]]);
    }
    Vec3d mid[3]; // opposite to corner k
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        mid[k] = arcMidpoint(p[i], n[i], p[j], n[j]);
    }
    Sums sums;
    for (const auto& [equal, weight] : rule) {
        for (int k = 0; k < 3; ++k) {
            double b[3] = {equal, equal, equal};
            b[k] = 1.0 - 2.0 * equal;
            // x = sum b_k (2 b_k - 1) p_k + sum 4 b_i b_j mid_k; derivatives along b_1 and b_2 with
            // b_0 = 1 - b_1 - b_2
            Vec3d x(0.0), d[3];
            for (int c = 0; c < 3; ++c) {
                const int i = (c + 1) % 3, j = (c + 2) % 3;
                x += b[c] * (2.0 * b[c] - 1.0) * p[c] + 4.0 * b[i] * b[j] * mid[c];
                d[c] = (4.0 * b[c] - 1.0) * p[c] + 4.0 * (b[i] * mid[j] + b[j] * mid[i]);
            }
            const Vec3d normal = (d[1] - d[0]).cross(d[2] - d[0]); // twice the area element
            sums.area += 0.5 * weight * normal.length();
            sums.volume += 0.5 * weight * x.dot(normal) / 3.0;
        }
    }
    return sums;
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
        for (std::size_t i = c * chunk; i < end; ++i) {
            const auto& t = mesh.triangles[i];
            partial[c][pieces[t[0]]] += measurePatch(mesh, t, origin);
            const Vec3d a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), d(mesh.positions[t[2]]);
            flats[c] += (b - a).cross(d - a).lengthSqr() == 0.0;
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

    const Topology topology = checkTopology(mesh, vertexTriangles(mesh), progress);
    report.closed = topology.closed;
    report.manifold = topology.manifold && topology.oriented;
    report.eulerCharacteristic =
        int(std::int64_t(mesh.positions.size()) - std::int64_t(mesh.triangles.size() * 3 / 2) +
            std::int64_t(mesh.triangles.size()));
    std::size_t count = 0;
    const std::vector<std::uint32_t> pieces = connectedPieces(mesh, count);

    // Volumes are taken about a vertex, so that they do not cancel far from the origin.
    const std::vector<Sums> sums = measurePieces(mesh, pieces, count, Vec3d(mesh.positions[0]),
                                                 report.degenerateTriangles, progress);
    countPieces(sums, report);
    return report;
}

} // namespace molsurf
