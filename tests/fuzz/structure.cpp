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
        LabelOptions labels;
        AssemblyChoice& assembly = options.assembly;
        if (choice & 1 && !structure.assemblies.empty())
            assembly.name = structure.assemblies.back().name;
        assembly.instances = assembly.name && choice & 2;
        assembly.bySymmetry = assembly.name && !assembly.instances && choice & 32;
        if (choice & 64) labels.valueBy = ValueBy{ValueBy::Kind::BFactor};
        if (choice & 4) labels.groupBy = GroupBy{GroupBy::Kind::Entity};
        if (choice & 8) options.coarse = {{"", CoarseRule::Level::Residue, 1}};
        const BallSet balls = selectBalls(structure, options, labels, 1.4, Progress());
        describeSelection(structure, balls);
    });
    if (choice & 16) fuzz::expectErrorAtMost([&] { describeStructure(path); });
    return 0;
}
