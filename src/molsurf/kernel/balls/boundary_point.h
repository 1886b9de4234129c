// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The point of the boundary of a union of balls that is nearest to a given point, exactly.

#include "molsurf/kernel/balls/ball_boundary.h"
#include "molsurf/kernel/balls/boundary_measure.h"
#include "molsurf/kernel/balls/box_tree.h"

#include <openvdb/Types.h>

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace molsurf
{

/// The part of the boundary that a point lies on. The points at a probe radius inside of a patch,
/// an arc and a corner are those of a contact, a toric re-entrant and a spherical re-entrant face
/// (Connolly, J. Appl. Cryst. 16:548-558, 1983).
enum class BoundaryPart : std::uint8_t { Patch, Arc, Corner };

/// A point of the boundary.
struct BoundaryPoint {
    BoundaryPart part;
    std::uint32_t index;     ///< of the patch, arc or corner
    openvdb::Vec3d position; ///< [Å]
    double distance;         ///< from the given point, >= 0 [Å]
};

/// Finds nearest points in double precision, but for the borders of patches, which are as exact as
/// floats (BallBoundary::caps). Immutable once made; safe to use from all threads.
class BoundaryPoints
{
public:
    /// @param[in] boundary  with at least one patch; has to outlive this object
    explicit BoundaryPoints(const BallBoundary& boundary);

    /// Leaves out some pieces.
    /// @param[in] measure  of the boundary
    /// @param[in] kept     one a piece
    BoundaryPoints(const BallBoundary& boundary, const BoundaryMeasure& measure,
                   const std::vector<char>& kept);

    /// The point nearest to x; of equally near ones corners come before arcs and these before
    /// patches, and the lower index first.
    /// @param[in] x      [Å]
    /// @param[in] guess  how far away it may be: the search widens from there [Å], > 0
    BoundaryPoint nearest(const openvdb::Vec3d& x, double guess) const;

private:
    /// An arc of a patch with some faces that are left out and some that are not.
    struct Side {
        std::uint32_t arc;
        bool kept; ///< the face there
    };

    bool isKept(std::size_t patch, const openvdb::Vec3d& point) const;
    void search(const openvdb::Vec3d& x, BoundaryPoint& best) const;

    const BallBoundary& boundary_;
    BoxTree patches_, arcs_, corners_;
    std::vector<double> cosines_; // of half the angle of each arc; below -1: a whole circle
    // Parts that stay; empty: all.
    std::vector<char> patchKept_, arcKept_, cornerKept_;
    std::unordered_map<std::size_t, std::vector<Side>> mixed_; // of patches kept in part
};

} // namespace molsurf
