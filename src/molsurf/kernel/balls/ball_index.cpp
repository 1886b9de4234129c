// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/ball_index.h"

#include <tbb/parallel_sort.h>

namespace molsurf
{

using openvdb::Coord;

namespace
{

// Class 0 holds atoms and beads, each further one radii up to four times as large.
constexpr double firstLimit = 8.0, factor = 4.0; // [Å]

std::size_t classOf(double radius)
{
    std::size_t k = 0;
    for (double limit = firstLimit; radius >= limit; limit *= factor) ++k;
    return k;
}

} // namespace

BallIndex::BallIndex(const std::vector<Ball>& balls, const CellSize& cell)
{
    balls_.reserve(balls.size());
    order_.reserve(balls.size());
    std::vector<std::vector<std::int32_t>> classes;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const std::size_t k = classOf(balls[i].radius);
        if (k >= classes.size()) classes.resize(k + 1);
        classes[k].push_back(std::int32_t(i));
    }
    const double largest = cell.largest > 0.0 ? cell.largest : largestRadius(balls);
    double limit = firstLimit;
    for (const auto& members : classes) {
        const double radius = std::min(limit, largest);
        limit *= factor;
        if (members.empty()) continue;
        addLevel(balls, members, std::max(cell.least, cell.perRadius * (radius + cell.grown)));
    }
}

/// Adds the balls of a class, sorted by cells. Each column has a run of `begins_`: the place of the
/// first ball of each of its cells, and the end of the last.
void BallIndex::addLevel(const std::vector<Ball>& balls, const std::vector<std::int32_t>& members,
                         double cell)
{
    Level level{cell, 0.0, {}, 60};
    for (const std::int32_t i : members)
        level.largest = std::max(level.largest, double(balls[std::size_t(i)].radius));
    std::vector<std::pair<Coord, std::int32_t>> keyed(members.size());
    for (std::size_t i = 0; i < members.size(); ++i) {
        const Ball& ball = balls[std::size_t(members[i])];
        keyed[i] = {level.cellOf(openvdb::Vec3d(ball.center)), members[i]};
    }
    tbb::parallel_sort(keyed.begin(), keyed.end());

    const auto sameColumn = [&](std::size_t i, std::size_t j) {
        const Coord &a = keyed[i].first, &b = keyed[j].first;
        return a.x() == b.x() && a.y() == b.y() && a.z() >> blockBits == b.z() >> blockBits;
    };
    const std::size_t before = balls_.size();
    std::size_t count = 0;
    for (std::size_t i = 0; i < keyed.size(); ++i) {
        order_.push_back(keyed[i].second);
        balls_.push_back(balls[std::size_t(keyed[i].second)]);
        count += i == 0 || !sameColumn(i, i - 1);
    }
    std::size_t capacity = 16;
    for (; capacity < 2 * count; capacity *= 2) --level.shift;
    level.columns.assign(capacity, Column{0, 0, 0, 0});

    for (std::size_t begin = 0, end; begin < keyed.size(); begin = end) {
        for (end = begin; end < keyed.size() && sameColumn(begin, end);) ++end;
        const Coord first = keyed[begin].first;
        const int cells = keyed[end - 1].first.z() - first.z() + 1;
        const std::uint64_t key = columnKey(first.x(), first.y(), first.z() >> blockBits);
        level.columns[level.position(key)] = {key, std::int64_t(begins_.size()), first.z(), cells};
        std::size_t i = begin;
        for (int z = first.z(); z < first.z() + cells; ++z) {
            while (i < end && keyed[i].first.z() < z) ++i;
            begins_.push_back(std::int32_t(before + i));
        }
        begins_.push_back(std::int32_t(before + end));
    }
    levels_.push_back(std::move(level));
}

} // namespace molsurf
