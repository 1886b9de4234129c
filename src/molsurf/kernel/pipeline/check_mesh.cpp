// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/pipeline/check_mesh.h"

#include "molsurf/error.h"
#include "molsurf/kernel.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/kernel/mesh/measure.h"
#include "molsurf/kernel/pipeline/surface_kind.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

[[noreturn]] void fail(const std::string& what)
{
    throw Error(ErrorKind::Check, "mesh: " + what);
}

/// The edges that do not have two triangles which run through them in opposite directions.
std::vector<std::array<std::uint32_t, 2>> badEdges(const Mesh& mesh)
{
    // The lower end, the higher one, and whether its triangle runs from the lower to the higher.
    std::vector<std::array<std::uint32_t, 3>> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (const auto& t : mesh.triangles) {
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k], b = t[(k + 1) % 3];
            edges.push_back({std::min(a, b), std::max(a, b), a < b});
        }
    }
    std::sort(edges.begin(), edges.end());
    std::vector<std::array<std::uint32_t, 2>> out;
    for (std::size_t i = 0, end; i < edges.size(); i = end) {
        end = i + 1;
        while (end < edges.size() && edges[end][0] == edges[i][0] && edges[end][1] == edges[i][1])
            ++end;
        if (end - i != 2 || edges[i][2] == edges[i + 1][2])
            out.push_back({edges[i][0], edges[i][1]});
    }
    return out;
}

/// The volume inside the triangles [Å^3].
double flatVolume(const Mesh& mesh, const Progress& progress)
{
    constexpr std::size_t chunk = 4096;
    const std::size_t count = mesh.triangles.size();
    const Vec3d origin(mesh.positions[0]);
    return parallelSum<double>((count + chunk - 1) / chunk, progress, [&](std::size_t c) {
        double sum = 0.0;
        for (std::size_t i = c * chunk; i < std::min(count, (c + 1) * chunk); ++i) {
            const auto& t = mesh.triangles[i];
            const Vec3d a(mesh.positions[t[0]]), ab = Vec3d(mesh.positions[t[1]]) - a,
                                                 ac = Vec3d(mesh.positions[t[2]]) - a;
            sum += (a - origin).dot(ab.cross(ac)) / 6.0; // of edges, which do not cancel
        }
        return sum;
    });
}

} // namespace

void checkMesh(const Mesh& mesh, const SurfaceReport& report, double voxel,
               const Progress& progress)
{
    if (mesh.triangles.empty()) return;
    if (!report.closed || !report.manifold) {
        const auto edges = badEdges(mesh);
        if (edges.empty()) fail("it is no manifold at a vertex");
        const openvdb::Vec3f& x = mesh.positions[edges[0][0]];
        fail(formatted(
            "expected two triangles at each edge, %zu edges have not, the first at (%.2f, "
            "%.2f, %.2f) Å",
            edges.size(), double(x[0]), double(x[1]), double(x[2])));
    }
    // A closed piece with g handles has the Euler number 2 - 2 g.
    const int pieces = report.components + int(report.cavities.size());
    const int chi = report.meshEulerCharacteristic;
    if (chi % 2 != 0 || chi > 2 * pieces)
        fail(formatted("its Euler number %d is that of no %d closed surfaces", chi, pieces));
    if (report.maxResidual > largestResidual * voxel) // false for what is not known
        fail(formatted("a vertex lies %.2g Å beside the surface, expected %.2g Å at most",
                       report.maxResidual, largestResidual * voxel));
    constexpr double share = 0.1; // of a voxel, between chords and arcs
    const double flat = flatVolume(mesh, progress);
    if (std::abs(flat - report.volume) <= share * voxel * report.area) return;
    throw Error(ErrorKind::Numeric, "mesh: the voxels are too large for the surface: triangles and "
                                    "arcs between its vertices enclose volumes that differ [hint: "
                                    "a smaller `voxel`]");
}

void warnOfMesh(const SurfaceReport& surface, double voxel, std::vector<std::string>& warnings)
{
    constexpr double most = 0.05; // of the area that the mesh may lack
    const int pieces = surface.components + int(surface.cavities.size());
    if (surface.piecesKnown && surface.meshComponents != pieces)
        warnings.push_back(formatted(
            "mesh: it has %s, the surface %d: voxels join or cut what is narrower",
            counted(std::size_t(surface.meshComponents), "closed piece", "closed pieces").c_str(),
            pieces));
    const double off = 1.0 - *surface.meshArea / surface.area;
    if (std::abs(off) <= most) return;
    // The area that a mesh lacks along creases grows with the voxel.
    const double fine = std::max(0.8 * voxel * most / std::abs(off), minVoxel);
    warnings.push_back(formatted("mesh: its area is %.1f %% %s that of the surface [hint: `voxel` "
                                 "%.2g]",
                                 100.0 * std::abs(off), off > 0.0 ? "below" : "above", fine));
}

} // namespace molsurf
