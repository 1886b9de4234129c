// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Measures how far one surface is from another. docs/math.md, section 11.

#include "molsurf/analysis/proximity/distance.h"
#include "molsurf/mesh.h"
#include "molsurf/progress.h"

#include <openvdb/openvdb.h>

#include <optional>
#include <vector>

namespace molsurf
{

/// Area and volume; of the smooth surface if there is a spline, else of the triangles.
struct Size {
    double area = 0.0;            ///< [Å^2]
    std::optional<double> volume; ///< [Å^3]; none if the surface is not closed
};

/// Edges longer than this are sampled between their ends too [Å]; doubled until the parts of large
/// triangles are a million at most.
constexpr double sampleSpacing = 1.0;

/// Measures the distance of every vertex of a surface from another one.
///
/// The mean of f is the sum of A_v f_v over the sum of A_v, with A_v a third of the area of the
/// triangles at a vertex: exact for f linear on the triangles. If the triangles are the surface,
/// one with an edge longer than sampleSpacing counts by its n^2 parts instead, at their centroids,
/// with n edges along each side; the maximum is then over their corners, too.
///
/// @param[in] from  with at least one triangle
Comparison::OneWay distancesFrom(const Surface& from, const DistanceTo& to,
                                 const Progress& progress);

/// The distance from a surface at every active voxel of a grid.
/// @param[in] on  a level set; the results have its active voxels and its transform
/// @return the grid `distance` [Å] and, if the surface is closed, `signed_distance`, < 0 inside it;
///         0 elsewhere
std::vector<openvdb::FloatGrid::Ptr> distanceGrids(const openvdb::FloatGrid& on,
                                                   const DistanceTo& to, const Progress& progress);

/// Area of the triangles, and the volume inside them if they bound one.
Size sizeOfTriangles(const Mesh& mesh, bool closed, const Progress& progress);

/// Normals at the vertices: the mean of the triangles', weighted by area.
std::vector<openvdb::Vec3f> vertexNormals(const Mesh& mesh);

} // namespace molsurf
