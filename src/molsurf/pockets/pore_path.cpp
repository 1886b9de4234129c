// SPDX-License-Identifier: MPL-2.0
#include "molsurf/pockets/pore_path.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace molsurf
{

namespace
{

using openvdb::Vec3d;

/// What is outside counts as a place with so little room [Å]: less than between the atoms of a
/// closed gate, where a way around the molecule would be taken for one through it.
constexpr double outsideRoom = -1.0;

/// Ways that cost the same are e times as long where there is this much more room [Å]. Less: the
/// way creeps between helices where a gate is hardly narrower; more: it cuts corners.
// measured: vdb_molsurf FILE --pore auto of gramicidin and of the glycine receptors 7tu9 and 8fe1
// goes through the pore; with 0.05 Å the way of 7tu9 made 200 Å of detours
constexpr double roomScale = 0.25;

/// Cost of an Å.
double weightOf(double room)
{
    return std::exp(-room / roomScale);
}

constexpr double never = std::numeric_limits<double>::infinity();

/// A point with its value: the least first, of equals the lower index.
using Entry = std::pair<double, std::size_t>;

/// Dijkstra's search over a lattice: the value of a point follows from that of the one before it,
/// and never falls.
class Search
{
public:
    explicit Search(const PoreGrid& grid)
        : grid_(grid), value_(grid.size(), std::numeric_limits<double>::infinity()),
          back_(grid.size(), 0)
    {
    }

    void begin(std::size_t cell, double value)
    {
        value_[cell] = value;
        back_[cell] = std::uint32_t(cell);
        queue_.emplace(value, cell);
    }

    /// @param[in] next   (value, cell, next cell, step) -> its value; infinite: no step is possible
    /// @param[in] isEnd  ends the search at a point
    template<typename Next, typename IsEnd>
    void run(const Next& next, const IsEnd& isEnd, const Progress& progress)
    {
        constexpr std::size_t often = 65536;
        for (std::size_t steps = 1; !queue_.empty(); ++steps) {
            const Entry top = queue_.top();
            queue_.pop();
            if (top.first > value_[top.second]) continue;
            if (isEnd(top.second)) return;
            if (steps % often == 0 && progress.cancelled()) throw Cancelled();
            grid_.forEachNeighbour(top.second, [&](std::size_t other, double step) {
                const double value = next(top.first, top.second, other, step);
                if (!(value < value_[other])) return;
                value_[other] = value;
                back_[other] = std::uint32_t(top.second);
                queue_.emplace(value, other);
            });
        }
    }

    double value(std::size_t cell) const { return value_[cell]; }

    std::vector<std::size_t> wayTo(std::size_t cell) const
    {
        std::vector<std::size_t> out = {cell};
        while (back_[cell] != cell) out.push_back(cell = back_[cell]);
        std::reverse(out.begin(), out.end());
        return out;
    }

private:
    const PoreGrid& grid_;
    std::vector<double> value_;
    std::vector<std::uint32_t> back_; // the point before each; itself: it is the first
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

/// A way from its middle to both sides until it could as well leave what is enclosed: what is left
/// of it there leads into crevices of the rim.
std::vector<std::size_t> untilItOpens(const PoreGrid& grid, const std::vector<std::size_t>& way)
{
    const auto opens = [&](std::size_t cell) {
        bool out = false;
        grid.forEachNeighbour(cell, [&](std::size_t next, double) {
            out = out || (!grid.isEnclosed(next) && grid.room(next) >= grid.room(cell));
        });
        return out;
    };
    std::size_t begin = way.size() / 2, end = begin;
    while (begin > 0 && !opens(way[begin])) --begin;
    while (end + 1 < way.size() && !opens(way[end])) ++end;
    return {way.begin() + std::ptrdiff_t(begin), way.begin() + std::ptrdiff_t(end) + 1};
}

} // namespace

PorePath widestPath(const PoreGrid& grid, std::size_t from, std::size_t to, const PathRule& rule,
                    const Progress& progress)
{
    const Vec3d ends[2] = {grid.place(from), grid.place(to)};
    const auto isOutside = [&](std::size_t cell) {
        if (grid.isEnclosed(cell)) return false;
        const Vec3d x = grid.place(cell);
        return (x - ends[0]).length() > rule.near && (x - ends[1]).length() > rule.near;
    };
    const auto weight = [&](std::size_t cell) {
        const double room = grid.room(cell);
        return weightOf(room > outsideRoom && isOutside(cell) ? outsideRoom : room);
    };
    Search search(grid);
    search.begin(from, 0.0);
    search.run(
        [&](double value, std::size_t cell, std::size_t next, double step) {
            if (rule.rises && grid.isBelow(next, cell)) return never;
            return value + 0.5 * step * (weight(cell) + weight(next));
        },
        [&](std::size_t cell) { return cell == to; }, progress);
    PorePath out{search.wayTo(to), search.value(to)};
    for (std::size_t i = 1; i < out.cells.size(); ++i) {
        if (!isOutside(out.cells[i])) continue;
        if (out.outside == 0.0) out.leaves = out.cells[i];
        out.outside += (grid.place(out.cells[i]) - grid.place(out.cells[i - 1])).length();
    }
    return out;
}

std::optional<PorePath> throughPath(const PoreGrid& grid, const Progress& progress)
{
    constexpr double wide = 0.7; // a way ends rather than going on where it is narrower [Å]
    const auto isMouth = [&](std::size_t cell) {
        if (!grid.isEnclosed(cell) || grid.room(cell) < wide) return false;
        bool opens = false;
        grid.forEachNeighbour(cell, [&](std::size_t next, double) {
            opens = opens || (!grid.isEnclosed(next) && grid.room(next) >= wide);
        });
        return opens;
    };
    std::vector<std::size_t> mouths;
    for (std::size_t cell = 0; cell < grid.size(); ++cell)
        if (isMouth(cell)) mouths.push_back(cell);
    const double low = grid.height(0), high = grid.height(grid.size() - 1);
    const double perLost = weightOf(wide);
    Search search(grid);
    for (const std::size_t mouth : mouths)
        search.begin(mouth, perLost * (grid.height(mouth) - low));
    search.run(
        [&](double value, std::size_t cell, std::size_t next, double step) {
            if (!grid.isEnclosed(next) || grid.isBelow(next, cell)) return never;
            return value + 0.5 * step * (weightOf(grid.room(cell)) + weightOf(grid.room(next)));
        },
        [](std::size_t) { return false; }, progress);
    std::optional<PorePath> best;
    std::size_t end = 0;
    for (const std::size_t mouth : mouths) {
        const double cost = search.value(mouth) / perLost + high - grid.height(mouth);
        if (best && cost >= best->cost) continue;
        best = PorePath{{}, cost};
        end = mouth;
    }
    if (best) best->cells = untilItOpens(grid, search.wayTo(end));
    return best;
}

} // namespace molsurf
