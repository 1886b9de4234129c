// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Finds the caps of a sphere that other balls cover.

#include "molsurf/kernel/balls/ball_boundary.h"
#include "molsurf/kernel/balls/box_tree.h"
#include "molsurf/kernel/balls/dense_caps.h"
#include "molsurf/kernel/balls/placed_ball.h"
#include "molsurf/progress.h"

#include <cstdint>
#include <vector>

namespace molsurf
{

/// The caps of a sphere, number by number: loops over them vectorise.
struct CapArrays {
    std::vector<double> x, y, z, cosine, sine;
    std::vector<std::int32_t> other;
    CapLists rounded; ///< the same as floats, padded

    int size() const { return int(other.size()); }
    void clear();
    void add(const openvdb::Vec3d& axis, double capCosine, double capSine, std::int32_t ball);
    Cap operator[](int k) const
    {
        const auto i = std::size_t(k);
        return {openvdb::Vec3d(x[i], y[i], z[i]), cosine[i], other[i]};
    }
};

/// The part of a sphere that another ball covers.
enum class Relation {
    Apart,   ///< nothing
    Meeting, ///< a cap
    Around   ///< all of it
};

/// Finds the relation of another ball to a sphere without rounding errors.
/// @param[in]  j    the place of the other ball
/// @param[out] cap  if it meets the sphere
Relation relate(const PlacedBall& ball, const PlacedBall& other, std::int32_t j, Cap& cap);

/// The knowledge of a ball that the search for its caps yields.
struct Exposure {
    bool possible;  ///< a part of the sphere may be uncovered; else it lies within other balls
    bool amongMany; ///< there are so many balls about it that not all of its overlaps are known
};

/// Finds the caps of balls. Safe to use from all threads, each with room of its own.
class CapFinder
{
public:
    /// @param[in] balls  kept by reference
    explicit CapFinder(const std::vector<PlacedBall>& balls);

    /// Room for one ball, kept from ball to ball by a thread.
    struct Scratch {
        std::vector<std::size_t> groups;
        std::vector<std::int32_t> near; // balls that touch it, by rounded places
        std::vector<double> wayX, wayY, wayZ, radius, cosine;
        std::vector<std::int32_t> relation, order;
        std::vector<Cap> found;
    };

    /// The caps of a ball, the large ones first, without those that lie well within another one.
    /// Where very many balls are near each other, without those that its power cell does not touch.
    Exposure find(std::int32_t i, Scratch& scratch, CapArrays& caps) const;

private:
    bool gather(std::int32_t i, Scratch& scratch) const;

    const std::vector<PlacedBall>& balls_;
    std::vector<float> x_, y_, z_, radius_; // of the balls, rounded
    BoxTree tree_;
    DenseCaps dense_;
};

} // namespace molsurf
