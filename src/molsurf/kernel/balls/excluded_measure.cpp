// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/excluded_measure.h"

#include "molsurf/error.h"
#include "molsurf/kernel/balls/probe_corners.h"
#include "molsurf/kernel/balls/sphere_region.h"
#include "molsurf/kernel/balls/toric_tube.h"
#include "molsurf/kernel/core/disjoint_sets.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/core/strings.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

/// Area and normal that a part of the surface adds to its piece.
struct Part {
    double area = 0.0;
    Vec3d normal = Vec3d(0.0); // integrated, outward
    Vec3d place = Vec3d(0.0);  // a point near it
    double flux = 0.0;         // integral of (x - place).n
    double euler = 0.0;        // its face, less half of the edges, with its share of the vertices
};

/// An edge between two concave faces, as it is seen from one of them.
struct Crease {
    std::uint32_t other; // corner
    Vec3d middle;        // relative to the own corner [Å]
    bool whole;          // a circle
    std::uint32_t face;  // of the own corner
};

/// The part of a probe's sphere at a corner.
struct ConcavePart {
    std::vector<Part> faces;
    std::vector<Crease> creases;
    std::vector<std::pair<std::int32_t, double>> shares; // balls, and their areas [Å^2]
    /// The faces at the sides, at the end towards each ball: side k at its first ball, and at its
    /// second one. -1: there is none.
    int sideFaces[3][2] = {{-1, -1}, {-1, -1}, {-1, -1}};
    double creaseLength = 0.0; // [Å]
    Vec3d edge = Vec3d(0.0);   // ConcavePull::edge
    bool fits = true;
};

[[noreturn]] void failSurface(const char* what, double one, double other)
{
    throw Error(ErrorKind::Check,
                formatted("surface: %s: %.8g and %.8g disagree", what, one, other));
}

/// The part of the torus between two angles f: the points x = centre + (rho - p cos f) e +
/// p sin f axis, with directions e from -half to half. There the element of area is
/// p (rho - p cos f), the normal n = cos f e - sin f axis, and (x - centre).n = rho cos f - p.
Part toricPart(const Arc& arc, double probe, double from, double to)
{
    const double p = probe, rho = arc.radius, width = to - from, angle = 2.0 * arc.half;
    // The integrals of cos f, sin f, sin f cos f and cos^2 f.
    const double sines = std::sin(to) - std::sin(from), cosines = std::cos(from) - std::cos(to);
    const double squares = 0.5 * (std::sin(to) - std::sin(from)) * (std::sin(to) + std::sin(from));
    const double twice =
        0.5 * (width + std::sin(to) * std::cos(to) - std::sin(from) * std::cos(from));
    Part part;
    part.area = areaOf(arc, p, from, to);
    part.place = arc.centre;
    part.normal = 2.0 * std::sin(arc.half) * p * (rho * sines - p * twice) * arc.middle -
                  angle * p * (rho * cosines - p * squares) * arc.axis;
    part.flux = angle * p * ((rho * rho + p * p) * sines - p * rho * width - p * rho * twice);
    return part;
}

/// The share of a ball among areas along an arc: those between two angles, less the cusp.
double shareOf(const Arc& arc, const Tube& tube, double probe, double from, double to)
{
    double area = areaOf(arc, probe, from, to);
    const double begin = std::clamp(-tube.cusp, from, to), end = std::clamp(tube.cusp, from, to);
    if (tube.isCut()) area -= areaOf(arc, probe, begin, end);
    return area;
}

/// Room for one corner, kept from corner to corner by a thread.
struct CornerScratch {
    std::vector<SphereCap> caps, shared;
    std::vector<std::uint32_t> others; // of the caps after the first three, the corners
    std::vector<std::uint8_t> used;
    std::vector<std::int32_t> touched; // balls
    RegionScratch room;
    SphereRegion region;
};

/// A cone of directions.
struct Cone {
    Vec3d axis;    // unit vector
    double cosine; // of its half angle, >= 0
};

