// SPDX-License-Identifier: MPL-2.0
//
// check_mesh MESH.ply LEVELSET.vdb: prints what CGAL says of the mesh and whether its Euler number
// is that of the level set's signs. Exit status 0 if all is well.

#include "molsurf/show/io/read_vdb.h"
#include "support/digital_euler.h"
#include "support/mesh_checks.h"

#include <cstdio>
#include <exception>
#include <iostream>

int main(int argc, char** argv)
{
    using namespace molsurf;
    if (argc != 3) {
        std::fprintf(stderr, "usage: check_mesh MESH.ply LEVELSET.vdb\n");
        return 2;
    }
    try {
        openvdb::initialize();
        const Mesh mesh = test::readPly(argv[1]);
        const test::MeshVerdict verdict = test::judge(mesh);
        std::cout << mesh.triangles.size() << " triangles: " << verdict << '\n';
        bool same = false;
        for (const auto& grid : readVdb(argv[2]).grids) {
            if (grid->getName() != "surface") continue;
            const auto& surface = dynamic_cast<const openvdb::FloatGrid&>(*grid);
            const test::DigitalEuler e = test::digitalEuler(surface);
            const std::int64_t rule = test::mesherEuler(surface);
            same = rule == verdict.euler;
            std::cout << "Euler number of the signs: " << rule << " by the mesher's rule, "
                      << 2 * e.six << " / " << 2 * e.eighteen << " / " << 2 * e.twentySix
                      << " by 6 / 18 / 26 neighbours, ambiguous cells " << e.ambiguousCells << '\n';
        }
        std::cout << (verdict.good() && same ? "good" : "BAD") << '\n';
        return verdict.good() && same ? 0 : 1;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "check_mesh: %s\n", e.what());
        return 1;
    }
}
