// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/unit_mesh.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/cancel.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/mesh/topology.h"
#include "molsurf/show/io/part_ranges.h"
#include "molsurf/surface/unit_border.h"

#include <algorithm>
#include <numeric>

namespace molsurf
{

using openvdb::Vec3d;
using openvdb::Vec3f;

namespace
{

/// The number in the whole of each vertex of each unit: that of unit k and vertex v at
/// k * vertices + v. New numbers ascend in this order. A shared vertex takes that of the first unit
/// and place that are the same vertex.
/// @param[out] count  of the vertices of the whole
std::vector<std::uint32_t> vertexNumbers(const Placement::Unit& unit,
                                         const std::vector<MolecularSurface::SharedVertex>& shared,
                                         std::size_t vertices, std::size_t& count)
{
    const std::size_t order = unit.inverse.size();
    BorderClasses classes(unit, shared, vertices);
    const std::vector<std::uint32_t>& border = classes.border();
    std::vector<std::uint32_t> out(order * vertices);
    count = 0;
    for (std::size_t k = 0; k < order; ++k) {
        for (std::size_t v = 0; v < vertices; ++v) {
            std::uint32_t& number = out[k * vertices + v];
            number = std::uint32_t(count);
            if (const std::int32_t place = classes.placeOf(std::uint32_t(v)); place >= 0) {
                const std::size_t first = classes.firstOf(k, place);
                if (first != k * border.size() + std::size_t(place)) {
                    number = out[first / border.size() * vertices + border[first % border.size()]];
                    continue;
                }
            }
            ++count;
        }
    }
    return out;
}

/// Turns the columns that are components of vectors: their names end in _x, _y and _z.
void turnVectors(const Instance& motion, std::vector<Attribute<float>>& scalars, std::size_t begin,
                 std::size_t end)
{
    for (std::size_t a = 0; a + 2 < scalars.size(); ++a) {
        const auto ends = [&](std::size_t i, const char* with) {
            const std::string& name = scalars[i].name;
            return name.size() > 2 && name.compare(name.size() - 2, 2, with) == 0;
        };
        if (!ends(a, "_x") || !ends(a + 1, "_y") || !ends(a + 2, "_z")) continue;
        for (std::size_t v = begin; v < end; ++v) {
            const Vec3d turned = motion.turned(
                Vec3d(scalars[a].values[v], scalars[a + 1].values[v], scalars[a + 2].values[v]));
            for (std::size_t i = 0; i < 3; ++i) scalars[a + i].values[v] = float(turned[int(i)]);
        }
    }
}

/// Appends a part of a mesh, moved, as a part of another.
void addCopy(const Mesh& mesh, const PartRange& range, const Instance& motion, Mesh& out)
{
    const std::size_t begin = out.positions.size();
    if (begin + range.vertexEnd - range.firstVertex > 0xffffffffu)
        throw Error(ErrorKind::Output, "the mesh of all copies has more vertices than 32 bits "
                                       "count [hint: a larger `voxel`]");
    appendPart(mesh, range, out);
    std::string& name = out.parts.back().name;
    name += (name.empty() ? "" : " ") + motion.name;
    for (std::size_t v = begin; v < out.positions.size(); ++v)
        out.positions[v] = Vec3f(motion.placed(Vec3d(out.positions[v])));
    for (std::size_t v = begin; v < out.normals.size(); ++v)
        out.normals[v] = Vec3f(motion.turned(Vec3d(out.normals[v])));
    turnVectors(motion, out.scalars, begin, out.positions.size());
}

} // namespace

Mesh wholeMesh(const BallSet& atoms, const MolecularSurface& surface, const Mesh& unit, bool weld,
               const std::vector<std::array<std::uint8_t, 3>>& colors, const Progress& progress)
{
    const Placement& placement = atoms.placement;
    const std::size_t order = placement.order(), vertices = unit.positions.size();
    if (order * vertices > 0xffffffffu)
        throw Error(ErrorKind::Output, "the mesh of the whole has more vertices than 32 bits count "
                                       "[hint: a .glb file holds the unit once]");
    std::size_t count = order * vertices;
    std::vector<std::uint32_t> numbers;
    if (weld) numbers = vertexNumbers(*placement.unit, surface.shared, vertices, count);

    Mesh out; // welded: a vertex is new if its number is the count of those before
    const auto repeat = [&](auto& to, const auto& from) {
        to.reserve(count);
        for (std::size_t k = 0; k < order; ++k) {
            for (std::size_t v = 0; v < from.size(); ++v)
                if (!weld || numbers[k * vertices + v] == to.size()) to.push_back(from[v]);
        }
    };
    repeat(out.positions, unit.positions);
    repeat(out.normals, unit.normals);
    for (const auto& a : unit.scalars) repeat(out.scalars.emplace_back().values, a.values);
    for (const auto& a : unit.labels) repeat(out.labels.emplace_back().values, a.values);
    for (std::size_t i = 0; i < unit.scalars.size(); ++i)
        out.scalars[i].name = unit.scalars[i].name;
    for (std::size_t i = 0; i < unit.labels.size(); ++i) out.labels[i].name = unit.labels[i].name;
    if (colors.empty()) repeat(out.colors, unit.colors);

    std::size_t first = 0; // vertex of unit k
    for (std::size_t k = 0; k < order; ++k) {
        const Instance& motion = placement.instances[k];
        std::size_t last = first;
        for (std::size_t v = 0; v < vertices; ++v)
            last += !weld || numbers[k * vertices + v] == last;
        parallelFor(last - first, progress, [&](std::size_t i) {
            const std::size_t v = first + i;
            out.positions[v] = Vec3f(motion.placed(Vec3d(out.positions[v])));
            out.normals[v] = Vec3f(motion.turned(Vec3d(out.normals[v])));
        });
        turnVectors(motion, out.scalars, first, last);
        if (!colors.empty()) out.colors.insert(out.colors.end(), last - first, colors[k]);
        first = last;
        if (!weld) out.parts.push_back({"unit " + motion.name, out.triangles.size()});
        for (const auto& t : unit.triangles) {
            auto& corners = out.triangles.emplace_back();
            for (std::size_t c = 0; c < 3; ++c) {
                const std::size_t v = k * vertices + t[c];
                corners[c] = weld ? numbers[v] : std::uint32_t(v);
            }
        }
    }
    if (weld && surface.report.surface.closed && !checkTopology(out, progress).closed)
        throw Error(ErrorKind::Check, "the units' meshes do not close when they are welded");
    return out;
}

std::vector<std::size_t> partsOfCopy(const Placement& placement, const Mesh& mesh,
                                     const Instance& copy)
{
    if (placement.prototypes() > 1) return {copy.part};
    std::vector<std::size_t> parts(std::max<std::size_t>(mesh.parts.size(), 1));
    std::iota(parts.begin(), parts.end(), std::size_t{0});
    return parts;
}

Mesh meshOfWhole(const BallSet& atoms, const MolecularSurface& surface, const Progress& progress)
{
    if (atoms.placement.unit) return wholeMesh(atoms, surface, surface.mesh, true, {}, progress);
    Mesh out;
    for (const auto& a : surface.mesh.scalars) out.scalars.push_back({a.name, {}});
    for (const auto& a : surface.mesh.labels) out.labels.push_back({a.name, {}});
    const std::vector<PartRange> parts = partRanges(surface.mesh, "");
    for (const Instance& copy : atoms.placement.instances) {
        stopIfCancelled(progress);
        for (const std::size_t part : partsOfCopy(atoms.placement, surface.mesh, copy))
            addCopy(surface.mesh, parts.at(part), copy, out);
    }
    return out;
}

} // namespace molsurf
