// SPDX-License-Identifier: MPL-2.0
#include "molsurf/levelset/bumps.h"

#include <cmath>

namespace molsurf
{

using openvdb::Coord;
using openvdb::Vec3d;

namespace
{

constexpr double bumpFelt = 16.0; // beyond this exponent a bump is not felt

} // namespace

void Bumps::add(const Bump& bump)
{
    const double edge = leafDim * voxelSize_;
    const Vec3d reach(std::sqrt(bumpFelt / bump.rate));
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

double Bumps::at(const Vec3d& x, Vec3d* gradient, openvdb::Mat3d* hessian) const
{
    if (leaves_.empty()) return 0.0;
    const auto found = leaves_.find(Coord::floor(x / voxelSize_) & ~(leafDim - 1));
    if (found == leaves_.end()) return 0.0;
    double sum = 0.0;
    for (const std::int32_t i : found->second) {
        const Bump& bump = bumps_[std::size_t(i)];
        const Vec3d way = x - bump.place;
        const double t = bump.rate * way.lengthSqr();
        if (t >= bumpFelt) continue;
        const double value = bump.amplitude * std::exp(-t);
        sum += value;
        if (gradient) *gradient -= 2.0 * bump.rate * value * way;
        for (int a = 0; hessian && a < 3; ++a) {
            for (int b = 0; b < 3; ++b)
                (*hessian)(a, b) += 4.0 * bump.rate * bump.rate * value * way[a] * way[b];
            (*hessian)(a, a) -= 2.0 * bump.rate * value;
        }
    }
    return sum;
}

} // namespace molsurf
