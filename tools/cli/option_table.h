// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Every option of the program, a row each: the parser, the help texts, the manual, the completion,
/// the metadata of files, the digest of frames and the plan of bricks come from it.

#include "cli/call.h"

#include "molsurf/kernel/core/strings.h"

#include <openvdb/openvdb.h>

#include <functional>
#include <string>
#include <vector>

namespace molsurf::tool
{

/// One option.
struct Option {
    const char* name;                    ///< "output"
    char letter;                         ///< 'o', or 0
    const char* value;                   ///< what follows it in a help text; nullptr for a switch
    std::string text;                    ///< what --help says of it; '\n' starts a new line
    std::string preset;                  ///< the default as --help shows it; empty for none
    unsigned verbs;                      ///< that take it
    std::vector<std::string> words = {}; ///< the values that are words, for completion
    bool repeats = false;
    /// Sets it.
    /// @throws Error(ErrorKind::Usage) for a value that it cannot have
    std::function<void(CommandLine&, const std::vector<std::string>& values)> set = nullptr;
    /// Its value as metadata of a file; null: it is not stored.
    std::function<openvdb::Metadata::Ptr(const CommandLine&)> stored = nullptr;
    /// Where in a value the path of a file begins that is read; npos: the value names none. Null:
    /// no value does.
    std::function<std::size_t(const std::string& value)> file = nullptr;
    /// The formats that show it, as a set of holds::Content; 0: it is no matter of formats.
    unsigned shownIn = 0;
};

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

/// Whether a name is that of an option, or its letter.
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
