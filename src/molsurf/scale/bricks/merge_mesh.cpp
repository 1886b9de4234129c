// SPDX-License-Identifier: MPL-2.0
#include "molsurf/scale/bricks/merge_mesh.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/cancel.h"
#include "molsurf/kernel/core/disjoint_sets.h"
#include "molsurf/kernel/mesh/statistics.h"
#include "molsurf/kernel/mesh/topology.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

namespace molsurf
{

namespace
{

using Triangle = std::array<std::uint32_t, 3>;

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
        for (const float area : brick.read<float>(brick.header().areas)) {
            const std::size_t v = areas.size();
            const bool finite = std::isfinite(area + values[0][v]) && std::isfinite(values[1][v]);
            areas.push_back(finite ? area : 0.0f); // without weight it does not count
        }
    }
    std::array<Statistics, 2> out;
    tbb::parallel_invoke([&] { out[0] = statistics(values[0], areas); },
                         [&] { out[1] = statistics(values[1], areas); });
    return out;
}

} // namespace

MergedMesh::MergedMesh(const std::vector<BrickFile>& bricks)
    : bricks_(bricks), foreign_(bricks.size())
{
    firsts_.push_back(0);
    std::vector<std::pair<VertexKey, std::uint64_t>> owned;
    for (const BrickFile& brick : bricks) {
        const BrickHeader& header = brick.header();
        border_.push_back(brick.read<BorderVertex>(header.border));
        for (const BorderVertex& v : border_.back()) {
            if (v.piece >= header.pieces.count) brick.refuse("names a piece that it does not have");
            if (v.vertex < header.vertices.count)
                owned.emplace_back(v.key, firsts_.back() + v.vertex);
        }
        firsts_.push_back(firsts_.back() + header.vertices.count);
        triangles_ += header.triangles.count;
    }
    // Each vertex that a brick has from others is found by its key among those that bricks own.
    std::sort(owned.begin(), owned.end());
    for (std::size_t b = 0; b < bricks.size(); ++b) {
        const std::uint64_t count = bricks[b].header().vertices.count;
        std::size_t size = 0;
        for (const BorderVertex& v : border_[b]) size += v.vertex >= count;
        constexpr std::uint64_t none = ~std::uint64_t(0);
        foreign_[b].assign(size, none);
        for (const BorderVertex& v : border_[b]) {
            if (v.vertex < count) continue;
            const auto found =
                std::lower_bound(owned.begin(), owned.end(), std::pair(v.key, std::uint64_t(0)));
            if (found == owned.end() || found->first != v.key)
                throw Error(ErrorKind::Input, "merge: brick " + std::to_string(b + 1) +
                                                  " does not fit its neighbours");
            if (v.vertex - count >= size || foreign_[b][v.vertex - count] != none)
                bricks[b].refuse("names a vertex that it does not have");
            foreign_[b][v.vertex - count] = found->second;
        }
    }
    for (std::size_t b = 0; b < bricks.size(); ++b)
        if (bricks[b].header().meshed()) checkTriangles(b);
}

void MergedMesh::checkTriangles(std::size_t b) const
{
    const BrickFile& brick = bricks_[b];
    const BrickHeader& header = brick.header();
    Mesh mesh;
    mesh.triangles = brick.read<Triangle>(header.triangles);
    mesh.positions.resize(header.vertices.count + foreign_[b].size()); // for their number only
    std::vector<char> used(mesh.positions.size()), border(mesh.positions.size());
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t v : t) {
            if (v >= used.size()) brick.refuse("names a vertex that it does not have");
            used[v] = 1;
        }
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
            brick.refuse("has a triangle of two vertices");
    }
    std::size_t count = 0;
    const std::vector<std::uint32_t> pieces = connectedPieces(mesh, count, Progress());
    if (count != header.pieces.count) brick.refuse("has another number of pieces than it says");
    for (const BorderVertex& v : border_[b]) {
        if (v.vertex >= used.size()) brick.refuse("names a vertex that it does not have");
        if (v.piece != pieces[v.vertex]) brick.refuse("has vertices of other pieces than it says");
        border[v.vertex] = 1;
    }
    std::vector<char> inner(border.size());
    for (std::size_t v = 0; v < inner.size(); ++v) {
        inner[v] = !border[v];
        const bool lent = border[v] && v < header.vertices.count; // to the triangles of others
        if (!used[v] && !lent) brick.refuse("has a vertex of no triangle");
    }
    const Topology found = checkTopology(mesh, inner, Progress());
    const bool manifold = found.closed && found.oriented && found.manifold;
    if (!manifold && (header.closed || header.manifold))
        brick.refuse("has a mesh with holes, and says that it is closed");
    const std::vector<OpenEdge> listed = brick.read<OpenEdge>(header.openEdges);
    const std::vector<OpenEdge> open = openEdges(mesh, border, Progress());
    const auto same = [](const OpenEdge& x, const OpenEdge& y) {
        return x.from == y.from && x.to == y.to && x.surplus == y.surplus;
    };
    if (!std::equal(listed.begin(), listed.end(), open.begin(), open.end(), same))
        brick.refuse("has other open edges than it says");
}

