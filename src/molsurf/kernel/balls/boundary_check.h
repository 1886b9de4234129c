// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Checks the measures of a boundary by other ways to the same numbers.

#include "molsurf/kernel/balls/ball_boundary.h"
#include "molsurf/kernel/balls/boundary_measure.h"
#include "molsurf/progress.h"

namespace molsurf
{

/// Checks the measures of a boundary:
/// - the area of every patch against the share of directions that no cap covers,
/// - the volume against the lengths of parallel lines within the boundary, whose ends are free by
///   the caps alone,
/// - the outer pieces against the parts of the union that hang together,
/// - the Euler number of every piece, by corners, arcs and faces: even and at most 2.
///
/// @throws Error(ErrorKind::Check) with both numbers if they disagree by more than sampling allows
void checkBoundary(const BallBoundary& boundary, const BoundaryMeasure& measure,
                   const Progress& progress);

/// Measures a boundary, and checks the measures as above.
BoundaryMeasure checkedMeasure(const BallBoundary& boundary, const Progress& progress);

/// Largest errors of a mesh: of its area [Å^2] and its volume [Å^3].
struct MeshTolerance {
    double area, volume;
};

/// The area and volume that a mesh by voxels of edge h may lose at creases, in clefts between balls
/// that hardly touch, and by cutting corners. A crease of length L takes up to h L of area and 0.4
/// h^2 L of volume; a patch of area A on a ball of radius r, with a cleft on each of six sides, 1.5
/// h A/r and 0.4 h^2 A/r. The measured losses are a third of these and less.
MeshTolerance meshTolerance(const BallBoundary& boundary, const BoundaryMeasure& measure,
                            double voxel);

/// Checks area and volume of a mesh against those in closed form.
/// @throws Error(ErrorKind::Check) with both numbers if they are farther apart than the tolerance
void checkMesh(double exactArea, double exactVolume, double meshArea, double meshVolume,
               const MeshTolerance& tolerance);

} // namespace molsurf
