// SPDX-License-Identifier: MPL-2.0
#include "sidecar.h"

#include "molsurf/error.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <optional>
#include <system_error>

namespace molsurf::tool
{

namespace fs = std::filesystem;

namespace
{

// The name of a .vdb: "name.0001.vdb" is frame 1 of "name".
struct FrameName {
    std::string stem;
    std::optional<int> frame;
};

FrameName frameName(const fs::path& path)
{
    const std::string stem = path.stem().string();
    const std::size_t dot = stem.rfind('.');
    if (dot == std::string::npos || dot == 0) return {stem, {}};
    int frame = 0;
    const char* end = stem.data() + stem.size();
    const auto [stop, problem] = std::from_chars(stem.data() + dot + 1, end, frame);
    if (problem != std::errc() || stop != end || frame < 0) return {stem, {}};
    return {stem.substr(0, dot), frame};
}

} // namespace

void addSidecars(Call& call)
{
    std::vector<Output> sidecars;
    for (const Output& output : call.outputs) {
        if (output.format != Format::Vdb) continue;
        if (output.path == "-")
            throw Error(ErrorKind::Usage, "--for usd: expected a file for the .vdb, got -");
        const fs::path path = output.path;
        if (call.verb == Verb::Batch) // its paths are extensions
            sidecars.push_back({".usda", Format::Usda, ""});
        else
            sidecars.push_back({(path.parent_path() / (frameName(path).stem + ".usda")).string(),
                                Format::Usda, output.path});
        const auto same = [&](const Output& o) { return o.path == sidecars.back().path; };
        if (std::count_if(sidecars.begin(), sidecars.end(), same) > 1)
            throw Error(ErrorKind::Usage, "--for usd: two .vdb files would have " +
                                              sidecars.back().path + " beside them");
    }
    call.outputs.insert(call.outputs.end(), sidecars.begin(), sidecars.end());
}

bool mayReplace(const Call& call, const Output& output)
{
    return call.force || (output.format == Format::Usda && !output.of.empty() &&
                          frameName(output.of).frame && isOwnUsda(output.path));
}

UsdVolume usdVolume(const Call& call, const Output& output)
{
    const fs::path vdb =
        output.of.empty() ? fs::path(output.path).replace_extension(".vdb") : fs::path(output.of);
    const FrameName own = frameName(vdb);
    constexpr double angstrom = 1e-10; // [m]
    UsdVolume volume{own.stem, angstrom / call.scene.scale, vdb.filename().string(), {}};
    if (output.of.empty() || !own.frame) return volume;
    volume.frames.emplace_back(*own.frame, volume.file);
    std::error_code ignored;
    const fs::path folder = vdb.parent_path().empty() ? "." : vdb.parent_path();
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
        const FrameName other = frameName(entry.path());
        if (entry.path().extension() == vdb.extension() && other.stem == own.stem && other.frame &&
            *other.frame != *own.frame)
            volume.frames.emplace_back(*other.frame, entry.path().filename().string());
    }
    std::sort(volume.frames.begin(), volume.frames.end());
    return volume;
}

} // namespace molsurf::tool
