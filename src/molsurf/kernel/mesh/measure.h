// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Area, volume and topology of the smooth surface behind a mesh.

#include "molsurf/mesh.h"
#include "molsurf/progress.h"
#include "molsurf/report.h"

#include <cstdint>
#include <vector>

namespace molsurf
{

/// Of a connected piece of a surface.
struct PieceMeasure {
    double area = 0.0;   ///< [Å^2]
    double volume = 0.0; ///< integral of (x - origin).n/3 [Å^3]

    PieceMeasure& operator+=(const PieceMeasure& other)
    {
        area += other.area;
        volume += other.volume;
        return *this;
    }
};

/// Sums over the triangles themselves.
struct TriangleSums {
    double area = 0.0;    ///< [Å^2]
    std::size_t flat = 0; ///< triangles without area

    TriangleSums& operator+=(const TriangleSums& other)
    {
        area += other.area;
        flat += other.flat;
        return *this;
    }
};

/// Area and volume of the pieces of a mesh, which need not be closed, as measure() takes them.
/// @param[in]  pieces  of the vertices, less than count
/// @param[in]  origin  of the volumes [Å]
/// @param[out] sums    raised by those of the triangles
std::vector<PieceMeasure> measurePieces(const Mesh& mesh, const std::vector<std::uint32_t>& pieces,
                                        std::size_t count, const openvdb::Vec3d& origin,
                                        TriangleSums& sums, const Progress& progress);

/// The connected pieces of a mesh, which need not be closed.
struct MeshPieces {
    std::vector<std::uint32_t> of;      ///< the piece of each vertex
    std::vector<PieceMeasure> measures; ///< of each piece
    TriangleSums triangles;             ///< of the whole mesh
};

/// Finds and measures the pieces.
/// @param[in] mesh    with normals
/// @param[in] origin  of the volumes [Å]; the first vertex, if none is given, so that they do not
/// cancel far from the origin
MeshPieces piecesOf(const Mesh& mesh, const Progress& progress);
MeshPieces piecesOf(const Mesh& mesh, const openvdb::Vec3d& origin, const Progress& progress);

/// Adds closed pieces to areas and volumes: components, and cavities, whose volume is negative.
void countPieces(const std::vector<PieceMeasure>& pieces, SurfaceReport& report);

/// Adds a piece to area, volume, components and cavities of a report.
/// @param[in] volume  [Å^3]; below 0 of a cavity's wall
void addPiece(double area, double volume, bool cavity, SurfaceReport& report);

/// Forgets Euler number and pieces, those of a mesh that may bridge what is narrower than a voxel.
void dropTopology(SurfaceReport& report);

/// Puts the cavities of a report in order, the largest first.
void sortCavities(SurfaceReport& report);

/// Numbers of vertices near kinks of the distance, and of those of the others that have a unit
/// gradient.
struct GradientCounts {
    std::size_t kink = 0, unit = 0;
    GradientCounts& operator+=(const GradientCounts& o)
    {
        kink += o.kink;
        unit += o.unit;
        return *this;
    }
};

/// Fills in the shares of vertices near kinks, and of those of the others that have a unit
/// gradient.
/// @param[in] vertices  how many there are
void describeGradients(const GradientCounts& counts, std::size_t vertices, SurfaceReport& report);

/// Measures the smooth surface that a mesh samples, and checks the mesh.
///
/// Each triangle is replaced by the quadratic patch through its corners and through the midpoints
/// of the arcs that its normals imply: for an edge e from p with normal m to q with normal n the
/// midpoint is (p + q)/2 + ((e.n) n - (e.m) m)/8 (the cubic Hermite arc, as in Vlachos et al.,
/// Curved PN triangles, Symposium on Interactive 3D Graphics 2001). Area by a rule of degree 4,
/// volume exactly, by the divergence theorem: fourth order in the length of the edges if vertices
/// and normals are exact.
///
/// A closed piece with negative volume is a cavity wall.
///
/// @param[in] mesh  with normals
/// @return everything but maxResidual, gradientShare, kinkShare
SurfaceReport measure(const Mesh& mesh, const Progress& progress);

/// The same with pieces that are known already.
SurfaceReport measure(const Mesh& mesh, const MeshPieces& pieces, const Progress& progress);

} // namespace molsurf
