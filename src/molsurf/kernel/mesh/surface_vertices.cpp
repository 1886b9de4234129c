// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/mesh/surface_vertices.h"

#include "molsurf/kernel/spline/curvature.h"
#include "molsurf/kernel/spline/spline_lanes.h"

#include <cmath>

namespace molsurf
{

using openvdb::Coord;
using openvdb::Vec3d;
using openvdb::Vec3f;

void SurfaceVertices::set(std::size_t v, const Vec3f& x, const Vec3f& normal, float slope,
                          float mean, float gauss)
{
    mesh.positions[v] = x;
    mesh.normals[v] = normal;
    slopes[v] = slope;
    mesh.scalars[0].values[v] = mean;
    mesh.scalars[1].values[v] = gauss;
}

void SurfaceVertices::set(std::size_t v, const Vec3d& x, const Jet& jet)
{
    const double slope = jet.gradient.length();
    const bool regular = slope >= leastSlope;
    set(v, Vec3f(x), slope > 0.0 ? Vec3f(jet.gradient / slope) : Vec3f(0.0f, 0.0f, 1.0f),
        float(slope), regular ? float(meanCurvature(jet)) : 0.0f,
        regular ? float(gaussianCurvature(jet)) : 0.0f);
}

namespace
{

/// Finds S = 0 between the corners of the cell of a point: the line from the corner nearest to the
/// point to the nearest one of the other sign. Where rounding has given all of them one sign, the
/// corner where the level set and the spline differ lies on S = 0, as good as that.
void bisect(SplineSampler& sampler, double voxel, Vec3d& x, Jet& jet)
{
    constexpr int bisections = 30;
    const Coord cell = Coord::floor(x / voxel);
    Vec3d ends[2] = {x, x};
    double distance[2] = {1e30, 1e30}, least = 1e30;
    Vec3d zero = x;
    for (int k = 0; k < 8; ++k) {
        const Vec3d corner = cell.offsetBy(k >> 2, k >> 1 & 1, k & 1).asVec3d() * voxel;
        const double value = sampler.at(corner).value;
        const int side = value < 0.0 ? 0 : 1;
        if (std::abs(value) < least) {
            least = std::abs(value);
            zero = corner;
        }
        const double d = (corner - x).lengthSqr();
        if (d < distance[side]) {
            distance[side] = d;
            ends[side] = corner;
        }
    }
    if (distance[0] < 1e30 && distance[1] < 1e30) {
        for (int i = 0; i < bisections; ++i) {
            x = 0.5 * (ends[0] + ends[1]);
            ends[sampler.at(x).value < 0.0 ? 0 : 1] = x;
        }
    } else {
        x = zero;
    }
    jet = sampler.at(x);
}

using Block = LeafBlock<float, 3>;

enum class Way : std::uint8_t { Going, There, Lost };

/// A point on its way to S = 0, relative to the first voxel of its leaf. Lengths in voxels.
struct Walker {
    float x[3], start[3];
    float normal[3], slope, mean, gauss; // at x, or where the last step to x began
    float residual;                      // |S| at x
    Way way = Way::Going;
};

constexpr float leastGradient = 0.05f;

/// The spline about the points, and the lengths that bound their way, in its voxels.
struct Field {
    const float* block;
    float inverse;   // of its voxels [1/Å]
    float tolerance; // of |S| at the end
    float farthest;  // from the start
    float longestStep;
    float shortStep; // What is known where it begins holds at its end, too.

    /// @param[in] unit  a voxel of the mesher
    Field(const float* values, double voxelSize, double unit)
        : block(values), inverse(float(1.0 / voxelSize)), tolerance(float(1e-5 * unit)),
          farthest(float(unit)), longestStep(float(0.5 * unit)), shortStep(float(1e-3 * unit))
    {
    }
};

/// A place in a block: the coefficient of its cell's lowest corner, and where it lies in the cell.
struct Place {
    const float* cell;
    float t[3];

