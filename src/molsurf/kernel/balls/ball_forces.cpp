// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/ball_forces.h"

#include "molsurf/kernel/balls/toric_tube.h"

#include <openvdb/math/Mat3.h>

#include <cmath>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

/// An arc as seen from one of its balls: x - centre = height axis + rho u, with u a unit vector to
/// the points of the arc.
struct ArcSide {
    Vec3d axis;    ///< to the other ball
    double height; ///< along it [Å]
    double radius; ///< of the ball [Å]
};

/// Both sides of an arc, and the cosine of the angle between the normals of its balls.
struct ArcSides {
    ArcSide of[2];
    double cosine;
};

ArcSide sideOf(const BallBoundary& boundary, const Arc& arc, int which)
{
    const PlacedBall& ball = boundary.balls[std::size_t(arc.balls[which])];
    const PlacedBall& other = boundary.balls[std::size_t(arc.balls[1 - which])];
    const double d = offset(ball, other).length(), r = ball.radius, R = other.radius;
    return {which == 0 ? arc.axis : -arc.axis, (d * d + (r - R) * (r + R)) / (2.0 * d), r};
}

ArcSides sidesOf(const BallBoundary& boundary, const Arc& arc)
{
    const ArcSide a = sideOf(boundary, arc, 0), b = sideOf(boundary, arc, 1);
    return {{a, b}, (arc.radius * arc.radius - a.height * b.height) / (a.radius * b.radius)};
}

/// The integral of the directions u along an arc [rad].
Vec3d directionsOf(const Arc& arc)
{
    return 2.0 * std::sin(arc.half) * arc.middle;
}

/// The scaled normals of the patches, with which both kinds begin.
/// @param[in] scale  of the area of a patch, by its radius
template<typename Scale, typename F>
void forEachFace(const BallBoundary& boundary, const BoundaryMeasure& measure, const Scale& scale,
                 const F& f)
{
    for (const BoundaryFace& face : measure.faces) {
        if (face.piece < 0) continue;
        const Patch& patch = boundary.patches[face.patch];
        f(std::size_t(boundary.balls[std::size_t(patch.ball)].index), patch,
          scale(patch.radius) * face.normal);
    }
}

/// The integrals of (c + s cos f) {cos f, sin f} over angles.
struct Moments {
    double cosine, sine;
};

Moments momentsOf(double c, double s, double from, double to)
{
    const double sines = std::sin(to) - std::sin(from), cosines = std::cos(from) - std::cos(to);
    const double squares = 0.5 * (to - from) + 0.25 * (std::sin(2.0 * to) - std::sin(2.0 * from));
    const double mixed = 0.5 * (std::sin(to) * std::sin(to) - std::sin(from) * std::sin(from));
    return {c * sines + s * squares, c * cosines + s * mixed};
}

/// The same over a tube, without what lies beyond the axis.
Moments momentsOf(const Tube& tube, double c, double s)
{
    if (!tube.isCut()) return momentsOf(c, s, tube.low, tube.high);
    const Moments a = momentsOf(c, s, tube.low, -tube.cusp);
    const Moments b = momentsOf(c, s, tube.cusp, tube.high);
    return {a.cosine + b.cosine, a.sine + b.sine};
}

} // namespace

