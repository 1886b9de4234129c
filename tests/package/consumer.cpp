// SPDX-License-Identifier: MPL-2.0
#include <molsurf/molsurf.h>
#include <molsurf/version.h>

#include <cstdio>

// The surface of two atoms, as a mesh, by what is installed alone.
int main(int argc, char** argv)
{
    if (argc != 2) return 2;
    openvdb::initialize();
    const std::vector<molsurf::Ball> balls = {{{0.0f, 0.0f, 0.0f}, 1.7f, 0},
                                              {{1.5f, 0.0f, 0.0f}, 1.55f, 1}};
    const molsurf::MolecularSurface surface = molsurf::makeSurface(balls);
    molsurf::writeMesh(surface.mesh, argv[1]);
    const molsurf::Comparison same = molsurf::compare(surface.mesh, molsurf::readMesh(argv[1]));
    std::printf("molsurf %s: area %.2f, %zu triangles\n", MOLSURF_VERSION_TEXT,
                surface.report.surface.area, surface.mesh.triangles.size());
    try {
        molsurf::makeSurface(std::vector<molsurf::Ball>());
    } catch (const molsurf::Error& error) {
        return !surface.mesh.triangles.empty() && same.hausdorff < 1e-6 ? 0 : 1;
    }
    return 1;
}
