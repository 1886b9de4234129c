// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/pockets/pocket_extremes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

constexpr double exact = 1e-3;     // the last step [Å]
constexpr double rounding = 1e-4;  // of a probe that touches balls [Å]
constexpr double leastGain = 1e-6; // of depth, so that rounding does not move places for ever [Å]

/// Some directions, evenly on a sphere.
const std::vector<Vec3d>& directions()
{
    static const std::vector<Vec3d> all = [] {
        constexpr int count = 60;
        constexpr double golden = 2.399963229728653; // angle [rad]
        std::vector<Vec3d> out;
        for (int k = 0; k < count; ++k) {
            const double z = 1.0 - (2.0 * k + 1.0) / count, across = std::sqrt(1.0 - z * z);
            out.emplace_back(across * std::cos(golden * k), across * std::sin(golden * k), z);
        }
        return out;
    }();
    return all;
}

} // namespace

double largestBall(const Vec3d& widest, double voxelSize, const Clearance& clearance,
                   const std::function<bool(const Vec3d&)>& isWithin)
{
    Vec3d at = widest;
    double most = clearance.at(at);
    for (double step = 0.5 * voxelSize; step > exact;) {
        Vec3d best = at;
        for (const Vec3d& way : directions()) {
            const Vec3d x = at + way * step;
            const double there = clearance.at(x);
            if (there <= most || !isWithin(x)) continue;
            most = there;
            best = x;
        }
        step *= best == at ? 0.5 : 1.5;
        at = best;
    }
    return most;
}

DeepestPlaces::DeepestPlaces(const VoidField& space, double probe, const Clearance& clearance)
    : corners_(space.corners, {0.0, 0.0, 2.0}), outer_(*space.outer), clearance_(clearance),
      probe_(probe), reach_(std::sqrt(3.0) * space.voxelSize)
{
}

double DeepestPlaces::depthNear(const Vec3d& voxel) const
{
    constexpr double typical = 10.0; // distance from the large probe's centre [Å]
    Deepest below{{voxel, voxel}, outer_.at(voxel, false, typical)};
    std::optional<Vec3d> nearest;
    bool isCovered = false;
    corners_.forEachNear(voxel, voxel, probe_ + reach_, [&](const Ball& corner, std::int32_t) {
        const Vec3d away = (corner.center - below.depth.centre).unitSafe();
        isCovered =
            tryDeeper({corner.center, corner.center + away * probe_}, voxel, below) || isCovered;
        if (!nearest || (corner.center - voxel).lengthSqr() < (*nearest - voxel).lengthSqr())
            nearest = corner.center;
    });
    if (isCovered) climb(voxel, below);
    if (!nearest) return below.depth.value;
    // Between large probes on several sides.
    const Vec3d place = coveredBy(*nearest, voxel);
    Deepest between{{*nearest, place}, outer_.at(place, false, typical)};
    climb(voxel, between);
    return std::max(below.depth.value, between.depth.value);
}

Vec3d DeepestPlaces::coveredBy(const Vec3d& centre, const Vec3d& place) const
{
    const double far = (place - centre).length();
    return far <= probe_ ? place : centre + (place - centre) * (probe_ / far);
}

bool DeepestPlaces::tryDeeper(const Cover& next, const Vec3d& voxel, Deepest& at) const
{
    if ((next.place - voxel).lengthSqr() > reach_ * reach_) return false;
    // A place is no deeper than it is far from any of the large probes.
    const double rim = (at.cover.place - at.depth.centre).length() - at.depth.value;
    const double bound = (next.place - at.depth.centre).length();
    if (bound - rim <= at.depth.value + leastGain) return false;
    if (clearance_.at(next.centre) < probe_ - rounding) return false;
    const OuterDepth::Depth there = outer_.at(next.place, false, bound);
    if (there.value <= at.depth.value + leastGain) return false;
    at = {next, there};
    return true;
}

void DeepestPlaces::climb(const Vec3d& voxel, Deepest& at) const
{
    for (double step = 0.2 * probe_; step > exact;) {
        const Cover from = at.cover;
        bool any = false;
        for (const Vec3d& way : directions()) {
            const Vec3d by = way * step, centre = from.centre + by;
            any =
                tryDeeper({from.centre, coveredBy(from.centre, from.place + by)}, voxel, at) || any;
            any = tryDeeper({centre, from.place + by}, voxel, at) || any;
        }
        step *= any ? 1.5 : 0.5;
    }
}

} // namespace molsurf
