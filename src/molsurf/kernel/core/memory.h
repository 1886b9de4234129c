// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Memory that there is, and that is taken.

#include <cstddef>
#include <string>

namespace molsurf
{

/// Memory that a process on this machine may have: all of it, or the limit of the control group or
/// of `ulimit -v` [byte].
std::size_t availableMemory();

/// Whether a step that takes so much beside what the process takes already stays within its memory.
/// @param[in] more,memory  as for needMemory()
bool hasMemory(double more, std::size_t memory);

/// Refuses to go on where a step is estimated to take more memory than there is, beside what the
/// process takes already.
/// @param[in] what    "m.cif: reading it takes", for example
/// @param[in] more    that the step takes [byte]
/// @param[in] memory  that the process may take [byte]; 0: availableMemory()
/// @throws Error(ErrorKind::Input) with both numbers
void needMemory(const std::string& what, double more, std::size_t memory);

/// Gives memory that was freed back to the system where it is more than 16 MiB: the allocator keeps
/// what many small pieces leave. To get less anew would take longer than it is worth.
void trimHeap();

} // namespace molsurf
