// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/write_comparison.h"

#include "unit/io/json_keys.h"

#include <gtest/gtest.h>

namespace molsurf
{
namespace
{

ComparisonReport sampleComparison()
{
    ComparisonReport report;
    report.version = "1.2.3";
    report.command = "vdb_molsurf compare a.vdb b.ply";
    report.a = {"a.vdb", "level set", 0, 0.25, 200.0, 90.0, 100, 196, true};
    report.b = {"b.ply", "mesh", 0, 0.0, 100.0, std::nullopt, 50, 90, false};
    Comparison::OneWay &there = report.distances.aToB, &back = report.distances.bToA;
    there.mean = 0.5;
    there.rms = 0.75;
    there.max = 2.0;
    there.maxAt = {1.0, 2.0, 3.0};
    there.samples = 100;
    back.mean = 0.25;
    back.rms = 0.375;
    back.max = 1.5;
    back.maxAt = {4.0, 5.0, 6.0};
    back.meanSigned = -0.125;
    back.inside = 0.625;
    back.samples = 60;
    report.distances.hausdorff = 2.0;
    report.shown = "distance";
    report.color = {"viridis", 0.0, 1.5, {{68, 1, 84}, {253, 231, 37}}};
    report.seconds = {{"surfaces", 0.5}, {"total", 2.0}};
    report.threads = 2;
    report.warnings = {"b.ply: the mesh is open"};
    return report;
}

TEST(WriteComparison, KeysAndValues)
{
    const Json json = Json::parse(comparisonText(sampleComparison()));
    EXPECT_EQ(keys(json), (Names{"program", "version", "command", "a", "b", "a_to_b", "b_to_a",
                                 "hausdorff", "superposition", "area_ratio", "volume_ratio",
                                 "color", "seconds", "peak_memory_bytes", "threads", "warnings"}));
    EXPECT_EQ(keys(json["a"]), (Names{"input", "kind", "atoms", "voxel", "area", "volume",
                                      "vertices", "triangles", "closed"}));
    EXPECT_EQ(keys(json["a_to_b"]),
              (Names{"mean", "rms", "max", "max_at", "mean_signed", "inside", "samples"}));
    EXPECT_EQ(keys(json["color"]), (Names{"attribute", "map", "low", "high", "bar"}));
    EXPECT_EQ(json["b_to_a"]["mean_signed"], -0.125);
    EXPECT_EQ(json["b_to_a"]["max_at"], Json({4.0, 5.0, 6.0}));
    EXPECT_EQ(json["area_ratio"], 2.0);
    EXPECT_EQ(json["color"]["bar"][1]["color"], Json({253, 231, 37}));
    EXPECT_EQ(json["seconds"]["total"], 2.0);
}

TEST(WriteComparison, WhatIsNotDefinedIsNull)
{
    const Json json = Json::parse(comparisonText(sampleComparison()));
    EXPECT_TRUE(json["b"]["volume"].is_null());
    EXPECT_TRUE(json["b"]["voxel"].is_null());
    EXPECT_TRUE(json["a"]["atoms"].is_null());
    EXPECT_TRUE(json["volume_ratio"].is_null());
    EXPECT_TRUE(json["a_to_b"]["mean_signed"].is_null());
    EXPECT_TRUE(json["a_to_b"]["inside"].is_null());
}

TEST(ComparisonTable, HasTheNumbers)
{
    const std::string table = comparisonTable(sampleComparison());
    for (const char* word : {"0.50000", "0.37500", "-0.12500", "Hausdorff", "2.00000", "200.00"})
        EXPECT_NE(table.find(word), std::string::npos) << word << "\n" << table;
    EXPECT_NE(table.find(" -\n"), std::string::npos) << table; // no volume of B
}

} // namespace
} // namespace molsurf
