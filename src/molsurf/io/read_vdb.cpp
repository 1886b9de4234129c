// SPDX-License-Identifier: MPL-2.0
#include "molsurf/io/read_vdb.h"

#include "molsurf/core/error.h"

#include <openvdb/io/File.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace molsurf
{

namespace
{

[[noreturn]] void refuse(const std::string& path, const std::string& why)
{
    throw Error(ErrorKind::Input, "cannot read " + path + ": " + why);
}

} // namespace

VdbFile readVdb(const std::string& path)
{
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) refuse(path, "it is a folder");
    errno = 0;
    if (!std::ifstream(path)) refuse(path, std::strerror(errno));
    try {
        openvdb::io::File file(path);
        file.open(false); // load now: a file that is cut short must show here
        VdbFile content;
        content.grids = *file.getGrids();
        content.metadata = *file.getMetadata();
        return content;
    } catch (const openvdb::Exception& e) {
        refuse(path, std::string("not a .vdb file, or damaged (") + e.what() + ")");
    } catch (const std::ios_base::failure&) {
        refuse(path, "not a .vdb file, or damaged");
    }
}

} // namespace molsurf
