// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/boundary_check.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/orthonormal_basis.h"
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

constexpr std::size_t ahead = 4; // caps, large ones first, before it is asked whether they suffice

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

/// Parallel lines through the points of a square lattice, in a frame of their own: along z, through
/// x and y at all multiples of a spacing. The frame is that of no crystal.
struct Lines {
    Vec3d x, y, z;  ///< unit vectors
    double spacing; ///< [Å]

    /// Such that spheres have 32,768 points with lines, or 16 each if they are very many.
    explicit Lines(const std::vector<Patch>& patches) : z(0.36137, 0.48291, -0.79764)
    {
        constexpr double points = 1 << 15, least = 16.0;
        z.normalize();
        x = perpendicular(z)[0] * std::cos(1.0) + perpendicular(z)[1] * std::sin(1.0);
        y = z.cross(x);
        double area = 0.0; // of disks
        for (const Patch& patch : patches) area += M_PI * patch.radius * patch.radius;
        spacing = std::sqrt(area / std::max(points, least * double(patches.size())));
    }
};

/// The sum over free points of lines: of the height of points where they leave a union, less that
/// where they enter. So it is the length within it.
struct LineSum {
    double length = 0.0;   ///< [Å]
    double variance = 0.0; ///< of it, at most [Å^2]
    LineSum& operator+=(const LineSum& o)
    {
        length += o.length;
        variance += o.variance;
        return *this;
    }
};

/// The free points of lines on a sphere about 0.
/// @param[in] caps  in the frame of the lines, their cosines multiplied by the radius
/// @param[in] x,y   of the lines with the least ones
/// @param[in] lift  of the centre, by which heights are larger
MOLSURF_KERNEL LineSum sumOf(const CapLists& caps, float radius, float spacing, float x, float y,
                             double lift)
{
    Floats heights = splat(0.0f), squares = splat(0.0f);
    Ints leaving = {}; // less entering
    for (; y < radius; y += spacing) {
        for (float first = x; first < radius; first += spacing * floatLanes) {
            const Floats along = first + spacing * __builtin_convertvector(laneNumbers(), Floats);
            const Floats rest = radius * radius - y * y - along * along;
            const Ints crossed = rest > 0.0f;
            const Floats height = squareRoot(larger(rest, splat(0.0f)));
            Ints above = crossed, below = crossed;
            const auto count = std::size_t(caps.size());
            for (std::size_t from = 0; from < count && any(above | below); from += ahead) {
                for (std::size_t k = from; k < from + ahead; ++k) { // the lists are padded
                    const Floats beyond = caps.x[k] * along + (caps.y[k] * y - caps.cosine[k]);
                    const Floats up = caps.z[k] * height;
                    above &= beyond + up <= 0.0f;
                    below &= beyond - up <= 0.0f;
                }
            }
            leaving += below - above; // all bits are -1
            heights -= height * __builtin_convertvector(above + below, Floats);
            // A line stands for a cell in which the height varies by the slope times the spacing.
            const Floats slope2 =
                (along * along + y * y) / larger(rest, splat(0.25f * radius * spacing));
            squares -= slope2 * __builtin_convertvector(above + below, Floats);
        }
    }
    LineSum out;
    for (int k = 0; k < floatLanes; ++k) {
        out.length += double(heights[k]) + lift * double(leaving[k]);
        out.variance += double(squares[k]) * double(spacing) * double(spacing) / 12.0;
    }
    return out;
}

