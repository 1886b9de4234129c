// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/unit_border.h"

#include "molsurf/kernel/balls/ball_index.h"

#include <algorithm>
#include <map>
#include <unordered_map>
#include <utility>

namespace molsurf
{

using openvdb::Vec3d;
using openvdb::Vec3f;

namespace
{

/// An edge in the whole.
struct UnitEdge {
    std::int32_t unit;
    std::uint32_t edge;
};

/// A vertex in the whole.
struct UnitVertex {
    std::int32_t unit;
    std::uint32_t vertex;
    bool operator==(const UnitVertex& o) const { return unit == o.unit && vertex == o.vertex; }
};

/// Glues edges of the border with those of neighbours. Vertices are one because their edges are,
/// and for no other reason: then the edges that are left free make closed lines without common
/// vertices.
class BorderFitter
{
public:
    BorderFitter(const Placement& placement, double voxel, CutMesh& part)
        : unit_(*placement.unit), motions_(placement.instances), near_(voxel),
          longest_(3.0 * voxel), mesh_(part.mesh), edges_(std::move(part.border))
    {
        for (std::uint32_t e = 0; e < edges_.size(); ++e) edgeFrom_[from(e)] = e;
    }

    BorderFit fit()
    {
        std::vector<std::int32_t> owners;
        for (const BorderEdge& e : edges_) owners.push_back(e.owner);
        std::sort(owners.begin(), owners.end());
        owners.erase(std::unique(owners.begin(), owners.end()), owners.end());
        for (const std::int32_t g : owners)
            if (g >= 0 && g <= inverse(g)) glueStrips(g, anchorsAt(g));
        while (unglueFolds()) {
        }
        glueCoincident();
        moveToMeans();
        fillHoles();
        return std::move(out_);
    }

private:
    using Chain = std::vector<std::uint32_t>;                         // of edges
    using Anchors = std::unordered_map<std::uint32_t, std::uint32_t>; // vertices

    Vec3d at(std::uint32_t v) const { return Vec3d(mesh_.positions[v]); }
    std::int32_t inverse(std::int32_t g) const
    {
        return std::int32_t(unit_.inverse[std::size_t(g)]);
    }
    std::int32_t product(std::int32_t g, std::int32_t h) const
    {
        return std::int32_t(unit_.product[std::size_t(g)][std::size_t(h)]);
    }
    const Instance& motion(std::int32_t g) const { return motions_[std::size_t(g)]; }
    std::uint32_t from(std::uint32_t e) const { return edges_[e].from; }
    std::uint32_t to(std::uint32_t e) const { return edges_[edges_[e].next].from; }

    /// A vertex of the border with a neighbour.
    struct Place {
        Vec3d x, tangent, normal;
        std::uint32_t vertex;
        std::int32_t before, after; ///< owners beyond the edges there
    };

    /// The vertices of the border with a neighbour g.
    std::vector<Place> placesAt(std::int32_t g) const
    {
        std::vector<Place> out;
        for (const BorderEdge& e : edges_) {
            const BorderEdge& last = edges_[e.previous];
            if (e.owner != g && last.owner != g) continue;
            out.push_back({at(e.from), at(edges_[e.next].from) - at(last.from),
                           Vec3d(mesh_.normals[e.from]), e.from, last.owner, e.owner});
        }
        return out;
    }

    /// The same of the neighbour's border with the unit, where they are in the whole.
    std::vector<Place> placesOf(std::int32_t g) const
    {
        std::vector<Place> out = placesAt(inverse(g));
        for (Place& p : out) {
            p.x = motion(g).placed(p.x);
            p.tangent = motion(g).turned(p.tangent);
            p.normal = motion(g).turned(p.normal);
            if (p.before >= 0) p.before = product(g, p.before);
            if (p.after >= 0) p.after = product(g, p.after);
        }
        return out;
    }

