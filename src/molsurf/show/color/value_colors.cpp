// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/color/value_colors.h"

#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/molecule/selection/scalar_map.h"
#include "molsurf/show/color/palette.h"

#include <openvdb/tree/LeafManager.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

constexpr double softness = 3.0;             // s of the weights [Å^2]
constexpr double farthestE = 8.0 * softness; // balls beyond this weigh nothing [Å^2]
constexpr float missing = std::numeric_limits<float>::quiet_NaN();

Color colorOn(const ColorScale& scale, float value)
{
    if (!std::isfinite(value)) return noValueColor;
    return scale.high > scale.low ? scale.at(double(value)) : neutralColor;
}

double powerOf(const Ball& ball, const Vec3d& x)
{
    return (x - Vec3d(ball.center)).lengthSqr() - ball.radius * ball.radius;
}

} // namespace

ColorScale scaleOf(const BallValues& values)
{
    return scaleOf(values.palette, values.low, values.high);
}

bool isFlat(const BallValues& values)
{
    return values.flat || findPalette(values.palette)->steps;
}

bool isBlended(const BallSet& atoms, ColorBy by)
{
    if (by != ColorBy::Value || !atoms.labels || !atoms.labels->values) return false;
    const BallValues& values = *atoms.labels->values;
    return values.byPoint() || !isFlat(values);
}

std::vector<Color> valueColors(const BallValues& values)
{
    const ColorScale scale = scaleOf(values);
    std::vector<Color> out;
    out.reserve(values.valueOf.size());
    for (const float v : values.valueOf) out.push_back(colorOn(scale, v));
    return out;
}

PointValues::PointValues(const std::vector<Ball>& balls, const BallValues& values, double outward)
    : values_(values), index_(balls, {0.5, 0.0, 2.0}), scale_(scaleOf(values_)),
      smallest_(std::numeric_limits<double>::max()), outward_(outward)
{
    for (const Ball& ball : balls) smallest_ = std::min(smallest_, ball.radius);
}

PointValue PointValues::at(const Vec3d& x, const Vec3d& normal, double reach) const
{
    if (!values_.byPoint()) return blended(x, reach);
    const float value = values_.field ? values_.field->at(x + outward_ * normal)
                                      : float((x - *values_.centre).length());
    return {value, std::isfinite(value) ? 1.0f : 0.0f};
}

/// The weighted mean over balls, in three steps: a bound of the least power from some ball near,
/// the least power, and the sums.
PointValue PointValues::blended(const Vec3d& x, double reach) const
{
    // An upper bound of the least power, from the first balls that a growing search meets.
    double least = std::numeric_limits<double>::max();
    for (double within = 0.5; least == std::numeric_limits<double>::max(); within *= 2.0) {
        index_.forEachNear(x, x, within, [&](const Ball& ball, std::int32_t) {
            least = std::min(least, powerOf(ball, x));
        });
        if (within >= reach) break;
    }
    if (least == std::numeric_limits<double>::max()) return {missing, 0.0f};
    // A ball of radius r farther off than gap has more power than (r + gap)^2 - r^2, which for the
    // smallest r, and so for each, is at least `power`.
    const double power = std::max(least, 0.0) + farthestE;
    const double gap = std::sqrt(smallest_ * smallest_ + power) - smallest_;
    index_.forEachNear(x, x, gap, [&](const Ball& ball, std::int32_t) {
        least = std::min(least, powerOf(ball, x));
    });
    const double none = std::exp(-farthestE / softness); // less this, weights end at 0
    double all = 0.0, known = 0.0, sum = 0.0;
    index_.forEachNear(x, x, gap, [&](const Ball& ball, std::int32_t i) {
        const double e = powerOf(ball, x) - least;
        if (e >= farthestE) return;
        const double weight = std::exp(-e / softness) - none;
        const float value = values_.valueOf[std::size_t(i)];
        all += weight;
        if (!std::isfinite(value)) return;
        known += weight;
        sum += weight * double(value);
    });
    if (known == 0.0) return {missing, 0.0f};
    return {float(sum / known), float(known / all)};
}

Color PointValues::colorOf(const PointValue& value) const
{
    Color out = colorOn(scale_, value.value);
    for (std::size_t c = 0; c < out.size(); ++c)
        out[c] = std::uint8_t(std::lround(value.share * float(out[c]) +
                                          (1.0f - value.share) * float(noValueColor[c])));
    return out;
}

std::vector<PointValue> PointValues::on(const openvdb::BoolGrid& voxels,
                                        const openvdb::FloatGrid& surface, double reach,
                                        const Progress& progress) const
{
    const openvdb::tree::LeafManager<const openvdb::BoolTree> leaves(voxels.tree());
    std::vector<std::size_t> first = {0}; // of each leaf
    for (std::size_t n = 0; n < leaves.leafCount(); ++n)
        first.push_back(first[n] + leaves.leaf(n).onVoxelCount());
    std::vector<PointValue> out(first.back());
    const double h = surface.voxelSize()[0];
    parallelFor(leaves.leafCount(), progress, [&](std::size_t n) {
        const auto from = surface.getConstAccessor();
        PointValue* value = out.data() + first[n];
        for (auto voxel = leaves.leaf(n).cbeginValueOn(); voxel; ++voxel) {
            const openvdb::Coord at = voxel.getCoord();
            Vec3d normal(0.0); // by differences of the distance
            for (int a = 0; a < 3; ++a) {
                openvdb::Coord step(0);
                step[a] = 1;
                normal[a] = double(from.getValue(at + step)) - double(from.getValue(at - step));
            }
            if (normal.lengthSqr() > 0.0) normal.normalize();
            // From the voxel to the surface, beside which it lies.
            const Vec3d x = at.asVec3d() * h - double(from.getValue(at)) * normal;
            *value++ = this->at(x, normal, reach);
        }
    });
    return out;
}

std::vector<PointValue> vertexValues(const PointValues& points, const BallValues& values,
                                     const Labels& nearest, double reach, const Progress& progress,
                                     const Mesh& mesh)
{
    const bool flat = isFlat(values) && !values.byPoint();
    std::vector<PointValue> out(mesh.positions.size(), {missing, 0.0f});
    constexpr std::size_t chunk = 64;
    parallelFor((out.size() + chunk - 1) / chunk, progress, [&](std::size_t c) {
        const std::size_t end = std::min(out.size(), (c + 1) * chunk);
        for (std::size_t v = c * chunk; v < end; ++v) {
            if (!flat)
                out[v] = points.at(Vec3d(mesh.positions[v]), Vec3d(mesh.normals[v]), reach);
            else if (nearest[v] >= 0)
                out[v] = {values.valueOf[std::size_t(nearest[v])], 1.0f};
        }
    });
    return out;
}

void addValues(const BallValues& values, const PointValues& points,
               const std::vector<PointValue>& ofVertices, Mesh& mesh)
{
    const bool colors = !isFlat(values) || values.byPoint();
    Attribute<float>& out = mesh.scalars.emplace_back();
    out.name = values.name;
    for (std::size_t v = 0; v < ofVertices.size(); ++v) {
        out.values.push_back(ofVertices[v].known());
        if (colors) mesh.colors[v] = points.colorOf(ofVertices[v]);
    }
}

double outwardOf(const Coloring& coloring, const SurfaceSpec& spec)
{
    const KindRow& row = rowOf(spec.kind);
    const bool out = row.hasProbe && !row.hasOffset; // already
    return coloring.potentialOffset.value_or(out ? 0.0 : spec.probe);
}

} // namespace molsurf
