// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/flow/front.h"

#include "molsurf/kernel/levelset/redistance.h"
#include "molsurf/kernel/spline/curvature.h"
#include "molsurf/kernel/spline/fit.h"

#include <algorithm>

namespace molsurf
{

namespace
{

double sumOf(const float* values)
{
    double sum = 0.0;
    for (int z = 0; z < 8; ++z) sum += values[z];
    return sum;
}

} // namespace

InterfaceSums& InterfaceSums::operator+=(const InterfaceSums& other)
{
    energy += other.energy;
    area += other.area;
    volume += other.volume;
    maxSpeed = std::max(maxSpeed, other.maxSpeed);
    unresolvedGaps += other.unresolvedGaps;
    return *this;
}

openvdb::Coord sumOrigin(const LeafTable& table, const Region& region)
{
    if (!region.whole()) return region.anchor;
    return table.size() ? table.origin(0) : openvdb::Coord();
}

void takeCurvature(const Spline& spline, const openvdb::Coord& origin, double voxelSize,
                   const LeafMask& active, LeafCurvature& shape)
{
    SplineSampler sampler(spline);
    active.forEach([&](int v) {
        const Jet jet =
            sampler.at(origin.offsetBy(v >> 6, v >> 3 & 7, v & 7).asVec3d() * voxelSize);
        if (jet.gradient.lengthSqr() < 1e-6) return;
        shape.mean[v] = float(2.0 * meanCurvature(jet));
        shape.gauss[v] = float(gaussianCurvature(jet));
    });
}

Spline splineOf(const SparseField& phi, int level, const Progress& progress)
{
    if (level == 0) return fitSpline(phi, 0, progress);
    const double width = (2.25 + 3.5 * (1 << level)) * phi.voxelSize;
    const DistanceBand wide = redistance(copied(phi), {width, width}, 0.0, progress);
    return fitSpline(wide.phi, level, progress);
}

InterfaceSums InterfaceRows::total(const openvdb::Vec3d& corner) const
{
    InterfaceSums sums;
    sums.area = sumOf(area);
    sums.energy = sumOf(energy);
    const openvdb::Vec3d normals(sumOf(normal[0]), sumOf(normal[1]), sumOf(normal[2]));
    sums.volume = (corner.dot(normals) + sumOf(along)) / 3.0;
    sums.maxSpeed = *std::max_element(speed, speed + 8);
    sums.unresolvedGaps = std::size_t(sumOf(unresolvedGaps));
    return sums;
}

} // namespace molsurf
