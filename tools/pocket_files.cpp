// SPDX-License-Identifier: MPL-2.0
#include "pocket_files.h"

#include "outputs.h"

#include "molsurf/error.h"
#include <cstring>

namespace molsurf::tool
{

bool wantsBodies(const CommandLine& call)
{
    return call.showsPockets() || call.writes(Numbered);
}

std::string numberedPath(const Output& output, std::size_t number)
{
    const std::size_t plural =
        output.path.size() - std::strlen(output.format->word) + std::strlen("pocket");
    std::string path = output.path;
    return path.replace(plural, 1, std::to_string(number));
}

void numberOutputs(std::size_t count, CommandLine& call)
{
    std::vector<Output> outputs;
    for (const Output& output : call.outputs) {
        if (!output.holds(Numbered)) {
            outputs.push_back(output);
            continue;
        }
        for (std::size_t number = 1; number <= count; ++number) {
            Output one = output;
            one.path = numberedPath(output, number);
            one.pocket = number;
            for (const Output& other : call.outputs)
                if (other.path == one.path)
                    throw Error(ErrorKind::Output, "-o " + one.path + " is given twice");
            outputs.push_back(std::move(one));
        }
    }
    call.outputs = std::move(outputs);
    prepareOutputs(call);
}

} // namespace molsurf::tool
