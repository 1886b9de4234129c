// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The .usda files of volumes, meshes and films.

#include "molsurf/mesh.h"
#include "molsurf/request/request.h"
#include "molsurf/show/io/output_file.h"
#include "molsurf/show/io/write_usda.h"

#include <string>
#include <vector>

namespace molsurf
{

/// The .usda of a volume. The frames of a sequence are those in its folder that are of
/// the same input and options, and the one that is being written.
UsdVolume usdVolume(const Request& request, const Output& output);

/// Writes the .usda of a mesh: of all, of one frame, or the film of all frames in its folder that
/// are of the same input and options.
void writeUsdStage(const Request& request, const Output& output, const Mesh& mesh,
                   OutputFile& file);

/// Whether an output is the .usda of a film of meshes.
bool isFilm(const Output& output);

/// A line for each .usda that leaves out frames of another sequence.
std::vector<std::string> leftOutOf(const Request& request);

} // namespace molsurf
