// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Level set grids and meshes of closed-form functions.

#include "molsurf/kernel/mesh/extract.h"
#include "support/fields.h"

#include <openvdb/tools/LevelSetSphere.h>

namespace molsurf::test
{

/// The mesh of f = 0, made as the pipeline makes it, from exact samples in a band of six voxels.
/// @param[in] f  about a distance near its zero set
inline Mesh meshOf(const Function& f, const openvdb::Vec3d& centre, double extent, double voxel,
                   ExtractStats& stats)
{
    const Spline spline = splineOf(f, f, centre, extent, voxel, 6.0 * voxel);
    const LeafTable band = bandTable(f, centre, extent, voxel, 3.0 * voxel);
    const auto grid = toLevelSet(filled(band, voxel, f), 3.0 * voxel, Progress());
    return extractMesh(*grid, spline, Progress(), stats);
}

inline Mesh meshOf(const Shape& shape, double voxel)
{
    ExtractStats stats;
    return meshOf(shape.distance, shape.centre, shape.extent, voxel, stats);
}

/// A grid `surface` of a ball of radius 5 about (0.3, 1.2, -0.7), voxels of 0.4.
inline openvdb::FloatGrid::Ptr ballGrid()
{
    openvdb::initialize();
    auto grid = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(
        5.0f, openvdb::Vec3f(0.3f, 1.2f, -0.7f), 0.4f);
    grid->setName("surface");
    return grid;
}

} // namespace molsurf::test
