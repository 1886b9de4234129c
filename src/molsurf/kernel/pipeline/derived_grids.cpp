// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/pipeline/derived_grids.h"

#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/grid/grid_like.h"
#include "molsurf/kernel/spline/curvature.h"

#include <openvdb/tools/LevelSetUtil.h>
#include <openvdb/tree/LeafManager.h>

#include <algorithm>

namespace molsurf
{

bool hasField(const std::vector<std::string>& fields, const std::string& name)
{
    return std::find(fields.begin(), fields.end(), name) != fields.end();
}

using openvdb::Coord;
using openvdb::Vec3d;

openvdb::FloatGrid::Ptr splineGrid(const Spline& spline)
{
    auto grid = openvdb::FloatGrid::create(0.0f);
    grid->setTransform(openvdb::math::Transform::createLinearTransform(spline.voxelSize()));
    grid->setName("spline");
    using Leaf = openvdb::FloatTree::LeafNodeType;
    for (std::size_t n = 0; n < spline.table().size(); ++n) {
        const LeafMask& active = spline.table().active(n);
        if (!active.any()) continue;
        auto* leaf = new Leaf(spline.table().origin(n), 0.0f);
        active.forEach(
            [&](int v) { leaf->setValueOn(openvdb::Index(v), spline.coefficients.leaf(n)[v]); });
        grid->tree().addLeaf(leaf);
    }
    return grid;
}

openvdb::FloatGrid::Ptr densityGrid(const openvdb::FloatGrid& surface)
{
    auto fog = surface.deepCopy();
    openvdb::tools::sdfToFogVolume(*fog);
    fog->setName("density");
    return fog;
}

namespace
{

/// How far a voxel of the band may be from the surface [voxel].
constexpr double reachVox = 4.0;

} // namespace

std::vector<openvdb::GridBase::Ptr> curvatureGrids(const openvdb::FloatGrid& surface,
                                                   const Spline& spline,
                                                   const std::vector<std::string>& names,
                                                   const Progress& progress)
{
    struct Target {
        const CurvatureField* field;
        openvdb::FloatGrid::Ptr scalars; // one of the two
        openvdb::Vec3SGrid::Ptr vectors;
        std::vector<float*> leaves; // values of each leaf, a vector's three together
    };
    std::vector<Target> targets;
    std::vector<openvdb::GridBase::Ptr> grids;
    for (const std::string& name : names) {
        const CurvatureField* field = findCurvatureField(name);
        if (!field) continue;
        Target target{field, nullptr, nullptr, {}};
        if (field->components == 1) {
            target.scalars = gridLike<openvdb::FloatGrid>(surface, name, 0.0f);
            for (auto leaf = target.scalars->tree().beginLeaf(); leaf; ++leaf)
                target.leaves.push_back(leaf->buffer().data());
            grids.push_back(target.scalars);
        } else {
            target.vectors = gridLike<openvdb::Vec3SGrid>(surface, name, openvdb::Vec3f(0.0f));
            target.vectors->setVectorType(openvdb::VEC_CONTRAVARIANT_RELATIVE);
            for (auto leaf = target.vectors->tree().beginLeaf(); leaf; ++leaf)
                target.leaves.push_back(leaf->buffer().data()->asPointer());
            grids.push_back(target.vectors);
        }
        targets.push_back(std::move(target));
    }
    if (targets.empty()) return grids;

    // All grids have the leaves of `surface`, in the same order.
    const double h = surface.voxelSize()[0];
    openvdb::tree::LeafManager<const openvdb::FloatTree> leaves(surface.tree());
    parallelFor(leaves.leafCount(), progress, [&](std::size_t n) {
        SplineSampler sampler(spline);
        for (auto it = leaves.leaf(n).cbeginValueOn(); it; ++it) {
            Vec3d x = surface.indexToWorld(it.getCoord());
            Jet jet;
            if (!moveToSurface(sampler, h, reachVox, x, jet)) {
                x = surface.indexToWorld(it.getCoord());
                jet = sampler.at(x);
            }
            const Curvature k = curvature(jet);
            for (const Target& t : targets)
                t.field->value(k, t.leaves[n] + t.field->components * it.pos());
        }
    });
    return grids;
}

void saveAsHalf(const openvdb::GridPtrVec& grids)
{
    for (const auto& grid : grids)
        if (grid->getName().rfind("value", 0) != 0) grid->setSaveFloatAsHalf(true);
}

} // namespace molsurf
