// SPDX-License-Identifier: MPL-2.0
#include "molsurf/balls/dense_caps.h"

#include "molsurf/balls/ball_caps.h"
#include "molsurf/balls/power_cell.h"

#include <algorithm>
#include <limits>
#include <queue>

namespace molsurf
{

using openvdb::Vec3d;

DenseCaps::DenseCaps(const std::vector<PlacedBall>& balls) : balls_(balls)
{
    while (leaves_ * bucket < balls.size()) leaves_ *= 2;
    Box empty;
    empty.low.fill(std::numeric_limits<std::int64_t>::max());
    empty.high.fill(std::numeric_limits<std::int64_t>::min());
    empty.largest = 0.0;
    boxes_.assign(2 * leaves_, empty);
    const auto widen = [](Box& box, const Box& by) {
        for (std::size_t a = 0; a < 3; ++a) {
            box.low[a] = std::min(box.low[a], by.low[a]);
            box.high[a] = std::max(box.high[a], by.high[a]);
        }
        box.largest = std::max(box.largest, by.largest);
    };
    for (std::size_t i = 0; i < balls.size(); ++i)
        widen(boxes_[leaves_ + i / bucket], {balls[i].place, balls[i].place, balls[i].radius});
    for (std::size_t n = leaves_; n-- > 1;) {
        widen(boxes_[n], boxes_[2 * n]);
        widen(boxes_[n], boxes_[2 * n + 1]);
    }
}

namespace
{

/// The square of the distance between x and a box, both relative to the same point [Å^2].
double distance2(const Vec3d& x, const Vec3d& low, const Vec3d& high)
{
    double sum = 0.0;
    for (int a = 0; a < 3; ++a) {
        const double d = std::max({0.0, low[a] - x[a], x[a] - high[a]});
        sum += d * d;
    }
    return sum;
}

} // namespace

double DenseCaps::powerFrom(const PlacedBall& ball, const Box& box) const
{
    if (box.low[0] > box.high[0]) return std::numeric_limits<double>::max();
    return distance2(Vec3d(0.0), offset(ball, {box.low, 0.0, 0}),
                     offset(ball, {box.high, 0.0, 0})) -
           box.largest * box.largest;
}

bool DenseCaps::mayReach(const PlacedBall& ball, const Box& box, const PowerCell& cell) const
{
    // A ball cuts off the points whose power distance to it is less than to the cell's own ball.
    const Vec3d low = offset(ball, {box.low, 0.0, 0}), high = offset(ball, {box.high, 0.0, 0});
    const double farthest = (Vec3d(std::max(-low.x(), high.x()), std::max(-low.y(), high.y()),
                                   std::max(-low.z(), high.z())))
                                .length();
    const double room = box.largest * box.largest - ball.radius * ball.radius +
                        2.0 * PowerCell::tolerance * farthest;
    for (const Vec3d& x : cell.outerPoints()) {
        if (distance2(x, low, high) <= x.lengthSqr() + room) return true;
    }
    return false;
}

bool DenseCaps::find(std::int32_t i, std::vector<Cap>& found) const
{
    const PlacedBall& ball = balls_[std::size_t(i)];
    PowerCell cell(ball.radius);
    std::priority_queue<Waiting> waiting;
    waiting.push({powerFrom(ball, boxes_[1]), 1});
    found.clear();
    while (!waiting.empty()) {
        const Waiting next = waiting.top();
        waiting.pop();
        if (!mayReach(ball, boxes_[next.node], cell)) continue;
        if (next.node < leaves_) {
            for (const std::size_t child : {2 * next.node, 2 * next.node + 1}) {
                const double power = powerFrom(ball, boxes_[child]);
                if (power < std::numeric_limits<double>::max()) waiting.push({power, child});
            }
            continue;
        }
        const std::size_t begin = (next.node - leaves_) * bucket;
        for (std::size_t j = begin; j < std::min(begin + bucket, balls_.size()); ++j) {
            Cap cap;
            if (j == std::size_t(i)) continue;
            const Relation relation = relate(ball, balls_[j], std::int32_t(j), cap);
            if (relation == Relation::Around) return false;
            const double height = ball.radius * cap.cosine;
            if (relation == Relation::Apart || !cell.reaches(cap.axis, height)) continue;
            found.push_back(cap);
            cell.cut(cap.axis, height);
            if (cell.isHidden()) return false;
        }
    }
    found.erase(std::remove_if(found.begin(), found.end(),
                               [&](const Cap& cap) {
                                   return !cell.touches(cap.axis, ball.radius * cap.cosine);
                               }),
                found.end());
    return true;
}

} // namespace molsurf
