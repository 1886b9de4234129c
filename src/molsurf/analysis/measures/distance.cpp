// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface.h"

#include "molsurf/analysis/measures/compare.h"
#include "molsurf/analysis/proximity/distance.h"
#include "molsurf/error.h"
#include "molsurf/kernel/balls/ball_boundary.h"
#include "molsurf/kernel/balls/ball_index.h"
#include "molsurf/kernel/balls/boundary_point.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/grid/grid_like.h"
#include "molsurf/kernel/mesh/check_arrays.h"
#include "molsurf/kernel/mesh/topology.h"
#include "molsurf/kernel/pipeline/check_balls.h"
#include "molsurf/kernel/pipeline/surface_kind.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

Vec3d unitOr(const Vec3d& v, const Vec3d& otherwise)
{
    const double length = v.length();
    return length > 0.0 ? v / length : otherwise;
}

/// The spline that the mesh was made of, if it is among the fields, or else one close to it.
Spline splineOf(const MolecularSurface& from, const Progress& progress)
{
    if (const auto coefficients = findGrid<openvdb::FloatGrid>(from.fields, "spline"))
        return Spline{fromGrid(*coefficients)};
    return splineThrough(*from.surface, progress);
}

} // namespace

struct SurfaceDistance::Parts {
    /// The ball whose surface is nearest to a point, in double precision.
    class NearestBall
    {
    public:
        explicit NearestBall(const std::vector<Ball>& balls) : index_(balls, {0.5, 0.0, 2.0}) {}

        /// @param[out] gap  |x - x_i| - r_i of it [Å]
        std::int32_t at(const Vec3d& x, double& gap) const
        {
            constexpr double none = std::numeric_limits<double>::infinity();
            // A search that widens: all balls with a gap up to `reach` are seen, and some others.
            for (double reach = 1.0;; reach *= 4.0) {
                std::int32_t best = -1;
                gap = none;
                index_.forEachNear(x, x, reach, [&](const Ball& ball, std::int32_t i) {
                    const double here = (x - ball.center).length() - ball.radius;
                    if (here > gap || (here == gap && i > best)) return;
                    gap = here;
                    best = i;
                });
                if (gap <= reach) return best;
            }
        }

    private:
        BallIndex index_;
    };

    /// The boundary of a union of balls, for points in it.
    struct ExactUnion {
        ExactUnion(const std::vector<Ball>& balls, double grown, const Progress& progress)
            : probe(grown), boundary(ballBoundary(balls, grown, progress)), points(boundary)
        {
        }
        ExactUnion(const ExactUnion&) = delete;
        ExactUnion& operator=(const ExactUnion&) = delete;

        double probe; ///< that the radii are grown by [Å]
        BallBoundary boundary;
        BoundaryPoints points;

        /// @param[in] nearest  the ball that is nearest to x
        /// @param[in] gap      how far x is outside of it, without the probe [Å]
        PointDistance at(const Vec3d& x, const Ball& nearest, double gap) const
        {
            const Vec3d away = unitOr(x - nearest.center, Vec3d(1.0, 0.0, 0.0));
            PointDistance out;
            if (gap >= probe) { // outside the nearest ball is that of the nearest point
                out.distance = gap - probe;
                out.normal = away;
                out.closest = nearest.center + (nearest.radius + probe) * away;
                return out;
            }
            const BoundaryPoint point = points.nearest(x, std::max(probe - gap, 0.1));
            out.distance = -point.distance;
            out.closest = point.position;
            // On an arc or in a corner there is more than one normal: the one toward the point is.
            out.normal = unitOr(point.position - x, away);
            return out;
        }
    };

    /// The mesh and the spline of a surface, for points anywhere.
    struct MeshedSurface {
        MeshedSurface(const MolecularSurface& from, const Progress& progress)
            : surface(), to(nullptr)
        {
            surface.mesh.positions = from.mesh.positions;
            surface.mesh.triangles = from.mesh.triangles;
            surface.closed = hasInside(surface.mesh, vertexTriangles(surface.mesh), progress);
            if (from.surface && from.shared.empty()) {
                Spline spline = splineOf(from, progress);
                if (spline.table().size() > 0) surface.spline = std::move(spline);
            }
            to = std::make_unique<DistanceTo>(surface);
        }
        MeshedSurface(const MeshedSurface&) = delete;
        MeshedSurface& operator=(const MeshedSurface&) = delete;

        Surface surface;
        std::unique_ptr<DistanceTo> to;
    };

    explicit Parts(const std::vector<Ball>& all) : balls(all), nearest(balls) {}
    Parts(const Parts&) = delete;
    Parts& operator=(const Parts&) = delete;

    std::vector<Ball> balls;
    NearestBall nearest;
    std::optional<ExactUnion> exact;
    std::optional<MeshedSurface> meshed;
};

SurfaceDistance::SurfaceDistance(const BallSet& atoms, const SurfaceOptions& options,
                                 const MolecularSurface& surface, const Progress& progress)
{
    if (atoms.balls.empty()) throw Error(ErrorKind::Input, "distance: no atoms");
    checkFinite(atoms.balls);
    checkArrays(surface.mesh);
    auto parts = std::make_unique<Parts>(atoms.balls);
    const bool changed = options.ofParts() || options.fillCavities;
    if (isBoundary(options) && !changed && atoms.placement.isWhole())
        parts->exact.emplace(atoms.balls, probeOf(options), progress);
    else if (!surface.mesh.triangles.empty())
        parts->meshed.emplace(surface, progress);
    else
        throw Error(ErrorKind::Input, "distance: expected a surface with a mesh, got none");
    parts_ = std::move(parts);
}

SurfaceDistance::~SurfaceDistance() = default;
SurfaceDistance::SurfaceDistance(SurfaceDistance&& other) noexcept = default;
SurfaceDistance& SurfaceDistance::operator=(SurfaceDistance&& other) noexcept = default;

std::vector<PointDistance> SurfaceDistance::at(const std::vector<Vec3d>& points,
                                               const Progress& progress) const
{
    constexpr double farthest = 1e6; // [Å]
    for (std::size_t i = 0; i < points.size(); ++i)
        for (int axis = 0; axis < 3; ++axis)
            if (!(std::abs(points[i][axis]) <= farthest))
                throw Error(ErrorKind::Input, "point " + std::to_string(i) +
                                                  ": expected coordinates within 1e6 Å, got " +
                                                  std::to_string(points[i][axis]));
    constexpr std::size_t chunk = 64;
    std::vector<PointDistance> out(points.size());
    parallelFor((points.size() + chunk - 1) / chunk, progress, [&](std::size_t c) {
        std::optional<DistanceTo::Query> query;
        if (parts_->meshed) query.emplace(*parts_->meshed->to);
        for (std::size_t i = c * chunk; i < std::min(points.size(), (c + 1) * chunk); ++i) {
            double gap = 0.0;
            const std::int32_t ball = parts_->nearest.at(points[i], gap);
            if (query) {
                const Distance d = query->at(points[i]);
                out[i] = {d.inside ? -d.value : d.value, d.closest, d.normal, ball};
                continue;
            }
            out[i] = parts_->exact->at(points[i], parts_->balls[std::size_t(ball)], gap);
            out[i].ball = ball;
        }
    });
    return out;
}

} // namespace molsurf
