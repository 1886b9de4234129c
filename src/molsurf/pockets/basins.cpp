// SPDX-License-Identifier: MPL-2.0
#include "molsurf/pockets/basins.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <map>
#include <numeric>
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

    std::int32_t add(float peak)
    {
        const auto part = std::int32_t(parents_.size());
        parents_.push_back(part);
        peaks_.push_back(peak);
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
        // Parts are made in the order of falling peaks: the later one has the lower peak.
        if (clearance >= share_ * peaks_[std::size_t(std::max(a, b))]) return join(a, b);
        auto& neck = necks_[std::minmax(a, b)];
        neck = std::max(neck, clearance);
        return a;
    }

    std::int32_t join(std::int32_t a, std::int32_t b)
    {
        const auto [first, last] = std::minmax(a, b);
        parents_[std::size_t(last)] = first;
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

private:
    float share_;
    std::vector<std::int32_t> parents_;
    std::vector<float> peaks_;
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
void number(Parts& parts, const std::vector<VoxelPlace>& order, Basins& basins)
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
}

/// The first of the widest voxels of each basin.
std::vector<openvdb::Vec3d> peakPlaces(const VoidField& space, const Basins& basins)
{
    std::vector<openvdb::Vec3d> out(basins.count());
    std::vector<char> isFound(basins.count(), 0);
    for (std::size_t n = 0; n < space.table.size(); ++n)
        space.table.active(n).forEach([&](int v) {
            const auto b = std::size_t(basins.of.leaf(n)[v]);
            if (isFound[b] || space.clearance.leaf(n)[v] < basins.peaks[b]) return;
            isFound[b] = 1;
            out[b] = space.table.origin(n).offsetBy(v >> 6, v >> 3 & 7, v & 7).asVec3d() *
                     space.voxelSize;
        });
    return out;
}

/// @param[in] order  fallingVoxels()
Basins splitInOrder(const VoidField& space, const std::vector<VoxelPlace>& order, double share,
                    double leastVoxels)
{
    Basins out;
    out.of = LeafArray<std::int32_t>(space.table.size());
    for (std::size_t n = 0; n < space.table.size(); ++n) std::fill_n(out.of.leaf(n), leafSize, -1);
    const auto at = [&](VoxelPlace place) -> std::int32_t& {
        return out.of.leaf(place / leafSize)[place % leafSize];
    };
    const auto clearanceAt = [&](VoxelPlace place) {
        return space.clearance.leaf(place / leafSize)[place % leafSize];
    };
    Parts parts(share);
    std::vector<std::size_t> sizes;
    for (const VoxelPlace place : order) {
        std::int32_t own = -1;
        float highest = 0.0f;
        forEachJoined(space.table, place, [&](VoxelPlace other) {
            if (at(other) < 0 || clearanceAt(other) <= highest) return;
            highest = clearanceAt(other);
            own = at(other);
        });
        if (own < 0) {
            own = parts.add(clearanceAt(place));
            sizes.push_back(0);
        }
        at(place) = own;
        ++sizes[std::size_t(own)];
        std::int32_t root = parts.find(own);
        forEachJoined(space.table, place, [&](VoxelPlace other) {
            if (at(other) < 0) return;
            const std::int32_t met = parts.find(at(other));
            if (met != root) root = parts.meet(root, met, clearanceAt(place));
        });
    }
    joinSmall(sizes, leastVoxels, parts);
    number(parts, order, out);
    return out;
}

/// The rooms of a graph below the cut and the basins of voxels that no such room is the top of, as
/// parts in the order of falling peaks, and where they meet.
struct RoomParts {
    /// Where two parts meet.
    struct Meeting {
        float clearance;       ///< [Å]
        std::int32_t parts[2]; ///< ascending
    };
    std::vector<float> peaks;      ///< of each part [Å]
    std::vector<std::int32_t> of;  ///< of each basin its part
    std::vector<Meeting> meetings; ///< the widest first

