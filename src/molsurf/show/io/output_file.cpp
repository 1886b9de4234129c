// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/output_file.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/transient_error.h"
#include "molsurf/show/io/commit.h"
#include "molsurf/show/io/temporary_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>

namespace molsurf
{

namespace fs = std::filesystem;

namespace
{

/// What may help against an error of the system, by its errno; empty: not known.
std::string hint(const std::string& path, int reason)
{
    switch (reason) {
    case ENOSPC:
    case EDQUOT:
        return " [hint: free some space, write elsewhere, or take a larger `voxel`]";
    case EACCES:
    case EPERM:
    case EROFS:
        return " [hint: choose a folder you may write to]";
    case ENOENT: { // of a folder that is there only the system knows why
        const fs::path folder = fs::path(path).parent_path();
        std::error_code ignored;
        const bool there = folder.empty() || fs::is_directory(folder, ignored);
        if (path.find("://") != std::string::npos)
            return " [hint: it is an address; aws s3 cp - ADDRESS or the like takes standard "
                   "output]";
        return there ? "" : " [hint: make the folder first]";
    }
    case ENAMETOOLONG:
        return " [hint: a shorter name]";
    default:
        return "";
    }
}

[[noreturn]] void refuse(const std::string& path, const std::string& why)
{
    throw Error(ErrorKind::Output, "cannot write " + path + ": " + why);
}

/// The same for what the system refuses with an errno.
[[noreturn]] void refuse(const std::string& path, const std::string& what, int reason)
{
    throw Error(ErrorKind::Output,
                "cannot write " + path + ": " + what + std::strerror(reason) + hint(path, reason),
                mayPass(reason));
}

[[noreturn]] void refuseExisting(const std::string& path)
{
    refuse(path, "it exists already [hint: `force` replaces it]");
}

/// Gives a file a second name; where a file system knows no such thing, only that one.
bool alsoNamed(const std::string& path, const std::string& name)
{
    return link(path.c_str(), name.c_str()) == 0 || (errno != ENOENT && moveFile(path, name, true));
}

} // namespace

bool isStream(const std::string& path)
{
    std::error_code ignored;
    return path == "-" || fs::is_fifo(path, ignored);
}

void checkWritable(const std::string& path, bool overwrite)
{
    if (isStream(path)) {
        if (path != "-" && access(path.c_str(), W_OK) != 0) refuse(path, "", errno);
        return;
    }
    const std::string target = followed(path), folder = folderOf(path);
    struct stat info;
    if (stat(folder.c_str(), &info) != 0) refuse(path, "folder " + folder + ": ", errno);
    if (!S_ISDIR(info.st_mode)) refuse(path, folder + " is not a folder");
    if (lstat(target.c_str(), &info) == 0) {
        if (S_ISDIR(info.st_mode)) refuse(path, "it is a folder");
        if (!S_ISREG(info.st_mode) && !S_ISLNK(info.st_mode))
            refuse(path, "it exists and is not a regular file");
        if (!overwrite) refuseExisting(path);
    } else if (errno != ENOENT) {
        refuse(path, "", errno);
    }
    if (lstat(temporaryName(path).c_str(), &info) != 0 && errno != ENOENT) // its name is longer
        refuse(path, "", errno);
    if (access(folder.c_str(), W_OK | X_OK) != 0) refuse(path, "folder " + folder + ": ", errno);
}

OutputFile::OutputFile(const std::string& path, bool overwrite)
    : path_(path), target_(followed(path)), replaces_(overwrite)
{
    if (path == "-") {
        std::cout.exceptions(std::ios_base::badbit | std::ios_base::failbit);
        return;
    }
    checkWritable(path, overwrite);
    if (isStream(path)) {
        const int opened = open(path.c_str(), O_WRONLY | O_CLOEXEC); // waits for its reader
        if (opened < 0) fail("cannot open");
        buffer_ = __gnu_cxx::stdio_filebuf<char>(opened, std::ios_base::out);
    } else {
        const std::string name = temporaryName(path);
        const int made = makeLockedFile(name);
        if (made < 0) fail("cannot create");
        temporary_ = name;
        buffer_ = __gnu_cxx::stdio_filebuf<char>(made, std::ios_base::in | std::ios_base::out);
    }
    file_.rdbuf(&buffer_);
    file_.exceptions(std::ios_base::badbit | std::ios_base::failbit);
}

OutputFile::~OutputFile()
{
    if (seekable() && !placed_) unlink(temporary_.c_str());
}

std::ostream& OutputFile::stream()
{
    return path_ == "-" ? std::cout : file_;
}

void OutputFile::write(const void* bytes, std::size_t size)
{
    try {
        stream().write(static_cast<const char*>(bytes), std::streamsize(size));
    } catch (const std::ios_base::failure&) {
        fail("cannot write");
    }
}

FileDescriptor OutputFile::again()
{
    const std::string self = "/proc/self/fd/" + std::to_string(buffer_.fd());
    FileDescriptor out(open(self.c_str(), O_RDWR | O_CLOEXEC));
    if (!out) fail("cannot open");
    return out;
}

bool OutputFile::isWhole()
{
    struct stat own, named;
    return fstat(buffer_.fd(), &own) == 0 && lstat(temporary_.c_str(), &named) == 0 &&
           own.st_size > 0 && own.st_dev == named.st_dev && own.st_ino == named.st_ino;
}

void OutputFile::finish()
{
    if (finished_) return;
    try {
        stream().flush();
    } catch (const std::ios_base::failure&) {
        fail("cannot write");
    }
    const bool unable = seekable() && fsync(buffer_.fd()) != 0;
    if (unable && errno != EINVAL && errno != ENOSYS) fail("cannot write");
    finished_ = true;
}

void OutputFile::place(bool keeping)
{
    if (keeping && replaces_) {
        hasOld_ = alsoNamed(target_, keptName(target_));
        if (!hasOld_ && errno != ENOENT) fail("cannot rename");
    }
    placed_ = moveFile(temporary_, target_, replaces_);
    if (!placed_ && errno == EEXIST) refuseExisting(path_);
    if (!placed_) fail("cannot rename");
}

bool OutputFile::takeBack()
{
    // The new file has its temporary name again before the old one comes back: while there is a
    // record of the commit, recover() would put it in its place.
    const bool free = !placed_ || (hasOld_ ? alsoNamed(target_, temporary_)
                                           : moveFile(target_, temporary_, false));
    if (!free || (hasOld_ && !moveFile(keptName(target_), target_, true))) return false;
    placed_ = false;
    dropOld(); // which is there if it had two names
    return true;
}

void OutputFile::dropOld()
{
    if (hasOld_) unlink(keptName(target_).c_str());
    hasOld_ = false;
}

void OutputFile::commit()
{
    molsurf::commit({this});
}

void OutputFile::fail(const char* step) const
{
    const int reason = errno;
    const std::string name = path_ == "-" ? "standard output" : path_;
    const std::string message = std::string(step) + " " + name + ": " +
                                (reason ? std::strerror(reason) : "unknown reason") +
                                hint(path_, reason);
    if (reason == EPIPE) throw NoReader(message);
    throw Error(ErrorKind::Output, message, mayPass(reason));
}

} // namespace molsurf
