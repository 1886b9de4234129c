// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/stored_surface.h"

#include "molsurf/analysis/measures/compare.h"
#include "molsurf/error.h"
#include "molsurf/kernel/grid/grid_like.h"
#include "molsurf/kernel/pipeline/derived_grids.h"
#include "molsurf/kernel/pipeline/surface_run.h"
#include "molsurf/molecule/selection/groups.h"
#include "molsurf/show/color/color_map.h"
#include "molsurf/show/color/color_table.h"
#include "molsurf/show/color/curvature_colors.h"
#include "molsurf/show/color/palette.h"
#include "molsurf/show/io/grid_form.h"
#include "molsurf/surface/field_table.h"

#include <openvdb/tools/ChangeBackground.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

namespace molsurf
{

using openvdb::Coord;
using openvdb::FloatGrid;
using openvdb::Int32Grid;
using openvdb::Vec3d;
using openvdb::Vec3f;
using openvdb::Vec3SGrid;

namespace
{

double numberOf(const openvdb::MetaMap& metadata, const char* name, double preset)
{
    const auto found = metadata.getMetadata<openvdb::DoubleMetadata>(name);
    return found ? found->value() : preset;
}

std::string textOf(const openvdb::MetaMap& metadata, const std::string& name)
{
    const auto found = metadata.getMetadata<openvdb::StringMetadata>(name);
    return found ? found->value() : std::string();
}

/// The grids `surface` and `spline` as they were before placeInScene(), but for the origin.
openvdb::GridPtrVec inAngstrom(const openvdb::GridPtrVec& grids, const openvdb::MetaMap& metadata)
{
    const double scale = numberOf(metadata, "scene.units_per_angstrom", 1.0);
    const double shift = numberOf(metadata, "scene.shift_in_voxels", 0.0);
    if (scale == 1.0 && shift == 0.0) return grids;
    constexpr double least = 1e-9, most = 1e9;
    if (!(scale >= least && scale <= most && std::abs(shift) <= most))
        throw Error(ErrorKind::Input, "metadata scene.units_per_angstrom and shift_in_voxels: "
                                      "expected numbers from 1e-9 to 1e9");
    openvdb::GridPtrVec out;
    for (const auto& grid : grids) {
        const auto placed = openvdb::gridPtrCast<FloatGrid>(grid);
        const bool wanted = grid->getName() == "surface" || grid->getName() == "spline";
        if (!placed || !wanted || !placed->transform().isLinear()) {
            out.push_back(grid);
            continue;
        }
        FloatGrid::Ptr local = placed->copy();
        if (scale != 1.0) {
            local = placed->deepCopy();
            if (placed->getGridClass() == openvdb::GRID_LEVEL_SET)
                openvdb::tools::changeLevelSetBackground(
                    local->tree(), float(double(placed->background()) / scale));
            for (auto it = local->beginValueOn(); it; ++it) it.setValue(float(double(*it) / scale));
        }
        // Voxels of the report, if they are these: a quotient would be off by its last digit.
        double voxel = placed->voxelSize()[0] / scale;
        const double told = numberOf(metadata, "option.voxel", voxel);
        for (const double known : {told, 2.0 * told, 4.0 * told})
            if (std::abs(voxel - known) < 1e-6 * known) voxel = known;
        const Vec3d origin = placed->indexToWorld(Vec3d(0.0)) / scale - Vec3d(shift * voxel);
        auto transform = openvdb::math::Transform::createLinearTransform(voxel);
        transform->postTranslate(origin);
        local->setTransform(transform);
        out.push_back(local);
    }
    return out;
}

/// The voxels nearest to vertices in the frame of the grid.
std::vector<Coord> voxelsOf(const Mesh& mesh, double voxel)
{
    std::vector<Coord> out;
    out.reserve(mesh.positions.size());
    for (const Vec3f& p : mesh.positions) out.push_back(Coord::round(Vec3d(p) / voxel));
    return out;
}

/// A warning for each name that several grids have.
void sayIfSeveral(const openvdb::GridPtrVec& grids, std::vector<std::string>& warnings)
{
    std::map<std::string, int> counts;
    for (const auto& grid : grids) ++counts[grid->getName()];
    for (const auto& [name, count] : counts)
        if (count > 1)
            warnings.push_back("grid '" + name + "': " + std::to_string(count) +
                               " of this name, of which the first counts");
}

template<typename GridT>
std::vector<typename GridT::ValueType> valuesAt(const GridT& grid, const std::vector<Coord>& voxels)
{
    std::vector<typename GridT::ValueType> out;
    out.reserve(voxels.size());
    const auto accessor = grid.getConstAccessor();
    for (const Coord& voxel : voxels) out.push_back(accessor.getValue(voxel));
    return out;
}

/// Reads what addLabelMetadata() wrote.
std::vector<Group> readLabels(const std::string& text)
{
    std::vector<Group> labels;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        const auto color = parseColor(line.substr(0, 7));
        labels.push_back({line.size() > 8 ? line.substr(8) : "", 0, color.value_or(neutralColor)});
    }
    return labels;
}

/// Names and colours of the values of a grid of labels. Values of older files, which have no names,
/// get their numbers, and colours as if each touched all others: then all differ.
std::vector<Group> labelsOf(const Int32Grid& grid, const openvdb::MetaMap& metadata)
{
    std::vector<Group> labels = readLabels(textOf(metadata, "label." + grid.getName()));
    if (!labels.empty()) return labels;
    std::int32_t most = -1;
    for (auto it = grid.cbeginValueOn(); it; ++it) most = std::max(most, *it);
    constexpr std::int32_t last = 4095; // every pair of them takes memory
    if (most > last)
        throw Error(ErrorKind::Input, "grid '" + grid.getName() + "': expected labels up to " +
                                          std::to_string(last) + ", got " + std::to_string(most));
    std::vector<std::vector<std::int32_t>> others(std::size_t(most) + 1);
    for (std::size_t i = 0; i < others.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) others[i].push_back(std::int32_t(j));
    const std::vector<Color> colors = distinctColors(others);
    labels.clear();
    for (std::size_t i = 0; i < colors.size(); ++i)
        labels.push_back({std::to_string(i), 0, colors[i]});
    return labels;
}

Color colorOf(const std::vector<Group>& labels, std::int32_t value)
{
    const bool known = value >= 0 && std::size_t(value) < labels.size();
    return known ? *labels[std::size_t(value)].color : neutralColor;
}

/// The source of the labels and colours of a stored surface.
struct Source {
    const openvdb::GridPtrVec& grids;
    const openvdb::MetaMap& metadata;
    std::vector<Coord> voxels; ///< those nearest to the vertices
    const Coloring& coloring;
};

/// Adds the identities that the grids hold to the mesh.
/// @return names and colours of chains and groups
BallLabels addLabels(const Source& from, Mesh& mesh)
{
    BallLabels names;
    if (const auto ids = findGrid<Int32Grid>(from.grids, "atom_id"))
        mesh.labels.push_back({"atom_id", valuesAt(*ids, from.voxels)});
    if (const auto chains = findGrid<Int32Grid>(from.grids, "chain_id")) {
        mesh.labels.push_back({"chain_id", valuesAt(*chains, from.voxels)});
        for (const Group& chain : labelsOf(*chains, from.metadata)) {
            names.chains.push_back(chain.name);
            names.chainColors.push_back(*chain.color);
        }
    }
    if (const auto groups = findGrid<Int32Grid>(from.grids, "group_id")) {
        mesh.labels.push_back({"group_id", valuesAt(*groups, from.voxels)});
        names.groups = labelsOf(*groups, from.metadata);
    }
    return names;
}

/// Adds the values that colours show, if they are stored and no curvature of the mesh.
void addValues(const Source& from, Mesh& mesh)
{
    const auto values = findGrid<FloatGrid>(from.grids, "value");
    if (!values) return;
    Attribute<float> scalar{textOf(*values, "attribute"), {}};
    for (const auto& known : mesh.scalars)
        if (known.name == scalar.name) return;
    const auto accessor = values->getConstAccessor();
    for (const Coord& voxel : from.voxels) {
        float value = 0.0f;
        const bool active = accessor.probeValue(voxel, value);
        scalar.values.push_back(active ? value : std::numeric_limits<float>::quiet_NaN());
    }
    if (scalar.name.empty()) scalar.name = values->getName();
    mesh.scalars.push_back(std::move(scalar));
}

/// Adds a grid of colours to a surface, placed as that of the file.
void addColorGrid(const Source& from, const Vec3SGrid::Ptr& grid, LevelSetSurface& result)
{
    for (const auto& other : from.grids)
        if (other->getName() == "surface" || from.grids.size() == 1)
            grid->setTransform(other->transform().copy());
    result.fields.push_back(grid);
}

void colorByLabel(const Source& from, const Int32Grid& ids, LevelSetSurface& result)
{
    const std::vector<Group> labels = labelsOf(ids, from.metadata);
    for (const std::int32_t id : valuesAt(ids, from.voxels))
        result.mesh.colors.push_back(colorOf(labels, id));
    const auto grid = gridLike<Vec3SGrid>(ids, "Cd", linearLight(neutralColor));
    auto to = grid->beginValueOn();
    for (auto id = ids.cbeginValueOn(); id; ++id, ++to)
        to.setValue(linearLight(colorOf(labels, *id)));
    describeColors(*grid);
    addColorGrid(from, grid, result);
}

/// @param[in] levelSet  that the spline was fitted to
void colorByCurvature(const Source& from, ColorBy by, FloatGrid& levelSet, const Spline& spline,
                      Progress& progress, LevelSetSurface& result)
{
    colorByCurvature(by, from.coloring, result.mesh);
    const auto local = levelSet.copy();
    local->setTransform(openvdb::math::Transform::createLinearTransform(levelSet.voxelSize()[0]));
    const openvdb::GridPtrVec curvatures =
        curvatureGrids(*local, spline, {curvatureNameOf(by)}, progress);
    const auto colors = curvatureColors(by, from.coloring, result.mesh, curvatures).at(0);
    addColorGrid(from, openvdb::gridPtrCast<Vec3SGrid>(colors), result);
}

/// The colours of the file, if these are colours that the program knows.
ColorBy storedColors(const Source& from)
{
    if (!findGrid<Vec3SGrid>(from.grids, "Cd")) return ColorBy::Nothing;
    for (const ColorKind& kind : colorTable())
        if (textOf(from.metadata, "option.color") == kind.word) return kind.by;
    return ColorBy::Nothing;
}

/// Refuses colours that a file has no grids for. Those of chains and groups are read from ids, all
/// others from the stored Cd; both need the spline.
[[noreturn]] void cannotColor(ColorBy by, const openvdb::GridPtrVec& grids)
{
    const std::string word = nameOf(by);
    std::string held, hint;
    for (const auto& grid : grids) held += (held.empty() ? "" : ",") + grid->getName();
    if (by == ColorBy::Pocket)
        throw Error(ErrorKind::Input,
                    "`color` pocket: pockets are found when a surface is built, not in a file");
    if (by == ColorBy::Chain || by == ColorBy::Group)
        hint = "`fields` spline," + word + "_id";
    else
        hint = "`color` " + word + " `fields` spline,Cd";
    throw Error(ErrorKind::Input, "`color` " + word + ": the file cannot give these colours, it " +
                                      "has the grids " + held +
                                      " [hint: store them when it is built: " + hint + "]");
}

/// Colours the mesh, and adds the grid of colours.
/// @param[in] kept  whether colours of the file are taken whatever they show
/// @throws Error(ErrorKind::Input) if the file cannot give the colours
void addColors(const Source& from, bool kept, ColorBy by, SurfaceRun& run, Progress& progress)
{
    LevelSetSurface& result = run.result();
    const auto colors = findGrid<Vec3SGrid>(from.grids, "Cd");
    const auto chains = findGrid<Int32Grid>(from.grids, "chain_id");
    const auto groups = findGrid<Int32Grid>(from.grids, "group_id");
    if (curvatureNameOf(by)) {
        colorByCurvature(from, by, *result.surface, run.currentSpline(), progress, result);
    } else if (colors && (kept || textOf(from.metadata, "option.color") == nameOf(by))) {
        for (const Vec3f& light : valuesAt(*colors, from.voxels))
            result.mesh.colors.push_back(
                {fromLinearLight(light[0]), fromLinearLight(light[1]), fromLinearLight(light[2])});
        addColorGrid(from, colors, result);
    } else if (by == ColorBy::Chain && chains) {
        colorByLabel(from, *chains, result);
    } else if (by == ColorBy::Group && groups) {
        colorByLabel(from, *groups, result);
    } else if (by != ColorBy::Nothing) {
        cannotColor(by, from.grids);
    }
}

} // namespace

