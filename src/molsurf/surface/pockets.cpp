// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/pockets.h"

#include "molsurf/analysis/pockets/find_pockets.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/kernel/pipeline/surface_run.h"
#include "molsurf/show/color/palette.h"
#include "molsurf/surface/field_table.h"
#include "molsurf/surface/pocket_meshes.h"

#include <algorithm>
#include <array>

namespace molsurf
{

namespace
{

/// The number of the pocket that a point of the surface is a wall of, or 0. Steps out along the
/// normal to the first place where any of the 8 voxels about it is a pocket's; the pocket that most
/// of them have wins.
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

/// Colours of pockets, none of which looks like what is no pocket's.
std::vector<Color> pocketColors()
{
    // Between red, green and blue; three greys of the palette have up to 32, its others 40 and
    // more.
    constexpr int least = 36;
    std::vector<Color> colors =
        distinctColors(std::vector<std::vector<std::int32_t>>(mostDistinct));
    const auto isGrey = [](const Color& color) {
        const auto [low, high] = std::minmax_element(color.begin(), color.end());
        return *high - *low < least;
    };
    colors.erase(std::remove_if(colors.begin(), colors.end(), isGrey), colors.end());
    return colors;
}

/// Labels and colours the vertices by their pockets. The largest have colours of their own, and the
/// others those again.
/// @return how many pockets no vertex is a wall of
std::size_t colorPockets(const Pockets& pockets, const Progress& progress, Mesh& mesh)
{
    Attribute<std::int32_t> label{"pocket", std::vector<std::int32_t>(mesh.positions.size()), {}};
    constexpr std::size_t chunk = 4096;
    parallelFor((mesh.positions.size() + chunk - 1) / chunk, progress, [&](std::size_t c) {
        for (std::size_t v = c * chunk; v < std::min(mesh.positions.size(), (c + 1) * chunk); ++v)
            label.values[v] = pocketBefore(*pockets.ids, openvdb::Vec3d(mesh.positions[v]),
                                           openvdb::Vec3d(mesh.normals[v]));
    });
    label.names = {"elsewhere"};
    for (const PocketReport& pocket : pockets.list)
        label.names.push_back(pocketName(label.names.size(), pocket.volume));
    mesh.colors.assign(mesh.positions.size(), neutralColor);
    std::vector<char> seen(pockets.list.size() + 1, 0);
    for (std::size_t v = 0; v < mesh.colors.size(); ++v) {
        const std::int32_t id = label.values[v];
        seen[std::size_t(id)] = 1;
        if (id > 0) mesh.colors[v] = pocketColor(std::size_t(id));
    }
    mesh.labels.push_back(std::move(label));
    return std::size_t(std::count(seen.begin() + 1, seen.end(), 0));
}

/// A line on pockets that the surface closes.
std::string closedText(std::size_t closed, std::size_t all, SurfaceKind kind)
{
    const bool open = kind == SurfaceKind::SolventExcluded || kind == SurfaceKind::VanDerWaals;
    return formatted("`color` pocket: %zu of %s no wall on this surface", closed,
                     counted(all, "pocket has", "pockets have").c_str()) +
           (open ? "" : " [hint: `surface` ses]");
}

} // namespace

std::string pocketName(std::size_t number, double volume)
{
    return formatted("%zu: %.0f Å³", number, volume);
}

Color pocketColor(std::size_t number)
{
    static const std::vector<Color> colors = pocketColors();
    return colors[(number - 1) % colors.size()];
}

bool wantsPockets(const SurfaceOptions& options)
{
    return options.pockets || options.color == ColorBy::Pocket;
}

void addPockets(const BallSet& atoms, const SurfaceOptions& options, Progress& progress,
                MolecularSurface& result)
{
    Stopwatch watch(result.report);
    progress.update("pockets", 0.0);
    const Products::PocketRule& asked = options.pocket;
    if (options.voxel > 0.5 * asked.probeIn)
        result.report.warnings.push_back(
            formatted("`voxel` %g: pockets that are narrow are lost on voxels above half of "
                      "`probeIn` [hint: `voxel` %g]",
                      options.voxel, 0.5 * asked.probeIn));
    Pockets found =
        findPockets(atoms.balls, asked, options.voxel, options.places.pocketAt, progress);
    if (options.color == ColorBy::Pocket && !result.mesh.normals.empty())
        if (const std::size_t closed = colorPockets(found, progress, result.mesh))
            result.report.warnings.push_back(closedText(closed, found.list.size(), options.kind));
    if (options.pocketBodies) result.pocketBodies = pocketBodies(found, progress);
    result.report.pockets = Report::Pockets{asked.probeIn,
                                            asked.probeOut,
                                            asked.cut,
                                            asked.neck,
                                            options.voxel,
                                            std::move(found.list),
                                            !options.places.pocketAt.empty()};
    const openvdb::GridPtrVec grids = {found.ids, found.depths, found.rooms};
    const bool alone = !options.grid; // for their callers: no file has grids then
    for (const auto& grid : grids)
        if (alone || hasField(options.fields, grid->getName())) result.fields.push_back(grid);
    watch.stop("pockets");
}

} // namespace molsurf
