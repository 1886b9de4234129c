// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The solvent-excluded surface as MSMS gives it: by components, with the kind of face and the
/// sphere of every vertex.

#include "molsurf/ball.h"
#include "molsurf/mesh.h"
#include "molsurf/options.h"
#include "molsurf/progress.h"

#include <cstdint>
#include <vector>

namespace molsurf::msms
{

/// The kinds of faces, by MSMS's numbers.
enum class FaceKind : std::uint8_t { Toric = 1, Spherical = 2, Contact = 3 };

/// A face of the analytical surface that a vertex or triangle lies on.
struct Face {
    FaceKind kind;
    std::uint32_t number; ///< from 1: patches of spheres, then arcs, then corners
};

/// Areas of a component in closed form [Å^2].
struct Areas {
    double contact = 0.0, toric = 0.0, spherical = 0.0;
    double accessible = 0.0; ///< of the solvent-accessible surface

    double excluded() const { return contact + toric + spherical; }
};

/// A part of the solvent-excluded surface that hangs together, or that probes touch which can reach
/// each other. The mesh of an outer one also has the walls of voids that no probe from outside gets
/// into, but that overlap with such a probe; the areas are without them.
struct Component {
    Mesh mesh;                       ///< vertices exactly on the surface, with its normals
    std::vector<Face> vertexFaces;   ///< one a vertex
    std::vector<Face> triangleFaces; ///< one a triangle, by its centre
    std::vector<std::int32_t> balls; ///< the ball nearest to each vertex
    Areas areas;
    double meshArea = 0.0; ///< [Å^2]
    double volume = 0.0;   ///< inside the mesh; negative: that of a cavity [Å^3]
};

/// Components with what each ball has of all of them.
struct MsmsSurface {
    std::vector<Component> components;
    std::vector<Areas> joined;        ///< of the voids whose walls meshes of outer components have
    std::vector<double> excludedOf;   ///< solvent-excluded area of each ball [Å^2]
    std::vector<double> accessibleOf; ///< solvent-accessible area of each ball [Å^2]
};

/// How the mesh is made that gives the topology.
SurfaceOptions meshOptions(const std::vector<Ball>& balls, double probe, double density);

/// Makes the components: the outer one of the largest area first, then the others, those of larger
/// area first.
///
/// A mesh on voxels fine enough gives the topology. Its vertices are put on the surface exactly,
/// by the nearest point of the boundary of the union of balls of radius r_i + probe, which also
/// gives their faces (but where faces meet in a crease that the voxels do not resolve). It also
/// gives the probes that have a component in common. Areas are those in closed form, as of
/// measureExcluded(), and volumes those of this mesh with curved triangles. Then vertices are taken
/// away until the density is the one that is wanted.
///
/// @param[in] probe    [Å], >= 0
/// @param[in] density  vertices an Å^2, in [leastDensity, largestDensity]
/// @param[in] all      whether all components are wanted, and not only the first
/// @throws Error as makeSurface()
MsmsSurface msmsSurface(const std::vector<Ball>& balls, double probe, double density, bool all,
                        Progress& progress);

} // namespace molsurf::msms
