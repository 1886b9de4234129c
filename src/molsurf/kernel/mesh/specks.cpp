// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/mesh/specks.h"

#include "molsurf/kernel/core/spherical_area.h"
#include "molsurf/kernel/grid/leaf_block.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <set>

namespace molsurf
{

using openvdb::Coord;
using openvdb::Vec3d;

namespace
{

/// Flood fill: the voxels of one sign that are connected to a voxel through faces.
/// @return empty if they do not stay in a box, as those beside the piece do
std::vector<Coord> enclosedVoxels(const openvdb::FloatGrid::ConstAccessor& surface,
                                  const Coord& start, bool inside, const openvdb::CoordBBox& box)
{
    std::set<Coord> seen = {start};
    std::vector<Coord> found = {start};
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (!box.isInside(found[i])) return {};
        for (int k = 0; k < 6; ++k) {
            Coord next = found[i];
            next[k / 2] += k % 2 ? 1 : -1;
            if ((surface.getValue(next) < 0.0f) == inside && seen.insert(next).second)
                found.push_back(next);
        }
    }
    return found;
}

/// A closed piece of a mesh.
struct Piece {
    std::vector<std::uint32_t> vertices;
    std::vector<std::size_t> triangles;
};

/// The normal of a triangle, as long as its area [Å^2].
Vec3d areaVector(const Mesh& mesh, std::size_t triangle)
{
    const auto& t = mesh.triangles[triangle];
    const Vec3d a(mesh.positions[t[0]]);
    return 0.5 * (Vec3d(mesh.positions[t[1]]) - a).cross(Vec3d(mesh.positions[t[2]]) - a);
}

/// The winding number of a piece about a point, without sign, by the solid angles of its triangles:
/// 1 within it, 0 outside.
double coverOf(const Mesh& mesh, const Piece& piece, const Vec3d& x)
{
    double sum = 0.0;
    for (const std::size_t t : piece.triangles) {
        Vec3d way[3];
        for (int k = 0; k < 3; ++k)
            way[k] = (Vec3d(mesh.positions[mesh.triangles[t][k]]) - x).unitSafe();
        sum += sphericalArea(way[0], way[1], way[2]);
    }
    return std::abs(sum) / (4.0 * M_PI);
}

/// Changes the signs of the voxels that a piece encloses: of the connected sets of one sign beside
/// its vertices those that it winds about, or the nearest. Sets of other pieces may be as near.
void fill(const Mesh& mesh, const Piece& piece, openvdb::FloatGrid& surface)
{
    const double voxel = surface.voxelSize()[0];
    const std::vector<std::uint32_t>& vertices = piece.vertices;
    openvdb::CoordBBox box;
    for (const std::uint32_t v : vertices)
        box.expand(Coord::floor(Vec3d(mesh.positions[v]) / voxel));
    box.min() -= Coord(1);
    box.max() += Coord(2);
    openvdb::FloatGrid::Accessor access = surface.getAccessor();
    std::set<Coord> seen;
    std::vector<Coord> nearest; // voxels, for a flat piece that lies beside those it encloses
    double least = std::numeric_limits<double>::max();
    bool within = false;
    Vec3d middle(0.0);
    for (const std::uint32_t v : vertices) middle += Vec3d(mesh.positions[v]);
    middle /= double(vertices.size());
    const auto change = [&](const std::vector<Coord>& voxels) {
        for (const Coord& ijk : voxels) access.setValueOnly(ijk, -access.getValue(ijk));
    };
    for (const std::uint32_t v : vertices) {
        const Vec3d x = Vec3d(mesh.positions[v]) / voxel;
        constexpr double beside = 1.5; // of vertices, which slide along the surface [voxel]
        const openvdb::CoordBBox about(Coord::ceil(x - Vec3d(beside)),
                                       Coord::floor(x + Vec3d(beside)));
        for (auto corner = about.begin(); corner; ++corner) {
            if (!seen.insert(*corner).second) continue;
            std::vector<Coord> voxels = enclosedVoxels(surface.getConstAccessor(), *corner,
                                                       access.getValue(*corner) < 0.0f, box);
            seen.insert(voxels.begin(), voxels.end());
            const bool own = std::any_of(voxels.begin(), voxels.end(), [&](const Coord& ijk) {
                return coverOf(mesh, piece, voxel * ijk.asVec3d()) > 0.5;
            });
            if (own) change(voxels);
            within = within || own;
            for (const Coord& ijk : voxels) {
                const double distance = (voxel * ijk.asVec3d() - middle).length();
                if (distance >= least) continue;
                least = distance;
                nearest = voxels;
            }
        }
    }
    if (!within) change(nearest);
}

/// Voxels of a leaf beside S = 0.
struct ShallowVoxels {
    std::vector<Coord> peaks; // below a depth, and no face neighbour of their sign is deeper
    std::size_t inside = 0;   // those with S < 0 within a voxel
};

/// The voxels of leaf n within `deep` of the interface, none of whose six neighbours is deeper.
ShallowVoxels shallowVoxels(const SparseField& S, std::size_t n, float deep)
{
    using Block = LeafBlock<float, 1>;
    const float voxel = float(S.voxelSize);
    ShallowVoxels out;
    const float* own = S.leaf(n);
    if (!within(own, voxel).any()) return out;
    Block block;
    block.gather(S, n);
    for (int v = 0; v < leafSize; ++v) {
        if (!(std::abs(own[v]) < voxel)) continue;
        out.inside += own[v] < 0.0f;
        if (!(std::abs(own[v]) < deep)) continue;
        const float* p = block.at(v >> 6, v >> 3 & 7, v & 7);
        bool deeper = false;
        for (const int step : {Block::strideX, Block::strideY, Block::strideZ})
            for (const int next : {-step, step})
                deeper = deeper ||
                         ((p[next] < 0.0f) == (p[0] < 0.0f) && std::abs(p[next]) > std::abs(p[0]));
        if (!deeper) out.peaks.push_back(S.table.origin(n).offsetBy(v >> 6, v >> 3 & 7, v & 7));
    }
    return out;
}

/// Whether the voxels of one sign that are connected with a voxel through faces have one that is
/// as deep. Of more than some thousand it is not asked.
bool leadsDeep(const SparseField& S, const Coord& start, float deep)
{
    constexpr std::size_t most = 4096; // voxels
    const auto at = [&](const Coord& ijk) {
        const std::int32_t n = S.table.find(ijk);
        return n == noLeaf
                   ? deep
                   : S.leaf(std::size_t(n))[openvdb::FloatTree::LeafNodeType::coordToOffset(ijk)];
    };
    const bool inside = at(start) < 0.0f;
    std::set<Coord> seen = {start};
    std::vector<Coord> found = {start};
    for (std::size_t i = 0; i < found.size() && found.size() < most; ++i) {
        for (int k = 0; k < 6; ++k) {
            Coord next = found[i];
            next[k / 2] += k % 2 ? 1 : -1;
            const float value = at(next);
            if ((value < 0.0f) != inside) continue;
            if (std::abs(value) >= deep) return true;
            if (seen.insert(next).second) found.push_back(next);
        }
    }
    return false;
}

/// The triangles of some pieces, in ascending order.
/// @param[in] chosen  whether a piece is one of them
std::vector<std::size_t> trianglesOf(const Mesh& mesh, const MeshPieces& pieces,
                                     const std::vector<char>& chosen)
{
    return parallelCollect<std::size_t>(mesh.triangles.size(), Progress(),
                                        [&](std::size_t t, std::vector<std::size_t>& some) {
                                            if (chosen[pieces.of[mesh.triangles[t][0]]])
                                                some.push_back(t);
                                        });
}

} // namespace

