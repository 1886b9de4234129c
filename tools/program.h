// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// What differs between the programs that share terminal.h and stop.h; each defines its own.

namespace molsurf::tool
{

/// How messages begin.
extern const char* const programName;

/// What to say when memory runs out.
extern const char* const noMemoryText;

/// Keeps a file that is opened from becoming standard output, if that is closed. What uses a closed
/// stream fails as before.
void holdStandardStreams();

} // namespace molsurf::tool