/// The smallest cone about three directions, which lie in a hemisphere.
/// @param[in] inward  a direction of this hemisphere
Cone coneAbout(const Vec3d* directions, const Vec3d& inward)
{
    for (int k = 0; k < 3; ++k) { // about two of them
        const Vec3d &a = directions[k], &b = directions[(k + 1) % 3];
        Vec3d middle = a + b;
        middle.normalize();
        const double cosine = middle.dot(a);
        if (middle.dot(directions[(k + 2) % 3]) >= cosine) return {middle, std::max(cosine, 0.0)};
    }
    Vec3d axis = (directions[1] - directions[0]).cross(directions[2] - directions[0]);
    axis.normalize();
    if (axis.dot(inward) < 0.0) axis = -axis;
    return {axis, std::max(axis.dot(directions[0]), 0.0)};
}

/// The triangle of directions from a corner to its three balls: what is outside of its sides are
/// three caps.
/// @return the cone about it
Cone triangleCaps(const BallBoundary& boundary, const ProbeCorner& corner,
                  std::vector<SphereCap>& caps)
{
    Vec3d inward(0.0), directions[3];
    caps.clear();
    for (int side = 0; side < 3; ++side) {
        const Arc& arc = boundary.arcs[corner.arcs[side]];
        const int end = corner.ends[side];
        // Along the circle, into the third ball.
        Vec3d normal = arc.axis.cross(arc.end(end)) * (end == 1 ? 1.0 : -1.0);
        normal.normalize();
        caps.push_back({-normal, 0.0});
        inward += normal;
        directions[side] =
            boundary.balls[std::size_t(corner.name.balls[side])].centre() - corner.position;
        directions[side].normalize();
    }
    return coneAbout(directions, inward);
}

/// Whether a corner cuts nothing that a nearer one on the same circle leaves: of the corners on the
/// circle of a side the one beyond the covered part is the nearest, seen from the axis.
bool isBehindPartner(const ProbeCorner& corner, const ProbeCorner& other, std::uint32_t number)
{
    for (int side = 0; side < 3; ++side) {
        const std::int32_t a = corner.name.balls[side], b = corner.name.balls[(side + 1) % 3];
        const auto& balls = other.name.balls;
        if (std::count(balls, balls + 3, a) + std::count(balls, balls + 3, b) == 2 &&
            corner.partners[side] != std::int32_t(number))
            return true;
    }
    return false;
}

/// Adds the caps of the corner's sphere that are nearer to other corners, if they meet the cone.
void addCutters(const ProbeCorners& corners, std::size_t c, double probe, const Cone& cone,
                CornerScratch& s)
{
    const double sine = std::sqrt((1.0 - cone.cosine) * (1.0 + cone.cosine));
    constexpr double slack = 1e-9;
    s.others.clear();
    corners.forEachNear(c, 2.0 * probe, [&](std::size_t o, const Vec3d& way) {
        const double length = way.length();
        const double h = length / (2.0 * probe);
        if (!(length > 0.0) || !(h < 1.0)) return;
        const Vec3d axis = way / length;
        if (axis.dot(cone.axis) < h * cone.cosine - std::sqrt(1.0 - h * h) * sine - slack) return;
        if (isBehindPartner(corners[c], corners[o], std::uint32_t(o))) return;
        constexpr double same = 1e-13;
        for (const SphereCap& cap : s.caps)
            if ((cap.axis - axis).lengthSqr() < same * same && std::abs(cap.cosine - h) < same)
                return;
        s.caps.push_back({axis, h});
        s.others.push_back(std::uint32_t(o));
    });
}

/// Finds the balls that a probe touches at a corner, to 0.01 Å: more than three in symmetric
/// molecules, where several corners are about in one place. Of very many the own three.
void findTouched(const ProbeCorners& corners, std::size_t c, CornerScratch& s)
{
    constexpr double together = 0.01; // [Å]
    constexpr std::size_t most = 32;
    const auto& own = corners[c].name.balls;
    s.touched.assign(own, own + 3);
    corners.forEachNear(c, together, [&](std::size_t o, const Vec3d&) {
        for (const std::int32_t ball : corners[o].name.balls)
            if (std::find(s.touched.begin(), s.touched.end(), ball) == s.touched.end())
                s.touched.push_back(ball);
    });
    if (s.touched.size() > most) s.touched.resize(3);
}

