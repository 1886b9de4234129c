// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Where points lie to a surface.

#include "molsurf/progress.h"
#include "molsurf/surface.h"

#include <openvdb/Types.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace molsurf
{

/// Where a point lies to a surface.
struct PointDistance {
    double distance = 0.0;       ///< from the surface, negative inside [Å]
    openvdb::Vec3d closest{0.0}; ///< the point of the surface that is nearest [Å]
    openvdb::Vec3d normal{0.0};  ///< of the surface there, unit, outward
    std::int32_t ball = -1;      ///< the ball whose own surface |x - x_i| = r_i is nearest to the
                                 ///< point; of equals the first
};

/// Finds where points lie to a surface, near or far.
///
/// Solvent-accessible and van der Waals surfaces are those of the balls themselves, exact to 1e-5
/// Å. Of other surfaces, and of those that parts, filled cavities or thickened walls changed, it is
/// the zero set of the spline where that reaches, and the mesh elsewhere; an open mesh has no
/// inside. The spline is that of the mesh if the fields have it, and else one through the level
/// set, some thousandths of an Å from it.
///
/// Immutable once made; safe to use from all threads.
class SurfaceDistance
{
public:
    /// @param[in] atoms    that the surface was made of
    /// @param[in] options  that it was made with
    /// @param[in] surface  what makeSurface() gave; it may be changed or go afterwards
    /// @throws Error(ErrorKind::Input) if there are no balls, or neither mesh nor closed form
    /// @throws Cancelled if the progress object says so
    SurfaceDistance(const BallSet& atoms, const SurfaceOptions& options,
                    const MolecularSurface& surface, const Progress& progress = Progress());
    ~SurfaceDistance();
    SurfaceDistance(SurfaceDistance&& other) noexcept;
    SurfaceDistance& operator=(SurfaceDistance&& other) noexcept;

    /// @param[in] points  within 1e6 Å of the origin
    /// @return one a point
    /// @throws Error(ErrorKind::Input) that names the first point at fault, by its index
    /// @throws Cancelled if the progress object says so
    std::vector<PointDistance> at(const std::vector<openvdb::Vec3d>& points,
                                  const Progress& progress = Progress()) const;

private:
    struct Parts;
    std::unique_ptr<const Parts> parts_;
};

} // namespace molsurf
