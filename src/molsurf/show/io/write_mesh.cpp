// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/write_mesh.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/show/io/output_buffer.h"
#include "molsurf/show/io/part_ranges.h"
#include "molsurf/show/io/ply_layout.h"
#include "molsurf/show/io/write_3mf.h"
#include "molsurf/show/io/write_fem.h"
#include "molsurf/show/io/write_glb.h"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <vector>

namespace molsurf
{

namespace
{

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "STL is written as it lies");

void putVectors(TextOutput& out, const char* key, const std::vector<openvdb::Vec3f>& vectors,
                double scale = 1.0)
{
    for (const openvdb::Vec3f& v : vectors) {
        out << key;
        for (int i = 0; i < 3; ++i) out << " " << float(scale * v[i]);
        out << "\n";
    }
}

/// " 0.5 0.25 1": a colour in [0, 1].
void putColor(TextOutput& out, const std::array<std::uint8_t, 3>& color)
{
    for (const std::uint8_t c : color) out << " " << float(std::round(c / 255.0 * 1e4) / 1e4);
}

void putColors(TextOutput& out, const std::vector<std::array<std::uint8_t, 3>>& colors)
{
    for (const auto& color : colors) {
        putColor(out, color);
        out << "\n";
    }
}

/// Positions, with colours behind them if there are any.
void putVertices(TextOutput& out, const Mesh& mesh, double scale)
{
    for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
        out << "v";
        for (int i = 0; i < 3; ++i) out << " " << float(scale * mesh.positions[n][i]);
        if (!mesh.colors.empty()) putColor(out, mesh.colors[n]);
        out << "\n";
    }
}

/// "3 0 2 1": the number and the indices of the corners of each triangle.
void putTriangles(TextOutput& out, const Mesh& mesh)
{
    for (const auto& [a, b, c] : mesh.triangles) out << "3 " << a << " " << b << " " << c << "\n";
}

/// The number of the atom nearest to each vertex; empty if the mesh does not say it.
const std::vector<std::int32_t>& vertexAtoms(const Mesh& mesh)
{
    static const std::vector<std::int32_t> none;
    for (const auto& label : mesh.labels)
        if (label.name == "atom_id") return label.values;
    return none;
}

std::string inOneWord(std::string name)
{
    constexpr std::size_t longest = 200;
    if (name.size() > longest) name.resize(longest);
    for (char& letter : name) {
        if (letter == ' ' || letter == '\t' || letter == '\n' || letter == '\r') letter = '_';
    }
    return name;
}

/// The three lines that the files of MSMS begin with: the third one has the number of rows, that of
/// the atoms that are met, and no density and no probe.
void putMsmsHeader(TextOutput& out, const char* what, std::size_t rows, const Mesh& mesh)
{
    const auto& atoms = vertexAtoms(mesh);
    const std::size_t spheres = std::set<std::int32_t>(atoms.begin(), atoms.end()).size();
    out << "# vdb_molsurf: " << what << " as MSMS writes them\n#count #sphere density probe_r\n"
        << formatted("%7zu %7zu  0.00  0.00\n", rows, spheres);
}

/// Writes a .vert file of MSMS: position [Å], normal, and of face, sphere and kind only the
/// sphere, counted from 1; the others are 0.
void writeVert(const Mesh& mesh, OutputFile& file)
{
    TextOutput out(file);
    putMsmsHeader(out, "vertices", mesh.positions.size(), mesh);
    const auto& atoms = vertexAtoms(mesh);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const openvdb::Vec3f x = mesh.positions[v];
        const openvdb::Vec3f n = mesh.normals.empty() ? openvdb::Vec3f(0.0f) : mesh.normals[v];
        out << formatted("%9.3f %9.3f %9.3f %9.3f %9.3f %9.3f %7d %7d %2d\n", double(x[0]),
                         double(x[1]), double(x[2]), double(n[0]), double(n[1]), double(n[2]), 0,
                         atoms.empty() ? 0 : atoms[v] + 1, 0);
    }
    out.finish();
}

/// Writes a .face file of MSMS: three vertices counted from 1, and kind and face, which are 1.
void writeFace(const Mesh& mesh, OutputFile& file)
{
    TextOutput out(file);
    putMsmsHeader(out, "faces", mesh.triangles.size(), mesh);
    for (const auto& [a, b, c] : mesh.triangles)
        out << formatted("%6u %6u %6u %2d %6d\n", a + 1, b + 1, c + 1, 1, 1);
    out.finish();
}

