// SPDX-License-Identifier: MPL-2.0
#include "molsurf/io/write_report.h"

#include "unit/io/json_keys.h"

#include <gtest/gtest.h>

#include <limits>

namespace molsurf
{
namespace
{

Report sampleReport()
{
    Report report;
    report.version = "1.2.3";
    report.command = "vdb_molsurf a.pdb -o a.json";
    report.input = "a.pdb";
    report.atoms = 327;
    report.voxel = 0.5;
    report.surface.area = 2500.25;
    report.surface.volume = 4000.5;
    report.surface.cavities = {{10.0, 3.0}, {20.0, 6.0}};
    report.evolution = EvolutionReport();
    report.evolution->steps = 2;
    report.evolution->energy = {3.0, 2.0, 1.5};
    report.activeVoxels = 7;
    report.seconds = {{"read", 0.5}, {"total", 2.0}};
    report.threads = 2;
    return report;
}

TEST(WriteReport, HasTheKeysOfTheContractInItsOrder)
{
    const Json json = Json::parse(reportText(sampleReport()));
    EXPECT_EQ(
        keys(json),
        (Names{"schema", "program",   "version",           "command", "input",      "atoms",      "voxel",
               "center",    "surface",           "coarse",  "resolution", "evolution",  "grid",
               "seconds",   "peak_memory_bytes", "threads", "groups", "areas_of",    "interfaces", "parts",
               "instances", "symmetry",          "warnings"}));
    Names surface = keys(json["surface"]);
    surface.resize(14); // later keys are additions
    EXPECT_EQ(surface, (Names{"kind", "area", "volume", "euler_characteristic", "mesh_euler_characteristic", "components",
                              "cavities", "outer_area", "outer_volume", "cavity_list", "vertices",
                              "triangles", "closed", "manifold"}));
    Names evolution = keys(json["evolution"]);
    evolution.resize(5);
    EXPECT_EQ(evolution, (Names{"steps", "converged", "energy", "mean_displacement", "max_speed"}));
    EXPECT_EQ(keys(json["grid"]), (Names{"active_voxels", "bytes"}));
    EXPECT_EQ(keys(json["seconds"]), (Names{"read", "total"}));
}

TEST(WriteReport, HasTheValues)
{
    const Json json = Json::parse(reportText(sampleReport()));
    EXPECT_EQ(json["atoms"], 327);
    EXPECT_EQ(json["surface"]["area"], 2500.25);
    EXPECT_EQ(json["surface"]["cavities"], 2);
    EXPECT_EQ(json["surface"]["cavity_list"][1]["volume"], 6.0);
    EXPECT_EQ(json["evolution"]["energy"], (std::vector<double>{3.0, 2.0, 1.5}));
    EXPECT_EQ(json["seconds"]["total"], 2.0);
    EXPECT_TRUE(json["groups"].is_array());
}

TEST(WriteReport, WithoutEvolutionItIsNull)
{
    Report report = sampleReport();
    report.evolution.reset();
    EXPECT_TRUE(Json::parse(reportText(report))["evolution"].is_null());
}

TEST(WriteReport, StaysJsonWhateverTheNumbersAndNamesAre)
{
    Report report = sampleReport();
    report.surface.area = std::numeric_limits<double>::quiet_NaN();
    report.input = "a\"\n\xff.pdb";
    const Json json = Json::parse(reportText(report));
    EXPECT_TRUE(json["surface"]["area"].is_null());
    EXPECT_EQ(json["input"], "a\"\n\xEF\xBF\xBD.pdb");
}

} // namespace
} // namespace molsurf
