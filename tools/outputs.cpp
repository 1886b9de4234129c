// SPDX-License-Identifier: MPL-2.0
#include "outputs.h"

#include "stop.h"

#include <sys/resource.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace molsurf::tool
{

double secondsSince(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

std::size_t peakMemory()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return std::size_t(usage.ru_maxrss) * 1024;
}

void stopIfAsked()
{
    if (stopRequested()) throw Cancelled();
}

std::string counted(std::size_t count, const std::string& one, const std::string& many)
{
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

void prepareOutputs(const Call& call, const std::vector<std::string>& more)
{
    std::vector<std::string> temporaries = more;
    for (const Output& output : call.outputs) {
        checkWritable(output.path, call.force);
        if (output.path != "-") temporaries.push_back(temporaryName(output.path));
    }
    handleSignals(temporaries);
}

void writeOutputs(const Call& call, Terminal& terminal,
                  const std::function<void(Format, OutputFile&)>& writeOne,
                  const std::function<void(double)>& timed)
{
    std::vector<Output> outputs = call.outputs;
    std::stable_sort(outputs.begin(), outputs.end(), [](const Output& a, const Output& b) {
        const auto turn = [](const Output& o) {
            return 2 * (o.format == Format::Json) + (o.path == "-");
        };
        return turn(a) < turn(b);
    });

    const Clock::time_point start = Clock::now();
    std::vector<std::unique_ptr<OutputFile>> files;
    bool done = false;
    const auto timeIt = [&] {
        if (!done) timed(secondsSince(start));
        done = true;
    };
    for (const Output& output : outputs) {
        if (output.format == Format::Json) timeIt();
        terminal.update("write", double(files.size()) / double(outputs.size()));
        files.push_back(std::make_unique<OutputFile>(output.path, call.force));
        writeOne(output.format, *files.back());
        stopIfAsked();
    }
    timeIt();
    ignoreSignals();
    for (const auto& file : files) file->commit();
}

} // namespace molsurf::tool
