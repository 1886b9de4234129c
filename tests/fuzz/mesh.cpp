// SPDX-License-Identifier: MPL-2.0
/// Meshes: the first byte chooses among .ply, .obj and .stl.
#include "fuzz.h"

#include "molsurf/files.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace molsurf;
    if (size == 0) return 0;
    const char* names[] = {".ply", ".obj", ".stl"};
    const fuzz::InputFile file(data + 1, size - 1, names[data[0] % 3]);
    fuzz::tryTo([&] { readMesh(file.path()); });
    return 0;
}
