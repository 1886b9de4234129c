// SPDX-License-Identifier: MPL-2.0
/// OpenVDB files.
#include "fuzz.h"

#include "molsurf/io/describe_vdb.h"
#include "molsurf/io/read_vdb.h"

#include <openvdb/openvdb.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace molsurf;
    openvdb::initialize();
    const fuzz::InputFile file(data, size, ".vdb");
    fuzz::tryTo([&] { readVdb(file.path()); });
    fuzz::tryTo([&] { describeVdb(file.path()); });
    return 0;
}
