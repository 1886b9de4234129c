// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/levelset/jets.h"

#include "molsurf/kernel/spline/spline_lanes.h"

#include <cmath>

namespace molsurf
{

using openvdb::Vec3f;

namespace
{

/// Copies a jet to a lane. Its Hessian is xx yy zz xy and xz yz, that of lanes xx yy zz xy yz xz.
MOLSURF_INLINE void setJet(const SplineJet& jet, float scale, int lane, JetLanes& jets)
{
    jets.value[lane] = scale * jet.first[0];
    for (int a = 0; a < 3; ++a) jets.gradient[a][lane] = scale * jet.first[a + 1];
    for (int i = 0; i < 4; ++i) jets.hessian[i][lane] = scale * jet.second[i];
    jets.hessian[4][lane] = scale * jet.mixed[1];
    jets.hessian[5][lane] = scale * jet.mixed[0];
}

MOLSURF_KERNEL void evaluateIn(const float* c, int strideX, int strideY, const FootPoints::Lanes* y,
                               const bool* which, JetLanes& jets)
{
    for (int l = 0; l < lanes; ++l) {
        if (!which[l]) continue;
        const float cell[3] = {std::floor(y[0][l]), std::floor(y[1][l]), std::floor(y[2][l])};
        const float t[3] = {y[0][l] - cell[0], y[1][l] - cell[1], y[2][l] - cell[2]};
        const float* at = c + int(cell[0]) * strideX + int(cell[1]) * strideY + int(cell[2]);
        setJet(splineJet(at, strideX, strideY, t), 1.0f, l, jets);
    }
}

/// The 4^3 coefficients about a cell, which lie in up to eight leaves.
struct Corners {
    const float* leaf[2][2][2]; ///< those that hold its lower and upper ends along each axis
    int first[3];               ///< where they begin in the lowest of these leaves, in [0, 8)
};

/// The jet in a cell whose coefficients lie in several leaves.
/// @tparam shift  0: all four coefficients of a row lie in the lower leaf; else the last `shift` of
///                them lie in the upper leaf, after those from z = 4 + shift in the lower one
template<int shift>
MOLSURF_INLINE SplineJet jetAcross(const Corners& c, const float* t)
{
    const auto row = [&](int i, int j) __attribute__((always_inline))
    {
        const int x = c.first[0] + i, y = c.first[1] + j, place = 64 * (x & 7) + 8 * (y & 7);
        const auto* column = c.leaf[x >> 3][y >> 3];
        if constexpr (shift == 0) {
            return load4(column[0] + place + c.first[2]);
        } else {
            return Floats4(__builtin_shufflevector(load4(column[0] + place + 4),
                                                   load4(column[1] + place), shift, shift + 1,
                                                   shift + 2, shift + 3));
        }
    };
    return splineJet(row, t);
}

/// The jet of a point whose stencil crosses leaves; the column of rows is a template argument.
MOLSURF_INLINE void evaluateAcross(const Corners& c, const float* t, float scale, int lane,
                                   JetLanes& jets)
{
    switch (c.first[2]) {
    case 5:
        return setJet(jetAcross<1>(c, t), scale, lane, jets);
    case 6:
        return setJet(jetAcross<2>(c, t), scale, lane, jets);
    case 7:
        return setJet(jetAcross<3>(c, t), scale, lane, jets);
    default:
        return setJet(jetAcross<0>(c, t), scale, lane, jets);
    }
}

} // namespace

void jetsIn(const LeafBlock<float, 3>& c, const FootPoints::Lanes* y, const bool* which,
            JetLanes& jets)
{
    evaluateIn(c.at(0, 0, 0), c.strideX, c.strideY, y, which, jets);
}

MOLSURF_KERNEL void jetBeside(const SparseField& coefficients, std::int32_t leaf, const Vec3f& y,
                              int lane, JetLanes& jets)
{
    alignas(64) static constexpr float none[leafSize] = {};
    const auto& near = coefficients.table.neighbours(leaf);
    Corners c;
    float t[3];
    int side[3][2];    // 0, 1 or 2: the leaf before, this one or the next along an axis
    bool about = true; // whether all coefficients lie in these leaves
    for (int a = 0; a < 3; ++a) {
        const float cell = clamped(std::floor(y[a]), -64.0f, 64.0f); // so that it fits an int
        const int begin = int(cell) - 1;
        t[a] = clamped(y[a] - cell, 0.0f, 1.0f);
        c.first[a] = begin & 7;
        side[a][0] = (begin >> 3) + 1;
        side[a][1] = ((begin + 3) >> 3) + 1;
        about = about && side[a][0] >= 0 && side[a][1] <= 2;
    }
    for (int i = 0; i < 8; ++i) {
        const int place = 9 * side[0][i >> 2] + 3 * side[1][i >> 1 & 1] + side[2][i & 1];
        const std::int32_t m = about ? near[std::size_t(place)] : noLeaf;
        c.leaf[i >> 2][i >> 1 & 1][i & 1] = m == noLeaf ? none : coefficients.leaf(m);
    }
    evaluateAcross(c, t, float(1.0 / coefficients.voxelSize), lane, jets);
}

} // namespace molsurf
