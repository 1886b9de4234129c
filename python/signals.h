// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Runs of the library without Python's lock: Ctrl-C and a callback reach them all the same.

#include <molsurf/error.h>
#include <molsurf/progress.h>

#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <tbb/global_control.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

namespace molsurf::python
{

namespace nb = nanobind;

namespace
{

/// What is called with stage and fraction, or None.
using Listener = std::optional<nb::object>;

/// Asks Python for signals on the thread that called, every 20 ms, and tells a callback of the
/// progress. An exception of either ends the run.
class Signals : public Progress
{
public:
    explicit Signals(Listener callback) : callback_(std::move(callback)) {}

    void update(const char* stage, double fraction) override
    {
        look();
        if (!callback_ || stopped_) return;
        nb::gil_scoped_acquire lock;
        try {
            (*callback_)(stage, fraction);
        } catch (nb::python_error& e) {
            stop(std::move(e));
        }
    }

    bool cancelled() const override
    {
        if (std::this_thread::get_id() == caller_) look();
        return stopped_;
    }

    /// Throws what ended the run. With the lock.
    [[noreturn]] void rethrow()
    {
        if (!error_) throw std::runtime_error("the run was cancelled");
        throw nb::python_error(std::move(*error_));
    }

private:
    void look() const
    {
        const auto now = std::chrono::steady_clock::now();
        if (stopped_ || now - last_ < std::chrono::milliseconds(20)) return;
        last_ = now;
        nb::gil_scoped_acquire lock;
        if (PyErr_CheckSignals() != 0) stop(nb::python_error());
    }

    void stop(nb::python_error&& e) const
    {
        error_ = std::make_unique<nb::python_error>(std::move(e));
        stopped_ = true;
    }

    Listener callback_;
    const std::thread::id caller_ = std::this_thread::get_id();
    mutable std::chrono::steady_clock::time_point last_{};
    mutable std::atomic<bool> stopped_{false};
    mutable std::unique_ptr<nb::python_error> error_;
};

/// How a run goes: who is told, and how many threads it has at most; 0: all.
struct How {
    Listener progress{};
    int threads = 0;
};

/// Calls f(progress) without the lock.
template<typename F>
auto run(const How& how, const F& f)
{
    Signals signals(how.progress);
    try {
        nb::gil_scoped_release free;
        std::optional<tbb::global_control> limit;
        if (how.threads > 0)
            limit.emplace(tbb::global_control::max_allowed_parallelism, std::size_t(how.threads));
        return f(signals);
    } catch (const Cancelled&) {
    }
    signals.rethrow();
}

} // namespace

} // namespace molsurf::python
