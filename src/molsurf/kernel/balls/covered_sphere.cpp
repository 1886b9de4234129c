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

/// The middles of cells of a sphere: those of 4 x 4 squares of equal angles on each face of a cube,
/// and of their 4 x 4 parts. Two rows of four make a bundle; bundles of squares that follow each
/// other lie on different sides.
template<std::size_t Parts>
struct SphereCells {
    static constexpr std::size_t edge = 4, squares = 6 * edge * edge,
                                 count = squares * Parts * Parts;
    std::array<float, count> x, y, z; ///< of each square all parts, one square after the other
    float cosine, sine; ///< of rho, the largest angle between the middle and a place of a cell

    SphereCells()
    {
        constexpr std::size_t bundles = squares / floatLanes, stride = 7; // no common divisor
        double least = 1.0;
        for (std::size_t k = 0; k < count; ++k) {
            const std::size_t square = k / (Parts * Parts), part = k % (Parts * Parts);
            const std::size_t bundle = square / floatLanes * stride % bundles, face = bundle / 2;
            const std::size_t row = 2 * (bundle % 2) + square % floatLanes / 4, column = square % 4;
            const auto at = [&](double down, double right) {
                return direction(face, (double(row) + (double(part / Parts) + down) / Parts) / edge,
                                 (double(column) + (double(part % Parts) + right) / Parts) / edge);
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

    /// The least cosine of the angle from the axis of each cap to the middle of a cell that it
    /// holds.
    void reachOf(const CapLists& caps, std::size_t number, float error,
                 std::vector<float>& reach) const
    {
        constexpr float never = 2.0f;
        reach.assign(number + floatLanes, never);
        for (std::size_t k = 0; k < number; ++k) {
            const float within = caps.cosine[k] * cosine + caps.sine[k] * sine + error;
            reach[k] = caps.cosine[k] < cosine ? within : never;
        }
    }
};
using Squares = SphereCells<1>;
using SquareParts = SphereCells<4>;

/// Which of eight cells lie in no cap.
MOLSURF_INLINE Ints openCells(const float* cellX, const float* cellY, const float* cellZ,
                              const CapLists& caps, const std::vector<float>& reach)
{
    constexpr std::size_t ahead = 4; // caps before it is asked whether they suffice
    const Floats x = load(cellX), y = load(cellY), z = load(cellZ);
    Ints open = splat(-1);
    for (std::size_t k = 0; k + floatLanes < reach.size() && any(open); k += ahead)
        for (std::size_t l = k; l < k + ahead; ++l) // the lists are padded; a NaN holds nothing
            open &= ~(caps.x[l] * x + caps.y[l] * y + caps.z[l] * z > reach[l]);
    return open;
}

/// Whether each square lies in a cap, or each of its parts does.
/// @param[in] reach,reachOfPart  of SphereCells::reachOf()
MOLSURF_KERNEL bool holdAllCells(const Squares& cells, const SquareParts& parts,
                                 const CapLists& caps, const std::vector<float>& reach,
                                 const std::vector<float>& reachOfPart)
{
    for (std::size_t c = 0; c < Squares::count; c += floatLanes) {
        const Ints open = openCells(&cells.x[c], &cells.y[c], &cells.z[c], caps, reach);
        for (std::uint32_t bits = bitsOf(open & laneBits()); bits != 0; bits &= bits - 1) {
            const std::size_t first = 16 * (c + std::size_t(__builtin_ctz(bits)));
            for (std::size_t p = first; p < first + 16; p += floatLanes)
                if (any(openCells(&parts.x[p], &parts.y[p], &parts.z[p], caps, reachOfPart)))
                    return false;
        }
    }
    return true;
}

} // namespace

bool isSphereSurelyCovered(const CapLists& caps, std::size_t count, float error)
{
    static const Squares cells;
    static const SquareParts parts;
    thread_local std::vector<float> reach, reachOfPart;
    cells.reachOf(caps, count, error, reach);
    parts.reachOf(caps, count, error, reachOfPart);
    return holdAllCells(cells, parts, caps, reach, reachOfPart);
}

} // namespace molsurf
