// SPDX-License-Identifier: MPL-2.0
#include "write_result.h"

#include "cli_table.h"
#include "sha256.h"
#include "sidecar.h"

#include "molsurf/color/legend.h"
#include "molsurf/io/write_3mf.h"
#include "molsurf/io/write_glb.h"
#include "molsurf/io/write_mesh.h"
#include "molsurf/io/write_report.h"
#include "molsurf/io/write_usda.h"
#include "molsurf/io/write_vdb.h"
#include "molsurf/picture/draw_legend.h"
#include "molsurf/picture/write_html.h"
#include "molsurf/picture/write_png.h"
#include "molsurf/surface/stored_surface.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>

namespace molsurf::tool
{

namespace
{

// Adds values of metadata by name.
struct Metadata {
    openvdb::MetaMap& map;
    void text(const char* name, const std::string& value)
    {
        map.insertMeta(name, openvdb::StringMetadata(value));
    }
    void number(const char* name, double value)
    {
        map.insertMeta(name, openvdb::DoubleMetadata(value));
    }
    void count(const char* name, std::int64_t value)
    {
        map.insertMeta(name, openvdb::Int64Metadata(value));
    }
    void yesNo(const char* name, bool value) { map.insertMeta(name, openvdb::BoolMetadata(value)); }
};

void addOptions(const Call& call, openvdb::MetaMap& map)
{
    Metadata to{map};
    const Options& options = call.options;
    to.text("option.select", options.atoms.select.empty() ? "all" : options.atoms.select);
    to.text("option.model", options.atoms.model ? std::to_string(options.atoms.model) : "first");
    to.text("option.assembly", options.atoms.assembly);
    to.text("option.copies", options.atoms.copies.empty() ? "all" : options.atoms.copies);
    to.text("option.altloc",
            options.atoms.altloc.empty() ? "highest occupancy" : options.atoms.altloc);
    to.yesNo("option.no-hydrogens", !options.atoms.hydrogens);
    to.yesNo("option.no-hetero", !options.atoms.hetero);
    to.yesNo("option.waters", options.atoms.waters);
    to.text("option.radii", options.atoms.radii);
    to.number("option.probe", options.probe);
    to.text("option.surface", nameOf(options.kind));
    to.number("option.blobbiness", options.blobbiness);
    to.number("option.voxel", options.voxel);
    to.yesNo("option.fill-cavities", options.fillCavities);
    std::string coarse;
    for (const CoarseRule& rule : options.atoms.coarse)
        coarse += (coarse.empty() ? "" : ", ") + nameOf(rule);
    to.text("option.coarse", coarse.empty() ? "atom" : coarse);
    std::string resolutions;
    for (const ResolutionRule& rule : options.atoms.resolutions) {
        resolutions += (resolutions.empty() ? "" : ", ") +
                       (rule.select.empty() ? "" : rule.select + "=") + shortest(rule.resolution);
    }
    to.text("option.resolution", resolutions);
    to.yesNo("option.match-volume", options.matchVolume);
    std::string groups;
    for (const GroupRule& group : options.atoms.groups)
        groups += (groups.empty() ? "" : ", ") + group.name + " " + group.select;
    to.text("option.groups", groups);
    to.text("option.group-by", options.atoms.groupBy);
    to.text("option.color", nameOf(options.color));
    to.text("option.split", options.split ? "group" : "none");
    std::string surfaceOf;
    for (const auto& [name, kind] : options.surfaceOf)
        surfaceOf += (surfaceOf.empty() ? "" : ",") + name + "=" + nameOf(kind);
    to.text("option.surface-of", surfaceOf);
    std::string fields = "surface";
    for (const std::string& field : options.fields) fields += "," + field;
    to.text("option.fields", fields);
    to.text("option.for", nameOf(call.scene.host));
    to.yesNo("option.center", call.center);
    to.number("option.min-wall", options.minWall);
    const char* axes[] = {"scene.center_x", "scene.center_y", "scene.center_z"};
    for (int i = 0; i < 3; ++i) to.number(axes[i], call.scene.center[i]);
    to.number("scene.units_per_angstrom", call.scene.scale);
    to.number("scene.shift_in_voxels", call.scene.host == Host::Blender ? -0.5 : 0.0);
    to.yesNo("option.curvature-totals", options.curvatureIntegrals);
    to.number("option.epsilon", options.epsilon);
    to.number("option.lambda", options.evolution.lambda);
    to.text("option.regularizer", nameOf(options.evolution.regularizer));
    to.text("option.flow", nameOf(options.evolution.flow));
    const int steps = options.evolution.maxSteps;
    to.text("option.steps", options.evolution.steps >= 0 ? std::to_string(options.evolution.steps)
                                                         : "by the stopping rule");
    to.text("option.max-steps", steps >= 0 ? std::to_string(steps) : "default of the flow");
    to.number("option.tolerance", options.evolution.energyTolerance);
    to.count("option.spline-level", options.splineLevel);
}

} // namespace

openvdb::MetaMap vdbMetadata(const Call& call, const Report& report)
{
    openvdb::MetaMap map;
    Metadata to{map};
    to.text("program", report.program);
    to.text("version", report.version);
    to.text("command", report.command);
    to.text("input", report.input);
    if (call.input != "-") to.text("input_sha256", sha256OfFile(call.input));
    to.count("atoms", std::int64_t(report.atoms));
    to.number("area", report.surface.area);
    to.number("volume", report.surface.volume);

    if (call.frame > 0) {
        to.count("frame", call.frame);
        to.text("trajectory", call.trajectory.empty() ? call.input : call.trajectory);
        to.text("frames.options", optionsDigest(call));
    }
    addOptions(call, map);
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

std::string optionsDigest(const Call& call)
{
    openvdb::MetaMap map;
    addOptions(call, map);
    std::string all = call.trajectory + "\n" + shortest(call.scene.scale) +
                      (call.input == "-" ? "" : sha256OfFile(call.input));
    for (auto meta = map.beginMeta(); meta != map.endMeta(); ++meta)
        if (meta->first.rfind("option.", 0) == 0 && meta->first != "option.model")
            all += "\n" + meta->first + "=" + meta->second->str();
    std::uint64_t hash = 14695981039346656037u; // FNV-1a
    for (const char letter : all) hash = (hash ^ std::uint8_t(letter)) * 1099511628211u;
    char digits[24];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
    return digits;
}

void writeOutput(const Call& call, const BallSelection& atoms, const Result& result,
                 const Output& output, const Progress& progress, OutputFile& file)
{
    switch (output.format) {
    case Format::Vdb: {
        openvdb::MetaMap metadata = vdbMetadata(call, result.report);
        addLabelMetadata(atoms, call.options.fields, progress, metadata);
        writeVdb(gridsOf(call, result), metadata, file);
        break;
    }
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
    case Format::ThreeMf:
        write3mf(result.mesh, stemOf(output.path), printUnit(call).perAngstrom, file);
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
    case Format::Csv: // of all frames: frames.cpp
        break;
    }
}

} // namespace molsurf::tool
