// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// How the library tells how far it is, and how it is asked to stop.

#include "molsurf/error.h"

#include <exception>

namespace molsurf
{

/// Receives the progress of a run. The base class ignores it and never cancels.
class Progress
{
public:
    virtual ~Progress() = default;

    /// Called from the thread that runs the pipeline.
    /// @param[in] stage     name of the stage, for example "evolve"; a literal
    /// @param[in] fraction  done part of this stage, in [0, 1]
    virtual void update(const char* stage, double fraction)
    {
        static_cast<void>(stage);
        static_cast<void>(fraction);
    }

    /// True once the caller wants the run to stop. Called from every thread.
    virtual bool cancelled() const { return false; }
};

/// Tells nobody of runs within a run, but lets them be stopped.
class QuietProgress : public Progress
{
public:
    explicit QuietProgress(const Progress& outer) : outer_(outer) {}
    bool cancelled() const override { return outer_.cancelled(); }

private:
    const Progress& outer_;
};

/// Thrown by a stage that found Progress::cancelled() true. Not an Error: nothing went wrong.
class Cancelled : public std::exception
{
public:
    const char* what() const noexcept override { return "cancelled"; }
};

} // namespace molsurf
