// SPDX-License-Identifier: MPL-2.0
#include "molsurf/rasterize/boundary_measure.h"

#include "molsurf/core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

/// Disjoint sets of indices.
class Sets
{
public:
    explicit Sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }
    std::size_t find(std::size_t i)
    {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    /// The lower root stays.
    void join(std::size_t a, std::size_t b)
    {
        a = find(a);
        b = find(b);
        parent_[std::max(a, b)] = std::uint32_t(std::min(a, b));
    }

private:
    std::vector<std::uint32_t> parent_;
};

/// An arc as seen from one of its two spheres.
struct Side {
    std::uint32_t arc;
    std::int32_t other; // ball on the other side
    double sign;        // +1: the arc's axis points away from the sphere's centre to the other ball
};

/// A connected part of a patch.
struct Face {
    double area = 0.0;
    Vec3d normal = Vec3d(0.0); // integrated
    int loops = 0;
    std::vector<std::uint32_t> arcs;
};

const Cap& capOf(const BallBoundary& boundary, const Patch& patch, std::int32_t other)
{
    std::uint32_t k = patch.capsBegin;
    while (k + 1 < patch.capsEnd && boundary.caps[k].other != other) ++k;
    return boundary.caps[k];
}

bool overlap(const Cap& a, const Cap& b)
{
    const double sines = std::sqrt((1.0 - a.cosine * a.cosine) * (1.0 - b.cosine * b.cosine));
    if (a.cosine <= -b.cosine) return true; // the half angles add up to pi or more
    return a.axis.dot(b.axis) > a.cosine * b.cosine - sines;
}

double distance2(const Arc& arc, const Vec3d& x)
{
    const Vec3d w = x - arc.centre;
    const double along = w.dot(arc.axis);
    const double r = std::sqrt(std::max(0.0, w.lengthSqr() - along * along));
    if (arc.ends[0] < 0 || w.dot(arc.middle) >= std::cos(arc.half) * r) {
        return along * along + (r - arc.radius) * (r - arc.radius);
    }
    return std::min((w - arc.radius * arc.end(0)).lengthSqr(),
                    (w - arc.radius * arc.end(1)).lengthSqr());
}

/// The loops that the arcs of a sphere form: for each arc the number of its loop.
std::vector<std::size_t> findLoops(const BallBoundary& boundary, const std::vector<Side>& sides,
                                   std::size_t& count)
{
    struct End {
        std::int32_t low, high; // the two other balls of the corner
        std::size_t side;
        Vec3d position;
    };
    std::vector<End> ends;
    for (std::size_t s = 0; s < sides.size(); ++s) {
        const Arc& arc = boundary.arcs[sides[s].arc];
        for (int e = 0; e < 2 && arc.ends[e] >= 0; ++e) {
            const auto [low, high] = std::minmax(sides[s].other, arc.ends[e]);
            ends.push_back({low, high, s, arc.centre + arc.radius * arc.end(e)});
        }
    }
    std::sort(ends.begin(), ends.end(), [](const End& a, const End& b) {
        return std::tie(a.low, a.high, a.side) < std::tie(b.low, b.high, b.side);
    });
    Sets joined(sides.size());
    for (std::size_t i = 0; i < ends.size(); ++i) {
        // Three spheres meet in at most two points, so the same three may come twice.
        std::size_t nearest = i;
        double least = 1e300;
        const auto look = [&](std::size_t k) {
            const double d2 = (ends[k].position - ends[i].position).lengthSqr();
            if (ends[k].side != ends[i].side && d2 < least) {
                least = d2;
                nearest = k;
            }
        };
        for (std::size_t k = i;
             k-- > 0 && ends[k].low == ends[i].low && ends[k].high == ends[i].high;)
            look(k);
        for (std::size_t k = i + 1;
             k < ends.size() && ends[k].low == ends[i].low && ends[k].high == ends[i].high; ++k)
            look(k);
        joined.join(ends[i].side, ends[nearest].side);
    }
    std::vector<std::size_t> loop(sides.size()), number(sides.size());
    count = 0;
    for (std::size_t s = 0; s < sides.size(); ++s) {
        if (joined.find(s) == s) number[s] = count++;
        loop[s] = number[joined.find(s)];
    }
    return loop;
}

