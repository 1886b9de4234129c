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
    /// Makes room for caps that set() is to give; until then they cover nothing.
    void makeRoom(std::size_t count);
    /// Keeps the first of them.
    void shrink(std::size_t count);
    void set(std::size_t i, const Cap& cap, double capSine)
    {
        x[i] = cap.axis.x();
        y[i] = cap.axis.y();
        z[i] = cap.axis.z();
        cosine[i] = cap.cosine;
        sine[i] = capSine;
        other[i] = cap.other;
        rounded.set(i, cap, capSine);
    }
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

/// Finds the caps of balls. Safe to use from all threads, each with room of its own.
class CapFinder
{
public:
    /// @param[in] balls  kept by reference
    explicit CapFinder(const std::vector<PlacedBall>& balls);

    /// Room for one ball, kept from ball to ball by a thread.
    struct Scratch {
        std::vector<std::size_t> groups;
        std::vector<std::int32_t> touching; // room for `near`
        std::vector<std::int32_t> near;     // balls that touch it, by rounded places
        std::vector<double> wayX, wayY, wayZ, radius, cosine, sine;
        std::vector<std::int32_t> relation, bin, order;
        std::vector<Cap> found;
        CapLists met; // the caps of `order`

        Cap capAt(std::size_t k) const
        {
            return {openvdb::Vec3d(wayX[k], wayY[k], wayZ[k]), cosine[k], near[k]};
        }

        /// Calls f(j) for the balls that meet the one of the last find().
        template<typename F>
        void forEachMet(const F& f) const
        {
            for (const std::int32_t k : order) f(near[std::size_t(k)]);
        }
    };

    /// The caps of a ball, the large ones first, without those that lie well within another one.
    /// Where very many balls are near each other, without those that its power cell does not touch.
    /// Of a hidden ball there are only the floats of all caps, in scratch.met.
    Exposure find(std::int32_t i, Scratch& scratch, CapArrays& caps) const;

    /// The caps of a ball with others that find() has given, to the same bits.
    /// @param[in] others  `count` balls, in the order of their caps
    void findAgain(std::int32_t i, const std::int32_t* others, std::size_t count, Scratch& scratch,
                   CapArrays& caps) const;

private:
    void relateNear(std::int32_t i, Scratch& scratch) const;
    bool gather(std::int32_t i, Scratch& scratch) const;

    const std::vector<PlacedBall>& balls_;
    std::vector<float> x_, y_, z_, radius_; // of the balls, rounded
    std::vector<openvdb::Vec3d> fromFirst_; // ways to the balls, if their differences are exact
    BoxTree tree_;
    DenseCaps dense_;
};

} // namespace molsurf
