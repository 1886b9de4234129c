// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// What people see on standard error while a run goes on.

#include "molsurf/progress.h"

#include <atomic>
#include <chrono>
#include <limits>
#include <string>

namespace molsurf::tool
{

/// A message of the library with options as the command line calls them: `maxSteps` becomes
/// --max-steps.
std::string withOptionNames(const std::string& message);

/// Prints "vdb_molsurf: ..." (programName) as one line on standard error, whatever the text holds.
void say(const std::string& text);

/// A progress bar on standard error, if that is a terminal: stage, per cent, time left in the
/// stage. It is drawn at most ten times a second. Also tells the run to stop after a signal.
class Terminal : public Progress
{
public:
    /// @param[in] bar  false for no bar, terminal or not
    explicit Terminal(bool bar);
    ~Terminal() override;

    void update(const char* stage, double fraction) override;
    bool cancelled() const override;

    /// What is put before the names of stages from now on: "frame 3/38: ".
    void setPrefix(const std::string& prefix) { prefix_ = prefix; }

    /// Ends the run when it has taken more than this from now on.
    /// @param[in] processor  time of all threads [s]; infinite: no limit
    /// @param[in] hours      by the clock
    void limit(double processor, double hours);

    /// The same of a run whose time was estimated [s]: four times as long, and a minute at least.
    void limitTo(double estimate, double hours);

    /// Whether the run ends because it has taken too long.
    bool overdue() const;

    /// What to call when the run was cancelled.
    /// @throws Error(ErrorKind::Numeric) if that was because it took too long
    void failIfOverdue(const std::string& hint) const;

    /// Takes the bar away, so that a line can be printed.
    void erase();

private:
    using Clock = std::chrono::steady_clock;
    bool bar_;
    bool drawn_ = false;
    std::string stage_, prefix_;
    Clock::time_point stageStart_, lastDrawn_;
    Clock::time_point latest_ = Clock::time_point::max();
    std::clock_t most_ = std::numeric_limits<std::clock_t>::max();
    mutable std::atomic<Clock::rep> looked_{0}; // when the time of all threads was asked for
    mutable std::atomic<bool> overdue_{false};
};

} // namespace molsurf::tool
