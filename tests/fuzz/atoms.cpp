// SPDX-License-Identifier: MPL-2.0
/// @file
/// The atoms of a plan. The checksums of the cells are made right first: with a wrong one nothing
/// else is read.

#include "input.h"

#include "molsurf/scale/bricks/atoms_file.h"
#include "molsurf/scale/bricks/run_brick.h"

#include <zlib.h>

#include <cstring>
#include <vector>

namespace
{

constexpr std::size_t head = 8, record = 72, tail = 32; // bytes
constexpr std::size_t cellSize = sizeof(molsurf::AtomCell);

/// Gives each cell the checksum of the records that it claims.
void mendChecksums(std::vector<std::uint8_t>& bytes)
{
    if (bytes.size() < head + tail) return;
    std::uint64_t lengths[3]; // of the map, the cells and the header
    std::memcpy(lengths, bytes.data() + bytes.size() - tail, sizeof lengths);
    const std::size_t most = bytes.size() - head - tail;
    if (lengths[1] > most || lengths[2] > most || lengths[1] + lengths[2] > most) return;
    const std::size_t cells = bytes.size() - tail - lengths[2] - lengths[1];
    std::size_t at = head;
    for (std::size_t c = cells; c + cellSize <= cells + lengths[1]; c += cellSize) {
        molsurf::AtomCell cell;
        std::memcpy(&cell, bytes.data() + c, cellSize);
        const std::size_t size = record * std::size_t(cell.count);
        if (size > cells - at) return;
        cell.checksum = std::uint32_t(crc32_z(0, bytes.data() + at, size));
        std::memcpy(bytes.data() + c, &cell, cellSize);
        at += size;
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace molsurf;
    std::vector<std::uint8_t> bytes(data, data + size);
    mendChecksums(bytes);
    const std::string path = fuzz::inputFile(bytes.data(), bytes.size(), ".brick");
    fuzz::expectErrorAtMost([&] { AtomsFile(path).within(everywhere()); });
    return 0;
}
