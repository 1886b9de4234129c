// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The interface at rest in closed form, where no front moves (docs/math.md, section 4): it is the
/// level set psi = v, and v at a point follows from psi and its first two derivatives there.

#include "molsurf/kernel/flow/displacement.h"
#include "molsurf/kernel/flow/metric.h"
#include "molsurf/kernel/grid/region.h"
#include "molsurf/kernel/grid/sparse_field.h"
#include "molsurf/kernel/levelset/gaussian_sum.h"
#include "molsurf/kernel/levelset/slope_field.h"
#include "molsurf/progress.h"

namespace molsurf
{

/// Width of the band that psi has to be known in, on each side of psi = 0 [voxel].
int restBandVox(double voxel);

/// The level v of psi at rest: the root of
///     2 a e (1 - (1 + q + lambda m) e) + kappa (1 - 2 e + (1 + q) e^2 + lambda_area) = 0
/// with v = ln e, a = |grad psi|, q = lambda a^2, m = n . Hess psi n and kappa the curvature of
/// psi's level set, all at the foot of the voxel on the interface.
/// @param[in] psi    in the band about psi = 0
/// @param[in] slope  of psi; v is that of a flat interface, -ln(1 + lambda slope^2), beyond 0.75 Å
///                   and a voxel from its foot
/// @return v on the leaves of psi
LeafField levelsAtRest(const SparseField& psi, const SlopeField& slope, const Weights& weights,
                       const Progress& progress);

/// The level at a point of the interface itself, and its derivatives by what it is made of.
struct RestLevel {
    double v = 0.0;
    double kappa = 0.0;                                  ///< of psi's level set [1/Å]
    double bySlope = 0.0, bySecond = 0.0, byKappa = 0.0; ///< by a, m and kappa
};

/// The same root in double precision at one point of the interface, without a mean about it.
/// @param[in] psi    there
/// @param[in] least  a counts as at least this [1/Å]
RestLevel levelAtRest(const PsiJet& psi, double least, const Weights& weights);

/// An interface psi = v.
struct RestingLevels {
    const LeafField& levels; ///< v, on the leaves of psi
    const SlopeField& slope; ///< as of levelsAtRest()
};

/// How far the interface psi = v is from rest: (w' + w kappa)/P at places where edges between
/// voxels cross it, with psi and its derivatives from the Gaussians themselves, those of v from
/// differences, and P the second derivative of w along the normal.
/// @param[in] psi     with the bumps of the sum
/// @param[in] region  whose own leaves count
/// @return ways [voxel] at a sample of leaves: all of fewer than 64, then every second, fourth and
///         eighth, and every sixteenth of 512 or more; there as many places as voxels of 1 Å have
Displacements waysToRest(const SparseField& psi, const RestingLevels& rest, const GaussianSum& sum,
                         const Weights& weights, const Region& region, const Progress& progress);

/// Turns levels into G = (v - psi)/slope, which carries the interface as smoothly as psi.
/// @param[in]     rest   the interface
/// @param[in]     width  G lies within two of it about 0 [Å]
/// @param[in,out] psi    becomes G [Å], < 0 inside
void carryLevels(const RestingLevels& rest, double width, SparseField& psi,
                 const Progress& progress);

} // namespace molsurf
