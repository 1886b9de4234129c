// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The files of a run.

#include "cli/call.h"

#include "molsurf/io/output_file.h"
#include "molsurf/surface.h"

namespace molsurf::tool
{

/// Everything that is needed to make a .vdb again.
openvdb::MetaMap vdbMetadata(const Call& call, const Report& report);

/// What a surface depends on but its atoms: 16 hexadecimal digits that change with any option.
std::string optionsDigest(const Call& call);

/// Writes one output. The report must be complete but for what is timed by writing.
/// @param[in] coarser  the meshes of the further levels of detail of --lod
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writeOutput(const Call& call, const BallSet& atoms, const MolecularSurface& result,
                 const Output& output, const Progress& progress, OutputFile& file,
                 const std::vector<Mesh>& coarser = {});

} // namespace molsurf::tool
