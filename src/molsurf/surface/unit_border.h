// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The border of a symmetric unit, made to fit those of its neighbours vertex on vertex.

#include "molsurf/atoms.h"
#include "molsurf/kernel/core/disjoint_sets.h"
#include "molsurf/surface.h"
#include "molsurf/surface/unit_cut.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace molsurf
{

/// A border that was fitted.
struct BorderFit {
    /// Every vertex of the border, once for each neighbour.
    std::vector<MolecularSurface::SharedVertex> shared;
    std::size_t open = 0; ///< edges of the border that fit none of a neighbour's
    double filled = 0.0;  ///< area of triangles in the holes that these left [Å^2]
    double largest = 0.0; ///< gap that was closed [Å]
};

/// The vertices of a whole that vertices of its units share.
class BorderClasses
{
public:
    /// @param[in] vertices  of the unit's mesh
    BorderClasses(const Placement::Unit& unit,
                  const std::vector<MolecularSurface::SharedVertex>& shared, std::size_t vertices);

    /// Vertices of the unit that are shared, ascending.
    const std::vector<std::uint32_t>& border() const { return border_; }

    /// The place of a vertex of the unit in border(), or -1.
    std::int32_t placeOf(std::uint32_t vertex) const { return place_[vertex]; }

    /// The first of the unit and place that are the same vertex, as unit * border().size() + place.
    std::size_t firstOf(std::size_t unit, std::int32_t place)
    {
        return sets_.find(std::uint32_t(unit * border_.size() + std::size_t(place)));
    }

    /// The number of vertices of the whole that are shared.
    std::size_t count();

private:
    std::size_t order_;
    std::vector<std::uint32_t> border_;
    std::vector<std::int32_t> place_;
    DisjointSets sets_;
};

/// Makes the border of a unit congruent with those of its neighbours.
///
/// The surface of a neighbour is that of the unit, turned, but was found on other voxels. Where the
/// lines of both run side by side they are glued: they get the vertices of both, each in the middle
/// of where it was on either side. Holes that are left are filled by triangles. A surface that is
/// glued along edges is one, whatever edges these are, so the whole is closed if the unit's surface
/// was.
///
/// @param[in]     placement  of the unit
/// @param[in]     voxel  what is farther apart is not glued [Å]
/// @param[in,out] part   what owner 0 has; its border is used up
BorderFit fitBorder(const Placement& placement, double voxel, CutMesh& part);

} // namespace molsurf
