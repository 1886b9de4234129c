// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The run that wrote a report.

#include <optional>
#include <string>

namespace molsurf
{

struct KnownRun {
    std::string options; ///< SHA-256 of version and options; empty if it is not known
    std::string input;   ///< SHA-256 of the input; the same
    bool converged = true;
};

/// Nothing if the file is no report of this program.
std::optional<KnownRun> readReport(const std::string& path);

} // namespace molsurf
