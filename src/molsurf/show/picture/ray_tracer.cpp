// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/picture/ray_tracer.h"

#include "molsurf/kernel/core/orthonormal_basis.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/show/io/part_ranges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace molsurf
{

using openvdb::Vec3d;
using openvdb::Vec3f;

namespace
{

constexpr std::size_t skyRays = PixelLight::skyRays, lampRays = PixelLight::lampRays;
constexpr double nearby = 60.0; // what half of the sky's rays look at [Å]
constexpr std::int32_t unknown = -2;
constexpr double golden = 0.6180339887498949;

/// Numbers of the pixels of a square of 4 x 4, whose rays complement each other: any such square of
/// pixels has all of them.
int patternOf(int x, int y)
{
    constexpr std::array<int, 16> order = {0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};
    return order[std::size_t((y & 3) * 4 + (x & 3))];
}

std::vector<std::pair<std::size_t, std::size_t>> trianglesOf(const Mesh& mesh)
{
    std::vector<std::pair<std::size_t, std::size_t>> out;
    for (const PartRange& part : partRanges(mesh, ""))
        out.emplace_back(part.firstTriangle, part.triangleEnd);
    return out;
}

Color mixed(const Color& a, const Color& b, const Color& c, const Vec3f& w)
{
    Color out;
    for (std::size_t k = 0; k < out.size(); ++k)
        out[k] = std::uint8_t(w[0] * float(a[k]) + w[1] * float(b[k]) + w[2] * float(c[k]) + 0.5f);
    return out;
}

Color multiplied(const Color& a, const Color& b)
{
    Color out;
    for (std::size_t k = 0; k < out.size(); ++k)
        out[k] = std::uint8_t((int(a[k]) * int(b[k]) + 127) / 255);
    return out;
}

/// The triangles of a mesh that a cut leaves: no ray goes where the others are. Empty: all.
RayScene::Triangles keptBy(const DrawOptions& options, const View& view, const Mesh& mesh)
{
    RayScene::Triangles kept;
    if (!options.clip || !options.instances.empty()) return kept;
    const double top = *options.clip + view.center.dot(view.toEye);
    std::vector<bool> below(mesh.positions.size());
    for (std::size_t i = 0; i < below.size(); ++i)
        below[i] = Vec3d(mesh.positions[i]).dot(view.toEye) <= top;
    const auto reaches = [&](const auto& t) { return below[t[0]] || below[t[1]] || below[t[2]]; };
    std::copy_if(mesh.triangles.begin(), mesh.triangles.end(), std::back_inserter(kept), reaches);
    return kept;
}

} // namespace

Vec3f Tracer::lamp()
{
    return Vec3f(-0.5f, 0.62f, 0.75f).unit();
}

Shapes::Shapes(const Mesh& shape, const std::vector<MeshInstance>& copies, RayScene::Triangles some)
    : mesh(shape), instances(copies), kept(std::move(some)), parts(trianglesOf(shape)),
      scene(copies.empty() ? RayScene(shape.positions, kept.empty() ? shape.triangles : kept)
                           : RayScene(shape, parts, copies))
{
}

namespace
{

std::vector<const RayUnit*> unitsOf(const AtomModel& model)
{
    std::vector<const RayUnit*> units;
    for (const AtomUnit& unit : model.units) units.push_back(&unit);
    return units;
}

} // namespace

AtomShapes::AtomShapes(const AtomModel& atoms) : model(atoms), scene(unitsOf(atoms), atoms.copies)
{
}

Tracer::Tracer(const Mesh& mesh, const View& view, const PictureStyle& style,
               const DrawOptions& options)
    : view_(view), style_(style), options_(options),
      surface_(mesh, options.instances, keptBy(options, view, mesh)),
      top_(std::min(view.far + 1.0, options.clip.value_or(view.far + 1.0))),
      clips_(top_ < view.far + 1.0),
      lamp_(double(lamp()[0]) * view.right + double(lamp()[1]) * view.up +
            double(lamp()[2]) * view.toEye),
      owners_(options.borders ? mesh.positions.size() : 0)
{
    for (auto& owner : owners_) owner.store(unknown, std::memory_order_relaxed);
    if (options.model) atoms_.emplace(*options.model);
    static const std::vector<MeshInstance> asTheyAre;
    if (options.model && !options.model->bodies.mesh.triangles.empty())
        bodies_.emplace(options.model->bodies.mesh, asTheyAre);
}

Seen meanOf(const Layer& layer, const Places& places)
{
    Seen mean = layer.seen[places[0]];
    if (!mean.any()) return mean;
    int nx = 0, ny = 0;
    float depth = 0.0f;
    std::array<int, 3> color{};
    for (const std::size_t n : places) {
        const Seen& seen = layer.seen[n];
        nx += seen.nx;
        ny += seen.ny;
        depth += seen.depth;
        for (std::size_t k = 0; k < 3; ++k) color[k] += seen.color[k];
    }
    mean.depth = depth / 4.0f;
    mean.nx = std::int16_t(nx / 4);
    mean.ny = std::int16_t(ny / 4);
    for (std::size_t k = 0; k < 3; ++k) mean.color[k] = std::uint8_t((color[k] + 2) / 4);
    return mean;
}

Layer Tracer::first(const Progress& progress) const
{
    return trace(nullptr, progress);
}

Layer Tracer::behind(const Layer& front, const Progress& progress) const
{
    return trace(&front, progress);
}

Layer Tracer::trace(const Layer* front, const Progress& progress) const
{
    const auto width = std::size_t(view_.width), height = std::size_t(view_.height);
    // A ray through one sample of four would miss thin bonds; and layers behind need exact depths
    // to begin at, which means have not.
    const bool sparse = isSparse(options_, view_) && options_.opacity >= 1.0 && !atoms_;
    Layer layer;
    layer.seen.resize(samplesPerPixel * width * height);
    layer.lights.resize(width * height);
    parallelFor(height, progress, [&](std::size_t y) {
        Samples samples;
        for (int row = subpixels * int(y); row < subpixels * int(y + 1); row += sparse ? 2 : 1)
            for (int column = 0; column < subpixels * view_.width; column += sparse ? 2 : 1)
                samples.push_back({column, row});
        look(samples, front, layer);
    });
    if (sparse) {
        parallelFor(height, progress, [&](std::size_t y) { lookBetween(int(y), layer); });
    }
    std::atomic<bool> any{false};
    parallelFor(height, progress, [&](std::size_t y) {
        for (std::size_t x = 0; x < width; ++x) {
            PixelLight& light = layer.lights[y * width + x];
            light = lightOf(int(x), int(y), !front, layer);
            if (light.depth > Seen::nothing) any = true;
        }
    });
    layer.empty = !any;
    return layer;
}

/// @param[in] depths  where the rays begin; Seen::nothing: they do not
Tracer::EyeRays Tracer::from(const std::array<int, 2>* samples,
                             const std::array<float, packet>& depths) const
{
    EyeRays out;
    for (std::size_t s = 0; s < packet; ++s) {
        out.valid[s] = depths[s] > Seen::nothing ? -1 : 0;
        out.from[s] = view_.center;
        if (!out.valid[s]) continue;
        out.from[s] =
            view_.at((samples[s][0] + 0.5) / subpixels, (samples[s][1] + 0.5) / subpixels) +
            double(depths[s]) * view_.toEye;
    }
    return out;
}

RTCRayHit4 Tracer::meet(const RayScene& scene, const EyeRays& eye) const
{
    alignas(16) RTCRayHit4 rays{};
    for (std::size_t s = 0; s < packet; ++s) {
        setRay(rays.ray, s, eye.from[s], -view_.toEye, view_.far - view_.low + 2.0);
        rays.hit.geomID[s] = rays.hit.instID[0][s] = RTC_INVALID_GEOMETRY_ID;
    }
    intersect(eye.valid.data(), scene.get(), rays);
    return rays;
}

/// Sends rays through samples.
/// @param[in] front  null, or the layer that they begin behind
void Tracer::look(const Samples& samples, const Layer* front, Layer& layer) const
{
    for (std::size_t first = 0; first < samples.size(); first += packet) {
        const std::array<int, 2>* at = samples.data() + first;
        const std::size_t count = std::min(packet, samples.size() - first);
        std::array<float, packet> depths, wallDepths; // where rays begin, and those to the surface
        std::array<std::uint8_t, packet> bodyPiece;   // of a body that a ray meets
        depths.fill(Seen::nothing);
        bodyPiece.fill(Seen::body);
        for (std::size_t s = 0; s < count; ++s) {
            depths[s] = float(top_);
            if (!front) continue;
            const Seen& before = front->seen[placeOf(at[s][0], at[s][1])];
            const bool solid = before.opaque() || (!before.ofBody() && options_.opacity >= 1.0);
            depths[s] = solid ? Seen::nothing : before.depth - 1e-3f;
            if (before.piece != Seen::body) bodyPiece[s] = Seen::bodyInside;
        }
        wallDepths = depths;
        for (std::size_t s = 0; s < packet; ++s)
            if (front && !options_.showBehind && bodyPiece[s] != Seen::body)
                wallDepths[s] = Seen::nothing; // behind the nearest wall there is no other
        const auto send = [&](const auto& shapes, const auto& begins, const auto& seenOf) {
            const EyeRays eye = from(at, begins);
            const RTCRayHit4 hits = meet(shapes.scene, eye);
            for (std::size_t s = 0; s < count; ++s) {
                if (hits.hit.geomID[s] == RTC_INVALID_GEOMETRY_ID) continue;
                const Seen found = seenOf(hits, s, eye.from[s]);
                Seen& seen = layer.seen[placeOf(at[s][0], at[s][1])];
                if (found.depth > seen.depth) seen = found;
            }
        };
        send(surface_, wallDepths, [this](auto&&... ray) { return hitOf(ray...); });
        if (!atoms_) continue;
        if (!front) std::fill_n(depths.begin(), count, float(view_.far + 1.0)); // not cut
        send(*atoms_, depths, [this](auto&&... ray) { return atomOf(ray...); });
        if (!bodies_) continue;
        send(*bodies_, depths, [&](const RTCRayHit4& hits, std::size_t s, const Vec3d& start) {
            Seen seen = bodyOf(hits, s, start);
            seen.piece = bodyPiece[s];
            return seen;
        });
    }
}

/// Fills the samples of a row of pixels between those that rays were sent through.
void Tracer::lookBetween(int y, Layer& layer) const
{
    Samples others;
    const auto fill = [&](int column, int row, const std::optional<Places>& about, bool alike) {
        if (alike) {
            layer.seen[placeOf(column, row)] = meanOf(layer, *about);
        } else {
            others.push_back({column, row});
        }
    };
    for (int x = 0; x < view_.width; ++x) {
        const int column = subpixels * x, row = subpixels * y;
        // What the four about the last sample see is smooth between any of them, too.
        const auto cell = sentAbout(column + 1, row + 1);
        const bool smooth = cell && areAlike(layer, *cell);
        const auto right = sentAbout(column + 1, row), below = sentAbout(column, row + 1);
        fill(column + 1, row, right, smooth || (right && areAlike(layer, *right)));
        fill(column, row + 1, below, smooth || (below && areAlike(layer, *below)));
        fill(column + 1, row + 1, cell, smooth);
    }
    look(others, nullptr, layer);
}

/// The places of the samples about one that have had a ray, some twice; none at the picture's end.
std::optional<Places> Tracer::sentAbout(int column, int row) const
{
    const int left = column - column % 2, right = column + column % 2;
    const int above = row - row % 2, below = row + row % 2;
    if (right >= subpixels * view_.width || below >= subpixels * view_.height) return {};
    return Places{placeOf(left, above), placeOf(right, above), placeOf(left, below),
                  placeOf(right, below)};
}

/// Whether samples see the same smooth piece of surface, or nothing.
bool Tracer::areAlike(const Layer& layer, const Places& places) const
{
    constexpr float flat = 0.98f, steepest = 0.25f; // cosines: of normals, and to the eye
    constexpr int mostColors = 16;                  // of 255, between two samples
    const Seen& one = layer.seen[places[0]];
    const Vec3f normal = one.normal();
    if (one.any() && normal[2] < steepest) return false;
    const float deepest = float(2.0 * view_.pixel / steepest);
    const int most = options_.borders ? 0 : mostColors;
    return std::all_of(places.begin() + 1, places.end(), [&](std::size_t n) {
        const Seen& other = layer.seen[n];
        if (other.any() != one.any() || other.piece != one.piece) return false;
        if (!one.any()) return true;
        for (std::size_t k = 0; k < 3; ++k)
            if (std::abs(int(other.color[k]) - int(one.color[k])) > most) return false;
        const Vec3f way = other.normal();
        return way.dot(normal) >= flat && way[2] >= steepest &&
               std::abs(other.depth - one.depth) <= deepest;
    });
}

PixelLight Tracer::lightOf(int x, int y, bool isFirst, const Layer& layer) const
{
    PixelLight light;
    Vec3d at(0.0);
    bool isAtom = false, isBody = false, isWall = false;
    for (int row = subpixels * y; row < subpixels * (y + 1); ++row) {
        for (int column = subpixels * x; column < subpixels * (x + 1); ++column) {
            const Seen& seen = layer.seen[placeOf(column, row)];
            if (seen.depth <= light.depth) continue;
            light.depth = seen.depth;
            light.nx = seen.nx;
            light.ny = seen.ny;
            isAtom = seen.piece == Seen::atom;
            isBody = seen.ofBody();
            isWall = !isAtom && !isBody && options_.opacity >= 1.0; // of an opaque surface
            at = view_.at((column + 0.5) / subpixels, (row + 0.5) / subpixels) +
                 double(seen.depth) * view_.toEye;
        }
    }
    // Walls that are seen through let light through: walls behind them have no shadow, and atoms
    // there only that of each other. Bodies have the light of the open.
    if (light.depth == Seen::nothing || isBody || (!isFirst && !isAtom && !isWall)) return light;
    const int step = lightStep(options_, view_);
    const int left = x - x % step, top = y - y % step;
    const bool asks = (left == x && top == y) || // a thin thing may miss the pixels that ask
                      !layer.seen[placeOf(subpixels * left, subpixels * top)].any();
    if (!asks) return light;
    const Vec3d seen(light.normal());
    const Vec3d normal = seen[0] * view_.right + seen[1] * view_.up + seen[2] * view_.toEye;
    const int pattern = patternOf(x / step, y / step);
    const bool among = isAtom && options_.opacity < 1.0;
    if (style_.sky > 0.0f) light.openRays = skyRaysAt(at, normal, among, pattern);
    if (style_.shadow > 0.0f) light.litRays = lampRaysAt(at, normal, among, pattern);
    return light;
}

/// @param[in] normal  of any length; turned to face the eye if it does not
Seen Tracer::facing(float depth, Vec3d normal) const
{
    // At a rim the mean of the normals may look past the eye.
    normal.normalize();
    normal -= std::min(0.0, normal.dot(view_.toEye)) * view_.toEye;
    normal.normalize();
    Seen out;
    out.depth = depth;
    out.nx = std::int16_t(std::lround(32767.0 * normal.dot(view_.right)));
    out.ny = std::int16_t(std::lround(32767.0 * normal.dot(view_.up)));
    return out;
}

Seen Tracer::atomOf(const RTCRayHit4& rays, std::size_t s, const Vec3d& from) const
{
    const MeshInstance& copy = atoms_->model.copies[rays.hit.instID[0][s]];
    const AtomUnit& unit = atoms_->model.units[copy.part];
    const std::size_t shape = rays.hit.primID[s];
    Vec3f normal(rays.hit.Ng_x[s], rays.hit.Ng_y[s], rays.hit.Ng_z[s]);
    Color color;
    if (rays.hit.geomID[s] == RayUnit::Triangles) {
        const auto& t = unit.mesh.triangles[shape];
        const Vec3f weights(1.0f - rays.hit.u[s] - rays.hit.v[s], rays.hit.u[s], rays.hit.v[s]);
        normal = weights[0] * unit.mesh.normals[t[0]] + weights[1] * unit.mesh.normals[t[1]] +
                 weights[2] * unit.mesh.normals[t[2]];
        color = unit.mesh.colors[t[0]];
    } else {
        const bool isBall = rays.hit.geomID[s] == RayUnit::Balls;
        color = isBall ? unit.ballColors[shape] : unit.stickColors[shape];
    }
    const double start = from.dot(view_.toEye) - view_.center.dot(view_.toEye);
    Seen out = facing(float(start - double(rays.ray.tfar[s])), copy.turned(Vec3d(normal)));
    out.color = multiplied(color, copy.color);
    out.piece = Seen::atom;
    return out;
}

Seen Tracer::bodyOf(const RTCRayHit4& rays, std::size_t s, const Vec3d& from) const
{
    const Mesh& mesh = bodies_->mesh;
    const auto& t = bodies_->triangleOf(rays, s);
    const Vec3f weights(1.0f - rays.hit.u[s] - rays.hit.v[s], rays.hit.u[s], rays.hit.v[s]);
    const Vec3d normal(weights[0] * mesh.normals[t[0]] + weights[1] * mesh.normals[t[1]] +
                       weights[2] * mesh.normals[t[2]]);
    const double start = from.dot(view_.toEye) - view_.center.dot(view_.toEye);
    // A back wall, which the eye sees from inside, faces the eye with its other side.
    Seen out = facing(float(start - double(rays.ray.tfar[s])),
                      normal.dot(view_.toEye) < 0.0 ? -normal : normal);
    out.color = mesh.colors[t[0]];
    return out;
}

Seen Tracer::hitOf(const RTCRayHit4& rays, std::size_t s, const Vec3d& from) const
{
    const MeshInstance* copy = surface_.copyOf(rays, s);
    const Mesh& mesh = surface_.mesh;
    const auto& t = surface_.triangleOf(rays, s);
    const Vec3f weights(1.0f - rays.hit.u[s] - rays.hit.v[s], rays.hit.u[s], rays.hit.v[s]);
    const Vec3f side = (mesh.positions[t[1]] - mesh.positions[t[0]])
                           .cross(mesh.positions[t[2]] - mesh.positions[t[0]]);
    const auto placed = [&](const Vec3f& way) {
        return copy ? copy->turned(Vec3d(way)) : Vec3d(way);
    };
    const bool fromBehind = placed(side).dot(view_.toEye) < 0.0;
    const double length = double(rays.ray.tfar[s]);
    const double start = from.dot(view_.toEye) - view_.center.dot(view_.toEye);
    // Rays of the first layer begin at float(top_), and `start` is that but for rounding. One that
    // meets a back face from there began inside.
    if (clips_ && start >= double(float(top_)) - 1e-6 && fromBehind) {
        Seen out;
        out.depth = float(top_);
        out.piece = Seen::cut;
        const Vec3d x = copy ? copy->broughtBack(from) : from;
        out.color = options_.inside ? options_.inside(x) : options_.plain;
        return out;
    }
    Vec3d normal = placed(weights[0] * mesh.normals[t[0]] + weights[1] * mesh.normals[t[1]] +
                          weights[2] * mesh.normals[t[2]]);
    Seen out = facing(float(start - length), fromBehind ? -normal : normal);
    // Copies beside each other get different numbers below those of cuts, atoms and bodies.
    if (copy) out.piece = std::uint8_t(rays.hit.instID[0][s] % Seen::body);
    const Vec3d x = from - length * view_.toEye;
    out.color = colorAt(t.data(), weights, copy ? copy->broughtBack(x) : x);
    if (copy) out.color = mesh.colors.empty() ? copy->color : multiplied(out.color, copy->color);
    return out;
}

Color Tracer::colorAt(const std::uint32_t* corners, const Vec3f& weights, const Vec3d& x) const
{
    const std::vector<Color>& colors = surface_.mesh.colors;
    if (colors.empty()) return options_.plain;
    if (options_.borders) return borderColor(corners, x);
    return mixed(colors[corners[0]], colors[corners[1]], colors[corners[2]], weights);
}

/// Where the corners of a triangle have one owner it has all of it; elsewhere it is asked for.
Color Tracer::borderColor(const std::uint32_t* corners, const Vec3d& x) const
{
    thread_local std::vector<OwnersPower> near;
    const ColorOwners& borders = *options_.borders;
    const auto ownerAt = [&](const Vec3d& at) {
        borders.owners.at(at, 0.0, near);
        return near.empty() ? -1 : near[0].owner;
    };
    std::array<std::int32_t, 3> owner;
    for (std::size_t k = 0; k < 3; ++k) {
        auto& known = owners_[corners[k]]; // the same, whoever finds it
        owner[k] = known.load(std::memory_order_relaxed);
        if (owner[k] != unknown) continue;
        owner[k] = ownerAt(Vec3d(surface_.mesh.positions[corners[k]]));
        known.store(owner[k], std::memory_order_relaxed);
    }
    const bool same = owner[0] == owner[1] && owner[1] == owner[2];
    const std::int32_t own = same ? owner[0] : ownerAt(x);
    return own < 0 ? options_.plain : borders.colors[std::size_t(own)];
}

/// How far a ray goes before it leaves what is drawn.
double Tracer::lengthTo(double length, const Vec3d& from, const Vec3d& way) const
{
    const double rise = way.dot(view_.toEye);
    if (!clips_ || rise <= 0.0) return length;
    const double left = top_ - (from - view_.center).dot(view_.toEye);
    return std::max(0.0, std::min(length, left / rise));
}

/// How many rays meet nothing. Embree makes tfar negative for those that do.
/// @param[in] lengths  of the rays to atoms; those in `rays` end where the surface is cut away
/// @param[in] among    whether only atoms are in the way
template<std::size_t count, typename Rays>
std::uint8_t Tracer::freeRays(const std::array<double, count>& lengths, bool among,
                              Rays& rays) const
{
    alignas(32) std::array<int, count> valid;
    valid.fill(-1);
    if (!among) occlude(valid.data(), surface_.scene.get(), rays);
    if (atoms_) {
        for (std::size_t k = 0; k < count; ++k) {
            valid[k] = rays.tfar[k] >= 0.0f ? -1 : 0;
            if (valid[k]) rays.tfar[k] = float(lengths[k]);
        }
        occlude(valid.data(), atoms_->scene.get(), rays);
    }
    return std::uint8_t(
        std::count_if(rays.tfar, rays.tfar + count, [](float left) { return left >= 0.0f; }));
}

/// Rays that reach the sky over a point (ambient occlusion). They are even over the disc below the
/// sky, by a golden spiral, and so weighted by the cosine (Malley's method). For every other ray
/// only what is near hides the sky, so that the insides of shells are not all dark.
std::uint8_t Tracer::skyRaysAt(const Vec3d& at, const Vec3d& normal, bool among, int pattern) const
{
    const auto [u, v] = perpendicular(normal);
    // Off the surface, lest rays meet it where they start.
    const Vec3d from = at + 1.5 * view_.pixel * normal + 1e-3 * view_.toEye;
    alignas(32) RTCRay8 rays{};
    std::array<double, skyRays> lengths;
    const double share = (double(pattern) + 0.5) / 16.0;
    for (std::size_t k = 0; k < skyRays; ++k) {
        const double r = std::sqrt((double(k) + share) / skyRays);
        const double angle = 2.0 * M_PI * (double(k) * golden + double(pattern * 7 % 16) / 16.0);
        const Vec3d way =
            r * std::cos(angle) * u + r * std::sin(angle) * v + std::sqrt(1.0 - r * r) * normal;
        lengths[k] = k % 2 ? nearby : std::numeric_limits<double>::infinity();
        setRay(rays, k, from, way, lengthTo(lengths[k], from, way));
    }
    return freeRays(lengths, among, rays);
}

/// Rays that reach the lamp, a disc: one to each ring of equal area, whose place in it varies with
/// the pattern.
std::uint8_t Tracer::lampRaysAt(const Vec3d& at, const Vec3d& normal, bool among, int pattern) const
{
    if (normal.dot(lamp_) <= 0.0) return 0;
    const auto [u, v] = perpendicular(lamp_);
    const Vec3d from = at + 1.5 * view_.pixel * normal + 1e-3 * view_.toEye;
    alignas(16) RTCRay4 rays{};
    std::array<double, lampRays> lengths;
    lengths.fill(std::numeric_limits<double>::infinity());
    for (std::size_t k = 0; k < lampRays; ++k) {
        const double share = (double(k) + (double(pattern) + 0.5) / 16.0) / lampRays;
        const double r = double(style_.lampSize) * std::sqrt(share);
        const double angle =
            2.0 * M_PI * (double(k) / lampRays + double(pattern * 7 % 16) / 16.0 * golden);
        const Vec3d way = (lamp_ + r * std::cos(angle) * u + r * std::sin(angle) * v).unit();
        setRay(rays, k, from, way, lengthTo(lengths[k], from, way));
    }
    return freeRays(lengths, among, rays);
}

} // namespace molsurf
