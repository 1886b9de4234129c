// SPDX-License-Identifier: MPL-2.0
/// @file
/// Plans of bricks, up to the call that they stand for.

#include "input.h"

#include "bricks.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace molsurf;
    const std::string path = fuzz::inputFile(data, size, ".json");
    fuzz::expectErrorAtMost(
        [&] { tool::callOf(readManifest(path), path, tool::PlanFiles::Hashes); });
    return 0;
}
