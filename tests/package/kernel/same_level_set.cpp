// SPDX-License-Identifier: MPL-2.0
/// @file
/// Whether the grids `surface` of two files have the same voxels, with the same bits:
///     same_level_set a.vdb b.vdb

#include <openvdb/openvdb.h>

#include <iostream>

namespace
{

openvdb::FloatGrid::Ptr surfaceOf(const char* path)
{
    openvdb::io::File file(path);
    file.open();
    return openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("surface"));
}

} // namespace

int main(int argc, char** argv)
{
    if (argc != 3) return 2;
    openvdb::initialize();
    const auto a = surfaceOf(argv[1]), b = surfaceOf(argv[2]);
    bool same = a->voxelSize() == b->voxelSize() && a->background() == b->background() &&
                a->activeVoxelCount() == b->activeVoxelCount() &&
                a->tree().hasSameTopology(b->tree());
    std::size_t differ = 0;
    auto other = b->cbeginValueAll();
    for (auto it = a->cbeginValueAll(); same && it; ++it, ++other) differ += *it != *other;
    std::cout << a->activeVoxelCount() << " and " << b->activeVoxelCount() << " voxels, " << differ
              << " values differ\n";
    return same && differ == 0 ? 0 : 1;
}
