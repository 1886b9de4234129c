// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/write_3mf.h"

#include "molsurf/kernel/core/content_digest.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/show/io/part_ranges.h"
#include "molsurf/show/io/zip_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <set>
#include <vector>

namespace molsurf
{

namespace
{

using Color = std::array<std::uint8_t, 3>;
using Triangle = std::array<std::uint32_t, 3>;

constexpr const char* xmlHead = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
constexpr const char* contentTypes =
    "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">\n"
    "<Default Extension=\"rels\" "
    "ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>\n"
    "<Default Extension=\"model\" "
    "ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/>\n"
    "<Default Extension=\"config\" ContentType=\"text/xml\"/>\n</Types>\n";
constexpr const char* relationships =
    "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">\n"
    "<Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
    "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>\n</Relationships>\n";
constexpr const char* modelHead =
    "<model unit=\"millimeter\" xml:lang=\"en-US\" "
    "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" "
    "xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/2015/02\" "
    "xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\" "
    "xmlns:slic3rpe=\"http://schemas.slic3r.org/3mf/2017/06\">\n";
constexpr const char *colorGroup = "1", *object = "2"; // numbers of resources

/// Identifiers of the things in a file, by its content.
class Identifiers
{
public:
    explicit Identifiers(const Mesh& mesh)
    {
        digest_.add(mesh.positions.data(), mesh.positions.size() * sizeof mesh.positions[0]);
        digest_.add(mesh.triangles.data(), mesh.triangles.size() * sizeof mesh.triangles[0]);
        digest_.add(mesh.colors.data(), mesh.colors.size() * sizeof mesh.colors[0]);
    }

    /// One that was not given before, as an attribute.
    std::string next()
    {
        ++count_;
        digest_.add(&count_, sizeof count_);
        return " p:UUID=\"" + digest_.uuid() + "\"";
    }

private:
    ContentDigest digest_;
    std::uint32_t count_ = 0;
};

std::string escaped(const std::string& text)
{
    std::string out;
    for (const char letter : text) {
        if (letter == '&' || letter == '<' || letter == '>' || letter == '"')
            out += "&#" + std::to_string(int(letter)) + ";";
        else
            out += static_cast<unsigned char>(letter) < ' ' ? ' ' : letter;
    }
    return out;
}

/// The state of a triangle that an extruder paints, counted from 1, as PrusaSlicer's
/// TriangleSelector packs it: the number in the upper half of a digit, or from 3 on a C and before
/// it the number less 3.
std::string paintOf(std::size_t extruder)
{
    return extruder < 3 ? formatted("%zX", 4 * extruder) : formatted("%zXC", extruder - 3);
}

/// Colours by their numbers, in the order of the vertices.
class CornerColors
{
public:
    explicit CornerColors(const Mesh& mesh)
    {
        std::map<Color, std::uint32_t> numbers;
        for (const Color& color : mesh.colors) {
            const auto [at, isNew] = numbers.emplace(color, std::uint32_t(numbers.size()));
            if (isNew) all_.push_back(color);
            numbers_.push_back(at->second);
        }
    }

    const std::vector<Color>& all() const { return all_; }
    bool paints() const { return !all_.empty() && all_.size() <= mostPaints; }
    std::size_t of(std::uint32_t vertex) const { return numbers_[vertex]; }

    /// The extruder of a triangle: that of two of its corners, or else of the first.
    std::size_t extruderOf(const Triangle& t) const
    {
        return 1 + (of(t[1]) == of(t[2]) ? of(t[1]) : of(t[0]));
    }

private:
    std::vector<std::uint32_t> numbers_; // of the vertices
    std::vector<Color> all_;
};

/// Text that goes into an archive in pieces.
class Pieces
{
public:
    explicit Pieces(ZipFile& to) : to_(to) {}
    void flush()
    {
        to_.put(text_);
        text_.clear();
    }

