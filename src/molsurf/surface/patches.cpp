// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/patches.h"

#include "molsurf/analysis/measures/patches.h"
#include "molsurf/analysis/measures/smooth_values.h"
#include "molsurf/kernel/balls/nearest_ball.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/kernel/pipeline/influence.h"
#include "molsurf/kernel/pipeline/surface_run.h"
#include "molsurf/show/color/color_table.h"
#include "molsurf/show/color/value_colors.h"
#include "molsurf/surface/pockets.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace molsurf
{

namespace
{

/// The values of the vertices.
/// @param[in] nearest  ball of each
std::vector<float> patchValues(const BallSet& atoms, const SurfaceOptions& options,
                               const Labels& nearest, double reach, const Progress& progress,
                               const Mesh& mesh)
{
    const ColorKind& kind = kindOf(options.patches->by);
    std::vector<float> out;
    if (kind.ofCurvature) {
        for (const Attribute<float>& scalar : mesh.scalars)
            if (scalar.name == kind.attribute) out = scalar.values;
    } else {
        const BallValues& values = *atoms.labels->patchValues;
        const PointValues points(atoms.balls, values, outwardOf(atoms.coloring, options));
        for (const PointValue& value : vertexValues(points, values, nearest, reach, progress, mesh))
            out.push_back(value.known());
    }
    const bool isSmooth = kind.ofCurvature && kind.by == options.color; // by labelSurface()
    if (options.smoothColors > 0.0 && !isSmooth)
        smoothValues(mesh, options.smoothColors, progress, out);
    return out;
}

/// Labels and colours the vertices by their patches, the largest in colours of their own.
void colorPatches(const FoundPatches& found, Mesh& mesh)
{
    Attribute<std::int32_t> label{"patch", found.patchOf, {"elsewhere"}};
    for (const Report::Patches::Patch& patch : found.list)
        label.names.push_back(formatted("%zu: %.0f Å²", label.names.size(), patch.area));
    mesh.colors.clear();
    for (const std::int32_t number : found.patchOf)
        mesh.colors.push_back(number > 0 ? pocketColor(std::size_t(number)) : neutralColor);
    mesh.labels.push_back(std::move(label));
}

} // namespace

void addPatches(const BallSet& atoms, const SurfaceOptions& options, Progress& progress,
                MolecularSurface& result)
{
    Stopwatch watch(result.report);
    progress.update("patches", 0.0);
    const Products::PatchRule& rule = *options.patches;
    const Mesh& mesh = result.mesh;
    const double reach = Influence(atoms, options).ofLabel();
    const Labels nearest = nearestBalls(atoms.balls, mesh.positions, reach, progress);
    FoundPatches found = findPatches(
        mesh, patchValues(atoms, options, nearest, reach, progress, mesh), rule, nearest);
    if (options.color == ColorBy::Patch) colorPatches(found, result.mesh);
    const std::string value =
        rule.by == ColorBy::Value ? atoms.labels->patchValues->name : kindOf(rule.by).attribute;
    result.report.patches = Report::Patches{value, rule.above, rule.level, std::move(found.list)};
    watch.stop("patches");
}

} // namespace molsurf
