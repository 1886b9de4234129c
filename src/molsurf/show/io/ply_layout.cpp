// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/ply_layout.h"

#include "molsurf/error.h"

#include <cstring>
#include <limits>

namespace molsurf
{

namespace
{

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "PLY is written as it lies");
static_assert(sizeof(openvdb::Vec3f) == 3 * sizeof(float), "a position is three floats");

template<typename T>
char* put(char* to, const T& value)
{
    std::memcpy(to, &value, sizeof(T));
    return to + sizeof(T);
}

} // namespace

PlyLayout layoutOf(const Mesh& mesh)
{
    PlyLayout layout;
    for (const auto& scalar : mesh.scalars) layout.scalars.push_back(scalar.name);
    for (const auto& label : mesh.labels) layout.labels.push_back(label.name);
    layout.colors = !mesh.colors.empty();
    return layout;
}

std::string plyHeader(const PlyLayout& layout, std::size_t vertices, std::size_t triangles,
                      const std::vector<std::string>& comments)
{
    if (vertices > std::size_t(std::numeric_limits<std::int32_t>::max()))
        throw Error(ErrorKind::Output,
                    ".ply counts at most 2147483647 vertices [hint: a larger `voxel`]");
    std::string header = "ply\nformat binary_little_endian 1.0\n";
    for (const std::string& comment : comments) header += "comment " + comment + "\n";
    header += "element vertex " + std::to_string(vertices) + "\n";
    for (const char* name : {"x", "y", "z", "nx", "ny", "nz"})
        header += std::string("property float ") + name + "\n";
    for (const auto& scalar : layout.scalars) header += "property float " + scalar + "\n";
    for (const auto& label : layout.labels) header += "property int " + label + "\n";
    if (layout.colors)
        for (const char* name : {"red", "green", "blue"})
            header += std::string("property uchar ") + name + "\n";
    header += "element face " + std::to_string(triangles) + "\n";
    header += "property list uchar int vertex_indices\nend_header\n";
    return header;
}

void encodeVertex(const Mesh& mesh, std::size_t n, char* to)
{
    to = put(to, mesh.positions[n]);
    to = put(to, mesh.normals[n]);
    for (const auto& scalar : mesh.scalars) to = put(to, scalar.values[n]);
    for (const auto& label : mesh.labels) to = put(to, label.values[n]);
    if (!mesh.colors.empty()) put(to, mesh.colors[n]);
}

void encodeTriangle(const std::array<std::uint32_t, 3>& triangle, char* to)
{
    *to = 3;
    put(to + 1, triangle);
}

} // namespace molsurf
