// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/field_table.h"

#include "molsurf/error.h"
#include "molsurf/kernel/grid/grid_like.h"
#include "molsurf/surface/product_table.h"
#include "support/runs.h"

#include <gtest/gtest.h>

#include <cmath>

namespace molsurf
{
namespace
{

/// Balls 10 Å apart along x, each with a value, a chain and a group.
BallSet valued(const std::vector<float>& values)
{
    BallSet atoms;
    BallLabels& labels = atoms.labels.emplace();
    labels.chains = {"A"};
    labels.groups = {{"all", values.size(), {}}};
    for (std::size_t i = 0; i < values.size(); ++i)
        atoms.balls.push_back({openvdb::Vec3d(10.0 * double(i), 0.3, 0.1), 1.7, std::int32_t(i)});
    labels.chainOf.assign(values.size(), 0);
    labels.groupOf = labels.chainOf;
    labels.elementOf.assign(values.size(), 6);
    labels.residueClassOf.assign(values.size(), ResidueClass::Other);
    BallValues& of = labels.values.emplace();
    of.name = "bfactor";
    of.unit = "Å²";
    of.valueOf = values;
    atoms.placement.begin = {0, values.size()};
    return atoms;
}

SurfaceOptions coloredBy(ColorBy by, std::vector<std::string> fields)
{
    SurfaceOptions options;
    options.voxel = 0.5;
    options.color = by;
    options.fields = std::move(fields);
    return options;
}

TEST(FieldTable, EachRowHasItsGridInTheOrderOfTheTable)
{
    SurfaceOptions options = coloredBy(ColorBy::Value, {});
    options.pockets = true;
    for (const FieldRow& row : fieldTable())
        options.fields.insert(options.fields.begin(), row.name);
    const MolecularSurface result = makeSurface(valued({1.0f, 2.0f}), options);
    std::size_t i = 0;
    for (const FieldRow& row : fieldTable()) {
        if (row.name == "v") continue; // of frames
        ASSERT_LT(i, result.fields.size());
        EXPECT_EQ(result.fields[i]->getName(), row.name);
        EXPECT_EQ(result.fields[i]->valueType() == "vec3s" ? 3 : 1, row.values) << row.name;
        ++i;
    }
    EXPECT_EQ(i, result.fields.size());
}

TEST(FieldTable, SaysWhichWaysGiveWhat)
{
    const auto missing = [](Way way, const char* field) {
        return missingIn(way, coloredBy(ColorBy::Value, {"atom_id", field}));
    };
    EXPECT_EQ(missing(InBricks, "density"), "`fields` density");
    EXPECT_EQ(missing(InBricks, "value"), "");
    EXPECT_EQ(missing(BySymmetry, "curvedness"), "`fields` atom_id");
    EXPECT_EQ(missingIn(BySymmetry, coloredBy(ColorBy::Nothing, {"curvedness"})), "");
    EXPECT_EQ(missing(InClosedForm, "curvedness"), "`surface`");
    SurfaceOptions totals;
    totals.curvatureTotals = true;
    EXPECT_EQ(missingIn(BySymmetry, totals), "`curvatureTotals`");
}

TEST(ValueField, IsThatOfTheNearestBall)
{
    const float none = std::nanf("");
    for (const bool flat : {true, false}) {
        BallSet atoms = valued({2.5f, none, 1e6f});
        atoms.labels->values->flat = flat;
        SurfaceOptions options = coloredBy(ColorBy::Value, {"Cd", "value"});
        options.halfFloats = true;
        const MolecularSurface result = makeSurface(atoms, options);
        const auto colors = findGrid<openvdb::Vec3SGrid>(result.fields, "Cd");
        const auto value = findGrid<openvdb::FloatGrid>(result.fields, "value");
        ASSERT_TRUE(colors && value);
        EXPECT_EQ(value->background(), 0.0f);
        EXPECT_FALSE(value->saveFloatAsHalf()); // which end at 65504
        EXPECT_TRUE(colors->saveFloatAsHalf());
        EXPECT_EQ(value->metaValue<std::string>("attribute"), "bfactor");
        for (auto it = colors->cbeginValueOn(); it; ++it) {
            const double x = value->indexToWorld(it.getCoord()).x();
            float found = -1.0f;
            const bool active = value->tree().probeValue(it.getCoord(), found);
            EXPECT_EQ(active, x < 5.0 || x > 15.0);
            EXPECT_EQ(found, x < 5.0 ? 2.5f : x < 15.0 ? 0.0f : 1e6f) << x;
        }
        EXPECT_GT(value->activeVoxelCount(), colors->activeVoxelCount() / 2);
    }
}

TEST(ValueField, OfCurvatureIsItsGrid)
{
    const BallSet atoms = valued({1.0f});
    const MolecularSurface result =
        makeSurface(atoms, coloredBy(ColorBy::MeanCurvature, {"value", "mean_curvature"}));
    const auto value = findGrid<openvdb::FloatGrid>(result.fields, "value");
    const auto mean = findGrid<openvdb::FloatGrid>(result.fields, "mean_curvature");
    ASSERT_TRUE(value && mean);
    EXPECT_EQ(result.fields.size(), 2u);
    for (auto it = mean->cbeginValueOn(); it; ++it)
        ASSERT_EQ(value->tree().getValue(it.getCoord()), *it);
    EXPECT_GT(value->tree().getValue(value->tree().beginLeaf()->beginValueOn().getCoord()), 0.0f);
    EXPECT_EQ(makeSurface(atoms, coloredBy(ColorBy::MeanCurvature, {"value"})).fields.size(), 1u);
}

TEST(ValueField, NeedsANumberThatColoursShow)
{
    for (const ColorBy by : {ColorBy::Nothing, ColorBy::Chain}) {
        try {
            makeSurface(valued({1.0f}), coloredBy(by, {"value"}));
            ADD_FAILURE() << int(by);
        } catch (const Error& e) {
            EXPECT_EQ(e.kind(), ErrorKind::Usage);
            EXPECT_NE(std::string(e.what()).find("`fields` value: expected `color`"),
                      std::string::npos)
                << e.what();
        }
    }
}

// All parts have the colours of one scale, each once.
TEST(Fields, OfCurvatureInParts)
{
    BallSet atoms = valued({1.0f, 2.0f});
    BallLabels& labels = *atoms.labels;
    atoms.balls[1].radius = 3.4;
    labels.groups = {{"left", 1, {}}, {"right", 1, {}}};
    labels.groupOf = {0, 1};
    SurfaceOptions options = coloredBy(ColorBy::MeanCurvature, {"Cd", "value"});
    options.split = true;
    const MolecularSurface result = makeSurface(atoms, options);
    std::vector<std::string> names;
    for (const auto& grid : result.fields) names.push_back(grid->getName());
    EXPECT_EQ(names, (std::vector<std::string>{"surface_left", "value_left", "surface_right",
                                               "value_right", "Cd_left", "Cd_right"}));
}

} // namespace
} // namespace molsurf
