// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/unit_union.h"

#include "molsurf/kernel/balls/boundary_check.h"
#include "molsurf/kernel/balls/boundary_measure.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

/// A boundary with its measures, checked.
struct MeasuredUnion {
    BallBoundary boundary;
    BoundaryMeasure measure;

    MeasuredUnion(const std::vector<Ball>& balls, const Progress& progress)
        : boundary(ballBoundary(balls, 0.0, progress)), measure(checkedMeasure(boundary, progress))
    {
    }

    std::size_t ballOf(std::size_t patch) const { return indexOf(boundary.patches[patch].ball); }
    std::size_t indexOf(std::int32_t place) const
    {
        return std::size_t(boundary.balls[std::size_t(place)].index);
    }
};

/// Share of the unit in the Euler characteristic: corners less arcs plus the characteristics of
/// faces, each with the mean weight of the balls whose spheres it lies on. (A full circle has no
/// ends, and counts 0.) Where many spheres meet in a point or a circle, which arcs and corners
/// there are depends on how ballBoundary() moves the balls, and that differs from unit to unit:
/// which spheres meet there does not.
///
/// @param[in] weights  the unit's part of each ball
double eulerOfUnit(const std::vector<Ball>& balls, const std::vector<double>& weights,
                   const MeasuredUnion& all)
{
    constexpr double near = 1e-5;       // of a sphere [Å], far above these moves
    constexpr double leastPatch = 1e-6; // [Å^2]: one that these moves can make
    const BallIndex index(balls, {1.0, 0.0, 1.0});
    const auto weightAt = [&](const Vec3d& x) {
        double sum = 0.0, count = 0.0;
        index.forEachNear(x, x, near, [&](const Ball& ball, std::int32_t i) {
            if (std::abs((Vec3d(ball.center) - x).length() - double(ball.radius)) > near) return;
            sum += weights[std::size_t(i)];
            ++count;
        });
        return count > 0.0 ? sum / count : 0.0;
    };
    const BallBoundary& boundary = all.boundary;
    std::vector<Vec3d> places(balls.size()); // of each ball: on the longest of its arcs
    std::vector<double> longest(balls.size(), 0.0);
    double euler = 0.0;
    for (const Arc& arc : boundary.arcs) {
        const Vec3d middle = arc.centre + arc.radius * arc.middle;
        if (arc.ends[0] >= 0) euler -= weightAt(middle);
        for (const std::int32_t place : arc.balls) {
            const std::size_t i = all.indexOf(place);
            if (arc.half * arc.radius <= longest[i]) continue;
            longest[i] = arc.half * arc.radius;
            places[i] = middle;
        }
    }
    for (const Corner& corner : boundary.corners) euler += weightAt(corner.position);
    for (const BoundaryFace& face : all.measure.faces) {
        const std::size_t i = all.ballOf(face.patch);
        const bool tiny = all.measure.patchAreas[face.patch] < leastPatch;
        euler += (tiny ? weightAt(places[i]) : weights[i]) * face.characteristic;
    }
    return euler;
}

} // namespace

std::vector<std::size_t> imagesAt(const BallSet& atoms, const BallIndex& index, std::size_t i)
{
    std::vector<std::size_t> out;
    const Vec3d x(atoms.balls[i].center);
    index.forEachNear(x, x, 0.0, [&](const Ball& ball, std::int32_t j) {
        if (std::size_t(j) == i || ball.radius != atoms.balls[i].radius) return;
        if ((Vec3d(ball.center) - x).length() < onAxis) out.push_back(std::size_t(j));
    });
    return out;
}

UnitShare shareOfUnit(const BallSet& atoms, double grown, const Progress& progress)
{
    const Placement& placement = atoms.placement;
    const Vec3d& middle = placement.unit->centre;
    std::vector<Ball> balls = atoms.balls;
    for (Ball& ball : balls) ball.radius += grown;
    const MeasuredUnion all(balls, progress);
    std::vector<double> areas(balls.size(), 0.0), fluxes(balls.size(), 0.0);
    for (const BoundaryFace& face : all.measure.faces) {
        const Patch& patch = all.boundary.patches[face.patch];
        areas[all.ballOf(face.patch)] += face.area;
        fluxes[all.ballOf(face.patch)] +=
            patch.radius * face.area + (patch.centre - middle).dot(face.normal);
    }

    UnitShare sum;
    sum.areas.assign(balls.size(), 0.0);
    // Of balls in one place only the first is kept: between two that are not quite equal lies a
    // circle with a direction of its own in each unit.
    std::vector<Ball> single;
    std::vector<double> weights; // the unit's parts of these
    const BallIndex index(atoms.balls, {0.0, 0.0, 2.0});
    for (std::size_t i = 0; i < balls.size(); ++i) {
        std::vector<std::size_t> here = imagesAt(atoms, index, i);
        here.push_back(i);
        const double part = 1.0 / double(here.size());
        double weight = 0.0;
        for (const std::size_t j : here) {
            if (placement.owns(std::int32_t(j))) weight += part;
            if (!placement.owns(std::int32_t(i))) continue;
            sum.areas[i] += part * areas[j];
            sum.volume += part * fluxes[j] / 3.0;
        }
        if (*std::min_element(here.begin(), here.end()) != i) continue;
        single.push_back(balls[i]);
        weights.push_back(weight);
    }
    const double order = double(placement.order());
    const double euler =
        order * (single.size() == balls.size() ? eulerOfUnit(balls, weights, all)
                                               : eulerOfUnit(single, weights, {single, progress}));
    const double whole = 2.0 * std::round(0.5 * euler); // that of closed surfaces is even
    if (std::abs(euler - whole) < 0.01) sum.wholeEuler = int(whole);
    return sum;
}

} // namespace molsurf
