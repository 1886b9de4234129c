// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The Euler number of the inside voxels of a level set, counted on its signs.

#include <openvdb/openvdb.h>
#include <openvdb/tools/VolumeToMesh.h>

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

/// The Euler number of the surface that OpenVDB's mesher makes of a grid's signs, twice that of the
/// set of inside voxels with the mesher's own rule for what is connected: voxels that share a face
/// or an edge (18), except where the square of an edge is the one ambiguous face of both cells that
/// share it; there the mesher inverts both cells, and the two voxels are apart
/// (correctCellSigns() and sAmbiguousFace in openvdb/tools/VolumeToMesh.h; the remedy of Nielson
/// and Hamann, The asymptotic decider, 1991, in the form of Wenger, Isosurfaces, 2013, for dual
/// cells).
inline std::int64_t mesherEuler(const openvdb::FloatGrid& grid)
{
    // The mesher's corners 0..7 of a cell, and its faces 1..6 by the axis and side.
    using openvdb::Coord;
    static const Coord corner[8] = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1},
                                    {0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}};
    static const Coord toward[7] = {{0, 0, 0},  {0, 0, -1}, {1, 0, 0}, {0, 0, 1},
                                    {-1, 0, 0}, {0, -1, 0}, {0, 1, 0}};
    static const int opposite[7] = {0, 3, 4, 1, 2, 6, 5};
    const auto& ambiguousFace = openvdb::tools::volume_to_mesh_internal::sAmbiguousFace;
    auto read = grid.getConstAccessor();
    const auto inside = [&](const Coord& c) { return read.getValue(c) < 0.0f; };
    const auto signs = [&](const Coord& cell) {
        int s = 0;
        for (int k = 0; k < 8; ++k) s |= int(inside(cell + corner[k])) << k;
        return s;
    };
    const auto cutFace = [&](const Coord& cell, int s) {
        const int face = ambiguousFace[s];
        return face != 0 && ambiguousFace[signs(cell + toward[face])] == opposite[face] ? face : 0;
    };
    // Pieces of cells - pieces of squares + faces of voxels - voxels, counted where signs differ;
    // a voxel that is inside with all its neighbours adds nothing, as below.
    std::int64_t eighths = 0;
    for (auto it = grid.cbeginValueOn(); it; ++it) {
        const Coord cell = it.getCoord();
        const int s = signs(cell);
        if (s == 0 || s == 255) continue;
        const int cut = cutFace(cell, s);
        const auto on = [s](int k) { return s >> k & 1; };
        const auto distance = [](int k, int m) {
            const Coord d = corner[k] - corner[m];
            return std::abs(d.x()) + std::abs(d.y()) + std::abs(d.z());
        };
        // Does the square that two corners span lie in the face that is cut?
        const auto apart = [&](int k, int m) {
            if (cut == 0) return false;
            for (int i = 0; i < 3; ++i) {
                if (toward[cut][i] != 0) {
                    const int side = toward[cut][i] > 0;
                    return corner[k][i] == side && corner[m][i] == side;
                }
            }
            return false;
        };
        int pieces = 0;
        for (int left = s; left != 0; ++pieces) {
            int piece = left & -left;
            for (int grown = 0; grown != piece;) {
                grown = piece;
                for (int k = 0; k < 8; ++k) {
                    for (int m = 0; m < 8 && (grown >> k & 1); ++m) {
                        if (!on(m)) continue;
                        const int d = distance(k, m);
                        if (d == 1 || (d == 2 && !apart(k, m))) piece |= 1 << m;
                    }
                }
            }
            left &= ~piece;
        }
        int squares = 0, pairs = 0, voxels = 0;
        for (int face = 1; face <= 6; ++face) {
            int count = 0, diagonal = 0;
            for (int k = 0; k < 8; ++k) {
                for (int i = 0; i < 3; ++i) {
                    if (toward[face][i] == 0 || corner[k][i] != (toward[face][i] > 0)) continue;
                    count += on(k);
                    for (int m = 0; m < k; ++m) {
                        diagonal +=
                            corner[m][i] == corner[k][i] && distance(k, m) == 2 && on(k) && on(m);
                    }
                }
            }
            squares += count == 2 && diagonal == 1 && face == cut ? 2 : count > 0;
        }
        for (int k = 0; k < 8; ++k) {
            voxels += on(k);
            for (int m = 0; m < k; ++m) pairs += distance(k, m) == 1 && (on(k) || on(m));
        }
        eighths += 8 * pieces - 4 * squares + 2 * pairs - voxels;
    }
    return 2 * (eighths / 8);
}

} // namespace molsurf::test
