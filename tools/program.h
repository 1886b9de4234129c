// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The main function of all programs, and the differences between them.

#include "molsurf/error.h"

#include <functional>
#include <string>

namespace molsurf::tool
{

/// How messages begin. Each program defines its own.
extern const char* const programName;

/// Message when memory runs out; the same.
extern const char* const noMemoryText;

/// Keeps a file that is opened from becoming standard output, if that is closed. Uses of a closed
/// stream fail as before.
void holdStandardStreams();

/// Prints a text on standard output at once, with what was printed before.
/// @throws Error(ErrorKind::Output) if that cannot be
void printed(const std::string& text);

/// Holds TBB to a number of threads; 0 or less: to none. It is never taken back: TBB would start
/// the other threads then, for the end of the program to stop.
void limitThreads(int threads);

/// The main function: sets the program up, performs, and says what goes wrong in one line.
/// @param[in] perform  returns the exit status where nothing goes wrong
/// @param[in] textOf   what to say of an error
/// @return the exit status
int runProgram(const std::function<int()>& perform,
               const std::function<std::string(const Error&)>& textOf);

} // namespace molsurf::tool
