// SPDX-License-Identifier: MPL-2.0
#include "molsurf/picture/draw_mesh.h"

#include "molsurf/core/parallel.h"
#include "molsurf/io/part_ranges.h"
#include "molsurf/mesh/ray_scene.h"

#include <openvdb/math/Mat3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace molsurf
{

using openvdb::Vec3d;
using openvdb::Vec3f;

namespace
{

constexpr std::size_t subpixels = 2; // a pixel is the mean of 2 x 2 rays
constexpr std::size_t eyeRays = subpixels * subpixels;
constexpr std::size_t occlusionRays = 12; // a pixel; at most 16
constexpr int smoothing = 2;              // occlusion is averaged over so many pixels to each side
constexpr double nearby = 60.0;           // what half of the occlusion looks at [Å]
constexpr double farthestFade = 0.22;     // of a depth cue
constexpr double border = 1.04;           // width of the picture over that of the molecule
constexpr double outlinePixels = 8;       // least jump in depth that gets an outline, in pixels,
constexpr double outlineLength = 2;       // and in Å
constexpr float nothing = -std::numeric_limits<float>::infinity();

/// The frame of the picture: unit vectors, right-handed.
struct View {
    Vec3d center, right, up, toEye;
    double pixel = 0.0;        ///< edge [Å]
    double low = 0.0, far = 0; ///< of the mesh along toEye, from the center [Å]
    int width = 0, height = 0; ///< [pixel]

    Vec3d at(double x, double y) const
    {
        return center + (x - 0.5 * width) * pixel * right + (0.5 * height - y) * pixel * up;
    }
};

/// The vertices of a part that lie farthest out in some direction of a few hundred.
std::vector<Vec3d> outermost(const Mesh& mesh, const PartRange& part)
{
    constexpr int directions = 400;
    std::vector<Vec3d> out;
    for (int k = 0; k < directions; ++k) { // by a golden spiral
        const double z = 1.0 - (2.0 * k + 1.0) / directions, r = std::sqrt(1.0 - z * z);
        const double angle = 2.0 * M_PI * 0.6180339887498949 * k;
        const Vec3f way(float(r * std::cos(angle)), float(r * std::sin(angle)), float(z));
        std::size_t farthest = part.firstVertex;
        for (std::size_t v = part.firstVertex; v < part.vertexEnd; ++v) {
            if (mesh.positions[v].dot(way) > mesh.positions[farthest].dot(way)) farthest = v;
        }
        out.push_back(Vec3d(mesh.positions[farthest]));
    }
    return out;
}

/// Points that span what is shown: the vertices, or of copies the outermost ones.
std::vector<Vec3d> spanOf(const Mesh& mesh, const std::vector<MeshInstance>& instances)
{
    std::vector<Vec3d> out;
    if (instances.empty()) {
        for (const Vec3f& p : mesh.positions) out.push_back(Vec3d(p));
        return out;
    }
    std::vector<std::vector<Vec3d>> outer;
    for (const PartRange& part : partRanges(mesh, "")) outer.push_back(outermost(mesh, part));
    for (const MeshInstance& instance : instances) {
        for (const Vec3d& x : outer[instance.part]) out.push_back(instance.placed(x));
    }
    return out;
}

/// Principal axes of points, the longest first.
std::array<Vec3d, 3> principalAxes(const std::vector<Vec3d>& points)
{
    Vec3d mean(0.0);
    for (const Vec3d& p : points) mean += p;
    mean /= double(points.size());
    openvdb::Mat3d covariance = openvdb::Mat3d::zero();
    for (const Vec3d& p : points) {
        const Vec3d d = p - mean;
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) covariance(i, j) += d[i] * d[j];
        }
    }
    openvdb::Mat3d vectors;
    Vec3d values;
    std::array<Vec3d, 3> axes = {Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1)};
    if (!openvdb::math::diagonalizeSymmetricMatrix(covariance, vectors, values)) return axes;
    std::array<int, 3> order = {0, 1, 2};
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return values[a] > values[b]; });
    for (std::size_t k = 0; k < 3; ++k) {
        Vec3d axis;
        for (int i = 0; i < 3; ++i) axis[i] = vectors(i, order[k]);
        axis.normalize();
        const Vec3d size(std::abs(axis[0]), std::abs(axis[1]), std::abs(axis[2]));
        const int largest = size[0] >= size[1] && size[0] >= size[2] ? 0
                            : size[1] >= size[2]                     ? 1
                                                                     : 2;
        axes[k] = axis[largest] < 0.0 ? -axis : axis;
    }
    return axes;
}

