// SPDX-License-Identifier: MPL-2.0
/// @file
/// Triangle meshes: the format FUZZ_ENDING, as `compare` reads them.

#include "input.h"

#include "molsurf/analysis/measures/compare.h"
#include "molsurf/progress.h"
#include "molsurf/show/io/read_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace molsurf;
    fuzz::expectErrorAtMost(
        [&] { operandOf(readMesh(fuzz::inputFile(data, size, FUZZ_ENDING)), Progress()); });
    return 0;
}
