// SPDX-License-Identifier: MPL-2.0
#include "molsurf/io/write_3mf.h"

#include "molsurf/error.h"
#include "molsurf/io/part_ranges.h"

#include <dlfcn.h>
#include <Model/COM/NMR_DLLInterfaces.h>

#include <array>
#include <cstdio>
#include <memory>
#include <vector>

namespace molsurf
{

namespace
{

constexpr std::uint32_t opaque = 255;

/// The functions of lib3mf that are used here.
class Library
{
public:
    /// @throws Error(ErrorKind::Output) if it is not there
    Library() : handle_(dlopen("lib3MF.so.1", RTLD_NOW | RTLD_LOCAL))
    {
        if (handle_ == nullptr)
            throw Error(ErrorKind::Output, std::string("3MF: expected lib3mf, got: ") + dlerror() +
                                               " [hint: Debian's package is lib3mf1]");
        load(createModel, "lib3mf_createmodel");
        load(setUnit, "lib3mf_model_setunit");
        load(setBuildId, "lib3mf_model_setbuilduuidutf8");
        load(addMesh, "lib3mf_model_addmeshobject");
        load(setGeometry, "lib3mf_meshobject_setgeometry");
        load(setName, "lib3mf_object_setnameutf8");
        load(setObjectId, "lib3mf_object_setuuidutf8");
        load(colorsOf, "lib3mf_meshobject_createpropertyhandler");
        load(setColors, "lib3mf_propertyhandler_setgradientcolorarray");
        load(defaultColorOf, "lib3mf_object_createdefaultpropertyhandler");
        load(setDefaultColor, "lib3mf_defaultpropertyhandler_setcolor");
        load(addItem, "lib3mf_model_addbuilditem");
        load(setItemId, "lib3mf_builditem_setuuidutf8");
        load(queryWriter, "lib3mf_model_querywriter");
        load(write, "lib3mf_writer_writetocallback");
        load(release, "lib3mf_release");
    }

    decltype(&NMR::lib3mf_createmodel) createModel;
    decltype(&NMR::lib3mf_model_setunit) setUnit;
    decltype(&NMR::lib3mf_model_setbuilduuidutf8) setBuildId;
    decltype(&NMR::lib3mf_model_addmeshobject) addMesh;
    decltype(&NMR::lib3mf_meshobject_setgeometry) setGeometry;
    decltype(&NMR::lib3mf_object_setnameutf8) setName;
    decltype(&NMR::lib3mf_object_setuuidutf8) setObjectId;
    decltype(&NMR::lib3mf_meshobject_createpropertyhandler) colorsOf;
    decltype(&NMR::lib3mf_propertyhandler_setgradientcolorarray) setColors;
    decltype(&NMR::lib3mf_object_createdefaultpropertyhandler) defaultColorOf;
    decltype(&NMR::lib3mf_defaultpropertyhandler_setcolor) setDefaultColor;
    decltype(&NMR::lib3mf_model_addbuilditem) addItem;
    decltype(&NMR::lib3mf_builditem_setuuidutf8) setItemId;
    decltype(&NMR::lib3mf_model_querywriter) queryWriter;
    decltype(&NMR::lib3mf_writer_writetocallback) write;
    decltype(&NMR::lib3mf_release) release;

private:
    template<typename Function>
    void load(Function& function, const char* name)
    {
        function = reinterpret_cast<Function>(dlsym(handle_, name));
        if (function == nullptr)
            throw Error(ErrorKind::Output, std::string("3MF: expected lib3mf 1.8, got one "
                                                       "without ") +
                                               name);
    }

    void* handle_; ///< stays loaded: unloading gains nothing
};

const Library& library()
{
    static const Library loaded;
    return loaded;
}

using Object = void*; // as lib3mf names them, pointers to pointers

struct Release {
    void operator()(Object* object) const { library().release(object); }
};
using Handle = std::unique_ptr<Object, Release>;

void expect(LIB3MFRESULT result, const char* step)
{
    if (result == 0) return;
    char text[64];
    std::snprintf(text, sizeof text, "%08x", unsigned(result));
    throw Error(ErrorKind::Output, std::string("3MF: lib3mf refuses ") + step + ", error " + text);
}

/// Identifiers of the things in a file, by its content.
class Identifiers
{
public:
    explicit Identifiers(const Mesh& mesh)
    {
        add(mesh.positions.data(), mesh.positions.size() * sizeof mesh.positions[0]);
        add(mesh.triangles.data(), mesh.triangles.size() * sizeof mesh.triangles[0]);
        add(mesh.colors.data(), mesh.colors.size() * sizeof mesh.colors[0]);
    }

