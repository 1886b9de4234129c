// SPDX-License-Identifier: MPL-2.0
#include "molsurf/io/write_mesh.h"

#include "molsurf/error.h"
#include "molsurf/io/output_buffer.h"
#include "molsurf/io/ply_layout.h"
#include "molsurf/io/write_3mf.h"
#include "molsurf/io/write_glb.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

namespace molsurf
{

namespace
{

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "STL is written as it lies");

template<typename T>
char* put(char* to, const T& value)
{
    std::memcpy(to, &value, sizeof(T));
    return to + sizeof(T);
}

// Appends the letters of a line: "v 1.5 2 3\n", "f 1//1 2//2 3//3\n".
class Line
{
public:
    explicit Line(Buffer& buffer) : buffer_(buffer), begin_(buffer.take(longest)), end_(begin_) {}
    ~Line() { buffer_.untake(std::size_t(begin_ + longest - end_)); }
    Line(const Line&) = delete;
    Line& operator=(const Line&) = delete;

    Line& operator<<(const char* text)
    {
        while (*text) *end_++ = *text++;
        return *this;
    }

    template<typename T>
    Line& number(T value)
    {
        end_ = std::to_chars(end_, begin_ + longest, value).ptr;
        return *this;
    }

private:
    static constexpr std::ptrdiff_t longest = 128; // six floats of at most 15 letters; six indices
    Buffer& buffer_;
    char* begin_;
    char* end_;
};

void putVectors(Buffer& buffer, const char* key, const std::vector<openvdb::Vec3f>& vectors,
                double scale = 1.0)
{
    for (const openvdb::Vec3f& v : vectors) {
        Line line(buffer);
        line << key;
        for (int i = 0; i < 3; ++i) (line << " ").number(float(scale * v[i]));
        line << "\n";
    }
}

/// " 0.5 0.25 1": a colour in [0, 1].
void putColor(Line& line, const std::array<std::uint8_t, 3>& color)
{
    for (const std::uint8_t c : color)
        (line << " ").number(float(std::round(c / 255.0 * 1e4) / 1e4));
}

/// Positions, with colours behind them if there are any.
void putVertices(Buffer& buffer, const Mesh& mesh, double scale)
{
    for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
        Line line(buffer);
        line << "v";
        for (int i = 0; i < 3; ++i) (line << " ").number(float(scale * mesh.positions[n][i]));
        if (!mesh.colors.empty()) putColor(line, mesh.colors[n]);
        line << "\n";
    }
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
    Buffer buffer(file);
    if (unit.perAngstrom != 1.0) {
        const std::string line = std::string("# lengths in ") + unit.name + "\n";
        std::copy(line.begin(), line.end(), buffer.take(line.size()));
    }
    putVertices(buffer, mesh, unit.perAngstrom);
    putVectors(buffer, "vn", mesh.normals);
    auto part = mesh.parts.begin();
    for (const auto& triangle : mesh.triangles) {
        const std::size_t number = std::size_t(&triangle - mesh.triangles.data());
        for (; part != mesh.parts.end() && part->firstTriangle == number; ++part) {
            const std::string line = "o " + inOneWord(part->name) + "\n";
            std::copy(line.begin(), line.end(), buffer.take(line.size()));
        }
        Line line(buffer);
        line << "f";
        for (std::uint32_t corner : triangle) {
            (line << " ").number(corner + 1ull); // counted from 1
            (line << "//").number(corner + 1ull);
        }
        line << "\n";
    }
    buffer.flush();
    file.finish();
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
        char* to = buffer.take(50);
        to = put(to, openvdb::Vec3f(normal));
        to = put(to, a);
        to = put(to, b);
        to = put(to, c);
        put(to, std::uint16_t(0));
    }
    buffer.flush();
    file.finish();
}

void writeOff(const Mesh& mesh, OutputFile& file)
{
    const std::string header = std::string(mesh.colors.empty() ? "OFF" : "COFF") + "\n" +
                               std::to_string(mesh.positions.size()) + " " +
                               std::to_string(mesh.triangles.size()) + " 0\n";
    file.write(header);
    Buffer buffer(file);
    for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
        Line line(buffer);
        const openvdb::Vec3f& p = mesh.positions[n];
        line.number(p[0]);
        (line << " ").number(p[1]);
        (line << " ").number(p[2]);
        if (!mesh.colors.empty()) {
            for (const std::uint8_t c : mesh.colors[n]) (line << " ").number(int(c));
            line << " 255";
        }
        line << "\n";
    }
    for (const auto& triangle : mesh.triangles) {
        Line line(buffer);
        line << "3";
        for (const std::uint32_t corner : triangle) (line << " ").number(corner);
        line << "\n";
    }
    buffer.flush();
    file.finish();
}

void writeWrl(const Mesh& mesh, OutputFile& file, const LengthUnit& unit)
{
    Buffer buffer(file);
    const auto put = [&](const char* text) { Line(buffer) << text; };
    put("#VRML V2.0 utf8\n# lengths in ");
    put(unit.name);
    put("\nShape {\nappearance Appearance { material Material { ambientIntensity 0.3 } }\n");
    put("geometry IndexedFaceSet {\ncoord Coordinate { point [\n");
    putVectors(buffer, "", mesh.positions, unit.perAngstrom);
    put("] }\nnormal Normal { vector [\n");
    putVectors(buffer, "", mesh.normals);
    put("] }\n");
    if (!mesh.colors.empty()) {
        put("color Color { color [\n");
        for (const auto& color : mesh.colors) {
            Line line(buffer);
            putColor(line, color);
            line << "\n";
        }
        put("] }\n");
    }
    put("coordIndex [\n");
    for (const auto& triangle : mesh.triangles) {
        Line line(buffer);
        for (const std::uint32_t corner : triangle) line.number(corner) << " ";
        line << "-1\n";
    }
    put("]\n}\n}\n");
    buffer.flush();
    file.finish();
}

const std::vector<MeshFormat>& meshFormats()
{
    using Title = MeshTitle;
    static const std::vector<MeshFormat> table = {
        {"ply", [](const Mesh& m, const Title&, OutputFile& f) { writePly(m, f); }},
        {"obj", [](const Mesh& m, const Title& t, OutputFile& f) { writeObj(m, f, t.unit); }},
        {"stl", [](const Mesh& m, const Title& t, OutputFile& f) { writeStl(m, f, t.unit); }},
        {"off", [](const Mesh& m, const Title&, OutputFile& f) { writeOff(m, f); }},
        {"wrl", [](const Mesh& m, const Title& t, OutputFile& f) { writeWrl(m, f, t.unit); }},
        {"glb", [](const Mesh& m, const Title& t, OutputFile& f) { writeGlb(m, {t.name}, f); }},
        {"3mf", [](const Mesh& m, const Title& t, OutputFile& f) {
             write3mf(m, t.name, t.unit.perAngstrom, f);
         }}};
    return table;
}

} // namespace molsurf
