// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/frame_files.h"

#include "molsurf/kernel/core/strings.h"
#include "molsurf/show/io/read_vdb.h"
#include "molsurf/show/io/usda_text.h"

#include <algorithm>
#include <string_view>
#include <system_error>

namespace molsurf
{

namespace fs = std::filesystem;

FrameName frameName(const std::string& path)
{
    const std::string stem = fs::path(path).stem().string();
    const std::size_t dot = stem.rfind('.');
    if (dot == std::string::npos || dot == 0) return {stem, {}};
    int frame = 0;
    if (!parseWhole(std::string_view(stem).substr(dot + 1), frame) || frame < 0) return {stem, {}};
    return {stem.substr(0, dot), frame};
}

std::string FrameOptions::of(const fs::directory_entry& file)
{
    const std::string path = file.path().string();
    std::error_code ignored;
    const fs::file_time_type time = file.last_write_time(ignored);
    const std::lock_guard lock(mutex_);
    const auto found = known_.find(path);
    if (found != known_.end() && found->second.time == time) return found->second.options;
    const std::string options = file.path().extension() == ".usda"
                                    ? usdaData(path, usdaFrameOptions)
                                    : vdbText(path, "frames.options");
    known_[path] = {time, options};
    return options;
}

FrameFiles framesBeside(const std::string& path, const std::string& options, FrameOptions& known)
{
    const fs::path own = path;
    const FrameName name = frameName(path);
    FrameFiles files{{{name.frame.value_or(0), own.filename().string()}}, {}};
    std::error_code ignored;
    const fs::path folder = own.parent_path().empty() ? "." : own.parent_path();
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
        const FrameName other = frameName(entry.path().string());
        if (entry.path().extension() != own.extension() || other.stem != name.stem ||
            !other.frame || other.frame == name.frame)
            continue;
        const std::string file = entry.path().filename().string();
        if (known.of(entry) == options)
            files.frames.emplace_back(*other.frame, file);
        else
            files.leftOut.push_back(file);
    }
    std::sort(files.leftOut.begin(), files.leftOut.end());
    std::sort(files.frames.begin(), files.frames.end());
    return files;
}

} // namespace molsurf
