// SPDX-License-Identifier: MPL-2.0
#include <molsurf/molsurf.h>

#include <cstdio>

int main(int, char** argv) // STRUCTURE REPORT.json
{
    const auto atoms = molsurf::readAtoms(argv[1]);
    molsurf::SurfaceOptions other;
    other.kind = molsurf::SurfaceKind::SolventExcluded;
    const auto a = molsurf::makeSurface(atoms), b = molsurf::makeSurface(atoms, other);
    std::printf("%.3f\n", molsurf::compare(a.mesh, b.mesh).hausdorff);
    molsurf::writeReport(a.report, argv[2]);
}