    /// @param[in] basins  their peaks are the starts of the graph
    RoomParts(const VoidField& space, const VoidGraph& graph, const Rooms& rooms,
              const Basins& basins, const BelowCut& below)
    {
        const auto isBelow = [&](const openvdb::Vec3d& x, double d) {
            return basinAbout(space, basins, x) >= 0 && below(x, d) > 0.0;
        };
        std::vector<std::pair<float, std::int32_t>> tops; // minus the peak; a room or -1 - a basin
        std::vector<std::int32_t> partOf(rooms.nodes.size(), -1);
        std::vector<char> isIn(rooms.nodes.size(), 0);
        for (std::size_t r = 1; r < rooms.nodes.size(); ++r) {
            const VoidGraph::Node& node = graph.nodes[std::size_t(rooms.nodes[r])];
            isIn[r] = isBelow(node.place, node.clearance);
            if (isIn[r]) tops.emplace_back(-float(node.clearance), std::int32_t(r));
        }
        // The room that the way up from a basin's peak leads to without leaving what is below the
        // cut, or 0.
        std::vector<std::int32_t> roomOf(basins.count(), 0);
        for (std::size_t b = 0; b < basins.count(); ++b) {
            std::int32_t n = graph.starts[b];
            if (n == VoidGraph::none || !isIn[std::size_t(rooms.of[std::size_t(n)])]) continue;
            bool stays = true;
            while (stays && rooms.up[std::size_t(n)] != VoidGraph::none) {
                const auto& ends = graph.edges[std::size_t(rooms.up[std::size_t(n)])].nodes;
                n = ends[ends[0] == n ? 1 : 0];
                const VoidGraph::Node& node = graph.nodes[std::size_t(n)];
                stays = isBelow(node.place, node.clearance);
            }
            if (stays) roomOf[b] = rooms.of[std::size_t(n)];
        }
        for (std::size_t b = 0; b < basins.count(); ++b)
            if (roomOf[b] == 0) tops.emplace_back(-basins.peaks[b], -1 - std::int32_t(b));
        std::sort(tops.begin(), tops.end());
        of.assign(basins.count(), -1);
        for (const auto& [peak, top] : tops) {
            auto& part = top < 0 ? of[std::size_t(-1 - top)] : partOf[std::size_t(top)];
            part = std::int32_t(peaks.size());
            peaks.push_back(-peak);
        }
        for (std::size_t b = 0; b < basins.count(); ++b)
            if (const std::int32_t room = roomOf[b]) of[b] = partOf[std::size_t(room)];
        for (const std::int32_t e : rooms.passages) {
            const VoidGraph::Edge& edge = graph.edges[std::size_t(e)];
            const std::int32_t a = partOf[std::size_t(rooms.of[std::size_t(edge.nodes[0])])],
                               b = partOf[std::size_t(rooms.of[std::size_t(edge.nodes[1])])];
            if (a >= 0 && b >= 0 && isBelow(edge.narrowest, edge.clearance))
                add(float(edge.clearance), a, b);
        }
        // What the graph does not join the probe does not pass, if it leads from room to room.
        for (const Neck& neck : basins.necks) {
            const std::int32_t a = of[std::size_t(neck.basins[0])],
                               b = of[std::size_t(neck.basins[1])];
            const bool joinsRooms = roomOf[std::size_t(neck.basins[0])] != 0 &&
                                    roomOf[std::size_t(neck.basins[1])] != 0;
            if (a != b)
                add(joinsRooms ? std::min(neck.clearance, float(graph.floor)) : neck.clearance, a,
                    b);
        }
        std::sort(meetings.begin(), meetings.end(), [](const Meeting& a, const Meeting& b) {
            if (a.clearance != b.clearance) return a.clearance > b.clearance;
            return std::pair(a.parts[0], a.parts[1]) < std::pair(b.parts[0], b.parts[1]);
        });
    }

private:
    void add(float clearance, std::int32_t a, std::int32_t b)
    {
        meetings.push_back({clearance, {std::min(a, b), std::max(a, b)}});
    }
};

} // namespace

Basins splitAtNecks(const VoidField& space, double share, double leastVoxels)
{
    return splitInOrder(space, fallingVoxels(space), share, leastVoxels);
}

std::int32_t basinAbout(const VoidField& space, const Basins& basins, const openvdb::Vec3d& x)
{
    const openvdb::Vec3d at = x / space.voxelSize;
    const openvdb::Coord low = openvdb::Coord::floor(at);
    double least = std::numeric_limits<double>::infinity();
    std::int32_t best = -1;
    for (int k = 0; k < 8; ++k) {
        const openvdb::Coord voxel = low.offsetBy(k >> 2, k >> 1 & 1, k & 1);
        const std::int32_t leaf = space.table.find(voxel);
        if (leaf < 0) continue;
        const std::int32_t basin = basins.of.leaf(
            std::size_t(leaf))[(voxel[0] & 7) << 6 | (voxel[1] & 7) << 3 | (voxel[2] & 7)];
        const double square = (voxel.asVec3d() - at).lengthSqr();
        if (basin < 0 || square >= least) continue;
        least = square;
        best = basin;
    }
    return best;
}

RoomBasins splitAtRooms(const std::vector<Ball>& balls, double probe, const VoidField& space,
                        const SplitRule& rule, const BelowCut& below, const Progress& progress)
{
    const std::vector<VoxelPlace> order = fallingVoxels(space);
    RoomBasins out{splitInOrder(space, order, 1.0, 0.0), {}}; // every maximum of the voxels
    out.graph = voidGraph(balls, probe, peakPlaces(space, out.basins), progress);
    const Rooms rooms = roomsOf(out.graph);
    const RoomParts found(space, out.graph, rooms, out.basins, below);
    Parts parts(rule.share);
    for (const float peak : found.peaks) parts.add(peak);
    for (const RoomParts::Meeting& meeting : found.meetings) {
        const std::int32_t a = parts.find(meeting.parts[0]), b = parts.find(meeting.parts[1]);
        if (a != b) parts.meet(a, b, meeting.clearance);
    }
    std::vector<std::size_t> sizes(parts.size(), 0);
    for (const VoxelPlace place : order) {
        std::int32_t& basin = out.basins.of.leaf(place / leafSize)[place % leafSize];
        basin = found.of[std::size_t(basin)];
        ++sizes[std::size_t(basin)];
    }
    joinSmall(sizes, rule.leastVoxels, parts);
    out.basins.peaks.clear();
    out.basins.necks.clear();
    number(parts, order, out.basins);
    for (auto place = order.rbegin(); place != order.rend();
         ++place) // the widest voxel is the last
        out.basins.peaks[std::size_t(out.basins.of.leaf(*place / leafSize)[*place % leafSize])] =
            space.clearance.leaf(*place / leafSize)[*place % leafSize];
    return out;
}

} // namespace molsurf
