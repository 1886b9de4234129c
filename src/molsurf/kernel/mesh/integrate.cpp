// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/mesh/integrate.h"

#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/core/spherical_area.h"
#include "molsurf/kernel/spline/curvature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

/// Points of a triangle in orbits of three: two equal barycentric coordinates, the weight in the
/// six-point rule of degree 4 (Dunavant 1985) and the one in the three-point rule of degree 2.
struct Orbit {
    double equal, fine, coarse;
};
constexpr Orbit orbits[] = {{0.445948490915965, 0.223381589678011, 0.0},
                            {0.091576213509771, 0.109951743655322, 0.0},
                            {1.0 / 6.0, 0.0, 1.0 / 3.0}};

constexpr double edgeCosine = 0.766;   // of 40 degrees
constexpr int maxSplits = 10;          // of triangles, one after the other
constexpr int maxLevels = 6;           // of the refinement in parameters
constexpr double transversality = 0.3; // least grad S.d/|grad S| on a line along d
constexpr double residualVox = 1e-5;   // |S|/|grad S| at a point of the surface [voxel]

/// A point of the surface with its normal, and its barycentric coordinates in the triangle of the
/// mesh.
struct Point {
    Vec3d x, n, b;
};

/// The integrals over a triangle of the mesh, and those of the curvatures times each coordinate.
struct TriangleIntegrals {
    SurfaceIntegrals sums;
    Vec3d meanCurvature{0.0}, gaussianCurvature{0.0};

    TriangleIntegrals& operator+=(const TriangleIntegrals& o)
    {
        sums += o.sums;
        meanCurvature += o.meanCurvature;
        gaussianCurvature += o.gaussianCurvature;
        return *this;
    }
};

/// Barycentric coordinates of the corners of a part of a triangle.
struct TrianglePart {
    Vec3d b[3];

    TrianglePart child(int k) const
    {
        const Vec3d p = 0.5 * (b[0] + b[1]), q = 0.5 * (b[1] + b[2]), r = 0.5 * (b[2] + b[0]);
        const TrianglePart parts[4] = {{{b[0], p, r}}, {{p, b[1], q}}, {{r, q, b[2]}}, {{p, q, r}}};
        return parts[k];
    }

    /// Of the whole triangle's parameters.
    double share() const
    {
        const Vec3d u = b[1] - b[0], v = b[2] - b[0];
        return std::abs(u.y() * v.z() - u.z() * v.y());
    }
};

/// The rise over its chord of the arc between two points with normals, times 8 (as in measure()).
Vec3d rise(const Point& p, const Point& q)
{
    const Vec3d e = q.x - p.x;
    return e.dot(q.n) * q.n - e.dot(p.n) * p.n;
}

class Integrator
{
public:
    /// @param[in] tolerance  of the difference of the two rules over a part of a triangle [sr]
    /// @param[in] origin     that volumes are taken about
    Integrator(const Spline& spline, double tolerance, const Vec3d& origin)
        : sampler_(spline), h_(spline.voxelSize()), tolerance_(tolerance), origin_(origin)
    {
    }

    /// Adds a triangle, split at its bent edges. Whether an edge is split depends on its ends only,
    /// so the neighbour does the same.
    void add(const Point& a, const Point& b, const Point& c, int splits = 0)
    {
        const Point* corner[3] = {&a, &b, &c};
        const auto bent = [&](int k) { // the edge from corner k
            return corner[k]->n.dot(corner[(k + 1) % 3]->n) < edgeCosine;
        };
        const int count = splits < maxSplits ? bent(0) + bent(1) + bent(2) : 0;
        if (count == 0) return addPatch(a, b, c, splits);
        if (count == 3) {
            const Point p = middle(a, b), q = middle(b, c), r = middle(c, a);
            add(a, p, r, splits + 1);
            add(p, b, q, splits + 1);
            add(r, q, c, splits + 1);
            return add(p, q, r, splits + 1);
        }
        // The odd edge runs from i to j.
        int i = 0;
        while (bent(i) != (count == 1)) ++i;
        const Point &s = *corner[i], &t = *corner[(i + 1) % 3], &u = *corner[(i + 2) % 3];
        if (count == 1) {
            const Point m = middle(s, t);
            add(s, m, u, splits + 1);
            add(m, t, u, splits + 1);
        } else {
            const Point p = middle(t, u), q = middle(u, s);
            add(q, p, u, splits + 1);
            add(s, t, p, splits + 1);
            add(s, p, q, splits + 1);
        }
    }

