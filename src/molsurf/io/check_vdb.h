// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A look over a .vdb file before OpenVDB reads it.

#include <cstdint>
#include <istream>
#include <string>

namespace molsurf
{

/// Follows a .vdb file from its first byte to the end of its last grid, and checks what OpenVDB
/// believes: lengths of texts and metadata buy memory, a length of packed values says how many
/// bytes go into an array, places of nodes decide which is freed. What passes is read in memory in
/// proportion to the size of the file.
///
/// @param[in] stream  at its beginning
/// @param[in] size    of the file [byte]
/// @throws std::runtime_error with what is wrong
void checkVdb(std::istream& stream, std::uint64_t size);

/// The same of the values of one leaf, tree::LeafNode::writeBuffers(), and nothing behind them.
/// @param[in] type         of a value, as "float"
/// @param[in] half         floats have 16 bits
/// @param[in] compression  flags of io::setDataCompression()
void checkVdbLeaf(std::istream& stream, std::uint64_t size, const std::string& type, bool half,
                  std::uint32_t compression);

} // namespace molsurf
