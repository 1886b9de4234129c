// SPDX-License-Identifier: MPL-2.0
#include "molsurf/io/write_3mf.h"

#include "molsurf/core/content_digest.h"
#include "molsurf/core/words.h"
#include "molsurf/error.h"
#include "molsurf/io/part_ranges.h"

#include <dlfcn.h>
#include <Model/COM/NMR_DLLInterfaces.h>

#include <memory>
#include <vector>

namespace molsurf
{

namespace
{

constexpr std::uint32_t opaque = 255;

/// The library, which stays loaded: unloading gains nothing.
/// @throws Error(ErrorKind::Output) if it is not there
void* library()
{
    static void* const handle = [] {
        void* const opened = dlopen("lib3MF.so.1", RTLD_NOW | RTLD_LOCAL);
        if (opened == nullptr)
            throw Error(ErrorKind::Output, std::string("3MF: expected lib3mf, got: ") + dlerror() +
                                               " [hint: Debian's package is lib3mf1]");
        return opened;
    }();
    return handle;
}

/// A function of the library.
/// @throws Error(ErrorKind::Output) if it is not there
template<typename Function>
Function* function(const char* name)
{
    void* const found = dlsym(library(), name);
    if (found == nullptr)
        throw Error(ErrorKind::Output,
                    std::string("3MF: expected lib3mf 1.8, got one without ") + name);
    return reinterpret_cast<Function*>(found);
}

/// lib3mf_NAME of the library, which is not linked.
#define LIB3MF(name) function<decltype(NMR::lib3mf_##name)>("lib3mf_" #name)

using Object = void*; // as lib3mf names them, pointers to pointers

struct Release {
    void operator()(Object* object) const { LIB3MF(release)(object); }
};
using Handle = std::unique_ptr<Object, Release>;

void expect(LIB3MFRESULT result, const char* step)
{
    if (result == 0) return;
    throw Error(ErrorKind::Output, std::string("3MF: lib3mf refuses ") + step + ", error " +
                                       formatted("%08x", unsigned(result)));
}

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

    /// One that was not given before.
    std::string next()
    {
        ++count_;
        digest_.add(&count_, sizeof count_);
        return digest_.uuid();
    }

private:
    ContentDigest digest_;
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
    expect(LIB3MF(model_addmeshobject)(model, &made), "an object");
    const Handle object(made);
    expect(LIB3MF(object_setnameutf8)(object.get(), range.name.c_str()), "the name of an object");
    expect(LIB3MF(object_setuuidutf8)(object.get(), identifiers.next().c_str()), "an identifier");
    expect(LIB3MF(meshobject_setgeometry)(object.get(), vertices.data(), DWORD(vertices.size()),
                                          triangles.data(), DWORD(triangles.size())),
           "the triangles");
    if (colored) {
        expect(LIB3MF(meshobject_createpropertyhandler)(object.get(), &made), "colours");
        expect(LIB3MF(propertyhandler_setgradientcolorarray)(Handle(made).get(), colors.data()),
               "colours");
        expect(LIB3MF(object_createdefaultpropertyhandler)(object.get(), &made), "a colour");
        NMR::MODELMESHCOLOR_SRGB first = colorOf(range.firstVertex);
        expect(LIB3MF(defaultpropertyhandler_setcolor)(Handle(made).get(), &first), "a colour");
    }
    expect(LIB3MF(model_addbuilditem)(model, object.get(), nullptr, &made), "an item to build");
    expect(LIB3MF(builditem_setuuidutf8)(Handle(made).get(), identifiers.next().c_str()),
           "an identifier");
}

} // namespace

void load3mf()
{
    library();
}

void write3mf(const Mesh& mesh, const std::string& name, double perAngstrom, OutputFile& file)
{
    Object* made = nullptr;
    expect(LIB3MF(createmodel)(&made), "a model");
    const Handle model(made);
    expect(LIB3MF(model_setunit)(model.get(), NMR::MODELUNIT_MILLIMETER), "millimetres");
    Identifiers identifiers(mesh);
    expect(LIB3MF(model_setbuilduuidutf8)(model.get(), identifiers.next().c_str()),
           "an identifier");
    for (const PartRange& range : partRanges(mesh, name))
        addPart(mesh, range, perAngstrom, model.get(), identifiers);
    expect(LIB3MF(model_querywriter)(model.get(), "3mf", &made), "a writer");
    const Handle writer(made);
    Content content;
    expect(LIB3MF(writer_writetocallback)(writer.get(), reinterpret_cast<void*>(&Content::write),
                                          reinterpret_cast<void*>(&Content::seek), &content),
           "the mesh");
    file.write(content.bytes.data(), content.bytes.size());
}

} // namespace molsurf