    /// Whether a vertex of the unit's border with a neighbour g may be one of the neighbour's: the
    /// sheet is the same, and so are all owners there. The neighbour's border runs the other way,
    /// and where the unit has g beyond, the neighbour has the unit, 0. On a two-fold axis a vertex
    /// may be its own image.
    bool mayBeOne(const Place& own, const Place& its, std::int32_t g) const
    {
        const auto same = [&](std::int32_t ofOwn, std::int32_t ofIts) {
            return ofOwn >= 0 && ofIts == (ofOwn == g ? 0 : ofOwn);
        };
        if (own.normal.dot(its.normal) < 0.0) return false;
        if (own.before == g && own.after == g && own.tangent.dot(its.tangent) > 0.0) return false;
        const bool onAxis = own.vertex == its.vertex && own.before >= 0 && own.after >= 0 &&
                            product(own.before, own.after) == 0;
        return onAxis || (same(own.before, its.after) && same(own.after, its.before));
    }

    /// The vertices of the border with a neighbour g, each with the neighbour's vertex, that are
    /// mutually nearest, within near_.
    Anchors anchorsAt(std::int32_t g) const
    {
        const std::vector<Place> own = placesAt(g), its = placesOf(g);
        const auto nearest = [&](const std::vector<Place>& of, const std::vector<Place>& among,
                                 const auto& fits) {
            std::vector<Ball> points;
            for (const Place& p : among) points.push_back({p.x, 0.0, 0});
            const BallIndex index(points, {0.0, 0.0, std::max(1.0, near_)});
            std::vector<std::size_t> out;
            for (const Place& p : of) {
                double least = near_ * near_;
                std::size_t best = among.size();
                index.forEachNear(p.x, p.x, near_, [&](const Ball& ball, std::int32_t i) {
                    const double square = (Vec3d(ball.center) - p.x).lengthSqr();
                    if (square > least || !fits(p, among[std::size_t(i)])) return;
                    least = square;
                    best = std::size_t(i);
                });
                out.push_back(best);
            }
            return out;
        };
        const auto ofOwn =
            nearest(own, its, [&](const Place& a, const Place& b) { return mayBeOne(a, b, g); });
        const auto ofIts =
            nearest(its, own, [&](const Place& a, const Place& b) { return mayBeOne(b, a, g); });
        Anchors out;
        for (std::size_t i = 0; i < own.size(); ++i) {
            const std::size_t k = ofOwn[i];
            if (k == its.size() || ofIts[k] != i) continue;
            if (g == inverse(g) && ofOwn[k] != i) continue; // both are the same border, turned
            out[own[i].vertex] = its[k].vertex;
        }
        return out;
    }

    /// The edges from one of some vertices to the next of them, if all of them border on g.
    template<typename F>
    Chain chainFrom(std::uint32_t vertex, std::int32_t g, const F& isEnd) const
    {
        Chain out;
        for (std::uint32_t e = edgeFrom_.at(vertex); edges_[e].owner == g; e = edges_[e].next) {
            out.push_back(e);
            if (isEnd(to(e))) return out;
        }
        return {};
    }

    /// Where the vertices of a chain are on it: from 0 to 1.
    std::vector<double> placesOn(const Chain& chain, double& length) const
    {
        std::vector<double> out = {0.0};
        for (const std::uint32_t e : chain)
            out.push_back(out.back() + (at(to(e)) - at(from(e))).length());
        length = out.back();
        for (double& s : out) s = length > 0.0 ? s / length : 0.0;
        out.back() = 1.0;
        return out;
    }

    /// Glues the parts of the border with a neighbour g from anchor to anchor. The two chains run
    /// in opposite directions. Each is split at the places, by share of its length, that the other
    /// has vertices at; then their edges correspond one to one.
    void glueStrips(std::int32_t g, const Anchors& anchorOf)
    {
        Anchors back;
        for (const auto& [own, its] : anchorOf) back[its] = own;
        const auto count = std::uint32_t(edges_.size());
        for (std::uint32_t e = 0; e < count; ++e) {
            if (edges_[e].owner != g || edges_[e].partner != noEdge) continue;
            const auto start = anchorOf.find(from(e));
            if (start == anchorOf.end()) continue;
            Chain own =
                chainFrom(from(e), g, [&](std::uint32_t v) { return anchorOf.count(v) > 0; });
            if (own.empty()) continue;
            Chain its = chainFrom(anchorOf.at(to(own.back())), inverse(g),
                                  [&](std::uint32_t v) { return back.count(v) > 0; });
            if (its.empty() || to(its.back()) != start->second) continue;
            double length = 0.0, itsLength = 0.0;
            const std::vector<double> s = placesOn(own, length);
            const std::vector<double> t = backward(placesOn(its, itsLength));
            if (std::max(length, itsLength) > longest_) continue;
            const bool mirrored = own[0] == its[0]; // it lies on a two-fold axis
            own = subdivided(own, s, t);
            its = mirrored ? own : subdivided(its, backward(t), backward(s));
            for (std::size_t i = 0; i < own.size(); ++i) glue(own[i], g, its[own.size() - 1 - i]);
        }
    }

