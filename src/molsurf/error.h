// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The one exception of the library.

#include <stdexcept>
#include <string>

namespace molsurf
{

/// What went wrong, as far as a caller can act on it.
enum class ErrorKind {
    Usage,   ///< an option has a value that is wrong whatever the files hold
    Input,   ///< a file cannot be read, or does not hold what it should
    Numeric, ///< the computation has no answer: no surface, not a number
    Output,  ///< a file cannot be written
    Check,   ///< a result contradicts itself: two ways to the same number disagree
};

/// Thrown at the entry points of the stages, never inside a kernel. The message names the step or
/// the file, what was expected and what was found, in one line without a final full stop. Options
/// stand in it as their members are called, in backticks: "`voxel`: expected 0.05 to 10 Å, got 20".
class Error : public std::runtime_error
{
public:
    Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}

    ErrorKind kind() const { return kind_; }

private:
    ErrorKind kind_;
};

} // namespace molsurf
