// SPDX-License-Identifier: MPL-2.0
/// @file
/// A library for LD_PRELOAD that plays file systems which lack something, or fail. The environment
/// tells which:
///
///     FAULTY_WITHOUT  words of: flock (ENOSYS), renameat2 (EINVAL), link (EPERM), fsync (EIO)
///     FAULTY_EIO      "3": the third renaming fails; "3-": it and all behind it
///     FAULTY_KILL     the number of the change of a name before which the process is killed
///     FAULTY_LOG      a file that gets a line "sync PATH" or "rename PATH" for each

#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace
{

bool without(const char* what)
{
    const char* list = getenv("FAULTY_WITHOUT");
    return list && std::strstr(list, what);
}

template<typename F>
F* original(const char* name, F*)
{
    return reinterpret_cast<F*>(dlsym(RTLD_NEXT, name));
}

void note(const char* what, const char* path)
{
    const char* name = getenv("FAULTY_LOG");
    if (!name) return;
    const int log = open(name, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    dprintf(log, "%s %s\n", what, path);
    close(log);
}

/// To be called before each change of a name.
void changing()
{
    static int changes = 0;
    const char* last = getenv("FAULTY_KILL");
    if (last && ++changes == atoi(last)) raise(SIGKILL);
}

/// Whether a renaming fails.
bool fails(const char* from)
{
    static int renamings = 0;
    changing();
    note("rename", from);
    const char* text = getenv("FAULTY_EIO");
    if (!text) return false;
    const int first = atoi(text);
    const bool now = ++renamings == first || (renamings > first && std::strchr(text, '-'));
    if (now) errno = EIO;
    return now;
}

int fail(int reason)
{
    errno = reason;
    return -1;
}

} // namespace

extern "C" {

int flock(int file, int operation)
{
    return without("flock") ? fail(ENOSYS) : original("flock", flock)(file, operation);
}

int rename(const char* from, const char* to)
{
    return fails(from) ? -1 : original("rename", rename)(from, to);
}

int renameat2(int fromFolder, const char* from, int toFolder, const char* to, unsigned flags)
{
    if (without("renameat2")) return fail(EINVAL);
    return fails(from) ? -1
                       : original("renameat2", renameat2)(fromFolder, from, toFolder, to, flags);
}

int link(const char* from, const char* to)
{
    changing();
    return without("link") ? fail(EPERM) : original("link", link)(from, to);
}

int unlink(const char* path)
{
    changing();
    return original("unlink", unlink)(path);
}

int fsync(int file)
{
    char link[64], path[4096] = "";
    std::snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    const ssize_t size = readlink(link, path, sizeof path - 1);
    if (size > 0) note("sync", path);
    return without("fsync") ? fail(EIO) : original("fsync", fsync)(file);
}
}
