// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/pockets/basins.h"

#include "molsurf/kernel/balls/ball_index.h"
#include "molsurf/kernel/balls/nearest_ball.h"
#include "molsurf/kernel/core/disjoint_sets.h"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <queue>
#include <tuple>
#include <utility>

namespace molsurf
{

namespace
{

/// Parts that join.
class Parts
{
public:
    /// @param[in] peaks  of each part its largest clearance [Å]
    Parts(double share, std::vector<float> peaks)
        : share_(float(share)), peaks_(std::move(peaks)), sets_(peaks_.size())
    {
    }

    std::int32_t find(std::int32_t part) { return std::int32_t(sets_.find(std::uint32_t(part))); }

    /// Two roots meet: they join, or a neck is between them.
    void meet(std::int32_t a, std::int32_t b, float clearance)
    {
        const float lower = std::min(peaks_[std::size_t(a)], peaks_[std::size_t(b)]);
        if (clearance >= share_ * lower) return join(a, b);
        note(a, b, clearance);
    }

    void note(std::int32_t a, std::int32_t b, float clearance)
    {
        auto& neck = necks_[std::minmax(a, b)];
        neck = std::max(neck, clearance);
    }

    bool hasNeck(std::int32_t a, std::int32_t b) const
    {
        return necks_.count(std::minmax(a, b)) > 0;
    }

    void join(std::int32_t a, std::int32_t b)
    {
        const float peak = std::max(peaks_[std::size_t(find(a))], peaks_[std::size_t(find(b))]);
        sets_.join(std::uint32_t(a), std::uint32_t(b));
        peaks_[std::size_t(find(a))] = peak;
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

    std::size_t size() const { return peaks_.size(); }
    bool splits() const { return share_ > 0.0f; }

private:
    float share_;
    std::vector<float> peaks_; // of roots the largest
    DisjointSets sets_;
    std::map<std::pair<std::int32_t, std::int32_t>, float> necks_;
};

/// The active voxel nearest to a place among the 8 about it, if there is one.
std::optional<VoxelPlace> voxelAbout(const VoidField& space, const openvdb::Vec3d& x)
{
    const openvdb::Vec3d at = x / space.voxelSize;
    const openvdb::Coord low = openvdb::Coord::floor(at);
    double least = std::numeric_limits<double>::infinity();
    std::optional<VoxelPlace> best;
    for (int k = 0; k < 8; ++k) {
        const openvdb::Coord voxel = low.offsetBy(k >> 2, k >> 1 & 1, k & 1);
        const std::optional<VoxelPlace> place = space.find(voxel);
        const double square = (voxel.asVec3d() - at).lengthSqr();
        if (!place || square >= least || !(space.room(*place) > 0.0f)) continue;
        least = square;
        best = place;
    }
    return best;
}

/// The nodes and exits of a graph below the cut, where the clearance is largest, as parts: first
/// all nodes, then the exits.
class CutParts
{
public:
    CutParts(const VoidGraph& graph, const CutGraph& cut) : graph_(graph), cut_(cut) {}

    std::int32_t ofExit(std::size_t exit) const { return std::int32_t(graph_.nodes.size() + exit); }

