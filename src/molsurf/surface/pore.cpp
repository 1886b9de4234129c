// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/pore.h"

#include "molsurf/analysis/pockets/find_pore.h"
#include "molsurf/kernel/core/orthonormal_basis.h"
#include "molsurf/kernel/pipeline/surface_run.h"
#include "molsurf/show/color/pore_color.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

void addPore(const BallSet& atoms, const SurfaceOptions& options, Progress& progress,
             Report& report)
{
    Stopwatch watch(report);
    progress.update("pore", 0.0);
    report.pore = findPore(atoms.balls, *options.places.pore, progress);
    watch.stop("pore");
}

void addTube(const std::vector<Report::Pore::Station>& stations, Mesh& mesh)
{
    constexpr std::uint32_t sides = 32;
    constexpr double thread = 0.05; // radius of the tube where the pore is closed [Å]
    constexpr double fullTurn = 6.283185307179586;
    const auto base = std::uint32_t(mesh.positions.size());
    const auto add = [&](const openvdb::Vec3d& x, const openvdb::Vec3d& normal, double radius) {
        mesh.positions.emplace_back(x);
        mesh.normals.emplace_back(normal);
        mesh.scalars[0].values.push_back(float(radius));
        mesh.colors.push_back(poreColor(radius));
    };
    const auto vectorOf = [](const std::array<double, 3>& v) {
        return openvdb::Vec3d(v[0], v[1], v[2]);
    };
    openvdb::Vec3d across(0.0);
    for (const Report::Pore::Station& station : stations) {
        const openvdb::Vec3d normal = vectorOf(station.normal);
        // Parallel transport: the last ring's first direction, made normal to this one's axis. So
        // rings do not twist.
        across -= normal * normal.dot(across);
        if (!(across.lengthSqr() > 1e-6)) across = perpendicular(normal)[0];
        across.normalize();
        const openvdb::Vec3d other = normal.cross(across);
        for (std::uint32_t k = 0; k < sides; ++k) {
            const double angle = fullTurn * k / sides;
            const openvdb::Vec3d way = across * std::cos(angle) + other * std::sin(angle);
            add(vectorOf(station.place) + way * std::max(station.radius, thread), way,
                station.radius);
        }
    }
    const std::uint32_t rings = std::uint32_t(stations.size());
    for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
        for (std::uint32_t k = 0; k < sides; ++k) {
            const std::uint32_t a = base + ring * sides + k,
                                b = base + ring * sides + (k + 1) % sides;
            mesh.triangles.push_back({a, b, b + sides});
            mesh.triangles.push_back({a, b + sides, a + sides});
        }
    }
    for (const bool last : {false, true}) { // the ends: fans of triangles about their middles
        const Report::Pore::Station& end = last ? stations.back() : stations.front();
        const std::uint32_t middle = std::uint32_t(mesh.positions.size());
        const std::uint32_t first = base + (last ? (rings - 1) * sides : 0);
        add(vectorOf(end.place), vectorOf(end.normal) * (last ? 1.0 : -1.0), end.radius);
        for (std::uint32_t k = 0; k < sides; ++k) {
            const std::uint32_t a = first + k, b = first + (k + 1) % sides;
            mesh.triangles.push_back(last ? std::array{middle, a, b} : std::array{middle, b, a});
        }
    }
}

Mesh poreTube(const Report::Pore& pore)
{
    Mesh mesh;
    mesh.scalars.push_back({"radius", {}});
    addTube(pore.stations, mesh);
    for (const Report::Pore& other : pore.bundle) addTube(other.stations, mesh);
    return mesh;
}

} // namespace molsurf
