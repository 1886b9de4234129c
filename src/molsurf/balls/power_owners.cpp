// SPDX-License-Identifier: MPL-2.0
#include "molsurf/balls/power_owners.h"

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

} // namespace molsurf
