// SPDX-License-Identifier: MPL-2.0
#include "molsurf/balls/nearest_ball.h"

#include "molsurf/balls/ball_index.h"
#include "molsurf/core/parallel.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

using openvdb::Vec3d;
using openvdb::Vec3f;

namespace
{

struct Candidate {
    Vec3f center;
    float radius;
    std::int32_t i;
};

std::int32_t nearest(const Vec3f& point, const std::vector<Candidate>& candidates, float within)
{
    std::int32_t found = -1;
    float best = within;
    for (const Candidate& b : candidates) {
        const float limit = best + b.radius, d2 = (point - b.center).lengthSqr();
        if (limit < 0.0f || d2 > limit * limit) continue;
        const float gap = std::sqrt(d2) - b.radius;
        if (gap < best || (gap == best && (found < 0 || b.i < found))) {
            best = gap;
            found = b.i;
        }
    }
    return found;
}

} // namespace

std::vector<std::int32_t> nearestBalls(const std::vector<Ball>& balls,
                                       const std::vector<Vec3f>& points, double reach,
                                       const Progress& progress)
{
    const BallIndex index(balls, {0.5, 0.0, 2.0});

    // Points are taken by runs that stay in a small box and share its candidates. Most lie close to
    // their ball; for those that do not the search goes on twice as far.
    constexpr std::size_t chunk = 256;
    constexpr float runSize = 2.0f; // [Å]
    constexpr double close = 0.5;   // [Å]
    std::vector<std::int32_t> out(points.size(), -1);
    parallelFor((points.size() + chunk - 1) / chunk, progress, [&](std::size_t c) {
        std::vector<Candidate> candidates;
        const std::size_t end = std::min(points.size(), (c + 1) * chunk);
        for (std::size_t begin = c * chunk, stop; begin < end; begin = stop) {
            Vec3f low = points[begin], high = points[begin];
            for (stop = begin + 1; stop < end; ++stop) {
                const Vec3f l = openvdb::math::minComponent(low, points[stop]);
                const Vec3f h = openvdb::math::maxComponent(high, points[stop]);
                if ((h - l).lengthSqr() > runSize * runSize) break;
                low = l;
                high = h;
            }
            bool missing = true;
            for (double within = std::min(close, reach); missing;
                 within = std::min(2.0 * within, reach)) {
                candidates.clear();
                index.forEachNear(Vec3d(low), Vec3d(high), within,
                                  [&](const Ball& ball, std::int32_t i) {
                                      candidates.push_back({ball.center, ball.radius, i});
                                  });
                missing = false;
                for (std::size_t p = begin; p < stop; ++p) {
                    if (out[p] < 0) out[p] = nearest(points[p], candidates, float(within));
                    missing = missing || out[p] < 0;
                }
                if (within == reach) break;
            }
        }
    });
    return out;
}

} // namespace molsurf