    /// The places of a chain from its other end.
    static std::vector<double> backward(const std::vector<double>& places)
    {
        std::vector<double> out;
        for (auto s = places.rbegin(); s != places.rend(); ++s) out.push_back(1.0 - *s);
        return out;
    }

    /// Splits an edge and its triangle. @return its second part
    /// @param[in] w  where: from 0, its beginning, to 1
    std::uint32_t split(std::uint32_t e, double w)
    {
        const std::uint32_t a = from(e), b = to(e), v = std::uint32_t(mesh_.positions.size());
        const float u = float(w);
        mesh_.positions.push_back((1.0f - u) * mesh_.positions[a] + u * mesh_.positions[b]);
        mesh_.normals.push_back((1.0f - u) * mesh_.normals[a] + u * mesh_.normals[b]);
        for (auto& scalar : mesh_.scalars)
            scalar.values.push_back((1.0f - u) * scalar.values[a] + u * scalar.values[b]);
        const auto rest = std::uint32_t(edges_.size());
        auto& triangle = mesh_.triangles[edges_[e].triangle];
        const std::uint32_t third = triangle[2];
        triangle[1] = v;
        edges_.push_back(
            {v, edges_[e].owner, std::uint32_t(mesh_.triangles.size()), edges_[e].next, e});
        mesh_.triangles.push_back({v, b, third});
        edges_[edges_[e].next].previous = rest;
        edges_[e].next = rest;
        edgeFrom_[v] = rest;
        return rest;
    }

    /// Splits edges of a chain at further places between its ends. @return the new chain
    /// @param[in] places,further  ascending from 0 to 1, as of placesOn()
    Chain subdivided(const Chain& chain, const std::vector<double>& places,
                     const std::vector<double>& further)
    {
        Chain out;
        std::size_t j = 1;
        for (std::size_t i = 0; i < chain.size(); ++i) {
            std::uint32_t e = chain[i];
            double begin = places[i];
            for (; j + 1 < further.size() && (i + 1 == chain.size() || further[j] < places[i + 1]);
                 ++j) {
                const double width = places[i + 1] - begin;
                out.push_back(e);
                e = split(e, width > 0.0 ? (further[j] - begin) / width : 0.5);
                begin = further[j];
            }
            out.push_back(e);
        }
        return out;
    }

    void glue(std::uint32_t e, std::int32_t g, std::uint32_t other)
    {
        edges_[e].partner = other;
        edges_[e].neighbour = g;
        edges_[other].partner = e;
        edges_[other].neighbour = inverse(g);
    }

    void unglue(std::uint32_t e)
    {
        if (edges_[e].partner == noEdge) return;
        edges_[edges_[e].partner].partner = noEdge;
        edges_[e].partner = noEdge;
    }

    /// The vertices of neighbours that a vertex is one with since their edges are.
    std::vector<UnitVertex> gluedTo(std::uint32_t v) const
    {
        std::vector<UnitVertex> out;
        const BorderEdge& after = edges_[edgeFrom_.at(v)];
        const BorderEdge& before = edges_[after.previous];
        if (after.partner != noEdge) out.push_back({after.neighbour, to(after.partner)});
        if (before.partner != noEdge) {
            const UnitVertex other{before.neighbour, from(before.partner)};
            if (out.empty() || !(out[0] == other)) out.push_back(other);
        }
        return out;
    }

