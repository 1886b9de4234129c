// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/levelset/part_tables.h"

#include "molsurf/kernel/core/parallel.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

using openvdb::Vec3d;

void PartTable::make(std::size_t size, int count, const Progress& progress,
                     const std::function<void(std::size_t)>& set)
{
    const std::size_t padded = (size + BoxTree::group - 1) / BoxTree::group * BoxTree::group;
    for (int n = PartRadius; n < count; ++n) list.numbers[std::size_t(n)].resize(padded);
    for (auto& coordinates : place) coordinates.resize(padded);
    list.part.resize(padded);
    list.size = int(size);
    regions.resize(size);
    parallelFor(size, progress, set);
    tree_.emplace(regions);
    regions = std::vector<Box>();
}

namespace
{

/// A ball about the points within `depth` of the apex of a cone.
/// @param[in] axis    unit vector
/// @param[in] cosine  of half the angle of the cone, any
struct Enclosing {
    Vec3d centre;
    double radius;

    Enclosing(const Vec3d& apex, const Vec3d& axis, double cosine, double depth)
    {
        if (cosine <= 0.1) { // hardly less than the ball about the apex
            centre = apex;
            radius = depth;
        } else if (cosine * cosine > 0.5) { // through the apex and the rim
            radius = 0.5 * depth / cosine;
            centre = apex + radius * axis;
        } else {
            radius = depth * std::sqrt(1.0 - cosine * cosine);
            centre = apex + depth * cosine * axis;
        }
    }
};

double sineOf(double cosine)
{
    return std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
}

/// The cone of directions from the centre of a patch that holds its free part.
struct FreeCone {
    Vec3d axis = Vec3d(0.0);
    double cosine = 1.0; // of half its angle
};

/// The least cosine between a unit vector and the directions from the centre of a sphere to an arc
/// on it: the least of base + a cos t + b sin t for |t| <= arc.half, over the sphere's radius.
double leastCosine(const Arc& arc, const Vec3d& centre, double radius, const Vec3d& axis)
{
    const double base = axis.dot(arc.centre - centre);
    const double a = arc.radius * axis.dot(arc.middle);
    const double b = arc.radius * axis.dot(arc.axis.cross(arc.middle));
    const double most = std::hypot(a, b), cosine = std::cos(arc.half);
    const bool opposite = -a >= cosine * most; // the arc holds the direction opposite to the axis
    return (base - (opposite ? most : std::abs(b) * std::sin(arc.half) - a * cosine)) / radius;
}

/// The cones about the free parts of all patches. A cone holds all arcs of its patch, so the rest
/// of the sphere is covered or free as a whole: the direction opposite to the axis decides. Where
/// it is free, the cone is the whole sphere.
std::vector<FreeCone> freeCones(const BallBoundary& boundary)
{
    constexpr double rounding = double(cosineRounding);
    const std::vector<Patch>& patches = boundary.patches;
    std::vector<std::uint32_t> patchOf(boundary.balls.size());
    for (std::size_t p = 0; p < patches.size(); ++p)
        patchOf[std::size_t(patches[p].ball)] = std::uint32_t(p);
    std::vector<FreeCone> cones(patches.size());
    const auto forEachSide = [&](const auto& f) {
        for (const Arc& arc : boundary.arcs) {
            for (const std::int32_t ball : arc.balls) {
                const std::uint32_t p = patchOf[std::size_t(ball)];
                f(arc, patches[p], cones[p]);
            }
        }
    };
    forEachSide([](const Arc& arc, const Patch& patch, FreeCone& cone) {
        cone.axis += arc.half * (arc.centre + arc.radius * arc.middle - patch.centre);
    });
    for (FreeCone& cone : cones) {
        const double length = cone.axis.length();
        cone.axis = length > rounding ? cone.axis / length : Vec3d(1.0, 0.0, 0.0);
    }
    forEachSide([](const Arc& arc, const Patch& patch, FreeCone& cone) {
        cone.cosine =
            std::min(cone.cosine, leastCosine(arc, patch.centre, patch.radius, cone.axis));
    });
    for (std::size_t p = 0; p < patches.size(); ++p) {
        FreeCone& cone = cones[p];
        const openvdb::Vec3f beyond(-cone.axis);
        const CapLists& caps = boundary.caps;
        bool covered = false;
        for (std::size_t k = patches[p].capsBegin; k < patches[p].capsEnd && !covered; ++k)
            covered = openvdb::Vec3f(caps.x[k], caps.y[k], caps.z[k]).dot(beyond) >
                      caps.cosine[k] + cosineRounding;
        cone.cosine = covered ? std::max(cone.cosine - rounding, -1.0) : -1.0;
    }
    return cones;
}

/// Sets the numbers of patch i and its region: the part of its cone down to depth `inside`.
void setPatch(const BallBoundary& boundary, const FreeCone& cone, double inside, std::size_t i,
              PartTable& table)
{
    const Patch& patch = boundary.patches[i];
    table.list.part[i] = std::int32_t(i);
    table.list.caps[i] = {patch.capsBegin, patch.capsEnd};
    table.setPlace(i, patch.centre);
    table.set(i, PartRadius, patch.radius);
    table.set(i, AxisX, cone.axis);
    table.set(i, FreeCosine, cone.cosine);
    table.set(i, FreeSine, sineOf(cone.cosine));
    // That part is a shell: the ball's radius is the largest distance from its centre to the outer
    // and the inner rim, and to the middles of its caps.
    const double r = patch.radius, deep = std::max(r - inside, 0.0);
    const double centre = cone.cosine > 0.0 ? 0.5 * (r + deep * cone.cosine) : 0.0;
    const auto rim = [&](double radius) {
        return std::hypot(radius * cone.cosine - centre, radius * sineOf(cone.cosine));
    };
    const double around =
        cone.cosine > 0.0 ? std::max({rim(r), rim(deep), r - centre, std::abs(deep - centre)}) : r;
    table.regions[i] = Box::about(patch.centre + centre * cone.axis, around);
}

/// Sets the numbers and the region of arc i; every place exceeds the EndCosine of a full circle.
void setArc(const BallBoundary& boundary, double inside, std::size_t i, PartTable& table)
{
    const Arc& arc = boundary.arcs[i];
    const PlacedBall& first = boundary.balls[std::size_t(arc.balls[0])];
    const PlacedBall& second = boundary.balls[std::size_t(arc.balls[1])];
    table.list.part[i] = std::int32_t(boundary.patches.size() + i);
    table.setPlace(i, arc.centre);
    table.set(i, PartRadius, arc.radius);
    table.set(i, AxisX, arc.axis);
    table.set(i, MiddleX, arc.middle);
    const bool whole = arc.ends[0] < 0;
    table.set(i, EndCosine, whole ? -2.0 : std::cos(arc.half));
    table.set(i, EndSine, whole ? 0.0 : std::sin(arc.half));
    const double height = arc.axis.dot(arc.centre - first.centre());
    const double rest = arc.axis.dot(second.centre() - arc.centre);
    table.set(i, FirstCosine, height / first.radius);
    table.set(i, FirstSine, arc.radius / first.radius);
    table.set(i, SecondCosine, rest / second.radius);
    table.set(i, SecondSine, arc.radius / second.radius);
    // The ways from the arc's middle to both centres span a cone; turned about the axis, its points
    // move by less than the chord from the middle to an end.
    const Vec3d middle = arc.centre + arc.radius * arc.middle;
    const Vec3d toFirst = (-height * arc.axis - arc.radius * arc.middle) / first.radius;
    const Vec3d toSecond = (rest * arc.axis - arc.radius * arc.middle) / second.radius;
    Vec3d way = toFirst + toSecond;
    const double length = way.length();
    const double cosine = 0.5 * length; // of half the angle between them
    const Enclosing ball(middle, length > 0.0 ? way / length : way, cosine, inside);
    table.regions[i] =
        Box::about(ball.centre, ball.radius + 2.0 * std::sin(0.5 * arc.half) * arc.radius);
}

/// Sets the numbers and the region of corner i. Its planes pass through it and two of the three
/// centres; normals are 0, and exclude nothing, where all four are nearly in one plane.
void setCorner(const BallBoundary& boundary, double inside, std::int32_t part, std::size_t i,
               PartTable& table)
{
    const Corner& corner = boundary.corners[i];
    table.list.part[i] = part;
    table.setPlace(i, corner.position);
    Vec3d to[3]; // the centres
    for (int k = 0; k < 3; ++k) {
        const PlacedBall& ball = boundary.balls[std::size_t(corner.balls[k])];
        to[k] = (ball.centre() - corner.position) / ball.radius;
    }
    constexpr double flat = double(cosineRounding); // the sign of a smaller volume is rounding
    const double volume = to[0].dot(to[1].cross(to[2]));
    const double sign = std::abs(volume) < flat ? 0.0 : volume > 0.0 ? 1.0 : -1.0;
    double cosine = 1.0;
    Vec3d way = to[0] + to[1] + to[2];
    const double length = way.length();
    if (length > 0.0) way /= length;
    for (int k = 0; k < 3; ++k) {
        const Vec3d normal = to[(k + 1) % 3].cross(to[(k + 2) % 3]);
        const double size = std::max(normal.length(), flat);
        table.set(i, NormalX + 3 * k, sign * normal / size);
        cosine = std::min(cosine, way.dot(to[k]));
    }
    const Enclosing ball(corner.position, way, cosine, inside);
    table.regions[i] = Box::about(ball.centre, ball.radius);
}

} // namespace

