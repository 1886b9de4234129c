// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/warm_start.h"

#include "molsurf/core/parallel.h"
#include "molsurf/flow/evolve.h"
#include "molsurf/levelset/reinitialize.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

WarmStart::WarmStart() = default;
WarmStart::~WarmStart() = default;
WarmStart::WarmStart(WarmStart&& other) noexcept = default;
WarmStart& WarmStart::operator=(WarmStart&& other) noexcept = default;

void addCorrection(const WarmStart& warm, SparseField& phi, const Progress& progress)
{
    if (warm.empty()) return;
    constexpr int repairs = 2; // the sum is nearly a distance
    const float width = float(bandWidthVox * phi.voxelSize);
    const SparseField& correction = warm.state->correction;
    parallelFor(phi.table.size(), progress, [&](std::size_t n) {
        const std::int32_t m = correction.table.find(phi.table.origin(n));
        if (m == noLeaf) return;
        for (int v = 0; v < leafSize; ++v)
            phi.leaf(n)[v] = std::clamp(phi.leaf(n)[v] + correction.leaf(m)[v], -width, width);
    });
    reinitialize(phi, width, repairs, progress);
}

WarmStart correctionOf(const SparseField& cold, const SparseField& phi, const Progress& progress)
{
    const float width = float(bandWidthVox * phi.voxelSize) * 0.999f;
    WarmStart warm;
    warm.state = std::make_unique<WarmStart::State>();
    SparseField& correction = warm.state->correction;
    correction = {phi.table, LeafField(phi.table.size()), phi.voxelSize};
    parallelFor(phi.table.size(), progress, [&](std::size_t n) {
        float* out = correction.leaf(n);
        std::fill_n(out, leafSize, 0.0f);
        const std::int32_t m = cold.table.find(phi.table.origin(n));
        if (m == noLeaf) return;
        const float *from = cold.leaf(m), *to = phi.leaf(n);
        for (int v = 0; v < leafSize; ++v)
            if (std::abs(from[v]) < width && std::abs(to[v]) < width) out[v] = to[v] - from[v];
    });
    return warm;
}

} // namespace molsurf