/// Writes a PolyData of VTK's legacy form, as text: positions [Å], triangles, and at the vertices
/// normals, vectors and other Mesh::scalars, Mesh::labels and, if there are any, colours.
void writeVtk(const Mesh& mesh, const std::string& name, OutputFile& file)
{
    const std::size_t vertices = mesh.positions.size(), triangles = mesh.triangles.size();
    TextOutput out(file);
    const auto putNumbers = [&](const std::string& key, const auto& numbers) {
        out << "SCALARS " << key << "\nLOOKUP_TABLE default\n";
        for (const auto number : numbers) out << number << "\n";
    };
    out << "# vtk DataFile Version 3.0\n"
        << inOneWord(name) << "\nASCII\nDATASET POLYDATA\n"
        << "POINTS " << vertices << " float\n";
    putVectors(out, "", mesh.positions);
    out << "POLYGONS " << triangles << " " << 4 * triangles << "\n";
    putTriangles(out, mesh);
    out << "POINT_DATA " << vertices << "\n";
    if (!mesh.normals.empty()) out << "NORMALS normal float\n";
    putVectors(out, "", mesh.normals);
    for (const VertexField& field : vertexFields(mesh)) {
        if (field.count == 1) {
            putNumbers(field.name + " float", field.components->values);
            continue;
        }
        const Attribute<float>* along = field.components;
        out << "VECTORS " << field.name << " float\n";
        for (std::size_t v = 0; v < vertices; ++v)
            out << along[0].values[v] << " " << along[1].values[v] << " " << along[2].values[v]
                << "\n";
    }
    for (const auto& label : mesh.labels) putNumbers(label.name + " int", label.values);
    if (!mesh.colors.empty()) out << "COLOR_SCALARS color 3\n";
    putColors(out, mesh.colors);
    out.finish();
}

} // namespace

void writePly(const Mesh& mesh, OutputFile& file, const std::vector<std::string>& comments)
{
    const PlyLayout layout = layoutOf(mesh);
    const std::string header =
        plyHeader(layout, mesh.positions.size(), mesh.triangles.size(), comments);
    file.write(header);

    Buffer buffer(file);
    const std::size_t size = layout.vertexSize();
    for (std::size_t n = 0; n < mesh.positions.size(); ++n)
        encodeVertex(mesh, n, buffer.take(size));
    for (const auto& triangle : mesh.triangles) encodeTriangle(triangle, buffer.take(13));
    buffer.flush();
    file.finish();
}

void writeObj(const Mesh& mesh, OutputFile& file, const LengthUnit& unit)
{
    TextOutput out(file);
    if (unit.perAngstrom != 1.0) out << "# lengths in " << unit.name << "\n";
    putVertices(out, mesh, unit.perAngstrom);
    putVectors(out, "vn", mesh.normals);
    auto part = mesh.parts.begin();
    for (const auto& triangle : mesh.triangles) {
        const std::size_t number = std::size_t(&triangle - mesh.triangles.data());
        for (; part != mesh.parts.end() && part->firstTriangle == number; ++part)
            out << "o " << inOneWord(part->name) << "\n";
        out << "f";
        for (const std::uint32_t corner : triangle) // counted from 1
            out << " " << corner + 1ull << "//" << corner + 1ull;
        out << "\n";
    }
    out.finish();
}

void writeStl(const Mesh& mesh, OutputFile& file, const LengthUnit& unit)
{
    if (mesh.triangles.size() > std::numeric_limits<std::uint32_t>::max())
        throw Error(ErrorKind::Output, "cannot write " + file.path() + ": .stl holds at most " +
                                           "4294967295 triangles [hint: write .obj]");

    // Not "solid": that is how readers know the text form.
    char header[80] = "binary STL, lengths in ";
    std::strncat(header, unit.name, sizeof header - std::strlen(header) - 1);
    file.write(header, sizeof header);
    const auto count = std::uint32_t(mesh.triangles.size());
    file.write(&count, sizeof count);

    Buffer buffer(file);
    for (const auto& triangle : mesh.triangles) {
        const float scale = float(unit.perAngstrom);
        const openvdb::Vec3f a = scale * mesh.positions[triangle[0]];
        const openvdb::Vec3f b = scale * mesh.positions[triangle[1]];
        const openvdb::Vec3f c = scale * mesh.positions[triangle[2]];
        openvdb::Vec3d normal = openvdb::Vec3d(b - a).cross(openvdb::Vec3d(c - a));
        const double length = normal.length();
        normal = length > 0.0 ? normal / length : openvdb::Vec3d(0.0);
        const openvdb::Vec3f record[] = {openvdb::Vec3f(normal), a, b, c};
        buffer.append(reinterpret_cast<const char*>(record), sizeof record);
        buffer.append("\0", 2);
    }
    buffer.flush();
    file.finish();
}

