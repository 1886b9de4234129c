// SPDX-License-Identifier: MPL-2.0
/// @file
/// .vdb files, as `info` and `convert` read them. OpenVDB is not instrumented, so what it does with
/// a file shows only where it ends the program or takes memory: checkVdb() has to keep that out.

#include "input.h"

#include "molsurf/show/io/describe_vdb.h"
#include "molsurf/show/io/read_vdb.h"
#include "molsurf/surface/stored_surface.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace molsurf;
    openvdb::initialize();
    fuzz::expectErrorAtMost([&] {
        const std::string path = fuzz::inputFile(data, size, ".vdb");
        const VdbFile file = readVdb(path);
        describeVdb(path);
        Progress progress;
        storedSurface(file.grids, file.metadata, SurfaceOptions(), Coloring(), progress);
    });
    return 0;
}
