// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/mesh/remesh.h"

#include "molsurf/kernel/core/cancel.h"
#include "molsurf/kernel/core/orthonormal_basis.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/mesh/half_edges.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace molsurf
{

using openvdb::Coord;
using openvdb::Vec3d;
using openvdb::Vec3f;

namespace
{

using Id = HalfEdges::Id;
using Corners = std::array<std::uint32_t, 3>;

constexpr float longest = 4.0f / 3.0f, shortest = 4.0f / 5.0f; // of the target: Botsch and Kobbelt
constexpr float longestMended = 1.6f; // of the target, where an angle gets better
constexpr float steepest = 0.3f;      // cosine between a triangle's normal and those at its corners
constexpr float forbidden = 4.0f;     // in the place of a cosine, for what must not be made
constexpr float sharpest = 0.97f;     // cosine of the least angle that a change may make
constexpr float leastGain = 1e-3f;    // of a cosine, for what counts as better
constexpr double converged = 1e-4;    // |S| of a vertex that is taken [voxel]

/// A point on S = 0 and what is known there.
struct SurfacePoint {
    Vec3f position, normal;
    float slope, mean, gauss, residual;
};

/// The cosine of the least angle, between an edge and the next one turned back; 1 for a triangle
/// with an edge of length 0.
float cosineOf(const Vec3f& a, const Vec3f& b, const Vec3f& c)
{
    const Vec3f p = b - a, q = c - b, r = a - c;
    const float pp = p.length(), qq = q.length(), rr = r.length();
    if (!(pp > 0.0f && qq > 0.0f && rr > 0.0f)) return 1.0f;
    return -std::min({p.dot(q) / (pp * qq), q.dot(r) / (qq * rr), r.dot(p) / (rr * pp)});
}

class Remesher
{
public:
    Remesher(const Spline& spline, double voxel, const EdgeTarget& target,
             const std::vector<char>& kept, SurfaceVertices& vertices, const Progress& progress)
        : spline_(spline), voxel_(voxel), target_(target), vertices_(vertices),
          mesh_(vertices.mesh), progress_(progress), kept_(kept), sampler_(spline),
          field_(mesh_, target, progress),
          edges_(std::move(mesh_.triangles), mesh_.positions.size()),
          residuals_(mesh_.positions.size(), 0.0f)
    {
    }

    void run();
    double finish();

private:
    void findTips();
    void findSizes();
    void splitLong();
    void collapseShort();
    void flipEdges();
    void smooth();
    bool dropShortest();
    bool mendAngles(double angle);

    const Vec3f& at(std::uint32_t v) const { return mesh_.positions[v]; }
    float length(Id h) const { return (at(edges_.to(h)) - at(edges_.from(h))).length(); }
    float sizeOf(Id h) const { return std::min(size_[edges_.from(h)], size_[edges_.to(h)]); }
    float bend(std::uint32_t v) const
    {
        return SizeField::bend(mesh_.scalars[0].values[v], mesh_.scalars[1].values[v]);
    }
    bool movable(Id h) const { return !kept_[edges_.from(h)] && !kept_[edges_.to(h)]; }
    bool isFirst(Id h) const { return h < edges_.twin(h) && !edges_.isGone(h / 3); }

    std::vector<SurfacePoint> project(const std::vector<openvdb::Vec3s>& starts) const;
    SurfacePoint pointOf(std::uint32_t v) const;
    void set(std::uint32_t v, const SurfacePoint& p);
    void add(const SurfacePoint& p, std::uint32_t a, std::uint32_t b);
    Vec3f slid(std::uint32_t v) const;
    void takeBackFolds(const std::vector<SurfacePoint>& before, std::vector<char>& moved);
    float slackOf(std::uint32_t v) const;
    float agreementOf(const Corners& t) const;
    bool agrees(const Corners& t) const { return agreementOf(t) > steepest; }
    float worstCosine(const Corners& t) const;
    float worstAround(std::uint32_t v) const;
    float worstAfterCollapse(Id h, float longestEdge) const;
    bool isTooShort(Id h) const;
    bool fits(Id h) const;
    bool mend(std::size_t t);
    bool tryFlip(Id h);
    bool tryCollapse(Id h);
    bool tryMove(std::uint32_t v);

    const Spline& spline_;
    const double voxel_;
    const EdgeTarget target_;
    SurfaceVertices& vertices_;
    Mesh& mesh_;
    const Progress& progress_;
    std::vector<char> kept_, tips_; // of the vertices
    SplineSampler sampler_;
    const SizeField field_;
    HalfEdges edges_;
    float leastAgreement_ = steepest, leastEdge_ = 0.0f;
    std::vector<float> residuals_, size_; // of the vertices
};

/// Finds the vertices on tips that are no wider than an edge, which would get lost between others.
void Remesher::findTips()
{
    // measured: 1A8O and 4AT1, ses at 0.5 Å: without tips the new mesh lies 0.29 Å beside the old
    // one, with them 0.14 and 0.18 Å.
    constexpr float leastTurn = 2.0f;
    const std::size_t count = mesh_.positions.size();
    tips_.assign(count, 0);
    parallelFor(count, progress_, [&](std::size_t i) {
        const auto v = std::uint32_t(i);
        const float own = bend(v);
        if (kept_[v] || own * float(target_.edge) < leastTurn) return;
        bool largest = true;
        edges_.around(v, [&](Id h) {
            edges_.around(edges_.to(h), [&](Id g) {
                const std::uint32_t w = edges_.to(g);
                largest = largest && (bend(w) < own || (w >= v && bend(w) == own));
            });
        });
        tips_[v] = largest;
    });
}

/// Rounds of splits, collapses, flips and smoothing (Botsch and Kobbelt 2004), then mends of
/// angles.
void Remesher::run()
{
    // measured: 1CRN, 1A8O and 4AT1, variational and ses at 0.5 Å. Angles below 35 degrees fall
    // from 1 % after the first round to 0.04 % after the eighth; mending leaves 0.006 % of the
    // worst one. It ends by itself after two to ten rounds.
    constexpr int rounds = 8, mendings = 10, lastMendings = 5;
    constexpr double good = 38.0, acute = 28.0; // least angles that mending aims at [degree]
    findTips();
    for (int round = 0; round < rounds; ++round) {
        stopIfCancelled(progress_);
        findSizes();
        splitLong();
        collapseShort();
        flipEdges();
        smooth();
        smooth();
    }
    leastEdge_ = float(0.51 * target_.edge);
    for (int round = 0; round < mendings; ++round) {
        stopIfCancelled(progress_);
        const bool dropped = dropShortest();
        if (!mendAngles(good) && !dropped) break;
    }
    // Walls and necks that are thinner than an edge, where normals turn by more than it.
    leastAgreement_ = -1.0f;
    leastEdge_ = 0.0f;
    for (int round = 0; round < lastMendings && mendAngles(acute); ++round) {
    }
}

/// The least cosine between the normal of a triangle and those at its corners, with their slack.
float Remesher::agreementOf(const Corners& t) const
{
    const Vec3f n = (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0]));
    const float length = n.length();
    if (!(length > 0.0f)) return -1.0f;
    float least = 1.0f;
    for (const std::uint32_t v : t)
        least = std::min(least, n.dot(mesh_.normals[v]) / length + slackOf(v));
    return least;
}

