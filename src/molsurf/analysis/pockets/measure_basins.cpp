// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/pockets/measure_basins.h"

#include "molsurf/kernel/core/disjoint_sets.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/grid/leaf_block.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <queue>
#include <utility>

namespace molsurf
{

using openvdb::Vec3d;
using openvdb::Vec3f;

namespace
{

/// A point with both distances of VoidField, which are linear between corners of a tetrahedron.
struct CellPoint {
    Vec3d x;
    double clearance, below; ///< [Å]
};

/// A corner of a cell.
struct CellCorner : CellPoint {
    std::int32_t basin; ///< -1: it has no room
    std::int32_t voxel; ///< corner of the cell, 0 to 7
};

using Tetrahedron = std::array<CellPoint, 4>;
using Triangle = std::array<CellPoint, 3>;

/// Share of a cell in a basin.
struct Share {
    std::int32_t basin;
    double volume = 0.0, wall = 0.0;
    Vec3d moment{0.0}, wallMoment{0.0};
};

/// A mouth's piece, and the voxels of the basin beside it.
struct MouthPiece {
    std::int32_t basin;
    double area;
    std::vector<VoxelPlace> voxels;
};

/// Shares of a leaf.
struct LeafShare {
    std::vector<Share> shares; ///< cell by cell
    std::vector<MouthPiece> mouths;
};

/// Where one of the distances is 0 on an edge.
CellPoint edgeBetween(const CellPoint& in, const CellPoint& out, double CellPoint::*value)
{
    const double t = in.*value / (in.*value - out.*value);
    return {in.x + t * (out.x - in.x), in.clearance + t * (out.clearance - in.clearance),
            in.below + t * (out.below - in.below)};
}

/// Cuts a tetrahedron where one of its distances is 0.
/// @param[in] above  called with tetrahedra that make up the part where it is above 0
/// @param[in] cut    called with triangles that make up the face where it is 0
template<typename Above, typename Cut>
void clip(Tetrahedron p, double CellPoint::*value, const Above& above, const Cut& cut)
{
    const auto end = std::stable_partition(
        p.begin(), p.end(), [&](const CellPoint& point) { return point.*value > 0.0; });
    const auto edge = [&](std::size_t i, std::size_t j) { return edgeBetween(p[i], p[j], value); };
    // A prism with the edges a0 b0, a1 b1 and a2 b2.
    const auto prism = [&](const Triangle& a, const Triangle& b) {
        above(Tetrahedron{a[0], a[1], a[2], b[2]});
        above(Tetrahedron{a[0], a[1], b[2], b[1]});
        above(Tetrahedron{a[0], b[0], b[1], b[2]});
    };
    switch (end - p.begin()) {
    case 1: {
        const Triangle face{edge(0, 1), edge(0, 2), edge(0, 3)};
        above(Tetrahedron{p[0], face[0], face[1], face[2]});
        return cut(face);
    }
    case 2: {
        const CellPoint a = edge(0, 2), b = edge(0, 3), c = edge(1, 2), d = edge(1, 3);
        prism({p[0], a, b}, {p[1], c, d});
        cut(Triangle{a, b, d});
        return cut(Triangle{a, d, c});
    }
    case 3: {
        const Triangle face{edge(0, 3), edge(1, 3), edge(2, 3)};
        prism({p[0], p[1], p[2]}, face);
        return cut(face);
    }
    case 4:
        return above(p);
    default:
        return;
    }
}

double volumeOf(const Tetrahedron& p)
{
    return std::abs((p[1].x - p[0].x).cross(p[2].x - p[0].x).dot(p[3].x - p[0].x)) / 6.0;
}

double areaOf(const Triangle& p)
{
    return 0.5 * (p[1].x - p[0].x).cross(p[2].x - p[0].x).length();
}

/// The share of a triangle where a linear function is above 0.
double shareAbove(std::array<double, 3> values)
{
    std::sort(values.begin(), values.end());
    if (values[0] > 0.0) return 1.0;
    if (values[2] <= 0.0) return 0.0;
    if (values[1] > 0.0)
        return 1.0 - values[0] * values[0] / ((values[0] - values[1]) * (values[0] - values[2]));
    return values[2] * values[2] / ((values[2] - values[0]) * (values[2] - values[1]));
}

/// Measures the cells of a leaf.
class Cells
{
public:
    Cells(const VoidField& space, const Basins& basins) : space_(space), basins_(basins) {}

