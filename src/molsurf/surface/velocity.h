// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// How the atoms of frames move, on voxels and at vertices.

#include "molsurf/atoms.h"
#include "molsurf/options.h"
#include "molsurf/progress.h"
#include "molsurf/surface.h"

#include <openvdb/openvdb.h>

#include <string>
#include <vector>

namespace molsurf
{

/// The unit of velocities.
struct VelocityUnit {
    double factor = 1.0; ///< that an Å per frame is
    std::string name = "Å per frame";
};

/// How far from the surface and its fog the grid `v` reaches at most [Å]: an atom that leaves a
/// periodic box on one side comes back on the other, and its way is as long as the box.
constexpr double farthestVelocity = 30.0;

/// The grid `v`: at each active voxel the way of the ball that it belongs to, as in labelSurface();
/// 0 elsewhere. Active are the voxels of the band, with `density` those of the fog, and all within
/// the way of its own ball from one of these (which belong to the nearest ball, far from all to the
/// nearest of those that move so far): renderers look up the velocity where a ray is, and
/// not where the voxel came from. Vectors that are relative and turn with the grid
/// (openvdb::VEC_CONTRAVARIANT_RELATIVE), with the metadata `unit`.
///
/// @param[in] displacement  one a ball [Å per frame]
openvdb::Vec3SGrid::Ptr velocityGrid(const openvdb::FloatGrid& surface, const BallSet& atoms,
                                     const std::vector<openvdb::Vec3f>& displacement,
                                     const VelocityUnit& unit, const SurfaceOptions& options,
                                     const Progress& progress);

/// Adds the scalars v_x, v_y and v_z to a mesh: the way of the ball that each vertex belongs to.
/// @param[in] displacement  one a ball [Å per frame]
/// @param[in] factor        that an Å per frame is
void addVelocity(const BallSet& atoms, const std::vector<openvdb::Vec3f>& displacement,
                 double factor, const SurfaceOptions& options, const Progress& progress,
                 Mesh& mesh);

} // namespace molsurf
