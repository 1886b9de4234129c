// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/pipeline/influence.h"

#include "molsurf/kernel/pipeline/surface_kind.h"

#include <algorithm>

namespace molsurf
{

Influence::Influence(const BallModel& model, const SurfaceSpec& spec)
    : Influence(extentOf(model.balls, gaussianOptions(spec),
                         hasFlow(spec.kind) ? model.decays : std::vector<Decay>()),
                spec)
{
}

Influence::Influence(const GaussianExtent& extent, const SurfaceSpec& spec)
    : spec_(spec), extent_(extent)
{
}

double Influence::ofSurface() const
{
    if (isBare(spec_.kind)) return 0.0;
    return extent_.maxGrownRadius - extent_.maxRadius + extent_.maxTolerance;
}

double Influence::ofLabel() const
{
    // Points of the surface lie within a probe radius and the tolerance's swelling of their atom.
    return 2.0 * spec_.probe + 4.0 * extent_.maxTolerance + 4.0 * spec_.voxel + spec_.minThickness;
}

double Influence::acrossGap() const
{
    if (isBare(spec_.kind)) return 0.0;
    if (isUnion(spec_.kind)) return 2.0 * spec_.probe;
    // Where the surface of one lies, the Gaussian of the other is not felt any more.
    return 2.0 * gaussianOptions(spec_).probe + extent_.cutoff(0.0) - extent_.maxGrownRadius;
}

double Influence::onVoxels() const
{
    const double h = spec_.voxel, leaf = leafDim * h;
    const double labels = extent_.maxRadius + ofLabel();
    // A ball's boundary takes part in the distance of its depth, and is cut by balls two radii off.
    const double unions = 3.0 * (extent_.maxRadius + spec_.probe) + widthsOf(spec_).inside + leaf;
    if (isUnion(spec_.kind)) return std::max(unions, labels);
    const double reach = std::max(gaussianOptions(spec_).reach, 2.0 * extent_.maxTolerance);
    const double sums = std::max(extent_.cutoff(reach), extent_.ofZero() + h + 2.0 * leaf);
    return std::max({unions, sums, labels});
}

} // namespace molsurf