/// How much farther a triangle may turn from the normal of a vertex at a ridge or a crevice that is
/// narrower than its edges.
float Remesher::slackOf(std::uint32_t v) const
{
    // measured: 4AT1, ses at 0.5 Å: without it 22 triangles keep angles below 25 degrees and edges
    // of 0.07 Å run across walls of that width; with it none.
    constexpr float most = 0.5f, atLowSlope = 0.4f, lowSlope = 0.5f, perTurn = 0.25f;
    const float turn = bend(v) * size_[v];
    const float slack = vertices_.slopes[v] < lowSlope ? atLowSlope : 0.0f;
    return std::clamp(perTurn * (turn - 1.0f), slack, most);
}

/// The cosine of the least angle; above 2 if the triangle is folded.
float Remesher::worstCosine(const Corners& t) const
{
    const float agreement = agreementOf(t);
    return agreement > leastAgreement_ ? cosineOf(at(t[0]), at(t[1]), at(t[2])) : 2.0f - agreement;
}

float Remesher::worstAround(std::uint32_t v) const
{
    float worst = -1.0f;
    edges_.around(v,
                  [&](Id h) { worst = std::max(worst, worstCosine(edges_.triangles()[h / 3])); });
    return worst;
}

/// Points moved onto S = 0, those of a leaf together; one that arrived has a small residual.
std::vector<SurfacePoint> Remesher::project(const std::vector<openvdb::Vec3s>& starts) const
{
    const std::size_t count = starts.size();
    const double h = spline_.voxelSize();
    std::vector<std::pair<std::int32_t, std::uint32_t>> order(count); // leaf, point
    parallelFor(count, progress_, [&](std::size_t i) {
        order[i] = {spline_.table().find(Coord::floor(Vec3d(starts[i]) / h)), std::uint32_t(i)};
    });
    tbb::parallel_sort(order.begin(), order.end());
    std::vector<std::size_t> begins; // of leaves
    for (std::size_t k = 0; k < count; ++k)
        if (k == 0 || order[k].first != order[k - 1].first) begins.push_back(k);
    begins.push_back(count);
    std::vector<SurfacePoint> out(count);
    parallelFor(begins.size() - 1, progress_, [&](std::size_t b) {
        const std::size_t first = begins[b], size = begins[b + 1] - first;
        Mesh mesh;
        mesh.positions.resize(size);
        for (std::size_t k = 0; k < size; ++k) mesh.positions[k] = starts[order[first + k].second];
        mesh.normals.resize(size);
        mesh.scalars.resize(2, {"", std::vector<float>(size)});
        std::vector<float> slopes(size), residuals(size);
        SurfaceVertices there{mesh, slopes};
        moveToSurface(spline_, voxel_, 0, size, there, residuals.data());
        for (std::size_t k = 0; k < size; ++k)
            out[order[first + k].second] = {
                mesh.positions[k],         mesh.normals[k],           slopes[k],
                mesh.scalars[0].values[k], mesh.scalars[1].values[k], residuals[k]};
    });
    return out;
}

