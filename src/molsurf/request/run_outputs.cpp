// SPDX-License-Identifier: MPL-2.0
#include "molsurf/request/run_outputs.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/request/format_table.h"

#include <cstring>
#include <filesystem>
#include <utility>

namespace molsurf
{

using namespace holds;
namespace fs = std::filesystem;

std::string formatWordOf(const std::string& path)
{
    const fs::path name = lowered(fs::path(path).filename().string());
    const std::string end = name.extension().string();
    if (end.empty()) return end;
    const std::string both = name.stem().extension().string() + end;
    return findFormat(both.substr(1)) ? both.substr(1) : end.substr(1);
}

std::vector<Output> withTurntable(const std::vector<Output>& outputs, int count)
{
    std::vector<Output> all;
    for (const Output& output : outputs) {
        if (!output.holds(Pixels) || output.holds(Moving)) {
            all.push_back(output);
            continue;
        }
        for (int n = 0; n < count; ++n) {
            Output frame = output;
            frame.path.insert(frame.path.size() - std::strlen(".png"), formatted(".%04d", n + 1));
            frame.turn = 360.0 * n / count;
            all.push_back(std::move(frame));
        }
    }
    return all;
}

std::string numberedPath(const Output& output, std::size_t number)
{
    const std::size_t plural =
        output.path.size() - std::strlen(output.format->word) + std::strlen("pocket");
    std::string path = output.path;
    return path.replace(plural, 1, std::to_string(number));
}

std::vector<Output> withPockets(const std::vector<Output>& outputs, std::size_t count)
{
    std::vector<Output> all;
    for (const Output& output : outputs) {
        if (!output.holds(Numbered)) {
            all.push_back(output);
            continue;
        }
        for (std::size_t number = 1; number <= count; ++number) {
            Output one = output;
            one.path = numberedPath(output, number);
            one.pocket = number;
            for (const Output& other : outputs)
                if (other.path == one.path)
                    throw Error(ErrorKind::Output, "-o " + one.path + " is given twice");
            all.push_back(std::move(one));
        }
    }
    return all;
}

} // namespace molsurf
