// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/grid/sparse_field.h"

#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/core/simd.h"

#include <openvdb/tools/SignedFloodFill.h>

#include <algorithm>
#include <utility>

namespace molsurf
{

SparseField copied(const SparseField& field)
{
    return {field.table, copied(field.values), field.voxelSize};
}

SparseField clipped(SparseField field, const openvdb::CoordBBox& box, const Progress& progress)
{
    if (box == openvdb::CoordBBox::inf()) return field;
    LeafTable inner = clipped(field.table, box);
    LeafField values(inner.size());
    parallelFor(inner.size(), progress, [&](std::size_t n) {
        const std::int32_t m = field.table.find(inner.origin(n));
        std::copy_n(field.leaf(std::size_t(m)), leafSize, values.leaf(n));
    });
    return {std::move(inner), std::move(values), field.voxelSize};
}

namespace
{

/// The values of a leaf between -most and most; voxels that are not active have one of these.
MOLSURF_KERNEL void cutOff(const float* in, const LeafMask& active, float most, float* out)
{
    const Ints bits = splat(1) << laneNumbers();
    for (int row = 0; row < leafSize / floatLanes; ++row) {
        const Floats value = load(in + floatLanes * row);
        const Floats far = (value < 0.0f) ? splat(-most) : splat(most);
        const Ints on = (bits & active.row(row)) != 0;
        store(out + floatLanes * row, on ? clamped(value, splat(-most), splat(most)) : far);
    }
}

/// OpenVDB's flood fill of the tiles inside. Inside leaves the signs are known, and the filling
/// would guess them along rows; a node of 4096^3 voxels whose children all end outside has its
/// tiles outside, as it was made.
struct FillTiles : openvdb::tools::SignedFloodFillOp<openvdb::FloatTree> {
    using Root = openvdb::FloatTree::RootNodeType;
    using Upper = Root::ChildNodeType;
    static constexpr openvdb::Index aboveLeaves = 1;

    explicit FillTiles(const openvdb::FloatTree& tree) : SignedFloodFillOp(tree, aboveLeaves) {}

    using SignedFloodFillOp::operator();
    void operator()(Upper& node) const
    {
        auto child = node.cbeginChildOn();
        bool inside = child && child->getFirstValue() < 0.0f;
        for (; child && !inside; ++child) inside = child->getLastValue() < 0.0f;
        if (inside) SignedFloodFillOp::operator()(node);
    }
};

} // namespace

openvdb::FloatGrid::Ptr toLevelSet(const SparseField& field, double halfWidth,
                                   const Progress& progress)
{
    using Leaf = openvdb::FloatTree::LeafNodeType;
    const LeafTable& table = field.table;
    const float background = float(halfWidth);
    std::vector<Leaf*> leaves(table.size(), nullptr);
    parallelFor(table.size(), progress, [&](std::size_t n) {
        const LeafMask& active = table.active(n);
        if (!active.any()) return;
        auto* leaf = new Leaf(table.origin(n), background);
        cutOff(field.leaf(n), active, background, leaf->buffer().data());
        Leaf::NodeMaskType mask;
        for (int x = 0; x < 8; ++x) mask.getWord<openvdb::Index64>(x) = active.words[x];
        leaf->setValueMask(mask);
        leaves[n] = leaf;
    });
    auto grid = openvdb::createLevelSet<openvdb::FloatGrid>(field.voxelSize, 3.0);
    grid->setTree(std::make_shared<openvdb::FloatTree>(background));
    for (Leaf* leaf : leaves) {
        if (leaf) grid->tree().addLeaf(leaf);
    }
    openvdb::tree::NodeManager<openvdb::FloatTree> nodes(grid->tree());
    nodes.foreachBottomUp(FillTiles(grid->tree()));
    return grid;
}

SparseField fromGrid(const openvdb::FloatGrid& grid)
{
    std::vector<openvdb::Coord> origins;
    for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) origins.push_back(leaf->origin());
    SparseField field;
    field.voxelSize = grid.voxelSize()[0];
    field.table = LeafTable(std::move(origins));
    field.values = LeafField(field.table.size());
    for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
        const auto n = std::size_t(field.table.find(leaf->origin()));
        for (int v = 0; v < leafSize; ++v) {
            field.leaf(n)[v] = leaf->getValue(openvdb::Index(v));
            field.table.active(n).set(v, leaf->isValueOn(openvdb::Index(v)));
        }
    }
    return field;
}

} // namespace molsurf
