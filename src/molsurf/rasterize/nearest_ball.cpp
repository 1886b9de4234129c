// SPDX-License-Identifier: MPL-2.0
#include "molsurf/rasterize/nearest_ball.h"

#include "molsurf/core/parallel.h"
#include "molsurf/rasterize/ball_index.h"

#include <algorithm>
#include <limits>

namespace molsurf
{

using openvdb::Vec3d;
using openvdb::Vec3f;

std::vector<std::int32_t> nearestBalls(const std::vector<Ball>& balls,
                                       const std::vector<Vec3f>& points, double reach,
                                       const Progress& progress)
{
    float largest = 0.0f;
    for (const Ball& ball : balls) largest = std::max(largest, ball.radius);
    const double cell = std::max(2.0, 0.5 * (largest + reach));
    const BallIndex index(balls, cell);

    // Points are taken by runs that stay in a box about as large as a cell, and share its
    // candidates.
    constexpr std::size_t chunk = 256;
    std::vector<std::int32_t> out(points.size(), -1);
    parallelFor((points.size() + chunk - 1) / chunk, progress, [&](std::size_t c) {
        struct Candidate {
            Vec3f center;
            float radius;
            std::int32_t i;
        };
        std::vector<Candidate> near;
        const std::size_t end = std::min(points.size(), (c + 1) * chunk);
        for (std::size_t begin = c * chunk, stop; begin < end; begin = stop) {
            Vec3f low = points[begin], high = points[begin];
            for (stop = begin + 1; stop < end; ++stop) {
                const Vec3f l = openvdb::math::minComponent(low, points[stop]);
                const Vec3f h = openvdb::math::maxComponent(high, points[stop]);
                if ((h - l).lengthSqr() > float(cell * cell)) break;
                low = l;
                high = h;
            }
            near.clear();
            index.forEachNear(Vec3d(low), Vec3d(high), largest + reach,
                              [&](const Ball& ball, std::int32_t i) {
                                  near.push_back({ball.center, ball.radius, i});
                              });
            for (std::size_t p = begin; p < stop; ++p) {
                float best = float(reach);
                for (const Candidate& b : near) {
                    const float limit = best + b.radius;
                    const float d2 = (points[p] - b.center).lengthSqr();
                    if (limit < 0.0f || d2 > limit * limit) continue;
                    const float gap = std::sqrt(d2) - b.radius;
                    if (gap < best || (gap == best && (out[p] < 0 || b.i < out[p]))) {
                        best = gap;
                        out[p] = b.i;
                    }
                }
            }
        }
    });
    return out;
}

} // namespace molsurf
