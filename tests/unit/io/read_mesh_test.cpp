// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/read_mesh.h"

#include "support/folder.h"

#include "molsurf/analysis/proximity/deviation.h"
#include "molsurf/error.h"
#include "molsurf/show/io/write_mesh.h"
#include "support/solids.h"

#include <gtest/gtest.h>

#include <cstring>

namespace molsurf
{
namespace
{

using openvdb::Vec3f;

/// What is said of a file; empty if nothing.
template<typename F>
std::string errorOf(const F& f)
{
    try {
        f();
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::Input);
        return e.what();
    }
    return "";
}

#define EXPECT_SAYS(call, words)                                                                   \
    EXPECT_NE(errorOf([&] { call; }).find(words), std::string::npos) << errorOf([&] { call; })

void expectBox(const Mesh& mesh)
{
    EXPECT_EQ(mesh.positions.size(), 8u);
    EXPECT_EQ(mesh.triangles.size(), 12u);
    ASSERT_TRUE(hasInside(mesh, vertexTriangles(mesh), Progress()));
    EXPECT_NEAR(*sizeOfTriangles(mesh, true, Progress()).volume, 6.0, 1e-5);
}

Mesh box()
{
    Mesh mesh = test::box({-1, 0, 0.5}, {1, 1, 3.5});
    mesh.normals = vertexNormals(mesh);
    return mesh;
}

const std::string plyHead = "ply\nformat ascii 1.0\ncomment a box\nelement vertex 8\n"
                            "property float x\nproperty float y\nproperty float z\n"
                            "property uchar red\nelement face 6\n"
                            "property list uchar int vertex_index\nend_header\n";

std::string textPly(const std::string& separator = "\n")
{
    std::string text = plyHead;
    for (const Vec3f& p : box().positions)
        text += std::to_string(p[0]) + " " + std::to_string(p[1]) + "\t" + std::to_string(p[2]) +
                " 200" + separator;
    for (const char* face : {"0 1 3 2", "4 6 7 5", "0 4 5 1", "2 3 7 6", "0 2 6 4", "1 5 7 3"})
        text += std::string("4 ") + face + separator;
    return text;
}

TEST(ReadMesh, WhatTheWritersWrite)
{
    const test::Folder folder;
    const Mesh mesh = box();
    const auto save = [&](const char* name, auto write) {
        OutputFile file(folder / name, false);
        write(file);
        file.commit();
        return readMesh(folder / name);
    };
    const Mesh ply = save("a.ply", [&](OutputFile& file) { writePly(mesh, file); });
    const Mesh obj = save("a.obj", [&](OutputFile& file) { writeObj(mesh, file); });
    const Mesh stl = save("a.STL", [&](OutputFile& file) { writeStl(mesh, file); });
    EXPECT_EQ(ply.positions, mesh.positions);
    EXPECT_EQ(ply.triangles, mesh.triangles);
    EXPECT_EQ(obj.positions, mesh.positions);
    EXPECT_EQ(obj.triangles, mesh.triangles);
    expectBox(stl);
}

TEST(ReadMesh, NamesTheFile)
{
    const test::Folder folder;
    EXPECT_SAYS(readMesh(folder / "none.ply"), "none.ply: cannot be opened: No such file");
    std::filesystem::create_directory(folder / "a.obj");
    EXPECT_SAYS(readMesh(folder / "a.obj"), "a.obj: is a folder, expected a file");
    std::ofstream(folder / "b.obj") << "v 0 0 0\n";
    EXPECT_SAYS(readMesh(folder / "b.obj"), "b.obj: expected triangles");
    std::ofstream(folder / "c.obj") << "v 0 0 0\nv 1 0 0\nf 1 2 1\n";
    EXPECT_SAYS(readMesh(folder / "c.obj"), "only such with two corners in one place");
}

TEST(ReadMesh, KnowsItsNames)
{
    for (const char* name : {"a.ply", "A.PLY", "x/y.obj", "b.Stl"}) EXPECT_TRUE(isMeshName(name));
    for (const char* name : {"a.pdb", "ply", "a.ply.gz", "-"}) EXPECT_FALSE(isMeshName(name));
}

// A closed mesh whose seams have vertices of their own, as programs with texture coordinates write.
TEST(ReadMesh, WeldsOnlyWhatIsOpen)
{
    const test::Folder folder;
    {
        std::ofstream file(folder / "seams.obj");
        const Mesh mesh = box();
        int n = 0;
        for (const auto& t : mesh.triangles) {
            for (const std::uint32_t v : t)
                file << "v " << mesh.positions[v][0] << " " << mesh.positions[v][1] << " "
                     << mesh.positions[v][2] << "\n";
            file << "f " << n + 1 << " " << n + 2 << " " << n + 3 << "\n";
            n += 3;
        }
    }
    expectBox(readMesh(folder / "seams.obj"));

    // Two boxes that touch at a corner keep two vertices there.
    Mesh two = box();
    const Mesh other = test::box({1, 1, 3.5}, {2, 2, 4.5});
    for (const auto& t : other.triangles) two.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
    two.positions.insert(two.positions.end(), other.positions.begin(), other.positions.end());
    two.normals = vertexNormals(two);
    OutputFile file(folder / "two.ply", false);
    writePly(two, file);
    file.commit();
    EXPECT_EQ(readMesh(folder / "two.ply").positions.size(), 16u);
}

TEST(Weld, MergesDropsAndKeepsTheOrder)
{
    Mesh mesh;
    mesh.positions = {{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {-0.0f, 0, 0}, {0, 1, 0}, {1, 0, 0}};
    mesh.triangles = {{1, 2, 4}, {3, 4, 5}, {1, 3, 4}}; // the last one loses a corner
    EXPECT_EQ(weld(mesh), 3u);
    EXPECT_EQ(mesh.positions, (std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    using Triangle = std::array<std::uint32_t, 3>;
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 1}}));
}

