// SPDX-License-Identifier: MPL-2.0
#include "cli/parse.h"
#include "cli/verb_table.h"
#include "outputs.h"
#include "program.h"
#include "stop.h"
#include "terminal.h"
#include "verbs.h"

#include "molsurf/error.h"
#include "molsurf/progress.h"

#include <openvdb/openvdb.h>
#include <tbb/global_control.h>

#include <cerrno>
#include <cstring>
#include <iostream>
#include <malloc.h>
#include <new>

using namespace molsurf;
using namespace molsurf::tool;

namespace
{

/// Writes out what was printed so far.
/// @pre errno is 0
void flushPrinted()
{
    if (std::cout.flush()) return;
    throw Error(ErrorKind::Output, std::string("cannot write standard output: ") +
                                       std::strerror(errno != 0 ? errno : EIO));
}

/// Holds TBB to the threads of a call, if it has --threads.
void limitThreads(const Call& call)
{
    // It is never taken back: TBB would start the other threads then, for the end of the program to
    // stop.
    if (call.threads == 0) return;
    static const auto* const held = new tbb::global_control(
        tbb::global_control::max_allowed_parallelism, std::size_t(call.threads));
    static_cast<void>(held);
}

int perform(int argc, char** argv)
{
    const auto start = std::chrono::steady_clock::now();
    const Parsed parsed = parse(argc, argv);
    errno = 0;
    std::cout << parsed.text;
    flushPrinted();
    if (!parsed.call) return 0;
    recoverOutputs(*parsed.call);
    openvdb::initialize();
    limitThreads(*parsed.call);
    return infoOf(parsed.call->verb).perform(*parsed.call, start);
}

int statusOf(ErrorKind kind)
{
    return kind == ErrorKind::Usage ? 2 : kind == ErrorKind::Check ? failedCheckStatus : 1;
}

} // namespace

const char* const tool::programName = "vdb_molsurf";
const char* const tool::noMemoryText =
    "error: not enough memory [hint: a larger --voxel, or fewer atoms by --select]";

int main(int argc, char** argv)
{
    holdStandardStreams();
    std::ios_base::sync_with_stdio(false);
    // Fields of many megabytes come and go between the stages: kept by the allocator, their pages
    // need not be mapped and cleared anew each time.
    mallopt(M_MMAP_MAX, 0); // the threshold for mappings cannot be set above 32 MB
    mallopt(M_TRIM_THRESHOLD, 1 << 30);
    try {
        const int status = perform(argc, argv);
        errno = 0;
        flushPrinted();
        return status;
    } catch (const Error& e) {
        say(std::string("error: ") + e.what());
        return statusOf(e.kind());
    } catch (const Cancelled&) {
        say("interrupted");
        return interruptedStatus;
    } catch (const std::bad_alloc&) {
        say(noMemoryText);
    } catch (const std::exception& e) {
        say(unforeseenText(e));
    }
    return 1;
}
