// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/sphere_region.h"

#include "molsurf/kernel/core/spherical_area.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

/// The rim of a cap: the points cosine axis + sine (cos a e1 + sin a e2).
struct Rim {
    Vec3d axis, e1, e2;
    double cosine, sine;

    explicit Rim(const SphereCap& cap)
        : axis(cap.axis), cosine(cap.cosine),
          sine(std::sqrt((1.0 - cap.cosine) * (1.0 + cap.cosine)))
    {
        const Vec3d a(std::abs(axis.x()), std::abs(axis.y()), std::abs(axis.z()));
        const Vec3d least = a.x() <= a.y() && a.x() <= a.z() ? Vec3d(1, 0, 0)
                            : a.y() <= a.z()                 ? Vec3d(0, 1, 0)
                                                             : Vec3d(0, 0, 1);
        e1 = axis.cross(least);
        e1.normalize();
        e2 = axis.cross(e1);
    }
    double angleOf(const Vec3d& u) const { return std::atan2(u.dot(e2), u.dot(e1)); }
    Vec3d at(double angle) const
    {
        return cosine * axis + sine * (std::cos(angle) * e1 + std::sin(angle) * e2);
    }
};

/// The two points in which the rims of caps of nearly one plane meet, on either side of the way
/// from the first axis to the second one. Where they lie along a rim is ill-conditioned, and what
/// one rim gains the other one has to lose: both take these very points.
/// @param[out] points  to the right and to the left, seen from outside along that way
/// @return whether they meet
bool findCrossings(const SphereCap& first, const SphereCap& second, Vec3d points[2])
{
    // A plane is the same with its axis and cosine turned over.
    const double sign = first.axis.dot(second.axis) < 0.0 ? -1.0 : 1.0;
    const Vec3d way = sign * second.axis - first.axis;
    Vec3d tangent = way - way.dot(first.axis) * first.axis;
    const double sine = tangent.length();
    tangent /= sine;
    // u = cosine axis + along tangent + across (axis x tangent) with u.(second axis) = its cosine.
    const double along =
        (sign * second.cosine - first.cosine + 0.5 * first.cosine * way.lengthSqr()) / sine;
    const double across2 = (1.0 - first.cosine) * (1.0 + first.cosine) - along * along;
    if (!(across2 > 0.0)) return false;
    const Vec3d middle = first.cosine * first.axis + along * tangent;
    const Vec3d across = std::sqrt(across2) * first.axis.cross(tangent);
    points[0] = middle - across;
    points[1] = middle + across;
    return true;
}

/// Adds the free parts of the rim of a cap, by a sweep over the angles that other caps cover, by
/// their begins in [0, 2 pi). It begins 2 pi before the last of their ends.
void addRimArcs(const std::vector<SphereCap>& caps, int own, RegionScratch& scratch,
                std::vector<RimArc>& arcs)
{
    const Rim rim(caps[std::size_t(own)]);
    auto& covers = scratch.covers;
    covers.clear();
    for (int k = 0; k < int(caps.size()); ++k) {
        if (k == own) continue;
        const SphereCap& cap = caps[std::size_t(k)];
        const double x = cap.axis.dot(rim.e1), y = cap.axis.dot(rim.e2);
        const double facing = cap.axis.dot(rim.axis), sine2 = x * x + y * y;
        const double cosine = (cap.cosine - rim.cosine * facing) / (rim.sine * std::sqrt(sine2));
        if (cosine >= 1.0) continue;
        if (!(cosine > -1.0)) return; // covered, or the rim of a complement
        double half = std::acos(cosine), begin = std::atan2(y, x) - half;
        constexpr double nearlyOne = 1e-4; // angle between planes
        const SphereCap &first = caps[std::size_t(std::min(own, k))],
                        &second = caps[std::size_t(std::max(own, k))];
        Vec3d points[2];
        if (sine2 < nearlyOne * nearlyOne && findCrossings(first, second, points)) {
            const bool turned = (own < k) == (facing < 0.0);
            begin = rim.angleOf(points[turned ? 1 : 0]);
            const double end = rim.angleOf(points[turned ? 0 : 1]);
            half = 0.5 * (end < begin ? end - begin + 2.0 * M_PI : end - begin);
        }
        if (begin < 0.0) begin += 2.0 * M_PI;
        covers.push_back({begin, begin + 2.0 * half, k});
    }
    const auto add = [&](double from, double to, int before, int after) {
        arcs.push_back({own, before, after, rim.at(from), rim.at(0.5 * (from + to)), rim.at(to),
                        to - from, -1});
    };
    if (covers.empty()) return add(0.0, 2.0 * M_PI, -1, -1);
    std::sort(covers.begin(), covers.end(), [](const auto& a, const auto& b) {
        return a.begin != b.begin ? a.begin < b.begin : a.cap < b.cap;
    });
    const auto last = std::max_element(covers.begin(), covers.end(),
                                       [](const auto& a, const auto& b) { return a.end < b.end; });
    double covered = last->end - 2.0 * M_PI;
    int before = last->cap;
    for (const auto& cover : covers) {
        if (cover.begin > covered) add(covered, cover.begin, before, cover.cap);
        if (cover.end <= covered) continue;
        covered = cover.end;
        before = cover.cap;
    }
}

