// SPDX-License-Identifier: MPL-2.0

/// @file
/// How fast the passes over leaf blocks are, in million active voxels a second on one thread,
/// beside the rate at which memory is copied in the same run. Each pass is checked against its
/// closed form first: a wrong answer must not win.

#include "molsurf/kernel/grid/leaf_block.h"
#include "molsurf/kernel/levelset/curvature.h"
#include "molsurf/kernel/levelset/gaussian_sum.h"
#include "molsurf/kernel/levelset/redistance.h"
#include "molsurf/kernel/levelset/reinitialize.h"
#include "molsurf/kernel/spline/spline.h"

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace
{

using namespace molsurf;

constexpr double voxel = 0.5, radius = 60.0, width = 2.0; // Å; a shell of some 1.4 million voxels

struct Shell {
    SparseField phi;

    Shell()
    {
        // The leaves that the shell of a ball meets, and its distance on them.
        const int reach = int((radius + width) / voxel / leafDim) + 1;
        std::vector<openvdb::Coord> origins;
        for (int x = -reach; x <= reach; ++x) {
            for (int y = -reach; y <= reach; ++y) {
                for (int z = -reach; z <= reach; ++z) {
                    const openvdb::Coord origin(x * leafDim, y * leafDim, z * leafDim);
                    const double far =
                        (origin.asVec3d() + openvdb::Vec3d(3.5)).length() * voxel - radius;
                    if (std::abs(far) < width + 0.87 * leafDim * voxel) origins.push_back(origin);
                }
            }
        }
        LeafTable all(std::move(origins));
        for (std::size_t n = 0; n < all.size(); ++n) {
            for (int v = 0; v < leafSize; ++v)
                all.active(n).set(v, std::abs(at(all, n, v)) < width);
        }
        const LeafTable table = pruned(all);
        phi = {table, LeafField(table.size()), voxel};
        for (std::size_t n = 0; n < table.size(); ++n) {
            for (int v = 0; v < leafSize; ++v) phi.leaf(n)[v] = float(at(table, n, v));
        }
    }

    static double at(const LeafTable& table, std::size_t n, int v)
    {
        return table.origin(n).offsetBy(v >> 6, v >> 3 & 7, v & 7).asVec3d().length() * voxel -
               radius;
    }
};

const Shell& shell()
{
    static const Shell one;
    return one;
}

void require(bool good, const char* what)
{
    if (good) return;
    std::fprintf(stderr, "wrong answer: %s\n", what);
    std::exit(1);
}

void countVoxels(benchmark::State& state)
{
    state.counters["voxels/s"] =
        benchmark::Counter(double(state.iterations()) * double(shell().phi.table.activeCount()),
                           benchmark::Counter::kIsRate);
}

void memoryCopy(benchmark::State& state)
{
    const std::size_t bytes = shell().phi.values.bytes();
    LeafField copy(shell().phi.table.size());
    for (auto _ : state) {
        for (std::size_t n = 0; n < copy.leafCount(); ++n)
            std::memcpy(copy.leaf(n), shell().phi.leaf(n), leafSize * sizeof(float));
        benchmark::ClobberMemory();
    }
    state.SetBytesProcessed(std::int64_t(state.iterations()) * 2 * std::int64_t(bytes));
    countVoxels(state);
}
BENCHMARK(memoryCopy);

/// What every pass begins with: a leaf and its rim, by halos of one and two voxels.
template<int Halo>
void gatherPass(benchmark::State& state)
{
    LeafBlock<float, Halo> block;
    for (auto _ : state) {
        for (std::size_t n = 0; n < shell().phi.table.size(); ++n) {
            block.gather(shell().phi, n);
            benchmark::ClobberMemory();
        }
    }
    countVoxels(state);
}
BENCHMARK(gatherPass<1>);
BENCHMARK(gatherPass<2>);

/// Mean and Gaussian curvature by 19 points of the 27 around each voxel.
void curvaturePass(benchmark::State& state)
{
    const LeafTable& table = shell().phi.table;
    LeafField mean(table.size());
    const auto pass = [&] {
        LeafCurvature shape;
        LeafBlock<float, 1> block;
        for (std::size_t n = 0; n < table.size(); ++n) {
            block.gather(shell().phi, n);
            mean.prefetchAfter(n);
            curvature(block, table.active(n), float(voxel), shape);
            std::memcpy(mean.leaf(n), shape.mean, sizeof shape.mean);
        }
    };
    pass();
    const std::size_t n = table.size() / 2;
    LeafMask inner = within(shell().phi.leaf(n), float(width - voxel));
    inner.forEach([&](int v) {
        const double exact = 2.0 / (radius + Shell::at(table, n, v));
        require(std::abs(mean.leaf(n)[v] - exact) < 0.01 * exact, "curvature");
    });
    for (auto _ : state) pass();
    countVoxels(state);
}
BENCHMARK(curvaturePass);

/// One iteration of reinitialize().
void redistancingPass(benchmark::State& state)
{
    SparseField phi = copied(shell().phi);
    LeafField scratch;
    Progress progress;
    for (auto _ : state) reinitialize(phi, {width, 1}, progress, scratch);
    const std::size_t n = shell().phi.table.size() / 2;
    within(phi.leaf(n), float(width - voxel)).forEach([&](int v) {
        require(std::abs(phi.leaf(n)[v] - Shell::at(shell().phi.table, n, v)) < 0.01, "distance");
    });
    countVoxels(state);
}
BENCHMARK(redistancingPass);

/// redistance() by closest points to depth 3.4 Å, as after the flow.
void closestPoints(benchmark::State& state)
{
    Progress progress;
    std::size_t voxels = 0;
    for (auto _ : state) {
        const DistanceBand band = redistance(copied(shell().phi), {3.4, 0.6}, -1.4, progress);
        voxels = band.phi.table.activeCount();
    }
    state.counters["voxels/s"] = benchmark::Counter(double(state.iterations()) * double(voxels),
                                                    benchmark::Counter::kIsRate);
}
BENCHMARK(closestPoints)->Unit(benchmark::kMillisecond);

void prefilterPass(benchmark::State& state)
{
    Progress progress;
    for (auto _ : state) benchmark::DoNotOptimize(prefilter(shell().phi, progress));
    countVoxels(state);
}
BENCHMARK(prefilterPass)->Unit(benchmark::kMillisecond);

/// psi of a lattice of atoms. A term is a voxel times a ball that is not left out of its octant.
void rasterize(benchmark::State& state)
{
    std::vector<Ball> balls;
    for (int i = 0; i < 4096; ++i) {
        const openvdb::Vec3f c(2.2f * (i & 15), 2.2f * (i >> 4 & 15), 2.2f * (i >> 8 & 15));
        balls.push_back({c, 1.7f, i});
    }
    const GaussianSum sum(balls, {1.4, 0.5, 0.0, voxel, 2.75});
    alignas(64) float psi[leafSize];
    std::size_t leaves = 0;
    for (auto _ : state) {
        for (int x = 0; x < 64; x += leafDim) {
            sum.evaluate(openvdb::Coord(x, 32, 32), 2.75, psi);
            benchmark::DoNotOptimize(psi[0]);
            ++leaves;
        }
    }
    std::size_t terms = 0;
    for (int x = 0; x < 64; x += leafDim)
        terms += sum.productCount(openvdb::Coord(x, 32, 32), 2.75);
    state.counters["terms/s"] =
        benchmark::Counter(double(leaves / 8) * double(terms), benchmark::Counter::kIsRate);
    state.counters["terms/leaf"] = double(terms / leafSize) / 8.0;
    state.counters["leaves/s"] = benchmark::Counter(double(leaves), benchmark::Counter::kIsRate);
}
BENCHMARK(rasterize);

} // namespace

int main(int argc, char** argv)
{
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
}