SurfacePoint Remesher::pointOf(std::uint32_t v) const
{
    return {at(v),
            mesh_.normals[v],
            vertices_.slopes[v],
            mesh_.scalars[0].values[v],
            mesh_.scalars[1].values[v],
            residuals_[v]};
}

void Remesher::set(std::uint32_t v, const SurfacePoint& p)
{
    vertices_.set(v, p.position, p.normal, p.slope, p.mean, p.gauss);
    residuals_[v] = p.residual;
}

/// The target at each vertex, made to grow by 0.3 Å an Å at most by four sweeps along the edges.
void Remesher::findSizes()
{
    const std::size_t count = mesh_.positions.size();
    std::vector<float> raw(count);
    size_.resize(count);
    parallelFor(count, progress_, [&](std::size_t v) {
        raw[v] = std::min(field_.at(mesh_.positions[v]),
                          field_.of(mesh_.scalars[0].values[v], mesh_.scalars[1].values[v]));
    });
    constexpr float grading = 0.3f;
    constexpr int sweeps = 4;
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        parallelFor(count, progress_, [&](std::size_t v) {
            float size = raw[v];
            if (edges_.valence(std::uint32_t(v)) > 0) {
                edges_.around(std::uint32_t(v), [&](Id h) {
                    size = std::min(size, raw[edges_.to(h)] + grading * length(h));
                });
            }
            size_[v] = size;
        });
        raw = size_;
    }
}

/// Splits edges longer than 4/3 of the target in the middle of the arc that their normals imply,
/// moved onto S = 0.
void Remesher::splitLong()
{
    const std::size_t halves = 3 * edges_.triangles().size();
    const auto found = parallelCollect<Corners>(halves, progress_, [&](std::size_t i, auto& out) {
        const Id h = Id(i);
        if (!isFirst(h) || !movable(h) || length(h) <= longest * sizeOf(h)) return;
        out.push_back({edges_.from(h), edges_.to(h), 0});
    });
    std::vector<openvdb::Vec3s> starts(found.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        const auto [a, b, unused] = found[i];
        const Vec3f e = at(b) - at(a), &m = mesh_.normals[a], &n = mesh_.normals[b];
        starts[i] = 0.5f * (at(a) + at(b)) + 0.125f * (e.dot(n) * n - e.dot(m) * m);
    }
    const std::vector<SurfacePoint> middles = project(starts);
    for (std::size_t i = 0; i < found.size(); ++i) {
        constexpr float farthest = 0.25f; // of the edge
        const auto [a, b, unused] = found[i];
        const float most = farthest * (at(b) - at(a)).length();
        if (double(middles[i].residual) > converged * voxel_ ||
            (middles[i].position - starts[i]).length() > most)
            continue;
        const Id h = edges_.between(a, b);
        add(middles[i], a, b);
        edges_.split(h, std::uint32_t(mesh_.positions.size() - 1));
    }
}

