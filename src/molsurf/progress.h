// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The object by which a caller follows a run and stops it.

#include "molsurf/error.h"

#include <exception>

namespace molsurf
{

/// Receives the progress of a run. The base class ignores it and never cancels.
class Progress
{
public:
    virtual ~Progress() = default;

    /// The library calls this from the thread that called it, as the work goes on.
    /// @param[in] stage     the name of the stage, for example "evolve"; a string literal
    /// @param[in] fraction  the part of this stage that is done, in [0, 1]
    virtual void update(const char* stage, double fraction)
    {
        static_cast<void>(stage);
        static_cast<void>(fraction);
    }

    /// Returns true once the caller wants the run to stop. The library calls this from all of its
    /// threads at the same time, so it must be safe to do so.
    virtual bool cancelled() const { return false; }
};

/// A stage throws this when Progress::cancelled() returns true. It is not an Error, since nothing
/// went wrong.
class Cancelled : public std::exception
{
public:
    const char* what() const noexcept override { return "cancelled"; }
};

} // namespace molsurf
