// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/boundary_check.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/core/simd.h"
#include "molsurf/kernel/core/strings.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

constexpr std::size_t bundle = floatLanes; // directions side by side

/// Directions that are spread evenly, any run of them too: Roberts' low-discrepancy sequence R2 on
/// a cylinder about the sphere. It adds 1/g and 1/g^2 modulo 1, g being the plastic number 1.3247.
struct Directions {
    static constexpr std::size_t count = 1 << 13;
    std::array<float, count> x, y, z;

    Directions()
    {
        for (std::size_t k = 0; k < count; ++k) {
            const double u = 0.7548776662466927 * double(k), v = 0.5698402909980532 * double(k);
            const double height =
                1.0 - 2.0 * (u - std::floor(u) + 0.5 / count) / (1.0 + 1.0 / count);
            const double angle = 2.0 * M_PI * (v - std::floor(v));
            const double wide = std::sqrt(std::max(0.0, 1.0 - height * height));
            x[k] = float(wide * std::cos(angle));
            y[k] = float(wide * std::sin(angle));
            z[k] = float(height);
        }
    }
};

const Directions& directions()
{
    static const Directions table;
    return table;
}

/// What rays from the centre of a sphere of radius 1 have of its cell.
struct RayCubes {
    double sum = 0.0, squares = 0.0; ///< of end^3 - begin^3, where they enter and leave
};

/// Clips sixteen rays at a time by the planes of the caps.
/// @param[in] first  of the directions, a multiple of 16, as is their number
MOLSURF_KERNEL RayCubes cubesOf(const Directions& u, std::size_t first, std::size_t rays,
                                const CapLists& caps)
{
    constexpr float flat = 1e-3f; // a plane this near the centre, in radii
    constexpr std::size_t pair = 2;
    Floats sum = splat(0.0f), squares = splat(0.0f); // rounding is far below the rays' own error
    for (std::size_t r = 0; r < rays; r += pair * bundle) {
        Floats x[pair], y[pair], z[pair], begin[pair], end[pair];
        Floats inverse[pair]; // of the end, by the planes with the centre on the near side
        for (std::size_t p = 0; p < pair; ++p) {
            const std::size_t d = (first + r + p * bundle) % Directions::count;
            x[p] = load(&u.x[d]);
            y[p] = load(&u.y[d]);
            z[p] = load(&u.z[d]);
            begin[p] = splat(0.0f);
            end[p] = inverse[p] = splat(1.0f);
        }
        for (std::size_t k = 0; k < std::size_t(caps.size()); ++k) {
            const bool isNear = caps.cosine[k] > flat; // as nearly always
            const float scale = isNear ? 1.0f / caps.cosine[k] : 1.0f;
            const float cx = scale * caps.x[k], cy = scale * caps.y[k], cz = scale * caps.z[k];
            for (std::size_t p = 0; p < pair; ++p) {
                const Floats along = cx * x[p] + cy * y[p] + cz * z[p];
                if (isNear) {
                    inverse[p] = larger(along, inverse[p]);
                    continue;
                }
                const Floats at = caps.cosine[k] / along; // beyond the plane where t along > cosine
                end[p] = smaller(along > 0.0f ? at : splat(2.0f), end[p]);
                begin[p] = larger(along < 0.0f ? at : splat(-1.0f), begin[p]);
            }
        }
        for (std::size_t p = 0; p < pair; ++p) {
            // A ray that misses the cell leaves before it enters.
            const Floats last = larger(begin[p], smaller(1.0f / inverse[p], end[p]));
            const Floats cubes = last * last * last - begin[p] * begin[p] * begin[p];
            sum += cubes;
            squares += cubes * cubes;
        }
    }
    RayCubes out;
    for (int k = 0; k < floatLanes; ++k) {
        out.sum += double(sum[k]);
        out.squares += double(squares[k]);
    }
    return out;
}

/// Counts the directions among eight that no cap of a range holds.
MOLSURF_KERNEL int countUncovered(const float* ux, const float* uy, const float* uz,
                                  const CapLists& caps, std::size_t begin, std::size_t end)
{
    const Floats x = load(ux), y = load(uy), z = load(uz);
    Ints covered = {};
    for (std::size_t k = begin; k < end; ++k)
        covered |= caps.x[k] * x + caps.y[k] * y + caps.z[k] * z > caps.cosine[k];
    return floatLanes - __builtin_popcount(bitsOf(covered & (splat(1) << laneNumbers())));
}

