// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/mesh_text.h"
#include "molsurf/show/io/read_mesh.h"

#include <cstring>

namespace molsurf
{

namespace
{

constexpr std::size_t headSize = 84, triangleSize = 50;

void addTriangle(Mesh& mesh)
{
    const auto n = std::uint32_t(mesh.positions.size());
    mesh.triangles.push_back({n - 3, n - 2, n - 1});
}

Mesh parseText(std::string_view content)
{
    Mesh mesh;
    MeshText text(content);
    std::size_t corners = 0;
    bool ended = false;
    while (text.nextLine()) {
        const std::string_view key = text.word();
        if (key == "vertex") {
            const double x = text.number<double>("a coordinate");
            const double y = text.number<double>("a coordinate");
            const double z = text.number<double>("a coordinate");
            mesh.positions.push_back(checkedPosition(x, y, z, mesh.positions.size() + 1));
            ++corners;
        } else if (key == "endfacet" || key == "facet") {
            if (key == "endfacet" && corners != 3) text.fail("three vertices a facet", key);
            if (key == "endfacet") addTriangle(mesh);
            corners = 0;
        } else if (key == "endsolid") {
            ended = true;
        } else if (key != "solid" && key != "outer" && key != "endloop") {
            text.fail("a word of an STL file", key);
        }
    }
    if (!ended)
        badMesh("cut short: expected 'endsolid' at the end, got line " +
                std::to_string(text.line()));
    return mesh;
}

} // namespace

Mesh parseStl(std::string_view content)
{
    // Some binary files begin with "solid" too; their size shows it.
    std::uint32_t count = 0;
    if (content.size() >= headSize) std::memcpy(&count, content.data() + 80, sizeof count);
    const std::size_t expected = headSize + count * triangleSize;
    const bool binary = content.size() >= headSize && content.size() == expected;
    if (!binary && content.substr(0, 5) == "solid") return parseText(content);
    if (content.size() < headSize)
        badMesh("not an STL file: expected 84 bytes or more, got " +
                std::to_string(content.size()));
    if (content.size() < expected)
        badMesh("not an STL file, or cut short: expected " + std::to_string(expected) +
                " bytes for " + std::to_string(count) + " triangles, got " +
                std::to_string(content.size()));

    Mesh mesh;
    mesh.positions.reserve(3 * std::size_t(count));
    mesh.triangles.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        float numbers[9]; // behind the normal, which is 12 bytes
        std::memcpy(numbers, content.data() + headSize + i * triangleSize + 12, sizeof numbers);
        for (int k = 0; k < 3; ++k)
            mesh.positions.push_back(checkedPosition(numbers[3 * k], numbers[3 * k + 1],
                                                     numbers[3 * k + 2], 3 * i + k + 1));
        addTriangle(mesh);
    }
    return mesh;
}

} // namespace molsurf
