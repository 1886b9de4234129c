// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <algorithm>
#include <cerrno>
#include <iterator>

namespace molsurf
{

/// Whether what the system refuses with this errno may go well when the same is tried again: space,
/// memory, descriptors or a lock were missing, or a disk or network failed.
inline bool mayPass(int systemError)
{
    constexpr int passing[] = {
        ENOSPC,   EDQUOT,      ENOMEM,    ENOBUFS,      EMFILE,     ENFILE,    EAGAIN, EINTR,
        EBUSY,    ETXTBSY,     ENOLCK,    EDEADLK,      EIO,        EREMOTEIO, ESTALE, ETIMEDOUT,
        ENETDOWN, ENETUNREACH, EHOSTDOWN, EHOSTUNREACH, ECONNRESET, ENOTCONN};
    return std::find(std::begin(passing), std::end(passing), systemError) != std::end(passing);
}

} // namespace molsurf
