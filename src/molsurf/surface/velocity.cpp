// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/velocity.h"

#include "molsurf/kernel/balls/nearest_ball.h"
#include "molsurf/kernel/grid/grid_like.h"
#include "molsurf/kernel/pipeline/influence.h"
#include "molsurf/show/color/label.h"
#include "molsurf/surface/field_table.h"

#include <openvdb/tools/Morphology.h>

#include <algorithm>
#include <cmath>

namespace molsurf
{

using openvdb::Vec3f;

namespace
{

Vec3f wayOf(std::int32_t ball, const std::vector<Vec3f>& displacement, double factor)
{
    return ball < 0 ? Vec3f(0.0f) : displacement[std::size_t(ball)] * float(factor);
}

double longestWay(const std::vector<Vec3f>& displacement)
{
    float longest = 0.0f;
    for (const Vec3f& way : displacement) longest = std::max(longest, way.length());
    return std::min(double(longest), farthestVelocity);
}

} // namespace

openvdb::Vec3SGrid::Ptr velocityGrid(const openvdb::FloatGrid& surface, const BallSet& atoms,
                                     const std::vector<Vec3f>& displacement,
                                     const VelocityUnit& unit, const SurfaceOptions& options,
                                     const Progress& progress)
{
    const double way = longestWay(displacement);
    const auto voxels = shownVoxels(surface, hasField(options.fields, "density"));
    openvdb::tools::dilateActiveValues(voxels->tree(), int(std::ceil(way / surface.voxelSize()[0])),
                                       openvdb::tools::NN_FACE_EDGE_VERTEX);
    const double corner = std::sqrt(3.0) * (way + options.voxel); // dilation is by cubes
    const Labels owner =
        ownersOf(*voxels, atoms.balls, Influence(atoms, options).ofLabel() + corner, progress);
    auto grid = gridOf<openvdb::Vec3SGrid>(*voxels, "v", Vec3f(0.0f), [&](std::size_t i) {
        return wayOf(owner[i], displacement, unit.factor);
    });
    grid->setVectorType(openvdb::VEC_CONTRAVARIANT_RELATIVE);
    grid->insertMeta("unit", openvdb::StringMetadata(unit.name));
    if (options.halfFloats) grid->setSaveFloatAsHalf(true);
    return grid;
}

void addVelocity(const BallSet& atoms, const std::vector<Vec3f>& displacement, double factor,
                 const SurfaceOptions& options, const Progress& progress, Mesh& mesh)
{
    const Labels owner =
        nearestBalls(atoms.balls, mesh.positions, Influence(atoms, options).ofLabel(), progress);
    for (int axis = 0; axis < 3; ++axis) {
        Attribute<float> along{std::string("v_") + "xyz" [axis], {}};
        for (const std::int32_t ball : owner)
            along.values.push_back(wayOf(ball, displacement, factor)[axis]);
        mesh.scalars.push_back(std::move(along));
    }
}

} // namespace molsurf
