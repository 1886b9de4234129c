// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/mesh/mesh_shape.h"

#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/mesh/topology.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

/// Extremes of some triangles.
struct Extremes {
    double cosine = -1.0; // of the least angle
    double shortest = std::numeric_limits<double>::infinity(), longest = 0.0;
    std::size_t below20 = 0, below28 = 0; // triangles

    Extremes& operator+=(const Extremes& o)
    {
        cosine = std::max(cosine, o.cosine);
        shortest = std::min(shortest, o.shortest);
        longest = std::max(longest, o.longest);
        below20 += o.below20;
        below28 += o.below28;
        return *this;
    }
};

/// The least angle of a triangle, by its cosine, and its shortest and longest edge.
Extremes extremesOf(const Mesh& mesh, std::size_t triangle)
{
    static const double of20 = std::cos(20.0 * M_PI / 180.0), of28 = std::cos(28.0 * M_PI / 180.0);
    const auto& t = mesh.triangles[triangle];
    Extremes out;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3d x(mesh.positions[t[k]]);
        const Vec3d a = Vec3d(mesh.positions[t[(k + 1) % 3]]) - x;
        const Vec3d b = Vec3d(mesh.positions[t[(k + 2) % 3]]) - x;
        const double edge = a.length(), lengths = edge * b.length();
        out.cosine = std::max(out.cosine, lengths > 0.0 ? a.dot(b) / lengths : 1.0);
        out.shortest = std::min(out.shortest, edge);
        out.longest = std::max(out.longest, edge);
    }
    out.below20 = out.cosine > of20;
    out.below28 = out.cosine > of28;
    return out;
}

} // namespace

std::vector<int> eulerNumbers(const Mesh& mesh, const std::vector<std::uint32_t>& pieces,
                              std::size_t count)
{
    std::vector<std::int64_t> twice(count, 0); // V - E + F with E = 3/2 F
    for (const std::uint32_t piece : pieces) twice[piece] += 2;
    for (const auto& t : mesh.triangles) --twice[pieces[t[0]]];
    std::vector<int> out;
    for (const std::int64_t n : twice) out.push_back(int(n / 2));
    return out;
}

MeshShape shapeOf(const Mesh& mesh, const Progress& progress)
{
    constexpr std::size_t chunk = 4096;
    const std::size_t count = mesh.triangles.size();
    const Extremes all =
        parallelSum<Extremes>((count + chunk - 1) / chunk, progress, [&](std::size_t c) {
            Extremes sum;
            for (std::size_t i = c * chunk; i < std::min(count, (c + 1) * chunk); ++i)
                sum += extremesOf(mesh, i);
            return sum;
        });
    std::size_t pieces = 0;
    const std::vector<std::uint32_t> of = connectedPieces(mesh, pieces, progress);
    MeshShape shape;
    shape.leastAngle = std::acos(std::min(all.cosine, 1.0)) * 180.0 / M_PI;
    shape.below20 = all.below20;
    shape.below28 = all.below28;
    shape.shortestEdge = all.shortest;
    shape.longestEdge = all.longest;
    shape.eulerNumbers = eulerNumbers(mesh, of, pieces);
    return shape;
}

void add(const MeshShape& part, MeshShape& sum)
{
    sum.leastAngle = std::min(sum.leastAngle, part.leastAngle);
    sum.below20 += part.below20;
    sum.below28 += part.below28;
    sum.shortestEdge = std::min(sum.shortestEdge, part.shortestEdge);
    sum.longestEdge = std::max(sum.longestEdge, part.longestEdge);
    sum.keptPieces += part.keptPieces;
    sum.eulerNumbers.insert(sum.eulerNumbers.end(), part.eulerNumbers.begin(),
                            part.eulerNumbers.end());
}

} // namespace molsurf
