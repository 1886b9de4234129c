// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// BinaryCIF 0.3: mmCIF as MessagePack with compressed columns.

#include <gemmi/cifdoc.hpp>

#include <functional>
#include <string>

namespace molsurf
{

/// True if the bytes begin as a BinaryCIF file does: with a map of MessagePack that has its keys.
bool isBinaryCif(const std::string& bytes);

/// Decodes a BinaryCIF file to the same blocks, loops and texts that its mmCIF file has. Numbers
/// that were stored with a fixed number of decimals have these; others have the fewest digits that
/// give the same number.
///
/// The encodings are those of the description of the format: ByteArray, FixedPoint,
/// IntervalQuantization, RunLength, Delta, IntegerPacking and StringArray.
///
/// @param[in] path      stands for the file in messages
/// @param[in] isWanted  whether a category, as "_atom_site", is to be decoded; others are left out
/// @throws Error(ErrorKind::Input) if the file is damaged, or would decode to more than a file of
///         its size can hold
gemmi::cif::Document decodeBinaryCif(const std::string& bytes, const std::string& path,
                                     const std::function<bool(const std::string&)>& isWanted);

} // namespace molsurf
