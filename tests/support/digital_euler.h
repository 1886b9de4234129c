// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The Euler number of the inside voxels of a level set, counted on its signs.

#include <openvdb/openvdb.h>

#include <array>
#include <cstdint>

namespace molsurf::test
{

/// The Euler numbers of the set of inside voxels (value < 0), by what counts as connected: voxels
/// that share a face (6), a face or an edge (18), or any corner (26). The surface of the set has
/// twice as much.
struct DigitalEuler {
    std::int64_t six = 0, eighteen = 0, twentySix = 0;
    std::size_t ambiguousCells = 0; ///< cells of 2^3 voxels where the three differ
};

/// Every voxel, face, edge and corner is shared out among the cells of 2^3 voxels that hold it;
/// uniform cells then add nothing.
/// @pre all corners of cells with both signs are active
inline DigitalEuler digitalEuler(const openvdb::FloatGrid& grid)
{
    // Corner k of a cell is (k >> 2, k >> 1 & 1, k & 1).
    std::array<std::array<int, 3>, 256> eighths; // contribution of each configuration, times 8
    for (int inside = 0; inside < 256; ++inside) {
        const auto on = [inside](int k) { return inside >> k & 1; };
        int voxels = 0, pairsAll = 0, pairsAny = 0, squaresAll = 0, squaresAny = 0;
        for (int k = 0; k < 8; ++k) voxels += on(k);
        for (const int a : {1, 2, 4}) {
            for (int k = 0; k < 8; ++k) {
                if (k & a) continue;
                pairsAll += on(k) && on(k | a);
                pairsAny += on(k) || on(k | a);
            }
            const int b = a == 4 ? 1 : 2 * a; // the squares across a, seen along the third axis
            for (int k = 0; k < 8; ++k) {
                if (k & a || k & b) continue;
                squaresAll += on(k) && on(k | a) && on(k | b) && on(k | a | b);
                squaresAny += on(k) || on(k | a) || on(k | b) || on(k | a | b);
            }
        }
        int pieces = 0; // of the inside corners, joined across faces and edges of voxels
        for (int left = inside; left != 0; ++pieces) {
            int piece = left & -left;
            for (int grown = 0; grown != piece;) {
                grown = piece;
                for (int k = 0; k < 8; ++k) {
                    if (!(grown >> k & 1)) continue;
                    for (int m = 0; m < 8; ++m) {
                        if (on(m) && (k ^ m) != 7) piece |= 1 << m;
                    }
                }
            }
            left &= ~piece;
        }
        const int allOn = inside == 255, anyOn = inside != 0;
        eighths[inside] = {voxels - 2 * pairsAll + 4 * squaresAll - 8 * allOn,
                           8 * pieces - 4 * squaresAny + 2 * pairsAny - voxels,
                           8 * anyOn - 4 * squaresAny + 2 * pairsAny - voxels};
    }
    DigitalEuler sum;
    auto read = grid.getConstAccessor();
    for (auto it = grid.cbeginValueOn(); it; ++it) {
        int inside = 0;
        for (int k = 0; k < 8; ++k) {
            inside |= int(read.getValue(it.getCoord().offsetBy(k >> 2, k >> 1 & 1, k & 1)) < 0.0f)
                      << k;
        }
        const auto& e = eighths[inside];
        sum.six += e[0];
        sum.eighteen += e[1];
        sum.twentySix += e[2];
        sum.ambiguousCells += e[0] != e[1] || e[1] != e[2];
    }
    sum.six /= 8;
    sum.eighteen /= 8;
    sum.twentySix /= 8;
    return sum;
}

} // namespace molsurf::test
