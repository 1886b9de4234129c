// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The manifest of a plan: plan.json.

#include "molsurf/bricks.h"
#include "molsurf/show/io/output_file.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace molsurf
{

/// A file that a plan depends on.
struct PlanInput {
    std::string path;
    std::string sha256;
    std::uint64_t bytes = 0;
};

/// The content of plan.json: what to compute, and how it is cut.
struct PlanManifest {
    std::string program = "vdb_molsurf";
    std::string version; ///< of the program
    std::string input;   ///< the structure
    /// Options of the surface that were given, by name, with their values.
    std::map<std::string, std::vector<std::string>> options;
    std::vector<PlanInput> files; ///< the structure and other files that were read
    double voxel = 0.0;           ///< [Å]
    std::string atomsIndex;       ///< SHA-256 of AtomsFile::index()
    BrickPlan plan;
};

/// The text of plan.json.
std::string manifestText(const PlanManifest& manifest);

void writeManifest(const PlanManifest& manifest, OutputFile& file);

/// @throws Error(ErrorKind::Input) if the file cannot be read or is no plan
PlanManifest readManifest(const std::string& path);

} // namespace molsurf
