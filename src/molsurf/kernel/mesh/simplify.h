// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Fewer vertices on the same surface.

#include "molsurf/mesh.h"
#include "molsurf/progress.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace molsurf
{

/// A mesh whose vertices are some of those of another one.
struct ThinnedMesh {
    std::vector<std::uint32_t> vertices; ///< those that are left, ascending
    /// Indices into `vertices`.
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Takes vertices away until a number of them is left, at the shortest edges first, so that what is
/// left is spread evenly. An edge is contracted to one of its ends, and none is moved. The surface
/// keeps its topology: an edge is left if contracting it would join what is apart, fold a triangle
/// or turn one away from the normal of a corner, or make a needle. So more vertices than wanted may
/// be left, at least four a piece.
///
/// Deterministic, by one thread: a few microseconds for each vertex that goes.
/// @param[in] mesh  closed, oriented, 2-manifold, with normals
ThinnedMesh thinned(const Mesh& mesh, std::size_t wanted, const Progress& progress);

} // namespace molsurf
