// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The files that the name of one stands for.

#include "molsurf/request/request.h"

#include <string>
#include <vector>

namespace molsurf
{

/// How a file's name ends, in lower case without the first dot: one of the words of formatTable()
/// if it is one of them, such as "atoms.csv", else the extension; empty: it has none.
std::string formatWordOf(const std::string& path);

/// The pictures of a turntable in the place of each picture: name.0001.png, ...; a film holds all
/// of its own.
std::vector<Output> withTurntable(const std::vector<Output>& outputs, int count);

/// The path of a file of a pocket: x.pocket1.ply of x.pockets.ply.
std::string numberedPath(const Output& output, std::size_t number);

/// The files of all pockets in the place of each that holds::Numbered.
/// @throws Error(ErrorKind::Output) if another file has the name of one
std::vector<Output> withPockets(const std::vector<Output>& outputs, std::size_t count);

} // namespace molsurf
