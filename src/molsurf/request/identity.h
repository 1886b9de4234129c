// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Identity of a result: the version, the options and the content of the input. Where all are the
/// same, the result is.

#include "molsurf/atoms.h"
#include "molsurf/settings.h"

#include <string>
#include <vector>

namespace molsurf
{

/// An option that a result depends on, as it was given.
struct GivenOption {
    std::string name;
    std::vector<std::string> values;
    std::vector<std::string> files; ///< that the values name, and the result depends on
};

/// An option with the files that its values name, if files keep its value: those of trajectories
/// are not read once more.
template<typename To>
GivenOption givenOption(const OptionRow<To>& row, const std::vector<std::string>& values)
{
    GivenOption given{row.name, values, {}};
    if (!row.get || !row.file) return given;
    for (const std::string& value : values)
        if (const auto path = row.file(value); !path.empty()) given.files.emplace_back(path);
    return given;
}

/// The options as one types them, with the first 16 digits of the SHA-256 of each file that they
/// name.
/// @param[in] given  in an order that the same request always has
/// @throws Error(ErrorKind::Input) if such a file cannot be read
std::string optionsLine(const std::vector<GivenOption>& given);

/// The SHA-256 of the version and a line of options: `options_sha256` of reports.
std::string identityOf(const std::string& optionsLine);

/// The SHA-256 of the file that balls were read from; empty if they are from another source.
std::string inputSha256(const SelectionRecord& record);

} // namespace molsurf
