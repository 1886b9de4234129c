// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/pockets/watershed.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <queue>
#include <tuple>
#include <utility>

namespace molsurf
{

namespace
{

/// The active voxels, those of large clearance first.
std::vector<VoxelPlace> fallingVoxels(const VoidField& space)
{
    std::vector<std::pair<float, VoxelPlace>> order;
    for (std::size_t n = 0; n < space.table.size(); ++n)
        space.table.active(n).forEach([&](int v) {
            order.emplace_back(-space.clearance.leaf(n)[v],
                               VoxelPlace(n * leafSize + std::size_t(v)));
        });
    tbb::parallel_sort(order.begin(), order.end());
    std::vector<VoxelPlace> out;
    out.reserve(order.size());
    for (const auto& [value, place] : order) out.push_back(place);
    return out;
}

/// Parts that grow and join.
class Parts
{
public:
    explicit Parts(double share) : share_(float(share)) {}

    /// @param[in] isKnown  whether the places where it meets other known ones are given
    std::int32_t add(float peak, bool isKnown = false)
    {
        const auto part = std::int32_t(parents_.size());
        parents_.push_back(part);
        peaks_.push_back(peak);
        isKnown_.push_back(isKnown);
        return part;
    }

    std::int32_t find(std::int32_t part)
    {
        while (parents_[std::size_t(part)] != part) {
            auto& up = parents_[std::size_t(part)];
            up = parents_[std::size_t(up)];
            part = up;
        }
        return part;
    }

    /// Two roots meet.
    /// @return the root of the one that they become, or the first
    std::int32_t meet(std::int32_t a, std::int32_t b, float clearance)
    {
        const float lower = std::min(peaks_[std::size_t(a)], peaks_[std::size_t(b)]);
        if (clearance >= share_ * lower) return join(a, b);
        note(a, b, clearance);
        return a;
    }

    /// Two roots touch and stay apart.
    void note(std::int32_t a, std::int32_t b, float clearance)
    {
        auto& neck = necks_[std::minmax(a, b)];
        neck = std::max(neck, clearance);
    }

    std::int32_t join(std::int32_t a, std::int32_t b)
    {
        const auto [first, last] = std::minmax(a, b);
        parents_[std::size_t(last)] = first;
        auto& peak = peaks_[std::size_t(first)];
        peak = std::max(peak, peaks_[std::size_t(last)]);
        isKnown_[std::size_t(first)] |= isKnown_[std::size_t(last)];
        return first;
    }

    /// The necks between roots, without those within one.
    std::map<std::pair<std::int32_t, std::int32_t>, float> necks()
    {
        std::map<std::pair<std::int32_t, std::int32_t>, float> out;
        for (const auto& [pair, clearance] : necks_) {
            const std::int32_t a = find(pair.first), b = find(pair.second);
            if (a == b) continue;
            auto& neck = out[std::minmax(a, b)];
            neck = std::max(neck, clearance);
        }
        return out;
    }

