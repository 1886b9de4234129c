// SPDX-License-Identifier: MPL-2.0
#include "stop.h"

#include "exit_status.h"
#include "program.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <cstring>
#include <exception>
#include <new>
#include <system_error>
#include <utility>

namespace molsurf::tool
{

namespace
{

constexpr suseconds_t patience = 700000; // [µs]

// Global, since a signal handler needs them.
std::atomic<bool> requested{false};
std::atomic<bool> deaf{false};
std::atomic<bool> pipeIgnored{false};                        // at the start of the program
std::atomic<const std::vector<std::string>*> names{nullptr}; // a handler may run until the very end

static_assert(std::atomic<bool>::is_always_lock_free, "used in signal handlers");

// Only what a signal handler may do.
[[noreturn]] void leave(const char* text, int status)
{
    if (const std::vector<std::string>* all = deaf ? nullptr : names.load()) {
        for (const std::string& name : *all) {
            if (unlink(name.c_str()) != 0) rmdir(name.c_str());
        }
    }
    const auto print = [](const char* words) {
        const ssize_t printed = write(STDERR_FILENO, words, std::strlen(words));
        static_cast<void>(printed); // there is nobody left to tell
    };
    if (isatty(STDERR_FILENO)) print("\r\033[K");
    print(programName);
    print(": ");
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
    } catch (const std::exception& e) {
        const Ending ending = endingOf(e);
        leave(ending.text.c_str(), ending.status);
    } catch (...) {
    }
    leave("error: internal", failedStatus);
}

void onStop(int)
{
    const bool again = requested.exchange(true);
    if (deaf) return;
    if (again) endNow();
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

bool isIgnored(int signal)
{
    struct sigaction present {
    };
    sigaction(signal, nullptr, &present);
    return present.sa_handler == SIG_IGN;
}

} // namespace

void handleEarly()
{
    pipeIgnored = isIgnored(SIGPIPE);
    std::set_terminate(onTerminate);
}

void holdStandardStreams()
{
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (fcntl(stream, F_GETFD) < 0)
            open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

Ending endingOf(const std::exception& e)
{
    const auto* system = dynamic_cast<const std::system_error*>(&e);
    const bool refused = system && system->code() == std::errc::resource_unavailable_try_again;
    const bool noThread = refused || std::strstr(e.what(), "pthread_create");
    if (noThread || dynamic_cast<const std::bad_alloc*>(&e)) return {noMemoryText, laterStatus};
    return {std::string("error: internal: ") + e.what(), failedStatus};
}

void handleSignals(const std::vector<std::string>& temporaries)
{
    // A handler may still read the list before this one, but not the one before that.
    static const std::vector<std::string>* before = nullptr;
    delete std::exchange(before, names.load());
    names = new std::vector<std::string>(temporaries);
    deaf = false;
    for (int signal : {SIGINT, SIGTERM, SIGHUP})
        if (!isIgnored(signal)) handle(signal, onStop);
    handle(SIGALRM, onAlarm);
    std::set_terminate(onTerminate);
    for (int signal : {SIGPIPE, SIGXFSZ}) handle(signal, SIG_IGN);
}

bool stopRequested()
{
    return requested;
}

void endByPipe()
{
    if (pipeIgnored) return;
    handle(SIGPIPE, SIG_DFL);
    raise(SIGPIPE);
}

void ignoreSignals()
{
    deaf = true;
}

} // namespace molsurf::tool
