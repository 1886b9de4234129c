// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Measures in closed form of a surface of a union of balls, on the union or inside of it.

#include "molsurf/kernel.h"
#include "molsurf/kernel/balls/boundary_check.h"
#include "molsurf/kernel/balls/boundary_measure.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace molsurf
{

/// Measures of a surface that isClosedForm().
struct ClosedForm {
    std::vector<BoundaryPiece> pieces;
    bool topologyKnown = true;        ///< ExcludedMeasure::topologyKnown
    std::vector<double> ballAreas;    ///< in the order of the caller's balls [Å^2], if asked for
    std::optional<double> cuspLength; ///< SurfaceReport::cuspLength
    MeshTolerance tolerance;          ///< of a mesh
};

/// Tells whether a run of a whole molecule measures its surface in closed form.
bool isMeasured(const SurfaceSpec& spec);

/// Measures a surface and checks the measures.
/// @param[in] boundary  of the balls grown by probeOf()
/// @param[in] areasOf   how many balls the caller has, if ClosedForm::ballAreas is to be made; or 0
/// @throws Error(ErrorKind::Check) if two ways to the same number disagree
ClosedForm measureClosedForm(const BallBoundary& boundary, const SurfaceSpec& spec,
                             std::size_t areasOf, const Progress& progress);

/// Finds the boundary of the balls, too, and their areas.
/// @param[in] balls  every one finite
ClosedForm measureClosedForm(const std::vector<Ball>& balls, const SurfaceSpec& spec,
                             const Progress& progress);

/// Tells the length of the arcs that are smaller than a probe [Å]: SurfaceReport::cuspLength.
double cuspLengthOf(const BallBoundary& boundary, double probe);

} // namespace molsurf
