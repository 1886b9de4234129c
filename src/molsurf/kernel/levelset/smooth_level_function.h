// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A function that carries an interface and is smoother than the distance to it.

#include "molsurf/kernel/grid/sparse_field.h"
#include "molsurf/kernel/levelset/slope_field.h"
#include "molsurf/progress.h"

namespace molsurf
{

/// The function psi of a sum of Gaussians, and how steep it is.
struct CarrierSource {
    const LeafField& psi; ///< on the leaves of phi
    const SlopeField& slope;
    bool onPsiZero; ///< whether the interface is psi = 0 itself: v is 0 then
    double lambda;  ///< weight of the regulariser |grad g|^2, whose valley lies off psi = 0; else 0
};

/// Computes G = (v - psi)/slope with v the values of psi on the interface phi = 0, extended along
/// with one light smoothing. v is nearly constant, so G is as smooth as psi.
///
/// A distance has ridges within a voxel or two outside creases of its interface, and no spline on
/// the grid can hold them; closest points that are found on such a spline scatter, and so do the
/// curvatures of the offset surface. psi has no ridges.
///
/// @param[in] phi    signed distance to the interface [Å]
/// @param[in] width  the result lies within two of it about 0 [Å]
/// @return a field on the leaves of phi: < 0 inside, with a slope of 1 where the interface is flat
///         and of 0.2 to 1 in creases
SparseField smoothCarrier(const SparseField& phi, const CarrierSource& source, double width,
                          const Progress& progress);

} // namespace molsurf
