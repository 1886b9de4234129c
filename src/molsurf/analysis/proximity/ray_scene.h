// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Triangle meshes, balls and sticks in Embree's hands.

#include "molsurf/analysis/proximity/embree.h"
#include "molsurf/analysis/proximity/ray_unit.h"
#include "molsurf/kernel/mesh/mesh_instance.h"
#include "molsurf/mesh.h"

#include <functional>
#include <utility>
#include <vector>

namespace molsurf
{

/// A bounding volume hierarchy over the triangles of a mesh, numbered as there.
class RayScene
{
public:
    using Triangles = decltype(Mesh::triangles);

    /// @param[in] mesh  with at least one triangle, positions finite
    /// @throws std::bad_alloc
    /// @throws Error(ErrorKind::Numeric) if Embree refuses
    explicit RayScene(const Mesh& mesh) : RayScene(mesh.positions, mesh.triangles) {}

    /// The same of some of its triangles, which have to live as long.
    RayScene(const std::vector<openvdb::Vec3f>& positions, const Triangles& triangles);

    /// The same of copies of parts, without making them: a hit has the index of its instance, and
    /// the triangle's within its part.
    /// @param[in] parts  triangles [first, end) of each
    RayScene(const Mesh& mesh, const std::vector<std::pair<std::size_t, std::size_t>>& parts,
             const std::vector<MeshInstance>& instances);

    /// The same of copies of units, as MeshInstance::part numbers them; they have to live as long.
    /// A hit has RayUnit::Kind as its geometry, and the index of the shape among those.
    RayScene(const std::vector<const RayUnit*>& units, const std::vector<MeshInstance>& instances);
    ~RayScene();
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;

    RTCScene get() const { return scene_; }

private:
    /// A device without a scene. The destructor releases it whatever follows.
    RayScene();
    RTCScene sceneOf(const std::function<void(RTCScene)>& attach);
    RTCScene sceneOf(const std::vector<openvdb::Vec3f>& positions, const Triangles& triangles,
                     std::size_t first, std::size_t end);
    void addTriangles(const std::vector<openvdb::Vec3f>& positions, const Triangles& triangles,
                      std::size_t first, std::size_t end, RTCScene scene);
    void addBalls(const RayUnit& unit, RTCScene scene);
    void addSticks(const RayUnit& unit, RTCScene scene);
    void place(const std::vector<MeshInstance>& instances);
    void check() const;

    RTCDevice device_ = nullptr;
    RTCScene scene_ = nullptr;
    std::vector<RTCScene> parts_;
};

} // namespace molsurf
