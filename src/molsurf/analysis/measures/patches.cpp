// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/measures/patches.h"

#include "molsurf/analysis/measures/lining.h"
#include "molsurf/kernel/core/disjoint_sets.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <tuple>

namespace molsurf
{

namespace
{

using MeshPatch = Report::Patches::Patch;
using openvdb::Vec3d;

/// The corner cut off a triangle by a line across the two edges at it: the barycentric integrals.
/// @param[in] s,t  where the line crosses the edges to the next corners, by their lengths
std::array<double, 3> cornerShares(std::size_t k, double s, double t)
{
    // The area is s t of the triangle's, and the middle the mean of the three corners.
    std::array<double, 3> out;
    out[k] = s * t * (3.0 - s - t) / 3.0;
    out[(k + 1) % 3] = s * t * s / 3.0;
    out[(k + 2) % 3] = s * t * t / 3.0;
    return out;
}

/// The value as it is or with its sign turned, so that patches are where it is above the level.
class Beyond
{
public:
    Beyond(const std::vector<float>& values, const Products::PatchRule& rule)
        : values_(values), sign_(rule.above ? 1.0 : -1.0), level_(sign_ * rule.level)
    {
    }

    double value(std::uint32_t v) const { return sign_ * double(values_[v]); }
    double level() const { return level_; }
    bool contains(std::uint32_t v) const { return value(v) > level_; }

    /// Whether all corners of a triangle have a value.
    bool isKnown(const std::array<std::uint32_t, 3>& t) const
    {
        return std::isfinite(values_[t[0]]) && std::isfinite(values_[t[1]]) &&
               std::isfinite(values_[t[2]]);
    }

private:
    const std::vector<float>& values_;
    double sign_, level_;
};

/// The connected piece of each vertex beyond the level: two are connected along an edge, since a
/// linear value is beyond it between them, too; and what a triangle has beyond it is one piece.
std::vector<std::uint32_t> piecesOf(const Mesh& mesh, const Beyond& beyond, std::size_t& count)
{
    DisjointSets sets(mesh.positions.size());
    for (const auto& t : mesh.triangles) {
        if (!beyond.isKnown(t)) continue;
        for (std::size_t k = 0; k < 3; ++k)
            if (beyond.contains(t[k]) && beyond.contains(t[(k + 1) % 3]))
                sets.join(t[k], t[(k + 1) % 3]);
    }
    return sets.numbers(count);
}

/// The part of a patch that a ball has on one triangle.
struct BallPart {
    std::uint32_t piece;
    std::int32_t ball;
    double area;
};

/// Adds the parts up by ball.
void addParts(std::vector<BallPart> parts, std::vector<MeshPatch>& patches)
{
    std::stable_sort(parts.begin(), parts.end(), [](const BallPart& a, const BallPart& b) {
        return std::tie(a.piece, a.ball) < std::tie(b.piece, b.ball);
    });
    for (const BallPart& part : parts) {
        auto& list = patches[part.piece].parts;
        const auto ball = std::size_t(part.ball);
        if (list.empty() || list.back().ball != ball) list.push_back({ball, 0.0});
        list.back().area += part.area;
    }
}

/// The patch of every piece; those of vertices that are not beyond the level have no area.
std::vector<MeshPatch> measured(const Mesh& mesh, const Beyond& beyond,
                                const std::vector<float>& values,
                                const std::vector<std::uint32_t>& pieces, std::size_t count,
                                const std::vector<std::int32_t>& nearest)
{
    std::vector<MeshPatch> patches(count);
    std::vector<BallPart> parts;
    for (const auto& t : mesh.triangles) {
        const auto in =
            std::find_if(t.begin(), t.end(), [&](std::uint32_t v) { return beyond.contains(v); });
        if (in == t.end() || !beyond.isKnown(t)) continue;
        MeshPatch& patch = patches[pieces[*in]];
        const auto corner = [&](std::size_t k) { return Vec3d(mesh.positions[t[k]]); };
        const double area = 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).length();
        const std::array<double, 3> shares = sharesAbove(
            {beyond.value(t[0]), beyond.value(t[1]), beyond.value(t[2])}, beyond.level());
        for (std::size_t k = 0; k < 3; ++k) {
            const double part = area * shares[k];
            patch.area += part;
            patch.integral += part * double(values[t[k]]);
            for (int axis = 0; axis < 3; ++axis)
                patch.centre[std::size_t(axis)] += part * corner(k)[axis];
            if (part > 0.0 && nearest[t[k]] >= 0)
                parts.push_back({pieces[*in], nearest[t[k]], part});
        }
    }
    addParts(std::move(parts), patches);
    for (MeshPatch& patch : patches)
        for (double& x : patch.centre) x /= patch.area;
    return patches;
}

/// How many residues the parts are of.
std::int64_t residuesOf(const BallSet& atoms, const MeshPatch& patch)
{
    std::set<std::int32_t> seen;
    if (atoms.names)
        for (const auto& part : patch.parts) seen.insert(atoms.names->residueOf[part.ball]);
    return std::int64_t(seen.size());
}

} // namespace