PartTables::PartTables(BallBoundary& boundary, const std::vector<Ball>& balls, double probe,
                       double inside, const Progress& progress)
    : inside_(inside)
{
    boundary.capOthers = std::vector<std::int32_t>();
    const std::vector<FreeCone> cones = freeCones(boundary);
    const std::size_t patches = boundary.patches.size(), arcs = boundary.arcs.size();
    patches_.list.caps.resize(patches);
    patches_.make(patches, patchNumbers, progress,
                  [&](std::size_t i) { setPatch(boundary, cones[i], inside, i, patches_); });
    arcs_.make(arcs, arcNumbers, progress,
               [&](std::size_t i) { setArc(boundary, inside, i, arcs_); });
    boundary.arcs = std::vector<Arc>();
    corners_.make(boundary.corners.size(), cornerNumbers, progress, [&](std::size_t i) {
        setCorner(boundary, inside, std::int32_t(patches + arcs + i), i, corners_);
    });
    boundary.corners = std::vector<Corner>();

    std::vector<std::int32_t> patchOf(boundary.balls.size(), -1);
    for (std::size_t p = 0; p < patches; ++p)
        patchOf[std::size_t(boundary.patches[p].ball)] = std::int32_t(p);
    balls_.make(boundary.balls.size(), ballNumbers, progress, [&](std::size_t i) {
        const Ball& ball = balls[std::size_t(boundary.balls[i].index)];
        const Vec3d centre(ball.center);
        const double radius = double(ball.radius) + probe;
        balls_.list.part[i] = patchOf[i];
        balls_.setPlace(i, centre);
        balls_.set(i, PartRadius, radius);
        balls_.regions[i] = Box::about(centre, radius);
    });
}

