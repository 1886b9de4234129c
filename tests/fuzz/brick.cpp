// SPDX-License-Identifier: MPL-2.0
/// @file
/// The file of a brick, merged alone. Its length and checksum are made right first: with a wrong
/// one nothing else is read.

#include "input.h"

#include "molsurf/scale/bricks/merged_bricks.h"

#include <zlib.h>

#include <cstring>
#include <iostream>
#include <vector>

namespace
{

/// Takes what is written to it, and forgets it.
class Nothing : public std::streambuf
{
    int overflow(int letter) override { return letter; }
    std::streamsize xsputn(const char*, std::streamsize count) override { return count; }
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace molsurf;
    static Nothing nothing;
    std::cout.rdbuf(&nothing);
    std::vector<std::uint8_t> bytes(data, data + size);
    constexpr std::size_t body = 32; // the magic, the place and length of the header, the checksum
    if (size > body) {
        std::uint64_t head[3];
        std::memcpy(head, bytes.data() + 8, sizeof head);
        if (head[0] < size) head[1] = size - head[0];
        head[2] = crc32_z(0, bytes.data() + body, size - body);
        std::memcpy(bytes.data() + 8, head, sizeof head);
    }
    openvdb::initialize();
    fuzz::expectErrorAtMost([&] {
        const std::string path = fuzz::inputFile(bytes.data(), bytes.size(), ".brick");
        BrickPlan plan;
        plan.bricks.push_back({anySpace()});
        plan.atoms = 1;
        const MergedBricks merged({path}, BrickFile(path).header().plan, plan, SurfaceOptions(),
                                  true);
        OutputFile file("-", false);
        merged.writeVdb(openvdb::MetaMap(), file, Progress());
        OutputFile mesh("-", false);
        merged.writePly(mesh, Progress());
    });
    return 0;
}
