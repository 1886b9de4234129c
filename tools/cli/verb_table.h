// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Every verb of the program, a row each.

#include "cli/option_table.h"

#include <chrono>
#include <vector>

namespace molsurf::tool
{

/// One verb.
struct VerbInfo {
    Verb verb;
    const char* name;              ///< "compare", "bricks plan"
    const char* synopsis;          ///< what follows the name
    const char* text;              ///< what it does, one line for the manual and the list of verbs
    const char* more;              ///< further lines of its help text; may be empty
    const char* status;            ///< what exit status 3 says of it; empty if it has none
    std::vector<Example> examples; ///< may be empty
    /// Makes what is meant of what was given, and refuses what makes no sense.
    /// @throws Error(ErrorKind::Usage)
    void (*complete)(CommandLine& call);
    /// @return the exit status
    int (*perform)(const CommandLine& call, std::chrono::steady_clock::time_point start);
};

/// All of them; the first one is the verb of a command line without one.
const std::vector<VerbInfo>& verbTable();

const VerbInfo& infoOf(Verb verb);

} // namespace molsurf::tool
