// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Lines on standard error while a run goes on.

#include "molsurf/progress.h"

#include <atomic>
#include <chrono>
#include <limits>
#include <mutex>
#include <string>
#include <vector>

namespace molsurf::tool
{

/// A message of the library with options as the command line calls them: `maxSteps` becomes
/// --max-steps.
std::string withOptionNames(const std::string& message);

/// Prints "vdb_molsurf: ..." (programName) as one line on standard error, whatever the text holds.
void printLine(const std::string& text);

/// A stage of a run, and its share of the time; the shares of a run add up to 1.
struct StageShare {
    const char* stage;
    double share;
};

/// A progress bar on standard error, if that is a terminal: stage, per cent and time left of the
/// run where its stages are known, of the stage elsewhere. It is drawn at most ten times a second,
/// and moves while a stage lasts. Also stops the run after a signal.
class Terminal : public Progress
{
public:
    /// @param[in] bar  false for no bar, terminal or not
    explicit Terminal(bool bar);
    ~Terminal() override;

    void update(const char* stage, double fraction) override;
    bool cancelled() const override;

    /// Begins run i of so many, counted from 0: all of them share the bar.
    /// @param[in] prefix  what is put before the names of stages from now on: "frame 3/38: "
    void begin(std::size_t i, std::size_t count, const std::string& prefix);

    /// Makes the bar that of a run.
    /// @param[in] stages   in their order
    /// @param[in] seconds  that it is estimated to take, by the clock
    void expect(std::vector<StageShare> stages, double seconds);

    /// Ends the run when it has taken more than this from now on.
    /// @param[in] processor  time of all threads [s]; infinite: no limit
    /// @param[in] hours      by the clock
    void limit(double processor, double hours);

    /// The same of a run whose time was estimated [s]: four times as long, and a minute at least.
    void limitTo(double estimate, double hours);

    /// Whether the run ends because it has taken too long.
    bool overdue() const;

    /// To be called when the run was cancelled.
    /// @throws Error(ErrorKind::Numeric) if that was because it took too long
    void failIfOverdue(const std::string& hint) const;

    /// Takes the bar away, so that a line can be printed.
    void erase();

private:
    using Clock = std::chrono::steady_clock;
    double done(Clock::time_point now) const;
    void draw(Clock::time_point now) const;

    bool bar_;
    mutable std::mutex drawing_; // of what follows: cancelled() draws from any thread
    mutable bool drawn_ = false;
    mutable Clock::time_point lastDrawn_;
    std::string stage_, prefix_;
    double fraction_ = 0.0; // of the stage
    std::vector<StageShare> stages_;
    std::size_t at_ = 0;             // the stage among them
    std::size_t run_ = 0, runs_ = 1; // of begin()
    double seconds_ = 0.0;           // of expect()
    Clock::time_point start_ = Clock::now(), stageStart_ = start_;
    Clock::time_point latest_ = Clock::time_point::max();
    std::clock_t most_ = std::numeric_limits<std::clock_t>::max();
    mutable std::atomic<Clock::rep> looked_{0}; // when the time of all threads was asked for
    mutable std::atomic<bool> overdue_{false};
};

} // namespace molsurf::tool
