// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/grid/leaf_table.h"

#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/core/simd.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>

namespace molsurf
{

using openvdb::Coord;

LeafField copied(const LeafField& field)
{
    LeafField copy(field.leafCount());
    for (std::size_t n = 0; n < field.leafCount(); ++n)
        std::copy_n(field.leaf(n), leafSize, copy.leaf(n));
    return copy;
}

namespace
{

/// The voxels of a leaf whose values, or their sizes, are below a limit.
template<bool size>
inline __attribute__((always_inline)) LeafMask below(const float* values, float limit)
{
    constexpr int vectors = 32 / floatLanes; // of half a plane
    Ints bit[vectors];
    for (int k = 0; k < 32; ++k) bit[k / floatLanes][k % floatLanes] = std::int32_t(1u << k);
    LeafMask mask;
    for (int half = 0; half < 2 * leafDim; ++half) {
        Ints bits = {};
        for (int i = 0; i < vectors; ++i) {
            Floats v = *reinterpret_cast<const Floats*>(values + 32 * half + floatLanes * i);
            if (size) v = v < 0.0f ? -v : v;
            bits |= v < limit ? bit[i] : Ints{};
        }
        mask.words[half / 2] |= std::uint64_t(bitsOf(bits)) << (32 * (half & 1));
    }
    return mask;
}

} // namespace

MOLSURF_KERNEL LeafMask lessThan(const float* values, float limit)
{
    return below<false>(values, limit);
}

MOLSURF_KERNEL LeafMask within(const float* values, float limit)
{
    return below<true>(values, limit);
}

namespace
{

/// The order of leaves.
bool before(const Coord& a, const Coord& b)
{
    const Coord s = a >> 6, t = b >> 6;
    return s != t ? s < t : a < b;
}

/// The step to the k-th of 27 neighbours.
Coord offsetOf(int k)
{
    return {k / 9 - 1, k / 3 % 3 - 1, k % 3 - 1};
}

} // namespace

/// The slot of a tile, or the empty one where it would be: a hash table with linear probing.
std::size_t LeafTable::Layout::slotOf(const Coord& place) const
{
    const std::size_t last = slots.size() - 1;
    std::uint64_t hash = std::uint32_t(place.x()) * 0x9e3779b97f4a7c15ull ^
                         std::uint32_t(place.y()) * 0xc2b2ae3d27d4eb4full ^
                         std::uint32_t(place.z()) * 0x165667b19e3779f9ull;
    hash ^= hash >> 32;
    std::size_t slot = std::size_t(hash) & last;
    while (slots[slot] >= 0 && tiles[std::size_t(slots[slot])].place != place)
        slot = (slot + 1) & last;
    return slot;
}

std::int32_t LeafTable::Layout::find(const Coord& voxel) const
{
    const std::int32_t tile = slots[slotOf(voxel >> 6)];
    if (tile < 0) return noLeaf;
    const Coord leaf = (voxel >> 3) & 7;
    return tiles[std::size_t(tile)].leaves[std::size_t(64 * leaf.x() + 8 * leaf.y() + leaf.z())];
}

void LeafTable::Layout::findNeighbours(std::size_t n)
{
    const Coord leaf = (origins[n] >> 3) & 7;
    const Tile& tile = tiles[std::size_t(slots[slotOf(origins[n] >> 6)])];
    // Of the three leaves along each axis: the part of the index of their tile, of which -1 and 8
    // lie in the next ones, and of their place in it.
    int beside[3][3], place[3][3];
    for (int a = 0, step = 9, stride = 64; a < 3; ++a, step /= 3, stride /= 8) {
        for (int i = 0; i < 3; ++i) {
            const int at = leaf[a] + i - 1;
            beside[a][i] = step * ((at >> 3) + 1);
            place[a][i] = stride * (at & 7);
        }
    }
    std::int32_t* out = neighbours[n].data();
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            for (int k = 0; k < 3; ++k) {
                const int side = beside[0][i] + beside[1][j] + beside[2][k];
                const std::int32_t t = tile.near[std::size_t(side)];
                const int at = place[0][i] + place[1][j] + place[2][k];
                *out++ = t < 0 ? noLeaf : tiles[std::size_t(t)].leaves[std::size_t(at)];
            }
        }
    }
}

