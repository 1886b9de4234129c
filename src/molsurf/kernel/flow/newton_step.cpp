// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/flow/newton_step.h"

#include "molsurf/kernel/core/parallel.h"

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

/// The upper half of a float, rounded: the number to a relative 0.002 (bfloat16). That is enough
/// for coefficients and for displacements, since rest is where both are 0.
MOLSURF_INLINE std::uint16_t upperHalf(float value)
{
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return std::uint16_t((bits + 0x8000u) >> 16);
}
MOLSURF_INLINE float ofUpperHalf(std::uint32_t half)
{
    const std::uint32_t bits = half << 16;
    float value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

/// Two numbers in one word.
MOLSURF_INLINE std::uint32_t packed(float b, float c)
{
    return std::uint32_t(upperHalf(b)) << 16 | upperHalf(c);
}
MOLSURF_INLINE float highOf(std::uint32_t word)
{
    return ofUpperHalf(word >> 16);
}
MOLSURF_INLINE float lowOf(std::uint32_t word)
{
    return ofUpperHalf(word & 0xffffu);
}

/// Coefficients of  (c + number of neighbours) u = b + sum of the neighbours' u,  with c = P h^2/w
/// and b = F h^2/w, and a first u.
MOLSURF_KERNEL void coefficientRows(const float* __restrict phiBlock,
                                    const float* __restrict psiBlock,
                                    const LeafCurvature& __restrict shape, const LeafMask& acting,
                                    float h, const Weights weights, InterfaceRows& __restrict sums,
                                    std::uint32_t* __restrict system, std::uint16_t* __restrict u)
{
    using Block = LeafBlock<float, 1>;
    const float inverse = 1.0f / h, h2 = h * h;
    for (int row = 0; row < 64; ++row) {
        const int bits = acting.row(row);
        const int first = (row / 8 + 1) * Block::strideX + (row % 8 + 1) * Block::strideY + 1;
        const float *p = phiBlock + first, *q = psiBlock + first;
        if (bits == 0) {
            for (int z = 0; z < 8; ++z) u[8 * row + z] = upperHalf(outside);
            continue;
        }
        for (int z = 0; z < 8; ++z) {
            const int v = 8 * row + z;
            const float phi = distanceOf(p[z], shape.slope[v]);
            const Front front = frontAt(q + z, shape, v, phi, inverse, weights);
            const Metric& m = front.metric;
            // Outward there may be no valley to stop in: beyond its shoulder w flattens out.
            const float valley = front.speed < 0.0f ? m.tangent : m.secant;
            // The part of curvature at rest, where n . grad w = -w kappa:
            // w (kappa^2 + k1^2 + k2^2).
            const float bend = 2.0f * m.w * (front.kappa * front.kappa - front.gauss);
            const float P = larger(valley - bend, 0.0f) + leastStiffness;
            const float scale = h2 / larger(m.w, 1e-4f);
            const float b = scale * front.speed, c = scale * P;
            system[v] = packed(b, c);
            u[v] = upperHalf(bits & rowBits[z] ? b / (c + 6.0f) : outside);
            const float on = bits & rowBits[z] ? 1.0f : 0.0f;
            addVoxel(front, shape, row, z, p[z], phi, h, on, sums);
        }
    }
}

/// One sweep: out <- out + omega (J(u) - out), J being Jacobi's.
/// @param[in] keep  0: out has no values yet, and counts as 0; else 1
MOLSURF_KERNEL void sweepRows(const std::uint16_t* __restrict uBlock, const LeafMask& acting,
                              const std::uint32_t* __restrict system, float omega, float keep,
                              std::uint16_t* __restrict out)
{
    constexpr int X = LeafBlock<std::uint16_t, 1>::strideX,
                  Y = LeafBlock<std::uint16_t, 1>::strideY;
    for (int row = 0; row < 64; ++row) {
        const int bits = acting.row(row);
        if (bits == 0) {
            for (int z = 0; z < 8; ++z) out[8 * row + z] = upperHalf(outside);
            continue;
        }
        const std::uint16_t* p = uBlock + (row / 8 + 1) * X + (row % 8 + 1) * Y + 1;
        for (int z = 0; z < 8; ++z) {
            const int v = 8 * row + z;
            float sum = 0.0f, count = 0.0f;
            for (const int step : {X, -X, Y, -Y, 1, -1}) {
                const float u = ofUpperHalf(p[z + step]);
                sum += u < known ? u : 0.0f;
                count += u < known ? 1.0f : 0.0f;
            }
            const float jacobi = (highOf(system[v]) + sum) / (lowOf(system[v]) + count);
            const float before = keep > 0.0f ? ofUpperHalf(out[v]) : 0.0f;
            const float next = before + omega * (jacobi - before);
            out[v] = upperHalf(bits & rowBits[z] ? next : outside);
        }
    }
}

/// Interpolates u at the feet of a leaf's voxels, trilinearly between corners where it is known,
/// and takes |grad phi| at the voxels. u is 0 beside the active voxels; changeRows() masks the
/// slope.
MOLSURF_KERNEL void feetRows(const float* __restrict phiBlock,
                             const std::uint16_t* __restrict uBlock, const LeafMask& active,
                             float h, float* __restrict atFoot, float* __restrict slope)
{
    constexpr int X = LeafBlock<float, 1>::strideX, Y = LeafBlock<float, 1>::strideY;
    constexpr int UX = LeafBlock<std::uint16_t, footReach>::strideX;
    constexpr int UY = LeafBlock<std::uint16_t, footReach>::strideY;
    const float inverse = 1.0f / h;
    for (int row = 0; row < 64; ++row) {
        const int bits = active.row(row);
        const float* p = phiBlock + (row / 8 + 1) * X + (row % 8 + 1) * Y + 1;
        const std::uint16_t* q =
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
        alignas(64) std::uint32_t pairs[4][8]; // corners that are neighbours in memory
        for (int k = 0; k < 4; ++k) {
            const std::uint16_t* corner = q + (k >> 1) * UX + (k & 1) * UY;
            for (int z = 0; z < 8; ++z)
                std::memcpy(pairs[k] + z, corner + cell[z], sizeof pairs[k][z]);
        }
        for (int k = 0; k < 4; ++k) {
            for (int z = 0; z < 8; ++z) {
                const float w = (k & 2 ? tx[z] : 1.0f - tx[z]) * (k & 1 ? ty[z] : 1.0f - ty[z]);
                const float below = lowOf(pairs[k][z]), above = highOf(pairs[k][z]);
                const float wBelow = below < known ? w * (1.0f - tz[z]) : 0.0f;
                const float wAbove = above < known ? w * tz[z] : 0.0f;
                sum[z] += wBelow * smaller(below, 1e6f) + wAbove * smaller(above, 1e6f);
                weight[z] += wBelow + wAbove;
            }
        }
        for (int z = 0; z < 8; ++z) {
            const float here = ofUpperHalf(q[z]);
            const float own = here < known ? here : 0.0f;
            // Where phi is flat two pieces meet, and its gradient leads to no foot.
            const bool hasFoot = (slopes[z] > 0.5f) & (weight[z] > 0.3f);
            const float u = hasFoot ? sum[z] / larger(weight[z], 0.1f) : own; // never by 0
            atFoot[8 * row + z] = bits & rowBits[z] ? u : 0.0f;
            slope[8 * row + z] = slopes[z];
        }
    }
}

/// The steps that are made of a leaf's displacements.
/// @param[in,out] history  of the step before; then of this one
/// @param[in,out] fronts   null, or likewise, and steps are extended
MOLSURF_KERNEL void chooseSteps(const float* __restrict atFoot, float h,
                                StepHistory& __restrict history, FrontHistory* __restrict fronts,
                                float* __restrict step)
{
    for (int v = 0; v < leafSize; ++v) {
        const float u = atFoot[v], last = float(history.share[v]) / StepHistory::whole;
        const float share = shareOfStep(u, last);
        const float whole = fronts ? extendedStep(u, fronts->u[v], fronts->step[v], h) : u;
        step[v] = clamped(share * whole, -longestStep * h, longestStep * h);
        const float made = StepHistory::whole * share + 0.5f;
        history.share[v] = std::int8_t(step[v] < 0.0f ? -made : step[v] > 0.0f ? made : 0.0f);
    }
    for (int v = 0; fronts && v < leafSize; ++v) {
        fronts->u[v] = atFoot[v];
        fronts->step[v] = step[v];
    }
}

/// How far phi moves by the steps.
MOLSURF_KERNEL void changeRows(const float* __restrict slope, const float* __restrict step,
                               const LeafMask& active, float* __restrict change)
{
    for (int row = 0; row < 64; ++row) {
        const int bits = active.row(row);
        for (int z = 0; z < 8; ++z) {
            const int v = 8 * row + z;
            const float on = bits & rowBits[z] ? 1.0f : 0.0f;
            change[v] = on * smaller(slope[v], 1.0f) * step[v];
        }
    }
}

} // namespace