    LeafShare measure(std::size_t n) const
    {
        LeafShare out;
        LeafBlock<float, 1> clearance, below;
        LeafBlock<std::int32_t, 1> basin;
        clearance.gather(space_.table, space_.clearance, n);
        below.gather(space_.table, space_.below, n);
        basin.gather(space_.table, basins_.of, n);
        const openvdb::Coord origin = space_.table.origin(n);
        for (int v = 0; v < leafSize; ++v) {
            const int at[3] = {v >> 6, v >> 3 & 7, v & 7};
            std::array<CellCorner, 8> corners;
            int above = 0;
            for (int k = 0; k < 8; ++k) {
                const int x = at[0] + (k >> 2), y = at[1] + (k >> 1 & 1), z = at[2] + (k & 1);
                CellCorner& c = corners[std::size_t(k)];
                c.clearance = *clearance.at(x, y, z);
                c.below = *below.at(x, y, z);
                const bool hasRoom = c.clearance > 0.0 && c.below > 0.0;
                c.basin = hasRoom ? *basin.at(x, y, z) : -1;
                c.x = origin.offsetBy(x, y, z).asVec3d() * space_.voxelSize;
                c.voxel = k;
                above += hasRoom;
            }
            if (above > 0) measureCell(n, v, corners, out);
        }
        return out;
    }

private:
    /// Adds the shares of the cell at voxel v of leaf n, by the six tetrahedra of Kuhn's
    /// triangulation: corners 0 and 7 and two between them. What a tetrahedron has belongs to those
    /// of its corners that have room, else to the first of the cell's.
    void measureCell(std::size_t n, int v, const std::array<CellCorner, 8>& corners,
                     LeafShare& out) const
    {
        constexpr int ways[6][2] = {{1, 3}, {1, 5}, {2, 3}, {2, 6}, {4, 5}, {4, 6}};
        const std::size_t first = out.shares.size();
        const auto hasRoom = [](const CellCorner& c) { return c.basin >= 0; };
        const CellCorner& any = *std::find_if(corners.begin(), corners.end(), hasRoom);
        for (const auto& way : ways) {
            const std::array<const CellCorner*, 4> c = {&corners[0], &corners[std::size_t(way[0])],
                                                        &corners[std::size_t(way[1])], &corners[7]};
            std::vector<const CellCorner*> own;
            for (const CellCorner* corner : c)
                if (hasRoom(*corner)) own.push_back(corner);
            if (own.empty()) own.push_back(&any);
            const Measure measure = measureOf({*c[0], *c[1], *c[2], *c[3]});
            if (measure.volume > 0.0) addTo(out.shares, first, own, measure);
            if (measure.mouth > 0.0) addMouth(n, v, own, measure.mouth, out);
        }
    }

    /// What of a tetrahedron is room.
    struct Measure {
        double volume = 0.0, wall = 0.0, mouth = 0.0;
        Vec3d moment{0.0}, wallMoment{0.0};
    };

    /// The part of a tetrahedron that the probe reaches below the cut: its volume and moment, its
    /// mouth, where the cut ends it, and its wall, where the reach ends.
    static Measure measureOf(const Tetrahedron& p)
    {
        Measure out;
        clip(
            p, &CellPoint::clearance,
            [&](const Tetrahedron& reached) {
                clip(
                    reached, &CellPoint::below,
                    [&](const Tetrahedron& room) {
                        const double volume = volumeOf(room);
                        out.volume += volume;
                        out.moment +=
                            0.25 * volume * (room[0].x + room[1].x + room[2].x + room[3].x);
                    },
                    [&](const Triangle& mouth) { out.mouth += areaOf(mouth); });
            },
            [&](const Triangle& wall) {
                const double area =
                    areaOf(wall) * shareAbove({wall[0].below, wall[1].below, wall[2].below});
                out.wall += area;
                out.wallMoment += area / 3.0 * (wall[0].x + wall[1].x + wall[2].x);
            });
        return out;
    }

    /// Gives each of some corners the same part, as shares of a cell.
    /// @param[in] first  the first share of the cell
    static void addTo(std::vector<Share>& shares, std::size_t first,
                      const std::vector<const CellCorner*>& corners, const Measure& measure)
    {
        const double part = 1.0 / double(corners.size());
        for (const CellCorner* corner : corners) {
            auto share = std::find_if(shares.begin() + std::ptrdiff_t(first), shares.end(),
                                      [&](const Share& s) { return s.basin == corner->basin; });
            if (share == shares.end()) share = shares.insert(shares.end(), Share{corner->basin});
            share->volume += part * measure.volume;
            share->moment += part * measure.moment;
            share->wall += part * measure.wall;
            share->wallMoment += part * measure.wallMoment;
        }
    }

