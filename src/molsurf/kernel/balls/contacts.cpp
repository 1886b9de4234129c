// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/contacts.h"

#include "molsurf/kernel/balls/ball_index.h"
#include "molsurf/kernel/core/parallel.h"

#include <algorithm>
#include <set>

namespace molsurf
{

std::vector<std::vector<std::int32_t>> contacts(const std::vector<Ball>& balls,
                                                const std::vector<std::int32_t>& labelOf,
                                                std::size_t labels, double gap,
                                                const Progress& progress)
{
    const BallIndex index(balls, {0.5, 0.0, 4.0});
    constexpr std::size_t chunk = 1024;
    std::vector<std::set<std::pair<std::int32_t, std::int32_t>>> found((balls.size() + chunk - 1) /
                                                                       chunk);
    parallelFor(found.size(), progress, [&](std::size_t c) {
        for (std::size_t i = c * chunk; i < std::min(balls.size(), (c + 1) * chunk); ++i) {
            if (labelOf[i] < 0) continue;
            const openvdb::Vec3d x(balls[i].center);
            index.forEachNear(x, x, balls[i].radius + gap, [&](const Ball& other, std::int32_t j) {
                if (labelOf[j] < 0 || labelOf[j] >= labelOf[i]) return;
                const double touch = balls[i].radius + other.radius + gap;
                if ((openvdb::Vec3d(other.center) - x).lengthSqr() < touch * touch) {
                    found[c].emplace(labelOf[i], labelOf[j]);
                }
            });
        }
    });
    std::set<std::pair<std::int32_t, std::int32_t>> all;
    for (const auto& f : found) all.insert(f.begin(), f.end());
    std::vector<std::vector<std::int32_t>> out(labels);
    for (const auto& [a, b] : all) {
        out[std::size_t(a)].push_back(b);
        out[std::size_t(b)].push_back(a);
    }
    return out;
}

} // namespace molsurf
