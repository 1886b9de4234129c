// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Whether a call has been carried out before.

#include "cli/call.h"

#include <optional>
#include <string>

namespace molsurf::tool
{

/// optionsLine() of the options of a call that results depend on.
std::string optionsLine(const CommandLine& call);

/// The exit status of a run that has made all outputs of a call of the same input, if there was
/// one: its report has the same identity, and no output is newer. Otherwise outputs beside a
/// report may be replaced.
/// @param[in,out] call  has a report among its outputs; it gets `force` if there is a report and
///                      the run is to be made, so that its files are replaced
std::optional<int> statusOfExisting(CommandLine& call);

} // namespace molsurf::tool
