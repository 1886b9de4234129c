// SPDX-License-Identifier: MPL-2.0
#include "cli.h"
#include "manual.h"
#include "stop.h"
#include "terminal.h"
#include "verbs.h"

#include "molsurf/core/error.h"
#include "molsurf/core/progress.h"
#include "molsurf/selection/select_balls.h"

#include <cerrno>
#include <cstring>
#include <iostream>
#include <malloc.h>
#include <new>

using namespace molsurf;
using namespace molsurf::tool;

namespace
{

int perform(const Call& call, std::chrono::steady_clock::time_point start)
{
    switch (call.verb) {
    case Verb::Help:
        std::cout << helpText();
        return 0;
    case Verb::InfoHelp:
        std::cout << infoHelpText();
        return 0;
    case Verb::CompareHelp:
        std::cout << compareHelpText();
        return 0;
    case Verb::Version:
        std::cout << "vdb_molsurf " MOLSURF_VERSION "\n";
        return 0;
    case Verb::ListRadii:
        std::cout << describeRadii();
        return 0;
    case Verb::Info:
        return info(call);
    case Verb::Compare:
        return molsurf::tool::compare(call, start);
    case Verb::BatchHelp:
        std::cout << batchHelpText();
        return 0;
    case Verb::Batch:
        return batch(call);
    case Verb::PlanHelp:
        std::cout << planHelpText();
        return 0;
    case Verb::BrickHelp:
        std::cout << brickHelpText();
        return 0;
    case Verb::MergeHelp:
        std::cout << mergeHelpText();
        return 0;
    case Verb::Plan:
        return plan(call);
    case Verb::Brick:
        return brick(call);
    case Verb::Merge:
        return merge(call, start);
    case Verb::Man:
        std::cout << manPage();
        return 0;
    case Verb::Completion:
        std::cout << bashCompletion();
        return 0;
    case Verb::MeshHelp:
    case Verb::ColorHelp:
        std::cout << storedHelpText(call.verb);
        return 0;
    case Verb::Mesh:
    case Verb::Color:
        return stored(call, start);
    case Verb::Build:
        if (!call.frames.empty()) return frames(call, start);
        return build(call, start);
    }
    return 1;
}

int statusOf(ErrorKind kind)
{
    return kind == ErrorKind::Usage ? 2 : kind == ErrorKind::Check ? failedCheckStatus : 1;
}

} // namespace

int main(int argc, char** argv)
{
    const auto start = std::chrono::steady_clock::now();
    std::ios_base::sync_with_stdio(false);
    // Fields of many megabytes come and go between the stages: kept by the allocator, their pages
    // need not be mapped and cleared anew each time.
    mallopt(M_MMAP_MAX, 0); // the threshold for mappings cannot be set above 32 MB
    mallopt(M_TRIM_THRESHOLD, 1 << 30);
    try {
        const int status = perform(parseCall(argc, argv), start);
        errno = 0;
        if (!std::cout.flush())
            throw Error(ErrorKind::Output,
                        std::string("cannot write standard output: ") + std::strerror(errno));
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
        say(std::string("error: internal: ") + e.what());
    }
    return 1;
}
