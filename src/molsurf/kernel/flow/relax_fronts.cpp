// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/flow/relax_fronts.h"

#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/levelset/reinitialize.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace molsurf
{

using openvdb::Coord;

namespace
{

/// A part of a band: the leaves that move, and those about them.
struct Part {
    NarrowBand band;
    LeafTable table;         ///< its leaves before any is added
    std::vector<bool> moves; ///< whether a leaf moves, or only stands beside those that do
};

/// The leaves within one of those that are marked.
std::vector<bool> widened(const LeafTable& table, const std::vector<bool>& marked)
{
    std::vector<bool> out = marked;
    for (std::size_t n = 0; n < table.size(); ++n) {
        if (!marked[n]) continue;
        for (const std::int32_t m : table.neighbours(n))
            if (m != noLeaf) out[std::size_t(m)] = true;
    }
    return out;
}

Part partOf(const NarrowBand& band, const std::vector<bool>& moves, const Progress& progress)
{
    const LeafTable& table = band.phi.table;
    const std::vector<bool> all = widened(table, moves);
    std::vector<Coord> origins;
    for (std::size_t n = 0; n < table.size(); ++n)
        if (all[n]) origins.push_back(table.origin(n));
    Part part;
    part.band.phi = {LeafTable(std::move(origins)), LeafField(), band.phi.voxelSize};
    LeafTable& own = part.band.phi.table;
    part.band.phi.values = LeafField(own.size());
    part.band.psi = LeafField(own.size());
    part.moves.resize(own.size());
    for (std::size_t n = 0; n < own.size(); ++n) {
        const auto m = std::size_t(table.find(own.origin(n)));
        part.moves[n] = moves[m];
        if (moves[m]) own.active(n) = table.active(m);
    }
    parallelFor(own.size(), progress, [&](std::size_t n) {
        const auto m = std::size_t(table.find(own.origin(n)));
        std::copy_n(band.phi.leaf(m), leafSize, part.band.phi.leaf(n));
        std::copy_n(band.psi.leaf(m), leafSize, part.band.psi.leaf(n));
    });
    part.table = own;
    return part;
}

/// How far the interface moved in a leaf [voxel].
float wayOf(const float* before, const float* after, double voxelSize)
{
    const float h = float(voxelSize);
    float way = 0.0f;
    for (int v = 0; v < leafSize; ++v) {
        if (std::min(std::abs(before[v]), std::abs(after[v])) < h)
            way = std::max(way, std::abs(after[v] - before[v]));
    }
    return way / h;
}

/// Makes room for leaves that were added to a part, and gives them its values.
void addLeaves(const NarrowBand& part, NarrowBand& band, std::vector<float>& largest,
               const Progress& progress)
{
    const LeafTable& own = part.phi.table;
    std::vector<Coord> added;
    for (std::size_t n = 0; n < own.size(); ++n)
        if (own.active(n).any() && band.phi.table.find(own.origin(n)) == noLeaf)
            added.push_back(own.origin(n));
    if (added.empty()) return;
    NarrowBand wide;
    wide.phi = {joined(band.phi.table, LeafTable(std::move(added))), LeafField(),
                band.phi.voxelSize};
    LeafTable& table = wide.phi.table;
    wide.phi.values = LeafField(table.size());
    wide.psi = LeafField(table.size());
    std::vector<float> values(table.size(), 0.0f);
    parallelFor(table.size(), progress, [&](std::size_t n) {
        const std::int32_t old = band.phi.table.find(table.origin(n));
        const NarrowBand& from = old != noLeaf ? band : part;
        const auto m = std::size_t(old != noLeaf ? old : own.find(table.origin(n)));
        std::copy_n(from.phi.leaf(m), leafSize, wide.phi.leaf(n));
        std::copy_n(from.psi.leaf(m), leafSize, wide.psi.leaf(n));
        table.active(n) = from.phi.table.active(m);
        if (old != noLeaf) values[n] = largest[m];
    });
    band = std::move(wide);
    largest = std::move(values);
}

/// Puts the leaves of a part that moved back.
/// @param[in,out] largest  how far the leaves of the band moved
void putBack(const Part& part, NarrowBand& band, std::vector<float>& largest,
             const Progress& progress)
{
    const SparseField& phi = part.band.phi;
    addLeaves(part.band, band, largest, progress);
    for (std::size_t n = 0; n < part.moves.size(); ++n) {
        if (!part.moves[n]) continue;
        const Coord& origin = part.table.origin(n);
        const auto from = std::size_t(phi.table.find(origin));
        const auto to = std::size_t(band.phi.table.find(origin));
        largest[to] = wayOf(band.phi.leaf(to), phi.leaf(from), band.phi.voxelSize);
        std::copy_n(phi.leaf(from), leafSize, band.phi.leaf(to));
        band.phi.table.active(to) = phi.table.active(from);
    }
}

/// Makes some steps of a part.
void move(NarrowBand& part, const PsiSource& source, const NewtonOptions& options, int steps,
          Progress& progress)
{
    NewtonSteps newton(options);
    LeafField before;
    for (int i = 0; i < steps; ++i) {
        newton.step(part, {}, before, progress);
        reinitialize(part.phi,
                     {bandWidthVox * part.phi.voxelSize, options.repairs(), Repair::Errors},
                     progress, before);
        updateBand(part, source, openvdb::CoordBBox::inf(), before, progress);
    }
}

} // namespace

Settling settle(NarrowBand& band, const PsiSource& source, const NewtonOptions& options,
                std::vector<float> largest, float limit, Progress& progress)
{
    constexpr int round = 4, most = 60; // steps
    Settling done;
    for (;;) {
        std::vector<bool> awake(largest.size());
        done.awake = 0;
        for (std::size_t n = 0; n < awake.size(); ++n) {
            awake[n] = largest[n] > limit;
            done.awake += awake[n];
        }
        if (done.awake == 0 || done.steps == most) return done;
        std::fill(largest.begin(), largest.end(), 0.0f);
        Part part = partOf(band, widened(band.phi.table, awake), progress);
        move(part.band, source, options, round, progress);
        putBack(part, band, largest, progress);
        done.steps += round;
    }
}

} // namespace molsurf
