// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The bodies of pockets, in files of their own and in pictures and pages.

#include "cli/call.h"

#include <cstddef>

namespace molsurf::tool
{

/// Whether files or pictures of a call have them.
bool wantsBodies(const CommandLine& call);

/// Puts a file for each pocket, NAME.pocket1.ply, in the place of NAME.pockets.ply.
/// @throws Error(ErrorKind::Output) if another output has that name
void numberOutputs(std::size_t count, CommandLine& call);

} // namespace molsurf::tool
