// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/flow/interface_energy.h"

#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/flow/edge_crossings.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

double interfaceEnergy(const SparseField& phi, const GaussianSum& sum, const Weights& weights,
                       const Region& region, const Progress& progress)
{
    const double h = phi.voxelSize;
    const double energy = parallelSum<double>(phi.table.size(), progress, [&](std::size_t n) {
        thread_local EdgeCrossings crossings;
        double own = 0.0;
        // An edge that is crossed begins within its own length of the interface, and a little more.
        const LeafMask near = phi.table.active(n) & within(phi.leaf(n), float(1.8 * h));
        if (!near.any() || !region.owned.isInside(phi.table.origin(n))) return own;
        EdgeCrossings::Block block;
        block.gather(phi, n);
        crossings.find(block, near);
        if (crossings.points.empty()) return own;
        sum.sample(phi.table.origin(n), crossings.points,
                   [&](std::size_t i, float psi, float slope2) {
                       const double e = std::exp(std::min(double(psi), 2.0)), g = 1.0 - e;
                       const double w = g * g + double(weights.gradient) * e * e * double(slope2) +
                                        double(weights.area);
                       own += crossings.weights[i] * w;
                   });
        return own;
    });
    return energy * h * h;
}

} // namespace molsurf