/// Appends a vertex that lies between two others.
void Remesher::add(const SurfacePoint& p, std::uint32_t a, std::uint32_t b)
{
    mesh_.positions.emplace_back();
    mesh_.normals.emplace_back();
    vertices_.slopes.emplace_back();
    for (auto& scalar : mesh_.scalars) scalar.values.emplace_back();
    residuals_.emplace_back();
    kept_.push_back(0);
    tips_.push_back(0);
    size_.push_back(0.5f * (size_[a] + size_[b]));
    set(std::uint32_t(mesh_.positions.size() - 1), p);
}

/// The worst cosine of the triangles about from(h) once it is moved to to(h); forbidden if one has
/// an edge that is longer than so many times the target.
float Remesher::worstAfterCollapse(Id h, float longestEdge) const
{
    const std::uint32_t a = edges_.from(h), b = edges_.to(h);
    float worst = -1.0f;
    edges_.around(a, [&](Id i) {
        Corners t = edges_.triangles()[i / 3];
        if (t[0] == b || t[1] == b || t[2] == b) return;
        const std::uint32_t w = edges_.to(i);
        const float limit = longestEdge * std::min(size_[b], size_[w]);
        if ((at(w) - at(b)).lengthSqr() > limit * limit) worst = forbidden;
        std::replace(t.begin(), t.end(), a, b);
        if (worst < forbidden) worst = std::max(worst, worstCosine(t));
    });
    return worst;
}

/// Collapses edges shorter than 4/5 of the target, to the end that leaves the better angles; the
/// other end must not be a tip.
void Remesher::collapseShort()
{
    const Id halves = Id(3 * edges_.triangles().size());
    for (Id h = 0; h < halves; ++h) {
        if (!isFirst(h) || !movable(h) || length(h) >= shortest * sizeOf(h)) continue;
        if (!edges_.canCollapse(h)) continue;
        const Id g = edges_.twin(h);
        const float there = tips_[edges_.from(h)] ? forbidden : worstAfterCollapse(h, longest);
        const float back = tips_[edges_.to(h)] ? forbidden : worstAfterCollapse(g, longest);
        if (std::min(there, back) < sharpest) edges_.collapse(there <= back ? h : g);
    }
}

/// Flips edges where that brings the valences of the four vertices about them nearer to 6.
void Remesher::flipEdges()
{
    const Id halves = Id(3 * edges_.triangles().size());
    for (Id h = 0; h < halves; ++h) {
        if (!isFirst(h) || !movable(h)) continue;
        const std::uint32_t a = edges_.from(h), b = edges_.to(h), c = edges_.opposite(h),
                            d = edges_.opposite(edges_.twin(h));
        const auto off = [&](std::uint32_t v, int change) {
            return std::abs(edges_.valence(v) + change - 6);
        };
        const int gain = off(a, 0) + off(b, 0) + off(c, 0) + off(d, 0) - off(a, -1) - off(b, -1) -
                         off(c, 1) - off(d, 1);
        if (gain <= 0 || !edges_.canFlip(h)) continue;
        if (std::max(worstCosine({d, c, a}), worstCosine({c, d, b})) > sharpest) continue;
        edges_.flip(h);
    }
}

/// Where a vertex goes in its tangent plane: to the centroid of the triangles about it, weighed by
/// how large they are for their place.
Vec3f Remesher::slid(std::uint32_t v) const
{
    constexpr float farthest = 0.5f; // of the target
    Vec3f sum(0.0f);
    float weights = 0.0f;
    edges_.around(v, [&](Id h) {
        const Corners& t = edges_.triangles()[h / 3];
        const float size = size_[t[0]] + size_[t[1]] + size_[t[2]];
        const float weight =
            (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0])).length() / (size * size);
        sum += weight / 3.0f * (at(t[0]) + at(t[1]) + at(t[2]));
        weights += weight;
    });
    const Vec3f& n = mesh_.normals[v];
    Vec3f way = weights > 0.0f ? sum / weights - at(v) : Vec3f(0.0f);
    way -= way.dot(n) * n;
    const float far = way.length(), most = farthest * size_[v];
    return at(v) + (far > most ? most / far : 1.0f) * way;
}

