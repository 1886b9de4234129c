// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Sets of the points of one sphere, a bit a point.

#include "molsurf/kernel/balls/excluded_points.h"

#include <openvdb/Types.h>

#include <cstdint>
#include <vector>

namespace molsurf
{

/// Points of a sphere by runs of 32 that are neighbours. Which points are near one is the same
/// wherever the sphere is: it is found once, when it is first asked for. One thread at a time.
class SpherePoints
{
public:
    /// Some of the points: bit k of word n is point 32 n + k.
    using Set = std::vector<std::uint32_t>;

    /// @param[in] spread  kept by reference
    /// @param[in] chord   how far apart near points of the unit sphere are
    SpherePoints(const ExcludedSampler::Spread& spread, double chord);

    Set none() const { return Set(spread_.runs.size(), 0); }

    /// Adds the points in directions u with u.way > least.
    void addCap(const openvdb::Vec3d& way, double least, Set& set) const;

    /// The points of a set that are near none outside of it.
    Set eroded(const Set& set);

    static std::size_t count(const Set& set);

    /// Calls f(k) for the points of a set, ascending.
    template<typename F>
    static void forEach(const Set& set, const F& f)
    {
        for (std::size_t n = 0; n < set.size(); ++n)
            for (std::uint32_t left = set[n]; left != 0; left &= left - 1)
                f(32 * n + std::size_t(__builtin_ctz(left)));
    }

private:
    struct Near {
        std::uint32_t run, points;
    };

    void findNear(std::size_t point);

    const ExcludedSampler::Spread& spread_;
    double chord_;
    std::vector<double> x_, y_, z_;       // of directions, padded by zeros to whole runs
    std::vector<std::vector<Near>> near_; // of each point; empty: not known yet
};

} // namespace molsurf
