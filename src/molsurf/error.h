// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The exception that the library throws, and the kinds of errors that it tells apart.

#include <stdexcept>
#include <string>

namespace molsurf
{

/// The kinds of errors, as far as a caller can act on them.
enum class ErrorKind {
    Usage,   ///< An option has a value that is wrong whatever the files hold.
    Input,   ///< A file cannot be read, or it does not hold what it should.
    Numeric, ///< The computation has no answer: there is no surface, or a value is not finite.
    Output,  ///< A file cannot be written.
    Check,   ///< A result contradicts itself: two ways to the same number disagree.
};

/// Every error of the library is of this class. The message is one line without a final full stop.
/// It names the step or the file, what was expected and what was found. It names an option by its
/// member, in backticks: "`voxel`: expected 0.05 to 10 Å, got 20".
class Error : public std::runtime_error
{
public:
    Error(ErrorKind kind, const std::string& message, bool mayPass = false)
        : std::runtime_error(message), kind_(kind), mayPass_(mayPass)
    {
    }

    /// The same error in other words.
    Error(const Error& error, const std::string& message)
        : Error(error.kind_, message, error.mayPass_)
    {
    }

    /// Tells what kind of error it is.
    ErrorKind kind() const { return kind_; }

    /// Tells whether the same call may go well later, or where there is more memory or space.
    bool mayPass() const { return mayPass_; }

private:
    ErrorKind kind_;
    bool mayPass_;
};

} // namespace molsurf