    /// All vertices of units that a vertex is one with, itself first: a breadth-first search over
    /// glued edges.
    std::vector<UnitVertex> classOf(std::uint32_t v) const
    {
        std::vector<UnitVertex> out = {{0, v}};
        for (std::size_t i = 0; i < out.size(); ++i) {
            const std::int32_t unit = out[i].unit;
            for (const UnitVertex& other : gluedTo(out[i].vertex)) {
                const UnitVertex found{product(unit, other.unit), other.vertex};
                if (std::find(out.begin(), out.end(), found) == out.end()) out.push_back(found);
            }
        }
        return out;
    }

    /// Frees the edges at vertices of which two of one unit have become one.
    /// @return whether there were any
    bool unglueFolds()
    {
        std::vector<std::uint32_t> folded;
        for (const BorderEdge& e : edges_) {
            for (const UnitVertex& other : classOf(e.from))
                if (other.unit == 0 && other.vertex != e.from) folded.push_back(e.from);
        }
        for (const std::uint32_t v : folded) {
            unglue(edgeFrom_.at(v));
            unglue(edges_[edgeFrom_.at(v)].previous);
        }
        return !folded.empty();
    }

    /// Glues the edges whose ends are one already.
    void glueCoincident()
    {
        for (std::uint32_t e = 0; e < edges_.size(); ++e) {
            if (edges_[e].partner != noEdge) continue;
            const std::vector<UnitVertex> ends = classOf(to(e));
            for (const UnitVertex& other : classOf(from(e))) {
                const std::uint32_t before = edges_[edgeFrom_.at(other.vertex)].previous;
                const UnitVertex start{other.unit, from(before)};
                if (other.unit == 0 || edges_[before].partner != noEdge ||
                    std::find(ends.begin(), ends.end(), start) == ends.end())
                    continue;
                glue(e, other.unit, before);
                break;
            }
        }
    }

    /// Moves vertices that are one to the middle of where they were.
    void moveToMeans()
    {
        std::vector<std::pair<Vec3d, Vec3d>> means;
        for (const BorderEdge& e : edges_) {
            Vec3d x(0.0), n(0.0);
            const std::vector<UnitVertex> same = classOf(e.from);
            for (const UnitVertex& v : same) {
                x += motion(v.unit).placed(at(v.vertex)) / double(same.size());
                n += motion(v.unit).turned(Vec3d(mesh_.normals[v.vertex]));
            }
            means.emplace_back(x, n);
        }
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            const std::uint32_t v = edges_[e].from;
            const auto& [x, n] = means[e];
            // No two of them were farther apart than twice the longest way to the middle.
            out_.largest = std::max(out_.largest, 2.0 * (x - at(v)).length());
            mesh_.positions[v] = Vec3f(x);
            if (n.lengthSqr() > 0.0) mesh_.normals[v] = Vec3f(n.unit());
            for (const UnitVertex& other : gluedTo(v))
                out_.shared.push_back({v, other.unit, other.vertex});
        }
    }

    /// The free edge of the whole that follows another one around a hole: turns about its end, over
    /// each glued edge into the next unit.
    UnitEdge following(const UnitEdge& e) const
    {
        UnitEdge out{e.unit, edges_[e.edge].next};
        while (edges_[out.edge].partner != noEdge) {
            const BorderEdge& glued = edges_[out.edge];
            out = {product(out.unit, glued.neighbour), edges_[glued.partner].next};
        }
        return out;
    }

    /// Closes the holes that are left, at gaps and necks too narrow for the voxels, by triangles
    /// about their middles.
    void fillHoles()
    {
        std::vector<char> done(edges_.size(), 0);
        for (std::uint32_t first = 0; first < edges_.size(); ++first) {
            if (edges_[first].partner != noEdge || done[first]) continue;
            std::vector<UnitEdge> round; // up to `first` or its image in next.unit
            UnitEdge next{0, first};
            do {
                round.push_back(next);
                done[next.edge] = 1;
                next = following(next);
            } while (next.edge != first);
            fillHole(round, next.unit);
            out_.open += round.size();
        }
    }