    std::size_t size() const { return parents_.size(); }
    float peak(std::int32_t part) const { return peaks_[std::size_t(part)]; }
    bool splits() const { return share_ > 0.0f; }
    bool isKnown(std::int32_t root) const { return isKnown_[std::size_t(root)] != 0; }

private:
    float share_;
    std::vector<std::int32_t> parents_;
    std::vector<float> peaks_; // of roots the largest
    std::vector<char> isKnown_;
    std::map<std::pair<std::int32_t, std::int32_t>, float> necks_;
};

/// Small parts join the neighbour with the widest neck, the smallest first.
void joinSmall(const std::vector<std::size_t>& sizes, double leastVoxels, Parts& parts)
{
    using Neighbour = std::pair<float, std::int32_t>; // by a neck, and it
    std::vector<std::size_t> size(parts.size(), 0);
    for (std::size_t p = 0; p < sizes.size(); ++p)
        size[std::size_t(parts.find(std::int32_t(p)))] += sizes[p];
    std::vector<std::vector<Neighbour>> near(parts.size());
    for (const auto& [pair, clearance] : parts.necks()) {
        near[std::size_t(pair.first)].emplace_back(clearance, pair.second);
        near[std::size_t(pair.second)].emplace_back(clearance, pair.first);
    }
    std::vector<std::int32_t> small;
    for (std::size_t p = 0; p < size.size(); ++p)
        if (size[p] > 0 && double(size[p]) < leastVoxels) small.push_back(std::int32_t(p));
    std::sort(small.begin(), small.end(), [&](std::int32_t a, std::int32_t b) {
        return std::pair(size[std::size_t(a)], a) < std::pair(size[std::size_t(b)], b);
    });
    for (const std::int32_t p : small) {
        const std::int32_t own = parts.find(p); // another one that was small, perhaps
        if (double(size[std::size_t(own)]) >= leastVoxels) continue;
        Neighbour best(-1.0f, -1);
        for (const auto& [clearance, other] : near[std::size_t(own)]) {
            const std::int32_t root = parts.find(other);
            if (root != own) best = std::max(best, Neighbour(clearance, root));
        }
        if (best.second < 0) continue;
        const std::int32_t root = parts.join(own, best.second),
                           last = root == own ? best.second : own;
        size[std::size_t(root)] += size[std::size_t(last)];
        auto& kept = near[std::size_t(root)];
        kept.insert(kept.end(), near[std::size_t(last)].begin(), near[std::size_t(last)].end());
    }
}

/// Gives the parts that voxels are in numbers, in the order of the parts, and lists their peaks and
/// necks.
/// @param[in,out] basins  of voxels their parts, then the numbers of these
/// @return of each part its number, or -1: no voxel is in it
std::vector<std::int32_t> number(Parts& parts, const std::vector<VoxelPlace>& order, Basins& basins)
{
    const auto at = [&](VoxelPlace place) -> std::int32_t& {
        return basins.of.leaf(place / leafSize)[place % leafSize];
    };
    std::vector<char> isUsed(parts.size(), 0);
    for (const VoxelPlace place : order) isUsed[std::size_t(parts.find(at(place)))] = 1;
    std::vector<std::int32_t> numbers(parts.size(), -1);
    for (std::size_t p = 0; p < numbers.size(); ++p) {
        const std::int32_t root = parts.find(std::int32_t(p));
        if (!isUsed[std::size_t(root)]) continue;
        auto& number = numbers[std::size_t(root)];
        if (number < 0) {
            number = std::int32_t(basins.peaks.size());
            basins.peaks.push_back(parts.peak(root));
        }
        numbers[p] = number;
    }
    for (const VoxelPlace place : order) at(place) = numbers[std::size_t(at(place))];
    for (const auto& [pair, clearance] : parts.necks()) {
        const auto [a, b] =
            std::minmax(numbers[std::size_t(pair.first)], numbers[std::size_t(pair.second)]);
        if (a >= 0) basins.necks.push_back({{a, b}, clearance});
    }
    return numbers;
}

openvdb::Vec3d pointAt(const VoidField& space, VoxelPlace place)
{
    const int v = int(place % leafSize);
    return space.table.origin(place / leafSize).offsetBy(v >> 6, v >> 3 & 7, v & 7).asVec3d() *
           space.voxelSize;
}

float clearanceAt(const VoidField& space, VoxelPlace place)
{
    return space.clearance.leaf(place / leafSize)[place % leafSize];
}

/// The active voxel nearest to a place among the 8 about it, if there is one.
std::optional<VoxelPlace> voxelAbout(const VoidField& space, const openvdb::Vec3d& x)
{
    const openvdb::Vec3d at = x / space.voxelSize;
    const openvdb::Coord low = openvdb::Coord::floor(at);
    double least = std::numeric_limits<double>::infinity();
    std::optional<VoxelPlace> best;
    for (int k = 0; k < 8; ++k) {
        const openvdb::Coord voxel = low.offsetBy(k >> 2, k >> 1 & 1, k & 1);
        const std::int32_t leaf = space.table.find(voxel);
        const int place = (voxel[0] & 7) << 6 | (voxel[1] & 7) << 3 | (voxel[2] & 7);
        const double square = (voxel.asVec3d() - at).lengthSqr();
        if (leaf < 0 || square >= least || !(space.room(std::size_t(leaf), place) > 0.0f)) continue;
        least = square;
        best = VoxelPlace(std::size_t(leaf) * leafSize + std::size_t(place));
    }
    return best;
}

/// The voxels beside which none has more clearance, in the order of all.
std::vector<VoxelPlace> maximaOf(const VoidField& space, const std::vector<VoxelPlace>& order)
{
    std::vector<VoxelPlace> out;
    for (const VoxelPlace place : order) {
        const float own = clearanceAt(space, place);
        bool isHighest = true;
        forEachJoined(space.table, place, [&](VoxelPlace other) {
            if (!(space.room(other / leafSize, int(other % leafSize)) > 0.0f)) return;
            const float there = clearanceAt(space, other);
            if (there > own || (there == own && other < place)) isHighest = false;
        });
        if (isHighest) out.push_back(place);
    }
    return out;
}

/// Parts that begin at voxels, and flow from there to those of less clearance.
struct Springs {
    std::vector<std::pair<VoxelPlace, std::int32_t>> marks; ///< voxels, and the parts of these
    std::vector<std::int32_t> tops; ///< of each maximum its part; -1, or none: one of its own
};

/// Gives each voxel a part: that of its mark, else that of the highest voxel beside it. Parts meet
/// where they touch; where some are known two of these stay apart, and what is of none, where only
/// the rim of a probe gets, joins one.
/// @param[in] order  fallingVoxels()
/// @return how many voxels each part has
std::vector<std::size_t> flood(const VoidField& space, const std::vector<VoxelPlace>& order,
                               const Springs& springs, Parts& parts, Basins& out)
{
    constexpr std::int32_t none = -1; // what is less is the mark of part -2 - it
    out.of = LeafArray<std::int32_t>(space.table.size());
    for (std::size_t n = 0; n < space.table.size(); ++n)
        std::fill_n(out.of.leaf(n), leafSize, none);
    const auto at = [&](VoxelPlace place) -> std::int32_t& {
        return out.of.leaf(place / leafSize)[place % leafSize];
    };
    for (const auto& [place, part] : springs.marks) {
        const std::int32_t before = -2 - at(place);
        if (before < 0 || parts.peak(part) > parts.peak(before)) at(place) = -2 - part;
    }
    std::vector<std::size_t> sizes(parts.size(), 0);
    std::size_t maximum = 0;
    for (const VoxelPlace place : order) {
        std::int32_t highest = none;
        float most = 0.0f;
        forEachJoined(space.table, place, [&](VoxelPlace other) {
            if (at(other) < 0 || clearanceAt(space, other) <= most) return;
            most = clearanceAt(space, other);
            highest = at(other);
        });
        std::int32_t own = at(place) == none ? highest : -2 - at(place);
        if (highest == none) {
            if (own == none && maximum < springs.tops.size()) own = springs.tops[maximum];
            ++maximum;
        }
        if (own == none) {
            own = parts.add(clearanceAt(space, place));
            sizes.push_back(0);
        }
        at(place) = own;
        ++sizes[std::size_t(own)];
        std::int32_t root = parts.find(own);
        forEachJoined(space.table, place, [&](VoxelPlace other) {
            if (at(other) < 0) return;
            const std::int32_t met = parts.find(at(other));
            if (met == root) return;
            if (parts.isKnown(met) && parts.isKnown(root) && parts.splits())
                parts.note(root, met, clearanceAt(space, place));
            else
                root = springs.tops.empty() ? parts.meet(root, met, clearanceAt(space, place))
                                            : parts.join(root, met);
        });
    }
    return sizes;
}

/// The nodes and exits of a graph below the cut, where the clearance is largest, as parts: first
/// all nodes, then the exits.
class CutParts
{
public:
    CutParts(const VoidGraph& graph, const CutGraph& cut) : graph_(graph), cut_(cut) {}