/// Divides the region by the power diagram of the balls that the probe touches: a ball gets the
/// area with the least |x - x_i|^2 - r_i^2, the rest being in caps of the other balls.
void shareRegion(const BallBoundary& boundary, const Vec3d& place, double probe,
                 const Vec3d& inside, CornerScratch& s, ConcavePart& part)
{
    s.used.assign(s.caps.size(), 0);
    for (const RimArc& arc : s.region.arcs) s.used[std::size_t(arc.cap)] = 1;
    s.shared.clear();
    for (std::size_t k = 0; k < s.caps.size(); ++k)
        if (k < 3 || s.used[k]) s.shared.push_back(s.caps[k]);
    const std::size_t own = s.shared.size();
    const auto ballAt = [&](std::int32_t k) -> const PlacedBall& {
        return boundary.balls[std::size_t(k)];
    };
    const auto powerOf = [&](const PlacedBall& ball) {
        const double r = ball.radius - probe;
        return (ball.centre() - place).lengthSqr() - r * r;
    };
    for (const std::int32_t k : s.touched) {
        s.shared.resize(own);
        const double power = powerOf(ballAt(k));
        bool none = false;
        for (const std::int32_t o : s.touched) {
            if (o == k) continue;
            const Vec3d way = offset(ballAt(k), ballAt(o));
            const double d = way.length();
            const double cosine = (powerOf(ballAt(o)) - power) / (2.0 * probe * d);
            none = none || cosine <= -1.0;
            if (cosine < 1.0) s.shared.push_back({way / d, cosine});
        }
        if (none) continue;
        part.shares.emplace_back(k, regionArea(s.shared, inside, s.room) * probe * probe);
    }
}

/// Adds the edges and vertices about the faces of a corner. To the Euler number of a face an edge
/// counts -1/2, since two faces meet there, and a vertex 1 over the number of faces about it. A
/// crease ends at a side only in a cusp, which addTori() counts in full.
/// @param[in] arcs  rims of the caps of `s`: the three sides first, then those of other corners
void describeEdges(const std::vector<RimArc>& arcs, const CornerScratch& s, double probe,
                   ConcavePart& part)
{
    for (const RimArc& arc : arcs) {
        const int face = s.region.faceOf[std::size_t(arc.loop)];
        Part& own = part.faces[std::size_t(face)];
        if (arc.cap >= 3) {
            part.creases.push_back({s.others[std::size_t(arc.cap - 3)], probe * arc.middle,
                                    arc.after < 0, std::uint32_t(face)});
            const double h = s.caps[std::size_t(arc.cap)].cosine;
            part.creaseLength += probe * arc.angle * std::sqrt((1.0 - h) * (1.0 + h));
            // n = -(h axis + sqrt(1 - h^2) e), and tan(phi/2) = h/sqrt(1 - h^2).
            const Vec3d& axis = s.caps[std::size_t(arc.cap)].axis;
            const Vec3d across = 2.0 * std::sin(0.5 * arc.angle) * (arc.middle - h * axis);
            part.edge -= probe * h * (arc.angle * h * axis + across);
            if (arc.after < 0) continue; // a whole circle has neither begin nor end
            own.euler -= 0.5;
            if (arc.after >= 3) own.euler += 1.0 / 3.0; // a point of three probes
            continue;
        }
        own.euler -= 0.5;
        if (arc.after < 0) {
            part.fits = false;
            continue;
        }
        if (arc.after < 3) own.euler += 0.25; // of a ball: contact, concave, 2 toric faces
        // Neighbouring sides share a ball: 0 and 1 the ball 1, 1 and 2 the ball 2, 2 and 0 the
        // ball 0, which is the first of side 0 and the second of side 2.
        for (const int next : {arc.before, arc.after}) {
            if (next >= 3) continue;
            const int which = next == (arc.cap + 1) % 3 ? 1 : 0;
            part.sideFaces[arc.cap][which] = face;
        }
    }
}

/// The part of a probe's sphere at a corner that is a face of the surface.
ConcavePart concavePart(const BallBoundary& boundary, const ProbeCorners& corners, std::size_t c,
                        double probe, bool shares, CornerScratch& s)
{
    ConcavePart part;
    const ProbeCorner& corner = corners[c];
    const Cone cone = triangleCaps(boundary, corner, s.caps);
    addCutters(corners, c, probe, cone, s);
    findRegion(s.caps, cone.axis, s.room, s.region);
    constexpr double wrong = 1e-6; // [sr]
    part.fits = s.region.mismatch < wrong;
    for (const RegionFace& face : s.region.faces) {
        Part out;
        out.area = probe * probe * face.area;
        out.normal = -probe * probe * face.normal;
        out.place = corner.position;
        out.flux = -probe * out.area;
        out.euler = face.characteristic;
        part.faces.push_back(out);
    }
    describeEdges(s.region.arcs, s, probe, part);
    if (!shares) return part;
    findTouched(corners, c, s);
    shareRegion(boundary, corner.position, probe, cone.axis, s, part);
    return part;
}