    /// Fills a hole by a fan of triangles about its middle. Each edge of the round, in whatever
    /// unit, gets its triangle in the frame of that unit, which puts it into the one mesh of all. A
    /// hole about an axis is the round and its images by the powers of `turn`.
    /// @param[in] turn  the rotation that brings the beginning of the round to its end; 0: none
    void fillHole(const std::vector<UnitEdge>& round, std::int32_t turn)
    {
        Vec3d middle(0.0), normal(0.0);
        double weight = 0.0;
        const Vec3d origin = at(from(round[0].edge));
        std::int32_t power = 0;
        do {
            for (const UnitEdge& e : round) {
                const Instance& there = motion(product(power, e.unit));
                const Vec3d a = there.placed(at(from(e.edge))), b = there.placed(at(to(e.edge)));
                middle += 0.5 * (b - a).length() * (a + b);
                weight += (b - a).length();
                normal += (b - origin).cross(a - origin);
            }
            power = product(power, turn);
        } while (power != 0);
        middle = weight > 0.0 ? middle / weight : origin;
        std::map<std::int32_t, std::uint32_t> middleOf; // of units
        for (const UnitEdge& e : round) {
            const Instance& back = motion(inverse(e.unit));
            std::int32_t like = e.unit; // the first unit that the rotation brings there
            for (power = turn; power != 0; power = product(power, turn))
                like = std::min(like, product(power, e.unit));
            const auto [found, isNew] =
                middleOf.emplace(like, std::uint32_t(mesh_.positions.size()));
            const std::uint32_t a = from(e.edge), b = to(e.edge), v = found->second;
            if (isNew) {
                mesh_.positions.push_back(Vec3f(back.placed(middle)));
                mesh_.normals.push_back(normal.lengthSqr() > 0.0 ? Vec3f(back.turned(normal.unit()))
                                                                 : mesh_.normals[a]);
                for (auto& scalar : mesh_.scalars) scalar.values.push_back(scalar.values[a]);
                share(middleOf.begin()->second, e.unit, v);
            }
            mesh_.triangles.push_back({b, a, v});
            out_.filled += 0.5 * (at(a) - at(v)).cross(at(b) - at(v)).length();
        }
        share(middleOf.begin()->second, turn, middleOf.begin()->second);
    }

    void share(std::uint32_t v, std::int32_t g, std::uint32_t other)
    {
        if (g == 0) return;
        out_.shared.push_back({v, g, other});
        out_.shared.push_back({other, inverse(g), v});
    }

    const Placement::Unit& unit_;
    const std::vector<Instance>& motions_;
    const double near_;    ///< how far vertices that become one are apart [Å]
    const double longest_; ///< line between two of them [Å]
    Mesh& mesh_;
    std::vector<BorderEdge> edges_;
    BorderFit out_;
    std::unordered_map<std::uint32_t, std::uint32_t> edgeFrom_; ///< of vertices
};

} // namespace

BorderClasses::BorderClasses(const Placement::Unit& unit,
                             const std::vector<MolecularSurface::SharedVertex>& shared,
                             std::size_t vertices)
    : order_(unit.inverse.size()), border_([&] {
          std::vector<std::uint32_t> all;
          for (const MolecularSurface::SharedVertex& s : shared) all.push_back(s.vertex);
          std::sort(all.begin(), all.end());
          all.erase(std::unique(all.begin(), all.end()), all.end());
          return all;
      }()),
      place_(vertices, -1), sets_(order_ * border_.size())
{
    const std::size_t n = border_.size();
    for (std::size_t i = 0; i < n; ++i) place_[border_[i]] = std::int32_t(i);
    for (const MolecularSurface::SharedVertex& s : shared) {
        const auto from = std::size_t(place_[s.vertex]), to = std::size_t(place_[s.other]);
        for (std::size_t k = 0; k < order_; ++k)
            sets_.join(std::uint32_t(k * n + from),
                       std::uint32_t(unit.product[k][std::size_t(s.motion)] * n + to));
    }
}

std::size_t BorderClasses::count()
{
    std::size_t out = 0;
    for (std::size_t i = 0; i < order_ * border_.size(); ++i)
        out += sets_.find(std::uint32_t(i)) == i;
    return out;
}

BorderFit fitBorder(const Placement& placement, double voxel, CutMesh& part)
{
    return BorderFitter(placement, voxel, part).fit();
}

} // namespace molsurf
