// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/write_mesh.h"

#include "molsurf/error.h"
#include "molsurf/show/io/ply_layout.h"

#include "support/folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <sstream>

namespace molsurf
{
namespace
{

using openvdb::Vec3f;

// A tetrahedron in general position, with one attribute of each kind.
Mesh tetrahedron()
{
    Mesh mesh;
    mesh.positions = {
        {0.1f, 0.2f, 0.3f}, {1.7f, 0.1f, -0.4f}, {0.3f, 2.1f, 1e-7f}, {0.4f, 0.6f, 3.3f}};
    for (const Vec3f& x : mesh.positions)
        mesh.normals.push_back((x - Vec3f(0.6f, 0.7f, 0.8f)).unit());
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    mesh.scalars = {{"mean_curvature", {0.1f, -0.2f, 0.3f, 1e30f}}};
    mesh.labels = {{"atom_id", {3, -1, 2000000000, 0}}};
    return mesh;
}

template<typename T>
T take(const char*& from)
{
    T value;
    std::memcpy(&value, from, sizeof(T));
    from += sizeof(T);
    return value;
}

TEST(WritePly, ColoursAndComments)
{
    Mesh mesh = tetrahedron();
    for (int v = 0; v < 4; ++v)
        mesh.colors.push_back({std::uint8_t(10 * v), std::uint8_t(20 * v), std::uint8_t(30 * v)});
    const std::string bytes = test::written([&](OutputFile& file) {
        writePly(mesh, file, {"one", "two"});
    });
    const std::size_t end = bytes.find("end_header\n") + 11;
    const std::string header = bytes.substr(0, end);
    EXPECT_NE(header.find("1.0\ncomment one\ncomment two\nelement vertex"), std::string::npos);
    EXPECT_NE(header.find("int atom_id\nproperty uchar red\nproperty uchar green\n"
                          "property uchar blue\nelement face"),
              std::string::npos);
    ASSERT_EQ(bytes.size(), end + 4 * 35 + 4 * 13);
    for (int v = 0; v < 4; ++v)
        for (int k = 0; k < 3; ++k)
            EXPECT_EQ(int(std::uint8_t(bytes[end + 35 * v + 32 + k])), 10 * v * (k + 1));
}

TEST(WritePly, HoldsTheMeshAndNothingElse)
{
    const Mesh mesh = tetrahedron();
    const std::string bytes = test::written([&](OutputFile& file) { writePly(mesh, file); });
    const std::string header = "ply\n"
                               "format binary_little_endian 1.0\n"
                               "element vertex 4\n"
                               "property float x\n"
                               "property float y\n"
                               "property float z\n"
                               "property float nx\n"
                               "property float ny\n"
                               "property float nz\n"
                               "property float mean_curvature\n"
                               "property int atom_id\n"
                               "element face 4\n"
                               "property list uchar int vertex_indices\n"
                               "end_header\n";
    ASSERT_EQ(bytes.size(), header.size() + 4 * 32 + 4 * 13);
    EXPECT_EQ(bytes.substr(0, header.size()), header);
    const char* at = bytes.data() + header.size();
    for (std::size_t n = 0; n < 4; ++n) {
        EXPECT_EQ(take<Vec3f>(at), mesh.positions[n]);
        EXPECT_EQ(take<Vec3f>(at), mesh.normals[n]);
        EXPECT_EQ(take<float>(at), mesh.scalars[0].values[n]);
        EXPECT_EQ(take<std::int32_t>(at), mesh.labels[0].values[n]);
    }
    for (const auto& triangle : mesh.triangles) {
        EXPECT_EQ(take<unsigned char>(at), 3);
        for (std::uint32_t corner : triangle) EXPECT_EQ(take<std::uint32_t>(at), corner);
    }
}

// More than one buffer full: nothing is lost or doubled where one ends.
TEST(WritePly, LargeMeshKeepsItsOrder)
{
    Mesh mesh;
    const std::uint32_t count = 200001;
    for (std::uint32_t n = 0; n < count; ++n) {
        mesh.positions.emplace_back(float(n), 0.5f, -float(n));
        mesh.normals.emplace_back(0.0f, 0.0f, 1.0f);
        mesh.triangles.push_back({n, (n + 1) % count, (n + 2) % count});
    }
    const std::string bytes = test::written([&](OutputFile& file) { writePly(mesh, file); });
    const char* at = bytes.data() + bytes.find("end_header\n") + 11;
    ASSERT_EQ(std::size_t(bytes.data() + bytes.size() - at), std::size_t(count) * (24 + 13));
    bool same = true;
    for (std::uint32_t n = 0; n < count; ++n, at += 12)
        same = same && take<Vec3f>(at) == mesh.positions[n];
    for (std::uint32_t n = 0; n < count; ++n) {
        same = same && take<unsigned char>(at) == 3;
        same = same && take<std::array<std::uint32_t, 3>>(at) == mesh.triangles[n];
    }
    EXPECT_TRUE(same);
}

TEST(WritePly, EmptyMesh)
{
    const std::string bytes = test::written([](OutputFile& file) { writePly(Mesh(), file); });
    EXPECT_NE(bytes.find("element vertex 0\n"), std::string::npos);
    EXPECT_NE(bytes.find("element face 0\n"), std::string::npos);
}

TEST(WritePly, RefusesWhatItsIndicesCannotCount)
{
    EXPECT_NO_THROW(plyHeader(PlyLayout(), 0x7fffffff, 1));
    EXPECT_THROW(plyHeader(PlyLayout(), 0x80000000, 1), Error);
}

TEST(WriteObj, GivesTheSameFloatsBack)
{
    const Mesh mesh = tetrahedron();
    std::istringstream text(test::written([&](OutputFile& file) { writeObj(mesh, file); }));
    std::vector<Vec3f> positions, normals;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::string key; text >> key;) {
        if (key == "f") {
            std::array<std::uint32_t, 3> triangle;
            for (std::uint32_t& corner : triangle) {
                std::uint32_t normal;
                char slash;
                text >> corner >> slash >> slash >> normal;
                EXPECT_EQ(corner, normal);
                --corner;
            }
            triangles.push_back(triangle);
        } else {
            Vec3f x;
            text >> x[0] >> x[1] >> x[2];
            (key == "v" ? positions : normals).push_back(x);
        }
    }
    EXPECT_EQ(positions, mesh.positions);
    EXPECT_EQ(normals, mesh.normals);
    EXPECT_EQ(triangles, mesh.triangles);
}

TEST(WriteStl, FacetNormalsPointOutward)
{
    Mesh mesh = tetrahedron();
    mesh.triangles.push_back({1, 1, 2}); // without area
    const std::string bytes = test::written([&](OutputFile& file) { writeStl(mesh, file); });
    ASSERT_EQ(bytes.size(), 84 + 5 * 50u);
    EXPECT_EQ(bytes.find("solid"), std::string::npos);
    const char* at = bytes.data() + 80;
    EXPECT_EQ(take<std::uint32_t>(at), 5u);
    const Vec3f inside(0.6f, 0.7f, 0.8f);
    for (const auto& triangle : mesh.triangles) {
        const Vec3f normal = take<Vec3f>(at);
        for (std::uint32_t corner : triangle) EXPECT_EQ(take<Vec3f>(at), mesh.positions[corner]);
        EXPECT_EQ(take<std::uint16_t>(at), 0);
        if (triangle[0] == triangle[1]) {
            EXPECT_EQ(normal, Vec3f(0.0f));
        } else {
            EXPECT_NEAR(normal.length(), 1.0f, 1e-6f);
            EXPECT_GT(normal.dot(mesh.positions[triangle[0]] - inside), 0.0f);
        }
    }
}

/// The numbers of a field of VRML, between its [ and its ].
std::vector<double> fieldOf(const std::string& text, const std::string& name)
{
    const std::size_t begin = text.find(name + " [");
    if (begin == std::string::npos) return {};
    std::istringstream words(text.substr(begin + name.size() + 2));
    std::vector<double> out;
    for (double number; words >> number;) out.push_back(number);
    return out;
}

TEST(WriteWrl, HasWhatTheMeshHas)
{
    Mesh mesh = tetrahedron();
    const auto written = [&](const LengthUnit& unit) {
        return test::written([&](OutputFile& file) { writeWrl(mesh, file, unit); });
    };
    EXPECT_EQ(written({}).find("color ["), std::string::npos);
    mesh.colors = {{255, 0, 51}, {0, 0, 0}, {102, 255, 255}, {1, 2, 3}};
    const std::string text = written({2.0, "mm"});
    EXPECT_EQ(text.rfind("#VRML V2.0 utf8\n# lengths in mm\n", 0), 0u);
    EXPECT_EQ(std::count(text.begin(), text.end(), '{'), std::count(text.begin(), text.end(), '}'));
    const std::vector<double> points = fieldOf(text, "point"), normals = fieldOf(text, "vector"),
                              colors = fieldOf(text, "color"),
                              indices = fieldOf(text, "coordIndex");
    ASSERT_EQ(points.size(), 12u);
    ASSERT_EQ(normals.size(), 12u);
    ASSERT_EQ(colors.size(), 12u);
    ASSERT_EQ(indices.size(), 16u);
    for (std::size_t n = 0; n < 4; ++n) {
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_EQ(float(points[3 * n + k]), 2.0f * mesh.positions[n][int(k)]);
            EXPECT_EQ(float(normals[3 * n + k]), mesh.normals[n][int(k)]);
            EXPECT_NEAR(colors[3 * n + k], mesh.colors[n][k] / 255.0, 1e-4);
            EXPECT_EQ(indices[4 * n + k], mesh.triangles[n][k]);
        }
        EXPECT_EQ(indices[4 * n + 3], -1.0);
    }
}