    /// The clearance of each, 0 above the cut [Å].
    std::vector<float> peaks() const
    {
        std::vector<float> out;
        for (std::size_t n = 0; n < graph_.nodes.size(); ++n)
            out.push_back(cut_.isBelow[n] ? float(graph_.nodes[n].clearance) : 0.0f);
        for (const CutGraph::Exit& exit : cut_.exits) out.push_back(float(exit.end.clearance));
        return out;
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

    /// Notes parts whose probes overlap below the cut though none passes from one to the other.
    /// Where they are nearest to each other they touch three atoms: there edges end at the floor.
    void noteTouching(const BelowCut& below, Parts& parts) const
    {
        constexpr double whole = 1e9; // [Å]
        std::vector<Ball> ends;       // Ball::atom is the part
        for (const VoidGraph::Edge& stub : graph_.stubs) {
            if (!cut_.isBelow[std::size_t(stub.nodes[0])]) continue;
            const std::vector<VoidPoint> points = graph_.pointsOf(stub, whole);
            if (!points.empty()) ends.push_back({points.back().place, 0.0, stub.nodes[0]});
        }
        for (std::size_t e = 0; e < cut_.exits.size(); ++e)
            if (cut_.exits[e].node == VoidGraph::none)
                ends.push_back({cut_.exits[e].narrowest, 0.0, ofExit(e)});
        const double reach = 2.0 * graph_.floor;
        const BallIndex index(ends, {0.0, 0.0, 2.0});
        for (const Ball& end : ends)
            index.forEachNear(end.center, end.center, reach, [&](const Ball& other, std::int32_t) {
                const std::int32_t a = parts.find(end.atom), b = parts.find(other.atom);
                if (a >= b || parts.hasNeck(a, b) || (other.center - end.center).length() >= reach)
                    return;
                const openvdb::Vec3d middle = 0.5 * (end.center + other.center);
                if (below(middle, graph_.floor).value > 0.0) parts.note(a, b, 0.0f);
            });
    }

    /// The balls about nodes and exits of edges; Ball::atom is the part.
    std::vector<Ball> rooms() const
    {
        std::vector<Ball> out;
        for (std::size_t n = 1; n < graph_.nodes.size(); ++n)
            if (cut_.isBelow[n] && graph_.nodes[n].balls[2] != VoidGraph::none)
                out.push_back({graph_.nodes[n].place, graph_.nodes[n].clearance, std::int32_t(n)});
        for (std::size_t e = 0; e < cut_.exits.size(); ++e) {
            const CutGraph::Exit& exit = cut_.exits[e];
            if (exit.balls[2] != VoidGraph::none)
                out.push_back({exit.end.place, exit.end.clearance, ofExit(e)});
        }
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

    /// The edges, exits and arcs at which parts meet, the widest first.
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

    const VoidGraph& graph_;
    const CutGraph& cut_;
};

/// What hangs together of the active voxels.
class Pieces
{
public:
    explicit Pieces(const VoidField& space) : space_(space), of_(space.table.size())
    {
        for (std::size_t n = 0; n < space.table.size(); ++n) std::fill_n(of_.leaf(n), leafSize, -1);
        for (std::size_t n = 0; n < space.table.size(); ++n)
            space.table.active(n).forEach([&](int v) {
                if (of_.leaf(n)[v] < 0) fill(VoxelPlace(n * leafSize + std::size_t(v)), count_++);
            });
    }

    const VoidField& space() const { return space_; }
    std::int32_t count() const { return count_; }
    std::int32_t of(VoxelPlace place) const { return of_.leaf(place / leafSize)[place % leafSize]; }

private:
    void fill(VoxelPlace first, std::int32_t piece)
    {
        std::vector<VoxelPlace> open = {first};
        of_.leaf(first / leafSize)[first % leafSize] = piece;
        while (!open.empty()) {
            const VoxelPlace from = open.back();
            open.pop_back();
            forEachJoined(space_.table, from, [&](VoxelPlace to) {
                std::int32_t& other = of_.leaf(to / leafSize)[to % leafSize];
                if (other >= 0 || !(space_.room(to) > 0.0f)) return;
                other = piece;
                open.push_back(to);
            });
        }
    }

    const VoidField& space_;
    LeafArray<std::int32_t> of_;
    std::int32_t count_ = 0;
};

/// The ball of some that a place lies deepest in.
std::int32_t deepestIn(const openvdb::Vec3d& x, const std::vector<Ball>& rooms,
                       const std::vector<std::int32_t>& some)
{
    std::int32_t best = some.front();
    double least = std::numeric_limits<double>::infinity();
    for (const std::int32_t k : some) {
        const Ball& room = rooms[std::size_t(k)];
        const double gap = (x - room.center).length() - room.radius;
        if (gap >= least) continue;
        least = gap;
        best = k;
    }
    return best;
}

/// Gives each active voxel the part of the room that it lies deepest in, of those in its piece. A
/// piece without rooms is a part.
/// @param[in] parts  the last ones are those of pieces
void assign(const Pieces& pieces, const std::vector<Ball>& rooms, double probe,
            const Progress& progress, Parts& parts, Basins& out)
{
    const VoidField& space = pieces.space();
    std::vector<std::vector<std::int32_t>> inPiece(std::size_t(pieces.count()));
    std::vector<std::int32_t> pieceOf(rooms.size(), -1);
    for (std::size_t k = 0; k < rooms.size(); ++k) {
        const auto place = voxelAbout(space, rooms[k].center);
        if (!place) continue;
        pieceOf[k] = pieces.of(*place);
        std::vector<std::int32_t>& own = inPiece[std::size_t(pieceOf[k])];
        if (!parts.splits() && !own.empty())
            parts.join(rooms[std::size_t(own[0])].atom, rooms[k].atom);
        own.push_back(std::int32_t(k));
    }
    const std::int32_t ofPieces = std::int32_t(parts.size()) - pieces.count();
    std::vector<openvdb::Vec3f> places;
    std::vector<VoxelPlace> voxels;
    for (std::size_t n = 0; n < space.table.size(); ++n)
        space.table.active(n).forEach([&](int v) {
            voxels.push_back(VoxelPlace(n * leafSize + std::size_t(v)));
            places.emplace_back(space.pointOf(voxels.back()));
        });
    const std::vector<std::int32_t> nearest = rooms.empty()
                                                  ? std::vector<std::int32_t>(voxels.size(), -1)
                                                  : nearestBalls(rooms, places, probe, progress);
    out.of = LeafArray<std::int32_t>(space.table.size());
    for (std::size_t n = 0; n < space.table.size(); ++n) std::fill_n(out.of.leaf(n), leafSize, -1);
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        const auto piece = std::size_t(pieces.of(voxels[i]));
        std::int32_t& part = out.of.leaf(voxels[i] / leafSize)[voxels[i] % leafSize];
        if (inPiece[piece].empty()) {
            part = ofPieces + std::int32_t(piece);
            continue;
        }
        std::int32_t k = nearest[i];
        if (k < 0 || pieceOf[std::size_t(k)] != std::int32_t(piece))
            k = deepestIn(openvdb::Vec3d(places[i]), rooms, inPiece[piece]);
        part = parts.find(rooms[std::size_t(k)].atom);
    }
}

/// Gives the parts that voxels are in numbers, in the order of the parts.
/// @param[in,out] basins  of voxels, whose clearance is above 0, the roots of their parts; then the
///                        numbers of these
/// @return of each part that of its root, or -1: no voxel is in it
std::vector<std::int32_t> numberParts(const VoidField& space, Parts& parts, Basins& basins)
{
    std::vector<float> peaks(parts.size(), 0.0f);
    const auto forEachVoxel = [&](const auto& f) {
        for (std::size_t n = 0; n < space.table.size(); ++n)
            space.table.active(n).forEach(
                [&](int v) { f(space.clearance.leaf(n)[v], basins.of.leaf(n)[v]); });
    };
    forEachVoxel([&](float clearance, std::int32_t part) {
        float& peak = peaks[std::size_t(part)];
        peak = std::max(peak, clearance);
    });
    std::vector<std::int32_t> numbers(parts.size(), -1);
    for (std::size_t p = 0; p < numbers.size(); ++p) {
        if (peaks[p] == 0.0f) continue;
        numbers[p] = std::int32_t(basins.peaks.size());
        basins.peaks.push_back(peaks[p]);
    }
    for (std::size_t p = 0; p < numbers.size(); ++p)
        numbers[p] = numbers[std::size_t(parts.find(std::int32_t(p)))];
    forEachVoxel([&](float, std::int32_t& part) { part = numbers[std::size_t(part)]; });
    return numbers;
}

/// Lists the necks between parts that have numbers.
void addNecks(const std::vector<std::int32_t>& numbers, Parts& parts, Basins& basins)
{
    for (const auto& [pair, clearance] : parts.necks()) {
        const auto [a, b] =
            std::minmax(numbers[std::size_t(pair.first)], numbers[std::size_t(pair.second)]);
        if (a >= 0) basins.necks.push_back({{a, b}, clearance});
    }
}

/// Finds where basins are widest, and which are cut.
void addWidest(const std::vector<Ball>& rooms, const std::vector<std::int32_t>& numbers,
               RoomBasins& out)
{
    const std::size_t nodes = out.graph.nodes.size();
    out.widest.resize(out.basins.count());
    out.isCut.assign(out.basins.count(), 0);
    for (const Ball& room : rooms) {
        const std::int32_t basin = numbers[std::size_t(room.atom)];
        if (basin < 0) continue;
        const bool isExit = std::size_t(room.atom) >= nodes;
        if (isExit) out.isCut[std::size_t(basin)] = 1;
        auto& widest = out.widest[std::size_t(basin)];
        if (widest && room.radius <= widest->ball.clearance) continue;
        const std::int32_t node =
            isExit ? out.cut.exits[std::size_t(room.atom) - nodes].above : room.atom;
        widest = WidestPlace{{room.center, room.radius}, node, isExit};
    }
}

} // namespace

RoomBasins splitAtRooms(const std::vector<Ball>& balls, double probe, const VoidField& space,
                        double share, const BelowCut& below, const Progress& progress)
{
    RoomBasins out{{}, voidGraph(balls, probe, {}, progress), {}, {}, {}, {}};
    out.cut = cutGraph(out.graph, space, below, progress);
    const CutParts known(out.graph, out.cut);
    const Pieces pieces(space);
    std::vector<float> peaks = known.peaks();
    peaks.resize(peaks.size() + std::size_t(pieces.count()), 0.0f); // of those without a room
    Parts parts(share, std::move(peaks));
    known.join(Clearance(balls), below, parts);
    known.noteTouching(below, parts);
    const std::vector<Ball> rooms = known.rooms();
    assign(pieces, rooms, probe, progress, parts, out.basins);
    out.ofNodes = numberParts(space, parts, out.basins);
    addNecks(out.ofNodes, parts, out.basins);
    addWidest(rooms, out.ofNodes, out);
    out.ofNodes.resize(out.graph.nodes.size());
    for (std::size_t n = 0; n < out.ofNodes.size(); ++n)
        if (!out.cut.isBelow[n]) out.ofNodes[n] = -1;
    return out;
}

} // namespace molsurf
