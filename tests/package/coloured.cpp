// SPDX-License-Identifier: MPL-2.0
#include <molsurf/molsurf.h>

int main(int, char** argv) // STRUCTURE MESH.glb GRIDS.vdb
{
    molsurf::SurfaceOptions options;
    options.color = molsurf::ColorBy::Chain;
    const auto surface = molsurf::makeSurface(molsurf::readAtoms(argv[1]), options);
    molsurf::writeMesh(surface.mesh, argv[2]);
    molsurf::writeVdb(surface, argv[3]);
}
