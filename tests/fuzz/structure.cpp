// SPDX-License-Identifier: MPL-2.0
/// Structures of every format, with their assemblies; the first byte chooses what is made of them.
#include "fuzz.h"

#include "molsurf/selection/describe_structure.h"
#include "molsurf/selection/select_balls.h"
#include "molsurf/structure/read_structure.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace molsurf;
    if (size == 0) return 0;
    const char* names[] = {".pdb", ".pqr", ".cif", ".xyzr"};
    const fuzz::InputFile file(data + 1, size - 1, names[data[0] & 3]);
    fuzz::tryTo([&] {
        const Structure structure = readStructure(file.path(), 1 << 24);
        SelectOptions options;
        options.labels = true;
        if (data[0] & 4) options.assembly = "1";
        if (data[0] & 8) options.assembly = "ncs";
        options.instances = (data[0] & 12) && (data[0] & 16);
        if (data[0] & 32) options.groupBy = "entity";
        const BallSet balls = selectBalls(structure, options);
        describeSelection(structure, balls);
    });
    if (data[0] & 128) fuzz::tryTo([&] { describeStructure(file.path(), 1 << 24); });
    return 0;
}
