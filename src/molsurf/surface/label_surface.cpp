// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/label_surface.h"

#include "molsurf/analysis/measures/smooth_values.h"
#include "molsurf/kernel/balls/nearest_ball.h"
#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/show/color/curvature_colors.h"
#include "molsurf/show/color/label.h"
#include "molsurf/show/color/palette.h"
#include "molsurf/show/color/value_colors.h"
#include "molsurf/surface/field_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace molsurf
{

using openvdb::Vec3f;

namespace
{

/// Values that add up to a whole.
std::vector<double> scaled(std::vector<double> parts, double whole)
{
    double sum = 0.0;
    for (const double p : parts) sum += p;
    for (double& p : parts) p *= sum > 0.0 ? whole / sum : 0.0;
    return parts;
}

/// The sum of each group's balls, and at last of those without one.
std::vector<double> groupSums(const BallLabels& labels, const std::vector<double>& values)
{
    std::vector<double> out(labels.groups.size() + 1, 0.0);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::int32_t g = labels.groupOf[i];
        out[g < 0 ? labels.groups.size() : std::size_t(g)] += values[i];
    }
    return out;
}

/// The areas of the balls by the triangles at the vertices that they own.
std::vector<double> areasBy(const Labels& nearest, const BallSet& atoms, const Mesh& mesh,
                            double whole)
{
    Labels self(atoms.balls.size());
    std::iota(self.begin(), self.end(), 0);
    std::vector<double> areas = memberAreas(atoms.balls, self, self.size(), nearest, mesh);
    areas.pop_back(); // of no ball
    return scaled(std::move(areas), whole);
}

/// The mean of a scalar over the vertices of each ball, weighted by the area of the triangles at
/// them; NaN for a ball without a finite value.
std::vector<double> meansOf(const std::vector<float>& values, const Labels& nearest,
                            const Mesh& mesh, std::size_t balls)
{
    std::vector<double> sums(balls, 0.0), areas(balls, 0.0);
    for (const auto& t : mesh.triangles) {
        const auto corner = [&](int k) { return mesh.positions[t[k]]; };
        const double area = double((corner(1) - corner(0)).cross(corner(2) - corner(0)).length());
        for (int k = 0; k < 3; ++k) {
            const std::int32_t ball = nearest[t[k]];
            if (ball < 0 || !std::isfinite(values[t[k]])) continue;
            sums[std::size_t(ball)] += area * double(values[t[k]]);
            areas[std::size_t(ball)] += area;
        }
    }
    for (std::size_t i = 0; i < balls; ++i)
        sums[i] = areas[i] > 0.0 ? sums[i] / areas[i] : std::numeric_limits<double>::quiet_NaN();
    return sums;
}

/// The ball of each vertex, if anything depends on it, and areas of balls, if they are known.
struct Owned {
    Labels nearest;
    std::vector<double> areas;
};

void reportGroups(const BallSet& atoms, const SurfaceOptions& options, const Owned& owned,
                  double reach, Progress& progress, MolecularSurface& result)
{
    const BallLabels& labels = *atoms.labels;
    const std::size_t other = labels.groups.size();
    std::vector<double> area;
    if (owned.areas.empty()) {
        area = scaled(memberAreas(atoms.balls, labels.groupOf, other, owned.nearest, result.mesh),
                      result.report.surface.area);
    } else {
        area = groupSums(labels, owned.areas);
    }
    std::vector<double> volume(other + 1, std::numeric_limits<double>::quiet_NaN());
    if (result.surface) {
        std::vector<double> points(other + 1, 0.0);
        const std::vector<Vec3f> inside =
            pointsInside(*result.surface, result.report.surface.volume);
        for (const std::int32_t ball : nearestBalls(atoms.balls, inside, reach, progress)) {
            if (!atoms.placement.owns(ball)) continue;
            const std::int32_t g = ball < 0 ? -1 : labels.groupOf[std::size_t(ball)];
            points[g < 0 ? other : std::size_t(g)] += 1.0;
        }
        const bool none =
            std::all_of(points.begin(), points.end(), [](double n) { return n == 0.0; });
        volume = scaled(none ? area : points, result.report.surface.volume);
    }

    std::vector<Color> colors;
    if (options.color == ColorBy::Group) colors = groupColors(atoms, progress);
    std::size_t grouped = 0;
    for (std::size_t g = 0; g < other; ++g) {
        const Group& group = labels.groups[g];
        grouped += group.balls;
        result.report.groups.push_back(
            {group.name, group.balls, area[g], volume[g], colors.empty() ? "" : hexOf(colors[g])});
    }
    const std::size_t rest = atoms.whole() - grouped;
    if (rest > 0 || area[other] > 0.0) {
        result.report.groups.push_back(
            {"other", rest, area[other], volume[other], colors.empty() ? "" : hexOf(neutralColor)});
    }
}

/// Smooths the curvature that colours show.
void smoothCurvature(const SurfaceOptions& options, const Progress& progress, Mesh& mesh)
{
    const char* shown = curvatureNameOf(options.color);
    if (!shown || options.smoothColors == 0.0) return;
    for (Attribute<float>& scalar : mesh.scalars)
        if (scalar.name == shown) smoothValues(mesh, options.smoothColors, progress, scalar.values);
}

/// Adds the values that colours show to the vertices, and colours those that blend.
void colorByValue(const BallSet& atoms, const SurfaceOptions& options, const Labels& nearest,
                  double reach, const Progress& progress, Mesh& mesh)
{
    const BallValues& values = *atoms.labels->values;
    const PointValues points(atoms, outwardOf(atoms.coloring, options));
    std::vector<PointValue> found = vertexValues(points, values, nearest, reach, progress, mesh);
    if (options.smoothColors > 0.0) {
        std::vector<float> means;
        for (const PointValue& value : found) means.push_back(value.known());
        smoothValues(mesh, options.smoothColors, progress, means);
        for (std::size_t v = 0; v < found.size(); ++v)
            if (std::isfinite(means[v])) found[v].value = means[v];
    }
    addValues(values, points, found, mesh);
}

/// Adds labels, colours and the grids of balls to the result, each of them if it is asked for.
/// @param[in] known  as of labelSurface()
Owned label(const BallSet& atoms, const SurfaceOptions& options, std::vector<double> known,
            double reach, Progress& progress, MolecularSurface& result)
{
    Mesh& mesh = result.mesh;
    const bool grouped = atoms.labels && !atoms.labels->groups.empty();
    smoothCurvature(options, progress, mesh);
    colorByCurvature(options.color, atoms.coloring, mesh);
    const bool colored = options.color != ColorBy::Nothing && mesh.colors.empty();
    Owned owned{{}, std::move(known)};
    Labels& nearest = owned.nearest;
    const bool areas = options.ballAreas && owned.areas.empty();
    if (options.meshLabels || grouped || colored || areas)
        nearest = nearestBalls(atoms.balls, mesh.positions, reach, progress);
    if (options.meshLabels) labelVertices(atoms, nearest, mesh);
    if (areas) owned.areas = areasBy(nearest, atoms, mesh, result.report.surface.area);
    std::vector<Color> ballColor;
    if (colored)
        ballColor =
            atoms.colors.empty() ? ballColors(atoms, options.color, progress) : atoms.colors;
    FieldSource source{atoms, options, result, colored ? &ballColor : nullptr, reach, progress};
    for (const FieldRow& row : fieldTable()) {
        if (!row.ofBalls || !hasField(options.fields, row.name)) continue;
        if (auto grid = row.ofBalls(source)) result.fields.push_back(std::move(grid));
    }
    if (!colored) return owned;
    mesh.colors = colorsOf(nearest, ballColor);
    for (std::string& warning : colorWarnings(atoms, options.color))
        result.report.warnings.push_back(std::move(warning));
    if (options.color == ColorBy::Value && atoms.labels && atoms.labels->values) {
        colorByValue(atoms, options, nearest, reach, progress, mesh);
        const std::vector<float>& values = mesh.scalars.back().values;
        if (std::none_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); }))
            result.report.warnings.push_back(atoms.labels->values->title +
                                             ": no point of the surface has one, all is grey");
        const BallValues& own = *atoms.labels->values;
        if (options.ballAreas && own.byPoint())
            result.ballValues = meansOf(values, nearest, mesh, atoms.balls.size());
        else if (options.ballAreas)
            result.ballValues.assign(own.valueOf.begin(), own.valueOf.end());
    }
    return owned;
}

} // namespace

