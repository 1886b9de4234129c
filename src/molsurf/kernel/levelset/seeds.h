// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Seeds: the closest points on an interface to the voxels beside it, with the shape of the
/// interface there. Lengths in voxels.

#include "molsurf/kernel/grid/sparse_field.h"
#include "molsurf/kernel/levelset/foot_points.h"
#include "molsurf/kernel/levelset/nearest_point.h"
#include "molsurf/progress.h"

#include <openvdb/Types.h>

#include <cstdint>
#include <vector>

namespace molsurf
{

/// Index of no seed.
constexpr std::int32_t noSeed = -1;

/// A closest point on the interface. One line of the cache.
struct alignas(64) Seed {
    openvdb::Vec3f y;  // from the first voxel of its leaf
    std::int32_t leaf; // of the voxel that it is closest to
    openvdb::Vec3f n;  // unit normal there, outward
    float A[6];        // shape operator: xx yy zz xy yz xz
    float kappa, gauss;

    /// A t
    openvdb::Vec3f bend(const openvdb::Vec3f& t) const
    {
        return {A[0] * t.x() + A[3] * t.y() + A[5] * t.z(),
                A[3] * t.x() + A[1] * t.y() + A[4] * t.z(),
                A[5] * t.x() + A[4] * t.y() + A[2] * t.z()};
    }

    /// Normal curvature along the tangential part of a vector; about the mean of all directions
    /// where the vector is along the normal.
    float curvatureAlong(const openvdb::Vec3f& d) const
    {
        const openvdb::Vec3f t = d - d.dot(n) * n;
        const float little = 0.01f * d.lengthSqr() + 1e-12f;
        return (t.dot(bend(t)) + little * 0.5f * kappa) / (t.lengthSqr() + little);
    }
};

/// @param[in] shift  from the first voxel of the seed's leaf to the origin of the lanes
inline void setLane(const Seed& seed, const openvdb::Vec3f& shift, int lane, FootPoints& feet)
{
    for (int a = 0; a < 3; ++a) {
        feet.y[a][lane] = seed.y[a] + shift[a];
        feet.n[a][lane] = seed.n[a];
    }
    for (int i = 0; i < 6; ++i) feet.A[i][lane] = seed.A[i];
    feet.kappa[lane] = seed.kappa;
    feet.gauss[lane] = seed.gauss;
}

/// One of vectors that are side by side.
inline openvdb::Vec3f lane(const FootPoints::Lanes* v, int l)
{
    return {v[0][l], v[1][l], v[2][l]};
}

inline void setLane(const openvdb::Vec3f& value, int l, FootPoints::Lanes* v)
{
    for (int a = 0; a < 3; ++a) v[a][l] = value[a];
}

/// A voxel of a leaf, from the first.
inline openvdb::Vec3f placeOf(int v)
{
    return {float(v >> 6), float(v >> 3 & 7), float(v & 7)};
}

/// The voxels of a mask, in ascending order.
/// @param[out] voxels  with room for 512
/// @return their number
int listOf(const LeafMask& mask, std::uint16_t* voxels);

/// The voxels with a face neighbour of the other sign, among the active ones.
/// @param[in] inside  a mask a leaf
std::vector<LeafMask> interfaceVoxels(const LeafTable& table, const std::vector<LeafMask>& inside,
                                      const Progress& progress);

/// The seeds of some interface voxels, leaf by leaf.
/// @param[in]  coefficients  of the spline through a level set, whose zero set is the interface
/// @param[out] begins        where those of each leaf begin, and the end
PagedArray<Seed> findSeeds(const SparseField& coefficients, const std::vector<LeafMask>& interface,
                           std::vector<std::size_t>& begins, const Progress& progress);

/// The places of seeds, for the search of the nearest.
LeafPoints pointsOf(const LeafTable& table, const PagedArray<Seed>& seeds,
                    std::vector<std::size_t> begins, const Progress& progress);

} // namespace molsurf
