// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The .usda files of volumes, meshes and films.

#include "cli/call.h"

#include "molsurf/mesh.h"
#include "molsurf/show/io/output_file.h"
#include "molsurf/show/io/write_usda.h"

#include <string>
#include <vector>

namespace molsurf::tool
{

/// Adds an output .usda for every .vdb: of name.vdb it is name.usda, of a frame name.0001.vdb, too.
/// @throws Error(ErrorKind::Usage) for a .vdb on standard output
void addSidecars(CommandLine& call);

/// Whether an output may replace a file: with --force, or if it is the .usda of a sequence that
/// this program has made, which gets one frame more.
bool mayReplace(const CommandLine& call, const Output& output);

/// The .usda of a volume. The frames of a sequence are those in its folder that are of
/// the same input and options, and the one that is being written.
UsdVolume usdVolume(const CommandLine& call, const Output& output);

/// Writes the .usda of a mesh: of all, of one frame, or the film of all frames in its folder that
/// are of the same input and options.
void writeMeshStage(const CommandLine& call, const Output& output, const Mesh& mesh,
                    OutputFile& file);

/// Whether an output is the .usda of a film of meshes.
bool isFilm(const Output& output);

/// A line for each .usda that leaves out frames of another sequence.
std::vector<std::string> leftOutOf(const CommandLine& call);

} // namespace molsurf::tool
