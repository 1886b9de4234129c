// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The evaluation of a cubic spline inside a kernel, in float, four z at a time. Lengths in voxels.

#include "molsurf/kernel/core/simd.h"

namespace molsurf
{

/// The four cubic B-splines that overlap a cell, at one place in it, and their derivatives.
struct SplineWeights {
    Floats4 value, first, second;
};

/// @param[in] t  place in the cell, in [0, 1]
MOLSURF_INLINE SplineWeights splineWeights(float t)
{
    constexpr float sixth = 1.0f / 6.0f;
    const Floats4 a = {-sixth, 0.5f, -0.5f, sixth}, b = {0.5f, -1.0f, 0.5f, 0.0f};
    const Floats4 c = {-0.5f, 0.0f, 0.5f, 0.0f}, d = {sixth, 4.0f * sixth, sixth, 0.0f};
    return {((a * t + b) * t + c) * t + d, (3.0f * a * t + 2.0f * b) * t + c,
            6.0f * a * t + 2.0f * b};
}

/// The sums of the elements of four vectors: of a transposed matrix.
MOLSURF_INLINE Floats4 sums(Floats4 a, Floats4 b, Floats4 c, Floats4 d)
{
    const Floats4 x =
        __builtin_shufflevector(a, b, 0, 4, 1, 5) + __builtin_shufflevector(a, b, 2, 6, 3, 7);
    const Floats4 y =
        __builtin_shufflevector(c, d, 0, 4, 1, 5) + __builtin_shufflevector(c, d, 2, 6, 3, 7);
    return __builtin_shufflevector(x, y, 0, 1, 4, 5) + __builtin_shufflevector(x, y, 2, 3, 6, 7);
}

/// Value and derivatives along x, y and z, with the 4^3 coefficients about a cell.
/// @param[in] c  coefficient at the cell's lowest corner, in an array whose z is contiguous
/// @param[in] t  place in the cell
MOLSURF_INLINE Floats4 splineGradient(const float* c, int strideX, int strideY, const float* t)
{
    const SplineWeights x = splineWeights(t[0]), y = splineWeights(t[1]), z = splineWeights(t[2]);
    // Contracted along x, then y; `sab` is the derivative of order a along x, b along y.
    Floats4 s00{}, s01{}, s10{};
    for (int j = 0; j < 4; ++j) {
        const float* row = c - strideX + (j - 1) * strideY - 1;
        Floats4 p{}, q{};
        for (int i = 0; i < 4; ++i) {
            const Floats4 v = load4(row + i * strideX);
            p += x.value[i] * v;
            q += x.first[i] * v;
        }
        s00 += y.value[j] * p;
        s01 += y.first[j] * p;
        s10 += y.value[j] * q;
    }
    return sums(s00 * z.value, s10 * z.value, s01 * z.value, s00 * z.first);
}

/// Value and all derivatives up to the second.
struct SplineJet {
    Floats4 first;  ///< value, x, y, z
    Floats4 second; ///< xx, yy, zz, xy
    Floats4 mixed;  ///< xz, yz, 0, 0
};

/// @param[in] row  row(i, j) has the four coefficients along z at x = i - 1, y = j - 1 from the
///                 cell's lowest corner
/// @param[in] t    place in the cell
template<typename Rows>
MOLSURF_INLINE SplineJet splineJet(const Rows& row, const float* t)
{
    const SplineWeights x = splineWeights(t[0]), y = splineWeights(t[1]), z = splineWeights(t[2]);
    Floats4 s00{}, s01{}, s02{}, s10{}, s11{}, s20{};
    for (int j = 0; j < 4; ++j) {
        Floats4 p{}, q{}, r{};
        for (int i = 0; i < 4; ++i) {
            const Floats4 v = row(i, j);
            p += x.value[i] * v;
            q += x.first[i] * v;
            r += x.second[i] * v;
        }
        s00 += y.value[j] * p;
        s01 += y.first[j] * p;
        s02 += y.second[j] * p;
        s10 += y.value[j] * q;
        s11 += y.first[j] * q;
        s20 += y.value[j] * r;
    }
    return {sums(s00 * z.value, s10 * z.value, s01 * z.value, s00 * z.first),
            sums(s20 * z.value, s02 * z.value, s00 * z.second, s11 * z.value),
            sums(s10 * z.first, s01 * z.first, Floats4{}, Floats4{})};
}

/// The arguments are those of splineGradient().
MOLSURF_INLINE SplineJet splineJet(const float* c, int strideX, int strideY, const float* t)
{
    const float* first = c - strideX - strideY - 1;
    const auto row = [&](int i, int j) __attribute__((always_inline))
    {
        return load4(first + i * strideX + j * strideY);
    };
    return splineJet(row, t);
}

} // namespace molsurf
