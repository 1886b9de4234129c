// SPDX-License-Identifier: MPL-2.0
// How long the search tree of a mesh of a million triangles takes, and a distance from it.
#include "molsurf/analysis/proximity/deviation.h"
#include "molsurf/kernel/core/parallel.h"

#include <benchmark/benchmark.h>

#include <cmath>

namespace
{

using namespace molsurf;
using openvdb::Vec3d;

/// A bumpy torus of 2 n² triangles, some 70 Å across.
Surface torus(std::uint32_t n, double phase)
{
    Surface surface;
    const auto id = [&](std::uint32_t i, std::uint32_t j) { return i % n * n + j % n; };
    for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t j = 0; j < n; ++j) {
            const double u = 2.0 * M_PI * i / n, v = 2.0 * M_PI * j / n;
            const double tube = 10.0 + std::sin(9.0 * u + phase) * std::cos(7.0 * v);
            const double ring = 25.0 + tube * std::cos(v);
            surface.mesh.positions.emplace_back(
                float(ring * std::cos(u)), float(ring * std::sin(u)), float(tube * std::sin(v)));
            surface.mesh.triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
            surface.mesh.triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
        }
    }
    surface.closed = true;
    return surface;
}

constexpr std::uint32_t side = 708; // 1 002 528 triangles

void searchTree(benchmark::State& state)
{
    const Surface surface = torus(side, 0.0);
    for (auto _ : state) {
        const ClosestPoint closest(surface.mesh);
        benchmark::DoNotOptimize(closest.at(Vec3d(1.0)));
    }
}
BENCHMARK(searchTree)->Unit(benchmark::kMillisecond)->UseRealTime();

void distances(benchmark::State& state)
{
    const Surface a = torus(side, 0.0), b = torus(side, 1.3);
    const DistanceTo to(b);
    for (auto _ : state) {
        const Comparison::OneWay way = distancesFrom(a, to, Progress());
        if (!(way.max > 0.5 && way.max < 2.0)) state.SkipWithError("wrong distance");
    }
    state.SetItemsProcessed(std::int64_t(state.iterations() * a.mesh.positions.size()));
}
BENCHMARK(distances)->Unit(benchmark::kMillisecond)->UseRealTime();

} // namespace

BENCHMARK_MAIN();
