// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/mesh/check_arrays.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/kernel/mesh/topology.h"

#include <cmath>
#include <string>

namespace molsurf
{

namespace
{

[[noreturn]] void refuse(const std::string& what, std::size_t index, const std::string& rest)
{
    throw Error(ErrorKind::Input, what + " " + std::to_string(index) + ": expected " + rest);
}

void checkLength(const std::string& name, std::size_t values, std::size_t vertices)
{
    if (values == vertices) return;
    throw Error(ErrorKind::Input, "attribute '" + name + "': expected " + std::to_string(vertices) +
                                      " values, one a vertex, got " + std::to_string(values));
}

void checkNormals(const Mesh& mesh)
{
    if (mesh.normals.empty()) return;
    checkLength("normal", mesh.normals.size(), mesh.positions.size());
    for (std::size_t v = 0; v < mesh.normals.size(); ++v)
        if (!openvdb::math::isFinite(mesh.normals[v].lengthSqr()))
            refuse("normal", v, "a finite vector");
}

void checkTriangles(const Mesh& mesh)
{
    const std::size_t vertices = mesh.positions.size();
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (const std::uint32_t v : mesh.triangles[i])
            if (v >= vertices)
                refuse("face", i,
                       "vertices below " + std::to_string(vertices) + ", got " +
                           std::to_string(std::int32_t(v)));
    for (std::size_t i = 0; i < mesh.parts.size(); ++i)
        if (mesh.parts[i].firstTriangle > mesh.triangles.size())
            refuse("part", i,
                   "a first triangle up to " + std::to_string(mesh.triangles.size()) + ", got " +
                       std::to_string(mesh.parts[i].firstTriangle));
}

} // namespace

void checkPosition(const openvdb::Vec3d& position, std::size_t vertex)
{
    constexpr double most = 1e6; // [Å]
    for (int a = 0; a < 3; ++a)
        if (!(std::abs(position[a]) < most))
            refuse("vertex", vertex,
                   "a finite position below 1e6 Å, got " + formatted("%.7g", position[a]));
}

void checkArrays(const Mesh& mesh)
{
    const std::size_t vertices = mesh.positions.size();
    for (std::size_t v = 0; v < vertices; ++v) checkPosition(openvdb::Vec3d(mesh.positions[v]), v);
    checkNormals(mesh);
    checkTriangles(mesh);
    for (const auto& scalar : mesh.scalars)
        checkLength(scalar.name, scalar.values.size(), vertices);
    for (const auto& label : mesh.labels) checkLength(label.name, label.values.size(), vertices);
    if (!mesh.colors.empty()) checkLength("color", mesh.colors.size(), vertices);
}

void checkManifold(const Mesh& mesh, const Progress& progress)
{
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto& t = mesh.triangles[i];
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
            refuse("face", i, "three vertices, each another one");
    }
    const Topology found = checkTopology(mesh, progress);
    const char* wrong = !found.closed     ? "edges that do not have two triangles"
                        : !found.oriented ? "neighbours that run round in opposite ways"
                        : !found.manifold ? "vertices where sheets meet"
                                          : nullptr;
    if (wrong)
        throw Error(ErrorKind::Input,
                    std::string("faces: expected a closed, oriented manifold, got ") + wrong);
}

} // namespace molsurf
