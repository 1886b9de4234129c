// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/levelset/leaf_feet.h"

#include "molsurf/kernel/levelset/kink.h"

#include <algorithm>
#include <cstring>

namespace molsurf
{

using openvdb::Coord;

namespace
{

/// Copies the numbers of a cube, which lie in pairs along z.
template<typename T>
void copyCube(const T* cube, int first, T* leaf)
{
    for (int k = 0; k < VoxelCube::size; k += 2) {
        const Coord at = VoxelCube::coord(k);
        std::memcpy(leaf + first + 64 * at.x() + 8 * at.y() + at.z(), cube + k, 2 * sizeof(T));
    }
}

/// The place of a voxel in a leaf.
int placeOf(const Coord& voxel)
{
    return 64 * voxel.x() + 8 * voxel.y() + voxel.z();
}

} // namespace

void LeafFeet::setDistances(const VoxelCube& cube, const Coord& corner)
{
    copyCube(cube.distance, placeOf(corner), distance);
}

void LeafFeet::set(const VoxelCube& cube, const Coord& corner)
{
    const int first = placeOf(corner);
    copyCube(cube.distance, first, distance);
    copyCube(cube.part, first, part);
    for (int a = 0; a < 3; ++a) copyCube(cube.normal[a], first, normal[a]);
    copyCube(cube.bend, first, bend);
}

MOLSURF_KERNEL void LeafFeet::finish()
{
    for (int v = 0; v < leafSize; v += floatLanes) {
        const Floats x = load(normal[0] + v), y = load(normal[1] + v), z = load(normal[2] + v);
        const Floats inverse = 1.0f / larger(squareRoot(x * x + y * y + z * z), splat(1e-12f));
        store(normal[0] + v, inverse * x);
        store(normal[1] + v, inverse * y);
        store(normal[2] + v, inverse * z);
    }
    std::fill(part + leafSize, part + padded, -1);
    for (float* numbers : {distance, normal[0], normal[1], normal[2], bend})
        std::fill(numbers + leafSize, numbers + padded, 0.0f);
}

MOLSURF_KERNEL LeafMask LeafFeet::cutOff(float inside, float outside, float* phi) const
{
    LeafMask mask;
    for (int v = 0; v < leafSize; v += floatLanes) {
        const Floats d = load(distance + v);
        store(phi + v, clamped(d, splat(-inside), splat(outside)));
        const Ints within = (d > -inside) & (d < outside);
        mask.words[v >> 6] |= std::uint64_t(bitsOf(within & (splat(1) << laneNumbers())))
                              << (v & 63);
    }
    return mask;
}

// isKink() for eight pairs of voxels v and w = v + stride at a time. With d and m the distance and
// the normal at a voxel, its foot lies at -d m from it. Curvatures are bounded by those of the
// parts: a kink that the bound leaves is sure; without a curvature it is possible.
MOLSURF_KERNEL KinkMasks findKinks(const LeafFeet& feet, float voxel, std::int32_t patches)
{
    constexpr float least = 0.5f * kinkSpread;
    constexpr int strides[3] = {64, 8, 1}, ends[3] = {leafSize - 64, leafSize, leafSize};
    const Ints bits = splat(1) << laneNumbers();
    KinkMasks out;
    for (int axis = 0; axis < 3; ++axis) {
        const int stride = strides[axis];
        for (int v = 0; v < ends[axis]; v += floatLanes) {
            if (axis == 1 && (v & 56) == 56) continue; // y = 7: the next row is of another plane
            const int w = v + stride;
            const Ints p = load(feet.part + v), q = load(feet.part + w);
            const Floats d = load(feet.distance + v), e = load(feet.distance + w);
            Ints pair = (p >= 0) & (q >= 0) & ((d < 0.0f) == (e < 0.0f));
            pair &= (p != q) | (p >= patches);
            if (axis == 2) pair &= laneNumbers() < splat(floatLanes - 1); // not z = 7
            if (!any(pair)) continue;
            Floats spread2 = {}, product = {}, chord2 = {}; // of the vectors in isKink()
            for (int a = 0; a < 3; ++a) {
                const Floats m = load(feet.normal[a] + v), n = load(feet.normal[a] + w);
                const Floats spread = n - m;
                Floats chord = d * m - e * n;
                if (a == axis) chord += voxel;
                spread2 += spread * spread;
                product += spread * chord;
                chord2 += chord * chord;
            }
            // Outside, the unit vectors toward the boundary are the opposite ones.
            product = d < 0.0f ? product : -product;
            const Floats bend = larger(load(feet.bend + v), load(feet.bend + w));
            const Floats sureRest = product - larger(bend, splat(0.0f)) * chord2;
            const Floats most2 = least * least * chord2;
            const Ints apart = pair & (spread2 >= kinkSpread * kinkSpread);
            const Ints possible = apart & (product > 0.0f) & (product * product > most2);
            const Ints sure =
                possible & (p != q) & (sureRest > 0.0f) & (sureRest * sureRest > most2);
            const int word = v >> 6, shift = v & 63;
            out.sure.words[word] |= std::uint64_t(bitsOf(sure & bits)) << shift;
            out.possible[axis].words[word] |= std::uint64_t(bitsOf(possible & ~sure & bits))
                                              << shift;
        }
    }
    return out;
}

} // namespace molsurf
