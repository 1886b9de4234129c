// SPDX-License-Identifier: MPL-2.0
#include "cli/parse.h"
#include "cli/verb_table.h"
#include "outputs.h"
#include "program.h"

#include <openvdb/openvdb.h>

#include <chrono>

using namespace molsurf;
using namespace molsurf::tool;

namespace
{

int perform(int argc, char** argv)
{
    const auto start = std::chrono::steady_clock::now();
    const Parsed parsed = parse(argc, argv);
    printed(parsed.text);
    if (!parsed.call) return 0;
    recoverOutputs(*parsed.call);
    openvdb::initialize();
    limitThreads(parsed.call->threads);
    return infoOf(parsed.call->verb).perform(*parsed.call, start);
}

} // namespace

const char* const tool::programName = "vdb_molsurf";
const char* const tool::noMemoryText =
    "error: not enough memory [hint: a larger --voxel, or fewer atoms by --select]";

int main(int argc, char** argv)
{
    return runProgram([&] { return perform(argc, argv); }, [](const Error& e) { return e.what(); });
}
