// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Measures how far two surfaces are from each other. docs/math.md, section 11.

#include "molsurf/mesh.h"
#include "molsurf/progress.h"

#include <openvdb/Types.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace molsurf
{

/// The distances between two surfaces a and b, both ways.
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