/// All parts of a surface: contact faces, then two for each arc (towards its first ball, and its
/// second one; the second is empty if the torus is whole), then the faces of the corners.
struct Parts {
    std::vector<Part> parts;
    std::size_t toric = 0;              // the first of arcs
    std::vector<std::uint32_t> concave; // the first of each corner, and the end
    std::vector<ConcavePart> corners;
    std::vector<Tube> tubes; // of arcs
    bool fits = true;
};

/// Adds the contact faces: the faces of the accessible surface, drawn in by the probe.
void addContacts(const BallBoundary& boundary, const BoundaryMeasure& measure, double probe,
                 Parts& all, ExcludedMeasure& out)
{
    for (const BoundaryFace& face : measure.faces) {
        Part part;
        if (face.piece >= 0) {
            const Patch& patch = boundary.patches[face.patch];
            const double r = patch.radius - probe, scale = (r / patch.radius) * (r / patch.radius);
            part.area = scale * face.area;
            part.normal = scale * face.normal;
            part.place = patch.centre;
            part.flux = r * part.area;
            part.euler = face.characteristic;
            if (!out.areas.empty()) out.areas[std::size_t(patch.ball)] += part.area;
            out.areasByCentre[std::size_t(face.piece)].contact += part.area;
        }
        all.parts.push_back(part);
    }
}

/// Adds the toric faces of all arcs. One that is not cut by its axis has an Euler number of 0 with
/// its share of edges and vertices: a band, or a rectangle, 1 - 4/2 + 4/4.
void addTori(const BallBoundary& boundary, const BoundaryMeasure& measure, double probe, Parts& all,
             ExcludedMeasure& out)
{
    all.toric = all.parts.size();
    all.parts.resize(all.toric + 2 * boundary.arcs.size());
    all.tubes.resize(boundary.arcs.size());
    for (std::size_t a = 0; a < boundary.arcs.size(); ++a) {
        if (measure.arcPieces[a] < 0) continue;
        const Arc& arc = boundary.arcs[a];
        const Tube tube = all.tubes[a] = tubeOf(boundary, arc, probe);
        const bool open = arc.ends[0] >= 0;
        Part& low = all.parts[all.toric + 2 * a];
        Part& high = all.parts[all.toric + 2 * a + 1];
        if (tube.isCut()) {
            low = toricPart(arc, probe, tube.low, -tube.cusp);
            high = toricPart(arc, probe, tube.cusp, tube.high);
            // A disk about the cusp, or a sector with three edges and two points on a ball.
            low.euler = high.euler = open ? 0.0 : 1.0;
        } else {
            low = toricPart(arc, probe, tube.low, tube.high);
        }
        out.areasByCentre[std::size_t(measure.arcPieces[a])].toric += low.area + high.area;
        if (!out.areas.empty()) {
            out.areas[std::size_t(arc.balls[0])] +=
                shareOf(arc, tube, probe, tube.low, tube.middle);
            out.areas[std::size_t(arc.balls[1])] +=
                shareOf(arc, tube, probe, tube.middle, tube.high);
        }
        if (!open) continue;
        for (const std::uint32_t face : measure.arcFaces[a])
            all.parts[face].euler += 0.25 - 0.5; // an edge, and its points on the ball
    }
    // The two cusps of a circle are vertices that all of its arcs share.
    for (std::size_t a = 0; a < boundary.arcs.size();) {
        std::size_t end = a, open = 0;
        for (; end < boundary.arcs.size(); ++end) {
            const std::int32_t* balls = boundary.arcs[end].balls;
            if (!std::equal(balls, balls + 2, boundary.arcs[a].balls)) break;
            open += all.tubes[end].isCut() && boundary.arcs[end].ends[0] >= 0;
        }
        for (; a < end; ++a) {
            if (!all.tubes[a].isCut() || boundary.arcs[a].ends[0] < 0) continue;
            for (std::size_t half = 0; half < 2; ++half)
                all.parts[all.toric + 2 * a + half].euler += 1.0 / double(open);
        }
    }
}

