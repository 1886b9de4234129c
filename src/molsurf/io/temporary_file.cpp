// SPDX-License-Identifier: MPL-2.0
#include "molsurf/io/temporary_file.h"

#include <fcntl.h>
#include <stdio.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <random>
#include <string_view>

namespace molsurf
{

namespace fs = std::filesystem;

namespace
{

/// @param[in] make  makes it and returns its descriptor, or -1
template<typename Make>
int makeLocked(const std::string& name, const Make& make)
{
    for (;;) {
        const int made = make();
        if (made < 0) return -1;
        flock(made, LOCK_EX); // without locks in the file system nobody removes it, either
        if (access(name.c_str(), F_OK) == 0) return made;
        close(made); // another process has locked it first, and removed it
    }
}

} // namespace

const std::string& ownMaker()
{
    static const std::string maker = [] {
        char text[48];
        std::snprintf(text, sizeof text, "%ld-%08x", long(getpid()), std::random_device()());
        return std::string(text);
    }();
    return maker;
}

std::string makerOf(const std::string& name)
{
    // .NAME.PROCESS-RANDOM.part
    constexpr std::string_view ending = ".part", digits = "0123456789",
                               hexadecimal = "0123456789abcdef";
    constexpr std::size_t randomLength = 8;
    if (name.size() <= ending.size() || name[0] != '.' || name.find('/') != std::string::npos ||
        name.compare(name.size() - ending.size(), ending.size(), ending) != 0)
        return "";
    const std::string stem = name.substr(0, name.size() - ending.size());
    const std::size_t dot = stem.rfind('.'), dash = stem.rfind('-');
    if (dot < 2 || dash == std::string::npos || dash < dot + 2) return "";
    const std::string_view process = std::string_view(stem).substr(dot + 1, dash - dot - 1);
    const std::string_view random = std::string_view(stem).substr(dash + 1);
    const bool fits = random.size() == randomLength &&
                      process.find_first_not_of(digits) == process.npos &&
                      random.find_first_not_of(hexadecimal) == random.npos;
    return fits ? stem.substr(dot + 1) : "";
}

std::string followed(const std::string& path)
{
    std::error_code ignored;
    if (!fs::is_symlink(path, ignored)) return path;
    const fs::path real = fs::weakly_canonical(path, ignored);
    return ignored ? path : real.string();
}

std::string folderOf(const std::string& path)
{
    const fs::path folder = fs::path(followed(path)).parent_path();
    return folder.empty() ? "." : folder.string();
}

std::string temporaryName(const std::string& path, const std::string& maker)
{
    const fs::path whole = path;
    return (whole.parent_path() / ("." + whole.filename().string() + "." + maker + ".part"))
        .string();
}

std::string temporaryName(const std::string& path)
{
    return path == "-" ? "" : temporaryName(followed(path), ownMaker());
}

int makeLockedFile(const std::string& name)
{
    return makeLocked(
        name, [&] { return open(name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666); });
}

int makeLockedFolder(const std::string& name)
{
    return makeLocked(name, [&] {
        if (mkdir(name.c_str(), 0700) != 0) return -1;
        return open(name.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    });
}

int lockAbandoned(const std::string& name)
{
    constexpr int flags = O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
    int file = open(name.c_str(), O_RDWR | flags);
    if (file < 0 && errno == EISDIR) file = open(name.c_str(), O_RDONLY | flags);
    if (file < 0) return -1;
    struct stat info;
    const bool ours = fstat(file, &info) == 0 && info.st_uid == geteuid() &&
                      (S_ISREG(info.st_mode) || S_ISDIR(info.st_mode));
    if (ours && flock(file, LOCK_EX | LOCK_NB) == 0 && access(name.c_str(), F_OK) == 0) return file;
    close(file);
    return -1;
}

bool moveFile(const std::string& from, const std::string& to, bool replace)
{
    if (renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), replace ? 0 : RENAME_NOREPLACE) ==
        0)
        return true;
    if (replace || (errno != EINVAL && errno != ENOSYS)) return false;
    struct stat info; // a file system that cannot refuse
    errno = lstat(to.c_str(), &info) == 0 ? EEXIST : 0;
    return errno == 0 && std::rename(from.c_str(), to.c_str()) == 0;
}

void syncFolder(const std::string& folder)
{
    const int opened = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (opened < 0) return;
    fsync(opened);
    close(opened);
}

} // namespace molsurf