    /// One that was not given before, of version 8 (RFC 9562), the bits of which are free.
    std::string next()
    {
        ++count_;
        add(&count_, sizeof count_);
        const std::uint64_t high = hash_;
        add(&count_, sizeof count_);
        char text[40];
        std::snprintf(text, sizeof text, "%08x-%04x-8%03x-%04x-%012llx", unsigned(high >> 32),
                      unsigned(high >> 16 & 0xffff), unsigned(high & 0xfff),
                      unsigned(0x8000 | (hash_ >> 48 & 0x3fff)),
                      static_cast<unsigned long long>(hash_ & 0xffffffffffff));
        return text;
    }

private:
    void add(const void* bytes, std::size_t size) // FNV-1a
    {
        const auto* byte = static_cast<const std::uint8_t*>(bytes);
        for (std::size_t i = 0; i < size; ++i) hash_ = (hash_ ^ byte[i]) * 1099511628211u;
    }

    std::uint64_t hash_ = 14695981039346656037u;
    std::uint32_t count_ = 0;
};

/// A file in the memory, which lib3mf writes back and forth in.
struct Content {
    std::string bytes;
    std::size_t at = 0;

    static std::uint32_t write(std::uint8_t* data, std::uint32_t size, void* to)
    {
        auto& content = *static_cast<Content*>(to);
        if (content.bytes.size() < content.at + size) content.bytes.resize(content.at + size);
        content.bytes.replace(content.at, size, reinterpret_cast<const char*>(data), size);
        content.at += size;
        return 0;
    }

    static std::uint32_t seek(std::uint64_t position, void* to)
    {
        static_cast<Content*>(to)->at = position;
        return 0;
    }
};

void addPart(const Mesh& mesh, const PartRange& range, double scale, Object* model,
             Identifiers& identifiers)
{
    const Library& lib = library();
    std::vector<NMR::MODELMESHVERTEX> vertices(range.vertexEnd - range.firstVertex);
    for (std::size_t v = 0; v < vertices.size(); ++v)
        for (int a = 0; a < 3; ++a)
            vertices[v].m_fPosition[a] = float(scale * mesh.positions[range.firstVertex + v][a]);
    const bool colored = !mesh.colors.empty();
    const auto colorOf = [&](std::size_t vertex) {
        const auto& c = mesh.colors[vertex];
        return NMR::MODELMESHCOLOR_SRGB{c[0], c[1], c[2], opaque};
    };
    std::vector<NMR::MODELMESHTRIANGLE> triangles(range.triangleEnd - range.firstTriangle);
    std::vector<NMR::MODELMESH_TRIANGLECOLOR_SRGB> colors(colored ? triangles.size() : 0);
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t corner = mesh.triangles[range.firstTriangle + t][c];
            triangles[t].m_nIndices[c] = std::uint32_t(corner - range.firstVertex);
            if (colored) colors[t].m_Colors[c] = colorOf(corner);
        }

    Object* made = nullptr;
    expect(lib.addMesh(model, &made), "an object");
    const Handle object(made);
    expect(lib.setName(object.get(), range.name.c_str()), "the name of an object");
    expect(lib.setObjectId(object.get(), identifiers.next().c_str()), "an identifier");
    expect(lib.setGeometry(object.get(), vertices.data(), DWORD(vertices.size()), triangles.data(),
                           DWORD(triangles.size())),
           "the triangles");
    if (colored) {
        expect(lib.colorsOf(object.get(), &made), "colours");
        expect(lib.setColors(Handle(made).get(), colors.data()), "colours");
        expect(lib.defaultColorOf(object.get(), &made), "a colour");
        NMR::MODELMESHCOLOR_SRGB first = colorOf(range.firstVertex);
        expect(lib.setDefaultColor(Handle(made).get(), &first), "a colour");
    }
    expect(lib.addItem(model, object.get(), nullptr, &made), "an item to build");
    expect(lib.setItemId(Handle(made).get(), identifiers.next().c_str()), "an identifier");
}

} // namespace

void load3mf()
{
    library();
}

void write3mf(const Mesh& mesh, const std::string& name, double perAngstrom, OutputFile& file)
{
    const Library& lib = library();
    Object* made = nullptr;
    expect(lib.createModel(&made), "a model");
    const Handle model(made);
    expect(lib.setUnit(model.get(), NMR::MODELUNIT_MILLIMETER), "millimetres");
    Identifiers identifiers(mesh);
    expect(lib.setBuildId(model.get(), identifiers.next().c_str()), "an identifier");
    for (const PartRange& range : partRanges(mesh, name))
        addPart(mesh, range, perAngstrom, model.get(), identifiers);
    expect(lib.queryWriter(model.get(), "3mf", &made), "a writer");
    const Handle writer(made);
    Content content;
    expect(lib.write(writer.get(), reinterpret_cast<void*>(&Content::write),
                     reinterpret_cast<void*>(&Content::seek), &content),
           "the mesh");
    file.write(content.bytes.data(), content.bytes.size());
}

} // namespace molsurf
