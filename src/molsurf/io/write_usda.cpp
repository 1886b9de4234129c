// SPDX-License-Identifier: MPL-2.0
#include "molsurf/io/write_usda.h"

#include "molsurf/core/words.h"
#include "molsurf/io/usda_text.h"

#include <fstream>
#include <limits>
#include <sstream>
#include <string_view>

namespace molsurf
{

namespace
{

constexpr const char* ofVolume = "vdb_molsurf";

const char* classOf(const openvdb::GridBase& grid)
{
    switch (grid.getGridClass()) {
    case openvdb::GRID_LEVEL_SET:
        return "levelSet";
    case openvdb::GRID_FOG_VOLUME:
        return "fogVolume";
    default:
        return "unknown";
    }
}

const char* typeOf(const openvdb::GridBase& grid)
{
    if (grid.valueType() == "vec3s") return "float3";
    return grid.valueType() == "int32" ? "int" : "float";
}

// The box of the active voxels of all grids.
openvdb::BBoxd extentOf(const openvdb::GridCPtrVec& grids)
{
    openvdb::BBoxd box;
    for (const auto& grid : grids) {
        const openvdb::CoordBBox voxels = grid->evalActiveVoxelBoundingBox();
        if (voxels.empty()) continue;
        box.expand(grid->indexToWorld(voxels.min()));
        box.expand(grid->indexToWorld(voxels.max()));
    }
    return box.empty() ? openvdb::BBoxd(openvdb::Vec3d(0.0), openvdb::Vec3d(0.0)) : box;
}

void writeField(const openvdb::GridBase& grid, const UsdVolume& volume, std::ostream& out)
{
    out << "\n        def OpenVDBAsset \"" << usdaIdentifier(grid.getName()) << "\"\n        {\n"
        << "            token fieldName = " << usdaString(grid.getName()) << "\n"
        << "            token fieldClass = \"" << classOf(grid) << "\"\n"
        << "            token fieldDataType = \"" << typeOf(grid) << "\"\n";
    if (grid.valueType() == "vec3s")
        out << "            token vectorDataRoleHint = \""
            << (grid.getName().rfind("Cd", 0) == 0 ? "Color" : "Vector") << "\"\n";
    if (volume.frames.empty()) {
        out << "            asset filePath = " << usdaAsset(volume.file) << "\n";
    } else {
        out << "            asset filePath.timeSamples = {\n";
        for (const auto& [frame, file] : volume.frames)
            out << "                " << frame << ": " << usdaAsset(file) << ",\n";
        out << "            }\n";
    }
    out << "        }\n";
}

// The extent of a frame is a line of its own, so that the file that takes the place of this one can
// keep it.
constexpr std::string_view extentIndent = "            ";

std::string extentText(const openvdb::GridCPtrVec& grids)
{
    std::ostringstream out;
    out.precision(std::numeric_limits<float>::max_digits10);
    const openvdb::BBoxd box = extentOf(grids);
    out << "[(" << box.min()[0] << ", " << box.min()[1] << ", " << box.min()[2] << "), ("
        << box.max()[0] << ", " << box.max()[1] << ", " << box.max()[2] << ")]";
    return out.str();
}

void writeExtent(const openvdb::GridCPtrVec& grids, const UsdVolume& volume, std::ostream& out)
{
    if (volume.frames.empty()) {
        out << "        float3[] extent = " << extentText(grids) << "\n";
        return;
    }
    out << "        float3[] extent.timeSamples = {\n";
    for (const auto& [frame, file] : volume.frames) {
        const auto known = volume.extents.find(frame);
        if (file == volume.file || known != volume.extents.end())
            out << extentIndent << frame << ": "
                << (file == volume.file ? extentText(grids) : known->second) << ",\n";
    }
    out << "        }\n";
}

std::string usdaText(const openvdb::GridCPtrVec& grids, const UsdVolume& volume)
{
    std::ostringstream out;
    out.precision(std::numeric_limits<float>::max_digits10);
    const std::string name = usdaIdentifier(volume.name);
    out << usdaFirstLine << "\n(\n    customLayerData = {\n"
        << usdaDataLine("creator", ofVolume) << "\n    }\n    defaultPrim = \"" << name << "\"\n";
    if (!volume.frames.empty()) out << "    endTimeCode = " << volume.frames.back().first << "\n";
    out << "    metersPerUnit = " << volume.metersPerUnit << "\n";
    if (!volume.frames.empty())
        out << "    startTimeCode = " << volume.frames.front().first
            << "\n    timeCodesPerSecond = " << volume.framesPerSecond << "\n";
    out << "    upAxis = \"Z\"\n)\n\ndef Xform \"" << name
        << "\" (\n    kind = \"component\"\n)\n{\n    def Volume \"volume\"\n    {\n";
    writeExtent(grids, volume, out);
    for (const auto& grid : grids) {
        const std::string field = usdaIdentifier(grid->getName());
        out << "        rel field:" << field << " = </" << name << "/volume/" << field << ">\n";
    }
    for (const auto& grid : grids) writeField(*grid, volume, out);
    out << "    }\n}\n";
    return out.str();
}

} // namespace

void writeUsda(const openvdb::GridCPtrVec& grids, const UsdVolume& volume, OutputFile& file)
{
    file.write(usdaText(grids, volume));
    file.finish();
}

bool isOwnUsda(const std::string& path)
{
    return usdaData(path, "creator") == ofVolume;
}

std::map<int, std::string> extentsOfUsda(const std::string& path)
{
    std::map<int, std::string> extents;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line) && line.find(" rel ") == std::string::npos;) {
        const std::size_t colon = line.find(": [(");
        int frame = 0;
        if (line.rfind(extentIndent, 0) == 0 && colon != std::string::npos && line.back() == ',' &&
            parseWhole(
                std::string_view(line).substr(extentIndent.size(), colon - extentIndent.size()),
                frame))
            extents[frame] = line.substr(colon + 2, line.size() - colon - 3);
    }
    return extents;
}

} // namespace molsurf
