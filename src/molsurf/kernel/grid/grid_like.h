// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Grids on the voxels of others, and among others.

#include <openvdb/openvdb.h>

#include <cstddef>
#include <memory>
#include <string>

namespace molsurf
{

/// Makes a grid on the active voxels of another, which all get the background's value, with the
/// transform of that grid.
template<typename GridT, typename SourceT>
typename GridT::Ptr gridLike(const SourceT& source, const std::string& name,
                             const typename GridT::ValueType& background)
{
    auto grid = GridT::create(background);
    grid->setTree(std::make_shared<typename GridT::TreeType>(source.tree(), background,
                                                             openvdb::TopologyCopy()));
    grid->setTransform(source.transform().copy());
    grid->setName(name);
    return grid;
}

/// Makes a grid of one value for each active voxel of another.
/// @param[in] of  gives the value of a voxel, by its number in the order of the tree
template<typename GridT, typename SourceT, typename Of>
typename GridT::Ptr gridOf(const SourceT& voxels, const std::string& name,
                           const typename GridT::ValueType& background, const Of& of)
{
    auto grid = gridLike<GridT>(voxels, name, background);
    std::size_t i = 0;
    for (auto to = grid->beginValueOn(); to; ++to) to.setValue(of(i++));
    return grid;
}

/// Says in a grid's metadata that its colours are in linear light, of the primaries of Rec. 709.
inline void describeColors(openvdb::GridBase& grid)
{
    grid.insertMeta("color_space", openvdb::StringMetadata("lin_rec709"));
}

/// The first grid of a name and type; null without one.
template<typename GridT>
typename GridT::Ptr findGrid(const openvdb::GridPtrVec& grids, const std::string& name)
{
    for (const auto& grid : grids)
        if (grid->getName() == name)
            if (auto found = openvdb::gridPtrCast<GridT>(grid)) return found;
    return nullptr;
}

} // namespace molsurf