    /// The sums since the last call.
    TriangleIntegrals take() { return std::exchange(sums_, {}); }

private:
    /// Moves a point along the gradient onto S = 0, by at most `reach`; else leaves it there.
    bool moveToZero(Point& p, double reach)
    {
        const Vec3d start = p.x;
        Jet jet = sampler_.at(p.x);
        p.n = jet.gradient.length() > 0.0 ? jet.gradient.unit() : Vec3d(0.0, 0.0, 1.0);
        const Vec3d normal = p.n;
        for (int i = 0; i < 12; ++i) {
            const double slope = jet.gradient.length();
            if (slope < leastSlope) break;
            p.n = jet.gradient / slope;
            const double step = jet.value / slope;
            if (std::abs(step) <= residualVox * h_) return true;
            p.x -= std::clamp(step, -0.3 * reach, 0.3 * reach) * p.n;
            if ((p.x - start).lengthSqr() > reach * reach) break;
            jet = sampler_.at(p.x);
        }
        p.x = start;
        p.n = normal;
        return false;
    }

    /// The middle of an edge on the surface; the same from either end.
    Point middle(const Point& a, const Point& b)
    {
        Point m{0.5 * (a.x + b.x) + 0.125 * rise(a, b), Vec3d(0.0), 0.5 * (a.b + b.b)};
        moveToZero(m, (b.x - a.x).length());
        return m;
    }

    /// Adds the integrals over the surface above a triangle. What does not converge is split at the
    /// point of the surface above its middle, at last taken as flat.
    void addPatch(const Point& a, const Point& b, const Point& c, int splits)
    {
        patch_[0] = a;
        patch_[1] = b;
        patch_[2] = c;
        TriangleIntegrals sums;
        if (integrate({{Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1)}}, 0, sums)) {
            sums_ += sums;
            return;
        }
        Point m{(a.x + b.x + c.x) / 3.0, Vec3d(0.0), (a.b + b.b + c.b) / 3.0};
        if (splits < maxSplits && moveToZero(m, (b.x - a.x).length())) {
            add(a, b, m, splits + 1);
            add(b, c, m, splits + 1);
            return add(c, a, m, splits + 1);
        }
        const Vec3d flat = 0.5 * (b.x - a.x).cross(c.x - a.x);
        const double K = sphericalArea(a.n, b.n, c.n);
        sums_.sums.area += flat.length();
        sums_.sums.volume += (a.x - origin_).dot(flat) / 3.0;
        sums_.sums.gaussianCurvature += K;
        sums_.sums.unresolvedArea += flat.length();
        sums_.gaussianCurvature += K * (a.b + b.b + c.b) / 3.0;
    }

    /// The integrals over a part of patch_, which is refined until the two rules agree.
    /// @return false if the patch is no graph along its normals
    bool integrate(const TrianglePart& part, int level, TriangleIntegrals& sums)
    {
        TriangleIntegrals fine;
        double difference = 0.0;
        if (!applyRules(part, fine, difference)) return false;
        if (difference <= tolerance_ || level == maxLevels) {
            sums += fine;
            return true;
        }
        for (int k = 0; k < 4; ++k) {
            if (!integrate(part.child(k), level + 1, sums)) return false;
        }
        return true;
    }

    /// Applies both rules to a part of patch_. With u and v the derivatives of x + t d by two
    /// barycentric coordinates at a fixed t, dA = |grad S| (u x v).d / (grad S.d) times theirs.
    /// @param[out] out         by the rule of degree 4
    /// @param[out] difference  of the two rules for the integral of K [sr]
    bool applyRules(const TrianglePart& part, TriangleIntegrals& out, double& difference)
    {
        const Point* P = patch_;
        SurfaceIntegrals& sums = out.sums;
        const double half = 0.5 * part.share();
        double coarse = 0.0;
        for (const Orbit& orbit : orbits) {
            for (int k = 0; k < 3; ++k) {
                const Vec3d b = orbit.equal * (part.b[0] + part.b[1] + part.b[2]) +
                                (1.0 - 3.0 * orbit.equal) * part.b[k];
                // The surface is x + t d, with x on the triangle and d the interpolated normal.
                const Vec3d x = b[0] * P[0].x + b[1] * P[1].x + b[2] * P[2].x;
                const Vec3d d = b[0] * P[0].n + b[1] * P[1].n + b[2] * P[2].n;
                const Vec3d arc = b[0] * b[1] * rise(P[0], P[1]) + b[1] * b[2] * rise(P[1], P[2]) +
                                  b[2] * b[0] * rise(P[2], P[0]);
                double t = 0.5 * arc.dot(d) / d.lengthSqr();
                Jet jet;
                if (!findOnLine(x, d, t, jet)) return false;
                const Vec3d u = P[1].x - P[0].x + t * (P[1].n - P[0].n);
                const Vec3d v = P[2].x - P[0].x + t * (P[2].n - P[0].n);
                const double element = half * u.cross(v).dot(d) / jet.gradient.dot(d);
                const double area = element * jet.gradient.length();
                const double H = meanCurvature(jet), K = gaussianCurvature(jet);
                coarse += orbit.coarse * area * K;
                sums.area += orbit.fine * area;
                sums.volume += orbit.fine * element * (x + t * d - origin_).dot(jet.gradient) / 3.0;
                sums.meanCurvature += orbit.fine * area * H;
                sums.gaussianCurvature += orbit.fine * area * K;
                sums.squaredMeanCurvature += orbit.fine * area * H * H;
                const Vec3d share =
                    orbit.fine * area * (b[0] * P[0].b + b[1] * P[1].b + b[2] * P[2].b);
                out.meanCurvature += H * share;
                out.gaussianCurvature += K * share;
            }
        }
        difference = std::abs(sums.gaussianCurvature - coarse);
        return true;
    }

    /// Newton's method for S(x + t d) = 0, where the surface crosses the line clearly.
    bool findOnLine(const Vec3d& x, const Vec3d& d, double& t, Jet& jet)
    {
        for (int i = 0; i < 10 && std::abs(t) <= h_; ++i) {
            jet = sampler_.at(x + t * d);
            const double slope = jet.gradient.length(), along = jet.gradient.dot(d);
            if (slope < leastSlope || along < transversality * slope) return false;
            if (std::abs(jet.value) <= residualVox * h_ * slope) return true;
            t -= std::clamp(jet.value / along, -0.3 * h_, 0.3 * h_);
        }
        return false;
    }

    SplineSampler sampler_;
    const double h_, tolerance_;
    const Vec3d origin_;
    Point patch_[3];
    TriangleIntegrals sums_;
};

} // namespace

