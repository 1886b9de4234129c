// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The files of a run of the command.

#include "cli/call.h"

#include "molsurf/request/drawn_request.h"
#include "molsurf/surface.h"

#include <string>

namespace molsurf::tool
{

/// Everything that is needed to make a .vdb again.
openvdb::MetaMap vdbMetadata(const CommandLine& call, const Report& report);

/// Digest of all that a surface depends on but its atoms: 16 hexadecimal digits that change with
/// any option.
std::string optionsDigest(const CommandLine& call);

/// Writes one output. The report must be complete but for what is timed by writing.
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writeOutput(const CommandLine& call, const BallSet& atoms, const MolecularSurface& result,
                 const Output& output, const Progress& progress, OutputFile& file,
                 const ShownMeshes& shown = {});

} // namespace molsurf::tool