/// Tangential smoothing: slides all vertices at once, back onto S = 0, and takes back what folds.
void Remesher::smooth()
{
    const std::size_t count = mesh_.positions.size();
    std::vector<std::uint32_t> moving;
    for (std::uint32_t v = 0; v < count; ++v)
        if (!kept_[v] && !tips_[v] && edges_.valence(v) > 0) moving.push_back(v);
    std::vector<openvdb::Vec3s> starts(moving.size());
    parallelFor(moving.size(), progress_, [&](std::size_t i) { starts[i] = slid(moving[i]); });
    const std::vector<SurfacePoint> there = project(starts);
    std::vector<SurfacePoint> before(count);
    std::vector<char> moved(count, 0);
    parallelFor(moving.size(), progress_, [&](std::size_t i) {
        constexpr float farthest = 0.5f, leastCosine = 0.3f; // of the target; between normals
        const std::uint32_t v = moving[i];
        if (double(there[i].residual) > converged * voxel_ ||
            (there[i].position - starts[i]).length() > farthest * size_[v] ||
            there[i].normal.dot(mesh_.normals[v]) < leastCosine)
            return;
        before[v] = pointOf(v);
        set(v, there[i]);
        moved[v] = 1;
    });
    takeBackFolds(before, moved);
}

/// Puts vertices back whose triangles are folded, until none is or none of theirs has moved.
void Remesher::takeBackFolds(const std::vector<SurfacePoint>& before, std::vector<char>& moved)
{
    for (;;) {
        const auto folded = parallelCollect<std::uint32_t>(
            edges_.triangles().size(), progress_, [&](std::size_t t, auto& out) {
                const Corners& c = edges_.triangles()[t];
                if (edges_.isGone(t) || !(moved[c[0]] || moved[c[1]] || moved[c[2]])) return;
                if (!agrees(c)) out.push_back(std::uint32_t(t));
            });
        if (folded.empty()) return;
        for (const std::uint32_t t : folded) {
            for (const std::uint32_t v : edges_.triangles()[t]) {
                if (!moved[v]) continue;
                moved[v] = 0;
                set(v, before[v]);
            }
        }
    }
}

bool Remesher::isTooShort(Id h) const
{
    constexpr float least = 0.75f; // of the target at its place
    return length(h) <= std::min(leastEdge_, least * sizeOf(h));
}

/// Whether an edge has a length that it may end with.
bool Remesher::fits(Id h) const
{
    return !isTooShort(h) && length(h) < longestMended * sizeOf(h);
}

bool Remesher::tryFlip(Id h)
{
    if (!edges_.canFlip(h)) return false;
    const std::uint32_t a = edges_.from(h), b = edges_.to(h), c = edges_.opposite(h),
                        d = edges_.opposite(edges_.twin(h));
    const float before = std::max(worstCosine({a, b, c}), worstCosine({b, a, d}));
    const float after = std::max(worstCosine({d, c, a}), worstCosine({c, d, b}));
    if (after >= before - leastGain ||
        (at(c) - at(d)).length() > longestMended * std::min(size_[c], size_[d]))
        return false;
    edges_.flip(h);
    return true;
}

bool Remesher::tryCollapse(Id h)
{
    if (!edges_.canCollapse(h)) return false;
    const float before = std::max(worstAround(edges_.from(h)), worstAround(edges_.to(h)));
    const Id g = edges_.twin(h);
    const float there = worstAfterCollapse(h, longestMended),
                back = worstAfterCollapse(g, longestMended);
    if (std::min(there, back) >= before - leastGain) return false;
    edges_.collapse(there <= back ? h : g);
    return true;
}

/// Collapses edges that must not stay as short as they are, if no angle becomes acute by that.
/// @return whether any went
bool Remesher::dropShortest()
{
    const float acute = float(std::cos(30.0 * M_PI / 180.0));
    const auto found = parallelCollect<Id>(3 * edges_.triangles().size(), progress_,
                                           [&](std::size_t i, auto& out) {
                                               const Id h = Id(i);
                                               if (isFirst(h) && movable(h) && isTooShort(h))
                                                   out.push_back(h);
                                           });
    bool any = false;
    for (const Id h : found) {
        if (!isFirst(h) || !isTooShort(h) || !edges_.canCollapse(h)) continue;
        const Id g = edges_.twin(h);
        const float there = worstAfterCollapse(h, longestMended),
                    back = worstAfterCollapse(g, longestMended);
        if (std::min(there, back) > acute) continue;
        edges_.collapse(there <= back ? h : g);
        any = true;
    }
    return any;
}

