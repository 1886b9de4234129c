// SPDX-License-Identifier: MPL-2.0
#include "molsurf/core/leaf_table.h"

#include "molsurf/core/parallel.h"
#include "molsurf/core/simd.h"

#include <openvdb/tools/SignedFloodFill.h>

#include <sys/mman.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <new>

namespace molsurf
{

using openvdb::Coord;

void* allocateLeaves(std::size_t bytes)
{
    constexpr std::size_t hugePage = 1 << 21, line = 64;
    const bool large = bytes >= 2 * hugePage;
    const std::size_t alignment = large ? hugePage : line;
    void* memory = std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
    if (!memory && bytes > 0) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
    if (large) madvise(memory, bytes, MADV_HUGEPAGE); // a hint; refusing it is no error
#endif
    return memory;
}

MOLSURF_KERNEL LeafMask lessThan(const float* values, float limit)
{
    LeafMask mask;
    for (int row = 0; row < 64; ++row) {
        int bits = 0;
        for (int z = 0; z < 8; ++z) bits |= int(values[8 * row + z] < limit) << z;
        mask.words[row >> 3] |= std::uint64_t(bits) << (8 * (row & 7));
    }
    return mask;
}

MOLSURF_KERNEL LeafMask within(const float* values, float limit)
{
    LeafMask mask;
    for (int row = 0; row < 64; ++row) {
        int bits = 0;
        for (int z = 0; z < 8; ++z) bits |= int(std::abs(values[8 * row + z]) < limit) << z;
        mask.words[row >> 3] |= std::uint64_t(bits) << (8 * (row & 7));
    }
    return mask;
}

LeafTable::LeafTable(std::vector<Coord> origins)
    : origins_(std::move(origins)), active_(origins_.size()), neighbours_(origins_.size())
{
    if (!std::is_sorted(origins_.begin(), origins_.end())) {
        tbb::parallel_sort(origins_.begin(), origins_.end());
    }
    // The origins, all shifted alike, stay in ascending order: one merge finds the neighbours at an
    // offset.
    tbb::parallel_for(0, 27, [&](int k) {
        const Coord offset(leafDim * (k / 9 - 1), leafDim * (k / 3 % 3 - 1), leafDim * (k % 3 - 1));
        std::size_t m = 0;
        for (std::size_t n = 0; n < origins_.size(); ++n) {
            const Coord wanted = origins_[n] + offset;
            while (m < origins_.size() && origins_[m] < wanted) ++m;
            const bool found = m < origins_.size() && origins_[m] == wanted;
            neighbours_[n][k] = found ? std::int32_t(m) : noLeaf;
        }
    });
}

std::int32_t LeafTable::find(const Coord& voxel) const
{
    const Coord origin = voxel & ~(leafDim - 1);
    const auto it = std::lower_bound(origins_.begin(), origins_.end(), origin);
    return it != origins_.end() && *it == origin ? std::int32_t(it - origins_.begin()) : noLeaf;
}

std::size_t LeafTable::activeCount() const
{
    std::size_t count = 0;
    for (const LeafMask& mask : active_) count += mask.count();
    return count;
}

std::size_t LeafTable::bytes() const
{
    return size() * (sizeof(Coord) + sizeof(LeafMask) + sizeof(neighbours_[0]));
}

namespace
{

constexpr std::uint64_t rowEnd = 0x8080808080808080ull; // z = 7 of all rows
constexpr std::uint64_t rowBegin = 0x0101010101010101ull;

/// One yz plane of 8 x 8 voxels and the planes of the leaves about it.
struct Planes {
    std::uint64_t at[3][3]; // [dy + 1][dz + 1]
};

/// The voxels of the centre plane that have a voxel of the set within one step in y or z.
std::uint64_t spreadFace(const Planes& p)
{
    const std::uint64_t c = p.at[1][1];
    std::uint64_t out = c | (c << 8) | (c >> 8);
    out |= p.at[0][1] >> 56 | p.at[2][1] << 56;
    out |= (c & ~rowEnd) << 1 | (c & ~rowBegin) >> 1;
    out |= (p.at[1][0] & rowEnd) >> 7 | (p.at[1][2] & rowBegin) << 7;
    return out;
}

/// The same for one step in y and one in z.
std::uint64_t spreadFull(const Planes& p)
{
    std::uint64_t alongZ[3];
    for (int i = 0; i < 3; ++i) {
        const std::uint64_t c = p.at[i][1];
        alongZ[i] = c | (c & ~rowEnd) << 1 | (c & ~rowBegin) >> 1 | (p.at[i][0] & rowEnd) >> 7 |
                    (p.at[i][2] & rowBegin) << 7;
    }
    return alongZ[1] | alongZ[1] << 8 | alongZ[1] >> 8 | alongZ[0] >> 56 | alongZ[2] << 56;
}

} // namespace

LeafMask dilatedMask(const LeafTable& table, const std::vector<LeafMask>& masks, std::size_t n,
                     bool full)
{
    const auto& near = table.neighbours(n);
    const auto plane = [&](int x, int dy, int dz) -> std::uint64_t {
        const int dx = x < 0 ? 0 : x > 7 ? 2 : 1;
        const std::int32_t m = near[9 * dx + 3 * dy + dz];
        return m == noLeaf ? 0 : masks[m].words[x & 7];
    };
    LeafMask out;
    std::uint64_t spread[10], plain[10];
    for (int x = -1; x <= 8; ++x) {
        Planes p;
        for (int i = 0; i < 9; ++i) p.at[i / 3][i % 3] = plane(x, i / 3, i % 3);
        plain[x + 1] = p.at[1][1];
        spread[x + 1] = full ? spreadFull(p) : spreadFace(p);
    }
    const std::uint64_t* sides = full ? spread : plain;
    for (int x = 0; x < 8; ++x) out.words[x] = sides[x] | spread[x + 1] | sides[x + 2];
    return out;
}

LeafTable dilated(const LeafTable& table, int steps, Spread spread, const Progress& progress)
{
    std::vector<Coord> added;
    for (std::size_t n = 0; n < table.size(); ++n) {
        if (!table.active(n).any()) continue;
        for (int k = 0; k < 27; ++k) {
            if (table.neighbours(n)[k] != noLeaf) continue;
            added.push_back(table.origin(n).offsetBy(
                leafDim * (k / 9 - 1), leafDim * (k / 3 % 3 - 1), leafDim * (k % 3 - 1)));
        }
    }
    tbb::parallel_sort(added.begin(), added.end());
    added.erase(std::unique(added.begin(), added.end()), added.end());
    std::vector<Coord> origins;
    origins.reserve(table.size() + added.size());
    std::merge(table.origins().begin(), table.origins().end(), added.begin(), added.end(),
               std::back_inserter(origins));
    LeafTable out(std::move(origins));

    std::vector<LeafMask> now(out.size()), next(out.size());
    std::size_t m = 0;
    for (std::size_t n = 0; n < out.size(); ++n) {
        while (m < table.size() && table.origin(m) < out.origin(n)) ++m;
        if (m < table.size() && table.origin(m) == out.origin(n)) now[n] = table.active(m);
    }
    for (int step = 0; step < steps; ++step) {
        const bool full = spread == Spread::Cube || step % 2 == 1;
        parallelFor(out.size(), progress,
                    [&](std::size_t n) { next[n] = dilatedMask(out, now, n, full); });
        now.swap(next);
    }
    for (std::size_t n = 0; n < out.size(); ++n) out.active(n) = now[n];
    return pruned(out);
}

LeafTable pruned(const LeafTable& table)
{
    std::vector<Coord> origins;
    std::vector<LeafMask> masks;
    origins.reserve(table.size());
    masks.reserve(table.size());
    for (std::size_t n = 0; n < table.size(); ++n) {
        if (!table.active(n).any()) continue;
        origins.push_back(table.origin(n));
        masks.push_back(table.active(n));
    }
    LeafTable out(std::move(origins)); // already in ascending order
    for (std::size_t n = 0; n < out.size(); ++n) out.active(n) = masks[n];
    return out;
}

LeafTable clipped(const LeafTable& table, const openvdb::CoordBBox& box)
{
    if (box == openvdb::CoordBBox::inf()) return table;
    std::vector<Coord> origins;
    std::vector<LeafMask> masks;
    for (std::size_t n = 0; n < table.size(); ++n) {
        if (!box.isInside(table.origin(n))) continue;
        origins.push_back(table.origin(n));
        masks.push_back(table.active(n));
    }
    LeafTable out(origins);
    for (std::size_t i = 0; i < origins.size(); ++i)
        out.active(std::size_t(out.find(origins[i]))) = masks[i];
    return out;
}

LeafField restricted(const LeafTable& table, const LeafField& field, const LeafTable& to,
                     const Progress& progress)
{
    LeafField out(to.size());
    parallelFor(to.size(), progress, [&](std::size_t n) {
        const std::int32_t m = table.find(to.origin(n));
        std::copy_n(field.leaf(std::size_t(m)), leafSize, out.leaf(n));
    });
    return out;
}

openvdb::FloatGrid::Ptr toLevelSet(const LeafTable& table, const LeafField& field, double halfWidth,
                                   double voxel, const Progress& progress)
{
    using Leaf = openvdb::FloatTree::LeafNodeType;
    const float background = float(halfWidth);
    std::vector<Leaf*> leaves(table.size(), nullptr);
    parallelFor(table.size(), progress, [&](std::size_t n) {
        const LeafMask& active = table.active(n);
        if (!active.any()) return;
        auto* leaf = new Leaf(table.origin(n), background);
        float* out = leaf->buffer().data();
        const float* in = field.leaf(n);
        for (int v = 0; v < leafSize; ++v) {
            const float value = active.on(v) ? in[v] : std::copysign(background, in[v]);
            out[v] = std::min(std::max(value, -background), background);
        }
        Leaf::NodeMaskType mask;
        for (int x = 0; x < 8; ++x) mask.getWord<openvdb::Index64>(x) = active.words[x];
        leaf->setValueMask(mask);
        leaves[n] = leaf;
    });
    auto grid = openvdb::createLevelSet<openvdb::FloatGrid>(voxel, 3.0);
    grid->setTree(std::make_shared<openvdb::FloatTree>(background));
    for (Leaf* leaf : leaves) {
        if (leaf) grid->tree().addLeaf(leaf);
    }
    openvdb::tools::signedFloodFill(grid->tree());
    return grid;
}

} // namespace molsurf
