// SPDX-License-Identifier: MPL-2.0
#include "molsurf/flow/interface_energy.h"

#include "molsurf/core/parallel.h"
#include "molsurf/grid/leaf_block.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace molsurf
{

namespace
{

using EnergyBlock = LeafBlock<float, 2>;

/// The cubic through the values at -1, 0, 1, 2 along a line, at t.
double cubic(const float* p, int step, double t)
{
    const double a = p[-step], b = p[0], c = p[step], d = p[2 * step];
    return b +
           0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)));
}

/// Where the cubic vanishes between 0 and 1, b and c being of opposite signs.
double crossing(const float* p, int step)
{
    double low = 0.0, high = 1.0, t = double(p[0]) / (double(p[0]) - double(p[step]));
    for (int i = 0; i < 4; ++i) { // Newton's method: the cubic is nearly straight
        const double value = cubic(p, step, t);
        ((value < 0.0) == (p[0] < 0.0f) ? low : high) = t;
        const double slope = (cubic(p, step, t + 1e-3) - value) * 1e3;
        if (std::abs(value) <= 1e-6 * std::abs(slope)) break;
        const double next = t - value / slope;
        t = next > low && next < high ? next : 0.5 * (low + high);
    }
    return t;
}

struct Crossings {
    std::vector<GaussianSum::Point> points;
    std::vector<double> weights; // [voxel^2]
};

/// The crossings of the edges that begin at voxels of a leaf.
void findCrossings(const EnergyBlock& phi, const LeafMask& active, Crossings& out)
{
    constexpr int steps[3] = {EnergyBlock::strideX, EnergyBlock::strideY, EnergyBlock::strideZ};
    out.points.clear();
    out.weights.clear();
    active.forEach([&](int v) {
        const int place[3] = {v >> 6, v >> 3 & 7, v & 7};
        const float* p = phi.at(place[0], place[1], place[2]);
        for (int a = 0; a < 3; ++a) {
            if ((p[0] < 0.0f) == (p[steps[a]] < 0.0f)) continue;
            const double t = crossing(p, steps[a]);
            double n[3], length = 0.0;
            for (int b = 0; b < 3; ++b) {
                const auto slope = [&](const float* q) {
                    return 0.5 * (double(q[steps[b]]) - double(q[-steps[b]]));
                };
                n[b] = (1.0 - t) * slope(p) + t * slope(p + steps[a]);
                length += n[b] * n[b];
            }
            if (length == 0.0) continue;
            float at[3] = {float(place[0]), float(place[1]), float(place[2])};
            at[a] += float(t);
            out.points.push_back({at[0], at[1], at[2]});
            out.weights.push_back(std::abs(n[a]) / std::sqrt(length));
        }
    });
}

} // namespace

double interfaceEnergy(const SparseField& phi, const GaussianSum& sum, const Weights& weights,
                       const Region& region, const Progress& progress)
{
    const double h = phi.voxelSize;
    const double energy = parallelSum<double>(phi.table.size(), progress, [&](std::size_t n) {
        thread_local Crossings crossings;
        double own = 0.0;
        const LeafMask near = phi.table.active(n) & within(phi.leaf(n), float(1.8 * h));
        if (!near.any() || !region.owned.isInside(phi.table.origin(n))) return own;
        EnergyBlock block;
        block.gather(phi, n);
        findCrossings(block, near, crossings);
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
