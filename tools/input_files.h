// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The files that a call reads, none of which it may replace: its inputs, and all that the table of
/// options says that their values name.

#include "cli/call.h"

#include <sys/types.h>

#include <map>
#include <string>
#include <utility>

namespace molsurf::tool
{

/// Refuses a path that names no file that can hold atoms, with what people do who meet it first: a
/// name of the Protein Data Bank, an address, a folder.
/// @throws Error(ErrorKind::Input)
void failIfNoFile(const std::string& path);

/// Refuses standard input, a pipe or a device where a file is read twice.
/// @param[in] expected  what it has to be, as "the file of a plan"
/// @throws Error(ErrorKind::Input)
void failIfStream(const std::string& path, const std::string& expected);

/// The files that a call reads, none of which it may replace.
class InputFiles
{
public:
    explicit InputFiles(const CommandLine& call);

    void add(const std::string& path);

    /// @throws Error(ErrorKind::Output) if an output is one of them, by whatever name
    void refuse(const std::string& output) const;

private:
    std::map<std::pair<dev_t, ino_t>, std::string> names_;
};

} // namespace molsurf::tool
