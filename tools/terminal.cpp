// SPDX-License-Identifier: MPL-2.0
#include "terminal.h"

#include "program.h"
#include "stop.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/printable.h"
#include "molsurf/kernel/core/strings.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>

namespace molsurf::tool
{

namespace
{

constexpr std::chrono::milliseconds betweenDraws(100);

// "3 s", "2:05 min", "1:02 h"
std::string duration(double seconds)
{
    const long s = std::lround(std::min(seconds, 3.6e6));
    if (s < 60) return formatted("%ld s", s);
    return s < 3600 ? formatted("%ld:%02ld min", s / 60, s % 60)
                    : formatted("%ld:%02ld h", s / 3600, s / 60 % 60);
}

} // namespace

std::string withOptionNames(const std::string& message)
{
    const auto isSmall = [](char c) { return c >= 'a' && c <= 'z'; };
    const auto isCapital = [](char c) { return c >= 'A' && c <= 'Z'; };
    std::string out;
    for (std::size_t i = 0; i < message.size(); ++i) {
        const std::size_t end = message[i] == '`' ? message.find('`', i + 1) : std::string::npos;
        const std::string_view name =
            end == std::string::npos ? "" : std::string_view(message).substr(i + 1, end - i - 1);
        if (name.empty() || !isSmall(name[0]) ||
            !std::all_of(name.begin(), name.end(),
                         [&](char c) { return isSmall(c) || isCapital(c); })) {
            out += message[i];
            continue;
        }
        out += "--";
        for (const char letter : name) {
            if (isCapital(letter)) out += '-';
            out += isCapital(letter) ? char(letter - 'A' + 'a') : letter;
        }
        i = end;
    }
    return out;
}

void printLine(const std::string& text)
{
    const std::string line = std::string(programName) + ": " + printable(withOptionNames(text));
    std::fprintf(stderr, "%s\n", line.c_str());
}

Terminal::Terminal(bool bar) : bar_(bar && isatty(STDERR_FILENO)) {}

Terminal::~Terminal()
{
    erase();
}

void Terminal::begin(std::size_t i, std::size_t count, const std::string& prefix)
{
    const std::lock_guard<std::mutex> lock(drawing_);
    run_ = i;
    runs_ = count;
    prefix_ = prefix;
    stages_.clear();
    stage_.clear();
}

void Terminal::expect(std::vector<StageShare> stages, double seconds)
{
    const std::lock_guard<std::mutex> lock(drawing_);
    stages_ = std::move(stages);
    seconds_ = seconds;
    at_ = 0;
}

void Terminal::update(const char* stage, double fraction)
{
    if (!bar_) return;
    const Clock::time_point now = Clock::now();
    const std::lock_guard<std::mutex> lock(drawing_);
    const bool next = stage_ != stage;
    fraction_ = std::clamp(fraction, 0.0, 1.0);
    if (next) {
        stage_ = stage;
        stageStart_ = now;
        // A stage that has been is a part of the one that goes on.
        for (std::size_t i = at_; i < stages_.size(); ++i) {
            if (stage_ != stages_[i].stage) continue;
            at_ = i;
            break;
        }
    }
    if (next || now - lastDrawn_ >= betweenDraws) draw(now);
}

double Terminal::done(Clock::time_point now) const
{
    if (stages_.empty()) return (double(run_) + (runs_ > 1 ? 0.0 : fraction_)) / double(runs_);
    double before = 0.0;
    for (std::size_t i = 0; i < at_; ++i) before += stages_[i].share;
    const double share = stages_[at_].share;
    // It comes near to the end of a stage as its time goes by, and never to it.
    const double expected = std::max(share * seconds_, 1e-3);
    const double spent = std::chrono::duration<double>(now - stageStart_).count();
    const double inner = std::max(fraction_, 1.0 - std::exp(-1.5 * spent / expected));
    return (double(run_) + before + share * inner) / double(runs_);
}

void Terminal::draw(Clock::time_point now) const
{
    lastDrawn_ = now;
    constexpr int width = 24;
    const double done = this->done(now);
    const int full = int(done * width);
    std::string line = "\r\033[K[" + std::string(std::size_t(full), '#') +
                       std::string(std::size_t(width - full), '.') + "]";
    line += formatted(" %3.0f %%  ", 100.0 * done) + printable(prefix_) + stage_;
    const bool whole = !stages_.empty() || runs_ > 1;
    const double spent =
        std::chrono::duration<double>(now - (whole ? start_ : stageStart_)).count();
    if (done > 0.02 && done < 1.0 && spent > 0.5)
        line += ", " + duration(spent * (1.0 - done) / done) + " left";
    std::fputs(line.c_str(), stderr);
    std::fflush(stderr);
    drawn_ = true;
}

bool Terminal::cancelled() const
{
    if (bar_ && drawing_.try_lock()) {
        const std::lock_guard<std::mutex> lock(drawing_, std::adopt_lock);
        const Clock::time_point now = Clock::now();
        if (drawn_ && now - lastDrawn_ >= betweenDraws) draw(now);
    }
    return stopRequested() || overdue();
}

void Terminal::limit(double processor, double hours)
{
    constexpr double longest = 1e7; // [s], which no clock here counts to
    latest_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                 std::chrono::duration<double>(std::min(3600.0 * hours, longest)));
    most_ = std::clock() + std::clock_t(std::min(processor, longest) * CLOCKS_PER_SEC);
}

void Terminal::limitTo(double estimate, double hours)
{
    constexpr double times = 4.0, least = 60.0; // [s]
    limit(std::max(times * estimate, least), hours);
}

void Terminal::failIfOverdue(const std::string& hint) const
{
    if (overdue())
        throw Error(ErrorKind::Numeric, "the surface takes more than four times as long as it was "
                                        "estimated to, or more than it may" +
                                            hint);
}

bool Terminal::overdue() const
{
    constexpr std::chrono::milliseconds betweenLooks(100);
    const Clock::rep now = Clock::now().time_since_epoch().count();
    Clock::rep before = looked_;
    if (now - before > std::chrono::duration_cast<Clock::duration>(betweenLooks).count() &&
        looked_.compare_exchange_strong(before, now) &&
        (std::clock() > most_ || now > latest_.time_since_epoch().count()))
        overdue_ = true;
    return overdue_;
}

void Terminal::erase()
{
    const std::lock_guard<std::mutex> lock(drawing_);
    if (!drawn_) return;
    std::fputs("\r\033[K", stderr);
    std::fflush(stderr);
    drawn_ = false;
    stage_.clear();
}

} // namespace molsurf::tool
