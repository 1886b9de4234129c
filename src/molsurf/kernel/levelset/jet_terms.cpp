// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/levelset/jet_terms.h"

#include "molsurf/kernel/core/simd.h"
#include "molsurf/kernel/levelset/gaussian_terms.h"

#include <cmath>

namespace molsurf
{

namespace
{

/// The sums of a list of terms e_i with slopes f_i = 2 C_i (x - x_i): of e, e f, e f f and 2 C e.
struct JetSums {
    double e, fx, fy, fz, xx, xy, xz, yy, yz, zz, rates;
};

double sumOf(Doubles v)
{
    return (v[0] + v[1]) + (v[2] + v[3]);
}

/// The columns of a list, filled up to whole vectors.
struct JetColumns {
    const double *x, *y, *z, *rate, *level;
    std::size_t count;
};

/// Adds up the terms e^t, t = level - rate |x - c|^2, with their first and second derivatives.
MOLSURF_KERNEL void sumJetTerms(const JetColumns& list, double x, double y, double z,
                                JetSums& __restrict out)
{
    const double* __restrict cx = list.x, * __restrict cy = list.y, * __restrict cz = list.z, * __restrict rates = list.rate, * __restrict levels = list.level;
    constexpr double least = -double(negligible); // exponent
    Doubles e = {}, fx = {}, fy = {}, fz = {}, xx = {}, xy = {}, xz = {}, yy = {}, yz = {}, zz = {},
            c = {};
    for (std::size_t i = 0; i < list.count; i += doubleLanes) {
        const Doubles u = x - load(cx + i), v = y - load(cy + i), w = z - load(cz + i);
        const Doubles rate = load(rates + i);
        const Doubles t = load(levels + i) - rate * (u * u + v * v + w * w);
        const Longs on = t >= least;
        if (!any(on)) continue;
        const Doubles term = on ? fastExp(t) : Doubles{}, twice = 2.0 * rate;
        const Doubles p = twice * u, q = twice * v, r = twice * w;
        const Doubles ep = term * p, eq = term * q, er = term * r;
        e += term;
        c += twice * term;
        fx += ep;
        fy += eq;
        fz += er;
        xx += ep * p;
        xy += ep * q;
        xz += ep * r;
        yy += eq * q;
        yz += eq * r;
        zz += er * r;
    }
    out = {sumOf(e),  sumOf(fx), sumOf(fy), sumOf(fz), sumOf(xx), sumOf(xy),
           sumOf(xz), sumOf(yy), sumOf(yz), sumOf(zz), sumOf(c)};
}

/// Where terms are written.
struct JetRoom {
    double *x, *y, *z, *rate, *level;
};

/// A ball in which terms may count.
struct Near {
    double x, y, z, radius; ///< [Å]
};

/// Appends the terms of balls that are felt somewhere in `near`. Without a branch each ball is
/// written, and counted if its lane is on, which is -1.
/// @param[in] h  edge of a voxel [Å]
/// @return the number of terms that count; one more may be written
MOLSURF_KERNEL std::size_t appendNear(const GaussianLists& balls, std::int32_t begin,
                                      std::int32_t end, double h, const Near& near,
                                      const JetRoom& out)
{
    const double *const x = balls.x.data(), *const y = balls.y.data(), *const z = balls.z.data();
    const double perVoxel = 1.0 / (h * h);
    std::size_t count = 0;
    for (std::int32_t i = begin; i < end; i += doubleLanes) {
        const Doubles u = load(x + i) - near.x, v = load(y + i) - near.y, w = load(z + i) - near.z;
        const Doubles felt =
            __builtin_convertvector(load4(balls.felt.data() + i), Doubles) + near.radius;
        const Longs counts = u * u + v * v + w * w <= felt * felt;
        if (!any(counts)) continue;
        for (int l = 0; l < doubleLanes && i + l < end; ++l) {
            out.x[count] = x[i + l];
            out.y[count] = y[i + l];
            out.z[count] = z[i + l];
            out.rate[count] = perVoxel * double(balls.decay[std::size_t(i + l)]);
            out.level[count] = double(balls.level[std::size_t(i + l)]);
            count -= std::size_t(counts[l]);
        }
    }
    return count;
}

} // namespace

void JetTerms::addNear(const GaussianLists& balls, std::int32_t begin, std::int32_t end,
                       double voxelSize, const openvdb::Vec3d& middle, double radius)
{
    const std::size_t most = count_ + std::size_t(end - begin) + doubleLanes;
    if (most > x_.size())
        for (auto* list : {&x_, &y_, &z_, &rate_, &level_}) list->resize(2 * most);
    const JetRoom room{x_.data() + count_, y_.data() + count_, z_.data() + count_,
                       rate_.data() + count_, level_.data() + count_};
    count_ += appendNear(balls, begin, end, voxelSize, {middle.x(), middle.y(), middle.z(), radius},
                         room);
}

void JetTerms::fillUp()
{
    constexpr double nothing = -1e3; // a level below all that count
    const std::size_t most = count_ + doubleLanes;
    if (most > x_.size())
        for (auto* list : {&x_, &y_, &z_, &rate_, &level_}) list->resize(most);
    for (; count_ % doubleLanes != 0; ++count_) {
        x_[count_] = y_[count_] = z_[count_] = rate_[count_] = 0.0;
        level_[count_] = nothing;
    }
}

PsiJet JetTerms::jetAt(const openvdb::Vec3d& x) const
{
    JetSums s;
    sumJetTerms({x_.data(), y_.data(), z_.data(), rate_.data(), level_.data(), count_}, x.x(),
                x.y(), x.z(), s);
    if (s.e == 0.0) return {double(lowestPsi), openvdb::Vec3d(0.0), openvdb::Mat3d::zero()};
    const openvdb::Vec3d gradient = openvdb::Vec3d(-s.fx, -s.fy, -s.fz) / s.e;
    openvdb::Mat3d hessian(s.xx - s.rates, s.xy, s.xz, s.xy, s.yy - s.rates, s.yz, s.xz, s.yz,
                           s.zz - s.rates);
    hessian *= 1.0 / s.e;
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) hessian(a, b) -= gradient[a] * gradient[b];
    return {std::log(s.e), gradient, hessian};
}

JetTerms JetTerms::sharpened(double times) const
{
    JetTerms sharp = *this;
    for (double& rate : sharp.rate_) rate *= times;
    for (double& level : sharp.level_) level *= times;
    return sharp;
}

} // namespace molsurf
