// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// From the words of a command line to a call, or to a help text about verbs and options.

#include "cli/call.h"

#include <optional>
#include <string>

namespace molsurf::tool
{

/// A call, or a text to print in its place: help, version and the like.
struct Parsed {
    std::optional<CommandLine> call;
    std::string text;
};

/// @throws Error(ErrorKind::Usage) if the command line is wrong
/// @throws Error(ErrorKind::Input) if the file of --config cannot be read
Parsed parse(int argc, const char* const* argv);

/// Sets options of a call; the order of their names does not matter.
/// @throws Error(ErrorKind::Usage) for a value that an option cannot have
void setOptions(const GivenOptions& given, CommandLine& call);

// help.cpp: the texts, all made of the tables of verbs and options.

/// All verbs, or those of a first word ("bricks"), a line each.
std::string overview(const std::string& first = "");

/// The text of --help for a verb: its common options, or that of --help-all.
std::string helpText(Verb verb, bool all);

/// The options of a group, or one option, with examples; empty if the word names neither.
/// @param[in] word  of small letters: "pockets", "voxel"
std::string topicText(const std::string& word);

/// The words of topicText(): titles of groups and names of options.
std::vector<std::string> topicWords();

/// The manual page, for man.
std::string manPage();

/// The options of all verbs as Markdown: docs/options.md.
std::string optionsPage();

// completion.cpp: what shells offer for the word under the cursor.

std::string bashCompletion();
std::string zshCompletion();
std::string fishCompletion();

} // namespace molsurf::tool
