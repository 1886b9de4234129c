// SPDX-License-Identifier: MPL-2.0
#include "molsurf/rasterize/ball_index.h"

#include <tbb/parallel_sort.h>

namespace molsurf
{

using openvdb::Coord;

BallIndex::BallIndex(const std::vector<Ball>& balls, double cell) : cell_(cell)
{
    std::vector<std::pair<Coord, std::int32_t>> keyed(balls.size());
    for (std::size_t i = 0; i < balls.size(); ++i) {
        keyed[i] = {cellOf(openvdb::Vec3d(balls[i].center)), std::int32_t(i)};
    }
    tbb::parallel_sort(keyed.begin(), keyed.end());

    const auto sameColumn = [&](std::size_t i, std::size_t j) {
        const Coord &a = keyed[i].first, &b = keyed[j].first;
        return a.x() == b.x() && a.y() == b.y() && a.z() >> blockBits == b.z() >> blockBits;
    };
    std::size_t count = 0;
    balls_.resize(balls.size());
    order_.resize(balls.size());
    for (std::size_t i = 0; i < keyed.size(); ++i) {
        order_[i] = keyed[i].second;
        balls_[i] = balls[order_[i]];
        count += i == 0 || !sameColumn(i, i - 1);
    }
    std::size_t capacity = 16;
    while (capacity < 2 * count) capacity *= 2;
    columns_.assign(capacity, Column{0, 0, 0, 0});

    for (std::size_t begin = 0, end; begin < keyed.size(); begin = end) {
        for (end = begin; end < keyed.size() && sameColumn(begin, end);) ++end;
        const Coord first = keyed[begin].first;
        const int cells = keyed[end - 1].first.z() - first.z() + 1;
        const std::uint64_t key = columnKey(first.x(), first.y(), first.z() >> blockBits);
        columns_[position(key)] = {key, std::int64_t(begins_.size()), first.z(), cells};
        std::size_t i = begin;
        for (int z = first.z(); z < first.z() + cells; ++z) {
            while (i < end && keyed[i].first.z() < z) ++i;
            begins_.push_back(std::int32_t(i));
        }
        begins_.push_back(std::int32_t(end));
    }
}

} // namespace molsurf
