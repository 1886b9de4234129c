// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// How the programs end, a row each: the help texts and the manual have this table, and a test
/// holds docs/settings.md against it.

#include "molsurf/error.h"

#include <array>

namespace molsurf::tool
{

constexpr int doneStatus = 0;
constexpr int failedStatus = 1;
constexpr int misusedStatus = 2;

/// Of a run that did not converge; the files are written all the same.
constexpr int notConvergedStatus = 3;

/// Of a run whose result failed its own checks; no file is written.
constexpr int failedCheckStatus = 3;

/// Of a run that may go well later, or where there is more memory or space: EX_TEMPFAIL of
/// sysexits.h, by which engines know what to start again.
constexpr int laterStatus = 75;

constexpr int interruptedStatus = 130;

/// Of a run whose output nobody reads any more, as a shell sees it: it ends by SIGPIPE.
constexpr int readerGoneStatus = 141;

/// A row.
struct ExitStatus {
    int status;
    const char* text;
};

/// All that every verb may have, in order; only some have 3.
constexpr std::array<ExitStatus, 6> exitStatuses = {
    {{doneStatus, "done"},
     {failedStatus, "failed"},
     {misusedStatus, "wrong usage"},
     {laterStatus, "failed; try again later (memory, space, a disk's error)"},
     {interruptedStatus, "interrupted"},
     {readerGoneStatus, "nobody reads its output any more"}}};

/// The exit status of an error.
inline int statusOf(const Error& error)
{
    if (error.mayPass()) return laterStatus;
    if (error.kind() == ErrorKind::Usage) return misusedStatus;
    return error.kind() == ErrorKind::Check ? failedCheckStatus : failedStatus;
}

} // namespace molsurf::tool
