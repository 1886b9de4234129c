// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/unit_cut.h"

#include "molsurf/kernel/core/bracketed_root.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/spline/curvature.h"

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

constexpr double converged = 1e-4; // of a border vertex, from the surface and the border [voxel]
constexpr double reach = 1.5;      // how far it may move from where an edge crosses [voxel]
constexpr int cutSteps = 12;

constexpr std::int32_t strongest = -1; // of the other owners

/// Finds points of the border. One a thread.
class BorderFinder
{
public:
    BorderFinder(const PowerOwners& owners, const Spline& spline)
        : owners_(owners), sampler_(spline), h_(spline.voxelSize())
    {
    }

    /// The excess of owner 0 over another one.
    PowerExcess excess(const Vec3d& x, std::int32_t over)
    {
        return owners_.excess(x, 0, over, near_);
    }

    /// Where the border crosses an edge (regula falsi), moved onto the surface along it (solve()).
    /// @param[in]  own,foreign  its ends
    /// @param[out] other        the owner beyond
    Vec3d crossing(const Vec3d& own, const Vec3d& foreign, std::int32_t& other, Jet& jet)
    {
        Vec3d x = own;
        const auto at = [&](const Vec3d& y) {
            const PowerExcess e = excess(y, strongest);
            other = e.other;
            return e.value;
        };
        const double below = at(own), above = at(foreign);
        zeroBetween(below, above, {cutSteps, 0.0, 1e-7}, [&](double t) {
            x = own + t * (foreign - own);
            return at(x);
        });
        solve(x, jet, [&](const Vec3d& y, Mat3d& rows, Vec3d& values) {
            const PowerExcess e = excess(y, strongest);
            other = e.other;
            rows.setRow(1, e.slope);
            values[1] = e.value;
            return 2;
        });
        other = excess(x, strongest).other;
        return x;
    }