LeafTable::LeafTable(std::vector<Coord> origins) : active_(origins.size())
{
    auto layout = std::make_shared<Layout>();
    Layout& l = *layout;
    l.origins = std::move(origins);
    if (!std::is_sorted(l.origins.begin(), l.origins.end(), before)) {
        tbb::parallel_sort(l.origins.begin(), l.origins.end(), before);
    }
    l.slots.assign(64, -1); // twice as many as tiles, or more
    std::int32_t last = -1; // the tile of the leaf before
    for (std::size_t n = 0; n < l.origins.size(); ++n) {
        const Coord place = l.origins[n] >> 6, leaf = (l.origins[n] >> 3) & 7;
        if (last < 0 || l.tiles[std::size_t(last)].place != place) {
            last = l.slots[l.slotOf(place)];
        }
        if (last < 0) {
            last = std::int32_t(l.tiles.size());
            l.tiles.emplace_back();
            l.tiles.back().place = place;
            l.tiles.back().leaves.fill(noLeaf);
            if (2 * l.tiles.size() > l.slots.size()) {
                l.slots.assign(2 * l.slots.size(), -1);
                for (std::size_t t = 0; t < l.tiles.size(); ++t)
                    l.slots[l.slotOf(l.tiles[t].place)] = std::int32_t(t);
            } else {
                l.slots[l.slotOf(place)] = last;
            }
        }
        l.tiles[std::size_t(last)].leaves[std::size_t(64 * leaf.x() + 8 * leaf.y() + leaf.z())] =
            std::int32_t(n);
    }

    for (Tile& tile : l.tiles) {
        for (int k = 0; k < 27; ++k)
            tile.near[std::size_t(k)] = l.slots[l.slotOf(tile.place + offsetOf(k))];
    }
    l.neighbours.reset(new std::array<std::int32_t, 27>[l.origins.size()]); // set by all threads
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, l.origins.size(), 256), [&](auto range) {
        for (std::size_t n = range.begin(); n != range.end(); ++n) l.findNeighbours(n);
    });
    layout_ = std::move(layout);
}

std::size_t LeafTable::activeCount() const
{
    std::size_t count = 0;
    for (const LeafMask& mask : active_) count += mask.count();
    return count;
}

std::size_t LeafTable::bytes() const
{
    return size() * (sizeof(Coord) + sizeof(LeafMask) + sizeof(layout_->neighbours[0])) +
           layout_->tiles.size() * sizeof(Tile) + layout_->slots.size() * sizeof(std::int32_t);
}

namespace
{

constexpr std::uint64_t rowEnd = 0x8080808080808080ull; // z = 7 of all rows
constexpr std::uint64_t rowBegin = 0x0101010101010101ull;

/// The words of the 27 leaves about one; of a leaf that is missing, zeros.
using NearWords = std::array<const std::uint64_t*, 27>;

/// The voxels of word x, a yz plane of a leaf, that have a voxel of the set within one step in z.
/// Voxel (y, z) is bit 8 y + z: a step along z shifts by 1 but for the ends of rows.
MOLSURF_INLINE std::uint64_t spreadZ(const NearWords& near, int k, int x)
{
    const std::uint64_t c = near[std::size_t(k)][x];
    return c | (c & ~rowEnd) << 1 | (c & ~rowBegin) >> 1 |
           (near[std::size_t(k - 1)][x] & rowEnd) >> 7 |
           (near[std::size_t(k + 1)][x] & rowBegin) << 7;
}

/// The same for one step in z and one in y, which shifts by 8.
MOLSURF_INLINE std::uint64_t spreadYZ(const NearWords& near, int k, int x)
{
    const std::uint64_t c = spreadZ(near, k, x);
    return c | c << 8 | c >> 8 | spreadZ(near, k - 3, x) >> 56 | spreadZ(near, k + 3, x) << 56;
}

/// A step to the 6 neighbours.
MOLSURF_KERNEL void spreadFaces(const NearWords& near, std::uint64_t* out)
{
    const std::uint64_t* c = near[centreNeighbour];
    std::uint64_t x[10];
    x[0] = near[centreNeighbour - 9][7];
    std::copy_n(c, 8, x + 1);
    x[9] = near[centreNeighbour + 9][0];
    for (int i = 0; i < 8; ++i) {
        out[i] = spreadZ(near, centreNeighbour, i) | x[i] | x[i + 2] | c[i] << 8 | c[i] >> 8 |
                 near[centreNeighbour - 3][i] >> 56 | near[centreNeighbour + 3][i] << 56;
    }
}

/// A step to the 26 neighbours.
MOLSURF_KERNEL void spreadCube(const NearWords& near, std::uint64_t* out)
{
    std::uint64_t x[10];
    x[0] = spreadYZ(near, centreNeighbour - 9, 7);
    for (int i = 0; i < 8; ++i) x[i + 1] = spreadYZ(near, centreNeighbour, i);
    x[9] = spreadYZ(near, centreNeighbour + 9, 0);
    for (int i = 0; i < 8; ++i) out[i] = x[i] | x[i + 1] | x[i + 2];
}

/// The box of the voxels of a mask that is not empty.
struct Extent {
    int low[3], high[3];

