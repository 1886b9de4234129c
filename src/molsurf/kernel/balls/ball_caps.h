// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Finds the caps of a sphere that other balls cover.

#include "molsurf/kernel/balls/ball_boundary.h"
#include "molsurf/kernel/balls/box_tree.h"
#include "molsurf/kernel/balls/dense_caps.h"
#include "molsurf/kernel/balls/placed_ball.h"
#include "molsurf/progress.h"

#include <array>
#include <cstdint>
#include <vector>

namespace molsurf
{

/// The caps of a sphere, number by number: loops over them vectorise.
struct CapArrays {
    std::vector<double> x, y, z, cosine, sine; ///< longer, perhaps, than there are caps
    std::vector<std::int32_t> other;
    CapLists rounded; ///< the same as floats, padded

    int size() const { return int(other.size()); }
    /// Makes room, and gives no memory back.
    void resize(std::size_t count);
    /// Sets a cap, but for its floats.
    void set(std::size_t i, const Cap& cap);
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

/// The cap of another ball that is known to meet the sphere, as relate() has it.
Cap meetingCap(const PlacedBall& ball, const PlacedBall& other, std::int32_t j);

/// The knowledge of a ball that the search for its caps yields.
struct Exposure {
    bool possible;  ///< a part of the ball may lie in no other one
    bool amongMany; ///< there are so many balls about it that not all of its overlaps are known
    bool hidden;    ///< other balls surely cover all of its sphere
};

/// Some of the balls, as floats.
struct RoundedBalls {
    const float *x, *y, *z, *radius;
};

/// Ways to balls, coordinate by coordinate.
using Ways = std::array<std::vector<double>, 3>;

/// Finds the caps of balls. Safe to use from all threads, each with room of its own.
class CapFinder
{
public:
    /// @param[in] balls  kept by reference
    explicit CapFinder(const std::vector<PlacedBall>& balls);

    /// Room for one ball, kept from ball to ball by a thread.
    struct Scratch {
        std::int32_t block = -1; // of eight balls, which have octets in common
        std::vector<std::size_t> octets, groups;
        std::vector<std::int32_t> touching; // room for `near`
        std::vector<std::int32_t> near;     // others that touch it, by rounded places
        CapArrays all;                      // of `near`
        CapLists met;                       // some of these, the large ones first
        std::vector<std::int32_t> relation, bin, places, kept;
        std::vector<std::uint8_t> isKept;
        std::vector<Cap> found;
    };

    /// The caps of a ball, the large ones first, without those that lie well within another one.
    /// Where very many balls are near each other, without those that its power cell does not touch.
    /// Of a hidden ball there are none, but balls that cover it, in scratch.near.
    Exposure find(std::int32_t i, Scratch& scratch, CapArrays& caps) const;

    /// The caps of a ball with others that find() has given, to the same bits.
    /// @param[in] others  `count` balls, in the order of their caps
    void findAgain(std::int32_t i, const std::int32_t* others, std::size_t count, Scratch& scratch,
                   CapArrays& caps) const;

private:
    bool findNear(std::int32_t i, Scratch& scratch) const;
    bool keepNear(std::int32_t i, Scratch& scratch) const;
    bool relate(std::int32_t i, const std::int32_t* near, std::size_t count, Scratch& scratch,
                CapArrays& caps) const;
    bool gather(std::int32_t i, Scratch& scratch, CapArrays& caps) const;
    RoundedBalls rounded() const { return {x_.data(), y_.data(), z_.data(), radius_.data()}; }

    /// The rounding of the place and radius of a ball to floats, and more [Å].
    double roundingOf(std::int32_t i) const;

    const std::vector<PlacedBall>& balls_;
    std::vector<float> x_, y_, z_, radius_; // rounded, from the first ball
    Ways ways_;                             // from there to the balls, if differences are exact
    BoxTree tree_;
    DenseCaps dense_;
};

} // namespace molsurf
