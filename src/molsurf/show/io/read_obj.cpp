// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/core/strings.h"
#include "molsurf/show/io/mesh_text.h"
#include "molsurf/show/io/read_mesh.h"

#include <limits>

namespace molsurf
{

Mesh parseObj(std::string_view content)
{
    Mesh mesh;
    MeshText text(content);
    std::vector<std::uint32_t> corners;
    // Faces may come before their vertices in principle, so indices are checked at the end.
    std::size_t largest = 0, largestLine = 0;
    while (text.nextLine()) {
        const std::string_view key = text.word();
        if (key == "v") {
            const double x = text.number<double>("a coordinate");
            const double y = text.number<double>("a coordinate");
            const double z = text.number<double>("a coordinate");
            mesh.positions.push_back(checkedPosition(x, y, z, mesh.positions.size() + 1));
        } else if (key == "f") {
            corners.clear();
            while (!text.lineDone()) {
                const std::string_view word = text.word(); // v, v/vt, v//vn or v/vt/vn
                const std::string_view digits = word.substr(0, word.find('/'));
                std::int64_t index = 0;
                if (!parseWhole(digits, index) || index == 0)
                    text.fail("the number of a vertex", word);
                if (index < 0)
                    index += std::int64_t(mesh.positions.size()) + 1; // from the last one
                if (index < 1 || index > std::numeric_limits<std::uint32_t>::max())
                    text.fail("the number of a vertex", word);
                if (std::size_t(index) > largest) {
                    largest = std::size_t(index);
                    largestLine = text.line();
                }
                corners.push_back(std::uint32_t(index - 1));
            }
            if (corners.size() < 3)
                text.fail("three vertices or more", std::to_string(corners.size()));
            addPolygon(corners, mesh);
        }
    }
    if (largest > mesh.positions.size())
        badMesh("line " + std::to_string(largestLine) + ": expected a vertex from 1 to " +
                std::to_string(mesh.positions.size()) + ", got " + std::to_string(largest));
    return mesh;
}

} // namespace molsurf
