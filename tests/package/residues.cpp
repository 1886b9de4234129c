// SPDX-License-Identifier: MPL-2.0
#include <molsurf/molsurf.h>

#include <cstdio>

int main(int, char** argv) // STRUCTURE
{
    molsurf::SurfaceOptions options;
    options.kind = molsurf::SurfaceKind::SolventAccessible;
    options.ballAreas = true;
    const auto atoms = molsurf::readAtoms(argv[1]);
    const auto table = molsurf::residueTable(atoms, 1.4, molsurf::makeSurface(atoms, options));
    for (const double area : std::get<2>(table.columns[6].values)) std::printf("%.2f\n", area);
}
