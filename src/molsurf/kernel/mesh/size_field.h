// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// How long the edges of a mesh shall be at a place, by the curvature of the surface about it.

#include "molsurf/mesh.h"
#include "molsurf/progress.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace molsurf
{

/// How large the triangles shall be.
struct EdgeTarget {
    double edge = 0.0;  ///< length of their edges [Å], > 0; the longest one where `error` is given
    double error = 0.0; ///< how far a triangle may lie from the surface [Å]; 0: it does not matter
    double least = 0.0; ///< what `error` does not make edges shorter than [Å]
};

/// Lengths of edges by the curvature that a fine mesh has at its vertices: what moves away from a
/// peak still knows of it. Memory goes with the part of the surface where they are short.
class SizeField
{
public:
    /// @param[in] mesh  fine, its first two scalars are the mean and the Gaussian curvature
    SizeField(const Mesh& mesh, const EdgeTarget& target, const Progress& progress);

    /// The length that a curvature of the surface asks for [Å].
    float of(float mean, float gaussian) const;

    /// The least length that is asked for within a cell of x or beside it [Å].
    float at(const openvdb::Vec3f& x) const;

    /// The larger of the two principal curvatures, without its sign [1/Å].
    static float bend(float mean, float gaussian);

private:
    std::uint64_t cellOf(const openvdb::Vec3f& x) const;

    const EdgeTarget target_;
    const double cell_;                                  // [Å]
    std::vector<std::pair<std::uint64_t, float>> sizes_; // by cells, ascending
};

} // namespace molsurf