Part PartTables::part(std::int32_t index) const
{
    auto i = std::size_t(index);
    PartKind kind = PartKind::Patch;
    const PartTable* table = &patches_;
    for (const PartTable* next : {&arcs_, &corners_}) {
        const auto size = std::size_t(table->list.size);
        if (i < size) break;
        i -= size;
        kind = next == &arcs_ ? PartKind::Arc : PartKind::Corner;
        table = next;
    }
    const auto number = [&](int n) { return table->list.numbers[std::size_t(n)][i]; };
    return {kind, Vec3d(table->place[0][i], table->place[1][i], table->place[2][i]),
            number(PartRadius),
            openvdb::Vec3f(number(AxisX), number(AxisY), number(AxisZ))}; // other for corners
}

void PartTables::gather(const Vec3d& centre, double half, double outside, LeafParts& out) const
{
    const float inside = float(inside_), radius = float(half * std::sqrt(3.0));
    for (PartList* list : {&out.corners, &out.arcs, &out.patches, &out.balls}) list->clear();
    // 1 % larger than the leaf for rounding, of which roomFor() allows 0.3 %.
    const Box box = Box::about(centre, 1.01 * half);
    corners_.forEachNear(box, [&](const PartGroup& group) {
        addCorners(group, centre, radius, inside, out.corners);
    });
    arcs_.forEachNear(
        box, [&](const PartGroup& group) { addArcs(group, centre, radius, inside, out.arcs); });
    patches_.forEachNear(box, [&](const PartGroup& group) {
        addPatches(group, centre, radius, inside, out.patches);
    });
    balls_.forEachNear(Box::about(centre, half + outside), [&](const PartGroup& group) {
        addBalls(group, centre, float(half), float(outside), out.balls);
    });
}

} // namespace molsurf
