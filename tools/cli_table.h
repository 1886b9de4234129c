// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Options as the help shows them, and the tables of the verbs that work brick by brick.

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

struct Group {
    const char* title;
    std::vector<Entry> entries;
};

/// The lines of an option in a help text.
std::string helpLine(const Entry& entry);

/// What plan, brick and merge have in the place of the group Output.
const std::vector<Group>& planGroups();
const std::vector<Group>& brickGroups();
const std::vector<Group>& mergeGroups();

/// "4G", "500M": bytes; 0 if it is neither. K, M, G and T are powers of 1024.
std::size_t parseSize(const std::string& text);

} // namespace molsurf::tool