TEST(ParsePly, Text)
{
    expectBox(parsePly(textPly()));
    expectBox(parsePly(textPly("\r\n")));
    expectBox(parsePly(textPly(" \n\n")));
}

template<typename T>
void append(std::string& bytes, T value, bool swapped)
{
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if (swapped) std::reverse(raw, raw + sizeof(T));
    bytes.append(raw, sizeof(T));
}

// Doubles, an element in between, faces with a list and a value before the wanted list.
std::string binaryPly(bool big)
{
    std::string text = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                       "_endian 1.0\nelement vertex 8\nproperty list uchar short parts\n"
                       "property double z\nproperty double y\nproperty double x\n"
                       "element edge 2\nproperty uint8 a\nproperty float32 b\n"
                       "element face 12\nproperty list ushort double uv\nproperty int16 flags\n"
                       "property list uint32 uint16 vertex_indices\nend_header\n";
    const Mesh mesh = box();
    for (const Vec3f& p : mesh.positions) {
        append<std::uint8_t>(text, 2, big);
        append<std::int16_t>(text, -7, big);
        append<std::int16_t>(text, 300, big);
        for (int i = 2; i >= 0; --i) append<double>(text, p[i], big);
    }
    for (int i = 0; i < 2; ++i) {
        append<std::uint8_t>(text, 1, big);
        append<float>(text, 1.5f, big);
    }
    for (const auto& t : mesh.triangles) {
        append<std::uint16_t>(text, 1, big);
        append<double>(text, 0.5, big);
        append<std::int16_t>(text, 3, big);
        append<std::uint32_t>(text, 3, big);
        for (const std::uint32_t v : t) append<std::uint16_t>(text, std::uint16_t(v), big);
    }
    return text;
}

TEST(ParsePly, BinaryOfBothByteOrders)
{
    expectBox(parsePly(binaryPly(false)));
    expectBox(parsePly(binaryPly(true)));
}

TEST(ParsePly, CutShortAnywhere)
{
    for (const std::string& whole : {textPly(), binaryPly(false)})
        for (std::size_t size = 0; size + 3 < whole.size(); size += 7)
            EXPECT_NE(errorOf([&] { parsePly(whole.substr(0, size)); }), "") << size;
    EXPECT_SAYS(parsePly(binaryPly(true).substr(0, 450)), "cut short: expected vertex ");
    EXPECT_SAYS(parsePly(plyHead), "cut short: expected vertex 1");
}

std::string replaced(std::string text, const std::string& from, const std::string& to)
{
    return text.replace(text.find(from), from.size(), to);
}

