// SPDX-License-Identifier: MPL-2.0
#include "molsurf/scale/bricks/merge_vdb.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/cancel.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/show/io/check_vdb.h"
#include "molsurf/show/io/vdb_archive.h"
#include "molsurf/show/io/write_vdb.h"

#include <openvdb/io/Archive.h>
#include <openvdb/io/Compression.h>
#include <openvdb/io/GridDescriptor.h>
#include <openvdb/io/io.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <map>
#include <sstream>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace molsurf
{

using openvdb::Coord;

namespace
{

// Of a node: whether its first and its last value are negative.
struct Ends {
    bool first, last;
};

// Fills the tiles of a node, and of those below it, by the signs of its children, as
// tools::SignedFloodFillOp does: a tile has the last sign of the child before it along z, y or x.
// The leaves have no values, but the signs of their ends as of StoredLeaf::negative.
template<typename NodeT, typename T>
Ends floodTiles(NodeT& node, const T& inside, const T& outside)
{
    if constexpr (NodeT::LEVEL == 0) {
        return {(node.transientData() & 1) != 0, (node.transientData() & 2) != 0};
    } else {
        constexpr int size = 1 << NodeT::LOG2DIM;
        std::vector<signed char> last(NodeT::NUM_VALUES, -1); // of children; -1: a tile
        std::vector<char> negative(NodeT::NUM_VALUES);
        bool any = false, x = false, first = false;
        for (auto it = node.beginChildOn(); it; ++it) {
            const Ends ends = floodTiles(*it, inside, outside);
            last[it.pos()] = ends.last;
            if (!any) x = ends.first;
            if (it.pos() == 0) first = ends.first;
            any = true;
        }
        for (int i = 0, n = 0; i < size; ++i) {
            if (last[std::size_t(n)] >= 0) x = last[std::size_t(n)];
            bool y = x;
            for (int j = 0; j < size; ++j) {
                if (last[std::size_t(n)] >= 0) y = last[std::size_t(n)];
                bool z = y;
                for (int k = 0; k < size; ++k, ++n) {
                    if (last[std::size_t(n)] >= 0) z = last[std::size_t(n)];
                    negative[std::size_t(n)] = z;
                }
            }
        }
        for (auto it = node.beginChildOff(); it; ++it)
            it.setValue(negative[it.pos()] ? inside : outside);
        return {last[0] >= 0 ? first : bool(negative[0]), bool(negative[NodeT::NUM_VALUES - 1])};
    }
}

// The same for the root: what lies between two inner nodes along z is inside.
template<typename TreeT>
void floodRoot(TreeT& tree)
{
    using Value = typename TreeT::ValueType;
    const Value outside = tree.background(), inside = -outside;
    std::map<Coord, Ends> nodes;
    for (auto it = tree.root().beginChildOn(); it; ++it)
        nodes.emplace(it.getCoord(), floodTiles(*it, inside, outside));
    constexpr int dim = int(TreeT::RootNodeType::ChildNodeType::DIM), most = 1 << 16;
    int tiles = 0;
    for (auto a = nodes.begin(), b = a; a != nodes.end(); a = b) {
        if (++b == nodes.end()) break;
        const Coord step = b->first - a->first;
        if (step.x() != 0 || step.y() != 0 || step.z() == dim) continue;
        if (!a->second.last || !b->second.first) continue;
        if ((tiles += step.z() / dim) > most)
            throw Error(ErrorKind::Input, "merge: leaves that enclose more than any molecule");
        for (Coord c = a->first.offsetBy(0, 0, dim); c.z() != b->first.z(); c.z() += dim)
            tree.root().addTile(c, inside, false);
    }
}

// Where the values of a leaf lie.
struct Place {
    std::uint32_t brick;
    std::uint64_t offset, size;
};

// A grid whose leaves have no values, and where these are.
struct Skeleton {
    openvdb::GridBase::Ptr grid;
    std::vector<Place> leaves; // in the order of the tree
    std::size_t bytes = 0;     // of the grid, once it is loaded
};

// A leaf without values knows the signs of its ends, and its number in a list of places.
constexpr int signBits = 2;

template<typename T>
T valueFrom(const std::vector<double>& numbers)
{
    if constexpr (std::is_arithmetic_v<T>)
        return T(numbers.at(0));
    else
        return T(float(numbers.at(0)), float(numbers.at(1)), float(numbers.at(2)));
}

/// Refuses leaves that are so far from each other that the nodes above them would take memory out
/// of proportion: those of a surface come in heaps.
/// @param[in] origins  of the leaves of all bricks
template<typename Tree>
void checkNodes(std::vector<std::array<std::int32_t, 3>> origins)
{
    using Upper = typename Tree::RootNodeType::ChildNodeType;
    using Lower = typename Upper::ChildNodeType;
    constexpr std::size_t lower = Lower::NUM_VALUES * sizeof(typename Lower::UnionType);
    constexpr std::size_t upper = Upper::NUM_VALUES * sizeof(typename Upper::UnionType);
    const std::size_t leaves = origins.size();
    for (auto& origin : origins)
        for (std::int32_t& x : origin) x &= ~std::int32_t(Upper::DIM - 1);
    std::sort(origins.begin(), origins.end());
    const auto nodes = std::size_t(std::unique(origins.begin(), origins.end()) - origins.begin());
    // As much as 8 upper nodes, and two lower ones a leaf, may take.
    if (nodes * upper > 8 * upper + 2 * lower * leaves)
        throw Error(ErrorKind::Input,
                    "merge: the leaves of the bricks are too far from each other");
}

/// Whether bytes are the values of a leaf, as OpenVDB reads them, and agree with the leaf.
template<typename LeafT>
bool holds(const StoredLeaf& stored, std::string bytes, const StoredGrid& grid,
           const typename LeafT::ValueType& background, std::uint32_t compression)
{
    try {
        std::istringstream stream(std::move(bytes));
        stream.exceptions(std::ios_base::badbit | std::ios_base::failbit | std::ios_base::eofbit);
        checkVdbLeaf(stream, stored.size, openvdb::typeNameAsString<typename LeafT::ValueType>(),
                     grid.half, compression);
        stream.seekg(0);
        openvdb::io::setCurrentVersion(stream);
        openvdb::io::setDataCompression(stream, compression);
        openvdb::io::setGridBackgroundValuePtr(stream, &background);
        LeafT leaf(Coord(stored.origin[0], stored.origin[1], stored.origin[2]), background);
        leaf.readBuffers(stream, grid.half);
        const StoredLeaf found = storedLeaf(leaf);
        return found.negative == stored.negative && found.mask == stored.mask;
    } catch (const std::runtime_error&) { // of checkVdbLeaf()
        return false;
    } catch (const openvdb::Exception&) {
        return false;
    }
}

/// Reads the values of all leaves of a brick once, so that the merged file is readable. It refuses
/// the brick after the first run of leaves with a bad one.
/// @param[in] g  number of the grid
template<typename GridT>
void checkValues(const BrickFile& brick, const std::vector<StoredLeaf>& leaves, std::size_t g,
                 const typename GridT::ValueType& background, std::uint32_t compression,
                 const Progress& progress)
{
    using Leaf = typename GridT::TreeType::LeafNodeType;
    constexpr std::size_t run = 4096; // leaves between two looks at what the threads found
    for (std::size_t begin = 0; begin < leaves.size(); begin += run) {
        const std::size_t count = std::min(run, leaves.size() - begin);
        std::atomic<bool> good{true};
        parallelFor(count, progress, [&](std::size_t i) {
            const StoredLeaf& leaf = leaves[begin + i];
            std::string bytes(leaf.size, ' ');
            brick.read(leaf.offset, bytes.data(), bytes.size());
            if (!holds<Leaf>(leaf, std::move(bytes), brick.header().grids[g], background,
                             compression))
                good = false;
        });
        if (!good) brick.refuse("has values that are not those of their leaf");
    }
}

template<typename GridT>
Skeleton skeletonOf(const std::vector<BrickFile>& bricks, std::size_t g, double voxel,
                    std::uint32_t compression, const Progress& progress)
{
    using Tree = typename GridT::TreeType;
    using Leaf = typename Tree::LeafNodeType;
    using Value = typename GridT::ValueType;
    const StoredGrid& first = bricks.front().header().grids[g];
    const Value background = valueFrom<Value>(first.background);
    auto grid = GridT::create(background);
    grid->setTransform(openvdb::math::Transform::createLinearTransform(voxel));
    for (const auto& [name, words] : first.metadata)
        grid->insertMeta(name, openvdb::StringMetadata(words));
    grid->setGridClass(openvdb::GridBase::stringToGridClass(first.gridClass));
    grid->setName(first.name);
    if (first.half) grid->setSaveFloatAsHalf(true);

    std::vector<std::array<std::int32_t, 3>> origins;
    for (const BrickFile& brick : bricks) {
        const std::vector<StoredLeaf> leaves = brick.leaves(g);
        checkValues<GridT>(brick, leaves, g, background, compression, progress);
        for (const StoredLeaf& leaf : leaves) origins.push_back(leaf.origin);
    }
    checkNodes<Tree>(std::move(origins));
    std::vector<Place> places;
    for (std::size_t b = 0; b < bricks.size(); ++b) {
        for (const StoredLeaf& stored : bricks[b].leaves(g)) {
            const Coord origin(stored.origin[0], stored.origin[1], stored.origin[2]);
            if (grid->constTree().probeConstLeaf(origin))
                bricks[b].refuse("has a leaf that another brick has");
            auto* leaf = new Leaf(openvdb::PartialCreate(), origin, background);
            typename Leaf::NodeMaskType mask;
            for (int x = 0; x < 8; ++x)
                mask.template getWord<openvdb::Index64>(x) = stored.mask[std::size_t(x)];
            leaf->setValueMask(mask);
            leaf->setTransientData(openvdb::Index32(places.size()) << signBits | stored.negative);
            grid->tree().addLeaf(leaf);
            places.push_back({std::uint32_t(b), stored.offset, stored.size});
        }
    }
    if constexpr (std::is_same_v<Value, float>) {
        if (grid->getGridClass() == openvdb::GRID_LEVEL_SET) floodRoot(grid->tree());
    }
    Skeleton out{grid, {}, 0};
    out.leaves.reserve(places.size());
    for (auto leaf = grid->tree().cbeginLeaf(); leaf; ++leaf)
        out.leaves.push_back(places[leaf->transientData() >> signBits]);
    out.bytes = std::size_t(grid->tree().memUsage()) + out.leaves.size() * 512 * sizeof(Value);
    return out;
}

Skeleton skeletonOfAny(const std::vector<BrickFile>& bricks, std::size_t g, double voxel,
                       std::uint32_t compression, const Progress& progress)
{
    const std::string& type = bricks.front().header().grids[g].type;
    if (type == openvdb::FloatGrid::gridType())
        return skeletonOf<openvdb::FloatGrid>(bricks, g, voxel, compression, progress);
    if (type == openvdb::Int32Grid::gridType())
        return skeletonOf<openvdb::Int32Grid>(bricks, g, voxel, compression, progress);
    return skeletonOf<openvdb::Vec3SGrid>(bricks, g, voxel, compression, progress);
}

// Writes a file like io::Archive::write(), but for the values, which it copies.
class CopyingArchive : public openvdb::io::Archive
{
public:
    explicit CopyingArchive(std::uint32_t compression) { setCompression(compression); }

    void begin(std::ostream& stream, bool seekable, std::size_t grids,
               const openvdb::MetaMap& metadata) const
    {
        openvdb::io::setDataCompression(stream, compression());
        writeHeader(stream, seekable);
        metadata.writeMeta(stream);
        const auto count = std::int32_t(grids);
        stream.write(reinterpret_cast<const char*>(&count), sizeof count);
    }

    void add(std::ostream& stream, bool seekable, const Skeleton& skeleton,
             const std::vector<BrickFile>& bricks, const Progress& progress) const
    {
        const openvdb::GridBase& grid = *skeleton.grid;
        openvdb::io::GridDescriptor descriptor(grid.getName(), grid.type(), grid.saveFloatAsHalf());
        descriptor.writeHeader(stream);
        const auto offsets = seekable ? stream.tellp() : std::ostream::pos_type(0);
        descriptor.writeStreamPos(stream); // again at the end, when the positions are known
        if (seekable) descriptor.setGridPos(stream.tellp());
        setGridCompression(stream, grid);
        openvdb::GridBase::Ptr described =
            openvdb::ConstPtrCast<openvdb::GridBase>(grid.copyGrid());
        described->addStatsMetadata();
        described->insertMeta(openvdb::GridBase::META_FILE_MEM_BYTES,
                              openvdb::Int64Metadata(std::int64_t(skeleton.bytes)));
        described->insertMeta(openvdb::GridBase::META_FILE_COMPRESSION,
                              openvdb::StringMetadata(openvdb::io::compressionToString(
                                  openvdb::io::getDataCompression(stream))));
        described->writeMeta(stream);
        grid.writeTransform(stream);
        grid.writeTopology(stream);
        if (seekable) descriptor.setBlockPos(stream.tellp());
        // Leaves that lie one after another in a brick's file are copied at once.
        constexpr std::size_t most = 1 << 20;
        std::vector<char> values;
        for (std::size_t i = 0; i < skeleton.leaves.size();) {
            const Place& first = skeleton.leaves[i];
            std::size_t size = 0;
            for (; i < skeleton.leaves.size() && size < most; ++i) {
                const Place& next = skeleton.leaves[i];
                if (next.brick != first.brick || next.offset != first.offset + size) break;
                size += next.size;
            }
            values.resize(size);
            bricks[first.brick].read(first.offset, values.data(), size);
            stream.write(values.data(), std::streamsize(size));
            stopIfCancelled(progress);
        }
        if (!seekable) return;
        descriptor.setEndPos(stream.tellp());
        stream.seekp(offsets);
        descriptor.writeStreamPos(stream);
        descriptor.seekToEnd(stream);
    }
};

} // namespace

void writeMergedVdb(const std::vector<BrickFile>& bricks, double voxel, const std::string& creator,
                    const openvdb::MetaMap& metadata, OutputFile& file, const Progress& progress)
{
    const std::vector<StoredGrid>& grids = bricks.front().header().grids;
    const bool floatsAlone = std::all_of(grids.begin(), grids.end(), [](const StoredGrid& grid) {
        return grid.type == openvdb::FloatGrid::gridType();
    });
    const std::uint32_t compression = vdbCompression(floatsAlone);
    const CopyingArchive archive(compression);
    const auto write = [&](std::ostream& out) {
        archive.begin(out, file.seekable(), grids.size(), metadata);
        for (std::size_t g = 0; g < grids.size(); ++g) {
            const Skeleton skeleton = skeletonOfAny(bricks, g, voxel, compression, progress);
            skeleton.grid->setCreator(creator);
            archive.add(out, file.seekable(), skeleton, bricks, progress);
        }
    };
    writeArchive(write, file);
}

MergedSize sizeOfMerged(const std::vector<BrickFile>& bricks)
{
    MergedSize size;
    for (const BrickFile& brick : bricks) {
        const Section& leaves = brick.header().grids.front().leaves;
        for (const StoredLeaf& leaf : brick.leaves(0)) {
            for (const std::uint64_t word : leaf.mask)
                size.activeVoxels += std::size_t(__builtin_popcountll(word));
        }
        size.bytes += leaves.count * (sizeof(openvdb::FloatTree::LeafNodeType) + 512 * 4);
    }
    return size;
}

} // namespace molsurf
