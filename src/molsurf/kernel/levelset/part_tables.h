// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The parts of the boundary of a union of balls, each with the region in which it can be the
/// nearest, and those of them near a leaf.

#include "molsurf/kernel/balls/ball_boundary.h"
#include "molsurf/kernel/balls/box_tree.h"
#include "molsurf/kernel/levelset/nearest_part.h"
#include "molsurf/progress.h"

#include <functional>
#include <optional>
#include <vector>

namespace molsurf
{

/// Parts of one kind in their order, which follows a space-filling curve.
class PartTable
{
public:
    /// Makes the table.
    /// @param[in] size   of parts
    /// @param[in] count  of their numbers
    /// @param[in] set    sets the numbers, place and region of a part
    void make(std::size_t size, int count, const Progress& progress,
              const std::function<void(std::size_t)>& set);

    PartList list;                ///< without places
    std::vector<double> place[3]; ///< [Å]
    std::vector<Box> regions;     ///< while the table is made

    void setPlace(std::size_t i, const openvdb::Vec3d& x)
    {
        for (int a = 0; a < 3; ++a) place[a][i] = x[a];
    }
    void set(std::size_t i, int number, double value)
    {
        list.numbers[std::size_t(number)][i] = float(value);
    }
    void set(std::size_t i, int firstNumber, const openvdb::Vec3d& values)
    {
        for (int a = 0; a < 3; ++a) set(i, firstNumber + a, values[a]);
    }

    /// Calls f(group) for groups of eight parts whose regions may meet a box.
    template<typename F>
    void forEachNear(const Box& box, const F& f) const
    {
        tree_->forEachNear(box, [&](std::size_t g) {
            f(PartGroup{list, place, BoxTree::group * g});
        });
    }

private:
    std::optional<BoxTree> tree_;
};

enum class PartKind { Patch, Arc, Corner };

/// A part by its index in the boundary: patches, then arcs, then corners.
struct Part {
    PartKind kind;
    openvdb::Vec3d place; ///< of the corner, or the centre of the sphere or circle [Å]
    float radius;         ///< of the sphere or circle [Å]
    openvdb::Vec3f axis;  ///< of the circle
};

/// All parts of a boundary.
class PartTables
{
public:
    /// @param[in,out] boundary  its arcs and corners are taken
    /// @param[in] balls   of the union, before they are grown by the probe
    /// @param[in] inside  parts are sought for points no deeper than this [Å]
    PartTables(BallBoundary& boundary, const std::vector<Ball>& balls, double probe, double inside,
               const Progress& progress);

    /// The parts that may be the nearest to a point of a leaf, and the balls near it.
    /// @param[in] centre   of the leaf; places in the lists are relative to it
    /// @param[in] half     of the edge of the box of its voxels
    /// @param[in] outside  how far from the leaf spheres of balls count
    void gather(const openvdb::Vec3d& centre, double half, double outside, LeafParts& out) const;

    std::size_t patches() const { return std::size_t(patches_.list.size); }
    Part part(std::int32_t index) const;

private:
    double inside_;
    PartTable corners_, arcs_, patches_, balls_;
};

} // namespace molsurf
