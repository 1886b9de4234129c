// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The distance of any point from a surface, near or far: to triangles, or to the zero set of a
/// spline that triangles sample. docs/math.md, section 11.

#include "molsurf/analysis/proximity/closest_point.h"
#include "molsurf/ball.h"
#include "molsurf/kernel/mesh/topology.h"
#include "molsurf/kernel/spline/spline.h"
#include "molsurf/mesh.h"
#include "molsurf/progress.h"

#include <optional>

namespace molsurf
{

/// A surface that distances are measured to or from.
struct Surface {
    Mesh mesh;                    ///< in the world [Å]; the surface itself if there is no spline
    bool closed = false;          ///< has an inside; see hasInside()
    std::optional<Spline> spline; ///< its zero set is the surface, the mesh a sample of it
    Motion pose = Motion::identity(); ///< of the spline's frame into the world
};

/// Whether a mesh bounds a volume: every edge is used as often in one direction as in the other.
/// Unlike Topology::closed that holds, too, where pieces touch along an edge.
bool hasInside(const Mesh& mesh, const VertexTriangles& around, const Progress& progress);

/// The distance of a point from a surface.
struct Distance {
    double value = 0.0;          ///< Euclidean, to the closest point [Å]
    bool inside = false;         ///< the point is inside; false for a surface that is not closed
    openvdb::Vec3d closest{0.0}; ///< the closest point [Å]
    openvdb::Vec3d normal{0.0};  ///< there, unit, outward
};

/// Finds distances of points from one surface.
///
/// The closest point of the triangles is exact. On a spline it is then moved by Newton's method to
/// the closest point of {S = 0}: with the normal n and the shape operator A there, s = n.(x - y)
/// and t = x - y - s n, one step adds -S/|grad S| n and the solution d of (I + s A) d = t (Chopp,
/// Some improvements of the fast marching method, SIAM J. Sci. Comput. 23(1):230-244, 2001). Where
/// two sheets are equally near up to the error of the triangles, either may be taken.
///
/// The normal of a spline tells on which side a point lies. On a mesh it is the mean of the normals
/// about the closest point, weighted by angle (Baerentzen and Aanaes, Signed distance
/// computation using the angle weighted pseudonormal, IEEE Trans. Visualization and Computer
/// Graphics 11(3):243-253, 2005).
class DistanceTo
{
public:
    /// @param[in] surface  with at least one triangle; must outlive this object
    explicit DistanceTo(const Surface& surface);

    /// Answers one thread.
    class Query
    {
    public:
        explicit Query(const DistanceTo& to);
        Distance at(const openvdb::Vec3d& x);

    private:
        const DistanceTo& to_;
        std::optional<SplineSampler> sampler_;
    };

    const Surface& surface() const { return surface_; }

private:
    /// Normal of the mesh at one of its points, of any length.
    openvdb::Vec3d pseudonormal(const MeshPoint& point) const;

    const Surface& surface_;
    ClosestPoint closest_;
    VertexTriangles around_;
};

} // namespace molsurf