/// Adds the concave faces, parts of probes at rest on three balls, and checks their areas.
void addConcave(const BallBoundary& boundary, const ProbeCorners& corners, double probe,
                const Progress& progress, Parts& all, ExcludedMeasure& out)
{
    all.corners.resize(corners.size());
    tbb::enumerable_thread_specific<CornerScratch> scratches;
    const bool shares = !out.areas.empty();
    parallelFor(corners.size(), progress, [&](std::size_t c) {
        all.corners[c] = concavePart(boundary, corners, c, probe, shares, scratches.local());
    });
    for (std::size_t c = 0; c < corners.size(); ++c) {
        const ConcavePart& part = all.corners[c];
        all.concave.push_back(std::uint32_t(all.parts.size()));
        all.fits = all.fits && part.fits;
        out.creaseLength += 0.5 * part.creaseLength; // seen from both sides
        double area = 0.0, shared = 0.0;
        ConcavePull pull{{}, corners[c].position, Vec3d(0.0), part.edge};
        std::copy_n(corners[c].name.balls, 3, pull.balls);
        for (const Part& face : part.faces) {
            all.parts.push_back(face);
            area += face.area;
            pull.normal += face.normal;
        }
        out.pulls.push_back(pull);
        for (const auto& [ball, share] : part.shares) {
            out.areas[std::size_t(ball)] += share;
            shared += share;
        }
        constexpr double wrong = 1e-6; // of a probe's surface
        if (shares && !(std::abs(area - shared) <= wrong * probe * probe))
            failSurface("area of a concave face and of its parts", area, shared);
        if (!(area >= -wrong * probe * probe) || !(area <= (2.0 * M_PI + wrong) * probe * probe))
            failSurface("area of a concave face and half a sphere", area,
                        2.0 * M_PI * probe * probe);
    }
    all.concave.push_back(std::uint32_t(all.parts.size()));
}

/// Shares the areas of concave faces out among the pieces on which their probes lie.
void addByCentre(const BoundaryMeasure& measure, const ProbeCorners& corners, const Parts& all,
                 ExcludedMeasure& out)
{
    for (std::size_t c = 0; c < corners.size(); ++c) {
        const std::int32_t piece = measure.arcPieces[corners[c].arcs[0]];
        for (std::size_t p = all.concave[c]; p < all.concave[c + 1]; ++p)
            out.areasByCentre[std::size_t(piece)].concave += all.parts[p].area;
    }
}

/// The face of another corner beyond a crease; -1: there is none.
std::int64_t beyond(const ProbeCorners& corners, const Parts& all, std::size_t c,
                    const Crease& crease)
{
    constexpr double apart = 1e-5; // [Å]
    const Vec3d way = corners[crease.other].position - corners[c].position;
    double least = apart * apart;
    std::int64_t found = -1;
    for (const Crease& o : all.corners[crease.other].creases) {
        if (o.other != c || o.whole != crease.whole) continue;
        const double d2 = o.whole ? 0.0 : (way + o.middle - crease.middle).lengthSqr();
        if (d2 >= least) continue;
        least = d2;
        found = all.concave[crease.other] + o.face;
    }
    return found;
}

