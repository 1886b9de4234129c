// SPDX-License-Identifier: MPL-2.0
/// @file
/// Structures: files whose names end in FUZZ_ENDING, from the text to the balls of an assembly. The
/// last byte, which no format needs, chooses what is made of them.

#include "input.h"

#include "molsurf/molecule/selection/select_balls.h"
#include "molsurf/molecule/structure/read_structure.h"
#include "molsurf/progress.h"
#include "molsurf/show/io/describe_structure.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace molsurf;
    const unsigned choice = size > 0 ? data[size - 1] : 0;
    const std::string path = fuzz::inputFile(data, size, FUZZ_ENDING);
    fuzz::expectErrorAtMost([&] {
        const Structure structure = readStructure(path);
        SelectOptions options;
        options.labels = true;
        if (choice & 1 && !structure.assemblies.empty())
            options.assembly = structure.assemblies.back().name;
        options.instances = options.assembly && choice & 2;
        options.bySymmetry = options.assembly && !options.instances && choice & 32;
        if (choice & 64) options.valueBy = ValueBy{ValueBy::Kind::BFactor};
        if (choice & 4) options.groupBy = GroupBy{GroupBy::Kind::Entity};
        if (choice & 8) options.coarse = {{"", CoarseRule::Level::Residue, 1}};
        const BallSet balls = selectBalls(structure, options, 1.4, Progress());
        describeSelection(structure, balls);
    });
    if (choice & 16) fuzz::expectErrorAtMost([&] { describeStructure(path); });
    return 0;
}
