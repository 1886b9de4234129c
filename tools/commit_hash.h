// SPDX-License-Identifier: MPL-2.0
#pragma once

namespace molsurf::tool
{

/// The commit of git that the program was built of, 12 digits, with a + if files had changed; empty
/// if there was no git. cmake/commit_hash.cmake writes it.
extern const char* const commitHash;

} // namespace molsurf::tool