/// Joins parts that have an edge in common; where an edge is not found, all that it may join.
void joinParts(const BallBoundary& boundary, const BoundaryMeasure& measure,
               const ProbeCorners& corners, Parts& all, DisjointSets& joined)
{
    const auto join = [&](std::size_t a, std::size_t b) {
        joined.join(std::uint32_t(a), std::uint32_t(b));
    };
    const auto joinAll = [&](std::size_t part, std::size_t corner) {
        for (std::size_t n = all.concave[corner]; n < all.concave[corner + 1]; ++n) join(part, n);
        all.fits = false;
    };
    for (std::size_t a = 0; a < boundary.arcs.size(); ++a) {
        if (measure.arcPieces[a] < 0) continue;
        const std::size_t low = all.toric + 2 * a;
        if (!all.tubes[a].isCut()) join(low, low + 1);
        join(measure.arcFaces[a][0], low);
        join(measure.arcFaces[a][1], low + 1);
    }
    for (std::size_t c = 0; c < corners.size(); ++c) {
        for (int side = 0; side < 3; ++side) {
            for (int which = 0; which < 2; ++which) {
                const int face = all.corners[c].sideFaces[side][which];
                // Side 2 goes from the third ball to the first.
                const int half = side == 2 ? 1 - which : which;
                const std::size_t tube = all.toric + 2 * corners[c].arcs[side] + std::size_t(half);
                if (face < 0) {
                    joinAll(tube, c);
                } else {
                    join(tube, all.concave[c] + std::size_t(face));
                }
            }
        }
        for (const Crease& crease : all.corners[c].creases) {
            const std::size_t own = all.concave[c] + crease.face;
            const std::int64_t other = beyond(corners, all, c, crease);
            if (other < 0) {
                joinAll(own, crease.other);
            } else {
                join(own, std::size_t(other));
            }
        }
    }
}

/// Adds up parts to pieces.
/// @return whether these can be closed surfaces, by their Euler numbers
bool addUp(const Parts& all, DisjointSets& joined, std::vector<BoundaryPiece>& pieces)
{
    std::size_t count = 0;
    const std::vector<std::uint32_t> pieceOf = joined.numbers(count);
    std::vector<Part> sums(count);
    std::vector<std::uint8_t> begun(count, 0);
    Part whole;
    for (std::size_t n = 0; n < all.parts.size(); ++n) {
        const Part& part = all.parts[n];
        Part& sum = sums[pieceOf[n]];
        if (!begun[pieceOf[n]]) sum.place = part.place;
        begun[pieceOf[n]] = 1;
        sum.area += part.area;
        sum.normal += part.normal;
        sum.flux += part.flux + (part.place - sum.place).dot(part.normal);
        sum.euler += part.euler;
        whole.area += part.area;
        whole.normal += part.normal;
    }
    // The integrated normal of a closed surface is zero.
    constexpr double open = 1e-8, rounding = 1e-3; // of the area, and [Å^2]
    if (!(whole.normal.length() <= open * whole.area + rounding))
        failSurface("integrated normal and 0", whole.normal.length(), 0.0);
    bool right = true;
    for (const Part& sum : sums) {
        if (sum.area == 0.0) continue; // of what is left out
        BoundaryPiece piece;
        piece.area = sum.area;
        piece.volume = sum.flux / 3.0;
        piece.eulerCharacteristic = 2 * int(std::lround(0.5 * std::min(sum.euler, 2.0)));
        piece.outer = piece.volume > 0.0;
        constexpr double inexact = 1e-6;
        right = right && std::abs(sum.euler - piece.eulerCharacteristic) < inexact;
        pieces.push_back(piece);
    }
    return right;
}

} // namespace

ExcludedAreas ExcludedMeasure::totalAreas() const
{
    ExcludedAreas total;
    for (const ExcludedAreas& part : areasByCentre) {
        total.contact += part.contact;
        total.toric += part.toric;
        total.concave += part.concave;
    }
    return total;
}

ExcludedMeasure measureExcluded(const BallBoundary& boundary, const BoundaryMeasure& measure,
                                double probe, bool shares, const Progress& progress)
{
    ExcludedMeasure out;
    if (shares) out.areas.assign(boundary.balls.size(), 0.0);
    out.areasByCentre.resize(measure.pieces.size());
    if (measure.pieces.empty()) return out;
    const ProbeCorners corners(boundary, measure, progress);
    Parts all;
    addContacts(boundary, measure, probe, all, out);
    addTori(boundary, measure, probe, all, out);
    addConcave(boundary, corners, probe, progress, all, out);
    addByCentre(measure, corners, all, out);
    DisjointSets joined(all.parts.size());
    joinParts(boundary, measure, corners, all, joined);
    out.topologyKnown = addUp(all, joined, out.pieces) && all.fits;
    return out;
}

std::vector<double> areasOfBalls(const BallBoundary& boundary, const ExcludedMeasure& measure,
                                 std::size_t count)
{
    std::vector<double> areas(count, 0.0);
    for (std::size_t n = 0; n < boundary.balls.size(); ++n)
        areas[std::size_t(boundary.balls[n].index)] = measure.areas[n];
    return areas;
}

} // namespace molsurf
