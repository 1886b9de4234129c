// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The sparse topology that all fields of a stage share: a list of 8^3 leaves, aligned and laid out
/// like OpenVDB's leaf nodes, with a mask of active voxels and a table of neighbours each. A field
/// on it is one array of 512 values a leaf. docs/adr/0002-leaf-table.md tells why.

#include "molsurf/kernel/grid/leaf_mask.h"
#include "molsurf/kernel/grid/paged_array.h"
#include "molsurf/progress.h"

#include <openvdb/openvdb.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace molsurf
{

constexpr int leafDim = 8;          ///< voxels along the edge of a leaf
constexpr int leafSize = 512;       ///< voxels of a leaf
constexpr std::int32_t noLeaf = -1; ///< in the table of neighbours: there is none
constexpr int centreNeighbour = 13; ///< index of the leaf itself among its 27 neighbours

/// 512 values a leaf, uninitialised when made.
template<typename T>
class LeafArray
{
    static_assert(PagedMemory::pageBytes % (leafSize * sizeof(T)) == 0, "leaves are in one piece");

public:
    LeafArray() = default;
    explicit LeafArray(std::size_t leaves) : values_(leaves * leafSize) {}

    T* leaf(std::size_t n) { return &values_[n * leafSize]; }
    const T* leaf(std::size_t n) const { return &values_[n * leafSize]; }
    std::size_t leafCount() const { return values_.size() / leafSize; }

    /// How many leaves ahead of a pass memory is prefetched: a leaf is too short for the hardware
    /// prefetcher.
    static constexpr std::size_t ahead = 8;

    /// Asks for the memory of the leaf that a pass, now at leaf n, will soon come to.
    inline __attribute__((always_inline)) void prefetchAfter(std::size_t n) const
    {
        constexpr int line = 64 / sizeof(T);
        if (n + ahead < leafCount()) prefetch(n + ahead, 0, leafSize, line);
    }

    /// Asks for the values begin, begin + step... below end of leaf n. (Inlined always: GCC takes a
    /// function that only prefetches for one without effect, and drops calls of it.)
    inline __attribute__((always_inline)) void prefetch(std::size_t n, int begin, int end,
                                                        int step) const
    {
        const T* values = leaf(n);
        for (int i = begin; i < end; i += step) __builtin_prefetch(values + i);
    }

    std::size_t bytes() const { return values_.size() * sizeof(T); }

    /// Gives the same memory to values of another type of this size; it holds the bytes of the old
    /// ones.
    template<typename U>
    LeafArray<U> reused() &&
    {
        static_assert(sizeof(U) == sizeof(T));
        LeafArray<U> out;
        out.values_ = std::move(values_).template reused<U>();
        return out;
    }

private:
    template<typename>
    friend class LeafArray;

    PagedArray<T> values_;
};

using LeafField = LeafArray<float>;

LeafField copied(const LeafField& field);

/// The voxels of a leaf whose values are below a limit.
LeafMask lessThan(const float* values, float limit);

/// The voxels of a leaf whose values lie between -limit and limit.
LeafMask within(const float* values, float limit);

/// Leaves, those of each tile of 64^3 voxels one after another, so that passes over all find most
/// neighbours in the cache; tiles, and the leaves of a tile, in ascending order of their origins
/// (x, then y, then z). Copies share all but the masks.
class LeafTable
{
public:
    /// @param[in] origins  coordinates of the first voxels, multiples of 8; any order, no
    /// duplicates
    explicit LeafTable(std::vector<openvdb::Coord> origins = {});

    std::size_t size() const { return active_.size(); }
    const openvdb::Coord& origin(std::size_t n) const { return layout_->origins[n]; }
    const std::vector<openvdb::Coord>& origins() const { return layout_->origins; }

    /// Index of the leaf at offset (dx, dy, dz) in {-1, 0, 1}^3 leaves from leaf n, or noLeaf;
    /// entry 9 (dx + 1) + 3 (dy + 1) + dz + 1.
    const std::array<std::int32_t, 27>& neighbours(std::size_t n) const
    {
        return layout_->neighbours[n];
    }

    /// Index of the leaf that holds a voxel, or noLeaf.
    std::int32_t find(const openvdb::Coord& voxel) const { return layout_->find(voxel); }

    LeafMask& active(std::size_t n) { return active_[n]; }
    const LeafMask& active(std::size_t n) const { return active_[n]; }
    std::size_t activeCount() const;
    std::size_t bytes() const;

private:
    /// The leaves of 64^3 voxels.
    struct Tile {
        openvdb::Coord place;              ///< of its first voxel, over 64
        std::array<std::int32_t, 27> near; ///< indices of the tiles about it, or -1
        std::array<std::int32_t, 512> leaves;
    };

    /// Where leaves are, and a hash table of tiles to find them.
    struct Layout {
        std::vector<openvdb::Coord> origins;
        std::unique_ptr<std::array<std::int32_t, 27>[]> neighbours; ///< by leaf
        std::vector<Tile> tiles;
        std::vector<std::int32_t> slots; ///< indices of tiles or -1; a power of two of them

        std::size_t slotOf(const openvdb::Coord& place) const;
        std::int32_t find(const openvdb::Coord& voxel) const;
        void findNeighbours(std::size_t n);
    };

    std::shared_ptr<const Layout> layout_;
    std::vector<LeafMask> active_;
};

/// How a set of voxels is dilated: by cubes of (2 n + 1)^3 voxels, or by steps that go by turns to
/// the 6 and to the 26 neighbours, so that n steps hold the Euclidean ball of radius n voxels.
enum class Spread { Cube, Ball };

/// Voxels within a number of steps of the active voxels of a table.
/// @param[in] steps  at most 8
/// @return a new table of every leaf that has such a voxel, with those voxels active
LeafTable dilated(const LeafTable& table, int steps, Spread spread, const Progress& progress);

/// One step: the voxels of leaf n that have a voxel of the masks among themselves and their 6
/// (full: 26) neighbours.
/// @param[in] masks  one a leaf of the table
LeafMask dilatedMask(const LeafTable& table, const std::vector<LeafMask>& masks, std::size_t n,
                     bool full);

/// The table without the leaves that have no active voxel.
LeafTable pruned(const LeafTable& table);

/// The same leaves with no active voxel.
LeafTable emptied(LeafTable table);

/// The leaves of both tables, with the active voxels of both.
LeafTable joined(const LeafTable& a, const LeafTable& b);

/// The leaves of a table that lie in a box of whole leaves, with their active voxels.
LeafTable clipped(const LeafTable& table, const openvdb::CoordBBox& box);

} // namespace molsurf
