// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/velocity.h"

#include "molsurf/kernel/balls/nearest_ball.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/grid/grid_like.h"
#include "molsurf/kernel/pipeline/influence.h"
#include "molsurf/show/color/label.h"
#include "molsurf/surface/field_table.h"

#include <openvdb/tools/Morphology.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>

namespace molsurf
{

using openvdb::Vec3f;

namespace
{

Vec3f wayOf(std::int32_t ball, const std::vector<Vec3f>& displacement, double factor)
{
    return ball < 0 ? Vec3f(0.0f) : displacement[std::size_t(ball)] * float(factor);
}

/// The length of a way, farthestVelocity at most.
double lengthOf(const Vec3f& way)
{
    return std::min(double(way.length()), farthestVelocity);
}

/// The voxels within the way of its own ball from one of these, without these.
openvdb::BoolGrid::Ptr beyond(const openvdb::BoolGrid& voxels, const Labels& owner,
                              const std::vector<Vec3f>& displacement)
{
    const double h = voxels.voxelSize()[0];
    std::map<int, openvdb::BoolTree, std::greater<int>> byReach; // [voxel], the largest first
    std::size_t next = 0;
    for (auto it = voxels.cbeginValueOn(); it; ++it) {
        const std::int32_t ball = owner[next++];
        if (ball < 0) continue;
        const int reach = int(std::ceil(lengthOf(displacement[std::size_t(ball)]) / h));
        if (reach > 0) byReach[reach].setValueOn(it.getCoord());
    }
    auto out = gridLike<openvdb::BoolGrid>(voxels, "", false);
    out->clear();
    // Those of a long way are dilated, then together with those of the next shorter one: by all of
    // its way in the end.
    for (auto at = byReach.begin(); at != byReach.end(); ++at) {
        const auto shorter = std::next(at);
        const int steps = at->first - (shorter == byReach.end() ? 0 : shorter->first);
        out->tree().topologyUnion(at->second);
        openvdb::tools::dilateActiveValues(out->tree(), steps, openvdb::tools::NN_FACE_EDGE_VERTEX);
    }
    out->tree().topologyDifference(voxels.tree());
    return out;
}

/// How far a voxel that a ball leads so far may lie from its own voxel: dilation is by cubes [Å].
double cornerOf(double way, double voxel)
{
    return std::sqrt(3.0) * (way + voxel);
}

/// The balls of voxels about the band. Those that no ball reaches by a short way belong to the
/// nearest of the balls with longer ones, if these are few: a search among all would go far.
/// @param[in] near  how far from its ball a voxel of the band may lie [Å]
Labels ownersAround(const openvdb::BoolGrid& voxels, const std::vector<Ball>& balls,
                    const std::vector<Vec3f>& displacement, double near, const Progress& progress)
{
    constexpr std::size_t few = 64;
    constexpr double shortWay = 1.0; // [Å]
    const double h = voxels.voxelSize()[0];
    std::vector<std::int32_t> movers;
    double longest = 0.0;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const double way = lengthOf(displacement[i]);
        longest = std::max(longest, way);
        if (way > shortWay) movers.push_back(std::int32_t(i));
    }
    const double reach = near + cornerOf(longest, h);
    if (movers.size() > few) return ownersOf(voxels, balls, reach, progress);
    const double byShort = near + cornerOf(shortWay, h);
    Labels out = ownersOf(voxels, balls, std::min(byShort, reach), progress);
    std::vector<std::size_t> far;
    std::vector<openvdb::Vec3d> places;
    std::size_t next = 0;
    for (auto it = voxels.cbeginValueOn(); it; ++it, ++next) {
        if (out[next] >= 0) continue;
        far.push_back(next);
        places.push_back(voxels.indexToWorld(it.getCoord()));
    }
    parallelFor(far.size(), progress, [&](std::size_t k) {
        double least = reach;
        for (const std::int32_t i : movers) {
            const Ball& ball = balls[std::size_t(i)];
            const double gap = (places[k] - ball.center).length() - ball.radius;
            if (gap >= least) continue;
            least = gap;
            out[far[k]] = i;
        }
    });
    return out;
}

} // namespace

openvdb::Vec3SGrid::Ptr velocityGrid(const openvdb::FloatGrid& surface, const BallSet& atoms,
                                     const std::vector<Vec3f>& displacement,
                                     const VelocityUnit& unit, const SurfaceOptions& options,
                                     const Progress& progress)
{
    const double label = Influence(atoms, options).ofLabel();
    const auto wayOn = [&](const openvdb::BoolGrid& voxels, const Labels& owner) {
        return gridOf<openvdb::Vec3SGrid>(voxels, "v", Vec3f(0.0f), [&](std::size_t i) {
            return wayOf(owner[i], displacement, unit.factor);
        });
    };
    const auto band = shownVoxels(surface, hasField(options.fields, "density"));
    const Labels owner = ownersOf(*band, atoms.balls, label, progress);
    const auto grid = wayOn(*band, owner);
    const auto around = beyond(*band, owner, displacement);
    const Labels aroundOwner = ownersAround(*around, atoms.balls, displacement, label, progress);
    grid->tree().merge(wayOn(*around, aroundOwner)->tree(), openvdb::MERGE_ACTIVE_STATES);
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
