// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/levelset/bumps.h"

#include "molsurf/kernel/levelset/gaussian_terms.h"

#include <cmath>

namespace molsurf
{

using openvdb::Coord;
using openvdb::Vec3d;

namespace
{

constexpr double bumpFelt = double(negligible); // beyond this exponent a bump counts as zero

} // namespace

double reachOf(const Bump& bump)
{
    return std::sqrt(bumpFelt / bump.rate);
}

PsiJet jetOf(const Bump& bump, const Vec3d& x)
{
    PsiJet jet{0.0, Vec3d(0.0), openvdb::Mat3d::zero()};
    const Vec3d way = x - bump.place;
    const double rate = bump.rate, t = rate * way.lengthSqr();
    if (t >= bumpFelt) return jet;
    jet.psi = bump.amplitude * std::exp(-t);
    jet.gradient = -2.0 * rate * jet.psi * way;
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b)
            jet.hessian(a, b) = 4.0 * rate * rate * jet.psi * way[a] * way[b];
        jet.hessian(a, a) -= 2.0 * rate * jet.psi;
    }
    return jet;
}

void Bumps::add(const Bump& bump)
{
    const double edge = leafDim * voxelSize_;
    const Vec3d reach(reachOf(bump));
    const Coord low = Coord::floor((bump.place - reach) / edge);
    const Coord high = Coord::floor((bump.place + reach) / edge);
    for (auto leaf = openvdb::CoordBBox(low, high).begin(); leaf; ++leaf)
        leaves_[Coord((*leaf).x() * leafDim, (*leaf).y() * leafDim, (*leaf).z() * leafDim)]
            .push_back(std::int32_t(bumps_.size()));
    bumps_.push_back(bump);
}

void Bumps::addTo(const Coord& origin, float* psi) const
{
    const auto found = leaves_.find(origin);
    if (found == leaves_.end()) return;
    for (const std::int32_t i : found->second) {
        const Bump& bump = bumps_[std::size_t(i)];
        for (int v = 0; v < leafSize; ++v) {
            const Coord voxel = origin.offsetBy(v >> 6, v >> 3 & 7, v & 7);
            const double t = bump.rate * (voxel.asVec3d() * voxelSize_ - bump.place).lengthSqr();
            if (t < bumpFelt) psi[v] += float(bump.amplitude * std::exp(-t));
        }
    }
}

PsiJet Bumps::jet(const Vec3d& x) const
{
    PsiJet sum{0.0, Vec3d(0.0), openvdb::Mat3d::zero()};
    if (leaves_.empty()) return sum;
    const auto found = leaves_.find(Coord::floor(x / voxelSize_) & ~(leafDim - 1));
    if (found == leaves_.end()) return sum;
    for (const std::int32_t i : found->second) {
        const PsiJet bump = jetOf(bumps_[std::size_t(i)], x);
        sum.psi += bump.psi;
        sum.gradient += bump.gradient;
        sum.hessian += bump.hessian;
    }
    return sum;
}

} // namespace molsurf
