// SPDX-License-Identifier: MPL-2.0
#include "molsurf/bricks/merge_mesh.h"

#include "molsurf/error.h"
#include "molsurf/mesh/statistics.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <numeric>

namespace molsurf
{

namespace
{

struct KeyHash {
    std::size_t operator()(const VertexKey& key) const
    {
        std::uint64_t h = 0;
        for (const std::int32_t word : key)
            h = (h ^ std::uint32_t(word)) * 0x9e3779b97f4a7c15ull, h ^= h >> 29;
        return std::size_t(h);
    }
};

/// Calls f(first record, number) for runs of records of a section.
template<typename F>
void inRuns(const BrickFile& brick, const Section& section, std::size_t size, const F& f)
{
    constexpr std::size_t run = 1 << 16;
    std::vector<char> records(run * size);
    for (std::uint64_t begin = 0; begin < section.count; begin += run) {
        const std::size_t count = std::size_t(std::min<std::uint64_t>(run, section.count - begin));
        brick.read(section.offset + begin * size, records.data(), count * size);
        f(records.data(), count);
    }
}

/// The one layout of all bricks that have vertices.
PlyLayout commonLayout(const std::vector<BrickFile>& bricks)
{
    PlyLayout layout = bricks.front().header().layout;
    for (const BrickFile& brick : bricks)
        if (brick.header().vertices.count > 0) layout = brick.header().layout;
    for (const BrickFile& brick : bricks) {
        const PlyLayout& other = brick.header().layout;
        if (brick.header().vertices.count > 0 &&
            (other.scalars != layout.scalars || other.labels != layout.labels ||
             other.colors != layout.colors))
            throw Error(ErrorKind::Input, "merge: the bricks' vertices differ in what they hold");
    }
    return layout;
}

/// Statistics of the mean and the Gaussian curvature.
std::array<Statistics, 2> curvatureStatistics(const std::vector<BrickFile>& bricks)
{
    std::size_t vertices = 0;
    for (const BrickFile& brick : bricks) vertices += brick.header().vertices.count;
    std::array<std::vector<float>, 2> values;
    std::vector<float> areas;
    for (auto* v : {&values[0], &values[1], &areas}) v->reserve(vertices);
    for (const BrickFile& brick : bricks) {
        using Pair = std::array<float, 2>;
        inRuns(brick, brick.header().curvatures, sizeof(Pair),
               [&](const char* records, std::size_t count) {
                   for (std::size_t i = 0; i < count; ++i) {
                       Pair pair;
                       std::memcpy(&pair, records + i * sizeof pair, sizeof pair);
                       for (int k = 0; k < 2; ++k) values[k].push_back(pair[k]);
                   }
               });
        const std::vector<float> more = brick.read<float>(brick.header().areas);
        areas.insert(areas.end(), more.begin(), more.end());
    }
    std::array<Statistics, 2> out;
    tbb::parallel_invoke([&] { out[0] = statistics(values[0], areas); },
                         [&] { out[1] = statistics(values[1], areas); });
    return out;
}

[[noreturn]] void refuseMesh(const BrickFile& brick, const char* what)
{
    throw Error(ErrorKind::Input, brick.path() + " names " + what + " [hint: run the brick again]");
}

} // namespace

MergedMesh::MergedMesh(const std::vector<BrickFile>& bricks) : bricks_(bricks)
{
    firsts_.push_back(0);
    for (const BrickFile& brick : bricks) {
        firsts_.push_back(firsts_.back() + brick.header().vertices.count);
        triangles_ += brick.header().triangles.count;
        border_.push_back(brick.read<BorderVertex>(brick.header().border));
        for (const BorderVertex& v : border_.back())
            if (v.piece >= brick.header().pieces.count)
                refuseMesh(brick, "a piece that it does not have");
    }
    std::unordered_map<VertexKey, std::uint64_t, KeyHash> owned;
    for (std::size_t b = 0; b < bricks.size(); ++b) {
        for (const BorderVertex& v : border_[b])
            if (v.vertex < bricks[b].header().vertices.count)
                owned.emplace(v.key, firsts_[b] + v.vertex);
    }
    foreign_.resize(bricks.size());
    for (std::size_t b = 0; b < bricks.size(); ++b) {
        for (const BorderVertex& v : border_[b]) {
            if (v.vertex < bricks[b].header().vertices.count) continue;
            const auto found = owned.find(v.key);
            if (found == owned.end())
                throw Error(ErrorKind::Input, "merge: brick " + std::to_string(b + 1) +
                                                  " does not fit its neighbours");
            foreign_[b].emplace(v.vertex, found->second);
        }
    }
}

std::uint64_t MergedMesh::indexOf(std::size_t brick, std::uint32_t vertex) const
{
    if (vertex < bricks_[brick].header().vertices.count) return firsts_[brick] + vertex;
    const auto found = foreign_[brick].find(vertex);
    if (found == foreign_[brick].end())
        refuseMesh(bricks_[brick], "a vertex that it does not have");
    return found->second;
}

void MergedMesh::writePly(OutputFile& file, const Progress& progress) const
{
    if (vertices() > std::size_t(std::numeric_limits<std::int32_t>::max()))
        throw Error(ErrorKind::Output, "cannot write " + file.path() +
                                           ": .ply counts at most 2147483647 vertices [hint: a "
                                           "larger `voxel`]");
    const PlyLayout layout = commonLayout(bricks_);
    const std::string header = plyHeader(layout, vertices(), triangles());
    file.write(header.data(), header.size());
    for (const BrickFile& brick : bricks_) {
        inRuns(brick, brick.header().vertices, layout.vertexSize(),
               [&](const char* records, std::size_t count) {
                   if (progress.cancelled()) throw Cancelled();
                   file.write(records, count * layout.vertexSize());
               });
    }
    using Triangle = std::array<std::uint32_t, 3>;
    Buffer buffer(file);
    for (std::size_t b = 0; b < bricks_.size(); ++b) {
        inRuns(bricks_[b], bricks_[b].header().triangles, sizeof(Triangle),
               [&](const char* records, std::size_t count) {
                   if (progress.cancelled()) throw Cancelled();
                   for (std::size_t i = 0; i < count; ++i) {
                       Triangle t;
                       std::memcpy(&t, records + i * sizeof t, sizeof t);
                       for (std::uint32_t& v : t) v = std::uint32_t(indexOf(b, v));
                       encodeTriangle(t, buffer.take(13));
                   }
               });
    }
    buffer.flush();
    file.finish();
}

SurfaceReport MergedMesh::report() const
{
    SurfaceReport report;
    report.vertices = vertices();
    report.triangles = triangles();
    if (triangles() == 0) return report;
    report.closed = report.manifold = true;
    report.eulerCharacteristic = int(std::int64_t(vertices()) - std::int64_t(triangles() * 3 / 2) +
                                     std::int64_t(triangles()));

    // Pieces of all bricks, joined where they share a vertex.
    std::vector<std::size_t> parent;
    std::vector<PieceMeasure> sums;
    std::vector<std::size_t> firstPiece;
    std::size_t kinks = 0, units = 0;
    for (const BrickFile& brick : bricks_) {
        firstPiece.push_back(sums.size());
        for (const PieceMeasure& p : brick.read<PieceMeasure>(brick.header().pieces))
            sums.push_back(p);
        const Brick& s = brick.header().sums;
        report.closed = report.closed && s.mesh.closed;
        report.manifold = report.manifold && s.mesh.manifold;
        report.degenerateTriangles += s.mesh.flat;
        report.maxResidual = std::max(report.maxResidual, s.maxResidual);
        kinks += s.kinkVertices;
        units += s.unitVertices;
    }
    parent.resize(sums.size());
    std::iota(parent.begin(), parent.end(), std::size_t(0));
    const auto root = [&](std::size_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    std::unordered_map<std::uint64_t, std::size_t> pieceAt; // by vertex of the whole
    for (std::size_t b = 0; b < bricks_.size(); ++b) {
        for (const BorderVertex& v : border_[b]) {
            const std::size_t piece = firstPiece[b] + v.piece;
            const auto [other, fresh] = pieceAt.emplace(indexOf(b, v.vertex), piece);
            if (fresh) continue;
            const std::size_t r = root(piece), s = root(other->second);
            parent[std::max(r, s)] = std::min(r, s);
        }
    }
    std::vector<PieceMeasure> whole;
    std::vector<std::size_t> place(sums.size());
    for (std::size_t i = 0; i < sums.size(); ++i) { // roots come first
        if (root(i) == i) {
            place[i] = whole.size();
            whole.emplace_back();
        }
        whole[place[root(i)]] += sums[i];
    }
    countPieces(whole, report);

    // Along the borders the bricks' triangles have to pair up.
    struct Edge {
        std::uint64_t from, to;
        std::int64_t surplus;
    };
    std::vector<Edge> edges;
    for (std::size_t b = 0; b < bricks_.size(); ++b) {
        for (const OpenEdge& e : bricks_[b].read<OpenEdge>(bricks_[b].header().openEdges)) {
            const std::uint64_t from = indexOf(b, e.from), to = indexOf(b, e.to);
            edges.push_back(
                {std::min(from, to), std::max(from, to), from < to ? e.surplus : -e.surplus});
        }
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
        return a.from != b.from ? a.from < b.from : a.to < b.to;
    });
    for (std::size_t i = 0; i < edges.size();) {
        std::int64_t surplus = 0;
        std::size_t begin = i;
        for (; i < edges.size() && edges[i].from == edges[begin].from &&
               edges[i].to == edges[begin].to;
             ++i)
            surplus += edges[i].surplus;
        if (surplus != 0) report.closed = false;
    }
    report.manifold = report.manifold && report.closed;

    report.kinkShare = double(kinks) / double(vertices());
    report.gradientShare = double(units) / double(vertices() - kinks);
    const auto [mean, gaussian] = curvatureStatistics(bricks_);
    report.meanCurvature = mean;
    report.gaussianCurvature = gaussian;
    return report;
}

} // namespace molsurf
