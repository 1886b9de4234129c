// SPDX-License-Identifier: MPL-2.0
#include "program.h"

#include "exit_status.h"
#include "stop.h"
#include "terminal.h"
#include "verbs.h"

#include "molsurf/kernel/core/transient_error.h"
#include "molsurf/progress.h"
#include "molsurf/show/io/output_file.h"

#include <tbb/global_control.h>

#include <cerrno>
#include <cstring>
#include <iostream>
#include <malloc.h>

namespace molsurf::tool
{

void printed(const std::string& text)
{
    errno = 0;
    if (std::cout << text << std::flush) return;
    const int reason = errno != 0 ? errno : EIO;
    const std::string message =
        std::string("cannot write standard output: ") + std::strerror(reason);
    if (reason == EPIPE) throw NoReader(message);
    throw Error(ErrorKind::Output, message, mayPass(reason));
}

void limitThreads(int threads)
{
    if (threads <= 0) return;
    [[maybe_unused]] static const auto* const held =
        new tbb::global_control(tbb::global_control::max_allowed_parallelism, std::size_t(threads));
}

int runProgram(const std::function<int()>& perform,
               const std::function<std::string(const Error&)>& textOf)
{
    holdStandardStreams();
    std::ios_base::sync_with_stdio(false);
    // Fields of many megabytes come and go between the stages: kept by the allocator, their pages
    // need not be mapped and cleared anew each time.
    mallopt(M_MMAP_MAX, 0); // the threshold for mappings cannot be set above 32 MB
    mallopt(M_TRIM_THRESHOLD, 1 << 30);
    try {
        const int status = perform();
        printed("");
        return status;
    } catch (const NoReader& e) {
        endByPipe();
        printLine("error: " + textOf(e));
        return statusOf(e);
    } catch (const Error& e) {
        printLine("error: " + textOf(e));
        return statusOf(e);
    } catch (const Cancelled&) {
        printLine("interrupted");
        return interruptedStatus;
    } catch (const std::exception& e) {
        const Ending ending = endingOf(e);
        printLine(ending.text);
        return ending.status;
    }
}

} // namespace molsurf::tool
