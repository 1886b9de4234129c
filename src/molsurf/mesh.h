// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A triangle mesh with named attributes at its vertices, and how far two of them are from each
/// other.

#include "molsurf/progress.h"

#include <openvdb/Types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace molsurf
{

/// A quantity that has a value at every vertex.
template<typename T>
struct Attribute {
    std::string name;                    ///< name in mesh files, for example "mean_curvature"
    std::vector<T> values;               ///< one for each vertex of the mesh
    std::vector<std::string> names = {}; ///< of what labels number, if the mesh alone knows them
};

/// A named part of a mesh: the triangles from its first one to that of the next part.
struct MeshPart {
    std::string name;
    std::size_t firstTriangle = 0; ///< index into Mesh::triangles
};

/// A mesh of triangles. Their corners run counter-clockwise if seen from outside the molecule.
struct Mesh {
    std::vector<openvdb::Vec3f> positions;               ///< of the vertices [Å]
    std::vector<openvdb::Vec3f> normals;                 ///< unit, outward; one a vertex, or none
    std::vector<std::array<std::uint32_t, 3>> triangles; ///< indices into `positions`
    std::vector<Attribute<float>> scalars;       ///< curvatures [1/Å], [1/Å^2], distances [Å]
    std::vector<Attribute<std::int32_t>> labels; ///< atom, chain and group of a vertex
    std::vector<std::array<std::uint8_t, 3>>
        colors;                  ///< red, green, blue (sRGB) of each vertex, or empty
    std::vector<MeshPart> parts; ///< surfaces of their own; empty if there is only one
};

/// The distances between two surfaces a and b, both ways. docs/math.md, section 11.
struct Comparison {
    /// The distances of the points of one surface from another surface. Means are weighted by area.
    struct OneWay {
        std::vector<float> distance; ///< distance of each vertex, >= 0 [Å]
        std::vector<float>
            signedDistance; ///< negative inside the other surface [Å]; empty if that is not closed
        double mean = 0.0;  ///< mean of the distance [Å]
        double rms = 0.0;   ///< root of the mean square [Å]
        double max = 0.0;   ///< one-sided Hausdorff distance [Å]
        openvdb::Vec3d maxAt{0.0};        ///< the point where the distance is largest [Å]
        std::optional<double> meanSigned; ///< mean of the signed distance [Å], if there is one
        std::optional<double> inside; ///< share of the area inside the other surface, in [0, 1],
                                      ///< if that is closed
        std::size_t samples = 0;      ///< number of points at which the distance was taken
    };

    OneWay aToB, bToA;
    double hausdorff = 0.0; ///< Hausdorff distance, the larger of both maxima [Å]
};

/// Measures the distance of every vertex of each of two meshes from the other one.
///
/// @param[in] a,b       meshes with at least one triangle; positions in Å
/// @param[in] progress  follows the run and may end it; null: nobody does
/// @throws Error(ErrorKind::Input) if a mesh has no triangles
/// @throws Cancelled if the progress object says so
Comparison compare(const Mesh& a, const Mesh& b, Progress* progress = nullptr);

} // namespace molsurf