/// Keeps the history for the leaves of a table; leaves that are new have not moved yet.
void NewtonSteps::fit(const LeafTable& table, const Progress& progress)
{
    if (known_.size() == table.size() && table.size() > 0) return; // leaves are never dropped
    const auto fitted = [&](auto& history) {
        std::decay_t<decltype(history)> all(table.size());
        parallelFor(table.size(), progress, [&](std::size_t n) {
            const std::int32_t m = known_.find(table.origin(n));
            if (m != noLeaf) all[n] = std::move(history[std::size_t(m)]);
        });
        history = std::move(all);
    };
    fitted(history_);
    fitted(fronts_);
    known_ = table;
}

/// Sweeps; the Chebyshev weights are those of eigenvalues of Jacobi's iteration in [-rho, rho], rho
/// such that all sweeps together lessen them tenfold. Smoother errors fall more slowly, and none
/// grows.
void NewtonSteps::sweep(const LeafTable& table, System& system, const Progress& progress) const
{
    constexpr double lessening = 10.0;
    const double rho = 1.0 / std::cosh(std::acosh(lessening) / options_.sweeps);
    double omega = 1.0;
    Displacement next(table.size());
    for (int i = 1; i < options_.sweeps; ++i) {
        omega = 1.0 / (1.0 - rho * rho * (i == 1 ? 0.5 : 0.25 * omega));
        parallelFor(table.size(), progress, [&](std::size_t n) {
            if (!system.acting[n].any()) {
                if (i == 1) std::copy_n(system.u.leaf(n), leafSize, next.leaf(n)); // all outside
                return;
            }
            LeafBlock<std::uint16_t, 1> u;
            u.gather(table, system.u, n);
            sweepRows(u.values, system.acting[n], system.coefficients.leaf(n), float(omega),
                      i == 1 ? 0.0f : 1.0f, next.leaf(n));
        });
        std::swap(system.u, next);
    }
}