    std::int32_t ofExit(std::size_t exit) const { return std::int32_t(graph_.nodes.size() + exit); }

    void addTo(Parts& parts) const
    {
        for (std::size_t n = 0; n < graph_.nodes.size(); ++n)
            parts.add(cut_.isBelow[n] ? float(graph_.nodes[n].clearance) : 0.0f, true);
        for (const CutGraph::Exit& exit : cut_.exits) parts.add(float(exit.end.clearance), true);
    }

    /// Joins them, the widest places where two meet first.
    void join(const Clearance& clearance, const BelowCut& below, Parts& parts) const
    {
        std::priority_queue<Meeting> open = meetings();
        while (!open.empty()) {
            const Meeting next = open.top();
            open.pop();
            const std::int32_t a = parts.find(next.first), b = parts.find(next.last);
            if (a == b) continue;
            if (next.arc < 0) {
                parts.meet(a, b, next.width);
                continue;
            }
            // Its width is not known yet: no more than this.
            const double width =
                widthOf(cut_.arcs[std::size_t(next.arc)], cut_, graph_, clearance, below);
            if (width >= graph_.floor)
                open.push({std::min(float(width), next.width), -1, next.first, next.last});
        }
    }

    /// Where parts begin.
    /// @param[in] maxima  the starts of the graph
    Springs springs(const VoidField& space, const Rooms& rooms) const
    {
        Springs out;
        const auto mark = [&](const openvdb::Vec3d& x, std::int32_t part) {
            if (const auto place = voxelAbout(space, x)) out.marks.emplace_back(*place, part);
        };
        for (std::size_t n = 1; n < graph_.nodes.size(); ++n)
            if (cut_.isBelow[n] && graph_.nodes[n].balls[2] != VoidGraph::none)
                mark(graph_.nodes[n].place, std::int32_t(n));
        std::vector<std::int32_t> exitBy(graph_.edges.size(), -1);
        for (std::size_t e = 0; e < cut_.exits.size(); ++e) {
            const CutGraph::Exit& exit = cut_.exits[e];
            if (isOfEdge(exit)) mark(exit.end.place, ofExit(e));
            if (exit.edge != VoidGraph::none) exitBy[std::size_t(exit.edge)] = std::int32_t(e);
        }
        for (const std::int32_t start : graph_.starts)
            out.tops.push_back(topAbove(start, rooms, exitBy, 2.0 * space.voxelSize));
        return out;
    }

private:
    /// Where two parts meet.
    struct Meeting {
        float width; ///< [Å]
        std::int32_t arc;
        std::int32_t first, last;
        bool operator<(const Meeting& other) const
        {
            if (width != other.width) return width < other.width;
            return std::tuple(arc, first, last) > std::tuple(other.arc, other.first, other.last);
        }
    };

