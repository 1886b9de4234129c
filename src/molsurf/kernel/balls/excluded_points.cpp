// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/excluded_points.h"

#include "molsurf/kernel/balls/ball_index.h"
#include "molsurf/kernel/balls/toric_tube.h"
#include "molsurf/kernel/core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

/// A direction of the golden spiral, which gives each the same part of the sphere.
Vec3d spiral(std::size_t k, std::size_t count)
{
    constexpr double golden = 0.6180339887498949;
    const double z = 1.0 - (2.0 * double(k) + 1.0) / double(count);
    const double across = std::sqrt((1.0 - z) * (1.0 + z)), angle = 2.0 * M_PI * golden * double(k);
    return {across * std::cos(angle), across * std::sin(angle), z};
}

using Spread = ExcludedSampler::Spread;

/// The golden spiral, its directions in the order of a space-filling curve.
Spread spreadOf(std::size_t count)
{
    std::vector<Ball> ends(count);
    for (std::size_t k = 0; k < count; ++k) ends[k] = {spiral(k, count), 0.0, 0};
    Spread out;
    for (const std::int32_t k : spatialOrder(ends))
        out.directions.push_back(ends[std::size_t(k)].center);
    for (std::size_t begin = 0; begin < count; begin += Spread::run) {
        const std::size_t end = std::min(begin + Spread::run, count);
        openvdb::BBoxd box;
        for (std::size_t k = begin; k < end; ++k) box.expand(out.directions[k]);
        out.runs.push_back({box.getCenter(), 0.5 * box.extents().length(), 0});
    }
    return out;
}

/// @param[in] wanted  whether a ball may hold points that are wanted
void addContact(const BallBoundary& boundary, const Patch& patch, double probe,
                const Spread& spread, const ExcludedSampler::Counts& wanted, ExcludedPoints& out)
{
    const double r = patch.radius - probe;
    const std::size_t count = spread.directions.size();
    const double area = 4.0 * M_PI * r * r / double(count);
    for (std::size_t n = 0; n < spread.runs.size(); ++n) {
        const Ball& about = spread.runs[n];
        if (!wanted(patch.centre + r * about.center, r * about.radius)) continue;
        const std::size_t end = std::min((n + 1) * Spread::run, count);
        for (std::size_t k = n * Spread::run; k < end; ++k) {
            const Vec3d& u = spread.directions[k];
            if (!isCovered(boundary, patch, u)) out.push_back({patch.centre + r * u, u, area});
        }
    }
}

/// Adds points of the toric face of an arc, in rings of about `density` points an Å^2. A face that
/// meets itself has two bands.
void addToric(const BallBoundary& boundary, const Arc& arc, double probe, double density,
              ExcludedPoints& out)
{
    const Tube tube = tubeOf(boundary, arc, probe);
    const Vec3d across = arc.axis.cross(arc.middle);
    const double steps = std::sqrt(density); // a length
    const auto addBand = [&](double from, double to) {
        const auto rings = std::size_t(std::ceil(std::max((to - from) * probe * steps, 0.0)));
        for (std::size_t k = 0; k < rings; ++k) {
            const double width = (to - from) / double(rings), low = from + double(k) * width;
            const double f = low + 0.5 * width, radius = arc.radius - probe * std::cos(f);
            const auto count =
                std::size_t(std::max(1.0, std::round(2.0 * arc.half * radius * steps)));
            const double area = areaOf(arc, probe, low, low + width) / double(count);
            for (std::size_t i = 0; i < count; ++i) {
                const double e = arc.half * ((2.0 * double(i) + 1.0) / double(count) - 1.0);
                const Vec3d aside = std::cos(e) * arc.middle + std::sin(e) * across;
                out.push_back({arc.centre + radius * aside + probe * std::sin(f) * arc.axis,
                               std::cos(f) * aside - std::sin(f) * arc.axis, area});
            }
        }
    };
    if (!tube.isCut()) return addBand(tube.low, tube.high);
    addBand(tube.low, -tube.cusp);
    addBand(tube.cusp, tube.high);
}

