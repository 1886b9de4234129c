// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/grid/leaf_block.h"

#include <gtest/gtest.h>

#include <cmath>

namespace molsurf
{
namespace
{

using openvdb::Coord;

/// A number that tells the voxel.
float label(const Coord& c)
{
    return float(c.x() + 100 * c.y() + 10000 * c.z());
}

template<int Halo>
void expectGathered(const LeafTable& table)
{
    LeafField field(table.size());
    for (std::size_t n = 0; n < table.size(); ++n) {
        for (int v = 0; v < leafSize; ++v)
            field.leaf(n)[v] = label(table.origin(n).offsetBy(v >> 6, v >> 3 & 7, v & 7));
    }
    LeafBlock<float, Halo> block;
    for (std::size_t n = 0; n < table.size(); ++n) {
        block.gather(table, field, n);
        for (int x = -Halo; x < 8 + Halo; ++x) {
            for (int y = -Halo; y < 8 + Halo; ++y) {
                for (int z = -Halo; z < 8 + Halo; ++z) {
                    const Coord c = table.origin(n).offsetBy(x, y, z);
                    const auto into = [](int i) { return std::min(std::max(i, 0), 7); };
                    const auto& o = table.origin(n);
                    // Only where a voxel of the row's own leaf is missing too may the row above or
                    // below stand in; a missing leaf gives the nearest voxel of this leaf or of the
                    // leaf beside it.
                    if (table.find(c) != noLeaf) {
                        ASSERT_EQ(*block.at(x, y, z), label(c)) << c << " of " << o;
                    } else if (table.find(o.offsetBy(x, y, into(z))) == noLeaf) {
                        ASSERT_EQ(*block.at(x, y, z), label(o.offsetBy(into(x), into(y), into(z))))
                            << c << " of " << o;
                    } else {
                        ASSERT_EQ(*block.at(x, y, z), label(o.offsetBy(x, y, into(z))))
                            << c << " of " << o;
                    }
                }
            }
        }
    }
}

TEST(LeafBlock, GathersTheRimOfAllNeighbours)
{
    std::vector<Coord> all, some;
    for (int k = 0; k < 27; ++k) {
        const Coord origin(8 * (k / 9) - 8, 8 * (k / 3 % 3) - 16, 8 * (k % 3));
        all.push_back(origin);
        if (k % 5 != 1) some.push_back(origin);
    }
    for (const auto& origins : {all, some, std::vector<Coord>{Coord(-8, 0, 16)}}) {
        const LeafTable table(origins);
        expectGathered<1>(table);
        expectGathered<2>(table);
        expectGathered<3>(table);
    }
}

} // namespace
} // namespace molsurf
