// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/scene.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"

#include <openvdb/tools/ChangeBackground.h>
#include <openvdb/tools/ValueTransformer.h>

#include <cmath>

namespace molsurf
{

namespace
{

/// A program.
struct HostRow {
    Host host;
    const char* word;
    double shift;   ///< that brings grids to where it shows them rightly [voxel]
    bool fogsAlone; ///< it takes no level sets, and fogs only with 16 bits in one box
};
constexpr HostRow hosts[] = {{Host::None, "none", 0.0, false},
                             {Host::Blender, "blender", 0.0, false},
                             {Host::Blender4, "blender4", -0.5, false},
                             {Host::Houdini, "houdini", 0.0, false},
                             {Host::Usd, "usd", 0.0, false},
                             {Host::Unreal, "unreal", 0.0, true},
                             {Host::Arnold, "arnold", 0.0, false}};

const HostRow& rowOf(Host host)
{
    for (const HostRow& row : hosts)
        if (row.host == host) return row;
    return hosts[0];
}

std::optional<double> parseScale(const std::string& text)
{
    if (text == "mn-0.01") return 0.01;
    if (text == "mn-0.1" || text == "nm") return 0.1;
    double scale = 0.0;
    constexpr double least = 1e-12, most = 1e6; // so that floats hold what comes of it
    if (!parseWhole(text, scale) || !(scale >= least && scale <= most)) return {};
    return scale;
}

openvdb::GridBase::Ptr scaledValues(const openvdb::FloatGrid& grid, double factor)
{
    auto out = grid.deepCopy();
    const auto multiply = [=](const openvdb::FloatGrid::ValueOnIter& it) {
        it.setValue(float(double(*it) * factor));
    };
    if (grid.getGridClass() == openvdb::GRID_LEVEL_SET)
        openvdb::tools::changeLevelSetBackground(out->tree(),
                                                 float(double(grid.background()) * factor));
    openvdb::tools::foreach (out->beginValueOn(), multiply);
    return out;
}

} // namespace

std::optional<Scene> parseScene(const std::string& text)
{
    const std::size_t split = text.find('=');
    for (const HostRow& row : hosts) {
        if (row.host == Host::None || text.substr(0, split) != row.word) continue;
        Scene scene;
        scene.host = row.host;
        scene.form.oneBox = scene.form.half = row.fogsAlone;
        if (split == std::string::npos) return scene;
        const auto scale = parseScale(text.substr(split + 1));
        if (!scale) return {};
        scene.scale = *scale;
        return scene;
    }
    return {};
}

const char* nameOf(Host host)
{
    return rowOf(host).word;
}

std::vector<std::string> hostNames()
{
    std::vector<std::string> names;
    for (const HostRow& row : hosts)
        if (row.host != Host::None) names.push_back(row.word);
    return names;
}

int lengthPower(const openvdb::GridBase& grid)
{
    if (grid.getGridClass() == openvdb::GRID_LEVEL_SET) return 1;
    const std::string name = grid.getName();
    const auto is = [&](const char* field) { return name.rfind(field, 0) == 0; };
    if (is("spline")) return 1;
    if (is("mean_curvature") || is("principal_curvature") || is("curvedness")) return -1;
    if (is("gaussian_curvature")) return -2;
    return 0;
}

namespace
{

/// Factor of the values of a grid.
double factorOf(const openvdb::GridBase& grid, const Scene& scene)
{
    const bool fog = grid.getName().rfind("density", 0) == 0;
    if (fog && scene.fogDensity > 0.0) return scene.fogDensity / scene.scale;
    const int power = lengthPower(grid);
    return power == 0 ? 1.0 : std::pow(scene.scale, power);
}

} // namespace

openvdb::GridCPtrVec placeInScene(const openvdb::GridCPtrVec& grids, const Scene& scene,
                                  bool isMoved)
{
    if (!scene.known() && !isMoved) return formed(grids, scene.form);
    openvdb::GridCPtrVec out;
    for (const auto& grid : grids) {
        if (rowOf(scene.host).fogsAlone && lengthPower(*grid) == 1) continue;
        const double factor = factorOf(*grid, scene);
        const auto floats = openvdb::gridConstPtrCast<openvdb::FloatGrid>(grid);
        openvdb::GridBase::Ptr placed;
        if (factor != 1.0 && floats)
            placed = scaledValues(*floats, factor);
        else
            placed = openvdb::ConstPtrCast<openvdb::GridBase>(grid->copyGrid());

        const double voxel = grid->voxelSize()[0];
        openvdb::Vec3d origin = grid->indexToWorld(openvdb::Vec3d(0.0)) - scene.center;
        origin += openvdb::Vec3d(rowOf(scene.host).shift * voxel);
        auto transform = openvdb::math::Transform::createLinearTransform(scene.scale * voxel);
        transform->postTranslate(scene.scale * origin);
        placed->setTransform(transform);
        out.push_back(placed);
    }
    if (out.empty())
        throw Error(ErrorKind::Usage, std::string("`for` ") + nameOf(scene.host) +
                                          ": expected a fog, got distances alone [hint: `fields` "
                                          "density,Cd]");
    return formed(out, scene.form);
}

void describeScene(const Scene& scene, openvdb::MetaMap& metadata)
{
    const auto add = [&](const char* name, double value) {
        metadata.insertMeta(name, openvdb::DoubleMetadata(value));
    };
    add("scene.center_x", scene.center[0]);
    add("scene.center_y", scene.center[1]);
    add("scene.center_z", scene.center[2]);
    add("scene.units_per_angstrom", scene.scale);
    add("scene.shift_in_voxels", rowOf(scene.host).shift);
}

} // namespace molsurf
