// SPDX-License-Identifier: MPL-2.0
/// @file
/// Small files of text: those that users write, and those that the program reads back. The first
/// byte says which, the others are the file.

#include "input.h"

#include "cli/parse.h"
#include "molsurf/molecule/selection/ball_values.h"
#include "molsurf/molecule/selection/groups.h"
#include "molsurf/molecule/selection/radii.h"
#include "molsurf/molecule/selection/scalar_map.h"
#include "molsurf/molecule/structure/structure_list.h"
#include "molsurf/show/io/batch_summary.h"
#include "molsurf/show/io/frame_table.h"
#include "molsurf/show/io/write_usda.h"
#include "molsurf/show/io/write_usda_mesh.h"
#include "molsurf/show/picture/view_file.h"
#include "nanoshaper/config.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace molsurf;
    if (size == 0) return 0;
    const std::string path = fuzz::inputFile(data + 1, size - 1, ".txt");
    fuzz::expectErrorAtMost([&] {
        switch (data[0]) {
        case 'r':
            readRadii(path);
            break;
        case 'g':
            readGroups(path);
            break;
        case 's':
            readJournalLine(std::string(data + 1, data + size));
            readJournalHeader(std::string(data + 1, data + size), path);
            break;
        case 'f':
            readFrameTable(path);
            break;
        case 'l':
            readStructureList(path);
            break;
        case 'd':
            readDx(path).at({0.5, 0.5, 0.5});
            break;
        case 'v': {
            Structure structure;
            structure.chains = structure.asyms = {"A"};
            structure.residues = {{"GLY", 0, 0, 1, ' '}};
            structure.atoms = {{openvdb::Vec3d(0.0), "CA", 0, 6, '\0', AtomRole::Atom, 1, 0, -1}};
            std::vector<std::string> warnings;
            ballValues(structure, {{openvdb::Vec3f(0.0f), 1.7f, 0}}, {ValueBy::Kind::Table, path},
                       Coloring(), {openvdb::Vec3d(0.0), {}}, 0, warnings);
            break;
        }
        case 'u':
            isOwnUsda(path);
            isOwnFilm(path);
            extentsOfUsda(path);
            break;
        case 'w': {
            DrawOptions options;
            readView(path, options);
            break;
        }
        case 'c': {
            const char* words[] = {"vdb_molsurf", "--config", path.c_str(), "a.pdb"};
            tool::parse(4, words);
            break;
        }
        case 'n':
            nanoshaper::readConfig(path);
            break;
        }
    });
    return 0;
}