/// @param[in] origin  a place near the patch's part of the union
LineSum sumOf(const BallBoundary& boundary, const Patch& patch, const Lines& lines,
              const Vec3d& origin)
{
    thread_local CapLists caps;
    const std::size_t count = patch.capsEnd - patch.capsBegin;
    caps.resize(count);
    const Vec3d &x = lines.x, &y = lines.y, &z = lines.z;
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t from = patch.capsBegin + k;
        const Vec3d axis(boundary.caps.x[from], boundary.caps.y[from], boundary.caps.z[from]);
        caps.x[k] = float(axis.dot(x));
        caps.y[k] = float(axis.dot(y));
        caps.z[k] = float(axis.dot(z));
        caps.cosine[k] = boundary.caps.cosine[from] * float(patch.radius);
    }
    std::fill_n(caps.cosine.begin() + std::ptrdiff_t(count), floatLanes,
                2.0f * float(patch.radius));
    const auto least = [&](double centre) {
        const double h = lines.spacing;
        return float(h * std::ceil((centre - patch.radius) / h) - centre);
    };
    return sumOf(caps, float(patch.radius), float(lines.spacing), least(patch.centre.dot(x)),
                 least(patch.centre.dot(y)), (patch.centre - origin).dot(z));
}

[[noreturn]] void disagree(const char* what, double one, double other)
{
    throw Error(ErrorKind::Check, formatted("%s: %.8g and %.8g disagree", what, one, other));
}

/// Checks the sum of the pieces' volumes.
void checkVolume(const BallBoundary& boundary, double volume, const Progress& progress)
{
    const std::vector<Patch>& patches = boundary.patches;
    const Lines lines(patches);
    // Points of one component have an origin of their own, so that lengths do not cancel far from
    // 0.
    std::vector<Vec3d> origins;
    for (const Patch& patch : patches)
        if (patch.component == std::int32_t(origins.size())) origins.push_back(patch.centre);
    const LineSum sum = parallelSum<LineSum>(patches.size(), progress, [&](std::size_t p) {
        const std::int32_t component = patches[p].component;
        return sumOf(boundary, patches[p], lines,
                     component < 0 ? patches[0].centre : origins[std::size_t(component)]);
    });
    constexpr double deviations = 8.0, floor = 0.003; // of the volume
    const double cell = lines.spacing * lines.spacing, byLines = cell * sum.length;
    if (std::abs(volume - byLines) > deviations * cell * std::sqrt(sum.variance) + floor * volume)
        disagree("boundary: volume by patches and by lines", volume, byLines);
}

/// The share of directions that no cap of a range holds.
/// @param[in] first  of the directions, a multiple of 8, as is their number
MOLSURF_KERNEL double uncoveredShare(const Directions& u, std::size_t first, std::size_t count,
                                     const CapLists& caps, std::size_t begin, std::size_t end)
{
    int uncovered = 0;
    for (std::size_t d = first; d < first + count; d += floatLanes) {
        const std::size_t at = d % Directions::count;
        const Floats x = load(&u.x[at]), y = load(&u.y[at]), z = load(&u.z[at]);
        Ints open = splat(-1);
        for (std::size_t from = begin; from < end && any(open); from += ahead)
            for (std::size_t k = from; k < std::min(from + ahead, end); ++k)
                open &= caps.x[k] * x + caps.y[k] * y + caps.z[k] * z <= caps.cosine[k];
        uncovered += __builtin_popcount(bitsOf(open & laneBits()));
    }
    return double(uncovered) / double(count);
}

/// Areas from loops are wrong by multiples of a quarter of the sphere, if they are wrong.
void checkArea(const BallBoundary& boundary, std::size_t p, double area)
{
    constexpr std::size_t few = 64, many = 4096;
    constexpr double suspicious = 0.15, wrong = 0.05; // of the sphere
    const Patch& patch = boundary.patches[p];
    const auto shareOf = [&](std::size_t first, std::size_t count) {
        return uncoveredShare(directions(), first, count, boundary.caps, patch.capsBegin,
                              patch.capsEnd);
    };
    const double share = area / (4.0 * M_PI * patch.radius * patch.radius);
    if (std::abs(share - shareOf(few * p, few)) < suspicious) return;
    const double exact = shareOf(0, many);
    if (std::abs(share - exact) > wrong)
        disagree("boundary: shares of a sphere that are free, by loops and by samples", share,
                 exact);
}

} // namespace

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
    if (boundary.components && outer != *boundary.components)
        disagree("boundary: outer pieces and parts that hang together", double(outer),
                 double(*boundary.components));
    if (!boundary.patches.empty()) checkVolume(boundary, volume, progress);
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