/// viewAxes() of points.
std::array<Vec3d, 3> axesOf(const std::vector<Vec3d>& points, const DrawOptions& options)
{
    Vec3d right, toEye;
    if (options.toEye.lengthSqr() > 0.0) {
        toEye = options.toEye.unit();
        right = options.up.cross(toEye).unit();
    } else {
        const auto axes = principalAxes(points);
        right = axes[0];
        toEye = axes[0].cross(axes[1]);
    }
    const Vec3d up = toEye.cross(right);
    const double angle = options.turn * M_PI / 180.0;
    return {std::cos(angle) * right - std::sin(angle) * toEye, up,
            std::cos(angle) * toEye + std::sin(angle) * right};
}

View chooseView(const Mesh& mesh, const DrawOptions& options)
{
    View view;
    const std::vector<Vec3d> points = spanOf(mesh, options.instances);
    const std::array<Vec3d, 3> axes =
        axesOf(options.about.empty() ? points : options.about, options);
    view.right = axes[0];
    view.up = axes[1];
    view.toEye = axes[2];

    // A turn must not change the scale, so the extent across is that of all turns.
    Vec3d low(std::numeric_limits<double>::max()), high(-low);
    double reach = 0.0;
    for (const Vec3d& x : points) {
        const Vec3d seen(x.dot(view.right), x.dot(view.up), x.dot(view.toEye));
        low = openvdb::math::minComponent(low, seen);
        high = openvdb::math::maxComponent(high, seen);
    }
    const Vec3d mid = 0.5 * (low + high), extent = high - low;
    view.center = mid[0] * view.right + mid[1] * view.up + mid[2] * view.toEye;
    if (options.turn != 0.0 || options.turnable) {
        for (const Vec3d& p : points) {
            const Vec3d d = p - view.center;
            reach = std::max(reach, std::hypot(d.dot(view.right), d.dot(view.toEye)));
        }
    }
    const double across = std::max(extent[0], 2.0 * reach), upward = extent[1];
    view.width = options.width;
    view.pixel = border * across / view.width;
    const double shape = std::clamp(upward * border / (across * border), 0.2, 4.0);
    view.height = std::max(1, int(std::lround(view.width * shape)));
    view.low = -0.5 * extent[2];
    view.far = 0.5 * extent[2];
    return view;
}

/// The surface as one pixel sees it.
struct Sample {
    Vec3f color{0.0f}; ///< linear, lit by the lamp and the sky, not shadowed
    Vec3f normal{0.0f};
    float depth = nothing; ///< along toEye, from the center [Å]
    float open = 1.0f;     ///< share of the sky that is seen
    float cover = 0.0f;    ///< share of the pixel
};

/// A number in [0, 1) for a pixel, unlike that of its neighbours (Jimenez, 2014).
double noise(int x, int y)
{
    const double u = 0.06711056 * x + 0.00583715 * y;
    const double v = 52.9829189 * (u - std::floor(u));
    return v - std::floor(v);
}

/// The rays of a pixel go in packets of 4 and of 16, a quarter faster than one by one.
class Tracer
{
public:
    Tracer(const Mesh& mesh, const View& view, const DrawOptions& options)
        : mesh_(mesh), view_(view), plain_(linearLight(options.plain)),
          instances_(options.instances), parts_(trianglesOf(mesh)),
          scene_(instances_.empty() ? RayScene(mesh) : RayScene(mesh, parts_, instances_)),
          lamp_((view.toEye - 0.35 * view.right + 0.55 * view.up).unit())
    {
    }

