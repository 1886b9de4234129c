// SPDX-License-Identifier: MPL-2.0
/// Brick files, whose checksum is made right, so that what lies behind it is met; and their merge.
#include "fuzz.h"

#include "molsurf/bricks/merged_bricks.h"

#include <zlib.h>

#include <cstring>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace molsurf;
    constexpr std::size_t body = 32;
    std::vector<std::uint8_t> bytes(data, data + size);
    if (size > body) {
        const std::uint64_t sum = crc32_z(0, bytes.data() + body, size - body);
        std::memcpy(&bytes[24], &sum, sizeof sum);
    }
    openvdb::initialize();
    const fuzz::InputFile file(bytes.data(), size, ".brick");
    const fuzz::InputFile vdb(nullptr, 0, ".vdb"), ply(nullptr, 0, ".ply");
    fuzz::tryTo([&] {
        const std::string plan = BrickFile(file.path()).header().plan;
        const MergedBricks merged({file.path()}, plan, 1, SurfaceOptions());
        fuzz::tryTo([&] {
            OutputFile out(vdb.path(), true);
            merged.writeVdb(openvdb::MetaMap(), out, Progress());
        });
        fuzz::tryTo([&] {
            OutputFile out(ply.path(), true);
            merged.writePly(out, Progress());
        });
    });
    return 0;
}
