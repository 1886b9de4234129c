// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Gaussians that are added to psi at single places.

#include "molsurf/kernel/grid/leaf_table.h"
#include "molsurf/kernel/levelset/psi_jet.h"

#include <openvdb/Types.h>

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace molsurf
{

/// amplitude exp(-rate |x - place|^2).
struct Bump {
    openvdb::Vec3d place; ///< [Å]
    double amplitude;     ///< no unit
    double rate;          ///< [1/Å^2]
};

/// How far from its place a bump counts; beyond this it is below e^-12 of its amplitude [Å].
double reachOf(const Bump& bump);

/// A bump at a point with its derivatives; zero beyond its reach.
PsiJet jetOf(const Bump& bump, const openvdb::Vec3d& x);

/// Bumps, found by the leaves that they reach.
class Bumps
{
public:
    explicit Bumps(double voxelSize) : voxelSize_(voxelSize) {}

    void add(const Bump& bump);
    std::size_t size() const { return bumps_.size(); }
    const std::vector<Bump>& all() const { return bumps_; }

    /// Whether any reaches the leaf with this first voxel.
    bool reach(const openvdb::Coord& origin) const { return leaves_.count(origin) > 0; }

    /// Adds them to the values of a leaf.
    /// @param[in,out] psi  512 values
    void addTo(const openvdb::Coord& origin, float* psi) const;

    /// Their sum at a point.
    double at(const openvdb::Vec3d& x) const { return jet(x).psi; }

    /// With its derivatives.
    PsiJet jet(const openvdb::Vec3d& x) const;

private:
    double voxelSize_;
    std::vector<Bump> bumps_;
    std::unordered_map<openvdb::Coord, std::vector<std::int32_t>> leaves_;
};

} // namespace molsurf