bool isClearOfSpecks(const SparseField& S, const Progress& progress)
{
    constexpr std::size_t plenty = 100; // a mesh of a few triangles has fewer voxels inside
    const float deep = 0.6f * float(S.voxelSize);
    std::atomic<std::size_t> inside{0};
    std::atomic<bool> clear{true};
    parallelFor(S.table.size(), progress, [&](std::size_t n) {
        if (!clear) return;
        const ShallowVoxels found = shallowVoxels(S, n, deep);
        inside += found.inside;
        for (const Coord& peak : found.peaks)
            if (clear && !leadsDeep(S, peak, deep)) clear = false;
    });
    return clear && inside >= plenty;
}

std::vector<char> removePieces(const MeshPieces& pieces, const std::vector<char>& gone, Mesh& mesh)
{
    const std::size_t vertices = mesh.positions.size();
    std::vector<char> stays(vertices);
    parallelFor(vertices, Progress(), [&](std::size_t v) { stays[v] = !gone[pieces.of[v]]; });
    std::vector<std::uint32_t> numbers(vertices, 0);
    for (std::size_t v = 1; v < vertices; ++v)
        numbers[v] = numbers[v - 1] + std::uint32_t(stays[v - 1]);
    const std::vector<std::size_t> left = trianglesOf(mesh, pieces, gone);
    for (MeshPart& part : mesh.parts)
        part.firstTriangle -= std::size_t(
            std::lower_bound(left.begin(), left.end(), part.firstTriangle) - left.begin());
    parallelKeep(mesh.triangles, Progress(),
                 [&](std::size_t t) { return stays[mesh.triangles[t][0]]; });
    parallelFor(mesh.triangles.size(), Progress(), [&](std::size_t t) {
        for (std::uint32_t& corner : mesh.triangles[t]) corner = numbers[corner];
    });
    keepVertices(stays, mesh.positions);
    keepVertices(stays, mesh.normals);
    keepVertices(stays, mesh.colors);
    for (auto& a : mesh.scalars) keepVertices(stays, a.values);
    for (auto& a : mesh.labels) keepVertices(stays, a.values);
    return stays;
}

