// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Where a probe touches three balls: what arcs end there, and which other probes are near.

#include "molsurf/kernel/balls/ball_boundary.h"
#include "molsurf/kernel/balls/boundary_measure.h"
#include "molsurf/kernel/balls/box_tree.h"
#include "molsurf/kernel/balls/quad.h"

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace molsurf
{

/// A corner with the arcs that end there. Side k is that between the balls k and (k + 1) % 3.
struct ProbeCorner {
    CornerName name;
    openvdb::Vec3d position;
    std::uint32_t arcs[3];    ///< of the sides
    int ends[3];              ///< of the arcs: 0 the first, 1 the last about the arc's axis
    std::int32_t partners[3]; ///< the corner beyond the covered part of the circle of each side
};

/// The corners of a boundary, without those of cavities that are left out.
class ProbeCorners
{
public:
    /// @param[in] boundary  has to outlive this object
    ProbeCorners(const BallBoundary& boundary, const BoundaryMeasure& measure,
                 const Progress& progress);

    std::size_t size() const { return corners_.size(); }
    const ProbeCorner& operator[](std::size_t c) const { return corners_[c]; }
    /// The corner at an end of an arc; -1: none.
    std::int32_t at(std::size_t arc, int end) const { return atEnds_[2 * arc + std::size_t(end)]; }

    /// Calls f(other, offset) for all other corners less than `reach` away [Å], with the way to
    /// there, whose direction is as exact as a double however near the other is.
    template<typename F>
    void forEachNear(std::size_t c, double reach, const F& f) const
    {
        const openvdb::Vec3d& x = corners_[c].position;
        tree_.forEachNear(Box::about(x, reach), [&](std::size_t group) {
            const std::size_t begin = BoxTree::group * group;
            const std::size_t end = std::min(begin + BoxTree::group, corners_.size());
            for (std::size_t o = begin; o < end; ++o) {
                openvdb::Vec3d way = corners_[o].position - x;
                if (o == c || !(way.lengthSqr() < reach * reach)) continue;
                if (way.lengthSqr() < close * close) way = exactWay(c, o);
                f(o, way);
            }
        });
    }

private:
    static constexpr double close = 1e-3; // [Å]

    void findEnds(const BallBoundary& boundary, const BoundaryMeasure& measure);
    void findPartners(const BallBoundary& boundary, const BoundaryMeasure& measure);
    std::vector<Box> boxes() const;
    openvdb::Vec3d exactWay(std::size_t from, std::size_t to) const;

    const BallBoundary& boundary_;
    std::vector<ProbeCorner> corners_;
    std::vector<std::int32_t> atEnds_; // of arcs, two each
    BoxTree tree_;
    std::unordered_map<std::size_t, QuadVector> exact_; // of corners close to others
};

} // namespace molsurf
