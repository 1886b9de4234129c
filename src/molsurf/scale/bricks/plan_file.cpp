// SPDX-License-Identifier: MPL-2.0
#include "molsurf/scale/bricks/plan_file.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/structure/load_text.h"
#include "molsurf/show/io/json_members.h"

#include <filesystem>
#include <stdexcept>

namespace molsurf
{

template<typename Rows>
void members(Rows& rows, PlanInput& file)
{
    rows("path", file.path);
    rows("sha256", file.sha256);
    rows("bytes", file.bytes);
}

template<typename Rows>
void members(Rows& rows, PlannedBrick& brick)
{
    rows("min", brick.box.min());
    rows("max", brick.box.max());
    rows("atoms", brick.atoms);
    rows("voxels", brick.voxels);
    rows("bytes", brick.bytes);
    rows("seconds", brick.seconds);
}

template<typename Rows>
void members(Rows& rows, PlanManifest& manifest)
{
    BrickPlan& plan = manifest.plan;
    rows("program", manifest.program);
    rows("version", manifest.version);
    rows("input", manifest.input);
    rows("options", manifest.options);
    rows("files", manifest.files);
    rows("atoms", plan.atoms);
    rows("atoms_index_sha256", manifest.atomsIndex);
    rows("voxel", manifest.voxel);
    rows("steps", plan.steps);
    rows("anchor", plan.anchor);
    rows("largest_radius", plan.maxRadius);
    rows("largest_extent", plan.maxGrownRadius);
    rows("largest_tolerance", plan.maxTolerance);
    rows("bricks", plan.bricks);
}

std::string manifestText(const PlanManifest& manifest)
{
    return jsonText(manifest, 2) + "\n";
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
        return JsonReader::valueOf<PlanManifest>(nlohmann::json::parse(text));
    } catch (const std::range_error& e) {
        throw Error(ErrorKind::Input, path + ": is no plan: its " + e.what());
    } catch (const nlohmann::json::exception&) {
        throw Error(ErrorKind::Input, noPlan);
    }
}

} // namespace molsurf
