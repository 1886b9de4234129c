// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The part of a surface that a unit owns, cut out along the exact border with its neighbours.

#include "molsurf/kernel/balls/power_owners.h"
#include "molsurf/kernel/spline/spline.h"
#include "molsurf/mesh.h"
#include "molsurf/progress.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace molsurf
{

/// No edge.
constexpr std::uint32_t noEdge = std::numeric_limits<std::uint32_t>::max();

/// An edge of the border, the unit on its left if seen from outside the molecule.
struct BorderEdge {
    std::uint32_t from;             ///< vertex
    std::int32_t owner;             ///< beyond it
    std::uint32_t triangle;         ///< (from, to, a vertex that is not of the border)
    std::uint32_t next;             ///< edge
    std::uint32_t previous;         ///< edge
    std::uint32_t partner = noEdge; ///< the edge that it is, the other way round, in a neighbour
    std::int32_t neighbour = -1;    ///< the motion of that
};

/// A part of a mesh with its border.
struct CutMesh {
    Mesh mesh;                          ///< vertices of the whole first, then those of the border
    std::vector<std::uint32_t> sources; ///< of the former: their indices in the whole
    std::vector<BorderEdge> border;     ///< closed lines, one after another
};

/// Cuts out of a mesh what owner 0 has. The vertices of the border lie on S = 0 where the power of
/// owner 0 is that of another one, corners where it is that of two.
///
/// @param[in] mesh   closed and 2-manifold, with its vertices on S = 0, normals and no scalars but
///                   mean and Gaussian curvature
CutMesh cutToOwner(const Mesh& mesh, const PowerOwners& owners, const Spline& spline,
                   const Progress& progress);

} // namespace molsurf
