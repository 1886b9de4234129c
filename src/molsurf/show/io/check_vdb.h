// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A look over a .vdb file before OpenVDB reads it.

#include <cstdint>
#include <istream>
#include <string>

namespace molsurf
{

/// Contents of a file that decide the cost of reading and meshing it.
struct VdbContent {
    std::uint64_t leaves = 0; ///< of the grid that has most
    std::uint64_t bytes = 0;  ///< of all trees in memory
    bool spline = false;      ///< whether a grid has that name
};

/// Follows a .vdb file from its first byte to the end of its last grid, and checks what OpenVDB
/// believes: lengths of texts and metadata buy memory, a length of packed values says how many
/// bytes go into an array, places of nodes decide which is freed. A file that passes takes memory
/// in proportion to its size.
///
/// @param[in] stream  at its beginning
/// @param[in] size    of the file [byte]
/// @throws std::runtime_error with what is wrong
VdbContent checkVdb(std::istream& stream, std::uint64_t size);

/// The same of the values of one leaf, tree::LeafNode::writeBuffers(), and nothing behind them.
/// @param[in] type         of a value, as "float"
/// @param[in] half         floats have 16 bits
/// @param[in] compression  flags of io::setDataCompression()
void checkVdbLeaf(std::istream& stream, std::uint64_t size, const std::string& type, bool half,
                  std::uint32_t compression);

} // namespace molsurf
