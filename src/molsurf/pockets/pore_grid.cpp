// SPDX-License-Identifier: MPL-2.0
#include "molsurf/pockets/pore_grid.h"

#include "molsurf/balls/ball_index.h"
#include "molsurf/core/parallel.h"
#include "molsurf/core/perpendicular.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

namespace
{

using openvdb::Vec3d;

/// Where less fits than this, there is a wall: gaps between atoms that touch are no windows [Å].
constexpr float wallRoom = 0.4f;

/// Directions in a layer, every 22.5 degrees or so.
constexpr int layerDirections[16][2] = {{1, 0},  {2, 1},  {1, 1},  {1, 2},   {0, 1},   {-1, 2},
                                        {-1, 1}, {-2, 1}, {-1, 0}, {-2, -1}, {-1, -1}, {-1, -2},
                                        {0, -1}, {1, -2}, {1, -1}, {2, -1}};

/// Lowers the room of points begin to end of a row to the distance to a ball, where that is less.
/// @param[in] at  the ball's place along the row, its squared distance from the row, its radius
void lower(float* row, int begin, int end, double start, double spacing, const Vec3d& at)
{
    const float x0 = float(start - at[0]), h = float(spacing), c = float(at[1]), r = float(at[2]);
    for (int i = begin; i < end; ++i) {
        const float x = x0 + h * float(i);
        row[i] = std::min(row[i], std::sqrt(x * x + c) - r);
    }
}

} // namespace

std::array<Vec3d, 3> PoreGrid::frameOf(const Vec3d& axis)
{
    const std::array<Vec3d, 2> across = perpendicular(axis);
    return {across[0], across[1], axis};
}

PoreGrid::PoreGrid(const std::vector<Ball>& balls, const Extent& extent, const Progress& progress)
    : extent_(extent), frame_(frameOf(extent.axis))
{
    for (int i = 0; i < 3; ++i)
        count_[std::size_t(i)] =
            1 + std::max(1, int(std::ceil((extent.high[i] - extent.low[i]) / extent.spacing)));
    room_.assign(std::size_t(count_[0]) * std::size_t(count_[1]) * std::size_t(count_[2]),
                 mostRoom);
    open_.assign(room_.size(), 0);
    std::vector<Ball> turned = balls;
    for (Ball& ball : turned)
        ball.center = {ball.center.dot(frame_[0]), ball.center.dot(frame_[1]),
                       ball.center.dot(frame_[2])};
    std::sort(turned.begin(), turned.end(),
              [](const Ball& a, const Ball& b) { return a.center[2] < b.center[2]; });
    const double largest = largestRadius(balls);
    parallelFor(std::size_t(count_[2]), progress, [&](std::size_t layer) {
        fillLayer(int(layer), turned, largest);
        findOpen(int(layer));
    });
}

/// @param[in] sorted  balls in the lattice's frame, ascending along the axis
void PoreGrid::fillLayer(int layer, const std::vector<Ball>& sorted, double largest)
{
    const double height = extent_.low[2] + layer * extent_.spacing, reach = largest + mostRoom;
    const auto below = [](const Ball& ball, double h) { return ball.center[2] < h; };
    auto ball = std::lower_bound(sorted.begin(), sorted.end(), height - reach, below);
    for (; ball != sorted.end() && ball->center[2] <= height + reach; ++ball) {
        const double own = ball->radius + mostRoom, dz = ball->center[2] - height;
        if (std::abs(dz) >= own) continue;
        const double across = std::sqrt(own * own - dz * dz), h = extent_.spacing;
        const auto range = [&](int i, double half) {
            const double middle = ball->center[i] - extent_.low[i];
            return std::array<int, 2>{
                std::clamp(int(std::ceil((middle - half) / h)), 0, count_[std::size_t(i)]),
                std::clamp(int(std::floor((middle + half) / h)) + 1, 0, count_[std::size_t(i)])};
        };
        const std::array<int, 2> rows = range(1, across);
        for (int j = rows[0]; j < rows[1]; ++j) {
            const double dy = extent_.low[1] + j * h - ball->center[1];
            const double half = std::sqrt(std::max(across * across - dy * dy, 0.0));
            const std::array<int, 2> columns = range(0, half);
            lower(&room_[index({0, j, layer})], columns[0], columns[1], extent_.low[0], h,
                  {ball->center[0], dy * dy + dz * dz, ball->radius});
        }
    }
}

/// Counts the free ones of 16 directions at the points of a layer: sweeps carry the least room on
/// the way from point to point, so that no ray is followed for each.
void PoreGrid::findOpen(int layer)
{
    const std::size_t begin = index({0, 0, layer});
    // The least room on the way from each point. It is a wall for a narrow point only where it is
    // narrower still: a dent in the outside has none in front of it.
    std::vector<float> least(std::size_t(count_[0]) * std::size_t(count_[1]));
    for (const auto& way : layerDirections) {
        // Each point is behind the one that its way comes from.
        for (int row = 0; row < count_[1]; ++row) {
            const int j = way[1] >= 0 ? row : count_[1] - 1 - row;
            for (int column = 0; column < count_[0]; ++column) {
                const int i = way[0] >= 0 ? column : count_[0] - 1 - column;
                const std::size_t at = index({i, j, 0});
                const std::array<int, 3> from = {i - way[0], j - way[1], 0};
                least[at] =
                    has(from) ? std::min(least[index(from)], room_[begin + index(from)]) : mostRoom;
                const bool wall = least[at] < std::min(wallRoom, room_[begin + at]);
                open_[begin + at] = std::uint8_t(open_[begin + at] + !wall);
            }
        }
    }
}

std::array<int, 3> PoreGrid::cornerOf(std::size_t cell) const
{
    const std::size_t nx = std::size_t(count_[0]), ny = std::size_t(count_[1]);
    return {int(cell % nx), int(cell / nx % ny), int(cell / (nx * ny))};
}

Vec3d PoreGrid::place(std::size_t cell) const
{
    const std::array<int, 3> at = cornerOf(cell);
    Vec3d out(0.0);
    for (int i = 0; i < 3; ++i)
        out += frame_[std::size_t(i)] * (extent_.low[i] + at[std::size_t(i)] * extent_.spacing);
    return out;
}

double PoreGrid::height(std::size_t cell) const
{
    return extent_.low[2] + cornerOf(cell)[2] * extent_.spacing;
}

std::array<int, 3> PoreGrid::corner(const Vec3d& x) const
{
    std::array<int, 3> at;
    for (int i = 0; i < 3; ++i)
        at[std::size_t(i)] =
            int(std::lround((x.dot(frame_[std::size_t(i)]) - extent_.low[i]) / extent_.spacing));
    return at;
}

std::size_t PoreGrid::nearest(const Vec3d& x) const
{
    std::array<int, 3> at = corner(x);
    for (std::size_t i = 0; i < 3; ++i) at[i] = std::clamp(at[i], 0, count_[i] - 1);
    return index(at);
}

bool PoreGrid::covers(const Vec3d& x) const
{
    return has(corner(x));
}

} // namespace molsurf
