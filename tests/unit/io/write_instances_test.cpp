// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/rotation_quaternion.h"
#include "molsurf/show/io/write_glb.h"
#include "molsurf/show/io/write_usda_instances.h"

#include "support/folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;
using openvdb::Vec3f;
using Rotation = std::array<std::array<double, 3>, 3>;

constexpr Rotation same = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr Rotation thirdTurn = {{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}}; // x to y to z
constexpr std::array<std::uint8_t, 3> red = {255, 0, 0}, blue = {0, 0, 255};

/// Two parts: a tetrahedron of edge `size` along the axes at (10, 20, 30), and one at the origin.
Mesh twoTetrahedra(float size)
{
    Mesh mesh;
    for (const Vec3f& corner : {Vec3f(10, 20, 30), Vec3f(0)}) {
        const auto first = std::uint32_t(mesh.positions.size());
        mesh.parts.push_back({first == 0 ? "one" : "two", mesh.triangles.size()});
        for (const Vec3f& edge :
             {Vec3f(0), Vec3f(size, 0, 0), Vec3f(0, size, 0), Vec3f(0, 0, size)}) {
            mesh.positions.push_back(corner + edge);
            mesh.normals.push_back((edge - Vec3f(0.25f * size)).unit());
        }
        for (const std::array<std::uint32_t, 3>& t :
             {std::array<std::uint32_t, 3>{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
            mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
    return mesh;
}

std::vector<MeshInstance> threeCopies()
{
    return {{{same, Vec3d(0.0)}, 0, "1", red},
            {{thirdTurn, Vec3d(100, 0, 0)}, 0, "2", blue},
            {{same, Vec3d(0, 0, 5)}, 1, "3", red}};
}

std::string usda(const Mesh& mesh, const UsdInstances& copies)
{
    return test::written([&](OutputFile& file) { writeUsdaInstances(mesh, copies, file); });
}

bool has(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

TEST(RotationQuaternion, TurnsAsTheMatrix)
{
    const auto [x, y, z, w] = quaternionOf(thirdTurn);
    for (const double number : {x, y, z, w}) EXPECT_NEAR(number, 0.5, 1e-12);
    Rotation rounded = thirdTurn;
    for (auto& row : rounded)
        for (double& number : row) number *= 1.01; // files round
    const auto q = quaternionOf(rounded);
    EXPECT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1.0, 1e-12);
}

TEST(WriteUsdaInstances, PrototypesLieAboutTheirMiddle)
{
    const std::string text = usda(twoTetrahedra(2), {"1 a", 1.0, threeCopies(), {}});
    EXPECT_TRUE(has(text, "defaultPrim = \"_1_a\"\n    metersPerUnit = 1e-10\n    upAxis = \"Z\""));
    EXPECT_TRUE(has(text, "point3f[] points = [(-1.0000, -1.0000, -1.0000), (1.0000, -1.0000"));
    EXPECT_TRUE(
        has(text, "float3[] extent = [(-1.0000, -1.0000, -1.0000), (1.0000, 1.0000, 1.0000)]"));
    // The middles (11, 21, 31) and (1, 1, 1), placed.
    EXPECT_TRUE(has(text, "positions = [(11.0000, 21.0000, 31.0000), (131.0000, 11.0000, 21.0000), "
                          "(1.0000, 1.0000, 6.0000)]"));
    const std::string half = "0.50000000, 0.50000000, 0.50000000, 0.50000000";
    const std::string real = "1.00000000, 0.00000000, 0.00000000, 0.00000000";
    for (const char* name : {"quath[] orientations", "quatf[] orientationsf"})
        EXPECT_TRUE(has(text, name + (" = [(" + real + "), (" + half + "), (" + real + ")]")));
    EXPECT_TRUE(
        has(text, "float3[] extent = [(0.0000, 0.0000, 5.0000), (132.0000, 22.0000, 32.0000)]"));
    EXPECT_TRUE(has(text, "int[] protoIndices = [0, 1, 2]"));
    EXPECT_TRUE(has(text, "rel prototypes = [</_1_a/copies/prototypes/part_0_color_"));
    EXPECT_FALSE(has(text, "variantSet"));
    EXPECT_FALSE(has(text, "xformOp"));
}

TEST(WriteUsdaInstances, LevelsAreVariants)
{
    const Mesh coarse = twoTetrahedra(3);
    const std::string text = usda(twoTetrahedra(2), {"a", 0.1, threeCopies(), {&coarse}});
    EXPECT_TRUE(has(text, "metersPerUnit = 1e-09"));
    EXPECT_TRUE(has(text, "double3 xformOp:scale = (0.1, 0.1, 0.1)"));
    EXPECT_TRUE(has(text, "string lod = \"lod0\""));
    // About the middle of the finest.
    EXPECT_TRUE(
        has(text, "float3[] extent = [(-1.0000, -1.0000, -1.0000), (2.0000, 2.0000, 2.0000)]"));
    const std::size_t first = text.find("\"lod0\" {"), second = text.find("\"lod1\" {");
    ASSERT_LT(first, second);
    EXPECT_TRUE(has(text.substr(first, second - first), "part_0_lod0_color_"));
    EXPECT_TRUE(has(text.substr(second), "part_1_lod1_color_"));
    EXPECT_FALSE(has(text.substr(second), "part_0_lod0_color_"));
}

TEST(WriteGlb, LevelsAreScenes)
{
    const Mesh coarse = twoTetrahedra(3);
    GlbOptions options;
    options.name = "a";
    options.instances = threeCopies();
    options.coarser = {&coarse};
    const std::string bytes =
        test::written([&](OutputFile& file) { writeGlb(twoTetrahedra(2), options, file); });
    std::uint32_t size = 0;
    std::memcpy(&size, bytes.data() + 12, 4);
    const auto json = nlohmann::json::parse(bytes.substr(20, size));
    EXPECT_EQ(json["scene"], 0);
    ASSERT_EQ(json["scenes"].size(), 2u);
    EXPECT_EQ(json["materials"].size(), 2u); // red and blue, for both levels
    for (std::size_t level = 0; level < 2; ++level) {
        const std::string name = "a lod" + std::to_string(level);
        EXPECT_EQ(json["scenes"][level]["name"], name);
        ASSERT_EQ(json["scenes"][level]["nodes"].size(), 1u);
        const auto& root = json["nodes"][json["scenes"][level]["nodes"][0].get<std::size_t>()];
        EXPECT_EQ(root["name"], name);
        ASSERT_EQ(root["children"].size(), 3u);
        const auto& copy = json["nodes"][root["children"][0].get<std::size_t>()];
        const auto& primitive = json["meshes"][copy["mesh"].get<std::size_t>()]["primitives"][0];
        const auto& points =
            json["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
        EXPECT_EQ(points["max"][0], level == 0 ? 12.0 : 13.0);
    }
}

// What glTF does not have: a value that is none is 0, a normal without a direction points up; the
// scale is of the node.
TEST(WriteGlb, HasNumbersAndUnitNormals)
{
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.normals = {{0, 0, 0}, {0, 2, 0}, {0, 0, 1}, {1, 0, 0}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    mesh.scalars = {{"depth", {1.5f, std::nanf(""), HUGE_VALF, -2.0f}}};
    for (const double scale : {1.0, 0.1}) {
        GlbOptions options;
        options.scale = scale;
        const std::string bytes =
            test::written([&](OutputFile& file) { writeGlb(mesh, options, file); });
        std::uint32_t size = 0;
        std::memcpy(&size, bytes.data() + 12, 4);
        const auto json = nlohmann::json::parse(bytes.substr(20, size));
        EXPECT_EQ(json["nodes"][0].contains("scale"), scale != 1.0);
        if (scale != 1.0) {
            EXPECT_EQ(json["nodes"][0]["scale"][2], scale);
        }
        const auto& attributes = json["meshes"][0]["primitives"][0]["attributes"];
        const auto floats = [&](const char* name, std::size_t count) {
            const auto& accessor = json["accessors"][attributes[name].get<std::size_t>()];
            const auto& view = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
            std::vector<float> out(count);
            std::memcpy(out.data(),
                        bytes.data() + 28 + size + view["byteOffset"].get<std::size_t>(),
                        4 * count);
            return out;
        };
        EXPECT_EQ(floats("_DEPTH", 4), (std::vector<float>{1.5f, 0.0f, 0.0f, -2.0f}));
        EXPECT_EQ(floats("NORMAL", 6), (std::vector<float>{0, 0, 1, 0, 1, 0}));
    }
}

} // namespace
} // namespace molsurf
