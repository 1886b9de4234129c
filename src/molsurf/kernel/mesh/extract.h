// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The triangle mesh of a surface given by its spline.

#include "molsurf/kernel/spline/spline.h"
#include "molsurf/mesh.h"
#include "molsurf/progress.h"

#include <openvdb/openvdb.h>

#include <string>
#include <vector>

namespace molsurf
{

/// Numbers that extractMesh() leaves besides the mesh.
struct ExtractStats {
    double maxResidual = 0.0;          ///< largest |S| at a vertex [Å]
    std::vector<float> slopes;         ///< |grad S| at each vertex
    bool keepCells = false;            ///< whether the next two are wanted
    std::vector<openvdb::Coord> cells; ///< cell of the mesher that each vertex comes from
    std::vector<float> residuals;      ///< |S| at each vertex [Å]
};

/// Meshes {S = 0}.
///
/// OpenVDB's dual mesher gives the connectivity from the signs of the level set at the voxels; each
/// vertex is then moved along the gradient onto S = 0 by Newton's method, or, where the gradient
/// fails, by bisection between two corners of its cell that lie on opposite sides. Quads are split
/// so that the two triangles agree best with the normals of the spline. Vertices with folded or
/// needle-like triangles slide along the surface to the centroid of their neighbours.
///
/// @param[in] surface  level set whose signs are those of the spline at the voxels
/// @param[in] spline   S
/// @return a closed mesh, oriented outward, 2-manifold unless the mesher failed, with normals and
///         the scalars mean_curvature and gaussian_curvature; empty if the level set has no zero
Mesh extractMesh(const openvdb::FloatGrid& surface, const Spline& spline, const Progress& progress,
                 ExtractStats& stats);

/// Adds curvatures of the spline at the vertices to Mesh::scalars; a direction becomes three, with
/// _x, _y and _z at the end of their names.
/// @param[in] names  of curvatureFields(); others, and those that the mesh already has, are skipped
void addCurvature(const Spline& spline, const std::vector<std::string>& names, Mesh& mesh,
                  const Progress& progress);

} // namespace molsurf