    /// Shares a face of the mouth among the basins of its corners, by the number of corners.
    /// @param[in] n, v  leaf and voxel of the cell
    void addMouth(std::size_t n, int v, const std::vector<const CellCorner*>& corners, double area,
                  LeafShare& out) const
    {
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const std::int32_t basin = corners[i]->basin;
            const auto same = [&](const CellCorner* other) { return other->basin == basin; };
            if (std::any_of(corners.begin(), corners.begin() + std::ptrdiff_t(i), same)) continue;
            MouthPiece piece{basin, 0.0, {}};
            for (const CellCorner* corner : corners) {
                if (corner->basin != basin) continue;
                piece.area += area / double(corners.size());
                piece.voxels.push_back(placeOf(n, v, corner->voxel));
            }
            out.mouths.push_back(std::move(piece));
        }
    }

    /// The place of a corner of the cell at voxel v of leaf n.
    VoxelPlace placeOf(std::size_t n, int v, int corner) const
    {
        const int x = (v >> 6) + (corner >> 2), y = (v >> 3 & 7) + (corner >> 1 & 1),
                  z = (v & 7) + (corner & 1);
        const std::size_t leaf =
            std::size_t(centreNeighbour + 9 * (x >> 3) + 3 * (y >> 3) + (z >> 3));
        return VoxelPlace(std::size_t(space_.table.neighbours(n)[leaf]) * leafSize +
                          std::size_t(64 * (x & 7) + 8 * (y & 7) + (z & 7)));
    }

    const VoidField& space_;
    const Basins& basins_;
};

/// Puts the pieces of mouths together: those of a basin that have a voxel in common are one.
class Mouths
{
public:
    /// Joins the pieces of mouths that have a voxel in common.
    explicit Mouths(const std::vector<LeafShare>& leaves)
    {
        for (const LeafShare& leaf : leaves)
            for (const MouthPiece& piece : leaf.mouths)
                for (const VoxelPlace place : piece.voxels) numbers_.emplace(place, 0);
        std::uint32_t next = 0;
        for (auto& [place, number] : numbers_) number = next++;
        DisjointSets sets(numbers_.size());
        for (const LeafShare& leaf : leaves)
            for (const MouthPiece& piece : leaf.mouths)
                for (const VoxelPlace place : piece.voxels)
                    sets.join(numbers_.at(piece.voxels[0]), numbers_.at(place));
        std::size_t count = 0;
        const std::vector<std::uint32_t> mouthOf = sets.numbers(count);
        for (auto& [place, number] : numbers_) number = mouthOf[number];
        areas_.assign(count, 0.0);
        basins_.assign(count, -1);
        for (const LeafShare& leaf : leaves) {
            for (const MouthPiece& piece : leaf.mouths) {
                const std::uint32_t mouth = numbers_.at(piece.voxels[0]);
                areas_[mouth] += piece.area;
                basins_[mouth] = piece.basin;
            }
        }
    }

    std::size_t count() const { return areas_.size(); }
    double area(std::size_t mouth) const { return areas_[mouth]; }
    std::int32_t basin(std::size_t mouth) const { return basins_[mouth]; }
    /// The voxels beside mouths, and the mouth of each.
    const std::map<VoxelPlace, std::uint32_t>& voxels() const { return numbers_; }

private:
    std::map<VoxelPlace, std::uint32_t> numbers_;
    std::vector<double> areas_;
    std::vector<std::int32_t> basins_;
};

/// Widest paths (Dijkstra's search with the narrowest clearance in the place of the length) from
/// the widest voxels of basins to their mouths: where each is narrowest.
class Passages
{
public:
    /// Widest ways by Dijkstra's algorithm, from the deepest voxel of each basin to its mouths.
    Passages(const VoidField& space, const Basins& basins, const Mouths& mouths)
        : space_(space), narrowest_(space.table.size() * leafSize, none),
          ofMouth_(mouths.count(), none)
    {
        std::vector<std::int32_t> mouthOf(narrowest_.size(), -1);
        for (const auto& [place, mouth] : mouths.voxels()) mouthOf[place] = std::int32_t(mouth);
        begin(basins, mouths);
        // Wide ways come first, so that the first voxel of a mouth has the widest.
        for (std::size_t left = mouths.count(); left > 0 && !open_.empty();) {
            const VoxelPlace from = open_.top().second;
            open_.pop();
            const std::int32_t mouth = mouthOf[from];
            if (mouth >= 0 && ofMouth_[std::size_t(mouth)] == none) {
                ofMouth_[std::size_t(mouth)] = narrowest_[from];
                --left;
            }
            const std::int32_t b = basins.of.leaf(from / leafSize)[from % leafSize];
            forEachJoined(space.table, from, [&](VoxelPlace to) {
                if (basins.of.leaf(to / leafSize)[to % leafSize] != b || narrowest_[to] != none)
                    return;
                const VoxelPlace before = narrowest_[from];
                reach(to, clearance(to) < clearance(before) ? to : before);
            });
        }
    }

