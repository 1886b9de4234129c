// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Conditions that a mesh meets before anything is written: --require.

#include "molsurf/mesh.h"
#include "molsurf/report.h"

#include <optional>
#include <string>
#include <vector>

namespace molsurf::tool
{

/// Something that a mesh has to be: a word, and a number for some.
struct Requirement {
    std::string word; ///< "components"
    double value = 0.0;
};

/// The words, with "=" behind those that need a number.
std::vector<std::string> requirementWords();

/// Reads "watertight,components=1". @return nothing if a word or a number is wrong
std::optional<std::vector<Requirement>> parseRequirements(const std::string& text);

/// @throws Error(ErrorKind::Check) that names the first requirement that a mesh does not meet, and
///         what it has instead
void checkRequired(const std::vector<Requirement>& required, const Mesh& mesh,
                   const SurfaceReport& surface);

} // namespace molsurf::tool
