// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The point of a triangle mesh that is nearest to a given point.

#include "molsurf/mesh.h"

#include <cstdint>
#include <memory>

namespace molsurf
{

class RayScene;

/// A point of a mesh.
struct MeshPoint {
    openvdb::Vec3d point;   ///< [Å]
    openvdb::Vec3d weights; ///< of the triangle's corners, >= 0, sum 1; 0 if not on them, exactly
    std::uint32_t triangle; ///< index; if several are as near, the least
};

/// Finds closest points: a bounding volume hierarchy by Embree, distances in double precision.
///
/// The hierarchy only narrows the choice, by a margin for its float bounds; so the answer is that
/// of a search through all triangles, whatever the hierarchy looks like.
class ClosestPoint
{
public:
    /// @param[in] mesh  with at least one triangle, positions finite; must outlive this object
    /// @throws std::bad_alloc
    /// @throws Error(ErrorKind::Numeric) if Embree refuses
    explicit ClosestPoint(const Mesh& mesh);
    ~ClosestPoint();
    ClosestPoint(const ClosestPoint&) = delete;
    ClosestPoint& operator=(const ClosestPoint&) = delete;

    /// The point nearest to @a x [Å]. May be called from many threads.
    MeshPoint at(const openvdb::Vec3d& x) const;

private:
    const Mesh& mesh_;
    double reach_ = 0.0; ///< largest coordinate of the mesh [Å]
    std::unique_ptr<RayScene> scene_;
};

} // namespace molsurf
