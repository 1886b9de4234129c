// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/flow/narrow_band.h"

#include "molsurf/kernel/core/parallel.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

namespace
{

/// Gives each voxel of a new leaf the sign of the nearest voxel of an old leaf.
/// @param[in]  n    index of the leaf in the new table
/// @param[out] phi  512 values, -width or width
void fillFromNeighbours(const SparseField& old, const LeafTable& table, std::size_t n, float width,
                        float* phi)
{
    const auto& near = table.neighbours(n);
    std::array<std::int32_t, 27> known;
    for (int k = 0; k < 27; ++k) {
        known[k] = near[k] == noLeaf ? noLeaf : old.table.find(table.origin(near[k]));
    }
    for (int v = 0; v < leafSize; ++v) {
        const int x = v >> 6, y = v >> 3 & 7, z = v & 7;
        int nearest = 1000;
        phi[v] = width;
        for (int k = 0; k < 27; ++k) {
            if (known[k] == noLeaf) continue;
            const int dx = k / 9 - 1, dy = k / 3 % 3 - 1, dz = k % 3 - 1;
            const int qx = dx == 0 ? x : dx < 0 ? -1 : 8, qy = dy == 0 ? y : dy < 0 ? -1 : 8;
            const int qz = dz == 0 ? z : dz < 0 ? -1 : 8;
            const int distance = (x - qx) * (x - qx) + (y - qy) * (y - qy) + (z - qz) * (z - qz);
            if (distance >= nearest) continue;
            nearest = distance;
            const float value = old.leaf(known[k])[64 * (qx & 7) + 8 * (qy & 7) + (qz & 7)];
            phi[v] = std::copysign(width, value);
        }
    }
}

/// Whether a leaf of a table lacks a neighbour, in a domain, that a step from its voxels leads to.
bool lacksNeighbour(const LeafTable& table, std::size_t n, const LeafMask& inside,
                    const openvdb::CoordBBox& domain)
{
    const auto& near = table.neighbours(n);
    const auto& w = inside.words;
    std::uint64_t all = 0;
    for (const std::uint64_t word : w) all |= word;
    const auto lacks = [&](int k) {
        return near[k] == noLeaf &&
               domain.isInside(table.origin(n).offsetBy(
                   leafDim * (k / 9 - 1), leafDim * (k / 3 % 3 - 1), leafDim * (k % 3 - 1)));
    };
    // The neighbours before and behind along x, y and z, and the faces of the leaf beside them.
    return (w[0] && lacks(4)) || (w[7] && lacks(22)) || ((all & 0xff) && lacks(10)) ||
           ((all >> 56) && lacks(16)) || ((all & 0x0101010101010101ull) && lacks(12)) ||
           ((all & 0x8080808080808080ull) && lacks(14));
}

/// Adds leaves about the active voxels. The leaves of the band stay, where none of their voxels is
/// active, too.
/// @param[in,out] scratch  a field that grows with the band; its values are lost
void addLeaves(NarrowBand& band, const PsiSource& source, const openvdb::CoordBBox& domain,
               LeafField& scratch, Progress& progress)
{
    const LeafTable& old = band.phi.table;
    const float width = float(bandWidthVox * band.phi.voxelSize);
    LeafTable table = joined(clipped(dilated(old, 1, Spread::Ball, progress), domain), old);
    // One field after the other: at no time are there both twice.
    scratch = LeafField();
    const auto extend = [&](LeafField& field, const auto& fill) {
        LeafField out(table.size());
        parallelFor(table.size(), progress, [&](std::size_t n) {
            const std::int32_t m = old.find(table.origin(n));
            if (m != noLeaf) {
                std::copy_n(field.leaf(std::size_t(m)), leafSize, out.leaf(n));
            } else {
                fill(n, out.leaf(n));
            }
        });
        field = std::move(out);
    };
    extend(band.psi, [&](std::size_t n, float* psi) { source(table.origin(n), psi); });
    extend(band.phi.values,
           [&](std::size_t n, float* phi) { fillFromNeighbours(band.phi, table, n, width, phi); });
    scratch = LeafField(table.size());
    band.phi.table = std::move(table);
}

} // namespace

void updateBand(NarrowBand& band, const PsiSource& source, const openvdb::CoordBBox& domain,
                LeafField& scratch, Progress& progress)
{
    LeafTable& table = band.phi.table;
    // The voxels that are certainly within the band, and one step around them.
    const float core = float(bandWidthVox * band.phi.voxelSize - band.phi.voxelSize);
    std::vector<LeafMask> inside(table.size());
    parallelFor(table.size(), progress, [&](std::size_t n) {
        inside[n] = within(band.phi.leaf(n), core) & table.active(n);
    });
    bool complete = true;
    for (std::size_t n = 0; n < table.size(); ++n) {
        table.active(n) = inside[n];
        complete = complete && !(inside[n].any() && lacksNeighbour(table, n, inside[n], domain));
    }
    if (!complete) {
        addLeaves(band, source, domain, scratch, progress);
        return;
    }
    parallelFor(table.size(), progress,
                [&](std::size_t n) { table.active(n) = dilatedMask(table, inside, n, false); });
}

} // namespace molsurf
