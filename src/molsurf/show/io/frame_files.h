// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The numbered files of a sequence, name.0001.vdb and name.0002.vdb or .usda.

#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace molsurf
{

/// The name of a file without folder and extension: "name.0001.vdb" is frame 1 of "name".
struct FrameName {
    std::string stem;
    std::optional<int> frame;
};
FrameName frameName(const std::string& path);

/// The `frames.options` of files, each of which is read once while it does not change. May be asked
/// from several threads.
class FrameOptions
{
public:
    /// Empty of a file that runs of their own have made.
    std::string of(const std::filesystem::directory_entry& file);

private:
    struct Known {
        std::filesystem::file_time_type time;
        std::string options;
    };
    std::mutex mutex_;
    std::map<std::string, Known> known_;
};

/// The files of a sequence.
struct FrameFiles {
    std::vector<std::pair<int, std::string>> frames; ///< names without folder, the first one first
    std::vector<std::string> leftOut;                ///< of another sequence, by name
};

/// The frame of a path that ends in a number, which may not be there yet, and the others in its
/// folder that have its name and extension.
///
/// @param[in] options  `frames.options` of those that belong to it
FrameFiles framesBeside(const std::string& path, const std::string& options, FrameOptions& known);

} // namespace molsurf
