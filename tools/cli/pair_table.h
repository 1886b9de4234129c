// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Options that need or exclude each other, a row each.

#include "cli/call.h"

#include <vector>

namespace molsurf::tool
{

/// A part of a call: an option, one value of an option, or a file of some formats.
struct Thing {
    /// @param[in] typed  "color", or with a value "color=copy"
    Thing(const char* typed, const char* name = nullptr) : words(typed), title(name) {}
    /// @param[in] some   what the file holds, as a set of holds::Content
    /// @param[in] table  the table of areas that it has; "": any or none
    Thing(holds::Content some, const char* table = "", const char* name = nullptr)
        : words(table), title(name), holds(some)
    {
    }

    const char* words;
    const char* title; ///< what messages call it beside what was typed; null: nothing
    unsigned holds = 0;
};

/// How the first thing of a row goes with the others.
enum Pairing {
    Needs,    ///< A call has to have one of them, too.
    Excludes, ///< A call may have none of them.
    IsFor     ///< It changes nothing without one of them, of which the call warns.
};

/// A row.
struct Pair {
    Thing thing;
    Pairing pairing;
    std::vector<Thing> others;
    const char* why = ""; ///< the end of the message, or all of what it is for
    bool (*unless)(const CommandLine& call) =
        nullptr; ///< calls that the row is not for; null: it is for all
};

/// All of them, in the order in which they are looked at.
const std::vector<Pair>& pairTable();

/// Holds a call against the table.
/// @throws Error(ErrorKind::Usage) that names the first pair that breaks it
void checkPairs(const CommandLine& call);

/// Adds the warnings of rows whose pairing is Pairing::IsFor.
void warnOfPairs(CommandLine& call);

} // namespace molsurf::tool