/// The signed area that an arc and the great circles from its ends to a point enclose: triangles to
/// the chords, which are great circles, and the segments between chords and arc.
double fan(const RimArc& arc, const SphereCap& cap, const Vec3d& point)
{
    constexpr double longest = 2.0; // where a chord is still on the same side as its arc
    const int parts = std::max(1, int(std::ceil(arc.angle / longest)));
    const double angle = arc.angle / parts, c = cap.cosine;
    const Rim rim(cap);
    const double start = std::atan2(arc.begin.dot(rim.e2), arc.begin.dot(rim.e1));
    // Between the arc and its chord: a sector of the cap less the triangle from its axis.
    double area =
        parts * (angle * (1.0 - c) - 2.0 * std::atan2((1.0 - c) * std::sin(angle),
                                                      (1.0 + c) + (1.0 - c) * std::cos(angle)));
    Vec3d from = arc.begin;
    for (int k = 1; k <= parts; ++k) {
        const Vec3d to = k == parts ? arc.end : rim.at(start + k * angle);
        area += sphericalArea(point, from, to);
        from = to;
    }
    return area;
}

/// The angle by which a loop turns from one rim to another at a direction.
double turn(const Vec3d& u, const Vec3d& axis, const Vec3d& next)
{
    const Vec3d a = u.cross(axis), b = u.cross(next);
    return std::atan2(a.cross(b).length(), a.dot(b));
}

/// Numbers the loops that arcs form. An arc that ends where a cap begins is followed by the one of
/// this cap that begins where the own one ends.
/// @return how many there are; -1: arcs do not meet
int followArcs(std::vector<int>& next, std::vector<RimArc>& arcs)
{
    next.assign(arcs.size(), -1);
    bool meet = true;
    for (std::size_t a = 0; a < arcs.size(); ++a) {
        if (arcs[a].after < 0) continue;
        const auto follows = [&](const RimArc& o) {
            return o.cap == arcs[a].after && o.before == arcs[a].cap;
        };
        const auto found = std::find_if(arcs.begin(), arcs.end(), follows);
        meet = meet && found != arcs.end();
        next[a] = found == arcs.end() ? -1 : int(found - arcs.begin());
    }
    int loops = 0;
    for (std::size_t a = 0; a < arcs.size(); ++a) {
        if (arcs[a].loop >= 0) continue;
        int at = int(a);
        while (at >= 0 && arcs[std::size_t(at)].loop < 0) {
            arcs[std::size_t(at)].loop = loops;
            at = next[std::size_t(at)];
        }
        meet = meet && (at < 0 || at == int(a));
        ++loops;
    }
    return meet ? loops : -1;
}

/// Whether a loop holds a direction, by the even-odd rule: the great circle from there to `far`,
/// which lies outside of all loops, crosses it an odd number of times.
bool holds(const std::vector<SphereCap>& caps, const std::vector<RimArc>& arcs, int loop,
           const Vec3d& direction, const Vec3d& far)
{
    Vec3d side = far - far.dot(direction) * direction;
    side.normalize();
    const double whole = std::atan2(far.dot(side), far.dot(direction));
    bool odd = false;
    for (const RimArc& arc : arcs) {
        if (arc.loop != loop) continue;
        const SphereCap& cap = caps[std::size_t(arc.cap)];
        const double x = cap.axis.dot(direction), y = cap.axis.dot(side);
        const double cosine = cap.cosine / std::sqrt(x * x + y * y);
        if (!(std::abs(cosine) < 1.0)) continue;
        const Vec3d middle = arc.middle - cap.cosine * cap.axis;
        for (const double sign : {-1.0, 1.0}) {
            double t = std::atan2(y, x) + sign * std::acos(cosine);
            if (t < 0.0) t += 2.0 * M_PI;
            if (t > 2.0 * M_PI) t -= 2.0 * M_PI;
            if (t >= whole) continue;
            const Vec3d u = std::cos(t) * direction + std::sin(t) * side - cap.cosine * cap.axis;
            const double away = std::atan2(u.cross(middle).length(), u.dot(middle));
            if (away < 0.5 * arc.angle) odd = !odd;
        }
    }
    return odd;
}

