// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/covered_sphere.h"

#include "molsurf/kernel/core/simd.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

/// The middles of cells of a sphere: those of 8 x 8 squares of equal angles on each face of a cube.
/// Two rows of four make a bundle; bundles that follow each other lie on different sides.
struct SphereCells {
    static constexpr std::size_t edge = 8, count = 6 * edge * edge;
    std::array<float, count> x, y, z;
    float cosine, sine; ///< of rho, the largest angle between the middle and a place of a cell

    SphereCells()
    {
        constexpr std::size_t bundles = count / floatLanes, stride = 19; // no common divisor
        double least = 1.0;
        for (std::size_t k = 0; k < count; ++k) {
            const std::size_t bundle = k / floatLanes * stride % bundles, lane = k % floatLanes;
            const std::size_t face = bundle / edge, block = bundle % edge;
            const auto at = [&](double down, double right) {
                const std::size_t row = 2 * (block / 2) + lane / 4;
                const std::size_t column = 4 * (block % 2) + lane % 4;
                return direction(face, (double(row) + down) / edge,
                                 (double(column) + right) / edge);
            };
            const Vec3d middle = at(0.5, 0.5);
            x[k] = float(middle.x());
            y[k] = float(middle.y());
            z[k] = float(middle.z());
            for (const double down : {0.0, 1.0})
                for (const double right : {0.0, 1.0})
                    least = std::min(least, middle.dot(at(down, right)));
        }
        cosine = float(least);
        sine = float(std::sqrt((1.0 - least) * (1.0 + least)));
    }

    /// Of a place on a face of the cube, from 0 to 1 along its edges.
    static Vec3d direction(std::size_t face, double down, double right)
    {
        const auto along = [](double place) { return std::tan(M_PI_2 * (place - 0.5)); };
        const double u[3] = {face < 3 ? 1.0 : -1.0, along(down), along(right)};
        const std::size_t turn = face % 3;
        Vec3d out(u[turn], u[(turn + 1) % 3], u[(turn + 2) % 3]);
        out.normalize();
        return out;
    }
};

/// Whether each cell lies in a cap.
/// @param[in] reach  the least cosine of the angle from the axis of each cap to the middle of a
///                   cell that it holds
MOLSURF_KERNEL bool holdAllCells(const SphereCells& cells, const CapLists& caps, const float* reach)
{
    constexpr int ahead = 4; // caps before it is asked whether they suffice
    const int count = caps.size();
    for (std::size_t c = 0; c < SphereCells::count; c += floatLanes) {
        const Floats x = load(&cells.x[c]), y = load(&cells.y[c]), z = load(&cells.z[c]);
        Ints held = {};
        for (int k = 0; k < count && any(~held); k += ahead) {
            for (int l = k; l < k + ahead; ++l) { // the lists are padded
                const auto i = std::size_t(l);
                held |= caps.x[i] * x + caps.y[i] * y + caps.z[i] * z > reach[i];
            }
        }
        if (any(~held)) return false;
    }
    return true;
}

} // namespace

bool isSphereSurelyCovered(const CapLists& caps)
{
    constexpr float rounding = 3e-6f, never = 2.0f;
    static const SphereCells cells;
    thread_local std::vector<float> reach;
    reach.resize(caps.x.size());
    for (std::size_t k = 0; k < reach.size(); ++k) {
        const float within = caps.cosine[k] * cells.cosine + caps.sine[k] * cells.sine + rounding;
        reach[k] = caps.cosine[k] < cells.cosine ? within : never; // padding has a cosine above 1
    }
    return holdAllCells(cells, caps, reach.data());
}

} // namespace molsurf
