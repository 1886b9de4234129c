// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/describe_vdb.h"

#include "molsurf/kernel/core/printable.h"
#include "molsurf/show/io/read_vdb.h"

#include <openvdb/tools/LevelSetMeasure.h>

#include <sstream>

namespace molsurf
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

std::string measure(const openvdb::FloatGrid& grid)
{
    // Both walk the interface; without one there is nothing to measure.
    if (grid.empty()) return "";
    return infoLine("area", text(openvdb::tools::levelSetArea(grid)) + " Å^2") +
           infoLine("volume", text(openvdb::tools::levelSetVolume(grid)) + " Å^3");
}

std::string describe(const openvdb::GridBase& grid)
{
    std::string out = infoTitle("  grid " + grid.getName());
    out += infoLine("type", grid.type());
    out += infoLine("class", openvdb::GridBase::gridClassToString(grid.getGridClass()));
    out += infoLine("transform", grid.transform().mapType());
    const openvdb::Vec3d voxel = grid.voxelSize();
    const bool cubes = grid.hasUniformVoxels();
    out += infoLine("voxel size", (cubes ? text(voxel[0]) : text(voxel)) + " Å");
    out += infoLine("background", backgroundOf(grid));
    out += infoLine("active voxels", text(grid.activeVoxelCount()));
    out += infoLine("memory", text(grid.memUsage()) + " bytes");
    const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
    if (!box.empty()) {
        const openvdb::BBoxd world = grid.transform().indexToWorld(box);
        out += infoLine("bounding box", text(world.min()) + " to " + text(world.max()) + " Å");
    }
    const auto* floats = dynamic_cast<const openvdb::FloatGrid*>(&grid);
    if (floats && cubes && grid.getGridClass() == openvdb::GRID_LEVEL_SET) out += measure(*floats);
    for (auto meta = grid.beginMeta(); meta != grid.endMeta(); ++meta)
        if (meta->first != "name" && meta->first != "class")
            out += infoLine(meta->first, meta->second->str());
    return out;
}

} // namespace

std::string describeVdb(const std::string& path)
{
    const VdbFile file = readVdb(path);
    std::string out = infoTitle(path) + infoTitle("  metadata");
    for (auto meta = file.metadata.beginMeta(); meta != file.metadata.endMeta(); ++meta)
        out += infoLine(meta->first, meta->second->str());
    for (const auto& grid : file.grids) out += describe(*grid);
    return out;
}

} // namespace molsurf
