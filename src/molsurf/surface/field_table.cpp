// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/field_table.h"

#include "molsurf/kernel/grid/grid_like.h"
#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/kernel/pipeline/surface_run.h"
#include "molsurf/kernel/spline/curvature.h"
#include "molsurf/show/color/color_table.h"
#include "molsurf/show/color/palette.h"
#include "molsurf/surface/product_table.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace molsurf
{

FieldSource::Voxels& FieldSource::of(bool colored)
{
    const bool inside = colored && hasField(options.fields, "density");
    Voxels& voxels = found[inside];
    if (!voxels.grid) voxels.grid = shownVoxels(*result.surface, inside);
    return voxels;
}

const Labels& FieldSource::owners(bool colored)
{
    Voxels& voxels = of(colored);
    if (!voxels.owners) voxels.owners = ownersOf(*voxels.grid, atoms.balls, reach, progress);
    return *voxels.owners;
}

namespace
{

using openvdb::GridBase;

/// A row of what the balls have.
FieldRow fromBalls(const char* name, int values, GridBase::Ptr (*make)(FieldSource& from))
{
    FieldRow row{name, values, BySymmetry | InClosedForm};
    row.ofBalls = make;
    return row;
}

GridBase::Ptr labelGrid(FieldSource& from, const char* name, const Labels& labelOf)
{
    const Labels labels = labelsOf(from.owners(false), labelOf);
    return gridOf<openvdb::Int32Grid>(from.voxels(false), name, -1,
                                      [&](std::size_t i) { return labels[i]; });
}

FieldRow atomField()
{
    return fromBalls("atom_id", 1, [](FieldSource& from) {
        return labelGrid(from, "atom_id", atomsOf(from.atoms.balls));
    });
}

FieldRow chainField()
{
    FieldRow row = fromBalls("chain_id", 1, [](FieldSource& from) {
        return from.atoms.labels ? labelGrid(from, "chain_id", from.atoms.labels->chainOf)
                                 : nullptr;
    });
    row.needsLabels = true;
    return row;
}

FieldRow groupField()
{
    return fromBalls("group_id", 1, [](FieldSource& from) {
        const auto& labels = from.atoms.labels;
        return labels && !labels->groups.empty() ? labelGrid(from, "group_id", labels->groupOf)
                                                 : nullptr;
    });
}

/// Colours in linear light. Curvatures have no colours of balls: the caller of the run makes these
/// of the grid of the curvature (curvatureColors()).
FieldRow colorField()
{
    FieldRow row = fromBalls("Cd", 3, [](FieldSource& from) -> GridBase::Ptr {
        if (!from.ballColors) return nullptr;
        std::vector<Color> colors;
        if (isBlended(from.atoms, from.options.color)) {
            const PointValues values(from.atoms, outwardOf(from.atoms.coloring, from.options));
            for (const PointValue& v :
                 values.on(from.voxels(true), *from.result.surface, from.reach, from.progress))
                colors.push_back(values.colorOf(v));
        } else {
            colors = colorsOf(from.owners(true), *from.ballColors);
        }
        const auto grid =
            gridOf<openvdb::Vec3SGrid>(from.voxels(true), "Cd", linearLight(neutralColor),
                                       [&](std::size_t i) { return linearLight(colors[i]); });
        describeColors(*grid);
        return grid;
    });
    row.ofColors = true;
    return row;
}

/// Says which number a grid holds, by the name of the vertex attribute.
void describeNumber(const std::string& attribute, const std::string& unit, GridBase& grid)
{
    grid.insertMeta("attribute", openvdb::StringMetadata(attribute));
    grid.insertMeta("unit", openvdb::StringMetadata(unit));
}

/// The number that colours show. Voxels without one are not active.
FieldRow valueField()
{
    FieldRow row = fromBalls("value", 1, [](FieldSource& from) -> GridBase::Ptr {
        const ColorKind& kind = kindOf(from.options.color);
        if (kind.ofCurvature) {
            auto known = findGrid<openvdb::FloatGrid>(from.result.fields, kind.attribute);
            if (!known) known = findGrid<openvdb::FloatGrid>(from.result.shown, kind.attribute);
            const auto grid = known->deepCopy();
            grid->setName("value");
            describeNumber(kind.attribute, kind.unit, *grid);
            return grid;
        }
        const BallValues& of = *from.atoms.labels->values;
        std::vector<float> values;
        if (isBlended(from.atoms, from.options.color)) {
            const PointValues points(from.atoms, outwardOf(from.atoms.coloring, from.options));
            for (const PointValue& v :
                 points.on(from.voxels(true), *from.result.surface, from.reach, from.progress))
                values.push_back(v.known());
        } else {
            for (const std::int32_t ball : from.owners(true))
                values.push_back(ball < 0 ? std::nanf("") : of.valueOf[std::size_t(ball)]);
        }
        const auto grid = gridOf<openvdb::FloatGrid>(from.voxels(true), "value", 0.0f,
                                                     [&](std::size_t i) { return values[i]; });
        for (auto it = grid->beginValueOn(); it; ++it) {
            if (std::isfinite(*it)) continue;
            it.setValue(0.0f);
            it.setValueOff();
        }
        describeNumber(of.name, of.unit, *grid);
        return grid;
    });
    row.help = "the number that `color` shows";
    row.needs = "`color` by a value or a curvature [hint: `color` bfactor, for example]";
    row.given = [](const SurfaceOptions& o) {
        return o.color == ColorBy::Value || kindOf(o.color).ofCurvature;
    };
    row.ofColors = true;
    return row;
}

} // namespace

const std::vector<FieldRow>& fieldTable()
{
    static const std::vector<FieldRow> all = [] {
        std::vector<FieldRow> rows = {{"sas", 1, BySymmetry | InClosedForm},
                                      {"spline", 1, BySymmetry | InClosedForm}};
        for (const CurvatureField& field : curvatureFields()) {
            rows.push_back({field.name, field.components, InClosedForm});
            rows.back().atVertices = true;
        }
        rows.push_back({"density", 1, BySymmetry | InClosedForm | InBricks});
        for (auto* more : {atomField, chainField, groupField, colorField, valueField})
            rows.push_back(more());
        for (const char* name : {"pocket_id", "pocket_depth", "pocket_room"}) { // by addPockets()
            rows.push_back({name, 1, BySymmetry | InClosedForm | InBricks});
            rows.back().needs = "`pockets`, too";
            rows.back().given = [](const SurfaceOptions& o) { return o.pockets; };
        }
        rows.push_back({"depth", 1, InBricks}); // by the table of products
        rows.back().help = "of the ball below the surface [Å]; tables of areas have it, too";
        rows.back().inTables = true;
        rows.push_back({"v", 3, BySymmetry | InClosedForm}); // by velocityGrid()
        rows.back().atVertices = true;
        return rows;
    }();
    return all;
}

const FieldRow* findField(const std::string& name)
{
    for (const FieldRow& row : fieldTable())
        if (row.name == name) return &row;
    return nullptr;
}

std::vector<std::string> fieldNames()
{
    std::vector<std::string> names;
    for (const FieldRow& row : fieldTable())
        if (!row.needs && !row.inTables) names.push_back(row.name);
    return names;
}

} // namespace molsurf
