// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/write_report.h"

#include "molsurf/show/io/report_keys.h"

#include "unit/io/json_keys.h"

#include <set>

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
    EXPECT_EQ(keys(json), (Names{"schema",     "program",        "version",
                                 "commit",     "options_sha256", "command",
                                 "input",      "input_sha256",   "atoms",
                                 "voxel",      "center",         "surface",
                                 "coarse",     "resolution",     "evolution",
                                 "grid",       "seconds",        "peak_memory_bytes",
                                 "threads",    "groups",         "areas_of",
                                 "polar_area", "apolar_area",    "interfaces",
                                 "pockets",    "pore",           "tunnels",
                                 "parts",      "instances",      "symmetry",
                                 "warnings"}));
    Names surface = keys(json["surface"]);
    surface.resize(14); // later keys are additions
    EXPECT_EQ(surface,
              (Names{"kind", "area", "volume", "euler_characteristic", "mesh_euler_characteristic",
                     "components", "cavities", "outer_area", "outer_volume", "cavity_list",
                     "vertices", "triangles", "closed", "manifold"}));
    Names evolution = keys(json["evolution"]);
    evolution.resize(5);
    EXPECT_EQ(evolution, (Names{"steps", "converged", "energy", "mean_displacement", "max_speed"}));
    EXPECT_EQ(keys(json["grid"]), (Names{"active_voxels", "bytes"}));
    EXPECT_EQ(keys(json["seconds"]), (Names{"read", "total"}));
}

/// The paths of all keys of a value, but for those of maps whose keys are names.
void addPaths(const Json& json, const std::string& path, Names& out)
{
    const std::set<std::string> open = {"seconds",
                                        "measures",
                                        "areas",
                                        "surface.mean_curvature.percentiles",
                                        "surface.gaussian_curvature",
                                        "parts[].surface"};
    if (open.count(path) > 0) return;
    if (json.is_array() && !json.empty() && json[0].is_object())
        addPaths(json[0], path + "[]", out);
    if (!json.is_object()) return;
    for (const auto& [key, value] : json.items()) {
        const std::string next = (path.empty() ? "" : path + ".") + key;
        out.push_back(next);
        addPaths(value, next, out);
    }
}

// docs/report.md is made of the table.
TEST(WriteReport, HasTheKeysOfTheTableAndNoOthers)
{
    Report report = sampleReport();
    report.surface.triangles = 4;
    report.surface.cuspLength = report.surface.meshArea = report.surface.meshVolume = 1.0;
    report.evolution->gaps = report.evolution->walls = EvolutionReport::Gaps();
    report.evolution->gaps->closedByField = 1;
    report.coarse = Report::Coarse{1, 2};
    report.resolutions.resize(1);
    report.groups = {{"A", 1, 1.0, 1.0, "#ff0000", 2.0}};
    report.interfaces.resize(1);
    report.pockets = Report::Pockets{};
    report.pockets->list.resize(1);
    report.pockets->list[0].mouths.resize(1);
    report.pore = Report::Pore{};
    report.pore->stations.resize(1);
    report.pore->stations[0].isBottleneck = true;
    report.pore->others.resize(1);
    report.tunnels = Report::Tunnels{};
    report.tunnels->list.resize(1);
    report.tunnels->list[0].stations.resize(1);
    report.tunnels->list[0].stations[0].isBottleneck = true;
    report.parts.resize(1);
    report.instances.resize(1);
    report.symmetry = Report::Symmetry();
    report.measures = {{"sphericity", 0.5}};
    report.tables = {{"atoms", {}}};
    report.surface.shape = SurfaceReport::Shape();
    Names written, listed;
    addPaths(Json::parse(reportText(report)), "", written);
    for (const ReportKey& key : reportKeys()) listed.push_back(key.path);
    EXPECT_EQ(written, listed);
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
