// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/boundary_measure.h"

#include "molsurf/error.h"
#include "molsurf/kernel/balls/ball_caps.h"
#include "molsurf/kernel/core/disjoint_sets.h"
#include "molsurf/kernel/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <string>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

/// An arc as seen from one of its two spheres.
struct Side {
    std::uint32_t arc;
    std::int32_t other; // ball on the other side
    double sign;        // +1: the arc's axis points away from the sphere's centre to the other ball
};

/// The sides of a patch.
struct Sides {
    const Side *first, *last;

    std::size_t size() const { return std::size_t(last - first); }
    bool empty() const { return first == last; }
    const Side& operator[](std::size_t s) const { return first[s]; }
};

/// A connected part of a patch.
struct Face {
    double area = 0.0;
    Vec3d normal = Vec3d(0.0); // integrated
    int loops = 0;
    std::vector<std::uint32_t> arcs;
};

/// The cap of a patch in another ball.
Cap capOf(const BallBoundary& boundary, const Patch& patch, std::int32_t other)
{
    return meetingCap(boundary.balls[std::size_t(patch.ball)], boundary.balls[std::size_t(other)],
                      other);
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

[[noreturn]] void disagree(const char* what)
{
    throw Error(ErrorKind::Check, std::string("boundary: ") + what);
}

/// Union-find of the arcs of a sphere by the corners where they meet: the number of each
/// one's loop.
std::vector<std::uint32_t> findLoops(const BallBoundary& boundary, const Sides& sides,
                                     std::size_t& count)
{
    struct End {
        CornerName corner;
        std::uint32_t side;
    };
    thread_local std::vector<End> ends;
    ends.clear();
    for (std::size_t s = 0; s < sides.size(); ++s) {
        const Arc& arc = boundary.arcs[sides[s].arc];
        for (int e = 0; e < 2 && arc.ends[e] >= 0; ++e)
            ends.push_back({cornerAt(arc, e), std::uint32_t(s)});
    }
    std::sort(ends.begin(), ends.end(),
              [](const End& a, const End& b) { return a.corner < b.corner; });
    DisjointSets sets(sides.size());
    for (std::size_t i = 0; i < ends.size(); i += 2) {
        if (i + 1 == ends.size() || !(ends[i].corner == ends[i + 1].corner))
            disagree("two arcs of a sphere do not meet in a corner");
        sets.join(ends[i].side, ends[i + 1].side);
    }
    return sets.numbers(count);
}

/// For each loop of a sphere the number of the face that it bounds.
std::vector<std::size_t> findFaces(const BallBoundary& boundary, const Patch& patch,
                                   const Sides& sides, const std::vector<std::uint32_t>& loop,
                                   std::size_t loops)
{
    std::vector<std::size_t> face(loops);
    std::iota(face.begin(), face.end(), 0u);
    if (loops == 1) return face;

    std::vector<Cap> caps;
    for (std::uint32_t k = patch.capsBegin; k < patch.capsEnd; ++k)
        caps.push_back(capOf(boundary, patch, boundary.capOthers[k]));
    DisjointSets sets(caps.size());
    for (std::uint32_t i = 0; i < caps.size(); ++i) {
        for (std::uint32_t j = 0; j < i; ++j) {
            if (sets.find(i) != sets.find(j) && capsOverlap(boundary, patch, caps[i], caps[j]))
                sets.join(i, j);
        }
    }
    std::size_t clusterCount = 0;
    const std::vector<std::uint32_t> clusters = sets.numbers(clusterCount);
    std::vector<std::size_t> clusterOf(loops); // the cluster of caps that a loop bounds
    std::vector<Vec3d> sample(loops);
    std::vector<double> longest(loops, 0.0);
    for (std::size_t s = 0; s < sides.size(); ++s) {
        const auto cap = std::find_if(caps.begin(), caps.end(),
                                      [&](const Cap& c) { return c.other == sides[s].other; });
        const Arc& arc = boundary.arcs[sides[s].arc];
        clusterOf[loop[s]] = clusters[std::size_t(cap - caps.begin())];
        if (arc.half * arc.radius <= longest[loop[s]]) continue;
        longest[loop[s]] = arc.half * arc.radius;
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
    // A cluster with one loop about it has but one side.
    std::vector<std::size_t> loopsOf(clusterCount, 0);
    for (const std::size_t cluster : clusterOf) ++loopsOf[cluster];
    std::map<std::vector<std::size_t>, std::size_t> faceOn; // by the sides
    for (std::size_t l = 0; l < loops; ++l) {
        std::vector<std::size_t> sidesOf;
        for (std::size_t cluster = 0; cluster < clusterCount; ++cluster) {
            if (loopsOf[cluster] > 1) sidesOf.push_back(sideOf(cluster, l));
        }
        face[l] = faceOn.emplace(std::move(sidesOf), l).first->second;
    }
    // Faces and clusters are the nodes of a tree, the loops between them its edges.
    if (faceOn.size() + clusterCount != loops + 1) disagree("faces of a sphere and their loops");
    return face;
}

/// The faces of a patch with their areas and integrated normals; measureBoundary() has formulas.
std::vector<Face> findFaces(const BallBoundary& boundary, const Patch& patch, const Sides& sides)
{
    const double R = patch.radius;
    if (sides.empty()) {
        Face whole;
        whole.area = 4.0 * M_PI * R * R;
        return {whole};
    }
    std::size_t loops = 0;
    const std::vector<std::uint32_t> loop = findLoops(boundary, sides, loops);
    const std::vector<std::size_t> faceOf = findFaces(boundary, patch, sides, loop, loops);
    std::vector<Face> byLoop(loops);
    for (std::size_t l = 0; l < loops; ++l) ++byLoop[faceOf[l]].loops;
    if (loops == 1) byLoop[0].arcs.reserve(sides.size());
    for (std::size_t s = 0; s < sides.size(); ++s) {
        const Arc& arc = boundary.arcs[sides[s].arc];
        const Cap cap = capOf(boundary, patch, sides[s].other);
        Face& face = byLoop[faceOf[loop[s]]];
        face.arcs.push_back(sides[s].arc);
        const double angle = 2.0 * arc.half, c = std::cos(arc.half), sine = std::sin(arc.half);
        const Vec3d across = arc.axis.cross(arc.middle);
        const Vec3d ends[2] = {c * arc.middle + -sine * across, c * arc.middle + sine * across};
        face.area += angle * cap.cosine;
        for (int e = 0; e < 2; ++e) {
            if (arc.ends[e] < sides[s].other) continue; // none, or the other arc there counts it
            const Cap next = capOf(boundary, patch, arc.ends[e]);
            const Vec3d u = (arc.centre + arc.radius * ends[e] - patch.centre) / R;
            const Vec3d a = u.cross(cap.axis), b = u.cross(next.axis);
            face.area -= std::atan2(a.cross(b).length(), a.dot(b)); // the exterior angle
        }
        // 1/2 of the integral of x cross dx, the face on the left: clockwise about the cap's axis
        const Vec3d m = arc.centre - patch.centre;
        // From the first end to the last about the arc's own axis.
        const Vec3d chord = 2.0 * sine * across;
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

/// Tells outer pieces from cavities, and leaves the smallest of these out. The outer one encloses
/// all cavities of its component, so its volume is larger than theirs; the sign of a volume alone
/// would be that of rounding where the piece is tiny.
/// @return the new number of each piece; -1: it is left out
std::vector<std::int32_t> findOuter(std::vector<BoundaryPiece>& pieces)
{
    constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> largest;
    for (std::size_t n = 0; n < pieces.size(); ++n) {
        const BoundaryPiece& piece = pieces[n];
        if (piece.component < 0) continue;
        const auto c = std::size_t(piece.component);
        if (c >= largest.size()) largest.resize(c + 1, none);
        if (largest[c] == none || std::abs(piece.volume) > std::abs(pieces[largest[c]].volume))
            largest[c] = n;
    }
    for (std::size_t n = 0; n < pieces.size(); ++n) {
        BoundaryPiece& piece = pieces[n];
        piece.outer =
            piece.component < 0 ? piece.volume > 0.0 : largest[std::size_t(piece.component)] == n;
    }
    std::vector<std::int32_t> numbers;
    std::size_t kept = 0;
    for (const BoundaryPiece& piece : pieces) {
        const bool keep = piece.outer || !(piece.area < leastCavity);
        numbers.push_back(keep ? std::int32_t(kept) : -1);
        if (keep) pieces[kept++] = piece;
    }
    pieces.resize(kept);
    return numbers;
}

/// The sides of arcs that bound each patch, one patch after the other.
struct SideLists {
    std::vector<Side> sides;
    std::vector<std::uint32_t> begins; // of each patch, and the end of all

    /// Sorts the two sides of each arc by their patches (counting sort).
    explicit SideLists(const BallBoundary& boundary) : begins(boundary.patches.size() + 1)
    {
        std::vector<std::uint32_t> patchOf(boundary.balls.size());
        for (std::size_t p = 0; p < boundary.patches.size(); ++p)
            patchOf[std::size_t(boundary.patches[p].ball)] = std::uint32_t(p);
        for (const Arc& arc : boundary.arcs) {
            for (const std::int32_t ball : arc.balls) ++begins[patchOf[std::size_t(ball)] + 1];
        }
        std::partial_sum(begins.begin(), begins.end(), begins.begin());
        sides.resize(begins.back());
        std::vector<std::uint32_t> next(begins.begin(), begins.end() - 1);
        for (std::size_t a = 0; a < boundary.arcs.size(); ++a) {
            const std::int32_t* balls = boundary.arcs[a].balls;
            for (int k = 0; k < 2; ++k) {
                sides[next[patchOf[std::size_t(balls[k])]]++] = {std::uint32_t(a), balls[1 - k],
                                                                 k == 0 ? 1.0 : -1.0};
            }
        }
    }
};

/// Joins the faces on both sides of every arc.
/// @param[in] begins  number of the first face of each patch, and that of all faces
DisjointSets joinedFaces(const std::vector<std::vector<Face>>& faces,
                         const std::vector<std::size_t>& begins, std::size_t arcs)
{
    DisjointSets joined(begins.back());
    constexpr std::size_t none = ~std::size_t(0);
    std::vector<std::size_t> faceOfArc(arcs, none);
    for (std::size_t p = 0; p < faces.size(); ++p) {
        for (std::size_t f = 0; f < faces[p].size(); ++f) {
            for (const std::uint32_t arc : faces[p][f].arcs) {
                if (faceOfArc[arc] == none) faceOfArc[arc] = begins[p] + f;
                joined.join(std::uint32_t(faceOfArc[arc]), std::uint32_t(begins[p] + f));
            }
        }
    }
    return joined;
}

/// Adds a face of a patch, and sets it and its piece for its arcs.
void addFace(const BallBoundary& boundary, std::uint32_t patch, const Face& face,
             std::int32_t piece, BoundaryMeasure& out)
{
    for (const std::uint32_t arc : face.arcs) {
        const bool first = boundary.arcs[arc].balls[0] == boundary.patches[patch].ball;
        out.arcPieces[arc] = piece;
        out.arcFaces[arc][first ? 0 : 1] = std::uint32_t(out.faces.size());
    }
    out.faces.push_back({patch, piece, face.area, face.normal, 2 - face.loops});
}

} // namespace

BoundaryMeasure measureBoundary(const BallBoundary& boundary, const Progress& progress)
{
    BoundaryMeasure out;
    const std::size_t patches = boundary.patches.size();
    if (patches == 0) return out;
    const SideLists lists(boundary);
    std::vector<std::vector<Face>> faces(patches);
    parallelFor(patches, progress, [&](std::size_t p) {
        const Side* sides = lists.sides.data();
        faces[p] = findFaces(boundary, boundary.patches[p],
                             {sides + lists.begins[p], sides + lists.begins[p + 1]});
    });
    std::vector<std::size_t> begins(patches + 1, 0);
    for (std::size_t p = 0; p < patches; ++p) begins[p + 1] = begins[p] + faces[p].size();
    DisjointSets joined = joinedFaces(faces, begins, boundary.arcs.size());

    std::vector<std::size_t> number(begins.back());
    std::vector<Vec3d> origin; // of each piece, so that volumes do not cancel far from 0
    std::vector<double> euler;
    std::vector<Vec3d> normal; // integrated
    out.arcPieces.assign(boundary.arcs.size(), -1);
    out.arcFaces.assign(boundary.arcs.size(), {});
    for (std::size_t p = 0; p < patches; ++p) {
        const Patch& patch = boundary.patches[p];
        out.patchAreas.push_back(0.0);
        for (std::size_t f = 0; f < faces[p].size(); ++f) {
            const std::size_t root = joined.find(std::uint32_t(begins[p] + f));
            if (root == begins[p] + f) {
                number[root] = out.pieces.size();
                out.pieces.emplace_back();
                out.pieces.back().component = patch.component;
                origin.push_back(patch.centre);
                euler.push_back(0.0);
                normal.emplace_back(0.0);
            }
            const Face& face = faces[p][f];
            const std::size_t n = number[root];
            addFace(boundary, std::uint32_t(p), face, std::int32_t(n), out);
            out.pieces[n].area += face.area;
            out.pieces[n].volume +=
                (patch.radius * face.area + (patch.centre - origin[n]).dot(face.normal)) / 3.0;
            normal[n] += face.normal;
            out.patchAreas[p] += face.area;
            // Faces, less arcs, plus corners, of which each ends three arcs: an arc with ends
            // counts -1 + 2/3, half of that for the face on either side.
            double openSides = 0.0;
            for (const std::uint32_t arc : face.arcs) openSides += boundary.arcs[arc].ends[0] >= 0;
            euler[n] += 2.0 - face.loops - openSides / 6.0;
        }
    }
    for (std::size_t n = 0; n < euler.size(); ++n) {
        BoundaryPiece& piece = out.pieces[n];
        piece.eulerCharacteristic = int(std::lround(euler[n]));
        // The integrated normal of a closed surface is zero.
        constexpr double open = 1e-6, rounding = 1e-9; // of the area, and [Å^2]
        if (!(normal[n].length() <= open * piece.area + rounding))
            disagree("a piece is not closed");
    }
    const std::vector<std::int32_t> renumbered = findOuter(out.pieces);
    for (BoundaryFace& face : out.faces) face.piece = renumbered[std::size_t(face.piece)];
    for (std::int32_t& piece : out.arcPieces) piece = renumbered[std::size_t(piece)];
    return out;
}

std::vector<double> areasOfBalls(const BallBoundary& boundary, const BoundaryMeasure& measure,
                                 std::size_t count)
{
    std::vector<double> areas(count, 0.0);
    for (std::size_t p = 0; p < boundary.patches.size(); ++p) {
        const PlacedBall& ball = boundary.balls[std::size_t(boundary.patches[p].ball)];
        areas[std::size_t(ball.index)] += measure.patchAreas[p];
    }
    return areas;
}

std::vector<std::int32_t> cornerPieces(const BallBoundary& boundary, const BoundaryMeasure& measure)
{
    // An arc with a later ball at an end has put the corner there into the list.
    std::vector<std::int32_t> out;
    for (std::size_t a = 0; a < boundary.arcs.size(); ++a) {
        const Arc& arc = boundary.arcs[a];
        for (int e = 0; e < 2 && arc.ends[e] >= 0; ++e)
            if (arc.ends[e] > arc.balls[1]) out.push_back(measure.arcPieces[a]);
    }
    return out;
}

} // namespace molsurf
