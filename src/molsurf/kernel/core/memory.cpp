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

/// Memory of this process [byte]; 0 where the system does not give it.
struct ProcessMemory {
    std::size_t mapped = 0;   ///< all of its addresses: libraries, stacks and heaps, too
    std::size_t resident = 0; ///< what of it is in memory
};

ProcessMemory processMemory()
{
    ProcessMemory memory;
    std::ifstream("/proc/self/statm") >> memory.mapped >> memory.resident;
    const std::size_t page = std::size_t(sysconf(_SC_PAGE_SIZE));
    return {page * memory.mapped, page * memory.resident};
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
    if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
        // It counts addresses: what is mapped and not in memory is left out.
        const ProcessMemory memory = processMemory();
        const std::size_t unused = memory.mapped - std::min(memory.mapped, memory.resident);
        bytes = std::min(bytes, limit.rlim_cur - std::min<std::size_t>(limit.rlim_cur, unused));
    }
    std::size_t ofGroup = 0; // "max" where there is none
    if (std::ifstream("/sys/fs/cgroup/memory.max") >> ofGroup) bytes = std::min(bytes, ofGroup);
    return bytes;
}

bool hasMemory(double more, std::size_t memory)
{
    return double(processMemory().resident) + more <= double(mostOf(memory));
}

void needMemory(const std::string& what, double more, std::size_t memory)
{
    if (hasMemory(more, memory)) return;
    const double bytes = double(processMemory().resident) + more;
    std::string text = what + " about " + sizeText(bytes) + " of memory, and there are " +
                       sizeText(double(mostOf(memory)));
    if (memory > 0)
        text += formatted(" [hint: `memory` %.0fM]", std::ceil(1.1 * bytes / double(1 << 20)));
    throw Error(ErrorKind::Input, text, memory == 0); // another machine may have more
}

void trimHeap()
{
#ifdef __GLIBC__
    if (mallinfo2().fordblks > std::size_t(16) << 20) malloc_trim(0);
#endif
}

} // namespace molsurf
