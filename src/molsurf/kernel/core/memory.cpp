// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/core/memory.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace molsurf
{
namespace
{

/// Resident memory of this process [byte]; 0 where the system does not tell it.
double residentMemory()
{
    std::size_t pages = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> pages >> resident;
    return double(resident) * double(sysconf(_SC_PAGE_SIZE));
}

std::size_t mostOf(std::size_t memory)
{
    return memory > 0 ? memory : availableMemory();
}

} // namespace

std::size_t availableMemory()
{
    std::size_t bytes = std::size_t(sysconf(_SC_PHYS_PAGES)) * std::size_t(sysconf(_SC_PAGE_SIZE));
    rlimit limit;
    if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
        bytes = std::min(bytes, std::size_t(limit.rlim_cur));
    std::size_t ofGroup = 0; // "max" where there is none
    if (std::ifstream("/sys/fs/cgroup/memory.max") >> ofGroup) bytes = std::min(bytes, ofGroup);
    return bytes;
}

bool hasMemory(double more, std::size_t memory)
{
    return residentMemory() + more <= double(mostOf(memory));
}

void needMemory(const std::string& what, double more, std::size_t memory)
{
    if (hasMemory(more, memory)) return;
    const double bytes = residentMemory() + more;
    std::string text = what + " about " + sizeText(bytes) + " of memory, and there are " +
                       sizeText(double(mostOf(memory)));
    if (memory > 0)
        text += formatted(" [hint: `memory` %.0fM]", std::ceil(1.1 * bytes / double(1 << 20)));
    throw Error(ErrorKind::Input, text, memory == 0); // another machine may have more
}

void trimHeap()
{
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

} // namespace molsurf