std::vector<double> areasOnMesh(const BallSet& atoms, const Mesh& mesh, double area, double reach,
                                const Progress& progress)
{
    return areasBy(nearestBalls(atoms.balls, mesh.positions, reach, progress), atoms, mesh, area);
}

std::vector<double> labelSurface(const BallSet& atoms, const SurfaceOptions& options,
                                 std::vector<double> known, double reach, Progress& progress,
                                 MolecularSurface& result)
{
    Owned owned = result.surface ? label(atoms, options, std::move(known), reach, progress, result)
                                 : Owned{{}, std::move(known)};
    const bool measured = !result.surface || !result.mesh.triangles.empty();
    if (measured && atoms.labels && !atoms.labels->groups.empty())
        reportGroups(atoms, options, owned, reach, progress, result);
    return std::move(owned.areas);
}

void labelPart(const BallSet& atoms, const SurfaceOptions& options, double reach,
               Progress& progress, MolecularSurface& result)
{
    const Labels nearest = label(atoms, options, {}, reach, progress, result).nearest;
    if (!atoms.labels || atoms.labels->groups.empty()) return;
    const std::vector<Group>& groups = atoms.labels->groups;
    const std::vector<double> areas =
        memberAreas(atoms.balls, atoms.labels->groupOf, groups.size(), nearest, result.mesh);
    const bool colored = options.color == ColorBy::Group && !atoms.colors.empty();
    const std::vector<std::int32_t>& groupOf = atoms.labels->groupOf;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const auto ball =
            std::find(groupOf.begin(), groupOf.end(), std::int32_t(g)) - groupOf.begin();
        const bool known = colored && std::size_t(ball) < groupOf.size();
        result.report.groups.push_back({groups[g].name, groups[g].balls, areas[g], 0.0,
                                        known ? hexOf(atoms.colors[std::size_t(ball)]) : ""});
    }
    result.report.groups.push_back(
        {"other", 0, areas.back(), 0.0, colored ? hexOf(neutralColor) : ""});
}

} // namespace molsurf
