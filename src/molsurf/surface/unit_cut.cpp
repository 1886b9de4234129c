// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/unit_cut.h"

#include "molsurf/core/parallel.h"
#include "molsurf/spline/curvature.h"

#include <openvdb/math/Mat3.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace molsurf
{

using openvdb::Mat3d;
using openvdb::Vec3d;
using openvdb::Vec3f;

namespace
{

constexpr double slack = 16.0;     // of powers that are compared [Å^2]
constexpr double converged = 1e-4; // of a border vertex, from the surface and the border [voxel]
constexpr double reach = 1.5;      // how far it may move from where an edge crosses [voxel]
constexpr int steps = 12;

/// How much more power an owner has than another, with the gradient of that.
struct Excess {
    double value; ///< [Å^2]
    Vec3d slope;  ///< [Å]
};

/// Finds points of the border. One a thread.
class BorderFinder
{
public:
    BorderFinder(const PowerOwners& owners, const Spline& spline)
        : owners_(owners), sampler_(spline), h_(spline.voxelSize())
    {
    }

    /// Whether owner 0 has a point.
    bool owns(const Vec3d& x)
    {
        owners_.at(x, 0.0, near_);
        return !near_.empty() && near_[0].owner == 0;
    }

    /// The excess of owner 0 over the strongest other one, and that one.
    Excess excess(const Vec3d& x, std::int32_t& other)
    {
        owners_.at(x, slack, near_);
        const OwnersPower *own = nullptr, *rest = nullptr;
        for (const OwnersPower& near : near_) {
            if (near.owner == 0 && !own) own = &near;
            if (near.owner != 0 && !rest) rest = &near;
        }
        other = rest ? rest->owner : -1;
        if (own && rest) return {own->power - rest->power, 2.0 * (rest->centre - own->centre)};
        return {own ? -slack : slack, Vec3d(0.0)};
    }

    /// The excess of owner 0 over a certain one.
    Excess excessOver(const Vec3d& x, std::int32_t other)
    {
        owners_.at(x, slack, near_);
        const OwnersPower *own = nullptr, *rest = nullptr;
        for (const OwnersPower& near : near_) {
            if (near.owner == 0) own = &near;
            if (near.owner == other) rest = &near;
        }
        if (own && rest) return {own->power - rest->power, 2.0 * (rest->centre - own->centre)};
        return {own ? -slack : slack, Vec3d(0.0)};
    }

    /// Where the border crosses an edge, moved onto the surface along the border.
    /// @param[in]  own,foreign  its ends
    /// @param[out] other        the owner beyond
    Vec3d crossing(const Vec3d& own, const Vec3d& foreign, std::int32_t& other, Jet& jet)
    {
        // Regula falsi (Illinois) on the edge.
        double low = 0.0, high = 1.0;
        double below = excess(own, other).value, above = excess(foreign, other).value;
        Vec3d x = own;
        for (int i = 0; i < steps; ++i) {
            double t = low + (high - low) * below / (below - above);
            if (!(t >= low && t <= high)) t = 0.5 * (low + high);
            x = own + t * (foreign - own);
            const double f = excess(x, other).value;
            if (std::abs(f) < 1e-7) break;
            if (f < 0.0) {
                low = t;
                below = f;
                above *= 0.5;
            } else {
                high = t;
                above = f;
                below *= 0.5;
            }
        }
        settle(x, jet, [&](const Vec3d& y, Mat3d& rows, Vec3d& values) {
            const Excess e = excess(y, other);
            rows.setRow(1, e.slope);
            values[1] = e.value;
            return 2;
        });
        excess(x, other);
        return x;
    }

    /// Where owner 0 and two others meet on the surface.
    Vec3d corner(const Vec3d& start, std::int32_t first, std::int32_t second, Jet& jet)
    {
        Vec3d x = start;
        settle(x, jet, [&](const Vec3d& y, Mat3d& rows, Vec3d& values) {
            const Excess one = excessOver(y, first), two = excessOver(y, second);
            rows.setRow(1, one.slope);
            rows.setRow(2, two.slope);
            values[1] = one.value;
            values[2] = two.value;
            return 3;
        });
        return x;
    }

private:
    /// Newton's method of least steps for S = 0 and further equations. Where it fails, x stays on
    /// the border but off the surface.
    template<typename F>
    void settle(Vec3d& x, Jet& jet, const F& further)
    {
        const Vec3d start = x;
        for (int i = 0; i < steps; ++i) {
            jet = sampler_.at(x);
            Mat3d rows = Mat3d::zero();
            Vec3d values(jet.value, 0.0, 0.0);
            rows.setRow(0, jet.gradient);
            const int count = further(x, rows, values);
            // Rows of unit length, so that values are distances.
            double worst = 0.0;
            for (int k = 0; k < count; ++k) {
                const double length = rows.row(k).length();
                if (length < 1e-6) return restore(start, x, jet);
                rows.setRow(k, rows.row(k) / length);
                values[k] /= length;
                worst = std::max(worst, std::abs(values[k]));
            }
            if (worst < converged * h_) return;
            Mat3d gram = rows * rows.transpose();
            for (int k = count; k < 3; ++k) gram(k, k) = 1.0;
            if (std::abs(gram.det()) < 1e-3) return restore(start, x, jet);
            const Vec3d step = rows.transpose() * (gram.inverse() * values);
            const double length = step.length(), most = 0.5 * h_;
            x -= step * (length > most ? most / length : 1.0);
            if ((x - start).length() > reach * h_) return restore(start, x, jet);
        }
    }

    void restore(const Vec3d& start, Vec3d& x, Jet& jet)
    {
        x = start;
        jet = sampler_.at(x);
    }

    const PowerOwners& owners_;
    SplineSampler sampler_;
    double h_;
    std::vector<OwnersPower> near_;
};

/// A vertex of the border.
struct BorderVertex {
    Vec3f position, normal;
    float mean = 0.0f, gauss = 0.0f; ///< curvature [1/Å], [1/Å^2]
    std::int32_t other = -1;         ///< the owner beyond
};

BorderVertex vertexAt(const Vec3d& x, const Jet& jet, std::int32_t other)
{
    BorderVertex out;
    out.position = Vec3f(x);
    const double slope = jet.gradient.length();
    out.normal = slope > 0.0 ? Vec3f(jet.gradient / slope) : Vec3f(0.0f, 0.0f, 1.0f);
    const Curvature k = curvature(jet);
    out.mean = float(k.mean());
    out.gauss = float(k.gaussian());
    out.other = other;
    return out;
}

using Triangle = std::array<std::uint32_t, 3>;

} // namespace

CutMesh cutToOwner(const Mesh& mesh, const PowerOwners& owners, const Spline& spline,
                   const Progress& progress)
{
    const std::size_t vertices = mesh.positions.size();
    constexpr std::size_t chunk = 256;
    std::vector<char> own(vertices);
    parallelFor((vertices + chunk - 1) / chunk, progress, [&](std::size_t c) {
        BorderFinder finder(owners, spline);
        for (std::size_t v = c * chunk; v < std::min(vertices, (c + 1) * chunk); ++v)
            own[v] = finder.owns(Vec3d(mesh.positions[v]));
    });

    CutMesh out;
    std::vector<std::uint32_t> place(vertices); // in the part, of those that are its
    for (std::size_t v = 0; v < vertices; ++v) {
        if (!own[v]) continue;
        place[v] = std::uint32_t(out.sources.size());
        out.sources.push_back(std::uint32_t(v));
    }
    const auto first = std::uint32_t(out.sources.size());

    // Edges that the border crosses, each with a vertex.
    std::vector<std::array<std::uint32_t, 2>> edges; // own, foreign
    std::unordered_map<std::uint64_t, std::uint32_t> vertexOf;
    const auto onEdge = [&](std::uint32_t a, std::uint32_t b) {
        if (!own[a]) std::swap(a, b);
        const auto [found, isNew] =
            vertexOf.emplace(std::uint64_t(a) << 32 | b, first + std::uint32_t(edges.size()));
        if (isNew) edges.push_back({a, b});
        return found->second;
    };
    struct BorderEdge {
        std::uint32_t from, to;
        std::uint32_t triangle; ///< of the part
    };
    std::vector<BorderEdge> borders;
    std::vector<Triangle>& triangles = out.mesh.triangles;
    const auto touched = std::size_t(
        std::count_if(mesh.triangles.begin(), mesh.triangles.end(),
                      [&](const Triangle& t) { return own[t[0]] || own[t[1]] || own[t[2]]; }));
    triangles.reserve(touched + touched / 16); // what comes for the border fits, too
    for (const Triangle& t : mesh.triangles) {
        const int count = own[t[0]] + own[t[1]] + own[t[2]];
        if (count == 0) continue;
        if (count == 3) {
            triangles.push_back({place[t[0]], place[t[1]], place[t[2]]});
            continue;
        }
        int k = 0; // the corner that is unlike the others
        while (own[t[std::size_t(k)]] != (count == 1)) ++k;
        const std::uint32_t a = t[std::size_t(k)], b = t[std::size_t((k + 1) % 3)],
                            c = t[std::size_t((k + 2) % 3)];
        const std::uint32_t ab = onEdge(a, b), ac = onEdge(a, c);
        if (count == 1) {
            borders.push_back({ab, ac, std::uint32_t(triangles.size())});
            triangles.push_back({ab, ac, place[a]});
        } else {
            triangles.push_back({place[b], place[c], ab});
            borders.push_back({ac, ab, std::uint32_t(triangles.size())});
            triangles.push_back({ac, ab, place[c]});
        }
    }

    std::vector<BorderVertex> added(edges.size());
    parallelFor((edges.size() + chunk - 1) / chunk, progress, [&](std::size_t c) {
        BorderFinder finder(owners, spline);
        for (std::size_t e = c * chunk; e < std::min(edges.size(), (c + 1) * chunk); ++e) {
            std::int32_t other = -1;
            Jet jet;
            const Vec3d x = finder.crossing(Vec3d(mesh.positions[edges[e][0]]),
                                            Vec3d(mesh.positions[edges[e][1]]), other, jet);
            added[e] = vertexAt(x, jet, other);
        }
    });

    // Corners, where the owner beyond changes.
    BorderFinder finder(owners, spline);
    struct Step {
        std::uint32_t to;
        std::int32_t other; ///< beyond the edge that ends there
        std::uint32_t triangle;
    };
    std::vector<Step> next(edges.size()); // of each vertex of the border
    for (const BorderEdge& border : borders) {
        const BorderVertex from = added[border.from - first], to = added[border.to - first];
        next[border.from - first] = {border.to, to.other, border.triangle};
        if (from.other == to.other || from.other < 0 || to.other < 0) continue;
        Jet jet;
        const Vec3d x = finder.corner(0.5 * (Vec3d(from.position) + Vec3d(to.position)), from.other,
                                      to.other, jet);
        const auto corner = first + std::uint32_t(added.size());
        added.push_back(vertexAt(x, jet, to.other));
        next.push_back({border.to, to.other, std::uint32_t(triangles.size())});
        next[border.from - first] = {corner, from.other, border.triangle};
        const std::uint32_t third = triangles[border.triangle][2];
        triangles[border.triangle][1] = corner;
        triangles.push_back({corner, border.to, third});
    }

    std::vector<char> seen(added.size(), 0);
    for (std::size_t e = 0; e < added.size(); ++e) {
        if (seen[e]) continue;
        BorderLoop& loop = out.loops.emplace_back();
        for (std::uint32_t v = first + std::uint32_t(e); !seen[v - first];) {
            seen[v - first] = 1;
            const Step& step = next[v - first];
            loop.vertices.push_back(v);
            loop.owners.push_back(step.other);
            loop.triangles.push_back(step.triangle);
            v = step.to;
        }
    }

    const std::size_t room = out.sources.size() + 4 * added.size();
    out.mesh.positions.reserve(room);
    out.mesh.normals.reserve(room);
    for (const std::uint32_t v : out.sources) {
        out.mesh.positions.push_back(mesh.positions[v]);
        out.mesh.normals.push_back(mesh.normals[v]);
    }
    for (const Attribute<float>& a : mesh.scalars) {
        Attribute<float>& part = out.mesh.scalars.emplace_back();
        part.name = a.name;
        part.values.reserve(room);
        for (const std::uint32_t v : out.sources) part.values.push_back(a.values[v]);
    }
    for (const BorderVertex& v : added) {
        out.mesh.positions.push_back(v.position);
        out.mesh.normals.push_back(v.normal);
        out.mesh.scalars[0].values.push_back(v.mean);
        out.mesh.scalars[1].values.push_back(v.gauss);
    }
    return out;
}

} // namespace molsurf
