// SPDX-License-Identifier: MPL-2.0
#include "stop.h"

#include <signal.h>
#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <cstring>
#include <exception>
#include <new>

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

// Only what a signal handler may do.
[[noreturn]] void leave(const char* text, int status)
{
    for (const std::string& name : *names) {
        if (unlink(name.c_str()) != 0) rmdir(name.c_str());
    }
    const auto print = [](const char* words) {
        const ssize_t printed = write(STDERR_FILENO, words, std::strlen(words));
        static_cast<void>(printed); // there is nobody left to tell
    };
    if (isatty(STDERR_FILENO)) print("\r\033[K");
    print("vdb_molsurf: ");
    print(text);
    print("\n");
    _exit(status);
}

[[noreturn]] void endNow()
{
    leave("interrupted", interruptedStatus);
}

[[noreturn]] void onTerminate()
{
    try {
        if (const std::exception_ptr present = std::current_exception())
            std::rethrow_exception(present);
    } catch (const std::bad_alloc&) {
        leave(noMemoryText, 1);
    } catch (const std::exception& e) {
        const std::string text = std::string("error: internal: ") + e.what();
        leave(text.c_str(), 1);
    } catch (...) {
    }
    leave("error: internal", 1);
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
    deaf = false;
    for (int signal : {SIGINT, SIGTERM, SIGHUP}) handle(signal, onStop);
    handle(SIGALRM, onAlarm);
    std::set_terminate(onTerminate);
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
