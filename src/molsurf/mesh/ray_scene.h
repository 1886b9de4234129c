// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A triangle mesh in Embree's hands.

#include "molsurf/mesh.h"

#include <embree3/rtcore.h>

namespace molsurf
{

/// A bounding volume hierarchy over the triangles of a mesh, numbered as there.
class RayScene
{
public:
    /// @param[in] mesh  with at least one triangle, positions finite
    /// @throws std::bad_alloc
    /// @throws Error(ErrorKind::Numeric) if Embree refuses
    explicit RayScene(const Mesh& mesh);
    ~RayScene();
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;

    RTCScene get() const { return scene_; }

private:
    void check() const;

    RTCDevice device_ = nullptr;
    RTCScene scene_ = nullptr;
};

} // namespace molsurf