    std::priority_queue<Meeting> meetings() const
    {
        std::priority_queue<Meeting> out;
        for (const VoidGraph::Edge& edge : graph_.edges) {
            const auto& [a, b] = edge.nodes;
            if (a != b && cut_.isBelow[std::size_t(a)] && cut_.isBelow[std::size_t(b)])
                out.push({float(edge.clearance), -1, a, b});
        }
        const std::vector<CutGraph::Exit>& exits = cut_.exits;
        for (std::size_t e = 0; e < exits.size(); ++e)
            if (exits[e].node != VoidGraph::none)
                out.push({float(exits[e].least), -1, exits[e].node, ofExit(e)});
        for (std::size_t k = 0; k < cut_.arcs.size(); ++k) {
            const auto a = std::size_t(cut_.arcs[k].exits[0]),
                       b = std::size_t(cut_.arcs[k].exits[1]);
            out.push({float(std::min(exits[a].end.clearance, exits[b].end.clearance)),
                      std::int32_t(k), ofExit(a), ofExit(b)});
        }
        return out;
    }

    /// Whether an exit is of an edge, not of a way up to one.
    static bool isOfEdge(const CutGraph::Exit& exit) { return exit.balls[2] != VoidGraph::none; }

    /// The room or the exit that the way up from a node leads to, or -1.
    std::int32_t topAbove(std::int32_t n, const Rooms& rooms,
                          const std::vector<std::int32_t>& exitBy, double reach) const
    {
        if (n == VoidGraph::none || !cut_.isBelow[std::size_t(n)]) return -1;
        for (std::int32_t e; (e = rooms.up[std::size_t(n)]) != VoidGraph::none;) {
            const auto& ends = graph_.edges[std::size_t(e)].nodes;
            n = ends[ends[0] == n ? 1 : 0];
            if (cut_.isBelow[std::size_t(n)]) continue;
            const std::int32_t exit = exitBy[std::size_t(e)];
            return exit < 0 ? -1 : nearestExit(std::size_t(exit), reach);
        }
        return n;
    }

