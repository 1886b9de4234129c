// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Finds things near a box by a tree of their bounding boxes, where their numbers follow a
/// space-filling curve.

#include "molsurf/kernel/core/simd.h"

#include <openvdb/Types.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace molsurf
{

/// A box, its sides parallel to the axes [Å].
struct Box {
    openvdb::Vec3d low, high;

    static Box about(const openvdb::Vec3d& centre, double radius)
    {
        return {centre - openvdb::Vec3d(radius), centre + openvdb::Vec3d(radius)};
    }

    /// The square of the distance from a point, 0 in the box [Å^2].
    double squareTo(const openvdb::Vec3d& x) const
    {
        double sum = 0.0;
        for (int a = 0; a < 3; ++a) {
            const double d = std::max({0.0, low[a] - x[a], x[a] - high[a]});
            sum += d * d;
        }
        return sum;
    }
};

/// A bounding volume hierarchy of eight children a node over groups of eight consecutive things:
/// these are near each other, so no sorting is needed. Immutable once made; safe to read from all
/// threads.
class BoxTree
{
public:
    static constexpr std::size_t group = floatLanes;

    /// @param[in] boxes  one a thing
    explicit BoxTree(const std::vector<Box>& boxes);

    /// Calls f(g) in ascending order for groups g, of the things 8 g to 8 g + 7: all that have a
    /// thing whose box meets the given one, and some more.
    template<typename F>
    void forEachNear(const Box& box, const F& f) const
    {
        if (!levels_.empty()) visit(rounded(box), levels_.size() - 1, 0, 0, f);
    }

    /// The octets of eight consecutive groups that meet a box, in ascending order.
    void findOctets(const Box& box, std::vector<std::size_t>& octets) const;

    /// The same as the first, where the octets of a box about the given one are known.
    template<typename F>
    void forEachNear(const Box& box, const std::vector<std::size_t>& octets, const F& f) const
    {
        const Ends ends = rounded(box);
        for (const std::size_t octet : octets) visit(ends, 0, group * octet, 0, f);
    }

private:
    /// Lower and upper ends along the axes, rounded outward.
    using Ends = std::array<float, 6>;
    static Ends rounded(const Box& box);

    /// The boxes of nodes, number by number, padded by empty ones to whole groups.
    using Level = std::array<std::vector<float>, 6>;

    /// One bit for each of the eight boxes from `first` that meets a box.
    static std::uint32_t meeting(const Level& level, std::size_t first, const Ends& box);

    /// Calls f with the nodes of the last level.
    template<typename F>
    void visit(const Ends& box, std::size_t level, std::size_t first, std::size_t last,
               const F& f) const
    {
        for (std::uint32_t bits = meeting(levels_[level], first, box); bits != 0;
             bits &= bits - 1) {
            const std::size_t node = first + std::size_t(__builtin_ctz(bits));
            if (level == last) {
                f(node);
            } else {
                visit(box, level - 1, group * node, last, f);
            }
        }
    }

    std::vector<Level> levels_; // the first has a box for each group of things, the last one group
};

} // namespace molsurf
