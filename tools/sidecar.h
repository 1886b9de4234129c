// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The .usda files that lie beside others.

#include "cli/call.h"

namespace molsurf::tool
{

/// Adds an output .usda for every .vdb: of name.vdb it is name.usda, of a frame name.0001.vdb, too.
/// @throws Error(ErrorKind::Usage) for a .vdb on standard output
void addSidecars(CommandLine& call);

/// Whether an output may replace a file: with --force, or if it is the .usda of a sequence that
/// this program has made, which gets one frame more.
bool mayReplace(const CommandLine& call, const Output& output);

} // namespace molsurf::tool
