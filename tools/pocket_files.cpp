// SPDX-License-Identifier: MPL-2.0
#include "pocket_files.h"

#include "outputs.h"

#include "molsurf/request/run_outputs.h"

namespace molsurf::tool
{

bool wantsBodies(const CommandLine& call)
{
    return call.showsPockets() || call.writes(Numbered);
}

void numberOutputs(std::size_t count, CommandLine& call)
{
    call.outputs = withPockets(call.outputs, count);
    prepareOutputs(call);
}

} // namespace molsurf::tool