    /// Where owner 0 and two others meet on the surface.
    Vec3d corner(const Vec3d& start, std::int32_t first, std::int32_t second, Jet& jet)
    {
        Vec3d x = start;
        solve(x, jet, [&](const Vec3d& y, Mat3d& rows, Vec3d& values) {
            const PowerExcess one = excess(y, first), two = excess(y, second);
            rows.setRow(1, one.slope);
            rows.setRow(2, two.slope);
            values[1] = one.value;
            values[2] = two.value;
            return 3;
        });
        return x;
    }

private:
    /// Newton's method for S = 0 and one or two further equations, whose values and gradients
    /// `further` puts in rows 1 and 2. With fewer than three equations J dx = values has many
    /// solutions, and the shortest is taken: dx = J^T (J J^T)^-1 values. Where it fails, x stays on
    /// the border but off the surface.
    template<typename F>
    void solve(Vec3d& x, Jet& jet, const F& further)
    {
        const Vec3d start = x;
        for (int i = 0; i < cutSteps; ++i) {
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
struct AddedVertex {
    Vec3f position, normal;
    float mean = 0.0f, gauss = 0.0f; ///< curvature [1/Å], [1/Å^2]
    std::int32_t other = -1;         ///< the owner beyond
};

AddedVertex vertexAt(const Vec3d& x, const Jet& jet, std::int32_t other)
{
    AddedVertex out;
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

/// An edge of the border, in a triangle of the part.
struct CutEdge {
    std::uint32_t from, to;
    std::uint32_t triangle;
};

/// The next step from a vertex of the border.
struct CutStep {
    std::uint32_t to;
    std::int32_t other; ///< the owner beyond the edge that ends there
    std::uint32_t triangle;
};

/// The vertices where the border crosses edges.
/// @param[in] edges  each with the vertex of owner 0 first
std::vector<AddedVertex> crossingsOf(const Mesh& mesh,
                                     const std::vector<std::array<std::uint32_t, 2>>& edges,
                                     const PowerOwners& owners, const Spline& spline,
                                     const Progress& progress)
{
    constexpr std::size_t chunk = 256;
    std::vector<AddedVertex> added(edges.size());
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
    return added;
}

/// Links the edges of the border. One between vertices with different owners beyond is split, and
/// its triangle with it, at the corner where these owners meet.
/// @param[in]     first      number of the first vertex of the border
/// @param[in,out] added      the vertices of the border: corners come behind
/// @param[in,out] triangles  of the part
/// @return the step from each of them
std::vector<CutStep> followBorder(const std::vector<CutEdge>& borders, std::uint32_t first,
                                  BorderFinder& finder, std::vector<AddedVertex>& added,
                                  std::vector<Triangle>& triangles)
{
    std::vector<CutStep> next(added.size());
    for (const CutEdge& border : borders) {
        const AddedVertex from = added[border.from - first], to = added[border.to - first];
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
    return next;
}

/// The edges of the border, closed line after closed line.
/// @param[in] next  as of followBorder()
std::vector<BorderEdge> edgesOf(const std::vector<CutStep>& next, std::uint32_t first)
{
    std::vector<BorderEdge> out;
    std::vector<char> seen(next.size(), 0);
    for (std::size_t begin = 0; begin < next.size(); ++begin) {
        const auto start = std::uint32_t(out.size());
        for (std::size_t i = begin; !seen[i]; i = next[i].to - first) {
            seen[i] = 1;
            const auto e = std::uint32_t(out.size());
            out.push_back(
                {first + std::uint32_t(i), next[i].other, next[i].triangle, e + 1, e - 1});
        }
        if (start == out.size()) continue;
        out.back().next = start;
        out[start].previous = std::uint32_t(out.size() - 1);
    }
    return out;
}

/// Adds the vertices of a part: those of the whole at `sources`, and those of the border.
void addVertices(const Mesh& whole, const std::vector<std::uint32_t>& sources,
                 const std::vector<AddedVertex>& added, Mesh& part)
{
    const std::size_t room = sources.size() + 4 * added.size();
    part.positions.reserve(room);
    part.normals.reserve(room);
    for (const std::uint32_t v : sources) {
        part.positions.push_back(whole.positions[v]);
        part.normals.push_back(whole.normals[v]);
    }
    for (const Attribute<float>& a : whole.scalars) {
        Attribute<float>& to = part.scalars.emplace_back();
        to.name = a.name;
        to.values.reserve(room);
        for (const std::uint32_t v : sources) to.values.push_back(a.values[v]);
    }
    for (const AddedVertex& v : added) {
        part.positions.push_back(v.position);
        part.normals.push_back(v.normal);
        part.scalars[0].values.push_back(v.mean);
        part.scalars[1].values.push_back(v.gauss);
    }
}

} // namespace

CutMesh cutToOwner(const Mesh& mesh, const PowerOwners& owners, const Spline& spline,
                   const Progress& progress)
{
    const std::size_t vertices = mesh.positions.size();
    std::vector<std::int32_t> own = owners.ownersOf(mesh.positions, progress);
    for (std::int32_t& owner : own) owner = owner == 0; // whether it is owner 0

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
    std::vector<CutEdge> borders;
    std::vector<Triangle>& triangles = out.mesh.triangles;
    const auto touched = std::size_t(
        std::count_if(mesh.triangles.begin(), mesh.triangles.end(),
                      [&](const Triangle& t) { return own[t[0]] || own[t[1]] || own[t[2]]; }));
    triangles.reserve(touched + touched / 16); // what comes for the border fits, too
    for (const Triangle& t : mesh.triangles) {
        const std::int32_t count = own[t[0]] + own[t[1]] + own[t[2]];
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
        if (count == 1) { // the tip at a stays; else the rest, a quad, is cut from c to ab
            borders.push_back({ab, ac, std::uint32_t(triangles.size())});
            triangles.push_back({ab, ac, place[a]});
        } else {
            triangles.push_back({place[b], place[c], ab});
            borders.push_back({ac, ab, std::uint32_t(triangles.size())});
            triangles.push_back({ac, ab, place[c]});
        }
    }

    std::vector<AddedVertex> added = crossingsOf(mesh, edges, owners, spline, progress);
    BorderFinder finder(owners, spline);
    const std::vector<CutStep> next = followBorder(borders, first, finder, added, triangles);
    out.border = edgesOf(next, first);
    addVertices(mesh, out.sources, added, out.mesh);
    return out;
}

} // namespace molsurf
