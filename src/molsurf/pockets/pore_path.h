// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Ways on a PoreGrid.

#include "molsurf/pockets/pore_grid.h"
#include "molsurf/progress.h"

#include <openvdb/Types.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace molsurf
{

/// A way on a lattice.
struct PorePath {
    std::vector<std::size_t> cells; ///< from end to end
    double cost = 0.0;              ///< the less the wider and shorter it is
    double outside = 0.0;           ///< length that is neither enclosed nor near the ends [Å]
    std::size_t leaves = 0;         ///< the first point of that
};

/// Rules of a way.
struct PathRule {
    double near; ///< what is so near to an end need not be enclosed [Å]
    bool rises;  ///< whether it never goes down along the axis
};

/// Finds the way from one point of a lattice to another that is wide and short: the integral of
/// exp(-room / 0.25 Å) over it is the least. What is not enclosed counts as a place with too little
/// room.
PorePath widestPath(const PoreGrid& grid, std::size_t from, std::size_t to, const PathRule& rule,
                    const Progress& progress);

/// Finds a way that is enclosed and rises from the lower end of the lattice to the upper one, as
/// far as it can; from its middle to where it opens.
/// @return its points and its cost, 1 for each Å of height that it lacks and each Å that is
///         0.7 Å wide, less for wider ones; none where nothing opens
std::optional<PorePath> throughPath(const PoreGrid& grid, const Progress& progress);

} // namespace molsurf