void addLabelMetadata(const BallSet& atoms, const std::vector<std::string>& fields,
                      const Progress& progress, openvdb::MetaMap& metadata)
{
    if (!atoms.labels) return;
    const auto add = [&](const char* field, std::size_t count, const auto& nameOfLabel,
                         const std::vector<Color>& colors) {
        if (!hasField(fields, field) || count == 0) return;
        std::string text;
        for (std::size_t i = 0; i < count; ++i) {
            text += hexOf(colors[i]) + " " + nameOfLabel(i) + "\n";
        }
        metadata.insertMeta(std::string("label.") + field, openvdb::StringMetadata(text));
    };
    const BallLabels& labels = *atoms.labels;
    add(
        "chain_id", labels.chains.size(), [&](std::size_t i) { return labels.chains[i]; },
        chainColors(atoms, progress));
    add(
        "group_id", labels.groups.size(), [&](std::size_t i) { return labels.groups[i].name; },
        groupColors(atoms, progress));
}

StoredSurface storedSurface(const openvdb::GridPtrVec& written, const openvdb::MetaMap& metadata,
                            const SurfaceOptions& options, const Coloring& coloring,
                            Progress& progress)
{
    const openvdb::GridPtrVec grids = withIntLabels(written);
    StoredSurface stored;
    stored.names.coloring = coloring;
    stored.scale = numberOf(metadata, "scene.units_per_angstrom", 1.0);
    progress.update("mesh", 0.0);
    Operand operand = storedOperand(inAngstrom(grids, metadata), progress);
    sayIfSeveral(grids, stored.warnings);
    if (!findGrid<FloatGrid>(grids, "spline"))
        stored.warnings.push_back("no grid spline: it is fitted to the level set, close to the "
                                  "one that was [hint: `fields` spline when it is built]");
    for (const std::string& warning : operand.warnings) stored.warnings.push_back(warning);
    const BallModel none;
    SurfaceRun run(none, {withVoxel(options, operand.voxel), options}, Scope(), progress);
    const Motion pose = operand.surface.pose;
    run.resume(std::move(operand.surface.mesh), std::move(*operand.surface.spline),
               operand.levelSet);
    LevelSetSurface& result = run.result();
    run.measure();
    run.describeCurvature();
    run.remesh();
    run.curvatures();
    run.integrateCurvature();
    const Source from{grids, metadata, voxelsOf(result.mesh, operand.voxel), coloring};
    place(pose, result.mesh);

    Report& report = result.report;
    for (std::string& warning : report.warnings) stored.warnings.push_back(std::move(warning));
    const std::string kind = textOf(metadata, "option.surface");
    report.surface.kind = kind.empty() ? "level set" : kind;
    report.surface.maxResidual = report.surface.gradientShare = report.surface.kinkShare =
        std::numeric_limits<double>::quiet_NaN();
    report.voxel = operand.voxel;
    const auto atoms = metadata.getMetadata<openvdb::Int64Metadata>("atoms");
    if (atoms) report.atoms = std::size_t(atoms->value());

    progress.update("color", 0.0);
    BallLabels names = addLabels(from, result.mesh);
    addValues(from, result.mesh);
    ColorBy& by = stored.options.color;
    by = options.color == ColorBy::Nothing ? storedColors(from) : options.color;
    addColors(from, options.color == ColorBy::Nothing, by, run, progress);
    if ((coloring.range || !coloring.palette.empty()) && !kindOf(by).ofCurvature)
        stored.warnings.push_back("`range` and `palette`: the colours are those of the file, only "
                                  "curvatures get others [hint: both when it is built]");
    stored.names.labels = std::move(names);
    stored.result = run.finish();
    return stored;
}

} // namespace molsurf
