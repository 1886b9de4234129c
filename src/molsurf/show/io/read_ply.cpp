// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/mesh_text.h"
#include "molsurf/show/io/read_mesh.h"

#include <algorithm>
#include <cstring>
#include <optional>

namespace molsurf
{

namespace
{

enum class NumberType { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float, Double };

struct Property {
    std::string name;
    NumberType type;
    std::optional<NumberType> count; ///< of a list: the type of its length
};

struct Element {
    std::string name;
    std::size_t count = 0;
    std::vector<Property> properties;
};

enum class Form { Text, Little, Big };

struct Header {
    Form form = Form::Text;
    std::vector<Element> elements;
};

NumberType typeOf(const MeshText& text, std::string_view word)
{
    static const struct {
        const char* name;
        NumberType type;
    } names[] = {{"char", NumberType::Int8},     {"int8", NumberType::Int8},
                 {"uchar", NumberType::Uint8},   {"uint8", NumberType::Uint8},
                 {"short", NumberType::Int16},   {"int16", NumberType::Int16},
                 {"ushort", NumberType::Uint16}, {"uint16", NumberType::Uint16},
                 {"int", NumberType::Int32},     {"int32", NumberType::Int32},
                 {"uint", NumberType::Uint32},   {"uint32", NumberType::Uint32},
                 {"float", NumberType::Float},   {"float32", NumberType::Float},
                 {"double", NumberType::Double}, {"float64", NumberType::Double}};
    for (const auto& known : names)
        if (word == known.name) return known.type;
    text.fail("a type of PLY", word);
}

Header parseHeader(MeshText& text)
{
    if (!text.nextLine() || text.word() != "ply") badMesh("not a PLY file: expected 'ply' first");
    Header header;
    bool form = false;
    while (text.nextLine()) {
        const std::string_view key = text.word();
        if (key == "end_header") {
            if (!form) text.fail("'format' before", key);
            return header;
        } else if (key == "format") {
            const std::string_view word = text.word();
            if (word == "ascii")
                header.form = Form::Text;
            else if (word == "binary_little_endian")
                header.form = Form::Little;
            else if (word == "binary_big_endian")
                header.form = Form::Big;
            else
                text.fail("ascii, binary_little_endian or binary_big_endian", word);
            form = true;
        } else if (key == "element") {
            Element element;
            element.name = std::string(text.word());
            element.count = text.number<std::uint32_t>("the number of elements");
            header.elements.push_back(std::move(element));
        } else if (key == "property") {
            if (header.elements.empty()) text.fail("'element' before", key);
            Property property;
            std::string_view word = text.word();
            if (word == "list") {
                property.count = typeOf(text, text.word());
                word = text.word();
            }
            property.type = typeOf(text, word);
            property.name = std::string(text.word());
            header.elements.back().properties.push_back(std::move(property));
        } else if (key != "comment" && key != "obj_info") {
            text.fail("a word of a PLY header", key);
        }
    }
    badMesh("cut short: expected 'end_header'");
}

/// The values of a file, one after the other.
class TextValues
{
public:
    explicit TextValues(MeshText& text) : text_(text) {}

    void beginElement(const std::string& name, std::size_t index)
    {
        if (!text_.nextLine())
            badMesh("cut short: expected " + name + " " + std::to_string(index + 1));
    }
    double value(NumberType type)
    {
        if (type == NumberType::Float || type == NumberType::Double)
            return text_.number<double>("a number");
        return double(text_.number<std::int64_t>("a whole number"));
    }

private:
    MeshText& text_;
};

template<bool swapped>
class BinaryValues
{
public:
    explicit BinaryValues(std::string_view bytes) : at_(bytes.data()), end_(at_ + bytes.size()) {}

    void beginElement(const std::string& name, std::size_t index)
    {
        name_ = &name;
        index_ = index;
    }
    double value(NumberType type)
    {
        switch (type) {
        case NumberType::Int8:
            return take<std::int8_t>();
        case NumberType::Uint8:
            return take<std::uint8_t>();
        case NumberType::Int16:
            return take<std::int16_t>();
        case NumberType::Uint16:
            return take<std::uint16_t>();
        case NumberType::Int32:
            return take<std::int32_t>();
        case NumberType::Uint32:
            return take<std::uint32_t>();
        case NumberType::Float:
            return double(take<float>());
        case NumberType::Double:
            return take<double>();
        }
        return 0.0;
    }

private:
    template<typename T>
    T take()
    {
        if (std::size_t(end_ - at_) < sizeof(T))
            badMesh("cut short: expected " + *name_ + " " + std::to_string(index_ + 1));
        char bytes[sizeof(T)];
        std::memcpy(bytes, at_, sizeof(T));
        if (swapped) std::reverse(bytes, bytes + sizeof(T));
        at_ += sizeof(T);
        T value;
        std::memcpy(&value, bytes, sizeof(T));
        return value;
    }