    MOLSURF_INLINE Place(const float* block, const float* x)
    {
        constexpr int strides[3] = {Block::strideX, Block::strideY, Block::strideZ};
        cell = block;
        for (int a = 0; a < 3; ++a) {
            const int fromRim = int(x[a] + 3.0f); // rounds down, for what lies beyond the rim
            cell += fromRim * strides[a];
            t[a] = x[a] - float(fromRim - 3);
        }
    }
};

/// Moves a walker against the normal, and sees whether it is too far from its start then.
MOLSURF_INLINE void take(const Field& f, float step, const float* normal, Walker& w)
{
    step = clamped(step, -f.longestStep, f.longestStep);
    float far2 = 0.0f;
    for (int a = 0; a < 3; ++a) {
        w.x[a] -= step * normal[a];
        far2 += (w.x[a] - w.start[a]) * (w.x[a] - w.start[a]);
    }
    if (!(far2 < f.farthest * f.farthest)) w.way = Way::Lost;
}

/// The first step of walkers, which are seldom near enough to need the curvature already.
MOLSURF_KERNEL void firstSteps(const Field& f, Walker* walkers, int count)
{
    for (int i = 0; i < count; ++i) {
        Walker& w = walkers[i];
        const Place place(f.block, w.x);
        const Floats4 d =
            f.inverse * splineGradient(place.cell, Block::strideX, Block::strideY, place.t);
        const float slope = std::sqrt(d[1] * d[1] + d[2] * d[2] + d[3] * d[3]);
        if (!(slope >= leastGradient)) {
            w.way = Way::Lost;
            continue;
        }
        const float normal[3] = {d[1] / slope, d[2] / slope, d[3] / slope};
        take(f, d[0] / slope, normal, w);
    }
}

/// A step of all walkers that are still going.
/// @return how many are going on
MOLSURF_KERNEL int nextSteps(const Field& f, Walker* walkers, int count)
{
    int going = 0;
    for (int i = 0; i < count; ++i) {
        Walker& w = walkers[i];
        if (w.way != Way::Going) continue;
        const Place place(f.block, w.x);
        const SplineJet jet = splineJet(place.cell, Block::strideX, Block::strideY, place.t);
        const Floats4 d = f.inverse * jet.first, e = f.inverse * jet.second,
                      m = f.inverse * jet.mixed;
        const float slope = std::sqrt(d[1] * d[1] + d[2] * d[2] + d[3] * d[3]);
        if (!(slope >= leastGradient)) {
            w.way = Way::Lost;
            continue;
        }
        const float scale = 1.0f / slope;
        const float n[3] = {d[1] * scale, d[2] * scale, d[3] * scale};
        const float Hn[3] = {e[0] * n[0] + e[3] * n[1] + m[0] * n[2],
                             e[3] * n[0] + e[1] * n[1] + m[1] * n[2],
                             m[0] * n[0] + m[1] * n[1] + e[2] * n[2]};
        const float along = n[0] * Hn[0] + n[1] * Hn[1] + n[2] * Hn[2];
        const float step = d[0] * scale, bend = 0.5f * step * step * std::abs(along);
        const bool near = std::abs(d[0]) <= f.tolerance;
        if (!near && !(std::abs(step) <= f.shortStep && bend <= 0.5f * f.tolerance)) {
            take(f, step, n, w);
            ++going;
            continue;
        }
        const float trace = e[0] + e[1] + e[2];
        const float minors =
            e[0] * e[1] + e[1] * e[2] + e[2] * e[0] - (e[3] * e[3] + m[0] * m[0] + m[1] * m[1]);
        const float Hn2 = Hn[0] * Hn[0] + Hn[1] * Hn[1] + Hn[2] * Hn[2];
        w.slope = slope;
        w.mean = 0.5f * (trace - along) * scale;
        w.gauss = (Hn2 - trace * along + minors) * scale * scale;
        w.residual = near ? std::abs(d[0]) : bend;
        w.way = Way::There;
        for (int a = 0; a < 3; ++a) {
            w.normal[a] = n[a];
            if (!near) w.x[a] -= step * n[a];
        }
    }
    return going;
}

} // namespace

void moveToSurface(const Spline& spline, double voxel, std::size_t first, std::size_t end,
                   SurfaceVertices& vertices, float* residuals)
{
    constexpr int rounds = 7;
    const double h = spline.voxelSize();
    SplineSampler sampler(spline); // for those that lose their way
    std::vector<Walker> walkers;
    Block block;
    const Field field(block.values, h, voxel / h);
    const std::vector<Vec3f>& positions = vertices.mesh.positions;
    for (std::size_t begin = first, next; begin < end; begin = next) {
        // The vertices of one leaf.
        const auto originOf = [h](const Vec3f& x) {
            return Coord::floor(Vec3d(x) / h) & ~(leafDim - 1);
        };
        const Coord origin = originOf(positions[begin]);
        walkers.clear();
        for (next = begin; next < end && originOf(positions[next]) == origin; ++next) {
            const Vec3d x = Vec3d(positions[next]) / h - origin.asVec3d();
            Walker w;
            for (int a = 0; a < 3; ++a) w.x[a] = w.start[a] = float(x[a]);
            walkers.push_back(w);
        }
        const std::int32_t leaf = spline.table().find(origin);
        if (leaf == noLeaf) {
            for (Walker& w : walkers) w.way = Way::Lost;
        } else {
            block.gather(spline.coefficients, std::size_t(leaf));
            firstSteps(field, walkers.data(), int(walkers.size()));
            for (int i = 0; i < rounds; ++i)
                if (nextSteps(field, walkers.data(), int(walkers.size())) == 0) break;
        }
        for (std::size_t v = begin; v < next; ++v) {
            const Walker& w = walkers[v - begin];
            if (w.way == Way::There) {
                const Vec3d x = (origin.asVec3d() + Vec3d(w.x[0], w.x[1], w.x[2])) * h;
                vertices.set(v, Vec3f(x), Vec3f(w.normal), w.slope, field.inverse * w.mean,
                             field.inverse * field.inverse * w.gauss);
                residuals[v - first] = w.residual * float(h);
                continue;
            }
            Vec3d x(positions[v]);
            Jet jet;
            if (!moveToSurface(sampler, voxel, 1.0, x, jet)) {
                x = Vec3d(positions[v]);
                bisect(sampler, voxel, x, jet);
            }
            vertices.set(v, x, jet);
            residuals[v - first] = float(std::abs(jet.value));
        }
    }
}

} // namespace molsurf
