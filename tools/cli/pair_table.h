// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// What goes together in a call and what does not, a row each.

#include "cli/call.h"

#include <string>
#include <vector>

namespace molsurf::tool
{

/// What a call may have: an option, one value of an option, or a file of some formats.
struct Thing {
    const char* option; ///< "color", "output"
    const char* value =
        "";             ///< "copy"; empty: any but none. Of a file the table of areas that it has.
    unsigned holds = 0; ///< of an output what it holds, as a set of Holds; 0: anything
    const char* title = nullptr; ///< what messages call it beside what was typed; null: nothing
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
    bool (*unless)(const Call& call) =
        nullptr; ///< calls that the row is not for; null: it is for all
};

/// All of them, in the order in which they are looked at.
const std::vector<Pair>& pairTable();

/// Holds a call against the table.
/// @throws Error(ErrorKind::Usage) that names the first pair that breaks it
void checkPairs(const Call& call);

/// Adds the warnings of rows whose pairing is Pairing::IsFor.
void warnOfPairs(Call& call);

} // namespace molsurf::tool
