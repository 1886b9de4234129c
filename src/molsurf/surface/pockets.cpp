// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/pockets.h"

#include "molsurf/color/palette.h"
#include "molsurf/core/parallel.h"
#include "molsurf/core/words.h"
#include "molsurf/pockets/find_pockets.h"
#include "molsurf/surface/field_table.h"
#include "molsurf/surface/surface_run.h"

#include <algorithm>
#include <array>

namespace molsurf
{

namespace
{

/// The number of the pocket that a point of the surface is a wall of, or 0: that of most of the
/// voxels about the nearest place before it that has any.
std::int32_t pocketBefore(const openvdb::Int32Grid& ids, const openvdb::Vec3d& x,
                          const openvdb::Vec3d& normal)
{
    // Of voxels up to 1 Å the first one of a pocket lies within this of its wall.
    constexpr double most = 1.0, step = 0.25; // [Å]
    const auto voxels = ids.getConstUnsafeAccessor();
    for (double t = step; t <= most; t += step) {
        const openvdb::Vec3d at = ids.transform().worldToIndex(x + normal * t);
        const openvdb::Coord low = openvdb::Coord::floor(at);
        std::array<std::int32_t, 8> found;
        for (int k = 0; k < 8; ++k)
            found[std::size_t(k)] = voxels.getValue(low.offsetBy(k >> 2, k >> 1 & 1, k & 1));
        std::sort(found.begin(), found.end());
        std::int32_t best = 0;
        std::ptrdiff_t count = 0;
        for (const std::int32_t id : found) {
            if (id == 0 || std::count(found.begin(), found.end(), id) <= count) continue;
            best = id;
            count = std::count(found.begin(), found.end(), id);
        }
        if (best != 0) return best;
    }
    return 0;
}

/// Labels and colours the vertices by their pockets, each of which has a colour of its own.
void colorPockets(const Pockets& pockets, const Progress& progress, Mesh& mesh)
{
    Attribute<std::int32_t> label{"pocket", std::vector<std::int32_t>(mesh.positions.size()), {}};
    constexpr std::size_t chunk = 4096;
    parallelFor((mesh.positions.size() + chunk - 1) / chunk, progress, [&](std::size_t c) {
        for (std::size_t v = c * chunk; v < std::min(mesh.positions.size(), (c + 1) * chunk); ++v)
            label.values[v] = pocketBefore(*pockets.ids, openvdb::Vec3d(mesh.positions[v]),
                                           openvdb::Vec3d(mesh.normals[v]));
    });
    std::vector<std::vector<std::int32_t>> neighbours;
    label.names = {"elsewhere"};
    for (const PocketReport& pocket : pockets.list) {
        neighbours.emplace_back(pocket.neighbours.begin(), pocket.neighbours.end());
        label.names.push_back(formatted("%zu: %.0f Å³", neighbours.size(), pocket.volume));
    }
    // The largest have colours of their own, and the others those again.
    neighbours.resize(std::min(neighbours.size(), mostDistinct));
    const auto most = std::int32_t(neighbours.size());
    for (std::vector<std::int32_t>& near : neighbours)
        near.erase(std::remove_if(near.begin(), near.end(), [=](auto n) { return n >= most; }),
                   near.end());
    const std::vector<Color> colors = distinctColors(neighbours);
    mesh.colors.assign(mesh.positions.size(), neutralColor);
    for (std::size_t v = 0; v < mesh.colors.size(); ++v)
        if (const std::int32_t id = label.values[v]; id > 0)
            mesh.colors[v] = colors[std::size_t(id - 1) % colors.size()];
    mesh.labels.push_back(std::move(label));
}

} // namespace

bool wantsPockets(const SurfaceOptions& options)
{
    return options.pockets || options.color == ColorBy::Pocket;
}

void addPockets(const BallSet& atoms, const SurfaceOptions& options, Progress& progress,
                MolecularSurface& result)
{
    Stopwatch watch(result.report);
    progress.update("pockets", 0.0);
    const Wanted::PocketRule& asked = options.pocket;
    if (options.voxel > 0.5 * asked.probeIn)
        result.report.warnings.push_back(
            formatted("`voxel` %g: pockets that are narrow are lost on voxels above half of "
                      "`probeIn` [hint: `voxel` %g]",
                      options.voxel, 0.5 * asked.probeIn));
    Pockets found = findPockets(atoms.balls, asked, options.voxel, atoms.pocketAt, progress);
    if (options.color == ColorBy::Pocket && !result.mesh.normals.empty())
        colorPockets(found, progress, result.mesh);
    result.report.pockets = PocketsReport{asked.probeIn, asked.probeOut, asked.cut,
                                          asked.neck,    options.voxel,  std::move(found.list)};
    const openvdb::GridPtrVec grids = {found.ids, found.depths};
    const bool alone = !options.grid; // for their callers: no file has grids then
    for (const auto& grid : grids)
        if (alone || hasField(options.fields, grid->getName())) result.fields.push_back(grid);
    watch.stop("pockets");
}

} // namespace molsurf