    Sample trace(int x, int y) const
    {
        Sample out;
        Vec3d at(0.0);
        int hits = 0;
        std::array<Vec3d, eyeRays> from;
        alignas(16) RTCRayHit4 rays{};
        for (std::size_t s = 0; s < eyeRays; ++s) {
            const double dx = (double(s % subpixels) + 0.5) / subpixels;
            const double dy = (double(s / subpixels) + 0.5) / subpixels;
            from[s] = view_.at(x + dx, y + dy) + (view_.far + 1.0) * view_.toEye;
            set(rays.ray, s, from[s], -view_.toEye, view_.far - view_.low + 2.0);
            rays.hit.geomID[s] = rays.hit.instID[0][s] = RTC_INVALID_GEOMETRY_ID;
        }
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        alignas(16) constexpr std::array<int, eyeRays> all = {-1, -1, -1, -1};
        rtcIntersect4(all.data(), scene_.get(), &context, &rays);
        for (std::size_t s = 0; s < eyeRays; ++s) {
            if (rays.hit.geomID[s] == RTC_INVALID_GEOMETRY_ID) continue;
            ++hits;
            const MeshInstance* instance = nullptr;
            std::size_t first = 0;
            if (!instances_.empty()) {
                instance = &instances_[rays.hit.instID[0][s]];
                first = parts_[instance->part].first;
            }
            const auto& t = mesh_.triangles[first + rays.hit.primID[s]];
            const float u = rays.hit.u[s], v = rays.hit.v[s], w = 1.0f - u - v;
            Vec3f normal =
                w * mesh_.normals[t[0]] + u * mesh_.normals[t[1]] + v * mesh_.normals[t[2]];
            if (instance) normal = Vec3f(instance->turned(Vec3d(normal)));
            normal.normalize();
            if (normal.dot(Vec3f(view_.toEye)) < 0.0f) normal = -normal;
            Vec3f color = mesh_.colors.empty() ? plain_
                                               : w * linearLight(mesh_.colors[t[0]]) +
                                                     u * linearLight(mesh_.colors[t[1]]) +
                                                     v * linearLight(mesh_.colors[t[2]]);
            if (instance)
                color = linearLight(instance->color) * (mesh_.colors.empty() ? Vec3f(1.0f) : color);
            out.color += lit(color, normal);
            out.normal += normal;
            const float depth = float(view_.far + 1.0) - rays.ray.tfar[s];
            if (depth > out.depth) {
                out.depth = depth;
                at = from[s] - double(rays.ray.tfar[s]) * view_.toEye;
            }
        }
        if (hits == 0) return out;
        out.color /= float(hits);
        out.normal.normalize();
        out.cover = float(hits) / eyeRays;
        out.open = openness(at, Vec3d(out.normal), noise(x, y));
        return out;
    }

private:
    /// Triangles [first, end) of each part.
    static std::vector<std::pair<std::size_t, std::size_t>> trianglesOf(const Mesh& mesh)
    {
        std::vector<std::pair<std::size_t, std::size_t>> out;
        for (const PartRange& part : partRanges(mesh, ""))
            out.emplace_back(part.firstTriangle, part.triangleEnd);
        return out;
    }

    template<typename Rays>
    static void set(Rays& rays, std::size_t k, const Vec3d& from, const Vec3d& way, double length)
    {
        rays.org_x[k] = float(from[0]);
        rays.org_y[k] = float(from[1]);
        rays.org_z[k] = float(from[2]);
        rays.dir_x[k] = float(way[0]);
        rays.dir_y[k] = float(way[1]);
        rays.dir_z[k] = float(way[2]);
        rays.tnear[k] = 0.0f;
        rays.tfar[k] = float(length);
        rays.mask[k] = ~0u;
    }

    Vec3f lit(const Vec3f& color, const Vec3f& normal) const
    {
        const float lamp = std::max(0.0f, normal.dot(Vec3f(lamp_)));
        return (0.66f + 0.42f * lamp) * color;
    }

    /// Share of the sky over a point, weighted by the cosine: rays by a golden spiral. To every
    /// other ray only what is near hides the sky, so that the insides of shells are not all dark.
    float openness(const Vec3d& at, const Vec3d& normal, double turn) const
    {
        const Vec3d side = std::abs(normal[0]) < 0.6 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
        const Vec3d u = normal.cross(side).unit(), v = normal.cross(u);
        const Vec3d from = at + 1.5 * view_.pixel * normal + 1e-3 * view_.toEye;
        alignas(64) RTCRay16 rays{};
        alignas(64) std::array<int, 16> valid{};
        for (std::size_t k = 0; k < occlusionRays; ++k) {
            const double r = std::sqrt((double(k) + 0.5) / occlusionRays);
            const double angle = 2.0 * M_PI * (double(k) * 0.6180339887498949 + turn);
            const Vec3d way =
                r * std::cos(angle) * u + r * std::sin(angle) * v + std::sqrt(1.0 - r * r) * normal;
            set(rays, k, from, way, k % 2 ? nearby : std::numeric_limits<double>::infinity());
            valid[k] = -1;
        }
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcOccluded16(valid.data(), scene_.get(), &context, &rays);
        int open = 0;
        for (std::size_t k = 0; k < occlusionRays; ++k) open += rays.tfar[k] >= 0.0f;
        return float(open) / occlusionRays;
    }

    const Mesh& mesh_;
    const View& view_;
    Vec3f plain_;
    const std::vector<MeshInstance>& instances_;
    std::vector<std::pair<std::size_t, std::size_t>> parts_;
    RayScene scene_;
    Vec3d lamp_;
};

/// The samples, and what is made of them.
class Canvas
{
public:
    Canvas(const View& view, bool depthCue, std::vector<Sample> samples)
        : view_(view), fade_(depthCue ? farthestFade : 0.0), samples_(std::move(samples))
    {
    }

    float cover(int x, int y) const { return at(x, y).cover; }