std::array<double, 3> sharesAbove(const std::array<double, 3>& v, double level)
{
    const std::array<bool, 3> in = {v[0] > level, v[1] > level, v[2] > level};
    const auto count = std::count(in.begin(), in.end(), true);
    constexpr double whole = 1.0 / 3.0;
    if (count == 0) return {0.0, 0.0, 0.0};
    if (count == 3) return {whole, whole, whole};
    // The corner that is alone on its side of the level is cut off.
    const auto alone = std::size_t(std::find(in.begin(), in.end(), count == 1) - in.begin());
    const double s = (v[alone] - level) / (v[alone] - v[(alone + 1) % 3]);
    const double t = (v[alone] - level) / (v[alone] - v[(alone + 2) % 3]);
    std::array<double, 3> out = cornerShares(alone, s, t);
    if (count == 2)
        for (double& share : out) share = whole - share;
    return out;
}

FoundPatches findPatches(const Mesh& mesh, const std::vector<float>& values,
                         const Products::PatchRule& rule, const std::vector<std::int32_t>& nearest)
{
    const Beyond beyond(values, rule);
    std::size_t count = 0;
    const std::vector<std::uint32_t> pieces = piecesOf(mesh, beyond, count);
    std::vector<MeshPatch> all = measured(mesh, beyond, values, pieces, count, nearest);
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    order.erase(std::remove_if(order.begin(), order.end(),
                               [&](std::uint32_t p) { return !(all[p].area > 0.0); }),
                order.end());
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return all[a].area > all[b].area; });
    FoundPatches out;
    std::vector<std::int32_t> numbers(count, 0);
    for (const std::uint32_t p : order) {
        out.list.push_back(std::move(all[p]));
        numbers[p] = std::int32_t(out.list.size());
    }
    for (const std::uint32_t piece : pieces) out.patchOf.push_back(numbers[piece]);
    return out;
}

Table Report::Patches::table(const BallSet& atoms) const
{
    constexpr std::size_t count = 6;
    const std::array<const char*, count> titles = {"area", "mean", "integral_A2",
                                                   "x_A",  "y_A",  "z_A"};
    std::array<std::vector<double>, count> numbers;
    std::vector<std::int64_t> number, atomCount, residueCount;
    std::vector<std::string> residues, ids;
    for (const MeshPatch& patch : list) {
        const std::array<double, count> row = {patch.area,      patch.integral / patch.area,
                                               patch.integral,  patch.centre[0],
                                               patch.centre[1], patch.centre[2]};
        for (std::size_t k = 0; k < count; ++k) numbers[k].push_back(row[k]);
        number.push_back(std::int64_t(number.size()) + 1);
        atomCount.push_back(std::int64_t(patch.parts.size()));
        residueCount.push_back(residuesOf(atoms, patch));
        std::vector<std::pair<std::size_t, double>> parts;
        for (const auto& part : patch.parts) parts.emplace_back(part.ball, part.area);
        const Lining names = liningOf(atoms, parts);
        residues.push_back(names.residues);
        ids.push_back(names.atoms);
    }
    Table table{"patches", {{"patch", std::move(number)}}};
    for (std::size_t k = 0; k < count; ++k)
        table.columns.push_back({titles[k], std::move(numbers[k])});
    table.columns.push_back({"atoms", std::move(atomCount)});
    table.columns.push_back({"residue_count", std::move(residueCount)});
    table.columns.push_back({"residues", std::move(residues)});
    table.columns.push_back({"atom_ids", std::move(ids)});
    const std::string side = above ? "above" : "below";
    table.columns.push_back({"value", std::vector<std::string>(list.size(), value)});
    table.columns.push_back({"side", std::vector<std::string>(list.size(), side)});
    table.columns.push_back({"level", std::vector<double>(list.size(), level)});
    return table;
}

} // namespace molsurf
