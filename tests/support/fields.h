// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Closed-form level sets in general position, and leaf fields filled from them.

#include "molsurf/kernel/grid/leaf_table.h"
#include "molsurf/kernel/spline/spline.h"

#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

namespace molsurf::test
{

using Function = std::function<double(const openvdb::Vec3d&)>;

/// A rigid motion that no grid knows: x -> centre + Q x.
struct Pose {
    openvdb::Vec3d centre = openvdb::Vec3d(0.137, -0.291, 0.443);
    openvdb::Mat3d turn;

    Pose();
    openvdb::Vec3d toWorld(const openvdb::Vec3d& x) const { return centre + turn * x; }
    openvdb::Vec3d toLocal(const openvdb::Vec3d& x) const
    {
        return turn.transpose() * (x - centre);
    }
};

/// A point of a surface with its outward normal and principal curvatures.
struct SurfacePoint {
    openvdb::Vec3d x, n;
    double mean;  ///< (k1 + k2)/2 [1/Å]
    double gauss; ///< k1 k2 [1/Å^2]
    /// Unit, tangential, along which the surface has k1, the larger; zero at an umbilic.
    openvdb::Vec3d direction1 = openvdb::Vec3d(0.0);

    double k1() const { return mean + std::sqrt(std::max(mean * mean - gauss, 0.0)); }
    double k2() const { return mean - std::sqrt(std::max(mean * mean - gauss, 0.0)); }
};

/// A closed surface whose signed distance, curvatures, area and volume are known.
struct Shape {
    Function distance; ///< exact, < 0 inside [Å]
    std::vector<SurfacePoint> points;
    double area, volume;
    double extent;         ///< it lies within this of its centre [Å]
    openvdb::Vec3d centre; ///< [Å]
    Function smooth = {};  ///< a smooth function that is no distance, with the same zero set
};

Shape sphere(double radius, const Pose& pose = Pose(), int count = 400);
Shape torus(double ring, double tube, const Pose& pose = Pose(), int count = 400);
Shape ellipsoid(const openvdb::Vec3d& axes, const Pose& pose = Pose(), int count = 400);

/// The solvent-excluded surface of two balls of radius 1.7 Å that are 4 Å apart, for a probe of
/// 1.4 Å: the exact distance, and points of the saddle between them, 0.75 Å or more from its
/// borders. There k1 > 0 runs about the axis and k2 = -1/1.4 along the meridian. Area and volume
/// are not given.
Shape saddleOfTwoBalls(const Pose& pose = Pose(), int count = 400);

/// Signed distance to the union of two balls, also inside, where the nearest point may lie on the
/// circle that the spheres share.
double distanceToTwoBalls(const openvdb::Vec3d& x, const openvdb::Vec3d& a, double R,
                          const openvdb::Vec3d& b, double S);

/// All leaves about a point in which |f| < width somewhere; those voxels are active. f should be
/// about a distance.
LeafTable bandTable(const Function& f, const openvdb::Vec3d& centre, double extent, double voxel,
                    double width);

/// The same for below < f < above.
LeafTable bandTable(const Function& f, const openvdb::Vec3d& centre, double extent, double voxel,
                    double below, double above);

/// f at all voxels of all leaves.
SparseField filled(const LeafTable& table, double voxelSize, const Function& f);

/// Calls f(n, v, x) for every active voxel: leaf, voxel of the leaf, position [Å].
template<typename F>
void forEachActive(const LeafTable& table, double voxel, const F& f)
{
    for (std::size_t n = 0; n < table.size(); ++n) {
        table.active(n).forEach([&](int v) {
            const openvdb::Coord c = table.origin(n).offsetBy(v >> 6, v >> 3 & 7, v & 7);
            f(n, v, c.asVec3d() * voxel);
        });
    }
}

/// The interpolating spline of f in a band of the given half width about f = 0 of a shape.
Spline splineOf(const Function& f, const Function& distance, const openvdb::Vec3d& centre,
                double extent, double voxel, double width);

/// Where a spline vanishes on the ray from a point: centre + t direction, t in [low, high], by
/// bisection; NaN if it has the same sign at both ends.
double zeroOnRay(const Spline& spline, const openvdb::Vec3d& centre,
                 const openvdb::Vec3d& direction, double low, double high);

} // namespace molsurf::test
