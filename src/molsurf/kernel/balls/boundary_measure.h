// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Area, volume and topology of a union of balls in closed form.

#include "molsurf/kernel/balls/ball_boundary.h"
#include "molsurf/progress.h"

#include <array>
#include <cstdint>
#include <vector>

namespace molsurf
{

/// One connected piece of the boundary of a union of balls.
struct BoundaryPiece {
    double area = 0.0;           ///< [Å^2]
    double volume = 0.0;         ///< enclosed; negative: that of a cavity [Å^3]
    int eulerCharacteristic = 0; ///< 2 - 2 genus
    bool outer = true;           ///< the wall of no cavity: one a part that hangs together
    std::int32_t component = -1; ///< Patch::component
};

/// A connected part of a patch.
struct BoundaryFace {
    std::uint32_t patch;
    std::int32_t piece;    ///< index; -1: of a cavity that is left out
    double area;           ///< [Å^2]
    openvdb::Vec3d normal; ///< integrated over it [Å^2]
    int characteristic;    ///< its Euler number: 2 - loops
};

/// Cavities with less area are left out [Å^2]: they are no larger than what moves of 1e-9 Å and
/// rounding can make where balls just touch.
constexpr double leastCavity = 1e-8;

/// The pieces, and the share of every ball.
struct BoundaryMeasure {
    std::vector<BoundaryPiece> pieces;   ///< in the order of their first ball
    std::vector<double> patchAreas;      ///< one a patch [Å^2]
    std::vector<BoundaryFace> faces;     ///< of all patches, in their order
    std::vector<std::int32_t> arcPieces; ///< of each arc the piece that it lies on, or -1
    /// Of each arc the faces on the spheres of its two balls, indices of `faces`.
    std::vector<std::array<std::uint32_t, 2>> arcFaces;
};

/// Measures the boundary of a union of balls, without a grid.
///
/// A face, a connected part of a patch, is bounded by loops of arcs. With half angles theta of the
/// caps, angles phi of the arcs and exterior angles epsilon of the corners the theorem of Gauss and
/// Bonnet gives its area R^2 (2 pi (2 - loops) + sum phi cos theta - sum epsilon) (Connolly,
/// Analytical molecular surface calculation, J. Appl. Cryst. 16:548-558, 1983). The volume is the
/// flux of x/3 through the faces, their integrated normals being integrals over the loops. Loops of
/// a sphere bound the same face if they lie on the same side of every connected cluster of caps.
///
/// @return exact but for rounding and the moves of placedBalls()
/// @throws Error(ErrorKind::Check) if the parts of the boundary do not fit together
BoundaryMeasure measureBoundary(const BallBoundary& boundary, const Progress& progress);

/// The piece that each corner lies on, or -1.
std::vector<std::int32_t> cornerPieces(const BallBoundary& boundary,
                                       const BoundaryMeasure& measure);

/// The area of every ball's patches [Å^2], in the order of the caller's balls.
/// @param[in] count  of those balls
std::vector<double> areasOfBalls(const BallBoundary& boundary, const BoundaryMeasure& measure,
                                 std::size_t count);

} // namespace molsurf