    /// Where the way to a mouth is narrowest; `none` if there is none.
    VoxelPlace narrowest(std::size_t mouth) const { return ofMouth_[mouth]; }
    float clearance(VoxelPlace place) const
    {
        return space_.clearance.leaf(place / leafSize)[place % leafSize];
    }

    static constexpr VoxelPlace none = ~VoxelPlace(0);

private:
    /// Begins at the first of the widest voxels of each basin that has a mouth.
    void begin(const Basins& basins, const Mouths& mouths)
    {
        std::vector<char> begins(basins.count(), 0);
        for (std::size_t m = 0; m < mouths.count(); ++m) begins[std::size_t(mouths.basin(m))] = 1;
        for (std::size_t n = 0; n < space_.table.size(); ++n) {
            space_.table.active(n).forEach([&](int v) {
                const auto b = std::size_t(basins.of.leaf(n)[v]);
                const auto place = VoxelPlace(n * leafSize + std::size_t(v));
                if (!begins[b] || clearance(place) < basins.peaks[b]) return;
                begins[b] = 0;
                reach(place, place);
            });
        }
    }

    void reach(VoxelPlace place, VoxelPlace narrowest)
    {
        narrowest_[place] = narrowest;
        open_.emplace(clearance(narrowest), place);
    }

    const VoidField& space_;
    std::vector<VoxelPlace> narrowest_, ofMouth_;
    std::priority_queue<std::pair<float, VoxelPlace>> open_;
};

/// Finds the deepest and the widest voxel of each basin.
void findPlaces(const VoidField& space, const Basins& basins, std::vector<BasinMeasure>& out)
{
    std::vector<float> depths(basins.count(), -1.0f), rooms(depths);
    for (std::size_t n = 0; n < space.table.size(); ++n) {
        space.table.active(n).forEach([&](int v) {
            const auto b = std::size_t(basins.of.leaf(n)[v]);
            const float below = space.below.leaf(n)[v], clearance = space.clearance.leaf(n)[v];
            const openvdb::Vec3d x = space.pointOf(VoxelPlace(n * leafSize + std::size_t(v)));
            if (below > depths[b]) {
                depths[b] = below;
                out[b].deepest = x;
            }
            if (clearance > rooms[b]) {
                rooms[b] = clearance;
                out[b].widest = x;
            }
        });
    }
}

} // namespace

std::vector<BasinMeasure> measureBasins(const VoidField& space, const Basins& basins,
                                        const Progress& progress)
{
    const Cells cells(space, basins);
    std::vector<LeafShare> leaves(space.table.size());
    parallelFor(leaves.size(), progress, [&](std::size_t n) { leaves[n] = cells.measure(n); });
    std::vector<BasinMeasure> out(basins.count());
    for (const LeafShare& leaf : leaves) {
        for (const Share& share : leaf.shares) {
            BasinMeasure& basin = out[std::size_t(share.basin)];
            basin.volume += share.volume;
            basin.moment += share.moment;
            basin.area += share.wall;
            if (share.wall > 0.0)
                basin.walls.push_back({Vec3f(share.wallMoment / share.wall), share.wall});
        }
    }
    findPlaces(space, basins, out);
    const Mouths mouths(leaves);
    const Passages passages(space, basins, mouths);
    std::vector<VoxelPlace> widest(mouths.count(), Passages::none);
    for (const auto& [place, mouth] : mouths.voxels())
        if (widest[mouth] == Passages::none ||
            passages.clearance(place) > passages.clearance(widest[mouth]))
            widest[mouth] = place;
    std::vector<std::vector<VoxelPlace>> voxels(mouths.count());
    for (const auto& [place, mouth] : mouths.voxels()) voxels[mouth].push_back(place);
    for (std::size_t m = 0; m < mouths.count(); ++m) {
        const VoxelPlace narrowest = passages.narrowest(m);
        BasinMeasure::Mouth mouth{mouths.area(m), passages.clearance(widest[m])};
        mouth.voxels = std::move(voxels[m]);
        mouth.widestPlace = space.pointOf(widest[m]);
        if (narrowest != Passages::none) {
            mouth.radius = passages.clearance(narrowest);
            mouth.narrowest = space.pointOf(narrowest);
        }
        out[std::size_t(mouths.basin(m))].mouths.push_back(mouth);
    }
    return out;
}

} // namespace molsurf
