// SPDX-License-Identifier: MPL-2.0
#include "molsurf/mesh/ray_scene.h"

#include "molsurf/error.h"

#include <cstring>
#include <new>
#include <string>

namespace molsurf
{

RayScene::RayScene(const Mesh& mesh)
{
    device_ = rtcNewDevice(nullptr);
    if (!device_) throw std::bad_alloc();
    scene_ = rtcNewScene(device_);
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    // Embree reads 16 bytes at the last vertex too, so it gets buffers of its own.
    void* positions =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(openvdb::Vec3f), mesh.positions.size());
    void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                              3 * sizeof(std::uint32_t), mesh.triangles.size());
    if (positions && triangles) {
        std::memcpy(positions, mesh.positions.data(),
                    mesh.positions.size() * sizeof(openvdb::Vec3f));
        std::memcpy(triangles, mesh.triangles.data(),
                    mesh.triangles.size() * 3 * sizeof(std::uint32_t));
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
    }
    rtcReleaseGeometry(geometry);
    check();
    rtcCommitScene(scene_);
    check();
}

RayScene::~RayScene()
{
    if (scene_) rtcReleaseScene(scene_);
    if (device_) rtcReleaseDevice(device_);
}

void RayScene::check() const
{
    const RTCError error = rtcGetDeviceError(device_);
    if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
    if (error != RTC_ERROR_NONE) {
        throw Error(ErrorKind::Numeric, "Embree failed with error " + std::to_string(int(error)));
    }
}

} // namespace molsurf
