// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// How area and volume change when balls move, in closed form.

#include "molsurf/kernel/balls/boundary_measure.h"
#include "molsurf/kernel/balls/excluded_measure.h"

#include <openvdb/Types.h>

#include <vector>

namespace molsurf
{

/// Derivatives by the centres of the balls, in the order of the caller's balls.
struct BallGradients {
    std::vector<openvdb::Vec3d> volume; ///< dV/dx_i [Å^2]
    std::vector<openvdb::Vec3d> area;   ///< dA/dx_i [Å]
    std::vector<char> besideGap{};      ///< MolecularSurface::Gradients::besideGap
    std::vector<char> besideRidge{};    ///< MolecularSurface::Gradients::besideRidge
};

/// Of the union of balls. The volume changes by the normal integrated over the patches of a ball.
/// The area changes along its arcs alone, a ball being the same wherever it is: with the normals
/// n_i of its sphere and n_j of the other, phi between them, and the direction nu in which the
/// patch ends there, by -(nu + tan(phi/2) n_i) for each length of arc. docs/math.md, section 10.
/// @param[in] count  of the caller's balls
BallGradients unionGradients(const BallBoundary& boundary, const BoundaryMeasure& measure,
                             std::size_t count);

/// Of the solvent-excluded surface. A contact face moves with its ball, a toric one with the probe
/// that rolls along its arc, a concave one with the probe that rests on three balls; where concave
/// faces meet, the edge between them moves along.
/// @param[in] boundary  of the balls grown by the probe
/// @param[in] pulls     ExcludedMeasure::pulls
/// @param[in] probe     [Å]
/// @param[in] count     of the caller's balls
BallGradients excludedGradients(const BallBoundary& boundary, const BoundaryMeasure& measure,
                                const std::vector<ConcavePull>& pulls, double probe,
                                std::size_t count);

} // namespace molsurf
