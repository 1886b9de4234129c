// SPDX-License-Identifier: MPL-2.0
#include <molsurf/io/write_mesh.h>
#include <molsurf/surface/run.h>

#include <cstdio>

// The surface of two atoms, as a mesh.
int main(int argc, char** argv)
{
    if (argc != 2) return 2;
    openvdb::initialize();
    const std::vector<molsurf::Ball> balls = {{{0.0f, 0.0f, 0.0f}, 1.7f, 0},
                                              {{1.5f, 0.0f, 0.0f}, 1.55f, 1}};
    molsurf::Progress progress;
    const molsurf::Result result = molsurf::run(balls, molsurf::Options(), progress);
    molsurf::OutputFile file(argv[1], false);
    molsurf::writePly(result.mesh, file);
    file.commit();
    std::printf("area %.2f, %zu triangles\n", result.report.surface.area,
                result.mesh.triangles.size());
    return result.mesh.triangles.empty() ? 1 : 0;
}
