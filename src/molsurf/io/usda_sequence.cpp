// SPDX-License-Identifier: MPL-2.0
#include "molsurf/io/usda_sequence.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
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
    const char* end = stem.data() + stem.size();
    const auto [stop, problem] = std::from_chars(stem.data() + dot + 1, end, frame);
    if (problem != std::errc() || stop != end || frame < 0) return {stem, {}};
    return {stem.substr(0, dot), frame};
}

UsdVolume usdVolumeOf(const std::string& vdb, bool sequence, double metersPerUnit)
{
    const fs::path path = vdb;
    const FrameName own = frameName(vdb);
    UsdVolume volume{own.stem, metersPerUnit, path.filename().string(), {}};
    if (!sequence || !own.frame) return volume;
    volume.frames.emplace_back(*own.frame, volume.file);
    std::error_code ignored;
    const fs::path folder = path.parent_path().empty() ? "." : path.parent_path();
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
        const FrameName other = frameName(entry.path().string());
        if (entry.path().extension() == path.extension() && other.stem == own.stem && other.frame &&
            *other.frame != *own.frame)
            volume.frames.emplace_back(*other.frame, entry.path().filename().string());
    }
    std::sort(volume.frames.begin(), volume.frames.end());
    return volume;
}

} // namespace molsurf
