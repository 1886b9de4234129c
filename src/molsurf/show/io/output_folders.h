// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Folders that files need.

#include <string>
#include <vector>

namespace molsurf
{

/// Makes folders; those that are empty when it goes are removed again.
class MadeFolders
{
public:
    MadeFolders() = default;
    MadeFolders(const MadeFolders&) = delete;
    MadeFolders& operator=(const MadeFolders&) = delete;
    ~MadeFolders();

    /// Makes a folder and those that it lies in, unless they exist.
    /// @throws Error(ErrorKind::Output) if that fails
    void make(const std::string& folder);

    /// Those that did not exist, each before the one that it lies in.
    const std::vector<std::string>& made() const { return made_; }

private:
    std::vector<std::string> made_;
};

} // namespace molsurf
