// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The checks of meshes that come from a file, a pickle or arrays anybody may write to.

#include "molsurf/mesh.h"
#include "molsurf/progress.h"

#include <cstddef>

namespace molsurf
{

/// Refuses the position of a vertex that is not finite or not below 1e6 Å.
/// @throws Error(ErrorKind::Input) that names the vertex by its index
void checkPosition(const openvdb::Vec3d& position, std::size_t vertex);

/// Refuses a mesh with such a position, a normal that is not finite, a corner that is no vertex, an
/// attribute without one value a vertex, or a part that begins outside of it.
/// @throws Error(ErrorKind::Input) that names the first fault
void checkArrays(const Mesh& mesh);

/// Refuses a mesh that is no closed, oriented manifold of triangles with three corners each.
/// @param[in] mesh  with corners that are vertices
/// @throws Error(ErrorKind::Input) that says what it has
void checkManifold(const Mesh& mesh, const Progress& progress);

} // namespace molsurf
