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

/// Refuses a plan that is no regular file: it is read twice, and a device has no end.
/// @throws Error(ErrorKind::Input)
void failIfNoPlan(const std::string& path);

/// The files that a call reads, none of which it may replace.
class InputFiles
{
public:
    explicit InputFiles(const Call& call);

    void add(const std::string& path);

    /// @throws Error(ErrorKind::Output) if an output is one of them, by whatever name
    void refuse(const std::string& output) const;

private:
    std::map<std::pair<dev_t, ino_t>, std::string> names_;
};

} // namespace molsurf::tool
