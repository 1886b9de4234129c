// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/levelset/seed_kinks.h"

#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/core/simd.h"
#include "molsurf/kernel/levelset/kink.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace molsurf
{

using openvdb::Coord;
using openvdb::Vec3f;

namespace
{

/// Normals at the closest points of the voxels of a leaf and of those one step on; not a number
/// where there is none.
struct Normals {
    static constexpr int dim = leafDim + 1;
    static constexpr int strides[3] = {dim * dim, dim, 1};
    float n[3][dim * dim * dim];
};

/// The voxels of a leaf whose normal turns as much as beside a kink to the next voxel along an
/// axis.
MOLSURF_KERNEL void turning(const Normals& normals, int stride, LeafMask& mask)
{
    constexpr float cosine = 1.0f - 0.5f * kinkSpread * kinkSpread;
    const float *nx = normals.n[0], *ny = normals.n[1], *nz = normals.n[2];
    const Ints bit = splat(1) << laneNumbers();
    for (int row = 0; row < 64; ++row) {
        const int i = row / 8 * Normals::strides[0] + row % 8 * Normals::strides[1];
        const int j = i + stride;
        const Floats along =
            load(nx + i) * load(nx + j) + load(ny + i) * load(ny + j) + load(nz + i) * load(nz + j);
        mask.words[row >> 3] |= std::uint64_t(bitsOf((along < cosine) & bit)) << (8 * (row & 7));
    }
}

/// Whether a voxel and the next one, whose normals turn, have a kink between them.
bool isKinkBetween(const NearestSeeds& near, const Coord& origin, std::int32_t seed,
                   std::int32_t next, int v)
{
    const Seed &a = near[seed], &b = near[next];
    const float side = a.n.dot(near.offset(a, origin, v)) < 0.0f ? 1.0f : -1.0f;
    const Vec3f chord = b.y + near.shift(b, origin) - a.y - near.shift(a, origin);
    const float curvature =
        std::max(side * a.curvatureAlong(chord), side * b.curvatureAlong(chord));
    return isKink(chord, side * (b.n - a.n), curvature);
}

/// The normals at the seeds of the voxels of a leaf and of those one step on.
void gatherNormals(const NearestSeeds& near, const SeedBlock& index, Normals& normals)
{
    constexpr int dim = Normals::dim;
    constexpr int ahead = 3; // rows, to ask for seeds: they lie scattered in memory
    for (float* numbers : normals.n)
        std::fill_n(numbers, dim * dim * dim, std::numeric_limits<float>::quiet_NaN());
    const std::int32_t* rows[dim * dim]; // that have a seed
    int places[dim * dim], count = 0;
    for (int row = 0; row < dim * dim; ++row) {
        const std::int32_t* in = index.at(row / dim, row % dim, 0);
        std::int32_t all = noSeed; // every bit
        for (int z = 0; z < dim; ++z) all &= in[z];
        rows[count] = in;
        places[count] = dim * row;
        count += all != noSeed;
    }
    for (int i = 0; i < count; ++i) {
        const std::int32_t* later = rows[std::min(i + ahead, count - 1)];
        for (int z = 0; z < dim; ++z) {
            const std::int32_t seed = rows[i][z], soon = later[z];
            if (soon != noSeed) __builtin_prefetch(&near[soon]);
            if (seed == noSeed) continue;
            const Vec3f& n = near[seed].n;
            for (int a = 0; a < 3; ++a) normals.n[a][places[i] + z] = n[a];
        }
    }
}

/// The voxels of a leaf with a kink between them and the next voxel along an axis.
/// @param[out] turns  those between which the normal turns as much
LeafMask kinksIn(const NearestSeeds& near, std::size_t n, LeafMask& turns)
{
    SeedBlock index;
    index.gather(near.domain, near.index, n);
    Normals normals;
    gatherNormals(near, index, normals);
    constexpr int strides[3] = {SeedBlock::strideX, SeedBlock::strideY, SeedBlock::strideZ};
    LeafMask along[3];
    for (int axis = 0; axis < 3; ++axis) turning(normals, Normals::strides[axis], along[axis]);
    turns = along[0] | along[1] | along[2];
    LeafMask out;
    turns.forEach([&](int v) {
        const std::int32_t* p = index.at(v >> 6, v >> 3 & 7, v & 7);
        for (int axis = 0; axis < 3; ++axis) {
            if (along[axis].on(v) &&
                isKinkBetween(near, near.domain.origin(n), *p, p[strides[axis]], v))
                out.set(v);
        }
    });
    return out;
}

} // namespace

SeedKinks kinksOf(const NearestSeeds& near, const Progress& progress)
{
    SeedKinks out{near.domain, std::vector<LeafMask>(near.domain.size())};
    parallelFor(near.domain.size(), progress,
                [&](std::size_t n) { out.kinks.active(n) = kinksIn(near, n, out.turns[n]); });
    return out;
}

} // namespace molsurf
