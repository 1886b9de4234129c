// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Volumes, walls and mouths of the parts of a space.

#include "molsurf/analysis/pockets/basins.h"
#include "molsurf/progress.h"

#include <openvdb/Types.h>

#include <cstdint>
#include <vector>

namespace molsurf
{

/// Measures of a basin.
struct BasinMeasure {
    /// Where it ends by the cut.
    struct Mouth {
        double area = 0.0;   ///< [Å^2]
        double widest = 0.0; ///< the largest clearance of its voxels [Å]
        double radius = 0.0; ///< of the largest ball that gets there from the widest place, by
                             ///< voxels: a little too small [Å]
        openvdb::Vec3d narrowest{0.0};    ///< the voxel where it just passes [Å]
        openvdb::Vec3d widestPlace{0.0};  ///< the voxel beside it with the largest clearance [Å]
        std::vector<VoxelPlace> voxels{}; ///< those beside it
    };
    /// A piece of its wall.
    struct Wall {
        openvdb::Vec3f place; ///< its middle [Å]
        double area;          ///< [Å^2]
    };

    double volume = 0.0;         ///< [Å^3]
    double area = 0.0;           ///< of the wall [Å^2]
    openvdb::Vec3d deepest{0.0}; ///< its deepest voxel [Å]
    openvdb::Vec3d widest{0.0};  ///< the first of its voxels with the largest clearance [Å]
    openvdb::Vec3d moment{0.0};  ///< integral of the place over the volume [Å^4]
    std::vector<Mouth> mouths;   ///< in the order of the voxels
    std::vector<Wall> walls;     ///< one a cell
};

/// Measures each basin. The space in a cell is that of its six tetrahedra where the linear
/// interpolations of both distances are above 0; its faces are walls where the clearance ends and
/// mouths where the depth does. Errors fall with the square of the voxels; what is lost in cells
/// without a corner in the space, with the voxels.
std::vector<BasinMeasure> measureBasins(const VoidField& space, const Basins& basins,
                                        const Progress& progress);

} // namespace molsurf
