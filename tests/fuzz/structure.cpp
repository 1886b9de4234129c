// SPDX-License-Identifier: MPL-2.0
/// @file
/// Structures: files whose names end in FUZZ_ENDING, from the text to the balls of an assembly.

#include "input.h"

#include "molsurf/progress.h"
#include "molsurf/selection/describe_structure.h"
#include "molsurf/selection/select_balls.h"
#include "molsurf/structure/read_structure.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace molsurf;
    fuzz::expectErrorAtMost([&] {
        const std::string path = fuzz::inputFile(data, size, FUZZ_ENDING);
        const Structure structure = readStructure(path);
        SelectOptions options;
        if (!structure.assemblies.empty()) options.assembly = structure.assemblies[0].name;
        selectBalls(structure, options, 1.4, Progress());
        describeStructure(path);
    });
    return 0;
}