BallGradients unionGradients(const BallBoundary& boundary, const BoundaryMeasure& measure,
                             std::size_t count)
{
    BallGradients out{std::vector<Vec3d>(count, Vec3d(0.0)), std::vector<Vec3d>(count, Vec3d(0.0))};
    forEachFace(
        boundary, measure, [](double) { return 1.0; },
        [&](std::size_t i, const Patch&, const Vec3d& normal) { out.volume[i] += normal; });
    for (std::size_t a = 0; a < boundary.arcs.size(); ++a) {
        if (measure.arcPieces[a] < 0) continue;
        const Arc& arc = boundary.arcs[a];
        const double rho = arc.radius;
        const auto [sides, cosine] = sidesOf(boundary, arc);
        const double t = std::sqrt(std::max(1.0 - cosine, 0.0) / (1.0 + cosine)); // tan(phi/2)
        for (int k = 0; k < 2; ++k) {
            const ArcSide& s = sides[k];
            // n = (height axis + rho u) / r, nu = (rho axis - height u) / r
            const Vec3d along = (rho + t * s.height) * 2.0 * arc.half * s.axis +
                                (t * rho - s.height) * directionsOf(arc);
            const PlacedBall& ball = boundary.balls[std::size_t(arc.balls[k])];
            out.area[std::size_t(ball.index)] -= rho / s.radius * along;
        }
    }
    return out;
}

BallGradients excludedGradients(const BallBoundary& boundary, const BoundaryMeasure& measure,
                                const std::vector<ConcavePull>& pulls, double probe,
                                std::size_t count)
{
    BallGradients out{std::vector<Vec3d>(count, Vec3d(0.0)), std::vector<Vec3d>(count, Vec3d(0.0))};
    forEachFace(
        boundary, measure,
        [&](double radius) { return (radius - probe) * (radius - probe) / (radius * radius); },
        [&](std::size_t i, const Patch& patch, const Vec3d& normal) {
            out.volume[i] += normal;
            if (patch.radius > probe) out.area[i] += 2.0 / (patch.radius - probe) * normal;
        });
    for (std::size_t a = 0; a < boundary.arcs.size(); ++a) {
        if (measure.arcPieces[a] < 0) continue;
        const Arc& arc = boundary.arcs[a];
        const double rho = arc.radius;
        const auto [sides, cosine] = sidesOf(boundary, arc);
        const double cot = cosine / std::sqrt((1.0 - cosine) * (1.0 + cosine));
        const Tube tube = tubeOf(boundary, arc, probe);
        // The element of area is p (rho - p cos f), and twice the mean curvature times that is
        // 2 p cos f - rho.
        const Moments ofVolume = momentsOf(tube, probe * rho, -probe * probe);
        const Moments ofArea = momentsOf(tube, -rho, 2.0 * probe);
        for (int k = 0; k < 2; ++k) {
            const ArcSide& s = sides[k];
            // If the ball moves by v, the arc moves by (v.n) (n + cot nu) in its normal plane.
            const double alongU = (rho - s.height * cot) / s.radius;
            const double alongAxis = (s.height + rho * cot) / s.radius * (k == 0 ? 1.0 : -1.0);
            const Vec3d normals =
                (2.0 * arc.half * s.height * s.axis + rho * directionsOf(arc)) / s.radius;
            const PlacedBall& ball = boundary.balls[std::size_t(arc.balls[k])];
            const auto i = std::size_t(ball.index);
            out.volume[i] += (alongU * ofVolume.cosine - alongAxis * ofVolume.sine) * normals;
            out.area[i] += (alongU * ofArea.cosine - alongAxis * ofArea.sine) * normals;
        }
    }
    for (const ConcavePull& pull : pulls) {
        Vec3d ways[3]; // from the balls to the probe, which stay as long as they are
        for (int k = 0; k < 3; ++k)
            ways[k] = pull.position - boundary.balls[std::size_t(pull.balls[k])].centre();
        const double volume = ways[0].dot(ways[1].cross(ways[2]));
        for (int k = 0; k < 3; ++k) {
            // The probe moves by cross (way.v), cross being at right angles to the other two.
            const Vec3d cross = ways[(k + 1) % 3].cross(ways[(k + 2) % 3]) / volume;
            const auto i = std::size_t(boundary.balls[std::size_t(pull.balls[k])].index);
            out.volume[i] += cross.dot(pull.normal) * ways[k];
            out.area[i] += cross.dot(pull.edge - 2.0 / probe * pull.normal) * ways[k];
        }
    }
    return out;
}

} // namespace molsurf