/// Joins loops to faces: each one that is anticlockwise (area > 0) bounds a face of its own, each
/// other one is a hole of the smallest that holds it, or of the sphere where none does. A region
/// without loops is the whole sphere, one face.
/// @param[in] inside  a direction whose opposite lies outside of all loops
void gatherFaces(const std::vector<SphereCap>& caps, const Vec3d& inside,
                 const std::vector<RegionFace>& loops, SphereRegion& region)
{
    std::vector<int> outer;
    region.faceOf.assign(loops.size(), 0);
    for (std::size_t l = 0; l < loops.size(); ++l) {
        if (loops[l].area <= 0.0) continue;
        region.faceOf[l] = int(outer.size());
        outer.push_back(int(l));
    }
    for (std::size_t l = 0; l < loops.size() && outer.size() > 1; ++l) {
        if (loops[l].area > 0.0) continue;
        const auto any = std::find_if(region.arcs.begin(), region.arcs.end(),
                                      [&](const RimArc& arc) { return arc.loop == int(l); });
        double least = 0.0; // the smallest of nested ones
        for (const int o : outer) {
            const double area = loops[std::size_t(o)].area;
            if (least > 0.0 && area >= least) continue;
            if (!holds(caps, region.arcs, o, any->middle, -inside)) continue;
            least = area;
            region.faceOf[l] = region.faceOf[std::size_t(o)];
        }
    }
    region.faces.assign(std::max<std::size_t>(outer.size(), 1), RegionFace());
    for (std::size_t l = 0; l < loops.size(); ++l) {
        RegionFace& face = region.faces[std::size_t(region.faceOf[l])];
        face.area += loops[l].area;
        face.normal += loops[l].normal;
        --face.characteristic;
    }
}

} // namespace

void findRegion(const std::vector<SphereCap>& caps, const Vec3d& inside, RegionScratch& scratch,
                SphereRegion& region)
{
    region.arcs.clear();
    region.faces.clear();
    region.faceOf.clear();
    region.area = region.mismatch = 0.0;
    for (int k = 0; k < int(caps.size()); ++k) addRimArcs(caps, k, scratch, region.arcs);
    if (region.arcs.empty()) return;

    const int loops = followArcs(scratch.next, region.arcs);
    int count = 0;
    for (const RimArc& arc : region.arcs) count = std::max(count, arc.loop + 1);
    scratch.loops.assign(std::size_t(count), RegionFace());
    double turned = 0.0;
    for (const RimArc& arc : region.arcs) {
        const SphereCap& cap = caps[std::size_t(arc.cap)];
        RegionFace& loop = scratch.loops[std::size_t(arc.loop)];
        const double area = fan(arc, cap, inside);
        loop.area -= area; // the face is on the right
        // 1/2 of the integral of u cross du
        loop.normal -= 0.5 * (cap.cosine * cap.axis.cross(arc.end - arc.begin) +
                              (1.0 - cap.cosine) * (1.0 + cap.cosine) * arc.angle * cap.axis);
        region.area -= area;
        turned -= arc.angle * cap.cosine;
        if (arc.after >= 0) turned += turn(arc.end, cap.axis, caps[std::size_t(arc.after)].axis);
    }
    gatherFaces(caps, inside, scratch.loops, region);
    int characteristic = 0;
    for (const RegionFace& face : region.faces) characteristic += face.characteristic;
    region.mismatch =
        loops < 0 ? 2.0 * M_PI : std::abs(region.area + turned - 2.0 * M_PI * characteristic);
}

double regionArea(const std::vector<SphereCap>& caps, const Vec3d& inside, RegionScratch& scratch)
{
    scratch.arcs.clear();
    for (int k = 0; k < int(caps.size()); ++k) addRimArcs(caps, k, scratch, scratch.arcs);
    double area = 0.0;
    for (const RimArc& arc : scratch.arcs) area -= fan(arc, caps[std::size_t(arc.cap)], inside);
    return area;
}

} // namespace molsurf
