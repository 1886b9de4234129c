// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/color/crisp_borders.h"

#include "molsurf/kernel/core/bracketed_root.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/show/color/color_table.h"
#include "molsurf/show/color/palette.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>

namespace molsurf
{

using openvdb::Vec3d;
using openvdb::Vec3f;

namespace
{

using Triangle = std::array<std::uint32_t, 3>;

/// From the middle of an edge to that of the cubic Hermite arc over it, which is at right angles to
/// both normals (as in measure()) [Å].
Vec3d bulge(const Mesh& mesh, std::uint32_t a, std::uint32_t b)
{
    const Vec3d edge = Vec3d(mesh.positions[b]) - Vec3d(mesh.positions[a]);
    const Vec3d m(mesh.normals[a]), n(mesh.normals[b]);
    return (edge.dot(n) * n - edge.dot(m) * m) / 8.0;
}

/// A point on the arc from a to b, taken as the parabola with the same middle.
Vec3d onArc(const Mesh& mesh, std::uint32_t a, std::uint32_t b, double t)
{
    return (1.0 - t) * Vec3d(mesh.positions[a]) + t * Vec3d(mesh.positions[b]) +
           4.0 * t * (1.0 - t) * bulge(mesh, a, b);
}

/// A point of the quadratic patch whose sides are those arcs, at barycentric coordinates w.
Vec3d onPatch(const Mesh& mesh, const Triangle& t, const Vec3d& w)
{
    Vec3d x(0.0);
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        x += w[k] * Vec3d(mesh.positions[t[std::size_t(k)]]);
        x += 4.0 * w[i] * w[j] * bulge(mesh, t[std::size_t(i)], t[std::size_t(j)]);
    }
    return x;
}

class Cutter
{
public:
    Cutter(const Mesh& mesh, const PowerOwners& owners) : mesh_(mesh), owners_(owners) {}

    /// How much more power owner a has at a point than owner b [Å^2].
    double excess(const Vec3d& x, std::int32_t a, std::int32_t b)
    {
        return owners_.excess(x, a, b, near_).value;
    }

    /// Where the arc from a vertex of owner `own` to one of owner `other` crosses their border.
    double crossing(std::uint32_t a, std::uint32_t b, std::int32_t own, std::int32_t other)
    {
        const auto at = [&](double t) { return excess(onArc(mesh_, a, b, t), own, other); };
        return zeroBetween(at(0.0), at(1.0), {20, 1e-5, 1e-6}, at);
    }

    /// Moves a point onto the circle in which the spheres of two owners meet, by Newton's
    /// method; leaves it if that is farther than a limit [Å], or not found. A mesh cuts off the
    /// crease there.
    void snap(Vec3d& x, std::int32_t a, std::int32_t b, double limit)
    {
        const Vec3d start = x;
        for (int i = 0; i < 6; ++i) {
            owners_.at(x, 16.0, near_);
            const OwnersPower *first = nullptr, *second = nullptr;
            for (const OwnersPower& near : near_) {
                if (near.owner == a) first = &near;
                if (near.owner == b) second = &near;
            }
            if (!first || !second) break;
            // Both powers f, g are to vanish, by the shortest step: a combination of their
            // gradients u, v, from two equations for the factors.
            const Vec3d u = 2.0 * (x - first->centre), v = 2.0 * (x - second->centre);
            const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), det = uu * vv - uv * uv;
            if (det < 1e-6 * uu * vv) break; // centres nearly in line with x
            const double f = first->power, g = second->power;
            const Vec3d step = ((vv * f - uv * g) * u + (uu * g - uv * f) * v) / det;
            x -= step;
            if ((x - start).length() > limit) break;
            if (step.length() < 1e-6) return;
        }
        x = start;
    }