    /// The part of an exit, or, if it is of a way up to an edge, of the nearest one of an edge, or
    /// -1.
    std::int32_t nearestExit(std::size_t exit, double reach) const
    {
        const std::vector<CutGraph::Exit>& exits = cut_.exits;
        if (isOfEdge(exits[exit])) return ofExit(exit);
        std::int32_t best = -1;
        double least = reach;
        for (std::size_t e = 0; e < exits.size(); ++e) {
            const double distance = (exits[e].end.place - exits[exit].end.place).length();
            if (!isOfEdge(exits[e]) || distance >= least) continue;
            least = distance;
            best = ofExit(e);
        }
        return best;
    }

    const VoidGraph& graph_;
    const CutGraph& cut_;
};

/// The largest clearance of the voxels of each basin.
void takePeaks(const VoidField& space, const std::vector<VoxelPlace>& order, Basins& basins)
{
    for (auto place = order.rbegin(); place != order.rend(); ++place) // the widest is the last
        basins.peaks[std::size_t(basins.of.leaf(*place / leafSize)[*place % leafSize])] =
            clearanceAt(space, *place);
}

} // namespace

Basins splitAtNecks(const VoidField& space, double share, double leastVoxels)
{
    const std::vector<VoxelPlace> order = fallingVoxels(space);
    Parts parts(share);
    Basins out;
    const std::vector<std::size_t> sizes = flood(space, order, {}, parts, out);
    joinSmall(sizes, leastVoxels, parts);
    number(parts, order, out);
    return out;
}

RoomBasins splitAtRooms(const std::vector<Ball>& balls, double probe, const VoidField& space,
                        const SplitRule& rule, const BelowCut& below, const Progress& progress)
{
    const std::vector<VoxelPlace> order = fallingVoxels(space);
    std::vector<openvdb::Vec3d> maxima;
    for (const VoxelPlace place : maximaOf(space, order)) maxima.push_back(pointAt(space, place));
    RoomBasins out{{}, voidGraph(balls, probe, maxima, progress), {}, {}};
    out.cut = cutGraph(out.graph, space, below, progress);
    const CutParts known(out.graph, out.cut);
    Parts parts(rule.share);
    known.addTo(parts);
    known.join(Clearance(balls), below, parts);
    const std::vector<std::size_t> sizes =
        flood(space, order, known.springs(space, roomsOf(out.graph)), parts, out.basins);
    joinSmall(sizes, rule.leastVoxels, parts);
    out.ofNodes = number(parts, order, out.basins);
    out.ofNodes.resize(out.graph.nodes.size());
    for (std::size_t n = 0; n < out.ofNodes.size(); ++n)
        if (!out.cut.isBelow[n]) out.ofNodes[n] = -1;
    takePeaks(space, order, out.basins);
    return out;
}

} // namespace molsurf
