// SPDX-License-Identifier: MPL-2.0
#include "molsurf/scale/bricks/plan_file.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/structure/load_text.h"
#include "molsurf/show/io/json_number.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <stdexcept>

namespace molsurf
{

namespace
{

using Json = nlohmann::ordered_json; // as it is written

Json json(const openvdb::Coord& c)
{
    return {c.x(), c.y(), c.z()};
}

openvdb::Coord coord(const nlohmann::json& json)
{
    const auto number = [&](int axis) { return jsonNumber<std::int32_t>(json.at(axis)); };
    return {number(0), number(1), number(2)};
}

} // namespace

std::string manifestText(const PlanManifest& m)
{
    Json files = Json::array(), bricks = Json::array();
    for (const PlanInput& f : m.files)
        files.push_back(Json{{"path", f.path}, {"sha256", f.sha256}, {"bytes", f.bytes}});
    for (const PlannedBrick& b : m.plan.bricks) {
        bricks.push_back(Json{{"min", json(b.box.min())},
                              {"max", json(b.box.max())},
                              {"atoms", b.atoms},
                              {"voxels", b.voxels},
                              {"bytes", b.bytes},
                              {"seconds", b.seconds}});
    }
    const BrickPlan& p = m.plan;
    const Json text = {{"program", "vdb_molsurf"},
                       {"version", m.version},
                       {"input", m.input},
                       {"options", m.options},
                       {"files", std::move(files)},
                       {"atoms", p.atoms},
                       {"atoms_index_sha256", m.atomsIndex},
                       {"voxel", m.voxel},
                       {"steps", p.steps},
                       {"anchor", json(p.anchor)},
                       {"largest_radius", p.maxRadius},
                       {"largest_extent", p.maxGrownRadius},
                       {"largest_tolerance", p.maxTolerance},
                       {"bricks", std::move(bricks)}};
    return text.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void writeManifest(const PlanManifest& manifest, OutputFile& file)
{
    file.write(manifestText(manifest));
    file.finish();
}

PlanManifest readManifest(const std::string& path)
{
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
        throw Error(ErrorKind::Input, path + ": is a folder, expected a plan");
    const std::string text = loadText(path);
    const std::string noPlan = path + ": is no plan [hint: vdb_molsurf bricks plan writes one]";
    if (!isModestJson(text)) throw Error(ErrorKind::Input, noPlan);
    try {
        using Known = nlohmann::json; // finds a key of many soon
        const Known j = Known::parse(text);
        PlanManifest m;
        m.version = j.at("version");
        m.input = j.at("input");
        m.options = j.at("options").get<std::map<std::string, std::vector<std::string>>>();
        const auto real = [](const Known& number) { return jsonNumber<double>(number); };
        const auto count = [](const Known& number) { return jsonNumber<std::size_t>(number); };
        for (const Known& f : j.at("files")) {
            m.files.push_back(
                {f.at("path"), f.at("sha256"), jsonNumber<std::uint64_t>(f.at("bytes"))});
        }
        m.voxel = real(j.at("voxel"));
        m.atomsIndex = j.at("atoms_index_sha256");
        m.plan.atoms = count(j.at("atoms"));
        m.plan.steps = jsonNumber<int>(j.at("steps"));
        m.plan.anchor = coord(j.at("anchor"));
        m.plan.maxRadius = real(j.at("largest_radius"));
        m.plan.maxGrownRadius = real(j.at("largest_extent"));
        m.plan.maxTolerance = real(j.at("largest_tolerance"));
        for (const Known& b : j.at("bricks")) {
            m.plan.bricks.push_back({openvdb::CoordBBox(coord(b.at("min")), coord(b.at("max"))),
                                     count(b.at("atoms")), count(b.at("voxels")),
                                     count(b.at("bytes")), real(b.at("seconds"))});
        }
        return m;
    } catch (const std::range_error& e) {
        throw Error(ErrorKind::Input, path + ": is no plan: its " + e.what());
    } catch (const nlohmann::json::exception&) {
        throw Error(ErrorKind::Input, noPlan);
    }
}

} // namespace molsurf
