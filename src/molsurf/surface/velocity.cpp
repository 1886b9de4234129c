// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/velocity.h"

#include "molsurf/balls/nearest_ball.h"
#include "molsurf/grid/grid_like.h"
#include "molsurf/surface/influence.h"

namespace molsurf
{

openvdb::Vec3SGrid::Ptr velocityGrid(const openvdb::FloatGrid& surface, const BallSet& atoms,
                                     const std::vector<openvdb::Vec3f>& displacement,
                                     const SurfaceOptions& options, const Progress& progress)
{
    auto grid = gridLike<openvdb::Vec3SGrid>(surface, "v", openvdb::Vec3f(0.0f));
    grid->setVectorType(openvdb::VEC_CONTRAVARIANT_RELATIVE);
    if (options.halfFloats) grid->setSaveFloatAsHalf(true);
    std::vector<openvdb::Vec3f> points;
    for (auto it = surface.cbeginValueOn(); it; ++it)
        points.emplace_back(surface.indexToWorld(it.getCoord()));
    const std::vector<std::int32_t> owner =
        nearestBalls(atoms.balls, points, Influence(atoms, options).ofLabel(), progress);
    std::size_t i = 0;
    for (auto it = grid->beginValueOn(); it; ++it, ++i)
        if (owner[i] >= 0) it.setValue(displacement[std::size_t(owner[i])]);
    return grid;
}

} // namespace molsurf
