// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/trajectory.h"

#include "molsurf/error.h"
#include "molsurf/molecule/structure/load_text.h"
#include "molsurf/molecule/structure/read_xtc.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>

namespace molsurf
{

Trajectory::Trajectory(const std::string& path) : path_(path)
{
    std::error_code problem;
    if (std::filesystem::is_directory(path, problem)) fail("it is a folder");
    errno = 0;
    file_.open(path, std::ios::binary);
    if (!file_) failBySystem(path_, "cannot be opened");
    size_ = std::filesystem::file_size(path, problem);
    if (problem) fail("cannot be read: " + problem.message());
}

void Trajectory::fail(const std::string& message) const
{
    throw Error(ErrorKind::Input, path_ + ": " + message);
}

std::vector<openvdb::Vec3f> Trajectory::read(std::size_t frame)
{
    std::vector<openvdb::Vec3f> out = load(frame);
    for (std::size_t i = 0; i < out.size(); ++i)
        for (int a = 0; a < 3; ++a)
            if (!(std::abs(out[i][a]) <= 1e6f))
                fail("frame " + std::to_string(frame + 1) + ": atom " + std::to_string(i + 1) +
                     ": expected coordinates from -1e6 to 1e6 Å");
    return out;
}

namespace
{

/// A kind of trajectory, by the first bytes of a file.
struct TrajectoryKind {
    std::string_view begin;
    std::unique_ptr<Trajectory> (*open)(const std::string& path); ///< null: it is refused
    std::string_view name, hint{};                                ///< for people
};

constexpr TrajectoryKind kinds[] = {
    {{"\0\0\7\xc9", 4}, openTrr, "TRR"},
    {"CDF", openNetcdf, "NetCDF"},
    {"\x89HDF\r\n", nullptr, "HDF5", " [hint: MDAnalysis or mdconvert writes FILE.dcd]"},
    {".tng", nullptr, "TNG", " [hint: gmx trjconv writes FILE.xtc]"}}; // by its name alone

} // namespace

std::unique_ptr<Trajectory> openTrajectory(const std::string& path)
{
    if (readsOnce(path)) failAt(path, "is a pipe or a device, expected a trajectory's file");
    if (XtcFile::recognizes(path)) return std::make_unique<XtcFile>(path);
    char bytes[8] = {};
    std::ifstream(path, std::ios::binary).read(bytes, sizeof bytes);
    const std::string_view first(bytes, sizeof bytes), file = path;
    for (const auto& [begin, open, name, hint] : kinds) {
        const bool isNamed =
            file.size() >= begin.size() && file.substr(file.size() - begin.size()) == begin;
        if (first.substr(0, begin.size()) != begin && !isNamed) continue;
        if (open) return open(path);
        failAt(path, "is a trajectory in " + std::string(name) +
                         ", expected DCD, XTC, TRR or NetCDF" + std::string(hint));
    }
    return openDcd(path);
}

} // namespace molsurf
