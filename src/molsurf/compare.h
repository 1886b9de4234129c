// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// How far two surfaces are from each other.

#include "molsurf/mesh.h"
#include "molsurf/progress.h"

#include <openvdb/Types.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace molsurf
{

/// The distances of one surface's points from another surface. Means are weighted by area.
struct OneWay {
    std::vector<float> distance; ///< of each vertex, >= 0 [Å]
    std::vector<float>
        signedDistance;        ///< < 0 inside the other one [Å]; empty if that is not closed
    double mean = 0.0;         ///< of the distance [Å]
    double rms = 0.0;          ///< root of the mean square [Å]
    double max = 0.0;          ///< one-sided Hausdorff distance [Å]
    openvdb::Vec3d maxAt{0.0}; ///< where that is [Å]
    std::optional<double> meanSigned; ///< mean of the signed distance [Å]
    std::optional<double> inside;     ///< share of the area that is inside the other surface
    std::size_t samples = 0;          ///< points at which the distance was taken
};

/// Both ways of a comparison.
struct Comparison {
    OneWay aToB, bToA;
    double hausdorff = 0.0; ///< the larger maximum [Å]
};

/// The distances between two meshes, vertex by vertex, both ways.
///
/// @param[in] a,b       with at least one triangle each; positions [Å]
/// @param[in] progress  null, or what is told of the progress and may end the run
/// @throws Error(ErrorKind::Input) if a mesh has no triangles
/// @throws Cancelled if the progress object says so
Comparison compare(const Mesh& a, const Mesh& b, Progress* progress = nullptr);

} // namespace molsurf
