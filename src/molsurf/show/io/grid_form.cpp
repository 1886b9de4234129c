// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/grid_form.h"

#include "molsurf/error.h"

#include <openvdb/tools/MultiResGrid.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <memory>
#include <string>

namespace molsurf
{

namespace
{

using openvdb::FloatGrid;
using openvdb::GridBase;
using openvdb::Int32Grid;
using openvdb::Vec3SGrid;

/// A copy that shares its voxels.
GridBase::Ptr sharedCopy(const GridBase::ConstPtr& grid)
{
    return openvdb::ConstPtrCast<GridBase>(grid->copyGrid());
}

/// Grids of labels in a file.
constexpr const char* labelGrids[] = {"atom_id", "chain_id", "group_id", "pocket_id"};

/// The labels of voxels as floats.
GridBase::Ptr asFloats(const Int32Grid& labels)
{
    constexpr std::int32_t most = 1 << 24; // the largest whole number below which floats hold all
    for (auto value = labels.cbeginValueOn(); value; ++value)
        if (*value > most)
            throw Error(ErrorKind::Usage, "`ids` float: grid " + labels.getName() +
                                              " has the label " + std::to_string(*value) +
                                              ", expected at most " + std::to_string(most));
    return std::make_shared<FloatGrid>(labels);
}

/// The levels of a grid.
template<typename GridT>
openvdb::GridPtrVecPtr levelsOf(const GridT& grid, int count)
{
    using Levels = openvdb::tools::MultiResGrid<typename GridT::TreeType>;
    Levels levels(std::size_t(count), grid, false);
    return levels.grids();
}

/// Adds a grid, or its levels.
void addLevels(const GridBase::Ptr& grid, int mips, openvdb::GridPtrVec& out)
{
    const std::string name = grid->getName();
    const bool isFog = grid->getGridClass() == openvdb::GRID_FOG_VOLUME;
    const auto floats = openvdb::gridPtrCast<FloatGrid>(grid);
    const auto colors = openvdb::gridPtrCast<Vec3SGrid>(grid);
    openvdb::GridPtrVecPtr levels;
    if (mips > 0 && floats && isFog) levels = levelsOf(*floats, mips + 1);
    if (mips > 0 && colors && name.rfind("Cd", 0) == 0) levels = levelsOf(*colors, mips + 1);
    if (!levels) return out.push_back(grid);
    for (const GridBase::Ptr& level : *levels) {
        level->setGridClass(grid->getGridClass());
        out.push_back(level);
    }
}

/// Calls f(grid) with its own type, if that is one of those of files.
template<typename F>
void withType(GridBase& grid, const F& f)
{
    using Types = openvdb::TypeList<FloatGrid, Vec3SGrid, Int32Grid>;
    grid.apply<Types>(f);
}

/// Makes the corners of a box active, with the value outside.
void reach(const openvdb::BBoxd& box, GridBase::Ptr& grid)
{
    GridBase::Ptr deep = grid->deepCopyGrid();
    withType(*deep, [&](auto& of) {
        for (const openvdb::Vec3d& corner : {box.min(), box.max()}) {
            const auto voxel = openvdb::Coord::round(of.worldToIndex(corner));
            if (!of.tree().isValueOn(voxel)) of.tree().setValueOn(voxel, of.background());
        }
    });
    grid = deep;
}

/// The box about the active voxels of all [scene units].
openvdb::BBoxd boxOf(const openvdb::GridPtrVec& grids)
{
    openvdb::BBoxd out;
    for (const GridBase::Ptr& grid : grids) {
        const openvdb::CoordBBox box = grid->evalActiveVoxelBoundingBox();
        if (box.empty()) continue;
        out.expand(grid->indexToWorld(box.min()));
        out.expand(grid->indexToWorld(box.max()));
    }
    return out;
}

} // namespace

const char* nameOf(IdType type)
{
    return type == IdType::Int ? "int" : "float";
}

openvdb::GridCPtrVec formed(const openvdb::GridCPtrVec& grids, const GridForm& form)
{
    if (!form.changes()) return grids;
    openvdb::GridPtrVec out;
    for (const GridBase::ConstPtr& grid : grids) {
        const auto labels = openvdb::gridConstPtrCast<Int32Grid>(grid);
        const bool converts = labels && form.ids == IdType::Float;
        const GridBase::Ptr own = converts ? asFloats(*labels) : sharedCopy(grid);
        addLevels(own, form.mips, out);
    }
    if (form.oneBox) {
        const openvdb::BBoxd box = boxOf(out);
        if (box)
            for (GridBase::Ptr& grid : out) reach(box, grid);
    }
    if (form.half)
        for (const GridBase::Ptr& grid : out) grid->setSaveFloatAsHalf(true);
    return {out.begin(), out.end()};
}

openvdb::GridPtrVec withIntLabels(const openvdb::GridPtrVec& grids)
{
    openvdb::GridPtrVec out;
    for (const GridBase::Ptr& grid : grids) {
        const auto floats = openvdb::gridPtrCast<FloatGrid>(grid);
        const bool isLabel =
            floats && std::count(std::begin(labelGrids), std::end(labelGrids), grid->getName());
        out.push_back(isLabel ? std::make_shared<Int32Grid>(*floats) : grid);
    }
    return out;
}

} // namespace molsurf
