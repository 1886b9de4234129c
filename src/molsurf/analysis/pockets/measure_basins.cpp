// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/pockets/measure_basins.h"

#include "molsurf/kernel/core/disjoint_sets.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/grid/leaf_block.h"

#include <algorithm>
#include <array>
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

/// A corner of a tetrahedron.
struct CellCorner {
    Vec3d x;
    double room, clearance, below; ///< of VoidField [Å]
    std::int32_t basin;
    std::int32_t voxel; ///< corner of the cell, 0 to 7
};

/// A point between two corners at which the room ends.
struct CellEdge {
    Vec3d x;
    double excess; ///< clearance less `below`: above 0 at mouths
    double clearance;
};

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

/// The share of a tetrahedron where a linear function is above 0, by its values at the corners, of
/// which the first `above` are.
double shareAbove(const std::array<const CellCorner*, 4>& c, int above)
{
    const auto cut = [&](int i, int j) { return c[i]->room / (c[i]->room - c[j]->room); };
    if (above == 4) return 1.0;
    if (above == 1) return cut(0, 1) * cut(0, 2) * cut(0, 3);
    if (above == 3) return 1.0 - (1.0 - cut(0, 3)) * (1.0 - cut(1, 3)) * (1.0 - cut(2, 3));
    const double s = cut(0, 2), t = cut(0, 3), u = cut(1, 2), w = cut(1, 3);
    return s * t + s * (1.0 - t) * w + (1.0 - s) * u * w;
}

CellEdge edgeBetween(const CellCorner& in, const CellCorner& out)
{
    const double t = in.room / (in.room - out.room);
    const double clearance = in.clearance + t * (out.clearance - in.clearance);
    const double below = in.below + t * (out.below - in.below);
    return {in.x + t * (out.x - in.x), clearance - below, clearance};
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
                c.room = std::min(c.clearance, c.below);
                c.basin = *basin.at(x, y, z);
                c.x = origin.offsetBy(x, y, z).asVec3d() * space_.voxelSize;
                c.voxel = k;
                above += c.room > 0.0;
            }
            if (above > 0) measureCell(n, v, corners, out);
        }
        return out;
    }

private:
    /// Adds the shares of the cell at voxel v of leaf n, by the six tetrahedra of Kuhn's
    /// triangulation: corners 0 and 7 and two between them.
    void measureCell(std::size_t n, int v, const std::array<CellCorner, 8>& corners,
                     LeafShare& out) const
    {
        constexpr int ways[6][2] = {{1, 3}, {1, 5}, {2, 3}, {2, 6}, {4, 5}, {4, 6}};
        std::vector<Share>& shares = out.shares;
        const std::size_t first = shares.size();
        const auto shareOf = [&](std::int32_t basin) -> Share& {
            for (std::size_t i = first; i < shares.size(); ++i)
                if (shares[i].basin == basin) return shares[i];
            return shares.emplace_back(Share{basin});
        };
        for (const auto& way : ways) {
            std::array<const CellCorner*, 4> c = {&corners[0], &corners[std::size_t(way[0])],
                                                  &corners[std::size_t(way[1])], &corners[7]};
            const auto end = std::stable_partition(
                c.begin(), c.end(), [](const CellCorner* corner) { return corner->room > 0.0; });
            const int above = int(end - c.begin());
            if (above == 0) continue;
            const double h = space_.voxelSize;
            const double volume = shareAbove(c, above) * h * h * h / 6.0 / above;
            for (int i = 0; i < above; ++i) {
                Share& share = shareOf(c[i]->basin);
                share.volume += volume;
                share.moment += volume * c[i]->x;
            }
            if (above < 4) measureFace(n, v, c, above, shareOf, out);
        }
    }

    /// Measures where the room ends in a tetrahedron: a triangle, or a quad of two, whose corners
    /// follow each other about it.
    template<typename ShareOf>
    void measureFace(std::size_t n, int v, const std::array<const CellCorner*, 4>& c, int above,
                     const ShareOf& shareOf, LeafShare& out) const
    {
        std::array<CellEdge, 4> edges;
        int count = 0;
        const auto add = [&](int i, int j) {
            edges[std::size_t(count++)] = edgeBetween(*c[i], *c[j]);
        };
        if (above == 2) {
            for (const auto& pair : {std::pair(0, 2), {0, 3}, {1, 3}, {1, 2}})
                add(pair.first, pair.second);
        } else {
            for (int i = 0; i < above; ++i)
                for (int j = above; j < 4; ++j) add(i, j);
        }
        double mouth = 0.0, wall = 0.0;
        Vec3d moment(0.0);
        for (int t = 0; t + 2 < count; ++t) {
            const CellEdge &p = edges[0], &q = edges[std::size_t(t + 1)],
                           &r = edges[std::size_t(t + 2)];
            const double area = 0.5 * (q.x - p.x).cross(r.x - p.x).length();
            const double open = shareAbove({p.excess, q.excess, r.excess}) * area;
            mouth += open;
            wall += area - open;
            moment += (area - open) / 3.0 * (p.x + q.x + r.x);
        }
        for (int i = 0; i < above; ++i) {
            Share& share = shareOf(c[i]->basin);
            share.wall += wall / above;
            share.wallMoment += moment / above;
        }
        if (mouth > 0.0) addMouth(n, v, c, above, mouth, out);
    }

    void addMouth(std::size_t n, int v, const std::array<const CellCorner*, 4>& c, int above,
                  double area, LeafShare& out) const
    {
        for (int i = 0; i < above; ++i) {
            const std::int32_t basin = c[i]->basin;
            const auto same = [&](const CellCorner* other) { return other->basin == basin; };
            if (std::any_of(c.begin(), c.begin() + i, same)) continue;
            MouthPiece piece{basin, 0.0, {}};
            for (int j = i; j < above; ++j) {
                if (c[j]->basin != basin) continue;
                piece.area += area / above;
                piece.voxels.push_back(placeOf(n, v, c[j]->voxel));
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

openvdb::Vec3d pointOf(const VoidField& space, VoxelPlace place)
{
    const int v = int(place % leafSize);
    return space.table.origin(place / leafSize).offsetBy(v >> 6, v >> 3 & 7, v & 7).asVec3d() *
           space.voxelSize;
}

/// Widest paths (Dijkstra's search with the narrowest clearance in the place of the length) from
/// the widest voxels of basins to their mouths: where each is narrowest.
class Passages
{
public:
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
            const openvdb::Vec3d x = pointOf(space, VoxelPlace(n * leafSize + std::size_t(v)));
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
        mouth.widestPlace = pointOf(space, widest[m]);
        if (narrowest != Passages::none) {
            mouth.radius = passages.clearance(narrowest);
            mouth.narrowest = pointOf(space, narrowest);
        }
        out[std::size_t(mouths.basin(m))].mouths.push_back(mouth);
    }
    return out;
}

} // namespace molsurf
