// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The room about balls on a lattice along an axis, and what of it the balls enclose sideways.

#include "molsurf/ball.h"
#include "molsurf/progress.h"

#include <openvdb/Types.h>

#include <array>
#include <cstdint>
#include <vector>

namespace molsurf
{

/// Points on a lattice whose third direction is an axis.
class PoreGrid
{
public:
    /// Extent of the lattice.
    struct Extent {
        openvdb::Vec3d axis;      ///< a unit vector
        openvdb::Vec3d low, high; ///< along the directions of frameOf(axis) [Å]
        double spacing;           ///< [Å]
    };

    /// More room than this is this [Å].
    static constexpr float mostRoom = 3.0f;

    PoreGrid(const std::vector<Ball>& balls, const Extent& extent, const Progress& progress);

    /// The directions of the lattice for an axis.
    static std::array<openvdb::Vec3d, 3> frameOf(const openvdb::Vec3d& axis);

    std::size_t size() const { return room_.size(); }
    double spacing() const { return extent_.spacing; }
    /// f of a point, at most mostRoom [Å].
    float room(std::size_t cell) const { return room_[cell]; }
    /// Whether balls lie on almost all sides of it, seen at right angles to the axis.
    bool isEnclosed(std::size_t cell) const { return open_[cell] <= mostOpen; }
    openvdb::Vec3d place(std::size_t cell) const;
    double height(std::size_t cell) const;
    bool isBelow(std::size_t cell, std::size_t other) const
    {
        const std::size_t layer = std::size_t(count_[0]) * std::size_t(count_[1]);
        return cell / layer < other / layer;
    }
    /// The point nearest to a place within the lattice.
    std::size_t nearest(const openvdb::Vec3d& x) const;
    /// Whether there is one near a place.
    bool covers(const openvdb::Vec3d& x) const;

    /// Calls f(neighbour, distance) for the 26 points about one, or those that there are.
    template<typename F>
    void forEachNeighbour(std::size_t cell, const F& f) const
    {
        const std::array<int, 3> at = cornerOf(cell);
        for (int dz = -1; dz <= 1; ++dz)
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx) {
                    const std::array<int, 3> to = {at[0] + dx, at[1] + dy, at[2] + dz};
                    if ((dx == 0 && dy == 0 && dz == 0) || !has(to)) continue;
                    f(index(to), extent_.spacing * ways[std::size_t(dx * dx + dy * dy + dz * dz)]);
                }
    }

private:
    static constexpr int mostOpen = 3; // of 16 directions
    static constexpr double ways[4] = {0.0, 1.0, 1.4142135623730951, 1.7320508075688772};

    bool has(const std::array<int, 3>& at) const
    {
        for (std::size_t i = 0; i < 3; ++i)
            if (at[i] < 0 || at[i] >= count_[i]) return false;
        return true;
    }
    std::size_t index(const std::array<int, 3>& at) const
    {
        return (std::size_t(at[2]) * std::size_t(count_[1]) + std::size_t(at[1])) *
                   std::size_t(count_[0]) +
               std::size_t(at[0]);
    }
    std::array<int, 3> cornerOf(std::size_t cell) const;
    std::array<int, 3> corner(const openvdb::Vec3d& x) const;

    void fillLayer(int layer, const std::vector<Ball>& sorted, double largest);
    void findOpen(int layer);

    Extent extent_;
    std::array<openvdb::Vec3d, 3> frame_;
    std::array<int, 3> count_;
    std::vector<float> room_;
    std::vector<std::uint8_t> open_; // of 16 directions in its layer, those without a wall
};

} // namespace molsurf
