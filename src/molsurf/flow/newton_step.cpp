// SPDX-License-Identifier: MPL-2.0
#include "molsurf/flow/newton_step.h"

#include "molsurf/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace molsurf
{

namespace
{

constexpr float outside = 1e30f; // u where the system is not solved
constexpr float known = 1e29f;   // u below this is a solution
constexpr int footReach = 4;     // rim of u that feet lie in [voxel]

// Added to the stiffness [1/Å^2]: where the metric is flat the surface moves as a whole over some
// 3 Å in a step.
constexpr float leastStiffness = 0.1f;

// Where all displacements of a leaf are below this, they are the steps, and leave no history
// [voxel].
constexpr float noHistory = 0.04f, noHistoryOfExtended = 0.01f;

/// Two positive or negative floats in one word, each to a relative 0.002 (bfloat16): enough for
/// coefficients, since rest is where b is 0.
MOLSURF_INLINE std::uint32_t packed(float b, float c)
{
    std::uint32_t high, low;
    std::memcpy(&high, &b, sizeof high);
    std::memcpy(&low, &c, sizeof low);
    return ((high + 0x8000u) & 0xffff0000u) | (low + 0x8000u) >> 16;
}
MOLSURF_INLINE float highOf(std::uint32_t word)
{
    const std::uint32_t bits = word & 0xffff0000u;
    float b;
    std::memcpy(&b, &bits, sizeof b);
    return b;
}
MOLSURF_INLINE float lowOf(std::uint32_t word)
{
    const std::uint32_t bits = word << 16;
    float c;
    std::memcpy(&c, &bits, sizeof c);
    return c;
}

/// Coefficients of  (c + number of neighbours) u = b + sum of the neighbours' u,  with c = P h^2/w
/// and b = F h^2/w, and a first u.
MOLSURF_KERNEL void coefficientRows(const float* __restrict phiBlock,
                                    const float* __restrict psiBlock,
                                    const LeafCurvature& __restrict shape, const LeafMask& acting,
                                    float h, const Weights weights, InterfaceRows& __restrict sums,
                                    std::uint32_t* __restrict system, float* __restrict u)
{
    using Block = LeafBlock<float, 1>;
    const float inverse = 1.0f / h, h2 = h * h;
    for (int row = 0; row < 64; ++row) {
        const int bits = acting.row(row);
        const int first = (row / 8 + 1) * Block::strideX + (row % 8 + 1) * Block::strideY + 1;
        const float *p = phiBlock + first, *q = psiBlock + first;
        if (bits == 0) {
            for (int z = 0; z < 8; ++z) u[8 * row + z] = outside;
            continue;
        }
        for (int z = 0; z < 8; ++z) {
            const int v = 8 * row + z;
            const float phi = distanceOf(p[z], shape.slope[v]);
            const Front front = frontAt(q + z, shape, v, phi, inverse, weights);
            const Metric& m = front.metric;
            // Outward there may be no valley to stop in: beyond its shoulder w flattens out.
            const float valley = front.speed < 0.0f ? m.tangent : m.secant;
            // What curvature takes of it at rest, where n . grad w = -w kappa:
            // w (kappa^2 + k1^2 + k2^2).
            const float bend = 2.0f * m.w * (front.kappa * front.kappa - front.gauss);
            const float P = larger(valley - bend, 0.0f) + leastStiffness;
            const float scale = h2 / larger(m.w, 1e-4f);
            const float b = scale * front.speed, c = scale * P;
            system[v] = packed(b, c);
            u[v] = bits & rowBits[z] ? b / (c + 6.0f) : outside;
            const float on = bits & rowBits[z] ? 1.0f : 0.0f;
            addVoxel(front, shape, row, z, p[z], phi, h, on, sums);
        }
    }
}

/// One sweep: out <- out + omega (J(u) - out), J being Jacobi's.
/// @param[in] keep  0: out has no values yet, and counts as 0; else 1
MOLSURF_KERNEL void sweepRows(const float* __restrict uBlock, const LeafMask& acting,
                              const std::uint32_t* __restrict system, float omega, float keep,
                              float* __restrict out)
{
    constexpr int X = LeafBlock<float, 1>::strideX, Y = LeafBlock<float, 1>::strideY;
    for (int row = 0; row < 64; ++row) {
        const int bits = acting.row(row);
        if (bits == 0) {
            for (int z = 0; z < 8; ++z) out[8 * row + z] = outside;
            continue;
        }
        const float* p = uBlock + (row / 8 + 1) * X + (row % 8 + 1) * Y + 1;
        for (int z = 0; z < 8; ++z) {
            const int v = 8 * row + z;
            float sum = 0.0f, count = 0.0f;
            for (const int step : {X, -X, Y, -Y, 1, -1}) {
                const float u = p[z + step];
                sum += u < known ? u : 0.0f;
                count += u < known ? 1.0f : 0.0f;
            }
            const float jacobi = (highOf(system[v]) + sum) / (lowOf(system[v]) + count);
            const float before = keep > 0.0f ? out[v] : 0.0f;
            const float next = before + omega * (jacobi - before);
            out[v] = bits & rowBits[z] ? next : outside;
        }
    }
}

/// u at the feet of a leaf's voxels, and |grad phi| there; 0 beside the active ones.
MOLSURF_KERNEL void feetRows(const float* __restrict phiBlock, const float* __restrict uBlock,
                             const LeafMask& active, float h, float* __restrict atFoot,
                             float* __restrict slope)
{
    constexpr int X = LeafBlock<float, 1>::strideX, Y = LeafBlock<float, 1>::strideY;
    constexpr int UX = LeafBlock<float, footReach>::strideX;
    constexpr int UY = LeafBlock<float, footReach>::strideY;
    const float inverse = 1.0f / h;
    for (int row = 0; row < 64; ++row) {
        const int bits = active.row(row);
        const float* p = phiBlock + (row / 8 + 1) * X + (row % 8 + 1) * Y + 1;
        const float* q =
            uBlock + (row / 8 + footReach) * UX + (row % 8 + footReach) * UY + footReach;
        if (bits == 0) {
            for (int z = 0; z < 8; ++z) atFoot[8 * row + z] = slope[8 * row + z] = 0.0f;
            continue;
        }
        alignas(32) std::int32_t cell[8];
        alignas(32) float tx[8], ty[8], tz[8], slopes[8], sum[8] = {}, weight[8] = {};
        for (int z = 0; z < 8; ++z) {
            const float* c = p + z;
            const float gx = c[X] - c[-X], gy = c[Y] - c[-Y], gz = c[1] - c[-1];
            const float norm = std::sqrt(gx * gx + gy * gy + gz * gz) + 1e-6f * h;
            slopes[z] = 0.5f * norm * inverse;
            const float way = clamped(distanceOf(c[0], slopes[z]) * inverse, -3.0f, 3.0f) / norm;
            const float fx = float(footReach) - way * gx, fy = float(footReach) - way * gy;
            const float fz = float(footReach) - way * gz; // > 0
            const int ix = int(fx), iy = int(fy), iz = int(fz);
            tx[z] = fx - float(ix);
            ty[z] = fy - float(iy);
            tz[z] = fz - float(iz);
            cell[z] = (ix - footReach) * UX + (iy - footReach) * UY + (iz - footReach) + z;
        }
        // u at the foot, from those corners of its cell where it is known. All are read before any
        // is used: a vector cannot be loaded while its parts are still being stored.
        alignas(64) float pairs[4][16]; // corners that are neighbours in memory
        for (int k = 0; k < 4; ++k) {
            const float* corner = q + (k >> 1) * UX + (k & 1) * UY;
            for (int z = 0; z < 8; ++z)
                std::memcpy(pairs[k] + 2 * z, corner + cell[z], 2 * sizeof(float));
        }
        for (int k = 0; k < 4; ++k) {
            for (int z = 0; z < 8; ++z) {
                const float w = (k & 2 ? tx[z] : 1.0f - tx[z]) * (k & 1 ? ty[z] : 1.0f - ty[z]);
                const float below = pairs[k][2 * z], above = pairs[k][2 * z + 1];
                const float wBelow = below < known ? w * (1.0f - tz[z]) : 0.0f;
                const float wAbove = above < known ? w * tz[z] : 0.0f;
                sum[z] += wBelow * smaller(below, 1e6f) + wAbove * smaller(above, 1e6f);
                weight[z] += wBelow + wAbove;
            }
        }
        for (int z = 0; z < 8; ++z) {
            const float own = q[z] < known ? q[z] : 0.0f;
            const bool hasFoot = (slopes[z] > 0.5f) & (weight[z] > 0.3f);
            const float u = hasFoot ? sum[z] / larger(weight[z], 0.1f) : own;
            atFoot[8 * row + z] = bits & rowBits[z] ? u : 0.0f;
            slope[8 * row + z] = slopes[z];
        }
    }
}

/// The steps that are made of a leaf's displacements.
/// @param[in,out] history  of the step before; then of this one
MOLSURF_KERNEL void chooseSteps(const float* __restrict atFoot, float h, bool extended,
                                StepHistory& __restrict history, float* __restrict step)
{
    for (int v = 0; v < leafSize; ++v) {
        const float u = atFoot[v], last = history.step[v];
        const float share = shareOfStep(u, last, 1.0f - history.lost[v]);
        const float whole = extended ? extendedStep(u, history.u[v], last, h) : u;
        step[v] = clamped(share * whole, -longestStep * h, longestStep * h);
        history.u[v] = u;
        history.step[v] = step[v];
        history.lost[v] = 1.0f - share;
    }
}

/// phi after the step.
MOLSURF_KERNEL void moveRows(const float* __restrict phi, const float* __restrict slope,
                             const float* __restrict step, const LeafMask& active,
                             float* __restrict next)
{
    for (int row = 0; row < 64; ++row) {
        const int bits = active.row(row);
        for (int z = 0; z < 8; ++z) {
            const int v = 8 * row + z;
            const float on = bits & rowBits[z] ? 1.0f : 0.0f;
            next[v] = phi[v] + on * smaller(slope[v], 1.0f) * step[v];
        }
    }
}

} // namespace

/// Makes fields for the leaves of a table; leaves that are new have not moved yet.
void NewtonSteps::fit(const LeafTable& table, const Progress& progress)
{
    acting_.assign(table.size(), LeafMask());
    if (known_.size() == table.size() && table.size() > 0) return; // leaves are never dropped
    u_ = LeafField();
    u_ = LeafField(table.size());
    system_ = LeafArray<std::uint32_t>();
    system_ = LeafArray<std::uint32_t>(table.size());
    std::vector<std::unique_ptr<StepHistory>> history(table.size());
    parallelFor(table.size(), progress, [&](std::size_t n) {
        const std::int32_t m = known_.find(table.origin(n));
        if (m == noLeaf) return;
        history[n] = std::move(history_[std::size_t(m)]);
    });
    history_ = std::move(history);
    known_ = table;
}

/// Sweeps; the Chebyshev weights are those of eigenvalues of Jacobi's iteration in [-rho, rho], rho
/// such that all sweeps together lessen them tenfold. Smoother errors fall more slowly, and none
/// grows.
void NewtonSteps::sweep(const LeafTable& table, LeafField& scratch, const Progress& progress)
{
    constexpr double lessening = 10.0;
    const double rho = 1.0 / std::cosh(std::acosh(lessening) / options_.sweeps);
    double omega = 1.0;
    for (int i = 1; i < options_.sweeps; ++i) {
        omega = 1.0 / (1.0 - rho * rho * (i == 1 ? 0.5 : 0.25 * omega));
        parallelFor(table.size(), progress, [&](std::size_t n) {
            if (!acting_[n].any()) {
                if (i == 1) std::fill_n(scratch.leaf(n), leafSize, outside);
                return;
            }
            LeafBlock<float, 1> u;
            u.gather(table, u_, n);
            sweepRows(u.values, acting_[n], system_.leaf(n), float(omega), i == 1 ? 0.0f : 1.0f,
                      scratch.leaf(n));
        });
        std::swap(u_, scratch);
    }
}

InterfaceSums NewtonSteps::sums(const NarrowBand& band, const Region& region,
                                const Progress& progress)
{
    const LeafTable& table = band.phi.table;
    fit(table, progress);
    const double h = band.phi.voxelSize;
    const openvdb::Coord first = sumOrigin(table, region);
    Spline coarse;
    if (options_.splineLevel > 0) coarse = splineOf(band.phi, options_.splineLevel, progress);
    return parallelSum<InterfaceSums>(table.size(), progress, [&](std::size_t n) {
        acting_[n] = table.active(n) & within(band.phi.leaf(n), float(newtonWidthVox * h));
        if (!acting_[n].any()) {
            std::fill_n(u_.leaf(n), leafSize, outside);
            return InterfaceSums();
        }
        LeafBlock<float, 1> phi, psi;
        phi.gather(band.phi, n);
        psi.gather(table, band.psi, n);
        LeafCurvature shape;
        curvature(phi, acting_[n], float(h), shape);
        if (options_.splineLevel > 0) takeCurvature(coarse, table.origin(n), h, acting_[n], shape);
        InterfaceRows rows;
        coefficientRows(phi.values, psi.values, shape, acting_[n], float(h), options_.weights, rows,
                        system_.leaf(n), u_.leaf(n));
        return region.owned.isInside(table.origin(n))
                   ? rows.total((table.origin(n) - first).asVec3d() * h)
                   : InterfaceSums();
    });
}

InterfaceSums NewtonSteps::step(const NarrowBand& band, const Region& region, LeafField& next,
                                const Progress& progress)
{
    const LeafTable& table = band.phi.table;
    const double h = band.phi.voxelSize;
    const InterfaceSums before = sums(band, region, progress);
    sweep(table, next, progress);
    const float least = options_.extended ? noHistoryOfExtended : noHistory;
    parallelFor(table.size(), progress, [&](std::size_t n) {
        const LeafMask& active = table.active(n);
        if (!active.any()) {
            std::copy_n(band.phi.leaf(n), leafSize, next.leaf(n));
            history_[n].reset();
            return;
        }
        LeafBlock<float, 1> phi;
        LeafBlock<float, footReach> u;
        phi.gather(band.phi, n);
        u.gather(table, u_, n);
        alignas(64) float solved[leafSize], slope[leafSize], step[leafSize];
        feetRows(phi.values, u.values, active, float(h), solved, slope);
        if (within(solved, least * float(h)).count() == leafSize) {
            history_[n].reset();
            std::copy_n(solved, leafSize, step);
        } else {
            if (!history_[n]) history_[n] = std::make_unique<StepHistory>();
            chooseSteps(solved, float(h), options_.extended, *history_[n], step);
        }
        moveRows(band.phi.leaf(n), slope, step, active, next.leaf(n));
    });
    return before;
}

} // namespace molsurf