    /// Barycentric coordinates (1 - u - v, u, v) where the three owners of a triangle's corners
    /// have equal power: by Newton's method with difference quotients. Moved inside if it lies just
    /// outside; the middle, if it is far away.
    Vec3d meeting(const Triangle& t, const std::array<std::int32_t, 3>& owner)
    {
        const Vec3d middle(1.0 / 3.0);
        Vec3d w = middle;
        constexpr double small = 1e-3;
        const auto at = [&](double u, double v) {
            const Vec3d x = onPatch(mesh_, t, {1.0 - u - v, u, v});
            return std::pair(excess(x, owner[0], owner[1]), excess(x, owner[0], owner[2]));
        };
        for (int i = 0; i < 8; ++i) {
            const auto [f, g] = at(w[1], w[2]);
            const auto [fu, gu] = at(w[1] + small, w[2]);
            const auto [fv, gv] = at(w[1], w[2] + small);
            const double a = (fu - f) / small, b = (fv - f) / small;
            const double c = (gu - g) / small, d = (gv - g) / small;
            const double det = a * d - b * c;
            if (std::abs(det) < 1e-12) return middle;
            const double du = (d * f - b * g) / det, dv = (a * g - c * f) / det;
            w[1] = std::clamp(w[1] - du, -1.0, 2.0);
            w[2] = std::clamp(w[2] - dv, -1.0, 2.0);
            w[0] = 1.0 - w[1] - w[2];
            if (std::abs(du) + std::abs(dv) < 1e-5) break;
        }
        constexpr double least = 0.01, far = -0.5;
        double sum = 0.0;
        for (int k = 0; k < 3; ++k) {
            if (!(w[k] > far)) return middle;
            sum += w[k] = std::max(w[k], least);
        }
        return w / sum;
    }

private:
    const Mesh& mesh_;
    const PowerOwners& owners_;
    std::vector<OwnersPower> near_;
};

/// An edge that a border crosses, with its lower vertex first.
struct CrossedEdge {
    std::array<std::uint32_t, 2> ends;
    double crossing = 0.0; ///< the share of the way at which it is
    Vec3d place{0.0};
};

std::uint64_t keyOf(std::uint32_t a, std::uint32_t b)
{
    return std::uint64_t(std::min(a, b)) << 32 | std::max(a, b);
}

/// The mesh as it grows: a crossed edge gets two vertices, one for each side.
class Builder
{
public:
    Builder(const Mesh& mesh, const std::vector<std::int32_t>& owner,
            const std::vector<Color>& colors, const std::string& stepwise)
        : from_(mesh), to_(mesh), owner_(owner), colors_(colors), stepwise_(stepwise)
    {
        to_.triangles.clear();
        to_.colors.clear();
        for (const std::int32_t k : owner) to_.colors.push_back(colors[std::size_t(k)]);
    }

    /// The edges that borders cross, in the order of the triangles; their places are to be found.
    std::vector<CrossedEdge> crossedEdges()
    {
        std::vector<CrossedEdge> edges;
        for (const Triangle& t : from_.triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t a = t[k], b = t[(k + 1) % 3];
                if (owner_[a] != owner_[b] && edgeOf_.emplace(keyOf(a, b), edges.size()).second)
                    edges.push_back({{std::min(a, b), std::max(a, b)}});
            }
        }
        return edges;
    }

    /// Adds the two vertices of the next crossed edge, that of its lower end's side first.
    void add(const CrossedEdge& edge)
    {
        const auto [a, b] = edge.ends;
        const double t = edge.crossing;
        for (const std::uint32_t side : {a, b}) add(edge.place, {a, b, b}, {1.0 - t, t, 0.0}, side);
    }

    /// Adds a triangle, or its pieces. Of three owners each corner gets two triangles as far as the
    /// point where they meet; of two owners one gets the tip, the other two triangles.
    void add(const Triangle& t, Cutter& cutter)
    {
        const std::array<std::int32_t, 3> o = {owner_[t[0]], owner_[t[1]], owner_[t[2]]};
        if (o[0] == o[1] && o[1] == o[2]) {
            to_.triangles.push_back(t);
        } else if (o[0] != o[1] && o[1] != o[2] && o[2] != o[0]) {
            const Vec3d w = cutter.meeting(t, o);
            const Vec3d x = onPatch(from_, t, w);
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
                const std::uint32_t middle = add(x, t, w, a);
                to_.triangles.push_back({a, onEdge(a, b), middle});
                to_.triangles.push_back({a, middle, onEdge(a, c)});
            }
        } else {
            std::size_t k = 0; // the corner that is unlike the others
            while (o[(k + 1) % 3] != o[(k + 2) % 3]) ++k;
            const std::uint32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
            to_.triangles.push_back({a, onEdge(a, b), onEdge(a, c)});
            to_.triangles.push_back({b, c, onEdge(b, a)});
            to_.triangles.push_back({c, onEdge(c, a), onEdge(b, a)});
        }
    }

    Mesh& mesh() { return to_; }

