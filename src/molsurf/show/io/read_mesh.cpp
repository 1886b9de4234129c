// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/read_mesh.h"

#include "molsurf/analysis/proximity/distance.h"
#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/kernel/mesh/check_arrays.h"
#include "molsurf/kernel/mesh/topology.h"
#include "molsurf/molecule/structure/load_text.h"
#include "molsurf/progress.h"
#include "molsurf/show/io/mesh_text.h"

#include <cstring>
#include <filesystem>
#include <limits>

namespace molsurf
{

namespace
{

std::string extensionOf(const std::string& path)
{
    return lowered(std::filesystem::path(path).extension().string());
}

/// A file has an end, so its size is limited only where a limit is asked for.
std::string contentOf(const std::string& path, std::size_t maxBytes)
{
    std::error_code failure;
    const bool ends = std::filesystem::is_regular_file(path, failure);
    return loadBytes(path, maxBytes || !ends ? maxBytes : std::numeric_limits<std::size_t>::max());
}

std::size_t hashOf(const openvdb::Vec3f& p)
{
    std::uint64_t hash = 0;
    for (int i = 0; i < 3; ++i) {
        const float value = p[i] + 0.0f; // -0 is 0
        std::uint32_t bits;
        std::memcpy(&bits, &value, sizeof bits);
        hash = (hash ^ bits) * 0x9e3779b97f4a7c15ull;
        hash ^= hash >> 29;
    }
    return std::size_t(hash);
}

/// The first vertex at the place of each vertex, by a hash table with linear probing.
std::vector<std::uint32_t> firstAtPlace(const std::vector<openvdb::Vec3f>& positions)
{
    std::size_t size = 16;
    while (size < 2 * positions.size()) size *= 2;
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> table(size, none), first(positions.size());
    for (std::uint32_t v = 0; v < positions.size(); ++v) {
        std::size_t slot = hashOf(positions[v]) & (size - 1);
        while (table[slot] != none && positions[table[slot]] != positions[v])
            slot = (slot + 1) & (size - 1);
        if (table[slot] == none) table[slot] = v;
        first[v] = table[slot];
    }
    return first;
}

/// Drops vertices of no triangle.
void dropUnused(Mesh& mesh)
{
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> place(mesh.positions.size(), none);
    for (const auto& t : mesh.triangles)
        for (const std::uint32_t v : t) place[v] = 0;
    std::uint32_t count = 0;
    for (std::size_t v = 0; v < place.size(); ++v) {
        if (place[v] == none) continue;
        mesh.positions[count] = mesh.positions[v];
        place[v] = count++;
    }
    mesh.positions.resize(count);
    for (auto& t : mesh.triangles)
        for (std::uint32_t& v : t) v = place[v];
}

void dropFlat(Mesh& mesh)
{
    std::size_t kept = 0;
    for (const auto& t : mesh.triangles) {
        const bool flat = mesh.positions[t[0]] == mesh.positions[t[1]] ||
                          mesh.positions[t[1]] == mesh.positions[t[2]] ||
                          mesh.positions[t[2]] == mesh.positions[t[0]];
        if (!flat) mesh.triangles[kept++] = t;
    }
    mesh.triangles.resize(kept);
}

} // namespace

bool isMeshName(const std::string& path)
{
    const std::string extension = extensionOf(path);
    return extension == ".ply" || extension == ".obj" || extension == ".stl";
}

std::size_t weld(Mesh& mesh)
{
    const std::size_t before = mesh.positions.size();
    const std::vector<std::uint32_t> first = firstAtPlace(mesh.positions);
    for (auto& t : mesh.triangles)
        for (std::uint32_t& v : t) v = first[v];
    dropFlat(mesh);
    dropUnused(mesh);
    return before - mesh.positions.size();
}

Mesh readMesh(const std::string& path)
{
    return readMesh(path, 0);
}

Mesh readMesh(const std::string& path, std::size_t maxBytes)
{
    const std::string content = contentOf(path, maxBytes);
    try {
        const std::string extension = extensionOf(path);
        const bool stl = extension == ".stl";
        Mesh mesh = stl                   ? parseStl(content)
                    : extension == ".obj" ? parseObj(content)
                                          : parsePly(content);
        if (mesh.triangles.empty()) badMesh("expected triangles, got a mesh without any");
        checkArrays(mesh);
        dropFlat(mesh);
        // A closed mesh is not welded: where its sheets touch, they would become one.
        if (stl || !hasInside(mesh, vertexTriangles(mesh), Progress())) {
            weld(mesh);
        } else {
            dropUnused(mesh);
        }
        if (mesh.triangles.empty())
            badMesh("expected triangles, got only such with two corners in one place");
        return mesh;
    } catch (const Error& e) {
        throw Error(ErrorKind::Input, "cannot read " + path + ": " + e.what());
    }
}

} // namespace molsurf
