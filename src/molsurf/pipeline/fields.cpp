// SPDX-License-Identifier: MPL-2.0
#include "molsurf/pipeline/fields.h"

#include "molsurf/bspline/curvature.h"
#include "molsurf/core/parallel.h"
#include "molsurf/rasterize/nearest_ball.h"

#include <openvdb/tree/LeafManager.h>

namespace molsurf
{

using openvdb::Coord;
using openvdb::Vec3d;

const std::vector<std::string>& fieldNames()
{
    static const std::vector<std::string> names = {"sas", "spline", "mean_curvature",
                                                   "gaussian_curvature", "atom_id"};
    return names;
}

openvdb::FloatGrid::Ptr splineGrid(const Spline& spline)
{
    auto grid = openvdb::FloatGrid::create(0.0f);
    grid->setTransform(openvdb::math::Transform::createLinearTransform(spline.voxel));
    grid->setName("spline");
    using Leaf = openvdb::FloatTree::LeafNodeType;
    for (std::size_t n = 0; n < spline.table.size(); ++n) {
        const LeafMask& active = spline.table.active(n);
        if (!active.any()) continue;
        auto* leaf = new Leaf(spline.table.origin(n), 0.0f);
        active.forEach(
            [&](int v) { leaf->setValueOn(openvdb::Index(v), spline.coefficients.leaf(n)[v]); });
        grid->tree().addLeaf(leaf);
    }
    return grid;
}

openvdb::FloatGrid::Ptr curvatureGrid(const openvdb::FloatGrid& surface, const Spline& spline,
                                      bool gaussian, const Progress& progress)
{
    auto grid = openvdb::FloatGrid::create(0.0f);
    grid->setTree(
        std::make_shared<openvdb::FloatTree>(surface.tree(), 0.0f, openvdb::TopologyCopy()));
    grid->setTransform(surface.transform().copy());
    grid->setName(gaussian ? "gaussian_curvature" : "mean_curvature");
    openvdb::tree::LeafManager<openvdb::FloatTree> leaves(grid->tree());
    parallelFor(leaves.leafCount(), progress, [&](std::size_t n) {
        SplineSampler sampler(spline);
        for (auto it = leaves.leaf(n).beginValueOn(); it; ++it) {
            const Jet jet = sampler.at(surface.indexToWorld(it.getCoord()));
            if (jet.gradient.lengthSqr() < 1e-6) continue;
            it.setValue(float(gaussian ? gaussianCurvature(jet) : meanCurvature(jet)));
        }
    });
    return grid;
}

openvdb::Int32Grid::Ptr atomGrid(const openvdb::FloatGrid& surface, const std::vector<Ball>& balls,
                                 double reach, const Progress& progress)
{
    auto grid = openvdb::Int32Grid::create(-1);
    grid->setTree(
        std::make_shared<openvdb::Int32Tree>(surface.tree(), -1, openvdb::TopologyCopy()));
    grid->setTransform(surface.transform().copy());
    grid->setName("atom_id");
    std::vector<openvdb::Vec3f> points;
    for (auto it = grid->cbeginValueOn(); it; ++it) {
        points.emplace_back(surface.indexToWorld(it.getCoord()));
    }
    const std::vector<std::int32_t> nearest = nearestBalls(balls, points, reach, progress);
    std::size_t i = 0;
    for (auto it = grid->beginValueOn(); it; ++it, ++i) {
        it.setValue(nearest[i] < 0 ? -1 : balls[nearest[i]].atom);
    }
    return grid;
}

} // namespace molsurf
