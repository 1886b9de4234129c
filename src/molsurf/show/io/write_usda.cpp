// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/write_usda.h"

#include "molsurf/kernel/core/strings.h"
#include "molsurf/show/io/rotation_quaternion.h"
#include "molsurf/show/io/usda_text.h"

#include <algorithm>
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

bool hasGrid(const openvdb::GridCPtrVec& grids, const std::string& name)
{
    return std::any_of(grids.begin(), grids.end(),
                       [&](const auto& grid) { return grid->getName() == name; });
}

std::string indented(const std::string& text, const std::string& by)
{
    std::istringstream lines(text);
    std::string all;
    for (std::string line; std::getline(lines, line);)
        all += (line.empty() ? "" : by) + line + "\n";
    return all;
}

/// A node of MaterialX: its inputs are lines.
void writeNode(const std::string& name, const std::string& id, const std::string& inputs,
               const std::string& output, std::ostream& out)
{
    out << "\ndef Shader \"" << name << "\"\n{\n    uniform token info:id = \"" << id << "\"\n"
        << inputs << "    " << output << " outputs:out\n}\n";
}

/// The nodes of fog that scatters light and takes none.
/// @param[in] colored  by the grid `Cd`
std::string fogNodes(const std::string& path, bool colored)
{
    const auto from = [&](const std::string& input, const std::string& node) {
        return "    " + input + ".connect = <" + path + node + ">\n";
    };
    const auto read = [](const char* field) {
        return "    string inputs:geomprop = \"" + std::string(field) + "\"\n";
    };
    std::ostringstream out;
    out << "token outputs:mtlx:volume.connect = <" << path << "/volume.outputs:out>\n";
    writeNode("volume", "ND_volume", from("token inputs:vdf", "/scatter.outputs:out"), "token",
              out);
    writeNode("scatter", "ND_anisotropic_vdf",
              "    float3 inputs:absorption = (0, 0, 0)\n" +
                  from("float3 inputs:scattering", "/light.outputs:out"),
              "token", out);
    writeNode("light", "ND_multiply_vector3FA",
              (colored ? from("float3 inputs:in1", "/color.outputs:out")
                       : "    float3 inputs:in1 = (1, 1, 1)\n") +
                  from("float inputs:in2", "/depth.outputs:out"),
              "float3", out);
    writeNode("depth", "ND_multiply_float",
              from("float inputs:in1", "/density.outputs:out") +
                  from("float inputs:in2", ".inputs:scattering"),
              "float", out);
    writeNode("density", "ND_geompropvalue_float", read("density"), "float", out);
    if (colored) writeNode("color", "ND_geompropvalue_vector3", read("Cd"), "float3", out);
    return out.str();
}

/// The Material, whose nodes are in a variant: OpenUSD without MaterialX does not know them.
void writeFog(const std::string& name, double scattering, bool colored, std::ostream& out)
{
    out << "\n    def Material \"fog\"\n    {\n        float inputs:scattering = " << scattering
        << " (\n            doc = \"optical depth of a unit of length where density is 1\"\n       "
           " )\n    }\n"
        << "    variantSet \"fog\" = {\n        \"materialx\" {\n            over \"fog\"\n        "
           "    {\n"
        << indented(fogNodes("/" + name + "/fog", colored), std::string(16, ' '))
        << "            }\n        }\n        \"plain\" {\n        }\n    }\n";
}

/// The Volume and its fields, under the path `above`.
std::string volumeText(const openvdb::GridCPtrVec& grids, const UsdVolume& volume,
                       const std::string& above)
{
    std::ostringstream out;
    const bool fog = hasGrid(grids, "density");
    out << "    def Volume \"volume\"";
    if (fog) out << " (\n        prepend apiSchemas = [\"MaterialBindingAPI\"]\n    )";
    out << "\n    {\n";
    writeExtent(grids, volume, out);
    for (const auto& grid : grids) {
        const std::string field = usdaIdentifier(grid->getName());
        out << "        rel field:" << field << " = <" << above << "/volume/" << field << ">\n";
    }
    if (fog) out << "        rel material:binding = </" << usdaIdentifier(volume.name) << "/fog>\n";
    for (const auto& grid : grids) writeField(*grid, volume, out);
    out << "    }\n";
    return out.str();
}

/// The copies of the volume about its middle, see writeUsdaInstances().
std::string copiesText(const openvdb::GridCPtrVec& grids, const UsdVolume& volume)
{
    const openvdb::BBoxd box = extentOf(grids);
    const openvdb::Vec3d middle = box.getCenter();
    const std::string unit = "/" + usdaIdentifier(volume.name) + "/copies/prototypes/unit";
    std::ostringstream places, turns, order, ids, out;
    for (std::ostringstream* each : {&places, &turns, &out}) each->precision(9);
    openvdb::BBoxd all;
    for (std::size_t i = 0; i < volume.copies.size(); ++i) {
        const Instance& copy = volume.copies[i];
        const char* between = i == 0 ? "" : ", ";
        const openvdb::Vec3d place = copy.placed(middle);
        const auto [x, y, z, w] = quaternionOf(copy.rotation);
        places << between << "(" << place[0] << ", " << place[1] << ", " << place[2] << ")";
        turns << between << "(" << w << ", " << x << ", " << y << ", " << z << ")";
        order << between << "0";
        ids << between << i + 1;
        for (int corner = 0; corner < 8; ++corner)
            all.expand(copy.placed({box.min()[0] + (corner & 1 ? box.extents()[0] : 0.0),
                                    box.min()[1] + (corner & 2 ? box.extents()[1] : 0.0),
                                    box.min()[2] + (corner & 4 ? box.extents()[2] : 0.0)}));
    }
    out << "    def PointInstancer \"copies\"\n    {\n        float3[] extent = [(" << all.min()[0]
        << ", " << all.min()[1] << ", " << all.min()[2] << "), (" << all.max()[0] << ", "
        << all.max()[1] << ", " << all.max()[2] << ")]\n        int64[] ids = [" << ids.str()
        << "]\n        int[] protoIndices = [" << order.str()
        << "]\n        point3f[] positions = [" << places.str()
        << "]\n        quath[] orientations = [" << turns.str()
        << "]\n        quatf[] orientationsf = [" << turns.str() << "]\n        rel prototypes = [<"
        << unit << ">]\n\n        def Scope \"prototypes\"\n"
        << "        {\n            def Xform \"unit\"\n            {\n"
        << "                double3 xformOp:translate = (" << -middle[0] << ", " << -middle[1]
        << ", " << -middle[2]
        << ")\n                uniform token[] xformOpOrder = [\"xformOp:translate\"]\n\n"
        << indented(volumeText(grids, volume, unit), "            ")
        << "            }\n        }\n    }\n";
    return out.str();
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
    out << "    upAxis = \"Z\"\n)\n\ndef Xform \"" << name << "\" (\n    kind = \"component\"\n";
    const bool fog = hasGrid(grids, "density");
    if (fog)
        out << "    variants = {\n        string fog = \"plain\"\n    }\n"
            << "    prepend variantSets = \"fog\"\n";
    out << ")\n{\n"
        << (volume.copies.empty() ? volumeText(grids, volume, "/" + name)
                                  : copiesText(grids, volume));
    if (fog) writeFog(name, volume.scattering, hasGrid(grids, "Cd"), out);
    out << "}\n";
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
