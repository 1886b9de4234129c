// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/temporary_file.h"

#include "molsurf/kernel/core/strings.h"

#include <fcntl.h>
#include <stdio.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

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

std::string tagOf(const std::string& text)
{
    const unsigned long sum = crc32_z(0, reinterpret_cast<const Bytef*>(text.data()), text.size());
    return formatted("%08lx", sum & 0xffffffff);
}

std::string lineOf(const std::string& path)
{
    std::ifstream file(path);
    std::string line;
    std::getline(file, line);
    return line;
}

/// When a process has started, counted from the boot of the machine; empty if it is gone.
std::string startOf(const std::string& process)
{
    // PROCESS (NAME) STATE and 18 more words, then the start; a name may hold anything.
    const std::string line = lineOf("/proc/" + process + "/stat");
    std::istringstream words(line.substr(std::min(line.rfind(')'), line.size() - 1) + 1));
    std::string state, word;
    words >> state;
    for (int i = 0; i < 19; ++i) words >> word;
    return words && state != "Z" && state != "X" ? word : "";
}

/// The maker that a process of this machine is.
std::string makerOfProcess(const std::string& process)
{
    static const std::string machine = [] {
        char host[256] = "";
        gethostname(host, sizeof host - 1);
        std::error_code ignored;
        return tagOf(host + lineOf("/etc/machine-id") +
                     fs::read_symlink("/proc/self/ns/pid", ignored).string());
    }();
    static const std::string boot = lineOf("/proc/sys/kernel/random/boot_id");
    return process + "-" + machine + tagOf(boot + startOf(process));
}

/// Whether a process of this machine has ended: its number is free, or that of one with another
/// start, so that the last tag differs and all before it is the same. False for another machine.
bool isGone(const std::string& maker)
{
    constexpr std::size_t tag = 8;
    const std::string process = maker.substr(0, maker.find('-'));
    const std::string now = makerOfProcess(process);
    return maker != now && maker.size() == now.size() &&
           maker.compare(0, maker.size() - tag, now, 0, now.size() - tag) == 0 &&
           !startOf("self").empty();
}

/// ".NAME.MAKER" + ending, beside a file of a path.
std::string hiddenName(const fs::path& path, const std::string& maker, const char* ending)
{
    return (path.parent_path() / ("." + path.filename().string() + "." + maker + ending)).string();
}

constexpr const char *partEnding = ".part", *oldEnding = ".old";

} // namespace

const std::string& ownMaker()
{
    static const std::string maker = makerOfProcess(std::to_string(getpid()));
    return maker;
}

bool isMaker(const std::string& text)
{
    constexpr std::size_t tags = 16;
    const std::size_t dash = text.find('-');
    return dash != 0 && dash != text.npos && text.size() == dash + 1 + tags &&
           text.find_first_not_of("0123456789") == dash &&
           text.find_first_not_of("0123456789abcdef", dash + 1) == text.npos;
}

std::string makerOf(const std::string& name)
{
    for (const std::string ending : {partEnding, oldEnding}) {
        if (name.size() <= ending.size() || name[0] != '.' ||
            name.compare(name.size() - ending.size(), ending.size(), ending) != 0)
            continue;
        const std::string stem = name.substr(0, name.size() - ending.size());
        const std::size_t dot = stem.rfind('.');
        if (dot >= 2 && isMaker(stem.substr(dot + 1))) return stem.substr(dot + 1);
    }
    return "";
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
    return hiddenName(path, maker, partEnding);
}

std::string keptName(const std::string& path)
{
    return hiddenName(path, ownMaker(), oldEnding);
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

FileDescriptor openOwn(const std::string& name)
{
    constexpr int flags = O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
    FileDescriptor file(open(name.c_str(), O_RDWR | flags));
    if (!file && errno == EISDIR) file = FileDescriptor(open(name.c_str(), O_RDONLY | flags));
    struct stat info;
    const bool ours = file && fstat(file.get(), &info) == 0 && info.st_uid == geteuid() &&
                      (S_ISREG(info.st_mode) || S_ISDIR(info.st_mode));
    return ours ? std::move(file) : FileDescriptor();
}

FileDescriptor lockAbandoned(const std::string& name, const std::string& maker)
{
    FileDescriptor file = openOwn(name);
    if (!file) return file;
    // A free lock proves it on every machine. Without locks the maker is looked up on this one.
    const bool free =
        flock(file.get(), LOCK_EX | LOCK_NB) == 0 || (errno != EWOULDBLOCK && isGone(maker));
    return free && access(name.c_str(), F_OK) == 0 ? std::move(file) : FileDescriptor();
}

bool moveFile(const std::string& from, const std::string& to, bool replace)
{
    if (!replace) {
        if (renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0)
            return true;
        if (errno != EINVAL && errno != ENOSYS) return false;
        struct stat info; // a file system that cannot refuse
        errno = lstat(to.c_str(), &info) == 0 ? EEXIST : 0;
        if (errno != 0) return false;
    }
    return std::rename(from.c_str(), to.c_str()) == 0;
}

void syncFolder(const std::string& folder)
{
    const FileDescriptor opened(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (opened) fsync(opened.get());
}

} // namespace molsurf
