// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/proximity/ray_scene.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/memory.h"

#include <cstring>
#include <new>
#include <string>

namespace molsurf
{

RayScene::RayScene() : device_(rtcNewDevice(nullptr))
{
    if (!device_) throw std::bad_alloc();
}

RayScene::RayScene(const std::vector<openvdb::Vec3f>& positions, const Triangles& triangles)
    : RayScene()
{
    scene_ = sceneOf(positions, triangles, 0, triangles.size());
    trimHeap(); // what it was built with
}

RayScene::RayScene(const Mesh& mesh, const std::vector<std::pair<std::size_t, std::size_t>>& parts,
                   const std::vector<MeshInstance>& instances)
    : RayScene()
{
    for (const auto& [first, end] : parts)
        parts_.push_back(sceneOf(mesh.positions, mesh.triangles, first, end));
    place(instances);
}

RayScene::RayScene(const std::vector<const RayUnit*>& units,
                   const std::vector<MeshInstance>& instances)
    : RayScene()
{
    for (const RayUnit* unit : units) {
        parts_.push_back(sceneOf([&](RTCScene scene) {
            if (!unit->balls.empty()) addBalls(*unit, scene);
            if (!unit->sticks.empty()) addSticks(*unit, scene);
            const Mesh& mesh = unit->mesh;
            if (!mesh.triangles.empty())
                addTriangles(mesh.positions, mesh.triangles, 0, mesh.triangles.size(), scene);
        }));
    }
    place(instances);
}

/// The scene of copies of the parts.
void RayScene::place(const std::vector<MeshInstance>& instances)
{
    scene_ = rtcNewScene(device_);
    for (std::size_t i = 0; i < instances.size(); ++i) {
        const MeshInstance& instance = instances[i];
        const RTCGeometry copy = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(copy, parts_[instance.part]);
        float rows[12];
        for (std::size_t row = 0; row < 3; ++row) {
            for (std::size_t column = 0; column < 3; ++column)
                rows[4 * row + column] = float(instance.rotation[row][column]);
            rows[4 * row + 3] = float(instance.translation[int(row)]);
        }
        rtcSetGeometryTransform(copy, 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, rows);
        rtcCommitGeometry(copy);
        rtcAttachGeometryByID(scene_, copy, unsigned(i));
        rtcReleaseGeometry(copy);
    }
    check();
    rtcCommitScene(scene_);
    check();
    trimHeap(); // what it was built with
}

RTCScene RayScene::sceneOf(const std::function<void(RTCScene)>& attach)
{
    const RTCScene scene = rtcNewScene(device_);
    // No ray slips through between triangles.
    rtcSetSceneFlags(scene, RTCSceneFlags(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_COMPACT));
    attach(scene);
    check();
    rtcCommitScene(scene);
    check();
    return scene;
}

RTCScene RayScene::sceneOf(const std::vector<openvdb::Vec3f>& positions, const Triangles& triangles,
                           std::size_t first, std::size_t end)
{
    return sceneOf([&](RTCScene scene) { addTriangles(positions, triangles, first, end, scene); });
}

void RayScene::addTriangles(const std::vector<openvdb::Vec3f>& positions,
                            const Triangles& triangles, std::size_t first, std::size_t end,
                            RTCScene scene)
{
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    // Embree reads 16 bytes at the last vertex too, so it gets buffers of its own.
    void* own = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                        sizeof(openvdb::Vec3f), positions.size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               triangles.data(), first * sizeof(triangles[0]), sizeof(triangles[0]),
                               end - first);
    if (own) {
        std::memcpy(own, positions.data(), positions.size() * sizeof(openvdb::Vec3f));
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(scene, geometry, RayUnit::Triangles);
    }
    rtcReleaseGeometry(geometry);
}

void RayScene::addBalls(const RayUnit& unit, RTCScene scene)
{
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4,
                               unit.balls.data(), 0, sizeof(unit.balls[0]), unit.balls.size());
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, RayUnit::Balls);
    rtcReleaseGeometry(geometry);
}

/// Each stick is a curve of one straight piece.
void RayScene::addSticks(const RayUnit& unit, RTCScene scene)
{
    const std::size_t count = unit.sticks.size();
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_CONE_LINEAR_CURVE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4,
                               unit.sticks.data(), 0, sizeof(openvdb::Vec4f), 2 * count);
    void* starts = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT,
                                           sizeof(std::uint32_t), count);
    void* joints = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_FLAGS, 0, RTC_FORMAT_UCHAR,
                                           sizeof(std::uint8_t), count);
    if (starts && joints) {
        for (std::uint32_t i = 0; i < count; ++i) static_cast<std::uint32_t*>(starts)[i] = 2 * i;
        std::memset(joints, 0, count); // no piece goes on in another
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(scene, geometry, RayUnit::Sticks);
    }
    rtcReleaseGeometry(geometry);
}

RayScene::~RayScene()
{
    if (scene_) rtcReleaseScene(scene_);
    for (const RTCScene part : parts_) rtcReleaseScene(part);
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