std::uint64_t MergedMesh::indexOf(std::size_t brick, std::uint32_t vertex) const
{
    const std::uint64_t count = bricks_[brick].header().vertices.count;
    if (vertex < count) return firsts_[brick] + vertex;
    if (vertex - count >= foreign_[brick].size())
        bricks_[brick].refuse("names a vertex that it does not have");
    return foreign_[brick][vertex - count];
}

void MergedMesh::writePly(OutputFile& file, const Progress& progress) const
{
    constexpr float farthest = 1e6f; // [Å], as readMesh() takes them
    const PlyLayout layout = commonLayout(bricks_);
    const std::string header = plyHeader(layout, vertices(), triangles());
    file.write(header);
    for (const BrickFile& brick : bricks_) {
        inRuns(brick, brick.header().vertices, layout.vertexSize(),
               [&](const char* records, std::size_t count) {
                   stopIfCancelled(progress);
                   for (std::size_t i = 0; i < count; ++i) {
                       std::array<float, 3> place;
                       std::memcpy(&place, records + i * layout.vertexSize(), sizeof place);
                       for (const float x : place)
                           if (!(std::abs(x) < farthest)) brick.refuse("has a vertex far away");
                   }
                   file.write(records, count * layout.vertexSize());
               });
    }
    Buffer buffer(file);
    for (std::size_t b = 0; b < bricks_.size(); ++b) {
        inRuns(bricks_[b], bricks_[b].header().triangles, sizeof(Triangle),
               [&](const char* records, std::size_t count) {
                   stopIfCancelled(progress);
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

void MergedMesh::pairBorders(SurfaceReport& report) const
{
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
        if (i - begin != 2) report.manifold = false; // a brick on each side
    }
}

SurfaceReport MergedMesh::report() const
{
    SurfaceReport report;
    report.vertices = vertices();
    report.triangles = triangles();
    if (triangles() == 0) return report;
    report.closed = report.manifold = true;
    report.eulerCharacteristic = report.meshEulerCharacteristic = int(
        std::int64_t(vertices()) - std::int64_t(triangles() * 3 / 2) + std::int64_t(triangles()));

    // Pieces of all bricks, joined where they share a vertex.
    std::vector<PieceMeasure> sums;
    std::vector<std::size_t> firstPiece;
    GradientCounts counts;
    for (const BrickFile& brick : bricks_) {
        firstPiece.push_back(sums.size());
        for (const PieceMeasure& p : brick.read<PieceMeasure>(brick.header().pieces)) {
            if (!std::isfinite(p.area + p.volume)) brick.refuse("has pieces without a size");
            sums.push_back(p);
        }
        const BrickHeader& h = brick.header();
        report.closed = report.closed && h.closed;
        report.manifold = report.manifold && h.manifold;
        report.degenerateTriangles += h.flat;
        report.maxResidual = std::max(report.maxResidual, h.sums.maxResidual);
        counts += {h.sums.kinkVertices, h.sums.unitVertices};
    }
    DisjointSets sets(sums.size());
    std::vector<std::pair<std::uint64_t, std::size_t>> pieceAt; // by vertex of the whole
    for (std::size_t b = 0; b < bricks_.size(); ++b)
        for (const BorderVertex& v : border_[b])
            pieceAt.emplace_back(indexOf(b, v.vertex), firstPiece[b] + v.piece);
    std::sort(pieceAt.begin(), pieceAt.end());
    for (std::size_t i = 1; i < pieceAt.size(); ++i)
        if (pieceAt[i].first == pieceAt[i - 1].first)
            sets.join(std::uint32_t(pieceAt[i].second), std::uint32_t(pieceAt[i - 1].second));
    std::size_t count = 0;
    const std::vector<std::uint32_t> numbers = sets.numbers(count);
    std::vector<PieceMeasure> whole(count);
    for (std::size_t i = 0; i < sums.size(); ++i) whole[numbers[i]] += sums[i];
    countPieces(whole, report);

    pairBorders(report);
    report.manifold = report.manifold && report.closed;
    const int euler = *report.eulerCharacteristic;
    if (report.manifold &&
        (triangles() % 2 != 0 || euler % 2 != 0 || euler > 2 * std::int64_t(whole.size())))
        throw Error(ErrorKind::Input, "merge: the bricks contradict each other: V - E + F is " +
                                          std::to_string(euler) + " for " +
                                          std::to_string(whole.size()) + " pieces");

    describeGradients(counts, vertices(), report);
    const auto [mean, gaussian] = curvatureStatistics(bricks_);
    report.meanCurvature = mean;
    report.gaussianCurvature = gaussian;
    return report;
}

} // namespace molsurf
