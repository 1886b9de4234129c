// SPDX-License-Identifier: MPL-2.0
/// @file
/// The solvent-excluded surface of the balls of an .xyzr file, as a level set:
///     xyzr_to_vdb balls.xyzr surface.vdb

#include "molsurf/kernel.h"

#include <fstream>
#include <iostream>

int main(int argc, char** argv)
{
    if (argc != 3) return 2;
    openvdb::initialize();
    molsurf::BallModel model;
    std::ifstream in(argv[1]);
    openvdb::Vec3d x;
    for (double r; in >> x[0] >> x[1] >> x[2] >> r;)
        model.balls.push_back({x, r, std::int32_t(model.balls.size())});
    molsurf::SurfaceSpec spec;
    spec.kind = molsurf::SurfaceKind::SolventExcluded;
    const molsurf::LevelSetSurface made = molsurf::makeLevelSet(model, spec);
    openvdb::io::File(argv[2]).write({made.surface});
    std::cout << made.report.surface.area << " Å^2, " << made.mesh.triangles.size()
              << " triangles\n";
}
