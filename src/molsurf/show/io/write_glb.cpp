// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/write_glb.h"

#include "molsurf/error.h"
#include "molsurf/show/io/part_ranges.h"
#include "molsurf/show/io/rotation_quaternion.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace molsurf
{

namespace
{

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "glTF is written as it lies");

using Json = nlohmann::ordered_json;
using openvdb::Vec3f;

// Numbers that the specification gives to types.
constexpr int floatType = 5126, shortType = 5123, indexType = 5125;
constexpr int vertexTarget = 34962, indexTarget = 34963;

std::string attributeName(const std::string& name)
{
    std::string capitals = "_";
    for (const char letter : name)
        capitals += char(std::toupper(static_cast<unsigned char>(letter)));
    return capitals;
}

/// The tables of the file and the bytes that they speak of.
class Document
{
public:
    Document(const Mesh& mesh, const GlbOptions& options) : mesh_(&mesh)
    {
        json_["asset"] = {{"version", "2.0"}, {"generator", "vdb_molsurf"}};
        json_["scene"] = 0;
        if (options.instances.empty()) {
            addRoot(options, "");
            addMaterial("surface", mesh.colors.empty() ? options.plain : white);
            const std::vector<PartRange> ranges = partRanges(mesh, options.name);
            for (const PartRange& range : ranges) {
                const Json primitive = primitiveOf(range);
                addNode(addMesh(range.name, primitive, 0), range.name, ranges.size() > 1);
            }
        } else {
            const std::size_t levels = 1 + options.coarser.size();
            for (std::size_t level = 0; level < levels; ++level) {
                if (level > 0) mesh_ = options.coarser[level - 1];
                const std::string name = levels > 1 ? " lod" + std::to_string(level) : "";
                addRoot(options, name);
                addInstances(partRanges(*mesh_, options.name), options.instances, name);
            }
        }
        json_["buffers"] = Json::array({Json{{"byteLength", bytes_.size()}}});
    }

    std::string header() const
    {
        return json_.dump(-1, ' ', false, Json::error_handler_t::replace);
    }
    const std::vector<char>& bytes() const { return bytes_; }

private:
    static constexpr Color white = {255, 255, 255};

    /// A scene with one node, below which the next ones come.
    void addRoot(const GlbOptions& options, const std::string& level)
    {
        const double half = std::sqrt(0.5), scale = options.scale;
        Json root = {{"name", options.name + level}, {"rotation", {-half, 0.0, 0.0, half}}};
        if (scale != 1.0) root["scale"] = {scale, scale, scale};
        root_ = json_["nodes"].size();
        json_["nodes"].push_back(root);
        json_["scenes"].push_back({{"name", options.name + level}, {"nodes", {root_}}});
    }

    void addMaterial(const std::string& name, const Color& color)
    {
        const Vec3f light = linearLight(color);
        const Json base = {light[0], light[1], light[2], 1.0};
        json_["materials"].push_back(
            {{"name", name},
             {"pbrMetallicRoughness",
              {{"baseColorFactor", base}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.5}}}});
    }

    /// The attributes and indices of a part.
    Json primitiveOf(const PartRange& range)
    {
        Json attributes = Json::object();
        attributes["POSITION"] = addPositions(range);
        attributes["NORMAL"] = addNormals(range);
        if (!mesh_->colors.empty()) attributes["COLOR_0"] = addColors(range);
        for (const VertexField& field : vertexFields(*mesh_))
            attributes[attributeName(field.name == "v" ? "velocity" : field.name)] =
                addField(range, field);
        for (const auto& label : mesh_->labels)
            attributes[attributeName(label.name)] = addNumbers(range, label.values);
        return {{"attributes", attributes}, {"indices", addTriangles(range)}};
    }

    std::size_t addMesh(const std::string& name, Json primitive, std::size_t material)
    {
        primitive["material"] = material;
        json_["meshes"].push_back(
            {{"name", name}, {"primitives", Json::array({std::move(primitive)})}});
        return json_["meshes"].size() - 1;
    }

    Json& addNode(std::size_t mesh, const std::string& name, bool several)
    {
        if (!several) {
            json_["nodes"][root_]["mesh"] = mesh;
            return json_["nodes"][root_];
        }
        json_["nodes"][root_]["children"].push_back(json_["nodes"].size());
        json_["nodes"].push_back({{"name", name}, {"mesh", mesh}});
        return json_["nodes"].back();
    }

    void addInstances(const std::vector<PartRange>& ranges,
                      const std::vector<MeshInstance>& instances, const std::string& level)
    {
        std::vector<Json> primitives;
        for (const PartRange& range : ranges) primitives.push_back(primitiveOf(range));
        std::map<std::pair<std::size_t, std::size_t>, std::size_t> meshes; // by part and material
        for (const MeshInstance& instance : instances) {
            const PartRange& range = ranges[instance.part];
            const auto [material, isNew] = materials_.emplace(instance.color, materials_.size());
            if (isNew) addMaterial("color " + std::to_string(materials_.size()), instance.color);
            const auto [mesh, isNewMesh] =
                meshes.emplace(std::make_pair(instance.part, material->second), std::size_t(0));
            if (isNewMesh)
                mesh->second =
                    addMesh(range.name + level, primitives[instance.part], material->second);
            Json& node = addNode(mesh->second, instance.name, true);
            const auto [x, y, z, w] = quaternionOf(instance.rotation);
            // To the single precision that readers keep.
            node["rotation"] = {float(x), float(y), float(z), float(w)};
            const openvdb::Vec3d& t = instance.translation;
            node["translation"] = {float(t[0]), float(t[1]), float(t[2])};
        }
    }

    template<typename T>
    void append(const T& value)
    {
        const auto* begin = reinterpret_cast<const char*>(&value);
        bytes_.insert(bytes_.end(), begin, begin + sizeof value);
    }

    /// The accessor of what was appended since `begin`.
    std::size_t close(std::size_t begin, std::size_t count, int type, const char* shape, int target)
    {
        json_["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", begin}, {"byteLength", bytes_.size() - begin}});
        Json& view = json_["bufferViews"].back();
        view["target"] = target;
        json_["accessors"].push_back({{"bufferView", json_["bufferViews"].size() - 1},
                                      {"componentType", type},
                                      {"count", count},
                                      {"type", shape}});
        return json_["accessors"].size() - 1;
    }

    std::size_t addPositions(const PartRange& range)
    {
        const std::size_t begin = bytes_.size();
        std::array<float, 3> low, high;
        low.fill(std::numeric_limits<float>::max());
        high.fill(std::numeric_limits<float>::lowest());
        for (std::size_t v = range.firstVertex; v < range.vertexEnd; ++v) {
            const Vec3f& p = mesh_->positions[v];
            for (int i = 0; i < 3; ++i) {
                append(p[i]);
                low[std::size_t(i)] = std::min(low[std::size_t(i)], p[i]);
                high[std::size_t(i)] = std::max(high[std::size_t(i)], p[i]);
            }
        }
        const std::size_t number =
            close(begin, range.vertexEnd - range.firstVertex, floatType, "VEC3", vertexTarget);
        json_["accessors"][number]["min"] = low;
        json_["accessors"][number]["max"] = high;
        return number;
    }

    std::size_t addNormals(const PartRange& range)
    {
        const std::size_t begin = bytes_.size();
        for (std::size_t v = range.firstVertex; v < range.vertexEnd; ++v) {
            openvdb::Vec3d normal(mesh_->normals[v]);
            if (!(normal.length() > 0.0)) normal = openvdb::Vec3d(0.0, 0.0, 1.0);
            normal.normalize();
            for (int i = 0; i < 3; ++i) append(float(normal[i]));
        }
        return close(begin, range.vertexEnd - range.firstVertex, floatType, "VEC3", vertexTarget);
    }

    std::size_t addColors(const PartRange& range)
    {
        constexpr double full = std::numeric_limits<std::uint16_t>::max();
        const std::size_t begin = bytes_.size();
        for (std::size_t v = range.firstVertex; v < range.vertexEnd; ++v) {
            const Vec3f light = linearLight(mesh_->colors[v]);
            for (int i = 0; i < 3; ++i) append(std::uint16_t(std::lround(full * double(light[i]))));
            append(std::uint16_t(full)); // opaque; an element is a multiple of four bytes
        }
        const std::size_t number =
            close(begin, range.vertexEnd - range.firstVertex, shortType, "VEC4", vertexTarget);
        json_["accessors"][number]["normalized"] = true;
        return number;
    }

    /// glTF has no NaN: they are 0.
    std::size_t addField(const PartRange& range, const VertexField& field)
    {
        const std::size_t begin = bytes_.size();
        for (std::size_t v = range.firstVertex; v < range.vertexEnd; ++v)
            for (std::size_t c = 0; c < field.count; ++c) {
                const float value = field.components[c].values[v];
                append(std::isfinite(value) ? value : 0.0f);
            }
        return close(begin, range.vertexEnd - range.firstVertex, floatType,
                     field.count == 3 ? "VEC3" : "SCALAR", vertexTarget);
    }

    template<typename T>
    std::size_t addNumbers(const PartRange& range, const std::vector<T>& values)
    {
        const std::size_t begin = bytes_.size();
        for (std::size_t v = range.firstVertex; v < range.vertexEnd; ++v) append(float(values[v]));
        return close(begin, range.vertexEnd - range.firstVertex, floatType, "SCALAR", vertexTarget);
    }

    std::size_t addTriangles(const PartRange& range)
    {
        const std::size_t begin = bytes_.size();
        for (std::size_t t = range.firstTriangle; t < range.triangleEnd; ++t)
            for (const std::uint32_t corner : mesh_->triangles[t])
                append(std::uint32_t(corner - range.firstVertex));
        return close(begin, 3 * (range.triangleEnd - range.firstTriangle), indexType, "SCALAR",
                     indexTarget);
    }

    const Mesh* mesh_;     // of the level that is being added
    std::size_t root_ = 0; // its node
    std::map<Color, std::size_t> materials_;
    Json json_;
    std::vector<char> bytes_;
};

} // namespace

void writeGlb(const Mesh& mesh, const GlbOptions& options, OutputFile& file)
{
    const Document document(mesh, options);
    std::string header = document.header();
    header.resize((header.size() + 3) / 4 * 4, ' ');
    const std::vector<char>& bytes = document.bytes(); // all of its elements are of four bytes
    const std::uint64_t size = 12 + 8 + header.size() + 8 + bytes.size();
    if (size > std::numeric_limits<std::uint32_t>::max())
        throw Error(ErrorKind::Output, "cannot write " + file.path() +
                                           ": .glb holds at most 4 GiB, "
                                           "got " +
                                           std::to_string(size) + " bytes [hint: write .ply]");
    const auto word = [&](std::uint32_t value) { file.write(&value, sizeof value); };
    file.write("glTF", 4);
    word(2);
    word(std::uint32_t(size));
    word(std::uint32_t(header.size()));
    file.write("JSON", 4);
    file.write(header);
    word(std::uint32_t(bytes.size()));
    file.write("BIN\0", 4);
    file.write(bytes.data(), bytes.size());
    file.finish();
}

} // namespace molsurf
