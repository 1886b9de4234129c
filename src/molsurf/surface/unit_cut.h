// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The part of a surface that a unit owns, cut out along the exact border with its neighbours.

#include "molsurf/balls/power_owners.h"
#include "molsurf/mesh.h"
#include "molsurf/progress.h"
#include "molsurf/spline/spline.h"

#include <cstdint>
#include <vector>

namespace molsurf
{

/// A closed line of border vertices, the unit on its left if seen from outside the molecule.
struct BorderLoop {
    std::vector<std::uint32_t> vertices;  ///< in order
    std::vector<std::int32_t> owners;     ///< beyond the edge from vertex i to the next one
    std::vector<std::uint32_t> triangles; ///< at that edge: their first two vertices are its own
};

/// A part of a mesh with its border.
struct CutMesh {
    Mesh mesh;                          ///< vertices of the whole first, then those of the border
    std::vector<std::uint32_t> sources; ///< of the former: their indices in the whole
    std::vector<BorderLoop> loops;
};

/// Cuts out of a mesh what owner 0 has. The vertices of the border lie on S = 0 where the power of
/// owner 0 is that of another one, corners where it is that of two.
///
/// @param[in] mesh   closed and 2-manifold, with its vertices on S = 0, normals and the scalars
/// mean
///                   and Gaussian curvature alone
CutMesh cutToOwner(const Mesh& mesh, const PowerOwners& owners, const Spline& spline,
                   const Progress& progress);

} // namespace molsurf
