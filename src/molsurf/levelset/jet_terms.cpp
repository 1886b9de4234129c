// SPDX-License-Identifier: MPL-2.0
#include "molsurf/levelset/jet_terms.h"

#include "molsurf/core/simd.h"
#include "molsurf/levelset/gaussian_terms.h"

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

MOLSURF_KERNEL void sumJetTerms(const JetColumns& list, double x, double y, double z,
                                JetSums& __restrict out)
{
    const double* __restrict cx = list.x, * __restrict cy = list.y, * __restrict cz = list.z, * __restrict rates = list.rate, * __restrict levels = list.level;
    constexpr double least = -12.0; // exponent
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

} // namespace

void JetTerms::clear()
{
    for (auto* list : {&x_, &y_, &z_, &rate_, &level_}) list->clear();
}

void JetTerms::add(const openvdb::Vec3d& place, double rate, double level)
{
    x_.push_back(place.x());
    y_.push_back(place.y());
    z_.push_back(place.z());
    rate_.push_back(rate);
    level_.push_back(level);
}

void JetTerms::fillUp()
{
    constexpr double nothing = -1e3; // a level below all that count
    while (x_.size() % doubleLanes != 0) add(openvdb::Vec3d(0.0), 0.0, nothing);
}

PsiJet JetTerms::jetAt(const openvdb::Vec3d& x) const
{
    JetSums s;
    sumJetTerms({x_.data(), y_.data(), z_.data(), rate_.data(), level_.data(), x_.size()}, x.x(),
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