void writeOff(const Mesh& mesh, OutputFile& file)
{
    TextOutput out(file);
    out << (mesh.colors.empty() ? "OFF\n" : "COFF\n") << mesh.positions.size() << " "
        << mesh.triangles.size() << " 0\n";
    for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
        const openvdb::Vec3f& p = mesh.positions[n];
        out << p[0] << " " << p[1] << " " << p[2];
        if (!mesh.colors.empty()) {
            for (const std::uint8_t c : mesh.colors[n]) out << " " << int(c);
            out << " 255";
        }
        out << "\n";
    }
    putTriangles(out, mesh);
    out.finish();
}

void writeWrl(const Mesh& mesh, OutputFile& file, const LengthUnit& unit)
{
    TextOutput out(file);
    out << "#VRML V2.0 utf8\n# lengths in " << unit.name
        << "\nShape {\nappearance Appearance { material Material { ambientIntensity 0.3 } }\n"
        << "geometry IndexedFaceSet {\ncoord Coordinate { point [\n";
    putVectors(out, "", mesh.positions, unit.perAngstrom);
    out << "] }\nnormal Normal { vector [\n";
    putVectors(out, "", mesh.normals);
    out << "] }\n";
    if (!mesh.colors.empty()) {
        out << "color Color { color [\n";
        putColors(out, mesh.colors);
        out << "] }\n";
    }
    out << "coordIndex [\n";
    for (const auto& [a, b, c] : mesh.triangles) out << a << " " << b << " " << c << " -1\n";
    out << "]\n}\n}\n";
    out.finish();
}

const std::vector<MeshFormat>& meshFormats()
{
    using Title = MeshTitle;
    using namespace holds;
    constexpr unsigned curved = Triangles | Colors | CutBorders | VertexCurvatures;
    constexpr unsigned printed = Triangles | Colors | CutBorders | Millimetres;
    constexpr const char *ofSolvers = "mesh for tetgen, Gmsh", *old = "old meshes";
    static const std::vector<MeshFormat> table = {
        {"ply", curved, "mesh", [](const Mesh& m, const Title&, OutputFile& f) { writePly(m, f); }},
        {"obj", printed, "mesh",
         [](const Mesh& m, const Title& t, OutputFile& f) { writeObj(m, f, t.unit); }},
        {"stl", Triangles | Millimetres, "mesh",
         [](const Mesh& m, const Title& t, OutputFile& f) { writeStl(m, f, t.unit); }},
        {"off", Triangles | Colors | CutBorders, old,
         [](const Mesh& m, const Title&, OutputFile& f) { writeOff(m, f); }},
        {"wrl", printed, old,
         [](const Mesh& m, const Title& t, OutputFile& f) { writeWrl(m, f, t.unit); }},
        {"vtk", curved, "mesh",
         [](const Mesh& m, const Title& t, OutputFile& f) { writeVtk(m, t.name, f); }},
        {"vert", Triangles, "mesh as of MSMS",
         [](const Mesh& m, const Title&, OutputFile& f) { writeVert(m, f); }},
        {"face", Triangles, "mesh as of MSMS",
         [](const Mesh& m, const Title&, OutputFile& f) { writeFace(m, f); }},
        {"poly", Triangles, ofSolvers,
         [](const Mesh& m, const Title&, OutputFile& f) { writePoly(m, f); }},
        {"msh", Triangles, ofSolvers,
         [](const Mesh& m, const Title&, OutputFile& f) { writeMsh4(m, f); }},
        {"msh2", Triangles, old,
         [](const Mesh& m, const Title&, OutputFile& f) { writeMsh2(m, f); }},
        {"glb", Colors | PlainColor | CutBorders | VertexCurvatures | SceneUnits | Copies | Levels,
         "mesh", [](const Mesh& m, const Title& t, OutputFile& f) { writeGlb(m, {t.name}, f); }},
        {"3mf", printed | Paint, "mesh", [](const Mesh& m, const Title& t, OutputFile& f) {
             write3mf(m, t.name, t.unit.perAngstrom, f);
         }}};
    return table;
}

} // namespace molsurf
