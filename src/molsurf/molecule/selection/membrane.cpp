// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/membrane.h"

#include "molsurf/molecule/structure/residue_names.h"

#include <openvdb/math/Mat3.h>

#include <vector>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

/// The middle of some points.
struct Middle {
    Vec3d sum{0.0};
    std::size_t count = 0;

    void add(const Vec3d& x)
    {
        sum += x;
        ++count;
    }
    Vec3d at() const { return sum / double(count); }
};

/// From the plane N to the plane O of dummy atoms.
std::optional<Vec3d> normalOfDummies(const Structure& structure, const Model& model)
{
    constexpr double thinnest = 10.0; // [Å]
    Middle inner, outer;
    for (std::size_t i = model.begin; i < model.end; ++i) {
        const Atom& atom = structure.atoms[i];
        if (residueOf(structure, atom).name != "DUM") continue;
        if (atom.name == "N") inner.add(atom.position);
        if (atom.name == "O") outer.add(atom.position);
    }
    if (inner.count == 0 || outer.count == 0) return {};
    const Vec3d way = outer.at() - inner.at();
    if (way.length() < thinnest) return {};
    return way.unit();
}

bool isLipid(const Residue& residue)
{
    const NameClass name = nameClass(residue.name);
    return name == NameClass::Lipid || name == NameClass::LongLipid || name == NameClass::CutLipid;
}

/// The ways of lipids from their phosphorus to their middle.
std::vector<Vec3d> lipidWays(const Structure& structure, const Model& model)
{
    std::vector<Vec3d> ways;
    for (std::size_t i = model.begin; i < model.end;) {
        const std::int32_t residue = structure.atoms[i].residue;
        Middle all, head;
        for (; i < model.end && structure.atoms[i].residue == residue; ++i) {
            const Atom& atom = structure.atoms[i];
            all.add(atom.position);
            if (atom.name == "P" || atom.name == "PO4") head.add(atom.position);
        }
        if (head.count != 1 || !isLipid(structure.residues[std::size_t(residue)])) continue;
        const Vec3d way = all.at() - head.at();
        if (way.lengthSqr() > 0.0) ways.push_back(way.unit());
    }
    return ways;
}

/// The direction along which lipids lie: the principal axis of the mean of n n^T over their ways n.
std::optional<Vec3d> normalOfLipids(const Structure& structure, const Model& model)
{
    constexpr std::size_t fewest = 16; // lipids
    constexpr double ordered = 0.5;    // mean square of cosines, a third for all directions
    const std::vector<Vec3d> ways = lipidWays(structure, model);
    if (ways.size() < fewest) return {};
    openvdb::Mat3d tensor = openvdb::Mat3d::zero(), vectors;
    for (const Vec3d& way : ways)
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) tensor(i, j) += way[i] * way[j] / double(ways.size());
    Vec3d values;
    if (!openvdb::math::diagonalizeSymmetricMatrix(tensor, vectors, values)) return {};
    const auto most = int(openvdb::math::MaxIndex(values));
    if (values[most] < ordered) return {};
    const Vec3d normal(vectors(0, most), vectors(1, most), vectors(2, most));
    return normal.unit() * (normal[2] < 0.0 ? -1.0 : 1.0);
}

} // namespace

std::optional<Vec3d> membraneNormal(const Structure& structure, const Model& model)
{
    const std::optional<Vec3d> normal = normalOfDummies(structure, model);
    return normal ? normal : normalOfLipids(structure, model);
}

} // namespace molsurf
