// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/nearest_ball.h"

#include "molsurf/kernel/balls/ball_index.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/core/simd.h"

#include <algorithm>
#include <limits>

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

/// Points, and the ball that each belongs to as far as balls were looked at.
struct Points {
    float x[3][floatLanes];
    float gap[floatLanes]; ///< to that ball
    std::int32_t ball[floatLanes];
};

MOLSURF_KERNEL void lookAt(const std::vector<Candidate>& candidates, Points& points)
{
    const Floats x = load(points.x[0]), y = load(points.x[1]), z = load(points.x[2]);
    Floats least = load(points.gap);
    Ints ball = load(points.ball);
    for (const Candidate& b : candidates) {
        const Floats dx = x - b.center[0], dy = y - b.center[1], dz = z - b.center[2];
        const Floats gap = squareRoot(dx * dx + dy * dy + dz * dz) - b.radius;
        const Ints i = splat(b.i);
        ball = (gap < least) | ((gap == least) & (i < ball)) ? i : ball;
        least = gap < least ? gap : least;
    }
    store(points.ball, ball);
}

/// Finds the balls of points that have none, as far as they are within a distance.
/// @return whether all of them have one now
bool findNearest(const std::vector<Vec3f>& points, std::size_t begin, std::size_t end,
                 const std::vector<Candidate>& candidates, float within,
                 std::vector<std::int32_t>& out)
{
    constexpr std::int32_t none = std::numeric_limits<std::int32_t>::max();
    bool all = true;
    for (std::size_t first = begin; first < end; first += floatLanes) {
        const std::size_t used = std::min<std::size_t>(floatLanes, end - first);
        Points lanes;
        for (std::size_t l = 0; l < floatLanes; ++l) {
            for (int a = 0; a < 3; ++a) lanes.x[a][l] = points[first + std::min(l, used - 1)][a];
            lanes.gap[l] = within;
            lanes.ball[l] = none;
        }
        lookAt(candidates, lanes);
        for (std::size_t l = 0; l < used; ++l) {
            if (out[first + l] < 0 && lanes.ball[l] != none) out[first + l] = lanes.ball[l];
            all = all && out[first + l] >= 0;
        }
    }
    return all;
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
    constexpr float runSize = 6.0f; // [Å]
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
                index.forEachNear(
                    Vec3d(low), Vec3d(high), within, [&](const Ball& ball, std::int32_t i) {
                        candidates.push_back({Vec3f(ball.center), float(ball.radius), i});
                    });
                missing = !findNearest(points, begin, stop, candidates, float(within), out);
                if (within == reach) break;
            }
        }
    });
    return out;
}

} // namespace molsurf
