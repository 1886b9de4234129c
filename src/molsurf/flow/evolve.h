// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The variational flow: a level set moves down the energy  E = integral over Gamma of w.

#include "molsurf/grid/region.h"
#include "molsurf/grid/sparse_field.h"
#include "molsurf/options.h"
#include "molsurf/progress.h"
#include "molsurf/report.h"

#include <functional>

namespace molsurf
{

/// A level set in its narrow band, and the field psi that drives it.
struct NarrowBand {
    SparseField phi; ///< signed distance [Å], < 0 inside; active voxels: the band
    LeafField psi;   ///< on the leaves of phi
};

/// Width of the band on each side of the interface [voxel]: the flow acts up to 2.25 voxels away,
/// and its stencils reach less than one further.
constexpr int bandWidthVox = 3;

/// Gives psi at the 512 voxels of the leaf with this first voxel. It is called from several
/// threads.
using PsiSource = std::function<void(const openvdb::Coord& origin, float* psi)>;

/// Evolves phi by  phi_t = |grad phi| (w kappa + n . grad w)  with speeds extended along normals
/// from the interface (docs/math.md, section 4). After each step the level set is made a distance
/// again by reinitialize(); leaves are added as the interface moves, and none is dropped.
///
/// Stops when in a step the energy changes by less than options.energyTolerance and the mean
/// displacement is below options.displacementTolerance; or after options.maxSteps; or, if these are
/// not given, when the mean displacement of the preconditioned flow is small, but above its
/// tolerance, and has not fallen by a hundredth in five steps; with options.steps after just so
/// many. Where steps are small because the voxels are (the bound of explicit diffusion), that can
/// be far from rest: EvolutionReport::estimatedRemainingDisplacement tells how far.
///
/// @param[in,out] band    as initialSurface() makes it
/// @param[in]     source  psi for leaves that are added
/// @param[in]     region  where leaves may be added: those that the band has must lie there, too;
///                        the report's sums are of its own voxels only, and may be empty
/// @param[in]     halo    of the region, in leaves
/// @throws Error(ErrorKind::Numeric) if a value is not finite, or if nothing is left of the surface
EvolutionReport evolve(NarrowBand& band, const PsiSource& source, const EvolveOptions& options,
                       Progress& progress, const Region& region = {}, int halo = 0);

/// Finds whether the last step of a history meets the stopping rule, and how far it has yet to go.
/// @param[in]     voxelSize  edge h of a voxel [Å]
/// @param[in,out] report     its converged and estimatedRemainingDisplacement are set
void checkConvergence(const EvolveOptions& options, double voxelSize, EvolutionReport& report);

} // namespace molsurf
