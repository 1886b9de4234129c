// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/proximity/closest_point.h"

#include "molsurf/analysis/proximity/ray_scene.h"

#include <openvdb/math/Proximity.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

/// One search: what is asked, and the best answer up to now.
struct Search {
    const Mesh& mesh;
    Vec3d x;
    double margin; ///< [Å]
    double best2 = std::numeric_limits<double>::infinity();
    MeshPoint found{Vec3d(0.0), Vec3d(0.0), std::numeric_limits<std::uint32_t>::max()};

    /// The radius to search for what is within a distance: float arithmetic may be wrong in its
    /// last digits.
    float radius(double distance) const { return float(distance * (1.0 + 1e-6) + margin); }
};

/// Called by Embree for each triangle near the point; returns whether the radius has shrunk.
bool visit(RTCPointQueryFunctionArguments* arguments)
{
    Search& search = *static_cast<Search*>(arguments->userPtr);
    const auto& t = search.mesh.triangles[arguments->primID];
    Vec3d weights;
    const Vec3d y = openvdb::math::closestPointOnTriangleToPoint(
        Vec3d(search.mesh.positions[t[0]]), Vec3d(search.mesh.positions[t[1]]),
        Vec3d(search.mesh.positions[t[2]]), search.x, weights);
    const double d2 = (search.x - y).lengthSqr();
    MeshPoint& found = search.found;
    if (d2 < search.best2 || (d2 == search.best2 && arguments->primID < found.triangle)) {
        search.best2 = d2;
        found.point = y;
        found.weights = weights;
        found.triangle = arguments->primID;
        const float radius = search.radius(std::sqrt(d2));
        if (radius < arguments->query->radius) {
            arguments->query->radius = radius;
            return true;
        }
    }
    return false;
}

} // namespace

ClosestPoint::ClosestPoint(const Mesh& mesh) : mesh_(mesh), scene_(std::make_unique<RayScene>(mesh))
{
    for (const auto& p : mesh.positions)
        for (int i = 0; i < 3; ++i) reach_ = std::max(reach_, double(std::abs(p[i])));
}

ClosestPoint::~ClosestPoint() = default;

MeshPoint ClosestPoint::at(const Vec3d& x) const
{
    const double size = std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2]), reach_});
    // Embree searches in floats, which are off by 1e-7 of the largest coordinate: ten times that.
    Search search{mesh_, x, 1e-6 * size};
    RTCPointQuery query{};
    query.x = float(x[0]);
    query.y = float(x[1]);
    query.z = float(x[2]);
    query.radius = std::numeric_limits<float>::infinity();
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(scene_->get(), &query, &context, visit, &search);
    return search.found;
}

} // namespace molsurf