    /// Of the surface alone, where there is any of it in a pixel.
    Vec3f color(int x, int y, const Vec3f& background) const
    {
        const Sample& s = at(x, y);
        if (s.cover <= 0.0f) return background;
        const float shade = 0.12f + 0.88f * smoothOpen(x, y);
        const double behind = (view_.far - double(s.depth)) / (view_.far - view_.low);
        const float haze = float(fade_ * std::clamp(behind, 0.0, 1.0));
        Vec3f lit = (1.0f - haze) * shade * s.color + haze * background;
        return lit * (1.0f - 0.75f * outline(x, y));
    }

private:
    const Sample& at(int x, int y) const
    {
        return samples_[std::size_t(y) * std::size_t(view_.width) + std::size_t(x)];
    }

    bool inside(int x, int y) const
    {
        return x >= 0 && y >= 0 && x < view_.width && y < view_.height;
    }

    /// Mean openness of the pixels about, of those on the same piece of surface.
    float smoothOpen(int x, int y) const
    {
        const Sample& here = at(x, y);
        const float reach = float(4.0 * smoothing * view_.pixel);
        float sum = 0.0f, weights = 0.0f;
        for (int j = y - smoothing; j <= y + smoothing; ++j) {
            for (int i = x - smoothing; i <= x + smoothing; ++i) {
                if (!inside(i, j) || at(i, j).cover <= 0.0f) continue;
                const Sample& s = at(i, j);
                if (std::abs(s.depth - here.depth) > reach) continue;
                const float alike = std::max(0.0f, s.normal.dot(here.normal));
                const float weight = alike * alike * alike * alike;
                sum += weight * s.open;
                weights += weight;
            }
        }
        return weights > 0.0f ? sum / weights : here.open;
    }

    /// 1 on the near side of a jump in depth.
    float outline(int x, int y) const
    {
        const float jump = float(std::max(outlinePixels * view_.pixel, outlineLength));
        const float depth = at(x, y).depth;
        float strongest = 0.0f;
        for (const auto& [dx, dy] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
            if (!inside(x + dx, y + dy)) continue;
            const float there = at(x + dx, y + dy).depth;
            const float drop = there == nothing ? 2.0f * jump : depth - there;
            strongest = std::max(strongest, std::clamp(drop / jump - 1.0f, 0.0f, 1.0f));
        }
        return strongest;
    }

    const View& view_;
    double fade_; // of the most distant parts
    std::vector<Sample> samples_;
};

} // namespace

std::array<Vec3d, 3> viewAxes(const Mesh& mesh, const DrawOptions& options)
{
    return axesOf(options.about.empty() ? spanOf(mesh, options.instances) : options.about, options);
}

Picture drawMesh(const Mesh& mesh, const DrawOptions& options, const Progress& progress)
{
    Picture picture;
    if (mesh.triangles.empty()) {
        picture.width = picture.height = options.width;
        for (int n = 0; n < options.width * options.width; ++n) {
            picture.rgb.insert(picture.rgb.end(), options.background.begin(),
                               options.background.end());
        }
        if (options.transparent) picture.alpha.resize(picture.rgb.size() / 3, 0);
        return picture;
    }
    const View view = chooseView(mesh, options);
    const auto width = std::size_t(view.width), height = std::size_t(view.height);
    std::vector<Sample> samples(width * height);
    {
        const Tracer tracer(mesh, view, options);
        parallelFor(height, progress, [&](std::size_t y) {
            for (std::size_t x = 0; x < width; ++x) {
                samples[y * width + x] = tracer.trace(int(x), int(y));
            }
        });
    }
    const Canvas canvas(view, options.depthCue, std::move(samples));
    const Vec3f background = linearLight(options.background);
    picture.width = view.width;
    picture.height = view.height;
    picture.rgb.resize(3 * width * height);
    if (options.transparent) picture.alpha.resize(width * height);
    parallelFor(height, progress, [&](std::size_t y) {
        for (std::size_t x = 0; x < width; ++x) {
            const float cover = canvas.cover(int(x), int(y));
            Vec3f color = canvas.color(int(x), int(y), background);
            if (options.transparent)
                picture.alpha[y * width + x] = std::uint8_t(std::lround(255.0f * cover));
            else if (cover > 0.0f)
                color = cover * color + (1.0f - cover) * background;
            std::uint8_t* to = &picture.rgb[3 * (y * width + x)];
            if (color == background) { // most of them, and exact
                std::copy(options.background.begin(), options.background.end(), to);
                continue;
            }
            for (int c = 0; c < 3; ++c) to[c] = fromLinearLight(double(color[c]));
        }
    });
    return picture;
}

} // namespace molsurf