/// The numbers behind some words of a text.
std::vector<double> numbersBehind(const std::string& text, const std::string& words)
{
    const std::size_t begin = text.find(words);
    if (begin == std::string::npos) return {};
    std::istringstream rest(text.substr(begin + words.size()));
    std::vector<double> out;
    for (double number; rest >> number;) out.push_back(number);
    return out;
}

TEST(WriteVtk, HasWhatTheMeshHas)
{
    Mesh mesh = tetrahedron();
    const auto written = [&] {
        return test::written([&](OutputFile& file) {
            for (const MeshFormat& format : meshFormats())
                if (std::string(format.word) == "vtk") format.write(mesh, {"a b\nc", {}}, file);
        });
    };
    EXPECT_EQ(written().find("COLOR_SCALARS"), std::string::npos);
    Mesh turned = mesh;
    turned.scalars = {{"a", {1, 2, 3, 4}},       {"n_x", {5, 6, 7, 8}}, {"n_y", {9, 10, 11, 12}},
                      {"n_z", {13, 14, 15, 16}}, {"b_x", {0, 0, 0, 0}}, {"b_y", {0, 0, 0, 0}}};
    std::swap(mesh, turned);
    const std::string vectors = written();
    std::swap(mesh, turned);
    EXPECT_EQ(numbersBehind(vectors, "VECTORS n float"),
              std::vector<double>({5, 9, 13, 6, 10, 14, 7, 11, 15, 8, 12, 16}));
    for (const char* scalar : {"SCALARS a float", "SCALARS b_x float", "SCALARS b_y float"})
        EXPECT_NE(vectors.find(scalar), std::string::npos) << scalar;
    EXPECT_EQ(vectors.find("SCALARS n_"), std::string::npos);
    mesh.colors = {{255, 0, 51}, {0, 0, 0}, {102, 255, 255}, {1, 2, 3}};
    const std::string text = written();
    EXPECT_EQ(
        text.rfind("# vtk DataFile Version 3.0\na_b_c\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n",
                   0),
        0u);
    const std::string table = "\nLOOKUP_TABLE default\n";
    const std::vector<double> points = numbersBehind(text, "POINTS 4 float"),
                              corners = numbersBehind(text, "POLYGONS 4 16"),
                              normals = numbersBehind(text, "POINT_DATA 4\nNORMALS normal float"),
                              mean = numbersBehind(text, "SCALARS mean_curvature float" + table),
                              atoms = numbersBehind(text, "SCALARS atom_id int" + table),
                              colors = numbersBehind(text, "COLOR_SCALARS color 3");
    EXPECT_EQ(points.size() + normals.size() + colors.size(), 36u);
    ASSERT_EQ(corners.size(), 16u);
    EXPECT_EQ(atoms, std::vector<double>({3, -1, 2000000000, 0}));
    ASSERT_EQ(mean.size(), 4u);
    for (std::size_t n = 0; n < 4; ++n) {
        EXPECT_EQ(float(mean[n]), mesh.scalars[0].values[n]);
        EXPECT_EQ(corners[4 * n], 3.0);
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_EQ(float(points[3 * n + k]), mesh.positions[n][int(k)]);
            EXPECT_EQ(float(normals[3 * n + k]), mesh.normals[n][int(k)]);
            EXPECT_NEAR(colors[3 * n + k], mesh.colors[n][k] / 255.0, 1e-4);
            EXPECT_EQ(corners[4 * n + 1 + k], mesh.triangles[n][k]);
        }
    }
}

} // namespace
} // namespace molsurf
