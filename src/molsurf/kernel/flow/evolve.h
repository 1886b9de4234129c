// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The variational flow: a level set moves down the energy  E = integral over Gamma of w.

#include "molsurf/kernel.h"
#include "molsurf/kernel/flow/displacement.h"
#include "molsurf/kernel/flow/metric.h"
#include "molsurf/kernel/flow/narrow_band.h"
#include "molsurf/kernel/grid/region.h"
#include "molsurf/progress.h"
#include "molsurf/report.h"

#include <vector>

namespace molsurf
{

/// The edge above which voxels are too coarse for a surface that shows atoms [Å].
constexpr double coarseVoxel = 1.0;

/// Largest numbers of steps, if the options do not say any: of the Newton flow, and of the paper's.
constexpr int defaultSteps = 50, defaultPaperSteps = 200;

/// The longest way in a step that 99.9 % of the interface may still have at rest: so many times
/// that of the root mean square, but no less than the grid's own noise [voxel].
constexpr double tailOfTolerance = 8.0, tailOfGrid = 0.04;

/// The weights that the options say.
Weights weightsOf(const EvolveOptions& options);

/// Whether the flow makes Newton steps, and any steps at all: then it starts where it will rest to
/// first order.
bool makesNewtonSteps(const EvolveOptions& options);

/// Whether the interface at rest is known in closed form (kernel/flow/equilibrium.h): no front
/// moves, and no number of steps is given.
bool restsInClosedForm(const EvolveOptions& options);

/// Whether the flow starts from its rest on voxels twice as large. It does so where lambda is so
/// large that fronts move far, as the surface closes pockets and gaps: that takes as many steps as
/// it is voxels.
bool startsOnCoarserVoxels(const EvolveOptions& options, double voxelSize);

/// Whether the flow leaves gaps as psi decides them: it is so but where fronts move far.
bool decidesGaps(const EvolveOptions& options);

/// The options of the flow on coarser voxels, which goes nearer to rest than those ask for.
EvolveOptions coarseFlow(const EvolveOptions& options);

/// Evolves phi by  phi_t = |grad phi| (w kappa + n . grad w)  to rest (docs/math.md, section 4): by
/// Newton steps, each solved for by sweeps over the interface, with speeds taken at the foot points
/// of voxels. After each step the level set is made a distance again by reinitialize(); leaves are
/// added as the interface moves, and none is dropped.
///
/// Stops when the way of the interface in a step has a root mean square below options.tolerance
/// voxels, and at 99.9 % of the interface is below eight times this; or after options.maxSteps; or,
/// if these are not given, when in eight steps neither of the two has fallen by a tenth, nor the
/// area and the volume have changed; with options.steps after just so many. Where fronts move far,
/// they go on alone as soon as all else is calm, see settle(), and steps of the whole follow.
///
/// @param[in,out] band    as initialSurface() or refined() make it
/// @param[in]     source  psi for leaves that are added
/// @param[in]     region  where leaves may be added: those that the band has must lie there, too;
///                        the report's sums are of its own voxels only, and may be empty
/// @param[in]     halo    of the region, in leaves
/// @param[out]    last    null, or takes the ways of the interface in the last step
/// @throws Error(ErrorKind::Numeric) if a value is not finite, or if nothing is left of the surface
EvolutionReport evolve(NarrowBand& band, const PsiSource& source, const EvolveOptions& options,
                       Progress& progress, const Region& region = {}, int halo = 0,
                       Displacements* last = nullptr);

/// Estimates how much the area will still change, from that of the last step and its ways.
/// @param[in,out] report  judged, with all its sums; areaError is set
void estimateAreaError(const EvolveOptions& options, EvolutionReport& report);

/// Finds whether an interface in closed form is at rest: whether the way from it to rest has a root
/// mean square below 2 Å times the tolerance, and is below eight times that at 99.9 % of it; on
/// voxels above 1 Å (h/Å)^2 times as much. On voxels above 0.75 Å, unless a smaller tolerance than
/// the default is asked for, it is at rest, too, where they hold nothing nearer: where the root
/// mean square is below the sag h^2 H / 8 of a chord, H = 0.5/Å, and the way at 99.9 % is below the
/// diagonal of a cell.
/// @param[in]     ways       from it to rest, see waysToRest()
/// @param[in]     voxelSize  edge h of a voxel [Å]
/// @param[in,out] report     converged, the ways and areaError are set
void checkConvergence(const Displacements& ways, const EvolveOptions& options, double voxelSize,
                      EvolutionReport& report);

/// Whether a flow has come as near to rest as its voxels let it: in eight steps neither the root
/// mean square nor the quantile of its ways has fallen by a tenth, nor have area and
/// volume changed.
/// @param[in] rms, tails  of the steps so far
bool stalled(const std::vector<double>& rms, const std::vector<double>& tails,
             const EvolutionReport& report);

/// Finds whether the ways of the interface in a step meet the stopping rule.
/// @param[in]     voxelSize  edge h of a voxel [Å]
/// @param[in,out] report     converged and the last ways are set
void judge(const Displacements& last, const EvolveOptions& options, double voxelSize,
           EvolutionReport& report);

} // namespace molsurf
