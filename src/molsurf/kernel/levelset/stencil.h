// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Rows of a leaf block in loops that vectorise: masks, and central differences of second order.

#include "molsurf/kernel/grid/leaf_block.h"

namespace molsurf
{

/// The bits of a row's voxels: loops that test a mask by this table vectorise, by shifts they do
/// not.
alignas(64) constexpr int rowBits[8] = {1, 2, 4, 8, 16, 32, 64, 128};

/// Gradient and Hessian at one voxel.
struct Derivatives {
    float x, y, z;
    float xx, yy, zz, xy, yz, xz;
};

/// @param[in] p        the voxel in a LeafBlock<float, Halo>
/// @param[in] inverse  1/h
template<int Halo>
inline __attribute__((always_inline)) Derivatives derivatives(const float* p, float inverse)
{
    constexpr int X = LeafBlock<float, Halo>::strideX;
    constexpr int Y = LeafBlock<float, Halo>::strideY;
    const float first = 0.5f * inverse, second = inverse * inverse, mixed = 0.25f * second;
    Derivatives d;
    d.x = first * (p[X] - p[-X]);
    d.y = first * (p[Y] - p[-Y]);
    d.z = first * (p[1] - p[-1]);
    d.xx = second * ((p[X] - p[0]) - (p[0] - p[-X]));
    d.yy = second * ((p[Y] - p[0]) - (p[0] - p[-Y]));
    d.zz = second * ((p[1] - p[0]) - (p[0] - p[-1]));
    d.xy = mixed * ((p[X + Y] - p[X - Y]) - (p[-X + Y] - p[-X - Y]));
    d.yz = mixed * ((p[Y + 1] - p[Y - 1]) - (p[-Y + 1] - p[-Y - 1]));
    d.xz = mixed * ((p[X + 1] - p[X - 1]) - (p[-X + 1] - p[-X - 1]));
    return d;
}

/// The distance to the zero of a level set, to first order, from its value and its slope; the value
/// itself in gaps that the grid does not resolve, where the slope says nothing of the distance.
inline __attribute__((always_inline)) float distanceOf(float phi, float slope)
{
    const float off = 1.0f - slope, trust = 1.0f - 25.0f * off * off;
    return phi * (1.0f + off * (trust > 0.0f ? trust : 0.0f));
}

} // namespace molsurf
