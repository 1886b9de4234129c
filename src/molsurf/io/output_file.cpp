// SPDX-License-Identifier: MPL-2.0
#include "molsurf/io/output_file.h"

#include "molsurf/error.h"

#include <fcntl.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <system_error>

namespace molsurf
{

namespace fs = std::filesystem;

namespace
{

// A symbolic link stays one: its target is replaced.
std::string followed(const std::string& path)
{
    std::error_code ignored;
    if (!fs::is_symlink(path, ignored)) return path;
    const fs::path real = fs::weakly_canonical(path, ignored);
    return ignored ? path : real.string();
}

std::string folderOf(const std::string& target)
{
    const fs::path folder = fs::path(target).parent_path();
    return folder.empty() ? "." : folder.string();
}

std::string hint(int reason)
{
    switch (reason) {
    case ENOSPC:
    case EDQUOT:
        return " [hint: free some space, write elsewhere, or take a larger `voxel`]";
    case EACCES:
    case EPERM:
    case EROFS:
        return " [hint: choose a folder you may write to]";
    default:
        return "";
    }
}

[[noreturn]] void refuse(const std::string& path, const std::string& why)
{
    throw Error(ErrorKind::Output, "cannot write " + path + ": " + why);
}

[[noreturn]] void refuseExisting(const std::string& path)
{
    refuse(path, "it exists already [hint: `force` replaces it]");
}

} // namespace

std::string temporaryName(const std::string& path)
{
    if (path == "-") return "";
    const std::string target = followed(path);
    const std::string name = fs::path(target).filename().string();
    const std::string part = "." + name + "." + std::to_string(getpid()) + ".part";
    return (fs::path(target).parent_path() / part).string();
}

void checkWritable(const std::string& path, bool overwrite)
{
    if (path == "-") return;
    const std::string target = followed(path);
    const std::string folder = folderOf(target);
    struct stat info;
    if (stat(folder.c_str(), &info) != 0)
        refuse(path, "folder " + folder + ": " + std::strerror(errno) +
                         (errno == ENOENT ? " [hint: make the folder first]" : ""));
    if (!S_ISDIR(info.st_mode)) refuse(path, folder + " is not a folder");
    if (lstat(target.c_str(), &info) == 0) {
        if (S_ISDIR(info.st_mode)) refuse(path, "it is a folder");
        if (!S_ISREG(info.st_mode) && !S_ISLNK(info.st_mode))
            refuse(path, "it exists and is not a regular file");
        if (!overwrite) refuseExisting(path);
    } else if (errno != ENOENT) {
        refuse(path, std::strerror(errno));
    }
    if (access(folder.c_str(), W_OK | X_OK) != 0)
        refuse(path, "folder " + folder + ": " + std::strerror(errno) + hint(errno));
}

OutputFile::OutputFile(const std::string& path, bool overwrite)
    : path_(path), target_(path == "-" ? path : followed(path)), overwrite_(overwrite)
{
    if (path == "-") {
        std::cout.exceptions(std::ios_base::badbit | std::ios_base::failbit);
        return;
    }
    checkWritable(path, overwrite);
    const std::string name = temporaryName(path);
    unlink(name.c_str()); // left by a process of the same number that was killed
    const int made = open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (made < 0) fail("cannot create");
    close(made);
    temporary_ = name;
    errno = 0;
    file_.open(name, std::ios_base::binary | std::ios_base::in | std::ios_base::out);
    if (!file_) {
        const int reason = errno;
        unlink(name.c_str());
        errno = reason;
        fail("cannot open");
    }
    file_.exceptions(std::ios_base::badbit | std::ios_base::failbit);
}

OutputFile::~OutputFile()
{
    if (!temporary_.empty()) unlink(temporary_.c_str());
    file_.exceptions(std::ios_base::goodbit); // closing may fail again, and nobody cares now
}

std::ostream& OutputFile::stream()
{
    return seekable() ? static_cast<std::ostream&>(file_) : std::cout;
}

void OutputFile::write(const void* bytes, std::size_t size)
{
    try {
        stream().write(static_cast<const char*>(bytes), std::streamsize(size));
    } catch (const std::ios_base::failure&) {
        fail("cannot write");
    }
}

void OutputFile::finish()
{
    if (finished_) return;
    try {
        stream().flush();
        if (seekable()) file_.close();
    } catch (const std::ios_base::failure&) {
        fail("cannot write");
    }
    finished_ = true;
}

void OutputFile::commit()
{
    finish();
    if (!seekable()) return;
    int status = renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, target_.c_str(),
                           overwrite_ ? 0 : RENAME_NOREPLACE);
    if (status != 0 && (errno == EINVAL || errno == ENOSYS)) { // a file system that cannot refuse
        checkWritable(path_, overwrite_);
        status = rename(temporary_.c_str(), target_.c_str());
    }
    if (status != 0 && errno == EEXIST) refuseExisting(path_);
    if (status != 0) fail("cannot rename");
    temporary_.clear();
}

void OutputFile::fail(const char* step) const
{
    const int reason = errno;
    const std::string name = path_ == "-" ? "standard output" : path_;
    throw Error(ErrorKind::Output, std::string(step) + " " + name + ": " +
                                       (reason ? std::strerror(reason) : "unknown reason") +
                                       hint(reason));
}

} // namespace molsurf
