// SPDX-License-Identifier: MPL-2.0
#include "molsurf/structure/trajectory.h"

#include "molsurf/error.h"
#include "molsurf/structure/load_text.h"
#include "molsurf/structure/read_xtc.h"
#include "molsurf/structure/text_fields.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>

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

std::unique_ptr<Trajectory> openTrajectory(const std::string& path)
{
    if (readsOnce(path)) failAt(path, "is a pipe or a device, expected a trajectory's file");
    if (XtcFile::recognizes(path)) return std::make_unique<XtcFile>(path);
    return openDcd(path);
}

} // namespace molsurf