std::optional<std::vector<char>> dropSpecks(MeshPieces& pieces, openvdb::FloatGrid& surface,
                                            Mesh& mesh)
{
    constexpr double rounding = 1e-3; // of the integral of the normal over a closed piece
    const double least = leastPiece * std::pow(surface.voxelSize()[0], 3);
    const std::size_t count = pieces.measures.size();
    std::vector<char> small(count, 0);
    for (std::size_t p = 0; p < count; ++p) small[p] = std::abs(pieces.measures[p].volume) < least;
    if (std::find(small.begin(), small.end(), 1) == small.end()) return std::nullopt;

    // A piece that is cut open has no volume.
    const std::vector<std::size_t> triangles = trianglesOf(mesh, pieces, small);
    std::vector<Vec3d> normals(count, Vec3d(0.0));
    for (const std::size_t t : triangles)
        normals[pieces.of[mesh.triangles[t][0]]] += areaVector(mesh, t);
    for (std::size_t p = 0; p < count; ++p)
        small[p] = small[p] && normals[p].length() <= rounding * pieces.measures[p].area;
    if (std::find(small.begin(), small.end(), 1) == small.end()) return std::nullopt;

    std::vector<Piece> specks(count);
    for (const std::size_t t : triangles) {
        Piece& speck = specks[pieces.of[mesh.triangles[t][0]]];
        speck.triangles.push_back(t);
        for (const std::uint32_t corner : mesh.triangles[t]) speck.vertices.push_back(corner);
    }
    for (Piece& speck : specks) {
        std::sort(speck.vertices.begin(), speck.vertices.end());
        speck.vertices.erase(std::unique(speck.vertices.begin(), speck.vertices.end()),
                             speck.vertices.end());
    }
    for (std::size_t p = 0; p < count; ++p)
        if (small[p]) fill(mesh, specks[p], surface);
    for (const Piece& speck : specks) {
        for (const std::size_t t : speck.triangles) {
            const double area = areaVector(mesh, t).length();
            pieces.triangles.area -= area;
            pieces.triangles.flat -= area == 0.0;
        }
    }

    std::vector<char> stays = removePieces(pieces, small, mesh);
    std::vector<std::uint32_t> places(count);
    std::vector<PieceMeasure> measures;
    for (std::size_t p = 0; p < count; ++p) {
        places[p] = std::uint32_t(measures.size());
        if (!small[p]) measures.push_back(pieces.measures[p]);
    }
    keepVertices(stays, pieces.of);
    parallelFor(pieces.of.size(), Progress(),
                [&](std::size_t v) { pieces.of[v] = places[pieces.of[v]]; });
    pieces.measures = std::move(measures);
    return stays;
}

} // namespace molsurf
