// SPDX-License-Identifier: MPL-2.0
#include "stop.h"

#include <signal.h>
#include <sys/time.h>
#include <unistd.h>

#include <atomic>

namespace molsurf::tool
{

namespace
{

constexpr suseconds_t patience = 700000; // [µs]

// What a signal handler needs has to be global.
std::atomic<bool> requested{false};
std::atomic<bool> deaf{false};
std::vector<std::string>* names = nullptr; // never freed: a handler may run until the very end

static_assert(std::atomic<bool>::is_always_lock_free, "used in signal handlers");

[[noreturn]] void endNow()
{
    for (const std::string& name : *names) unlink(name.c_str());
    const char clear[] = "\r\033[K";
    const char text[] = "vdb_molsurf: interrupted\n";
    bool told = !isatty(STDERR_FILENO) || write(STDERR_FILENO, clear, sizeof clear - 1) > 0;
    told = told && write(STDERR_FILENO, text, sizeof text - 1) > 0;
    static_cast<void>(told); // there is nobody left to tell
    _exit(interruptedStatus);
}

void onStop(int)
{
    if (deaf) return;
    if (requested.exchange(true)) endNow();
    itimerval timer{};
    timer.it_value.tv_usec = patience;
    setitimer(ITIMER_REAL, &timer, nullptr);
}

void onAlarm(int)
{
    if (!deaf) endNow();
}

void handle(int signal, void (*handler)(int))
{
    struct sigaction action {
    };
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
}

} // namespace

void handleSignals(const std::vector<std::string>& temporaries)
{
    names = new std::vector<std::string>(temporaries);
    for (int signal : {SIGINT, SIGTERM, SIGHUP}) handle(signal, onStop);
    handle(SIGALRM, onAlarm);
    for (int signal : {SIGPIPE, SIGXFSZ}) handle(signal, SIG_IGN);
}

bool stopRequested()
{
    return requested;
}

void ignoreSignals()
{
    deaf = true;
}

} // namespace molsurf::tool