    Pieces& operator<<(std::string_view words)
    {
        constexpr std::size_t enough = 1 << 16;
        text_ += words;
        if (text_.size() >= enough) flush();
        return *this;
    }
    Pieces& operator<<(std::size_t number)
    {
        char digits[24];
        return *this << std::string_view(
                   digits,
                   std::size_t(std::to_chars(digits, std::end(digits), number).ptr - digits));
    }
    Pieces& operator<<(float number)
    {
        char digits[64];
        const auto end =
            std::to_chars(digits, std::end(digits), number, std::chars_format::fixed, 6);
        return *this << std::string_view(digits, std::size_t(end.ptr - digits));
    }

private:
    ZipFile& to_;
    std::string text_;
};

void putTriangle(const Triangle& t, std::size_t shift, const CornerColors& palette, Pieces& out)
{
    const char* const corners[] = {"<triangle v1=\"", "\" v2=\"", "\" v3=\""};
    const char* const colors[] = {"\" p1=\"", "\" p2=\"", "\" p3=\""};
    for (std::size_t k = 0; k < 3; ++k) out << corners[k] << std::size_t(t[k]) - shift;
    if (!palette.all().empty()) {
        out << "\" pid=\"" << colorGroup;
        for (std::size_t k = 0; k < 3; ++k) out << colors[k] << palette.of(t[k]);
    }
    if (palette.paints())
        out << "\" slic3rpe:mmu_segmentation=\"" << paintOf(palette.extruderOf(t));
    out << "\"/>\n";
}

void putMesh(const Mesh& mesh, const std::vector<PartRange>& parts, double scale,
             const CornerColors& palette, Pieces& out)
{
    out << "<mesh>\n<vertices>\n";
    for (const PartRange& part : parts)
        for (std::size_t v = part.firstVertex; v < part.vertexEnd; ++v) {
            const char* const axes[] = {"<vertex x=\"", "\" y=\"", "\" z=\""};
            for (int a = 0; a < 3; ++a) out << axes[a] << float(scale * mesh.positions[v][a]);
            out << "\"/>\n";
        }
    out << "</vertices>\n<triangles>\n";
    std::size_t before = 0; // vertices of the parts before
    for (const PartRange& part : parts) {
        for (std::size_t t = part.firstTriangle; t < part.triangleEnd; ++t)
            putTriangle(mesh.triangles[t], part.firstVertex - before, palette, out);
        before += part.vertexEnd - part.firstVertex;
    }
    out << "</triangles>\n</mesh>\n";
}

void putModel(const Mesh& mesh, const std::vector<PartRange>& parts, const std::string& name,
              double scale, const CornerColors& palette, Pieces& out)
{
    Identifiers identifiers(mesh);
    const std::string ofBuild = identifiers.next(), ofObject = identifiers.next();
    out << xmlHead << modelHead << "<resources>\n";
    if (!palette.all().empty()) {
        out << "<m:colorgroup id=\"" << colorGroup << "\">\n";
        for (const auto& [red, green, blue] : palette.all())
            out << formatted("<m:color color=\"#%02X%02X%02XFF\"/>\n", red, green, blue);
        out << "</m:colorgroup>\n";
    }
    out << "<object id=\"" << object << "\" name=\"" << escaped(name) << "\" type=\"model\""
        << ofObject;
    if (!palette.all().empty())
        out << " pid=\"" << colorGroup << "\" pindex=\"" << palette.of(0) << "\"";
    out << ">\n";
    putMesh(mesh, parts, scale, palette, out);
    out << "</object>\n</resources>\n<build" << ofBuild << ">\n<item objectid=\"" << object << "\""
        << identifiers.next() << "/>\n</build>\n</model>\n";
}

/// The parts as volumes of the object, as PrusaSlicer has them.
void putVolumes(const Mesh& mesh, const std::vector<PartRange>& parts, const std::string& name,
                const CornerColors& palette, Pieces& out)
{
    const auto says = [&](const char* of, const char* key, const std::string& value) {
        out << "<metadata type=\"" << of << "\" key=\"" << key << "\" value=\"" << escaped(value)
            << "\"/>\n";
    };
    out << xmlHead << "<config>\n<object id=\"" << object << "\" instances_count=\"1\">\n";
    says("object", "name", name);
    std::size_t first = 0, number = 0;
    for (const PartRange& part : parts) {
        const std::size_t count = part.triangleEnd - part.firstTriangle;
        out << "<volume firstid=\"" << first << "\" lastid=\"" << first + count - 1 << "\">\n";
        says("volume", "name", part.name);
        const std::size_t extruder =
            palette.paints() ? palette.extruderOf(mesh.triangles[part.firstTriangle]) : ++number;
        if (extruder <= mostPaints) says("volume", "extruder", std::to_string(extruder));
        out << "</volume>\n";
        first += count;
    }
    out << "</object>\n</config>\n";
}

template<typename Put>
void add(ZipFile& archive, const char* name, const Put& put)
{
    archive.begin(name);
    Pieces out(archive);
    put(out);
    out.flush();
    archive.end();
}

} // namespace

std::size_t colorsIn(const Mesh& mesh)
{
    return std::set<Color>(mesh.colors.begin(), mesh.colors.end()).size();
}

void write3mf(const Mesh& mesh, const std::string& name, double perAngstrom, OutputFile& file)
{
    const CornerColors palette(mesh);
    const std::vector<PartRange> parts = partRanges(mesh, name);
    ZipFile archive(file);
    add(archive, "[Content_Types].xml", [](Pieces& out) { out << xmlHead << contentTypes; });
    add(archive, "_rels/.rels", [](Pieces& out) { out << xmlHead << relationships; });
    add(archive, "3D/3dmodel.model",
        [&](Pieces& out) { putModel(mesh, parts, name, perAngstrom, palette, out); });
    if (parts.size() > 1)
        add(archive, "Metadata/Slic3r_PE_model.config",
            [&](Pieces& out) { putVolumes(mesh, parts, name, palette, out); });
    archive.finish();
    file.finish();
}

} // namespace molsurf