private:
    /// A vertex between others, on the side of one of them.
    std::uint32_t add(const Vec3d& x, const Triangle& between, const Vec3d& w, std::uint32_t side)
    {
        const auto v = std::uint32_t(to_.positions.size());
        to_.positions.push_back(Vec3f(x));
        Vec3d normal(0.0);
        for (int k = 0; k < 3; ++k) normal += w[k] * Vec3d(from_.normals[between[std::size_t(k)]]);
        to_.normals.push_back(normal.lengthSqr() > 0.0 ? Vec3f(normal.unit())
                                                       : from_.normals[side]);
        for (std::size_t a = 0; a < to_.scalars.size(); ++a) {
            double mean = 0.0;
            for (int k = 0; k < 3; ++k)
                mean += w[k] * double(from_.scalars[a].values[between[std::size_t(k)]]);
            const bool step = to_.scalars[a].name == stepwise_;
            to_.scalars[a].values.push_back(step ? from_.scalars[a].values[side] : float(mean));
        }
        for (std::size_t a = 0; a < to_.labels.size(); ++a)
            to_.labels[a].values.push_back(from_.labels[a].values[side]);
        to_.colors.push_back(colors_[std::size_t(owner_[side])]);
        return v;
    }

    /// The vertex on a crossed edge, on the side of its end `a`. Edge e has the vertices n + 2e and
    /// n + 2e + 1 (see add()), after the n of the mesh.
    std::uint32_t onEdge(std::uint32_t a, std::uint32_t b) const
    {
        return std::uint32_t(owner_.size() + 2 * edgeOf_.at(keyOf(a, b)) + (a > b));
    }

    const Mesh& from_;
    Mesh to_;
    const std::vector<std::int32_t>& owner_; ///< of the vertices of the first mesh
    const std::vector<Color>& colors_;       ///< of the owners
    const std::string& stepwise_;
    std::unordered_map<std::uint64_t, std::size_t> edgeOf_;
};

} // namespace

ColorOwners colorOwners(const std::vector<Ball>& balls, const std::vector<Color>& ballColor)
{
    std::map<Color, std::int32_t> number;
    std::vector<Color> colors;
    std::vector<std::int32_t> ownerOf;
    for (const Color& color : ballColor) {
        const auto [found, isNew] = number.emplace(color, std::int32_t(colors.size()));
        if (isNew) colors.push_back(color);
        ownerOf.push_back(found->second);
    }
    return {std::move(colors), PowerOwners(balls, std::move(ownerOf))};
}

std::shared_ptr<const ColorOwners> bordersOf(ColorBy color, const BallSet& atoms,
                                             const std::vector<Ball>& balls, const Mesh& mesh,
                                             const Progress& progress)
{
    const ColorKind& kind = kindOf(color);
    if (!kind.hasBorders || !kind.hasBorders(atoms)) return nullptr;
    if (balls.empty() || !mesh.parts.empty()) return nullptr;
    return std::make_shared<ColorOwners>(colorOwners(
        balls, atoms.colors.empty() ? ballColors(atoms, color, progress) : atoms.colors));
}

Mesh withCrispBorders(const Mesh& mesh, const ColorOwners& colorOwners, double crease,
                      const std::string& stepwise, const Progress& progress)
{
    const std::vector<Color>& colors = colorOwners.colors;
    const PowerOwners& owners = colorOwners.owners;
    const std::vector<std::int32_t> owner =
        colors.size() > 1 ? owners.ownersOf(mesh.positions, progress)
                          : std::vector<std::int32_t>(mesh.positions.size(), 0);

    Builder out(mesh, owner, colors, stepwise);
    std::vector<CrossedEdge> edges = out.crossedEdges();
    constexpr std::size_t chunk = 256;
    parallelFor((edges.size() + chunk - 1) / chunk, progress, [&](std::size_t c) {
        Cutter cutter(mesh, owners);
        for (std::size_t e = c * chunk; e < std::min(edges.size(), (c + 1) * chunk); ++e) {
            const auto [a, b] = edges[e].ends;
            edges[e].crossing = cutter.crossing(a, b, owner[a], owner[b]);
            edges[e].place = onArc(mesh, a, b, edges[e].crossing);
            if (crease > 0.0) cutter.snap(edges[e].place, owner[a], owner[b], crease);
        }
    });
    for (const CrossedEdge& edge : edges) out.add(edge);
    Cutter cutter(mesh, owners);
    for (const Triangle& t : mesh.triangles) out.add(t, cutter);
    return std::move(out.mesh());
}

} // namespace molsurf
