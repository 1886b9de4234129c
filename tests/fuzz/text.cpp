// SPDX-License-Identifier: MPL-2.0
/// Small files that the program reads: the first byte chooses which.
#include "fuzz.h"

#include "molsurf/bricks/plan_file.h"
#include "molsurf/io/batch_summary.h"
#include "molsurf/io/frame_table.h"
#include "molsurf/selection/choose_copies.h"
#include "molsurf/selection/groups.h"
#include "molsurf/selection/match_atoms.h"
#include "molsurf/selection/radii.h"
#include "molsurf/structure/read_structure.h"
#include "molsurf/structure/structure_list.h"

namespace
{

/// Some atoms for selections.
const molsurf::Structure& someAtoms()
{
    static const molsurf::Structure atoms =
        molsurf::readStructure(MOLSURF_TEST_DATA "/1a8o.cif.gz");
    return atoms;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace molsurf;
    if (size == 0) return 0;
    const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
    const fuzz::InputFile file(data + 1, size - 1, ".json");
    fuzz::tryTo([&] {
        switch (data[0] % 8) {
        case 0:
            readManifest(file.path());
            break;
        case 1:
            readRadii(file.path());
            break;
        case 2:
            readGroups(file.path());
            break;
        case 3:
            matchAtoms(someAtoms(), text);
            break;
        case 4:
            readSummary(file.path());
            break;
        case 5:
            readFrameTable(file.path());
            break;
        case 6:
            parseCopies(text);
            break;
        default:
            readStructureList(file.path());
        }
    });
    return 0;
}