IntegratedSurface integrateSurface(const Mesh& mesh, const Spline& spline, double tolerance,
                                   const Progress& progress)
{
    if (mesh.triangles.empty()) return {};
    constexpr std::size_t chunk = 256;
    const std::size_t triangles = mesh.triangles.size();
    const Vec3d origin(mesh.positions[0]); // so that volumes do not cancel
    std::vector<std::array<Vec3d, 2>> shares(triangles);
    IntegratedSurface result;
    result.sums =
        parallelSum<SurfaceIntegrals>((triangles + chunk - 1) / chunk, progress, [&](auto c) {
            Integrator integrator(spline, tolerance / double(triangles), origin);
            SurfaceIntegrals sums;
            for (std::size_t i = c * chunk; i < std::min(triangles, (c + 1) * chunk); ++i) {
                Point p[3];
                for (int k = 0; k < 3; ++k) {
                    const std::uint32_t v = mesh.triangles[i][k];
                    p[k] = {Vec3d(mesh.positions[v]), Vec3d(mesh.normals[v]),
                            Vec3d(k == 0, k == 1, k == 2)};
                }
                integrator.add(p[0], p[1], p[2]);
                const TriangleIntegrals triangle = integrator.take();
                sums += triangle.sums;
                shares[i] = {triangle.meanCurvature, triangle.gaussianCurvature};
            }
            return sums;
        });
    result.meanCurvature.resize(mesh.positions.size());
    result.gaussianCurvature.resize(mesh.positions.size());
    for (std::size_t i = 0; i < triangles; ++i) {
        for (int k = 0; k < 3; ++k) {
            result.meanCurvature[mesh.triangles[i][k]] += shares[i][0][k];
            result.gaussianCurvature[mesh.triangles[i][k]] += shares[i][1][k];
        }
    }
    return result;
}

} // namespace molsurf
