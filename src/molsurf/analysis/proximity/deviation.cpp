// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/proximity/deviation.h"

#include "molsurf/kernel/core/cancel.h"
#include "molsurf/kernel/core/parallel.h"

#include <openvdb/tree/LeafManager.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace molsurf
{

using openvdb::Vec3d;
using openvdb::Vec3f;

namespace
{

constexpr std::size_t chunk = 512; // vertices or triangles that share a query

template<typename F>
void inChunks(std::size_t n, const Progress& progress, const F& f)
{
    parallelFor((n + chunk - 1) / chunk, progress,
                [&](std::size_t c) { f(c * chunk, std::min(n, (c + 1) * chunk)); });
}

struct Corners {
    Vec3d a, b, c;

    Corners(const Mesh& mesh, std::size_t i)
        : a(mesh.positions[mesh.triangles[i][0]]), b(mesh.positions[mesh.triangles[i][1]]),
          c(mesh.positions[mesh.triangles[i][2]])
    {
    }
    double area() const { return 0.5 * (b - a).cross(c - a).length(); }
    double longest() const
    {
        return std::sqrt(std::max({(b - a).lengthSqr(), (c - b).lengthSqr(), (a - c).lengthSqr()}));
    }
    /// Parts along each side.
    int parts(double spacing) const
    {
        constexpr double most = 256.0;
        return int(std::clamp(std::ceil(longest() / spacing), 1.0, most));
    }
};

/// sampleSpacing, or as many times doubled as it takes to have a million parts at most.
double spacingOf(const Mesh& mesh, const Progress& progress)
{
    constexpr std::size_t mostParts = 1000000;
    const std::size_t triangles = mesh.triangles.size();
    for (double spacing = sampleSpacing;; spacing *= 2.0) {
        const auto parts =
            parallelSum<std::size_t>((triangles + chunk - 1) / chunk, progress, [&](std::size_t c) {
                std::size_t sum = 0;
                for (std::size_t i = c * chunk; i < std::min(triangles, (c + 1) * chunk); ++i) {
                    const auto n = std::size_t(Corners(mesh, i).parts(spacing));
                    if (n > 1) sum += n * n;
                }
                return sum;
            });
        if (parts <= mostParts) return spacing;
    }
}

/// Sums of weighted distances.
struct Sums {
    double weight = 0.0, distance = 0.0, square = 0.0, withSign = 0.0, inside = 0.0, max = -1.0;
    Vec3d maxAt{0.0};
    std::size_t samples = 0;

    void add(double w, const Distance& d)
    {
        weight += w;
        distance += w * d.value;
        square += w * d.value * d.value;
        withSign += w * (d.inside ? -d.value : d.value);
        if (d.inside) inside += w;
    }
    void look(const Vec3d& x, const Distance& d)
    {
        ++samples;
        if (!(d.value > max)) return;
        max = d.value;
        maxAt = x;
    }
    Sums& operator+=(const Sums& o)
    {
        weight += o.weight;
        distance += o.distance;
        square += o.square;
        withSign += o.withSign;
        inside += o.inside;
        samples += o.samples;
        if (o.max > max) {
            max = o.max;
            maxAt = o.maxAt;
        }
        return *this;
    }
};

/// The parts of a large triangle: their centroids count, their corners are looked at.
void addParts(const Corners& t, int n, const Progress& progress, DistanceTo::Query& query,
              Sums& sums)
{
    const double weight = t.area() / (double(n) * n);
    const auto point = [&](double i, double j) {
        return t.a + (i / n) * (t.b - t.a) + (j / n) * (t.c - t.a);
    };
    for (int i = 0; i <= n; ++i) {
        stopIfCancelled(progress); // a distance from triangles in a tangle takes long
        for (int j = 0; i + j <= n; ++j) {
            const Vec3d x = point(i, j);
            sums.look(x, query.at(x));
            for (int upper = 0; upper < 2 && i + j + upper < n; ++upper) {
                const Vec3d y = point(i + (1 + upper) / 3.0, j + (1 + upper) / 3.0);
                const Distance d = query.at(y);
                sums.add(weight, d);
                sums.look(y, d);
            }
        }
    }
}

} // namespace

Comparison::OneWay distancesFrom(const Surface& from, const DistanceTo& to,
                                 const Progress& progress)
{
    const Mesh& mesh = from.mesh;
    const std::size_t vertices = mesh.positions.size(), triangles = mesh.triangles.size();
    std::vector<Distance> distances(vertices);
    inChunks(vertices, progress, [&](std::size_t begin, std::size_t end) {
        DistanceTo::Query query(to);
        for (std::size_t v = begin; v < end; ++v) {
            if (v % 64 == 0) stopIfCancelled(progress);
            distances[v] = query.at(Vec3d(mesh.positions[v]));
        }
    });

    // Large triangles by their parts, the others by their corners.
    const double spacing =
        from.spline ? std::numeric_limits<double>::infinity() : spacingOf(mesh, progress);
    Sums sums = parallelSum<Sums>((triangles + chunk - 1) / chunk, progress, [&](std::size_t c) {
        DistanceTo::Query query(to);
        Sums part;
        for (std::size_t i = c * chunk; i < std::min(triangles, (c + 1) * chunk); ++i) {
            const Corners t(mesh, i);
            const int n = t.parts(spacing);
            if (n > 1) {
                addParts(t, n, progress, query, part);
            } else {
                for (const std::uint32_t v : mesh.triangles[i])
                    part.add(t.area() / 3.0, distances[v]);
            }
        }
        return part;
    });
    sums += parallelSum<Sums>((vertices + chunk - 1) / chunk, progress, [&](std::size_t c) {
        Sums part;
        for (std::size_t v = c * chunk; v < std::min(vertices, (c + 1) * chunk); ++v)
            part.look(Vec3d(mesh.positions[v]), distances[v]);
        return part;
    });

    Comparison::OneWay result;
    result.samples = sums.samples;
    result.max = sums.max;
    result.maxAt = sums.maxAt;
    const double weight = sums.weight > 0.0 ? sums.weight : 1.0; // no triangle has an area
    result.mean = sums.distance / weight;
    result.rms = std::sqrt(sums.square / weight);
    const bool withSign = to.surface().closed;
    if (withSign) {
        result.meanSigned = sums.withSign / weight;
        result.inside = sums.inside / weight;
    }
    result.distance.reserve(vertices);
    if (withSign) result.signedDistance.reserve(vertices);
    for (const Distance& d : distances) {
        result.distance.push_back(float(d.value));
        if (withSign) result.signedDistance.push_back(float(d.inside ? -d.value : d.value));
    }
    return result;
}

std::vector<openvdb::FloatGrid::Ptr> distanceGrids(const openvdb::FloatGrid& on,
                                                   const DistanceTo& to, const Progress& progress)
{
    std::vector<openvdb::FloatGrid::Ptr> grids;
    for (const char* name : {"distance", "signed_distance"}) {
        auto grid = openvdb::FloatGrid::create(0.0f);
        grid->setTree(
            std::make_shared<openvdb::FloatTree>(on.tree(), 0.0f, openvdb::TopologyCopy()));
        grid->setTransform(on.transform().copy());
        grid->setName(name);
        grids.push_back(std::move(grid));
    }
    openvdb::tree::LeafManager<openvdb::FloatTree> plain(grids[0]->tree()), signs(grids[1]->tree());
    parallelFor(plain.leafCount(), progress, [&](std::size_t n) {
        DistanceTo::Query query(to);
        for (auto it = plain.leaf(n).beginValueOn(); it; ++it) {
            const Distance d = query.at(on.indexToWorld(it.getCoord()));
            it.setValue(float(d.value));
            signs.leaf(n).setValueOnly(it.pos(), float(d.inside ? -d.value : d.value));
        }
    });
    if (!to.surface().closed) grids.pop_back();
    return grids;
}

Size sizeOfTriangles(const Mesh& mesh, bool closed, const Progress& progress)
{
    struct Sum {
        double area = 0.0, volume = 0.0;
        Sum& operator+=(const Sum& o)
        {
            area += o.area;
            volume += o.volume;
            return *this;
        }
    };
    Size size;
    if (mesh.triangles.empty()) return size;
    const std::size_t triangles = mesh.triangles.size();
    // Relative to a vertex, so that the volume does not cancel far from the origin.
    const Vec3d origin(mesh.positions[mesh.triangles[0][0]]);
    const Sum sum = parallelSum<Sum>((triangles + chunk - 1) / chunk, progress, [&](std::size_t c) {
        Sum part;
        for (std::size_t i = c * chunk; i < std::min(triangles, (c + 1) * chunk); ++i) {
            const Corners t(mesh, i);
            part += {t.area(), (t.a - origin).dot((t.b - origin).cross(t.c - origin)) / 6.0};
        }
        return part;
    });
    size.area = sum.area;
    if (closed) size.volume = sum.volume;
    return size;
}

std::vector<Vec3f> vertexNormals(const Mesh& mesh)
{
    std::vector<Vec3d> sums(mesh.positions.size(), Vec3d(0.0));
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Corners t(mesh, i);
        const Vec3d n = (t.b - t.a).cross(t.c - t.a);
        for (const std::uint32_t v : mesh.triangles[i]) sums[v] += n;
    }
    std::vector<Vec3f> normals(sums.size());
    for (std::size_t v = 0; v < sums.size(); ++v) {
        const double length = sums[v].length();
        normals[v] = length > 0.0 ? Vec3f(sums[v] / length) : Vec3f(0.0f, 0.0f, 1.0f);
    }
    return normals;
}

} // namespace molsurf
