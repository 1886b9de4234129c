// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/pipeline/fill_cavities.h"

#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/flow/evolve.h"
#include "molsurf/kernel/levelset/reinitialize.h"
#include "molsurf/kernel/mesh/topology.h"
#include "molsurf/kernel/pipeline/surface_kind.h"

#include <cmath>
#include <deque>

namespace molsurf
{

namespace
{

/// Flood fill: the voxels that can be reached from seeds by steps to face neighbours within a set
/// of voxels. A queue has the leaves that may grow. Each is filled as far as its neighbours are
/// now, and queues these again if it grew.
///
/// @param[in] allowed  the set, one mask a leaf of the table
/// @param[in] seeds    one mask a leaf; those outside the set count for nothing
/// @return one mask a leaf
std::vector<LeafMask> connectedTo(const LeafTable& table, const std::vector<LeafMask>& allowed,
                                  const std::vector<LeafMask>& seeds)
{
    std::vector<LeafMask> reached(table.size());
    std::deque<std::size_t> queue;
    std::vector<bool> queued(table.size(), false);
    const auto enqueue = [&](std::size_t n) {
        if (queued[n]) return;
        queued[n] = true;
        queue.push_back(n);
    };
    for (std::size_t n = 0; n < table.size(); ++n) {
        reached[n] = seeds[n] & allowed[n];
        if (!reached[n].any()) continue;
        for (const std::int32_t m : table.neighbours(n)) {
            if (m != noLeaf) enqueue(std::size_t(m));
        }
    }
    while (!queue.empty()) {
        const std::size_t n = queue.front();
        queue.pop_front();
        queued[n] = false;
        bool grown = false;
        for (;;) {
            const LeafMask next = (dilatedMask(table, reached, n, false) & allowed[n]) | reached[n];
            if (next.words == reached[n].words) break;
            reached[n] = next;
            grown = true;
        }
        if (!grown) continue;
        for (const std::int32_t m : table.neighbours(n)) {
            if (m != noLeaf) enqueue(std::size_t(m));
        }
    }
    return reached;
}

/// Makes voxels inner ones, and the level set a distance again.
/// @param[in] voxels  one mask a leaf
/// @param[in] width   half width of the level set's band [Å]
void fillVoxels(const std::vector<LeafMask>& voxels, double width, SparseField& phi,
                const Progress& progress)
{
    for (std::size_t n = 0; n < phi.table.size(); ++n) {
        voxels[n].forEach([&](int v) { phi.leaf(n)[v] = float(-width); });
    }
    reinitialize(phi, width, int(std::ceil(2.0 * width / phi.voxelSize)), progress);
}

} // namespace

std::vector<LeafMask> cavityVoxels(const Mesh& mesh, const SparseField& S, const Progress& progress)
{
    std::size_t count = 0;
    const std::vector<std::uint32_t> pieces = connectedPieces(mesh, count, progress);
    const std::vector<double> volumes = pieceVolumes(mesh, pieces, count);

    // Two flood fills of S >= 0, from the corners of vertices' cells on the side of the normals: of
    // cavities, whose pieces have a negative volume, and of outer surfaces. Voxels that both reach,
    // where a wall is thinner than a voxel, are no cavity.
    std::vector<LeafMask> positive(S.table.size()), walls(S.table.size()), skin(S.table.size());
    for (std::size_t n = 0; n < S.table.size(); ++n) {
        positive[n] = ~lessThan(S.leaf(n), 0.0f);
    }
    bool any = false;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const bool cavity = volumes[pieces[i]] < 0.0;
        any = any || cavity;
        const openvdb::Vec3d x = openvdb::Vec3d(mesh.positions[i]) / S.voxelSize;
        const openvdb::Coord cell = openvdb::Coord::floor(x);
        for (int k = 0; k < 8; ++k) {
            const openvdb::Coord corner = cell.offsetBy(k >> 2, k >> 1 & 1, k & 1);
            if ((corner.asVec3d() - x).dot(openvdb::Vec3d(mesh.normals[i])) <= 0.0) continue;
            const std::int32_t n = S.table.find(corner);
            if (n != noLeaf)
                (cavity ? walls : skin)[std::size_t(n)].set(
                    int(openvdb::FloatTree::LeafNodeType::coordToOffset(corner)));
        }
    }
    if (!any) return {};
    std::vector<LeafMask> cavities = connectedTo(S.table, positive, walls);
    const std::vector<LeafMask> exterior = connectedTo(S.table, positive, skin);
    for (std::size_t n = 0; n < cavities.size(); ++n) cavities[n] &= ~exterior[n];
    return cavities;
}

void fillInLevelSet(const std::vector<LeafMask>& cavities, const LeafTable& S, SparseField& phi,
                    const Progress& progress)
{
    std::vector<LeafMask> outside(phi.table.size()), start(phi.table.size());
    for (std::size_t n = 0; n < phi.table.size(); ++n) {
        outside[n] = ~lessThan(phi.leaf(n), 0.0f);
        const std::int32_t m = S.find(phi.table.origin(n));
        if (m != noLeaf) start[n] = cavities[m];
    }
    fillVoxels(connectedTo(phi.table, outside, start), bandWidthVox * phi.voxelSize, phi, progress);
}

void fillInCarrier(const std::vector<LeafMask>& cavities, const LeafTable& S, SparseField& carrier,
                   const Progress& progress)
{
    constexpr float leastShare = 0.6f; // of the distance
    const float h = float(carrier.voxelSize), width = float(bandWidthVox) * h;
    SparseField phi = copied(carrier);
    reinitialize(phi, width, 2 * bandWidthVox, progress);
    fillInLevelSet(cavities, S, phi, progress);
    // The carrier keeps its values beside the interface. Farther than a voxel from the new one its
    // size becomes at least leastShare (|distance| - h), so that a filled cavity leaves no zero.
    parallelFor(phi.table.size(), progress, [&](std::size_t n) {
        for (int v = 0; v < leafSize; ++v) {
            const float distance = phi.leaf(n)[v], side = distance < 0.0f ? -1.0f : 1.0f;
            const float depth = side * distance - h;
            float& value = carrier.leaf(n)[v];
            if (depth > 0.0f) value = side * std::max(side * value, leastShare * depth);
        }
    });
}

void fillInDistance(const std::vector<LeafMask>& cavities, SparseField& S, const Progress& progress)
{
    SparseField filled = copied(S);
    fillVoxels(cavities, splineWidthVox * S.voxelSize, filled, progress);
    // Its band changes on both sides of a wall that is gone; all other values stay as they are.
    LeafTable about = S.table;
    for (std::size_t n = 0; n < about.size(); ++n) about.active(n) = cavities[n];
    about = dilated(about, int(2.0 * splineWidthVox), Spread::Ball, progress);
    parallelFor(S.table.size(), progress, [&](std::size_t n) {
        const std::int32_t m = about.find(S.table.origin(n));
        if (m == noLeaf) return;
        about.active(m).forEach([&](int v) { S.leaf(n)[v] = filled.leaf(n)[v]; });
    });
}

} // namespace molsurf
