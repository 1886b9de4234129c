// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/mesh/patch_gradients.h"

#include "molsurf/kernel/mesh/check_arrays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

/// Six points of a triangle with weights, exact for polynomials of degree 4: see measure.cpp.
constexpr double patchRule[2][2] = {{0.445948490915965, 0.223381589678011},
                                    {0.091576213509771, 0.109951743655322}};

using Corners = std::array<std::uint32_t, 3>;

std::uint64_t keyOf(std::uint32_t a, std::uint32_t b)
{
    return std::uint64_t(std::min(a, b)) << 32 | std::max(a, b);
}

/// The edges of a closed, oriented mesh, each once: one of its two triangles runs upward.
std::vector<std::uint64_t> edgesOf(const Mesh& mesh)
{
    std::vector<std::uint64_t> edges;
    edges.reserve(mesh.triangles.size() * 3 / 2);
    for (const Corners& t : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k)
            if (t[k] < t[(k + 1) % 3]) edges.push_back(keyOf(t[k], t[(k + 1) % 3]));
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

/// The values and derivatives of the shape functions of a patch at a point of it: of the corners,
/// then of the midpoints opposite to them.
struct Shapes {
    std::array<double, 6> value, byU, byV;

    explicit Shapes(const std::array<double, 3>& b)
    {
        const std::array<double, 3> u = {-1, 1, 0}, v = {-1, 0, 1}; // derivatives of b
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
            value[k] = b[k] * (2.0 * b[k] - 1.0);
            byU[k] = (4.0 * b[k] - 1.0) * u[k];
            byV[k] = (4.0 * b[k] - 1.0) * v[k];
            value[3 + k] = 4.0 * b[i] * b[j];
            byU[3 + k] = 4.0 * (u[i] * b[j] + b[i] * u[j]);
            byV[3 + k] = 4.0 * (v[i] * b[j] + b[i] * v[j]);
        }
    }
};

/// Adds the derivatives of a patch at one point of the rule. On a closed mesh those of the volume
/// add up to the integral of a shape function times the normal.
void addPoint(const std::array<std::size_t, 6>& nodes, const Shapes& shapes, double weight,
              PatchNodes& out)
{
    Vec3d u(0.0), v(0.0);
    for (std::size_t k = 0; k < 6; ++k) {
        u += shapes.byU[k] * out.points[nodes[k]];
        v += shapes.byV[k] * out.points[nodes[k]];
    }
    const Vec3d across = u.cross(v);
    const double length = across.length();
    const Vec3d n = length > 0.0 ? across / length : Vec3d(0.0);
    const Vec3d ofU = v.cross(n), ofV = n.cross(u);
    for (std::size_t k = 0; k < 6; ++k) {
        out.volume[nodes[k]] += 0.5 * weight * shapes.value[k] * across;
        out.area[nodes[k]] += 0.5 * weight * (shapes.byU[k] * ofU + shapes.byV[k] * ofV);
    }
}

} // namespace

PatchNodes patchNodes(const Mesh& mesh, const Progress& progress)
{
    checkManifold(mesh, progress);
    const std::vector<std::uint64_t> edges = edgesOf(mesh);
    const std::size_t vertices = mesh.positions.size();
    PatchNodes out;
    out.points.assign(mesh.positions.begin(), mesh.positions.end());
    out.normals.assign(mesh.normals.begin(), mesh.normals.end());
    for (const std::uint64_t edge : edges) {
        const Vec3d &p = out.points[edge >> 32], &q = out.points[edge & 0xffffffff];
        const Vec3d m = out.normals[edge >> 32], n = out.normals[edge & 0xffffffff];
        const Vec3d mid = 0.5 * (p + q) + 0.125 * ((q - p).dot(n) * n - (q - p).dot(m) * m);
        const Vec3d mean = m + n;
        out.points.push_back(mid);
        out.normals.push_back(mean.length() > 0.1 ? mean.unit() : m);
    }
    out.volume.assign(out.points.size(), Vec3d(0.0));
    out.area.assign(out.points.size(), Vec3d(0.0));
    std::vector<std::pair<Shapes, double>> points;
    for (const auto& [equal, weight] : patchRule) {
        for (std::size_t k = 0; k < 3; ++k) {
            std::array<double, 3> b = {equal, equal, equal};
            b[k] = 1.0 - 2.0 * equal;
            points.emplace_back(Shapes(b), weight);
        }
    }
    for (const Corners& t : mesh.triangles) {
        std::array<std::size_t, 6> nodes{t[0], t[1], t[2]};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint64_t key = keyOf(t[(k + 1) % 3], t[(k + 2) % 3]);
            const auto found = std::lower_bound(edges.begin(), edges.end(), key);
            nodes[3 + k] = vertices + std::size_t(found - edges.begin());
        }
        for (const auto& [shapes, weight] : points) addPoint(nodes, shapes, weight, out);
    }
    return out;
}

} // namespace molsurf
