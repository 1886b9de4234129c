// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/picture/view.h"

#include "molsurf/show/io/part_ranges.h"
#include "molsurf/show/picture/atom_model.h"

#include <openvdb/math/Mat3.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace molsurf
{

using openvdb::Vec3d;
using openvdb::Vec3f;

namespace
{

constexpr double border = 1.04; // width of the picture over that of the molecule

constexpr int manyDirections = 400;

/// One of some directions, by a golden spiral.
Vec3f spiralWay(int k, int directions)
{
    const double z = 1.0 - (2.0 * k + 1.0) / directions, r = std::sqrt(1.0 - z * z);
    const double angle = 2.0 * M_PI * 0.6180339887498949 * k;
    return {float(r * std::cos(angle)), float(r * std::sin(angle)), float(z)};
}

/// The vertices of a part that lie farthest out in some directions.
std::vector<Vec3d> outermost(const Mesh& mesh, const PartRange& part, int directions)
{
    std::vector<Vec3d> out;
    for (int k = 0; k < directions; ++k) {
        const Vec3f way = spiralWay(k, directions);
        std::size_t farthest = part.firstVertex;
        for (std::size_t v = part.firstVertex; v < part.vertexEnd; ++v) {
            if (mesh.positions[v].dot(way) > mesh.positions[farthest].dot(way)) farthest = v;
        }
        out.push_back(Vec3d(mesh.positions[farthest]));
    }
    return out;
}

/// Calls a function for each of some points, which need not lie in memory: copies have many.
using Points = std::function<void(const std::function<void(const Vec3d&)>&)>;

Points pointsOf(const std::vector<Vec3d>& points)
{
    return [&points](const auto& f) { std::for_each(points.begin(), points.end(), f); };
}

/// A ball that has to be in the picture; of a vertex the radius is 0.
struct Extent {
    Vec3d center;
    double radius;
};

/// The ends of the shapes of a unit.
std::vector<Extent> extentsOf(const AtomUnit& unit)
{
    std::vector<Extent> out;
    const auto add = [&](const openvdb::Vec4f& ball) {
        out.push_back({Vec3d(ball[0], ball[1], ball[2]), double(ball[3])});
    };
    for (const openvdb::Vec4f& ball : unit.balls) add(ball);
    for (const auto& ends : unit.sticks)
        for (const openvdb::Vec4f& end : ends) add(end);
    for (const Vec3f& p : unit.mesh.positions) out.push_back({Vec3d(p), 0.0});
    return out;
}

/// Those that reach farthest out in some directions.
std::vector<Extent> outermost(const std::vector<Extent>& all)
{
    std::vector<std::size_t> far;
    for (int k = 0; k < manyDirections; ++k) {
        const Vec3d way(spiralWay(k, manyDirections));
        const auto reach = [&](const Extent& x) { return x.center.dot(way) + x.radius; };
        far.push_back(std::size_t(std::max_element(all.begin(), all.end(),
                                                   [&](const Extent& a, const Extent& b) {
                                                       return reach(a) < reach(b);
                                                   }) -
                                  all.begin()));
    }
    std::sort(far.begin(), far.end());
    far.erase(std::unique(far.begin(), far.end()), far.end());
    std::vector<Extent> out;
    for (const std::size_t i : far) out.push_back(all[i]);
    return out;
}

/// What spans that which is shown: the vertices, or of copies the outermost ones, and atoms.
class Span
{
public:
    Span(const Mesh& mesh, const DrawOptions& options) : mesh_(mesh), options_(options)
    {
        if (!options.instances.empty())
            for (const PartRange& part : partRanges(mesh, ""))
                parts_.push_back(outermost(mesh, part, manyDirections));
        if (!options.model) return;
        std::vector<std::size_t> copies(options.model->units.size(), 0);
        for (const MeshInstance& copy : options.model->copies) ++copies[copy.part];
        for (std::size_t u = 0; u < copies.size(); ++u) {
            units_.push_back(extentsOf(options.model->units[u]));
            if (copies[u] > 1) units_[u] = outermost(units_[u]);
        }
    }

    /// Calls f(center, radius).
    template<typename F>
    void forEach(const F& f) const
    {
        if (options_.instances.empty())
            for (const Vec3f& p : mesh_.positions) f(Vec3d(p), 0.0);
        for (const MeshInstance& copy : options_.instances)
            for (const Vec3d& x : parts_[copy.part]) f(copy.placed(x), 0.0);
        if (!options_.model) return;
        for (const MeshInstance& copy : options_.model->copies)
            for (const auto& [x, radius] : units_[copy.part]) f(copy.placed(x), radius);
        for (const Vec3f& p : options_.model->bodies.mesh.positions) f(Vec3d(p), 0.0);
    }

private:
    const Mesh& mesh_;
    const DrawOptions& options_;
    std::vector<std::vector<Vec3d>> parts_;  ///< of the mesh, if there are copies
    std::vector<std::vector<Extent>> units_; ///< of the model
};

/// The points whose principal axes make the automatic view.
Points aboutOf(const Span& span, const DrawOptions& options)
{
    if (!options.about.empty()) return pointsOf(options.about);
    if (options.aboutParts.empty())
        return [&span](const auto& f) { span.forEach([&](const Vec3d& x, double) { f(x); }); };
    return [&options](const auto& f) {
        for (const MeshInstance& copy : options.instances)
            for (const Vec3d& x : options.aboutParts[copy.part]) f(copy.placed(x));
    };
}

/// Principal axes of points, those of their covariance, the longest first. The largest component of
/// each is positive, lest signs be left to chance.
std::array<Vec3d, 3> principalAxes(const Points& points)
{
    Vec3d mean(0.0);
    std::size_t count = 0;
    points([&](const Vec3d& p) {
        mean += p;
        ++count;
    });
    mean /= double(count);
    openvdb::Mat3d covariance = openvdb::Mat3d::zero();
    points([&](const Vec3d& p) {
        const Vec3d d = p - mean;
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) covariance(i, j) += d[i] * d[j];
        }
    });
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

/// The part of a point that is level.
Vec3d level(const Vec3d& x, const Vec3d& up)
{
    return x - x.dot(up) * up;
}

/// The direction to the right of a view with something upright.
/// @param[in] toEye  zero: the longest level extent lies across
Vec3d rightOf(const Points& points, const Vec3d& up, const Vec3d& toEye)
{
    constexpr double least = 1e-3; // sine of the angle between the two
    if (toEye.lengthSqr() > 0.0 && up.cross(toEye.unit()).length() > least)
        return up.cross(toEye).unit();
    const Points levelled = [&](const auto& f) {
        points([&](const Vec3d& x) { f(level(x, up)); });
    };
    const Vec3d across = level(principalAxes(levelled)[0], up);
    return across.length() > least ? across.unit() : level(Vec3d(up[1], up[2], up[0]), up).unit();
}

/// viewAxes() of points.
std::array<Vec3d, 3> axesOf(const Points& points, const DrawOptions& options)
{
    Vec3d right, toEye;
    if (options.upright.lengthSqr() > 0.0) {
        const Vec3d upward = options.upright.unit();
        right = rightOf(points, upward, options.toEye);
        toEye = right.cross(upward);
    } else if (options.toEye.lengthSqr() > 0.0) {
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

/// The part of space that shows an extent [Å].
PictureFrame frameOf(const Vec3d& center, double across, double upward)
{
    return {center, border * across, border * across * std::clamp(upward / across, 0.2, 4.0)};
}

/// The extent of points as they are seen.
openvdb::BBoxd seenBox(const std::vector<Vec3d>& points, const std::array<Vec3d, 3>& axes)
{
    openvdb::BBoxd box;
    for (const Vec3d& x : points) box.expand(Vec3d(x.dot(axes[0]), x.dot(axes[1]), x.dot(axes[2])));
    return box;
}

/// The point that is seen at a place.
Vec3d pointAt(const Vec3d& seen, const std::array<Vec3d, 3>& axes)
{
    return seen[0] * axes[0] + seen[1] * axes[1] + seen[2] * axes[2];
}

/// The square frame that DrawOptions::zoom asks for.
PictureFrame zoomFrame(const std::array<Vec3d, 3>& axes, const DrawOptions& options)
{
    constexpr double filled = 0.8;
    constexpr double least = 4.0; // of a single atom, which has no extent [Å]
    const openvdb::BBoxd box = seenBox(options.zoom, axes);
    const Vec3d extent = box.extents(), center = pointAt(box.getCenter(), axes);
    double across = extent[0];
    if (options.turn != 0.0 || options.turnable) // the same scale for all turns
        for (const Vec3d& x : options.zoom)
            across = std::max(across, 2.0 * level(x - center, axes[1]).length());
    const double side = std::max({across, extent[1], least}) / filled;
    return {center, side, side};
}

} // namespace

void keepView(std::size_t count, const std::function<std::vector<Vec3d>(std::size_t)>& setOf,
              double margin, DrawOptions& options)
{
    const std::vector<Vec3d> first = setOf(0);
    const std::array<Vec3d, 3> axes = axesOf(pointsOf(first), options);
    openvdb::BBoxd box;
    for (std::size_t i = 0; i < count; ++i) box.expand(seenBox(setOf(i), axes));
    const Vec3d extent = box.extents() + Vec3d(2.0 * margin);
    options.up = axes[1];
    options.toEye = axes[2];
    options.upright = Vec3d(0.0);
    options.turn = 0.0;
    options.frame = options.zoom.empty()
                        ? frameOf(pointAt(box.getCenter(), axes), extent[0], extent[1])
                        : zoomFrame(axes, options);
    options.zoom.clear(); // lest a cut comes and goes
}

View chooseView(const Mesh& mesh, const DrawOptions& options)
{
    View view;
    const Span span(mesh, options);
    const std::array<Vec3d, 3> axes = axesOf(aboutOf(span, options), options);
    view.right = axes[0];
    view.up = axes[1];
    view.toEye = axes[2];

    // A turn must not change the scale, so the extent across is that of all turns.
    Vec3d low(std::numeric_limits<double>::max()), high(-low);
    double reach = 0.0;
    span.forEach([&](const Vec3d& x, double radius) {
        const Vec3d seen(x.dot(view.right), x.dot(view.up), x.dot(view.toEye));
        low = openvdb::math::minComponent(low, seen - Vec3d(radius));
        high = openvdb::math::maxComponent(high, seen + Vec3d(radius));
    });
    std::vector<Vec3d> places; // of notes, which are in the frame but move no cut
    for (const PictureNote& note : options.notes) {
        places.push_back(note.from);
        if (note.to) places.push_back(*note.to);
    }
    for (const Vec3d& x : places) {
        const Vec3d seen(x.dot(view.right), x.dot(view.up), 0.0);
        for (int a = 0; a < 2; ++a) {
            low[a] = std::min(low[a], seen[a]);
            high[a] = std::max(high[a], seen[a]);
        }
    }
    const Vec3d mid = 0.5 * (low + high), extent = high - low;
    view.center = pointAt(mid, axes);
    if (options.turn != 0.0 || options.turnable) {
        const auto turnWith = [&](const Vec3d& p, double radius) {
            const Vec3d d = p - view.center;
            reach = std::max(reach, std::hypot(d.dot(view.right), d.dot(view.toEye)) + radius);
        };
        span.forEach(turnWith);
        for (const Vec3d& x : places) turnWith(x, 0.0);
    }
    const double across = std::max(extent[0], 2.0 * reach), upward = extent[1];
    PictureFrame frame = frameOf(view.center, across, upward);
    view.low = -0.5 * extent[2];
    view.far = 0.5 * extent[2];
    if (options.frame || !options.zoom.empty()) {
        frame = options.frame ? *options.frame : zoomFrame(axes, options);
        const double behind = (frame.center - view.center).dot(view.toEye);
        view.low -= behind;
        view.far -= behind;
        view.center = frame.center;
    }
    view.width = options.width;
    view.pixel = frame.width / view.width;
    view.height = std::max(1, int(std::lround(view.width * frame.height / frame.width)));
    return view;
}

std::optional<double> clipBefore(const Mesh& mesh, const View& view, const DrawOptions& options)
{
    if (options.clip || options.zoom.empty() || options.turnable || !options.instances.empty())
        return std::nullopt;
    // The site's own surface lies within a radius and a probe in front of its centres.
    constexpr double own = 3.5; // [Å]
    const std::array<Vec3d, 3> axes = {view.right, view.up, view.toEye};
    const openvdb::BBoxd box = seenBox(options.zoom, axes);
    const auto hides = [&](const Vec3f& p) {
        const Vec3d x(p);
        const double a = x.dot(axes[0]), b = x.dot(axes[1]);
        return x.dot(axes[2]) > box.max()[2] + own && a >= box.min()[0] && a <= box.max()[0] &&
               b >= box.min()[1] && b <= box.max()[1];
    };
    if (std::none_of(mesh.positions.begin(), mesh.positions.end(), hides)) return std::nullopt;
    return box.getCenter()[2] - view.center.dot(view.toEye);
}

std::array<Vec3d, 3> viewAxes(const Mesh& mesh, const DrawOptions& options)
{
    return axesOf(aboutOf(Span(mesh, options), options), options);
}

} // namespace molsurf
