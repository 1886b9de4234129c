// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Identity of a result: the version, the options and the content of the input. Where all are
/// the same, the result is.

#include "cli/call.h"

#include <cstddef>
#include <optional>
#include <string>

namespace molsurf::tool
{

/// The options that results depend on, as they were given, with the hashes of files that they name.
std::string optionsLine(const CommandLine& call);

/// The SHA-256 of the version and the options.
std::string identityOf(const CommandLine& call);

/// The SHA-256 of the content of an input; empty for standard input, pipes, and what cannot be
/// read, as its reader will say.
/// @param[in] maxBytes  that a member of an archive may have; see loadText()
std::string sha256OfInput(const std::string& path, std::size_t maxBytes);

/// The exit status of a run that has made all outputs of a call of the same input, if there was
/// one: its report has the same identity, and no output is newer. Otherwise outputs beside a
/// report may be replaced.
/// @param[in,out] call  has a report among its outputs; it gets `force` if there is a report and
///                      the run is to be made, so that its files are replaced
std::optional<int> statusOfExisting(CommandLine& call);

} // namespace molsurf::tool
