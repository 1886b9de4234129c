// SPDX-License-Identifier: MPL-2.0
#include "write_result.h"

#include "sha256.h"
#include "sidecar.h"

#include "molsurf/io/draw_legend.h"
#include "molsurf/io/write_glb.h"
#include "molsurf/io/write_html.h"
#include "molsurf/io/write_mesh.h"
#include "molsurf/io/write_png.h"
#include "molsurf/io/write_report.h"
#include "molsurf/io/write_usda.h"
#include "molsurf/io/write_vdb.h"
#include "molsurf/pipeline/legends.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <optional>

namespace molsurf::tool
{

namespace
{

std::string shortest(double number)
{
    char digits[32];
    return std::string(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
}

} // namespace

openvdb::MetaMap vdbMetadata(const Call& call, const Report& report)
{
    openvdb::MetaMap map;
    const auto text = [&](const char* name, const std::string& value) {
        map.insertMeta(name, openvdb::StringMetadata(value));
    };
    const auto number = [&](const char* name, double value) {
        map.insertMeta(name, openvdb::DoubleMetadata(value));
    };
    const auto count = [&](const char* name, std::int64_t value) {
        map.insertMeta(name, openvdb::Int64Metadata(value));
    };
    const auto yesNo = [&](const char* name, bool value) {
        map.insertMeta(name, openvdb::BoolMetadata(value));
    };
    text("program", report.program);
    text("version", report.version);
    text("command", report.command);
    text("input", report.input);
    if (call.input != "-") text("input_sha256", sha256OfFile(call.input));
    count("atoms", std::int64_t(report.atoms));
    number("area", report.surface.area);
    number("volume", report.surface.volume);

    const Options& options = call.options;
    text("option.select", options.atoms.select.empty() ? "all" : options.atoms.select);
    text("option.model", options.atoms.model ? std::to_string(options.atoms.model) : "first");
    text("option.assembly", options.atoms.assembly);
    text("option.copies", options.atoms.copies.empty() ? "all" : options.atoms.copies);
    text("option.altloc",
         options.atoms.altloc.empty() ? "highest occupancy" : options.atoms.altloc);
    yesNo("option.no-hydrogens", !options.atoms.hydrogens);
    yesNo("option.no-hetero", !options.atoms.hetero);
    yesNo("option.waters", options.atoms.waters);
    text("option.radii", options.atoms.radii);
    number("option.probe", options.probe);
    text("option.surface", nameOf(options.kind));
    number("option.blobbiness", options.blobbiness);
    number("option.voxel", options.voxel);
    yesNo("option.fill-cavities", options.fillCavities);
    std::string coarse;
    for (const CoarseRule& rule : options.atoms.coarse)
        coarse += (coarse.empty() ? "" : ", ") + nameOf(rule);
    text("option.coarse", coarse.empty() ? "atom" : coarse);
    std::string resolutions;
    for (const ResolutionRule& rule : options.atoms.resolutions) {
        resolutions += (resolutions.empty() ? "" : ", ") +
                       (rule.select.empty() ? "" : rule.select + "=") + shortest(rule.resolution);
    }
    text("option.resolution", resolutions);
    yesNo("option.match-volume", options.matchVolume);
    std::string groups;
    for (const GroupRule& group : options.atoms.groups)
        groups += (groups.empty() ? "" : ", ") + group.name + " " + group.select;
    text("option.groups", groups);
    text("option.group-by", options.atoms.groupBy);
    text("option.color", nameOf(options.color));
    text("option.split", options.split ? "group" : "none");
    std::string surfaceOf;
    for (const auto& [name, kind] : options.surfaceOf)
        surfaceOf += (surfaceOf.empty() ? "" : ",") + name + "=" + nameOf(kind);
    text("option.surface-of", surfaceOf);
    std::string fields = "surface";
    for (const std::string& field : options.fields) fields += "," + field;
    text("option.fields", fields);
    text("option.for", nameOf(call.scene.host));
    yesNo("option.center", call.center);
    number("option.min-wall", options.minWall);
    const char* axes[] = {"scene.center_x", "scene.center_y", "scene.center_z"};
    for (int i = 0; i < 3; ++i) number(axes[i], call.scene.center[i]);
    number("scene.units_per_angstrom", call.scene.scale);
    number("scene.shift_in_voxels", call.scene.host == Host::Blender ? -0.5 : 0.0);
    yesNo("option.curvature-totals", options.curvatureIntegrals);
    number("option.epsilon", options.epsilon);
    number("option.lambda", options.evolution.lambda);
    text("option.regularizer", nameOf(options.evolution.regularizer));
    text("option.flow", nameOf(options.evolution.flow));
    const int steps = options.evolution.maxSteps;
    text("option.steps", options.evolution.steps >= 0 ? std::to_string(options.evolution.steps)
                                                      : "by the stopping rule");
    text("option.max-steps", steps >= 0 ? std::to_string(steps) : "default of the flow");
    number("option.tolerance", options.evolution.energyTolerance);
    count("option.spline-level", options.splineLevel);
    return map;
}

namespace
{

openvdb::GridCPtrVec gridsOf(const Call& call, const Result& result)
{
    openvdb::GridCPtrVec grids;
    if (result.surface) grids.push_back(result.surface);
    grids.insert(grids.end(), result.fields.begin(), result.fields.end());
    const Scene& scene = call.scene;
    return scene.known() || call.center ? placeInScene(grids, scene) : grids;
}

LengthUnit printUnit(const Call& call)
{
    return call.printScale > 0.0 ? LengthUnit{call.printScale, "mm"} : LengthUnit{};
}

// The name of the input without folder, .gz and extension.
std::string titleOf(const std::string& input)
{
    if (input == "-") return "standard input";
    std::filesystem::path name = std::filesystem::path(input).filename();
    if (name.extension() == ".gz") name = name.stem();
    return name.stem().string();
}

std::string stemOf(const std::string& path)
{
    return path == "-" ? "surface" : std::filesystem::path(path).stem().string();
}

// What the colours can mean; the first one is what they do mean, if they were asked for.
std::vector<Legend> legendsOf(const Call& call, const BallSelection& atoms, const Mesh& mesh,
                              const Progress& progress)
{
    std::vector<ColorBy> kinds = {ColorBy::Chain, ColorBy::Group, ColorBy::MeanCurvature,
                                  ColorBy::GaussianCurvature};
    const ColorBy asked = call.options.color;
    const auto found = std::find(kinds.begin(), kinds.end(), asked);
    if (found != kinds.end()) kinds.erase(found);
    if (asked != ColorBy::Nothing) kinds.insert(kinds.begin(), asked);
    std::vector<Legend> legends;
    for (const ColorBy kind : kinds)
        if (auto legend = legendOf(kind, atoms, mesh, progress))
            legends.push_back(std::move(*legend));
    return legends;
}

void writePicture(const Call& call, const BallSelection& atoms, const Mesh& mesh, double turn,
                  const Progress& progress, OutputFile& file)
{
    DrawOptions options = call.picture;
    options.turn += turn;
    const auto legend =
        call.legend ? legendOf(call.options.color, atoms, mesh, progress) : std::optional<Legend>();
    if (!legend) {
        writePng(drawMesh(mesh, options, progress), file);
        return;
    }
    const int width = options.width;
    options.width = std::max(width - legendWidth(*legend, width), width / 2);
    writePng(withLegend(drawMesh(mesh, options, progress), *legend, width, options.background),
             file);
}

} // namespace

void writeOutput(const Call& call, const BallSelection& atoms, const Result& result,
                 const Output& output, const Progress& progress, OutputFile& file)
{
    switch (output.format) {
    case Format::Vdb:
        writeVdb(gridsOf(call, result), vdbMetadata(call, result.report), file);
        break;
    case Format::Usda:
        writeUsda(gridsOf(call, result), usdVolume(call, output), file);
        break;
    case Format::Ply:
        writePly(result.mesh, file);
        break;
    case Format::Obj:
        writeObj(result.mesh, file, printUnit(call));
        break;
    case Format::Stl:
        writeStl(result.mesh, file, printUnit(call));
        break;
    case Format::Off:
        writeOff(result.mesh, file);
        break;
    case Format::Glb:
        writeGlb(result.mesh, {stemOf(output.path), call.scene.scale, call.picture.plain}, file);
        break;
    case Format::Png:
        writePicture(call, atoms, result.mesh, output.turn, progress, file);
        break;
    case Format::Html:
        writeHtml(result.mesh,
                  {titleOf(call.input), legendsOf(call, atoms, result.mesh, progress),
                   call.picture.plain, viewAxes(result.mesh, call.picture)},
                  file);
        break;
    case Format::Json:
        writeReport(result.report, file);
        break;
    }
}

} // namespace molsurf::tool