/// The share of a patch's sphere that is uncovered, by a number of directions.
double uncoveredShare(const BallBoundary& boundary, const Patch& patch, std::size_t first,
                      std::size_t count)
{
    const Directions& u = directions();
    int uncovered = 0;
    for (std::size_t k = 0; k < count; k += bundle) {
        const std::size_t at = (first + k) % Directions::count;
        uncovered += countUncovered(&u.x[at], &u.y[at], &u.z[at], boundary.caps, patch.capsBegin,
                                    patch.capsEnd);
    }
    return double(uncovered) / double(count);
}

[[noreturn]] void disagree(const char* what, double one, double other)
{
    throw Error(ErrorKind::Check, formatted("%s: %.8g and %.8g disagree", what, one, other));
}

/// Areas from loops are wrong by multiples of a quarter of the sphere, if they are wrong.
void checkArea(const BallBoundary& boundary, std::size_t p, double area)
{
    constexpr std::size_t few = 64, many = 4096;
    constexpr double suspicious = 0.15, wrong = 0.05; // of the sphere
    const Patch& patch = boundary.patches[p];
    const double share = area / (4.0 * M_PI * patch.radius * patch.radius);
    if (std::abs(share - uncoveredShare(boundary, patch, few * p, few)) < suspicious) return;
    const double exact = uncoveredShare(boundary, patch, 0, many);
    if (std::abs(share - exact) > wrong)
        disagree("boundary: shares of a sphere that are free, by loops and by samples", share,
                 exact);
}

} // namespace

std::size_t raysFor(std::size_t balls)
{
    constexpr std::size_t all = 1 << 18, least = 16, most = 1024;
    return std::clamp(all / std::max<std::size_t>(balls, 1) / least * least, least, most);
}

CellVolume sampleCell(const CapLists& caps, double radius, std::int32_t i, std::size_t rays)
{
    const double ball = 4.0 / 3.0 * M_PI * radius * radius * radius, n = double(rays);
    if (caps.size() == 0) return {ball, 0.0};
    const RayCubes cubes = cubesOf(directions(), std::size_t(i) * rays, rays, caps);
    const double mean = cubes.sum / n;
    return {ball * mean, ball * ball * std::max(cubes.squares / n - mean * mean, 0.0) / n};
}

void checkBoundary(const BallBoundary& boundary, const BoundaryMeasure& measure,
                   const Progress& progress)
{
    parallelFor(boundary.patches.size(), progress,
                [&](std::size_t p) { checkArea(boundary, p, measure.patchAreas[p]); });

    std::size_t outer = 0;
    double volume = 0.0;
    for (const BoundaryPiece& piece : measure.pieces) {
        constexpr double rounding = 1e-9; // [Å^3]
        const int chi = piece.eulerCharacteristic;
        if (chi > 2 || chi % 2 != 0)
            disagree("boundary: Euler number of a piece and 2 - 2 genus", chi, 2);
        if (!(piece.area > 0.0)) disagree("boundary: area of a piece and 0", piece.area, 0.0);
        if ((piece.outer ? piece.volume : -piece.volume) < -rounding)
            disagree("boundary: volume of an outer piece or a cavity and 0", piece.volume, 0.0);
        volume += piece.volume;
        outer += piece.outer;
    }
    if (!boundary.estimate) return;
    const UnionEstimate& estimate = *boundary.estimate;
    if (outer != estimate.components)
        disagree("boundary: outer pieces and parts that hang together", double(outer),
                 double(estimate.components));
    constexpr double deviations = 8.0, floor = 0.003; // of the volume
    if (std::abs(volume - estimate.volume) > deviations * estimate.error + floor * volume)
        disagree("boundary: volume by patches and by power cells", volume, estimate.volume);
}

BoundaryMeasure checkedMeasure(const BallBoundary& boundary, const Progress& progress)
{
    BoundaryMeasure measure = measureBoundary(boundary, progress);
    checkBoundary(boundary, measure, progress);
    return measure;
}

MeshTolerance meshTolerance(const BallBoundary& boundary, const BoundaryMeasure& measure,
                            double voxel)
{
    double creases = 0.0, bends = 0.0;
    for (const Arc& arc : boundary.arcs) creases += 2.0 * arc.half * arc.radius;
    for (std::size_t p = 0; p < boundary.patches.size(); ++p)
        bends += measure.patchAreas[p] / boundary.patches[p].radius;
    return {voxel * (creases + 1.5 * bends), 0.4 * voxel * voxel * (creases + bends)};
}

void checkMesh(double exactArea, double exactVolume, double meshArea, double meshVolume,
               const MeshTolerance& tolerance)
{
    if (!(std::abs(meshArea - exactArea) <= tolerance.area))
        disagree("mesh: area in closed form and of the triangles", exactArea, meshArea);
    if (!(std::abs(meshVolume - exactVolume) <= tolerance.volume))
        disagree("mesh: volume in closed form and of the triangles", exactVolume, meshVolume);
}

} // namespace molsurf