// Rows without properties take no bytes: counting them would take a minute each billion.
TEST(ParsePly, ElementsWithoutPropertiesAreLeftOut)
{
    std::string rows = "ply\nformat ascii 1.0\n";
    for (int i = 0; i < 50; ++i) rows += "element nothing" + std::to_string(i) + " 4294967295\n";
    const Mesh mesh = parsePly(rows + "element vertex 3\nproperty float x\nproperty float y\n"
                                      "property float z\nelement face 1\n"
                                      "property list uchar int vertex_indices\nend_header\n"
                                      "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    EXPECT_EQ(mesh.positions.size(), 3u);
    EXPECT_EQ(mesh.triangles.size(), 1u);
}

TEST(ParsePly, Damaged)
{
    const std::string good = textPly();
    EXPECT_SAYS(parsePly("solid"), "expected 'ply' first");
    EXPECT_SAYS(parsePly(""), "expected 'ply' first");
    EXPECT_SAYS(parsePly(replaced(good, "ascii", "asci")), "line 2: expected ascii");
    EXPECT_SAYS(parsePly(replaced(good, "float x", "half x")), "line 5: expected a type");
    EXPECT_SAYS(parsePly(replaced(good, "float x", "float u")), "vertex property 'x'");
    EXPECT_SAYS(parsePly(replaced(good, "vertex_index", "corners")), "'vertex_indices', got none");
    EXPECT_SAYS(parsePly(replaced(good, "element vertex", "element point")), "element 'vertex'");
    EXPECT_SAYS(parsePly(replaced(good, "vertex 8", "vertex -8")), "got '-8'");
    EXPECT_SAYS(parsePly(replaced(good, "0.500000", "nan")), "vertex 1: expected a finite");
    EXPECT_SAYS(parsePly(replaced(good, "0.500000", "1e7")), "below 1e6 Å");
    EXPECT_SAYS(parsePly(replaced(good, "0.500000", "0.5x")), "line 12: expected a number, got '0");
    EXPECT_SAYS(parsePly(replaced(good, "4 0 1 3 2", "4 0 1 3 8")),
                "face 1: expected a vertex from 0 to 7, got 8");
    EXPECT_SAYS(parsePly(replaced(good, "4 0 1 3 2", "4 0 1 3")), "got nothing");
    EXPECT_SAYS(parsePly(replaced(good, "4 0 1 3 2", "4 0 1 -3 2")), "got -3");
    EXPECT_SAYS(parsePly(replaced(good, "element face", "element tristrips")), "strips");
}

TEST(ParseObj, AllFormsOfFaces)
{
    const Mesh mesh = parseObj("# a comment\nmtllib a.mtl\no thing\nv 0 0 0 1.0\nv 1 0 0\r\n"
                               "v 1 1 0 0.5 0.5 0.5\nvt 0 0\nvn 0 0 1\n\nusemtl red\n"
                               "f 1 2 3\nf 1/1 2/1 3/1\nf 1//1 2//1 3//1\nf -3/1/1 -2/1/1 -1/1/1\n"
                               "v +0 1e0 0\nf 1 2 3 4\n");
    EXPECT_EQ(mesh.positions.size(), 4u);
    ASSERT_EQ(mesh.triangles.size(), 6u);
    using Triangle = std::array<std::uint32_t, 3>;
    for (int i = 0; i < 5; ++i) EXPECT_EQ(mesh.triangles[i], (Triangle{0, 1, 2}));
    EXPECT_EQ(mesh.triangles[5], (Triangle{0, 2, 3}));
}

TEST(ParseObj, Damaged)
{
    EXPECT_SAYS(parseObj("v 0 0\n"), "line 1: expected a coordinate, got nothing");
    EXPECT_SAYS(parseObj("v 0 zero 0\n"), "got 'zero'");
    EXPECT_SAYS(parseObj("v 0 inf 0\n"), "vertex 1: expected a finite");
    EXPECT_SAYS(parseObj("v 0 0 0\nf 1 2 3\n"), "line 2: expected a vertex from 1 to 1, got 3");
    EXPECT_SAYS(parseObj("v 0 0 0\nf 1 1\n"), "three vertices or more");
    EXPECT_SAYS(parseObj("v 0 0 0\nf 0 1 1\n"), "the number of a vertex, got '0'");
    EXPECT_SAYS(parseObj("v 0 0 0\nf -2 1 1\n"), "got '-2'");
    EXPECT_SAYS(parseObj("v 0 0 0\nf 1 a 1\n"), "got 'a'");
}

std::string textStl()
{
    std::string text = "solid box\n";
    const Mesh mesh = box();
    for (const auto& t : mesh.triangles) {
        text += "  facet normal 0 0 0\n    outer loop\n";
        for (const std::uint32_t v : t) {
            text += "      vertex";
            for (int i = 0; i < 3; ++i) text += " " + std::to_string(mesh.positions[v][i]);
            text += "\n";
        }
        text += "    endloop\n  endfacet\n";
    }
    return text + "endsolid box\n";
}

TEST(ParseStl, Text)
{
    Mesh mesh = parseStl(textStl());
    EXPECT_EQ(mesh.positions.size(), 36u);
    weld(mesh);
    expectBox(mesh);
}

TEST(ParseStl, BinaryThatBeginsWithSolid)
{
    std::string bytes = test::written([](OutputFile& file) { writeStl(box(), file); });
    bytes.replace(0, 5, "solid");
    Mesh mesh = parseStl(bytes);
    weld(mesh);
    expectBox(mesh);
}

TEST(ParseStl, Damaged)
{
    const std::string bytes = test::written([](OutputFile& file) { writeStl(box(), file); });
    EXPECT_SAYS(parseStl(bytes.substr(0, bytes.size() - 1)), "expected 684 bytes for 12 triangles");
    EXPECT_SAYS(parseStl(bytes.substr(0, 83)), "84 bytes or more, got 83");
    EXPECT_SAYS(parseStl(textStl().substr(0, textStl().find("  facet", 200))), "cut short");
    EXPECT_SAYS(parseStl(replaced(textStl(), "vertex", "vertx")), "got 'vertx'");
    EXPECT_SAYS(parseStl(replaced(textStl(), "      vertex", "      endloop\n#")), "got '#'");
    EXPECT_SAYS(parseStl(replaced(textStl(), "      vertex -1.0", "      endloop\nsolid 1.0")),
                "three vertices a facet");
    std::string nan = bytes;
    const float none = std::nanf("");
    std::memcpy(nan.data() + 84 + 50 + 12 + 12, &none, 4);
    EXPECT_SAYS(parseStl(nan), "vertex 5: expected a finite position");
}

} // namespace
} // namespace molsurf
