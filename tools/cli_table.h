// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The options of every verb as tables, which the parser, the help texts and the manual read.

#include "cli.h"

#include <cstddef>
#include <string>
#include <vector>

namespace molsurf::tool
{

/// One option: how it is parsed and what --help says of it.
struct Entry {
    const char* name;   ///< "output,o": long name, and short name if there is one
    const char* value;  ///< what follows the option; nullptr for a switch
    std::string text;   ///< '\n' starts a new line
    std::string preset; ///< the default as --help shows it; empty for none
    bool repeats = false;
};

/// Options under a title.
struct Group {
    const char* title;
    std::vector<Entry> entries;
};

/// The groups of Build.
const std::vector<Group>& groups();

/// What batch, plan, brick and merge have in the place of the group Output.
const std::vector<Group>& batchGroups();
const std::vector<Group>& planGroups();
const std::vector<Group>& brickGroups();
const std::vector<Group>& mergeGroups();

/// The groups of a verb, in the order of its help.
std::vector<Group> groupsOf(Verb verb);

/// The same without what the help does not show.
std::vector<Group> shownGroups(Verb verb);

/// "output" of "output,o".
std::string longName(const Entry& entry);

/// What --fields takes, `surface` first.
const std::vector<std::string>& knownFields();

/// What --format takes.
extern const char* const formatWords;

/// A number with the fewest digits that give it back.
std::string shortest(double number);

/// "4G", "500M": bytes; 0 if it is neither. K, M, G and T are powers of 1024.
std::size_t parseSize(const std::string& text);

} // namespace molsurf::tool
