// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A mesh judged by CGAL, which shares no code with the library.

#include "molsurf/mesh.h"

#include <iosfwd>
#include <string>

namespace molsurf::test
{

struct MeshVerdict {
    bool polygonMesh = false;          ///< the triangles form a 2-manifold, consistently oriented
    bool valid = false;                ///< and CGAL's data structure of it is sound
    bool closed = false;               ///< without border
    bool outward = false;              ///< it bounds a volume, normals outward, cavities nested
    std::size_t degenerate = 0;        ///< triangles whose corners are on a line, exactly
    std::size_t selfIntersections = 0; ///< pairs of triangles that meet where they should not
    long euler = 0;
    double volume = 0.0; ///< of the flat triangles [Å^3]

    bool good() const
    {
        return polygonMesh && valid && closed && outward && degenerate == 0 &&
               selfIntersections == 0;
    }
};

/// @param[in] intersections  whether to look for self-intersections, which takes some seconds for a
///                           large mesh
MeshVerdict judge(const Mesh& mesh, bool intersections = true);

/// Positions and triangles of a .ply file, by CGAL's reader.
Mesh readPly(const std::string& path);

std::ostream& operator<<(std::ostream& out, const MeshVerdict& verdict);

} // namespace molsurf::test