/// For each loop of a sphere the number of the face that it bounds.
std::vector<std::size_t> findFaces(const BallBoundary& boundary, const Patch& patch,
                                   const std::vector<Side>& sides,
                                   const std::vector<std::size_t>& loop, std::size_t loops)
{
    std::vector<std::size_t> face(loops);
    std::iota(face.begin(), face.end(), 0u);
    if (loops == 1) return face;

    const std::size_t caps = patch.capsEnd - patch.capsBegin;
    Sets clusters(caps);
    for (std::size_t i = 0; i < caps; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const Cap &a = boundary.caps[patch.capsBegin + i],
                      &b = boundary.caps[patch.capsBegin + j];
            if (clusters.find(i) != clusters.find(j) && overlap(a, b)) clusters.join(i, j);
        }
    }
    std::vector<std::size_t> clusterOf(loops); // the cluster of caps that a loop bounds
    std::vector<Vec3d> sample(loops);
    for (std::size_t s = 0; s < sides.size(); ++s) {
        const Cap& cap = capOf(boundary, patch, sides[s].other);
        const Arc& arc = boundary.arcs[sides[s].arc];
        clusterOf[loop[s]] = clusters.find(std::size_t(&cap - &boundary.caps[patch.capsBegin]));
        sample[loop[s]] = arc.centre + arc.radius * arc.middle;
    }
    // The side of a cluster that a loop lies on is named by the cluster's loop nearest to it.
    const auto sideOf = [&](std::size_t cluster, std::size_t l) {
        if (clusterOf[l] == cluster) return l;
        std::size_t found = l;
        double least = 1e300;
        for (std::size_t s = 0; s < sides.size(); ++s) {
            if (clusterOf[loop[s]] != cluster) continue;
            const double d2 = distance2(boundary.arcs[sides[s].arc], sample[l]);
            if (d2 < least) {
                least = d2;
                found = loop[s];
            }
        }
        return found;
    };
    for (std::size_t l = 1; l < loops; ++l) {
        for (std::size_t other = 0; other < l && face[l] == l; ++other) {
            bool same = true;
            for (std::size_t k = 0; k < loops && same; ++k) {
                same = sideOf(clusterOf[k], l) == sideOf(clusterOf[k], other);
            }
            if (same) face[l] = face[other];
        }
    }
    return face;
}

/// The faces of a patch, without their loops' shares.
std::vector<Face> findFaces(const BallBoundary& boundary, const Patch& patch,
                            const std::vector<Side>& sides)
{
    const double R = patch.radius;
    if (sides.empty()) {
        Face whole;
        whole.area = 4.0 * M_PI * R * R;
        return {whole};
    }
    std::size_t loops = 0;
    const std::vector<std::size_t> loop = findLoops(boundary, sides, loops);
    const std::vector<std::size_t> faceOf = findFaces(boundary, patch, sides, loop, loops);
    std::vector<Face> byLoop(loops);
    for (std::size_t l = 0; l < loops; ++l) ++byLoop[faceOf[l]].loops;
    for (std::size_t s = 0; s < sides.size(); ++s) {
        const Arc& arc = boundary.arcs[sides[s].arc];
        const Cap& cap = capOf(boundary, patch, sides[s].other);
        Face& face = byLoop[faceOf[loop[s]]];
        face.arcs.push_back(sides[s].arc);
        const double angle = 2.0 * arc.half;
        face.area += angle * cap.cosine;
        for (int e = 0; e < 2 && arc.ends[e] >= 0; ++e) {
            const Cap& next = capOf(boundary, patch, arc.ends[e]);
            const Vec3d u = (arc.centre + arc.radius * arc.end(e) - patch.centre) / R;
            const Vec3d a = u.cross(cap.axis), b = u.cross(next.axis);
            const double exterior = std::atan2(a.cross(b).length(), a.dot(b));
            face.area -= 0.5 * exterior; // the other half comes with the next arc
        }
        // 1/2 of the integral of x cross dx, the face on the left: clockwise about the cap's axis
        const Vec3d m = arc.centre - patch.centre;
        const Vec3d chord = arc.end(1) - arc.end(0); // about the arc's own axis
        face.normal -= 0.5 * sides[s].sign * arc.radius * m.cross(chord) +
                       0.5 * arc.radius * arc.radius * angle * cap.axis;
    }
    std::vector<Face> faces;
    for (Face& face : byLoop) {
        if (face.loops == 0) continue;
        face.area = R * R * (2.0 * M_PI * (2 - face.loops) + face.area);
        faces.push_back(std::move(face));
    }
    return faces;
}

} // namespace