    const char* at_;
    const char* end_;
    const std::string* name_ = nullptr;
    std::size_t index_ = 0;
};

template<typename Values>
void readVertices(const Element& element, Values& values, Mesh& mesh)
{
    int axes[3] = {-1, -1, -1};
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
        const Property& property = element.properties[k];
        for (int i = 0; i < 3; ++i)
            if (property.name == std::string(1, char('x' + i)) && !property.count) axes[i] = int(k);
    }
    for (int i = 0; i < 3; ++i)
        if (axes[i] < 0)
            badMesh(std::string("expected a vertex property '") + char('x' + i) + "', got none");
    std::vector<double> row(element.properties.size());
    for (std::size_t v = 0; v < element.count; ++v) {
        values.beginElement(element.name, v);
        for (std::size_t k = 0; k < row.size(); ++k) {
            const Property& property = element.properties[k];
            if (property.count) {
                const double length = values.value(*property.count);
                for (double i = 0.0; i < length; ++i) values.value(property.type);
            } else {
                row[k] = values.value(property.type);
            }
        }
        mesh.positions.push_back(checkedPosition(row[axes[0]], row[axes[1]], row[axes[2]], v + 1));
    }
}

template<typename Values>
void readFaces(const Element& element, std::size_t vertices, Values& values, Mesh& mesh)
{
    const auto& properties = element.properties;
    const auto list = std::find_if(properties.begin(), properties.end(), [](const Property& p) {
        return p.count && (p.name == "vertex_indices" || p.name == "vertex_index");
    });
    if (list == properties.end()) badMesh("expected a face property 'vertex_indices', got none");
    std::vector<std::uint32_t> corners;
    for (std::size_t f = 0; f < element.count; ++f) {
        values.beginElement(element.name, f);
        for (const Property& property : properties) {
            const double length = property.count ? values.value(*property.count) : 1.0;
            const bool wanted = &property == &*list;
            if (wanted) corners.clear();
            for (double i = 0.0; i < length; ++i) {
                const double index = values.value(property.type);
                if (!wanted) continue;
                if (!(index >= 0.0 && index < double(vertices)))
                    badMesh("face " + std::to_string(f + 1) + ": expected a vertex from 0 to " +
                            std::to_string(vertices - 1) + ", got " + std::to_string(index));
                corners.push_back(std::uint32_t(index));
            }
        }
        addPolygon(corners, mesh);
    }
}

template<typename Values>
void skip(const Element& element, Values& values)
{
    if (element.properties.empty()) return; // billions of them take no bytes
    for (std::size_t n = 0; n < element.count; ++n) {
        values.beginElement(element.name, n);
        for (const Property& property : element.properties) {
            const double length = property.count ? values.value(*property.count) : 1.0;
            for (double i = 0.0; i < length; ++i) values.value(property.type);
        }
    }
}

template<typename Values>
Mesh readBody(const Header& header, Values values)
{
    Mesh mesh;
    const auto vertex =
        std::find_if(header.elements.begin(), header.elements.end(),
                     [](const Element& element) { return element.name == "vertex"; });
    if (vertex == header.elements.end()) badMesh("expected an element 'vertex', got none");
    for (const Element& element : header.elements) {
        if (element.name == "tristrips")
            badMesh("expected faces, got strips of triangles [hint: save it without strips]");
        if (element.name == "vertex")
            readVertices(element, values, mesh);
        else if (element.name == "face")
            readFaces(element, vertex->count, values, mesh);
        else
            skip(element, values);
    }
    return mesh;
}

} // namespace

Mesh parsePly(std::string_view content)
{
    MeshText text(content);
    const Header header = parseHeader(text);
    switch (header.form) {
    case Form::Little:
        return readBody(header, BinaryValues<false>(text.rest()));
    case Form::Big:
        return readBody(header, BinaryValues<true>(text.rest()));
    default:
        return readBody(header, TextValues(text));
    }
}

} // namespace molsurf
