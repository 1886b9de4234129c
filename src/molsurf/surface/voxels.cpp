// SPDX-License-Identifier: MPL-2.0
#include "molsurf/error.h"
#include "molsurf/surface.h"

#include <tbb/parallel_for.h>

namespace molsurf
{

Voxels voxelsOf(const openvdb::FloatGrid& grid)
{
    const openvdb::math::Transform& transform = grid.transform();
    const openvdb::Vec3d zero = transform.indexToWorld(openvdb::Vec3d(0.0));
    const double edge = transform.indexToWorld(openvdb::Vec3d(1.0, 0.0, 0.0)).x() - zero.x();
    const openvdb::Vec3d one = transform.indexToWorld(openvdb::Vec3d(1.0)) - zero;
    if (!transform.isLinear() || !(edge > 0.0) || !one.eq(openvdb::Vec3d(edge), 1e-6 * edge))
        throw Error(ErrorKind::Input,
                    "grid '" + grid.getName() + "': expected voxels that are cubes along the axes");
    Voxels out;
    out.edge = edge;
    out.origin = zero;
    std::vector<const openvdb::FloatTree::LeafNodeType*> leaves;
    std::vector<std::size_t> begins{0};
    for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
        leaves.push_back(leaf.getLeaf());
        begins.push_back(begins.back() + leaf->onVoxelCount());
    }
    out.coordinates.resize(begins.back());
    out.values.resize(begins.back());
    tbb::parallel_for(std::size_t(0), leaves.size(), [&](std::size_t n) {
        std::size_t at = begins[n];
        for (auto voxel = leaves[n]->cbeginValueOn(); voxel; ++voxel, ++at) {
            const openvdb::Coord ijk = voxel.getCoord();
            out.coordinates[at] = {ijk.x(), ijk.y(), ijk.z()};
            out.values[at] = *voxel;
        }
    });
    return out;
}

} // namespace molsurf