/// Spreads points over the parts of probes that rest on three balls.
class Concave
{
public:
    /// @param[in] spread  over the sphere of a probe
    Concave(const BallBoundary& boundary, double probe, const Spread& spread)
        : boundary_(boundary), probe_(probe), directions_(spread.directions),
          centres_(centresOf(boundary), {0.0, 0.0, 2.0})
    {
    }

    /// Adds the part of the probe at a corner that faces the triangle of its three balls, less what
    /// lies in another probe.
    void add(const Corner& corner, ExcludedPoints& out) const
    {
        std::array<Vec3d, 3> to, planes; // to the balls; normals of the sides, inward
        for (std::size_t k = 0; k < 3; ++k)
            to[k] = boundary_.balls[std::size_t(corner.balls[k])].centre() - corner.position;
        for (std::size_t k = 0; k < 3; ++k) {
            planes[k] = to[k].cross(to[(k + 1) % 3]);
            if (planes[k].dot(to[(k + 2) % 3]) < 0.0) planes[k] = -planes[k];
        }
        std::vector<Vec3d> others; // ways to the probes that may cut this one
        centres_.forEachNear(corner.position, corner.position, 2.0 * probe_,
                             [&](const Ball& other, std::int32_t) {
                                 const Vec3d way = Vec3d(other.center) - corner.position;
                                 const double square = way.lengthSqr();
                                 if (square > 0.0 && square < 4.0 * probe_ * probe_)
                                     others.push_back(way);
                             });
        const double area = 4.0 * M_PI * probe_ * probe_ / double(directions_.size());
        for (const Vec3d& u : directions_) {
            const bool within = std::all_of(planes.begin(), planes.end(),
                                            [&](const Vec3d& p) { return p.dot(u) > 0.0; });
            if (!within || isCut(others, u)) continue;
            out.push_back({corner.position + probe_ * u, -u, area});
        }
    }

private:
    static std::vector<Ball> centresOf(const BallBoundary& boundary)
    {
        std::vector<Ball> out(boundary.corners.size());
        for (std::size_t c = 0; c < out.size(); ++c) out[c].center = boundary.corners[c].position;
        return out;
    }

    /// Whether another probe is nearer to the point in a direction.
    bool isCut(const std::vector<Vec3d>& others, const Vec3d& u) const
    {
        return std::any_of(others.begin(), others.end(), [&](const Vec3d& way) {
            return 2.0 * probe_ * u.dot(way) > way.lengthSqr();
        });
    }

    const BallBoundary& boundary_;
    double probe_;
    const std::vector<Vec3d>& directions_;
    BallIndex centres_;
};

} // namespace

const Spread& ExcludedSampler::spreadOver(double radius)
{
    const auto count = std::size_t(std::ceil(4.0 * M_PI * radius * radius * density_));
    Spread& spread = spreads_[count];
    if (spread.directions.empty()) spread = spreadOf(count);
    return spread;
}

ExcludedPoints ExcludedSampler::of(const BallBoundary& boundary, const Progress& progress,
                                   const Counts& counts)
{
    const std::size_t patches = boundary.patches.size(), arcs = boundary.arcs.size();
    std::vector<const Spread*> spreads; // of patches
    for (const Patch& patch : boundary.patches)
        spreads.push_back(&spreadOver(std::max(patch.radius - probe_, 0.0)));
    const Concave concave(boundary, probe_, spreadOver(probe_));
    const Counts wanted = counts ? counts : [](const Vec3d&, double) { return true; };
    return parallelCollect<ExcludedPoint>(
        patches + arcs + boundary.corners.size(), progress,
        [&](std::size_t i, ExcludedPoints& out) {
            if (i < patches) {
                const Patch& patch = boundary.patches[i];
                if (wanted(patch.centre, std::max(patch.radius - probe_, 0.0)))
                    addContact(boundary, patch, probe_, *spreads[i], wanted, out);
            } else if (i < patches + arcs) {
                const Arc& arc = boundary.arcs[i - patches];
                if (wanted(arc.centre, arc.radius + probe_))
                    addToric(boundary, arc, probe_, density_, out);
            } else {
                const Corner& corner = boundary.corners[i - patches - arcs];
                if (wanted(corner.position, probe_)) concave.add(corner, out);
            }
        });
}

} // namespace molsurf