/// Pattern search: moves a vertex along the surface in six directions, with steps that halve, while
/// the least angle about it grows.
bool Remesher::tryMove(std::uint32_t v)
{
    constexpr double first = 0.24, last = 0.03; // of the target
    constexpr int directions = 6;
    float least = worstAround(v);
    bool any = false;
    const auto [u, w] = perpendicular(Vec3d(mesh_.normals[v]));
    for (double step = first; step >= last; step *= 0.5) {
        for (int k = 0; k < directions; ++k) {
            const double angle = k * 2.0 * M_PI / directions + step;
            const SurfacePoint before = pointOf(v);
            Vec3d x = Vec3d(at(v)) +
                      step * double(size_[v]) * (std::cos(angle) * u + std::sin(angle) * w);
            Jet jet;
            if (!moveToSurface(sampler_, voxel_, 1.0, x, jet)) continue;
            vertices_.set(v, x, jet);
            residuals_[v] = float(std::abs(jet.value));
            bool fitting = true;
            edges_.around(v, [&](Id h) { fitting = fitting && fits(h); });
            const float worst = worstAround(v);
            if (fitting && worst < least - leastGain) {
                least = worst;
                any = true;
            } else {
                set(v, before);
            }
        }
    }
    return any;
}

/// Turns the edges of a triangle, or collapses its shortest one, or moves its corners, if its
/// surroundings get better.
bool Remesher::mend(std::size_t t)
{
    bool any = false;
    for (int k = 0; k < 3 && !edges_.isGone(t); ++k) any = tryFlip(Id(3 * t) + Id(k)) || any;
    if (any || edges_.isGone(t)) return any;
    Id least = Id(3 * t);
    for (Id h = least; h < Id(3 * t + 3); ++h)
        if (length(h) < length(least)) least = h;
    if (tryCollapse(least)) return true;
    const Corners corners = edges_.triangles()[t];
    for (const std::uint32_t v : corners) any = tryMove(v) || any;
    return any;
}

/// Tries to mend each triangle that has an angle below this one [degree].
/// @return whether any changed
bool Remesher::mendAngles(double angle)
{
    const float bad = float(std::cos(angle * M_PI / 180.0));
    const auto found = parallelCollect<std::uint32_t>(
        edges_.triangles().size(), progress_, [&](std::size_t t, auto& out) {
            const Corners& c = edges_.triangles()[t];
            if (edges_.isGone(t) || kept_[c[0]] || kept_[c[1]] || kept_[c[2]]) return;
            if (worstCosine(edges_.triangles()[t]) > bad) out.push_back(std::uint32_t(t));
        });
    bool any = false;
    for (const std::uint32_t t : found)
        if (!edges_.isGone(t) && worstCosine(edges_.triangles()[t]) > bad) any = mend(t) || any;
    return any;
}

/// Numbers what is left: vertices by the leaf that they lie in, triangles by their first vertex.
/// @return the largest |S| at a vertex that is new [Å]
double Remesher::finish()
{
    double largest = 0.0;
    std::vector<std::pair<std::int32_t, std::uint32_t>> order;
    for (std::uint32_t v = 0; v < edges_.vertices(); ++v) {
        if (edges_.valence(v) == 0) continue;
        order.push_back(
            {spline_.table().find(Coord::floor(Vec3d(at(v)) / spline_.voxelSize())), v});
        largest = std::max(largest, double(residuals_[v]));
    }
    std::sort(order.begin(), order.end());
    std::vector<std::uint32_t> number(edges_.vertices(), 0);
    Mesh out;
    out.scalars = {{mesh_.scalars[0].name, {}}, {mesh_.scalars[1].name, {}}};
    std::vector<float> slopes;
    for (const auto& [leaf, v] : order) {
        number[v] = std::uint32_t(out.positions.size());
        out.positions.push_back(at(v));
        out.normals.push_back(mesh_.normals[v]);
        for (int k = 0; k < 2; ++k) out.scalars[k].values.push_back(mesh_.scalars[k].values[v]);
        slopes.push_back(vertices_.slopes[v]);
    }
    for (std::size_t t = 0; t < edges_.triangles().size(); ++t) {
        if (edges_.isGone(t)) continue;
        Corners c = edges_.triangles()[t];
        for (std::uint32_t& v : c) v = number[v];
        std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
        out.triangles.push_back(c);
    }
    std::sort(out.triangles.begin(), out.triangles.end());
    mesh_ = std::move(out);
    vertices_.slopes = std::move(slopes);
    return largest;
}

} // namespace

double remesh(const Spline& spline, double voxel, const EdgeTarget& target,
              const std::vector<char>& kept, SurfaceVertices& vertices, const Progress& progress)
{
    Remesher remesher(spline, voxel, target, kept, vertices, progress);
    remesher.run();
    return remesher.finish();
}

} // namespace molsurf