BoundaryMeasure measureBoundary(const BallBoundary& boundary, const Progress& progress)
{
    BoundaryMeasure out;
    const std::size_t patches = boundary.patches.size();
    if (patches == 0) return out;
    std::vector<std::uint32_t> patchOf(std::size_t(boundary.patches.back().ball) + 1);
    for (std::size_t p = 0; p < patches; ++p) patchOf[boundary.patches[p].ball] = std::uint32_t(p);
    std::vector<std::vector<Side>> sides(patches);
    for (std::size_t a = 0; a < boundary.arcs.size(); ++a) {
        const Arc& arc = boundary.arcs[a];
        sides[patchOf[arc.balls[0]]].push_back({std::uint32_t(a), arc.balls[1], 1.0});
        sides[patchOf[arc.balls[1]]].push_back({std::uint32_t(a), arc.balls[0], -1.0});
    }
    std::vector<std::vector<Face>> faces(patches);
    parallelFor(patches, progress, [&](std::size_t p) {
        faces[p] = findFaces(boundary, boundary.patches[p], sides[p]);
    });

    std::vector<std::size_t> begins(patches + 1, 0);
    for (std::size_t p = 0; p < patches; ++p) begins[p + 1] = begins[p] + faces[p].size();
    Sets joined(begins.back());
    constexpr std::size_t none = ~std::size_t(0);
    std::vector<std::size_t> faceOfArc(boundary.arcs.size(), none);
    for (std::size_t p = 0; p < patches; ++p) {
        for (std::size_t f = 0; f < faces[p].size(); ++f) {
            for (const std::uint32_t arc : faces[p][f].arcs) {
                if (faceOfArc[arc] == none) faceOfArc[arc] = begins[p] + f;
                joined.join(faceOfArc[arc], begins[p] + f);
            }
        }
    }

    const Vec3d origin = boundary.patches[0].centre; // so that volumes do not cancel far from 0
    std::vector<std::size_t> number(begins.back());
    std::vector<double> euler;
    for (std::size_t p = 0; p < patches; ++p) {
        const Patch& patch = boundary.patches[p];
        out.patchAreas.push_back(0.0);
        for (std::size_t f = 0; f < faces[p].size(); ++f) {
            const std::size_t root = joined.find(begins[p] + f);
            if (root == begins[p] + f) {
                number[root] = out.pieces.size();
                out.pieces.emplace_back();
                euler.push_back(0.0);
            }
            const Face& face = faces[p][f];
            BoundaryPiece& piece = out.pieces[number[root]];
            piece.area += face.area;
            piece.volume +=
                (patch.radius * face.area + (patch.centre - origin).dot(face.normal)) / 3.0;
            out.patchAreas[p] += face.area;
            // Faces, less arcs, plus corners, of which each ends three arcs.
            double openSides = 0.0;
            for (const std::uint32_t arc : face.arcs) openSides += boundary.arcs[arc].ends[0] >= 0;
            euler[number[root]] += 2.0 - face.loops - openSides / 6.0;
        }
    }
    for (std::size_t i = 0; i < euler.size(); ++i) {
        out.pieces[i].eulerCharacteristic = int(std::lround(euler[i]));
    }
    return out;
}

} // namespace molsurf
