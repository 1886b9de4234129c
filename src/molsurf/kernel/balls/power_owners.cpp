// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/power_owners.h"

#include "molsurf/kernel/core/parallel.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace molsurf
{

using openvdb::Vec3d;

PowerOwners::PowerOwners(const std::vector<Ball>& balls, std::vector<std::int32_t> ownerOf)
    : index_(balls, {0.5, 0.0, 2.0}), ownerOf_(std::move(ownerOf)),
      leastRadius_(std::numeric_limits<double>::max())
{
    for (const Ball& ball : balls) leastRadius_ = std::min(leastRadius_, double(ball.radius));
}

void PowerOwners::at(const Vec3d& x, double slack, std::vector<OwnersPower>& near) const
{
    constexpr double start = 1.0, farthest = 32.0; // [Å]
    for (double gap = start; gap <= farthest; gap *= 2.0) {
        near.clear();
        index_.forEachNear(x, x, gap, [&](const Ball& ball, std::int32_t i) {
            const Vec3d c(ball.center);
            const double power = (x - c).lengthSqr() - double(ball.radius) * double(ball.radius);
            const std::int32_t owner = ownerOf_[std::size_t(i)];
            for (OwnersPower& known : near) {
                if (known.owner != owner) continue;
                if (power < known.power) known = {owner, power, c};
                return;
            }
            near.push_back({owner, power, c});
        });
        std::sort(near.begin(), near.end(), [](const OwnersPower& a, const OwnersPower& b) {
            return a.power != b.power ? a.power < b.power : a.owner < b.owner;
        });
        // Balls farther off than the gap have at least this power.
        if (!near.empty() && near[0].power + slack <= gap * (gap + 2.0 * leastRadius_)) return;
    }
}

PowerExcess PowerOwners::excess(const Vec3d& x, std::int32_t owner, std::int32_t other,
                                std::vector<OwnersPower>& near) const
{
    constexpr double slack = 16.0; // [Å^2]
    at(x, slack, near);
    const OwnersPower *own = nullptr, *rest = nullptr;
    for (const OwnersPower& n : near) {
        if (n.owner == owner) own = &n;
        if (n.owner == other || (other < 0 && !rest && n.owner != owner)) rest = &n;
    }
    const std::int32_t second = rest ? rest->owner : -1;
    if (own && rest) return {own->power - rest->power, 2.0 * (rest->centre - own->centre), second};
    return {own ? -slack : slack, Vec3d(0.0), second};
}

std::vector<std::int32_t> PowerOwners::ownersOf(const std::vector<openvdb::Vec3f>& points,
                                                const Progress& progress) const
{
    constexpr std::size_t chunk = 256;
    std::vector<std::int32_t> out(points.size(), 0);
    parallelFor((points.size() + chunk - 1) / chunk, progress, [&](std::size_t c) {
        std::vector<OwnersPower> near;
        for (std::size_t i = c * chunk; i < std::min(points.size(), (c + 1) * chunk); ++i) {
            at(Vec3d(points[i]), 0.0, near);
            if (!near.empty()) out[i] = near[0].owner;
        }
    });
    return out;
}

} // namespace molsurf
