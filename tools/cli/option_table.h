// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Every option of the program, a row each: the parser, the help texts, the manual, the completion,
/// the metadata of files, the digest of frames and the plan of bricks come from it.

#include "cli/call.h"

#include "molsurf/settings.h"

#include <openvdb/openvdb.h>

#include <string>
#include <vector>

namespace molsurf::tool
{

/// An option of the command line, with the verbs that take it.
using Option = OptionRow<CommandLine>;

/// A command line that people can take as it is printed, and what it makes.
struct Example {
    const char* command;
    const char* text;
};

/// Options under a title.
struct OptionGroup {
    const char* title;
    std::vector<Option> options;
    std::vector<Example> examples = {};
};

/// The whole table.
const std::vector<OptionGroup>& optionTable();

/// The groups that have options of a verb, with these only, and with help and version; Verb(0xff):
/// those of all verbs.
std::vector<OptionGroup> optionGroups(unsigned verb);

/// Whether a name is that of an option, one of before, or its letter.
bool isCalled(const Option& option, const std::string& name);

/// The option of a verb by its name or letter, or null.
const Option* findOption(Verb verb, const std::string& name);

/// A file that is read since an option names it.
struct OptionFile {
    const Option* option;
    std::string path;
};

/// The files that the options of a call name.
std::vector<OptionFile> filesOf(Verb verb, const GivenOptions& given);

/// Adds the options as metadata "option.NAME", and the hashes of the files that they name as
/// "option.NAME.sha256".
void addOptions(const CommandLine& call, openvdb::MetaMap& map);

/// @throws Error(ErrorKind::Usage)
[[noreturn]] void usageError(const std::string& message);

} // namespace molsurf::tool