InterfaceSums NewtonSteps::assemble(const NarrowBand& band, const Region& region, System& system,
                                    const Progress& progress) const
{
    const LeafTable& table = band.phi.table;
    const double h = band.phi.voxelSize;
    const openvdb::Coord first = sumOrigin(table, region);
    Spline coarse;
    if (options_.splineLevel > 0) coarse = splineOf(band.phi, options_.splineLevel, progress);
    return parallelSum<InterfaceSums>(table.size(), progress, [&](std::size_t n) {
        LeafMask& acting = system.acting[n];
        acting = table.active(n) & within(band.phi.leaf(n), float(newtonWidthVox * h));
        if (!acting.any()) {
            std::fill_n(system.u.leaf(n), leafSize, upperHalf(outside));
            return InterfaceSums();
        }
        LeafBlock<float, 1> phi, psi;
        phi.gather(band.phi, n);
        psi.gather(table, band.psi, n);
        LeafCurvature shape;
        curvature(phi, acting, float(h), shape);
        if (options_.splineLevel > 0) takeCurvature(coarse, table.origin(n), h, acting, shape);
        InterfaceRows rows;
        coefficientRows(phi.values, psi.values, shape, acting, float(h), options_.weights, rows,
                        system.coefficients.leaf(n), system.u.leaf(n));
        return region.owned.isInside(table.origin(n))
                   ? rows.total((table.origin(n) - first).asVec3d() * h)
                   : InterfaceSums();
    });
}

InterfaceSums NewtonSteps::sums(const NarrowBand& band, const Region& region,
                                const Progress& progress)
{
    System system(band.phi.table.size());
    return assemble(band, region, system, progress);
}

/// The steps of a leaf, and its history.
/// @param[in] u  at the feet of its voxels [Å]
void NewtonSteps::choose(std::size_t n, float h, const float* u, float* step)
{
    const float least = options_.extended ? noHistoryOfExtended : noHistory;
    if (within(u, least * h).count() == leafSize) {
        history_[n].reset();
        fronts_[n].reset();
        std::copy_n(u, leafSize, step);
        return;
    }
    if (!history_[n]) history_[n] = std::make_unique<StepHistory>();
    if (!fronts_[n] && options_.extended) fronts_[n] = std::make_unique<FrontHistory>();
    chooseSteps(u, h, *history_[n], fronts_[n].get(), step);
}

InterfaceSums NewtonSteps::step(NarrowBand& band, const Region& region, LeafField& before,
                                const Progress& progress)
{
    const LeafTable& table = band.phi.table;
    const double h = band.phi.voxelSize;
    fit(table, progress);
    before = LeafField(); // its memory serves the equations
    InterfaceSums sums;
    LeafField change;
    {
        System system(table.size());
        sums = assemble(band, region, system, progress);
        sweep(table, system, progress);
        change = std::move(system.coefficients).reused<float>();
        parallelFor(table.size(), progress, [&](std::size_t n) {
            const LeafMask& active = table.active(n);
            if (!active.any()) {
                std::fill_n(change.leaf(n), leafSize, 0.0f);
                history_[n].reset();
                fronts_[n].reset();
                return;
            }
            LeafBlock<float, 1> phi;
            LeafBlock<std::uint16_t, footReach> u;
            phi.gather(band.phi, n);
            u.gather(table, system.u, n);
            alignas(64) float solved[leafSize], slope[leafSize], step[leafSize];
            feetRows(phi.values, u.values, active, float(h), solved, slope);
            choose(n, float(h), solved, step);
            changeRows(slope, step, active, change.leaf(n));
        });
    }
    before = LeafField(table.size());
    parallelFor(table.size(), progress, [&](std::size_t n) {
        float* phi = band.phi.leaf(n);
        std::copy_n(phi, leafSize, before.leaf(n));
        for (int v = 0; v < leafSize; ++v) phi[v] += change.leaf(n)[v];
    });
    return sums;
}

} // namespace molsurf
