// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/usda_mesh.h"

#include "molsurf/show/color/color_map.h"

#include <algorithm>
#include <array>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

using Scalars = Attribute<float>;

const Scalars* scalarsOf(const Mesh& mesh, const std::string& name)
{
    const auto found = std::find_if(mesh.scalars.begin(), mesh.scalars.end(),
                                    [&](const Scalars& s) { return s.name == name; });
    return found == mesh.scalars.end() ? nullptr : &*found;
}

std::array<const Scalars*, 3> velocityOf(const Mesh& mesh)
{
    return {scalarsOf(mesh, "v_x"), scalarsOf(mesh, "v_y"), scalarsOf(mesh, "v_z")};
}

class Properties
{
public:
    Properties(TextOutput& out, const UsdaMesh& what)
        : out_(out), what_(what), first_(what.range.firstVertex),
          vertices_(what.range.vertexEnd - first_)
    {
    }

    /// A property, with one call of `put` for each element.
    template<typename Put>
    void array(const std::string& name, std::size_t count, const Put& put, bool byVertex = false)
    {
        const std::string& in = what_.indent;
        const std::string meta =
            byVertex ? " (\n" + in + "    interpolation = \"vertex\"\n" + in + ")\n" : "\n";
        out_ << in;
        if (what_.declared) {
            out_ << name << meta;
        } else if (!what_.time) {
            putArray(out_, name, count, put);
            out_ << meta;
        } else {
            if (byVertex) out_ << name << meta << in;
            out_ << name << ".timeSamples = {\n" << in << "    " << *what_.time << ": ";
            putList(out_, count, put);
            out_ << ",\n" << in << "}\n";
        }
    }

    /// A property of vertices; put(v) gets indices into the mesh.
    template<typename Put>
    void ofVertices(const std::string& name, const Put& put, bool byVertex)
    {
        array(
            name, vertices_, [&](std::size_t v) { put(first_ + v); }, byVertex);
    }

private:
    TextOutput& out_;
    const UsdaMesh& what_;
    std::size_t first_, vertices_;
};

} // namespace

openvdb::BBoxd boxOf(const Mesh& mesh, const PartRange& range)
{
    openvdb::BBoxd box;
    for (std::size_t v = range.firstVertex; v < range.vertexEnd; ++v)
        box.expand(Vec3d(mesh.positions[v]));
    return box.empty() ? openvdb::BBoxd(Vec3d(0.0), Vec3d(0.0)) : box;
}

void putUsdaMesh(TextOutput& out, const UsdaMesh& what)
{
    const Mesh& mesh = what.mesh;
    const PartRange& range = what.range;
    const openvdb::BBoxd box = boxOf(mesh, range);
    const std::size_t triangles = range.triangleEnd - range.firstTriangle;
    Properties to(out, what);
    to.array("float3[] extent", 2, [&](std::size_t i) {
        putTuple(out, (i == 0 ? box.min() : box.max()) - what.origin, 3, usdaLengthDigits);
    });
    to.array("int[] faceVertexCounts", triangles, [&](std::size_t) { out << "3"; });
    to.array("int[] faceVertexIndices", 3 * triangles, [&](std::size_t i) {
        out << mesh.triangles[range.firstTriangle + i / 3][i % 3] - range.firstVertex;
    });
    to.ofVertices(
        "point3f[] points",
        [&](std::size_t v) {
            putTuple(out, Vec3d(mesh.positions[v]) - what.origin, 3, usdaLengthDigits);
        },
        false);
    to.ofVertices(
        "normal3f[] normals",
        [&](std::size_t v) { putTuple(out, mesh.normals[v], 3, usdaDirectionDigits); }, true);
    const auto velocity = velocityOf(mesh);
    if (velocity[0] && velocity[1] && velocity[2])
        to.ofVertices(
            "vector3f[] velocities",
            [&](std::size_t v) {
                Vec3d way;
                for (int axis = 0; axis < 3; ++axis)
                    way[axis] = what.velocityFactor * velocity[std::size_t(axis)]->values[v];
                putTuple(out, way, 3, usdaLengthDigits);
            },
            false);
    if (!mesh.colors.empty())
        to.ofVertices(
            "color3f[] primvars:displayColor",
            [&](std::size_t v) {
                putTuple(out, linearLight(mesh.colors[v]), 3, usdaDirectionDigits);
            },
            true);
    for (const Scalars& scalars : mesh.scalars)
        if (std::count(what.fields.begin(), what.fields.end(), scalars.name) > 0)
            to.ofVertices(
                "float[] primvars:" + usdaIdentifier(scalars.name),
                [&](std::size_t v) { out << scalars.values[v]; }, true);
    out << what.indent << "uniform token subdivisionScheme = \"none\"\n";
}

} // namespace molsurf
