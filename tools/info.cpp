// SPDX-License-Identifier: MPL-2.0
#include "verbs.h"

#include "molsurf/error.h"
#include "molsurf/io/read_vdb.h"

#include <openvdb/tools/LevelSetMeasure.h>

#include <iostream>

namespace molsurf::tool
{

namespace
{

template<typename T>
std::string text(const T& value)
{
    std::ostringstream stream;
    stream << value;
    return stream.str();
}

std::string backgroundOf(const openvdb::GridBase& grid)
{
    if (const auto* floats = dynamic_cast<const openvdb::FloatGrid*>(&grid))
        return text(floats->background());
    const openvdb::Metadata::Ptr background = grid.baseTree().getBackgroundValue();
    return background ? background->str() : "unknown";
}

void measure(const openvdb::FloatGrid& grid)
{
    // Both walk the interface; without one there is nothing to measure.
    if (grid.empty()) return;
    line("area", text(openvdb::tools::levelSetArea(grid)) + " Å^2");
    line("volume", text(openvdb::tools::levelSetVolume(grid)) + " Å^3");
}

void describe(const openvdb::GridBase& grid)
{
    std::cout << "  grid " << grid.getName() << "\n";
    line("type", grid.type());
    line("class", openvdb::GridBase::gridClassToString(grid.getGridClass()));
    line("transform", grid.transform().mapType());
    const openvdb::Vec3d voxel = grid.voxelSize();
    const bool cubes = grid.hasUniformVoxels();
    line("voxel size", (cubes ? text(voxel[0]) : text(voxel)) + " Å");
    line("background", backgroundOf(grid));
    line("active voxels", text(grid.activeVoxelCount()));
    line("memory", text(grid.memUsage()) + " bytes");
    const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
    if (!box.empty()) {
        const openvdb::BBoxd world = grid.transform().indexToWorld(box);
        line("bounding box", text(world.min()) + " to " + text(world.max()) + " Å");
    }
    const auto* floats = dynamic_cast<const openvdb::FloatGrid*>(&grid);
    if (floats && cubes && grid.getGridClass() == openvdb::GRID_LEVEL_SET) measure(*floats);
    for (auto meta = grid.beginMeta(); meta != grid.endMeta(); ++meta)
        if (meta->first != "name" && meta->first != "class")
            line(meta->first.c_str(), meta->second->str());
}

} // namespace

void line(const char* name, const std::string& value)
{
    std::string text = "    " + std::string(name);
    text.resize(std::max<std::size_t>(text.size() + 1, 20), ' ');
    std::cout << text << value << "\n";
}

int info(const Call& call)
{
    openvdb::initialize();
    for (const std::string& path : call.inputs) {
        if (!isVdbFile(path)) {
            infoStructure(path);
            continue;
        }
        const VdbFile file = readVdb(path);
        std::cout << path << "\n  metadata\n";
        for (auto meta = file.metadata.beginMeta(); meta != file.metadata.endMeta(); ++meta)
            line(meta->first.c_str(), meta->second->str());
        for (const auto& grid : file.grids) describe(*grid);
    }
    return 0;
}

} // namespace molsurf::tool