    /// The box of the active voxels of a mask that has some.
    explicit Extent(const LeafMask& mask)
    {
        std::uint64_t all = 0;
        low[0] = high[0] = -1;
        for (int x = 0; x < leafDim; ++x) {
            if (mask.words[x] == 0) continue;
            if (low[0] < 0) low[0] = x;
            high[0] = x;
            all |= mask.words[x];
        }
        std::uint64_t rows = all; // to one byte: the z of any row
        for (const int shift : {32, 16, 8}) rows |= rows >> shift;
        const unsigned z = unsigned(rows & 0xff);
        low[1] = __builtin_ctzll(all) >> 3;
        high[1] = (63 - __builtin_clzll(all)) >> 3;
        low[2] = __builtin_ctz(z);
        high[2] = 31 - __builtin_clz(z);
    }

    /// Whether a voxel of the leaf at an offset lies within a number of steps of the box.
    bool reaches(const Coord& offset, int steps) const
    {
        for (int a = 0; a < 3; ++a) {
            if (offset[a] < 0 && low[a] - steps >= 0) return false;
            if (offset[a] > 0 && high[a] + steps < leafDim) return false;
        }
        return true;
    }
};

} // namespace

LeafMask dilatedMask(const LeafTable& table, const std::vector<LeafMask>& masks, std::size_t n,
                     bool full)
{
    static constexpr LeafMask none;
    NearWords near;
    for (std::size_t k = 0; k < 27; ++k) {
        const std::int32_t m = table.neighbours(n)[k];
        near[k] = (m == noLeaf ? none : masks[std::size_t(m)]).words.data();
    }
    LeafMask out;
    full ? spreadCube(near, out.words.data()) : spreadFaces(near, out.words.data());
    return out;
}

LeafTable dilated(const LeafTable& table, int steps, Spread spread, const Progress& progress)
{
    const auto lacking = [&](std::size_t n, std::vector<Coord>& added) {
        const LeafMask& active = table.active(n);
        if (!active.any()) return;
        const Extent extent(active);
        for (int k = 0; k < 27; ++k) {
            if (table.neighbours(n)[k] != noLeaf) continue;
            const Coord offset = offsetOf(k);
            if (!extent.reaches(offset, steps)) continue;
            added.push_back(table.origin(n).offsetBy(leafDim * offset.x(), leafDim * offset.y(),
                                                     leafDim * offset.z()));
        }
    };
    std::vector<Coord> added = parallelCollect<Coord>(table.size(), progress, lacking);
    tbb::parallel_sort(added.begin(), added.end(), before);
    added.erase(std::unique(added.begin(), added.end()), added.end());
    std::vector<Coord> origins;
    origins.reserve(table.size() + added.size());
    std::merge(table.origins().begin(), table.origins().end(), added.begin(), added.end(),
               std::back_inserter(origins), before);
    LeafTable out(std::move(origins));

    std::vector<LeafMask> now(out.size()), next(out.size());
    for (std::size_t n = 0, m = 0; n < out.size() && m < table.size(); ++n) {
        if (table.origin(m) == out.origin(n)) now[n] = table.active(m++);
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

namespace
{

/// The leaves of a table that keep(n) names, with their active voxels.
template<typename F>
LeafTable filtered(const LeafTable& table, const F& keep)
{
    std::vector<Coord> origins;
    std::vector<LeafMask> masks;
    origins.reserve(table.size());
    masks.reserve(table.size());
    for (std::size_t n = 0; n < table.size(); ++n) {
        if (!keep(n)) continue;
        origins.push_back(table.origin(n));
        masks.push_back(table.active(n));
    }
    LeafTable out(std::move(origins)); // already in order
    for (std::size_t n = 0; n < out.size(); ++n) out.active(n) = masks[n];
    return out;
}

} // namespace

LeafTable pruned(const LeafTable& table)
{
    const auto kept = [&](std::size_t n) { return table.active(n).any(); };
    std::size_t n = 0;
    while (n < table.size() && kept(n)) ++n;
    return n == table.size() ? table : filtered(table, kept);
}

LeafTable emptied(LeafTable table)
{
    for (std::size_t n = 0; n < table.size(); ++n) table.active(n) = LeafMask();
    return table;
}

LeafTable joined(const LeafTable& a, const LeafTable& b)
{
    std::vector<Coord> origins = a.origins();
    for (const Coord& origin : b.origins()) {
        if (a.find(origin) == noLeaf) origins.push_back(origin);
    }
    LeafTable out(std::move(origins));
    for (const LeafTable* table : {&a, &b}) {
        for (std::size_t n = 0; n < table->size(); ++n)
            out.active(std::size_t(out.find(table->origin(n)))) |= table->active(n);
    }
    return out;
}

LeafTable clipped(const LeafTable& table, const openvdb::CoordBBox& box)
{
    if (box == openvdb::CoordBBox::inf()) return table;
    return filtered(table, [&](std::size_t n) { return box.isInside(table.origin(n)); });
}

} // namespace molsurf
