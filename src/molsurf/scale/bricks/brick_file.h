// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The result of a brick on disk: leaves as a .vdb holds them and vertices as a .ply does, ready to
/// be copied, and a JSON header with their places.

#include "molsurf/kernel/core/file_descriptor.h"
#include "molsurf/scale/bricks/brick.h"
#include "molsurf/show/io/output_file.h"
#include "molsurf/show/io/ply_layout.h"

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

namespace molsurf
{

/// A run of records in the file.
struct Section {
    std::uint64_t offset = 0; ///< of the first byte
    std::uint64_t count = 0;  ///< records
};

/// A leaf of a grid; its values lie in the file as tree::LeafNode::writeBuffers() puts them.
struct StoredLeaf {
    std::array<std::int32_t, 3> origin;
    std::uint32_t negative; ///< bit 0: the first value is negative, bit 1: the last
    std::uint64_t offset;   ///< of its values in the file
    std::uint64_t size;     ///< bytes
    std::array<std::uint64_t, 8> mask;
};

/// A grid without its leaves.
struct StoredGrid {
    std::string name, type, gridClass;             ///< as OpenVDB calls them
    std::vector<double> background;                ///< one number, or three
    bool half;                                     ///< floats have 16 bits
    Section leaves;                                ///< of StoredLeaf
    std::map<std::string, std::string> metadata{}; ///< that are words
    std::uint64_t values = 0; ///< where those of the first leaf begin in the file
};

/// The content of the header.
struct BrickHeader {
    std::string plan;       ///< of which plan it is: the name that writeBrick() was given
    std::size_t number = 0; ///< from 1
    std::vector<StoredGrid> grids;
    PlyLayout layout;
    Section vertices;     ///< the owned ones, records of layout.vertexSize() bytes, if meshed
    Section triangles;    ///< three 32-bit indices, if meshed
    Section areas;        ///< floats, one an owned vertex
    Section curvatures;   ///< two floats an owned vertex: mean [1/Å] and Gaussian [1/Å^2]
    Section border;       ///< of BorderVertex
    Section openEdges;    ///< of OpenEdge
    Section pieces;       ///< of PieceMeasure
    std::size_t flat = 0; ///< as those of BrickMesh
    bool closed = true, manifold = true;
    BrickSums sums;

    /// Whether vertices and triangles are in the file.
    bool meshed() const { return triangles.offset > 0; }
};

/// A stored leaf without its values and their place.
template<typename LeafT>
StoredLeaf storedLeaf(const LeafT& leaf)
{
    StoredLeaf out{};
    out.origin = {leaf.origin().x(), leaf.origin().y(), leaf.origin().z()};
    if constexpr (std::is_arithmetic_v<typename LeafT::ValueType>)
        out.negative =
            std::uint32_t(leaf.getFirstValue() < 0) | std::uint32_t(leaf.getLastValue() < 0) << 1;
    for (int x = 0; x < 8; ++x)
        out.mask[std::size_t(x)] = leaf.getValueMask().template getWord<openvdb::Index64>(x);
    return out;
}

/// Reads bytes of a file from a place on.
/// @param[in] path  names it in messages
/// @throws Error(ErrorKind::Input) if it cannot be read or ends before
void readAt(const FileDescriptor& file, const std::string& path, std::uint64_t offset, void* to,
            std::size_t bytes);

/// The voxels that any ball can reach.
openvdb::CoordBBox anySpace();

/// Writes what a brick leaves. The file must be one that can be written out of order.
/// @param[in] meshed  whether MergedMesh::writePly() is to be possible; else vertices and triangles
///                    are counted but left out
void writeBrick(const Brick& brick, const std::string& plan, std::size_t number, bool meshed,
                OutputFile& file, const Progress& progress);

/// A brick that lies on disk. Once its checksum is verified it reads nothing that is not asked for.
class BrickFile
{
public:
    /// @param[in] box  the brick's, in which its leaves have to lie
    /// @throws Error(ErrorKind::Input) if it cannot be read, is damaged, or is not the file of a
    ///         brick
    explicit BrickFile(const std::string& path, const openvdb::CoordBBox& box = anySpace());

    const BrickHeader& header() const { return header_; }

    void read(std::uint64_t offset, void* to, std::size_t bytes) const
    {
        readAt(file_, path_, offset, to, bytes);
    }

    template<typename T>
    std::vector<T> read(const Section& section) const
    {
        std::vector<T> out(section.count);
        read(section.offset, out.data(), out.size() * sizeof(T));
        return out;
    }

    /// The leaves of grid g.
    /// @throws Error(ErrorKind::Input) if one lies outside of the brick, or if their values are not
    ///         what stands before them, one after the other
    std::vector<StoredLeaf> leaves(std::size_t g) const;

    /// Says that the file is no good.
    /// @param[in] what  "has a leaf between leaves", for example
    [[noreturn]] void refuse(const std::string& what) const;

    const std::string& path() const { return path_; }

private:
    /// CRC-32 of what follows the head.
    std::uint64_t checksumOf(std::uint64_t size) const;

    std::string path_;
    openvdb::CoordBBox box_;
    FileDescriptor file_;
    BrickHeader header_;
};

} // namespace molsurf
