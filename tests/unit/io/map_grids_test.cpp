// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/map_grids.h"

#include "molsurf/error.h"
#include "support/folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

/// How a map is written.
struct MrcKind {
    int mode = 2;
    bool isBig = false;
    std::array<int, 3> axes{1, 2, 3}; ///< of columns, rows and sections
    std::array<int, 3> start{};       ///< along these
    Vec3d origin{0.0};                ///< [Å]
    float angle = 90.0f;
    std::size_t extended = 0, cut = 0; ///< [byte]
};

constexpr std::array<int, 3> counts{4, 5, 6};
const Vec3d steps(0.5, 1.0, 2.0);

float valueAt(int x, int y, int z)
{
    return float(x + 10 * y - 25 * z);
}

std::string mrc(const MrcKind& kind)
{
    std::string out(1024 + kind.extended, '\0');
    const auto put = [&](std::size_t at, std::uint32_t bits, std::size_t width) {
        for (std::size_t k = 0; k < width; ++k)
            out[at + k] = char(bits >> 8 * (kind.isBig ? width - 1 - k : k));
    };
    const auto word = [&](std::size_t n, int value) { put(4 * (n - 1), std::uint32_t(value), 4); };
    const auto real = [&](std::size_t n, float value) {
        std::uint32_t bits = 0;
        std::memcpy(&bits, &value, 4);
        put(4 * (n - 1), bits, 4);
    };
    for (std::size_t k = 0; k < 3; ++k) {
        word(1 + k, counts[std::size_t(kind.axes[k] - 1)]);
        word(5 + k, kind.start[k]);
        word(8 + k, counts[k]);
        real(11 + k, float(steps[int(k)] * counts[k]));
        real(14 + k, kind.angle);
        word(17 + k, kind.axes[k]);
        real(50 + k, float(kind.origin[int(k)]));
    }
    word(4, kind.mode);
    word(24, int(kind.extended));
    out.replace(208, 4, "MAP ");
    std::array<int, 3> at{};
    int &c = at[std::size_t(kind.axes[0] - 1)], &r = at[std::size_t(kind.axes[1] - 1)],
        &s = at[std::size_t(kind.axes[2] - 1)];
    const auto sizeOf = [&](std::size_t k) { return counts[std::size_t(kind.axes[k] - 1)]; };
    for (s = 0; s < sizeOf(2); ++s)
        for (r = 0; r < sizeOf(1); ++r)
            for (c = 0; c < sizeOf(0); ++c) {
                const float value = valueAt(at[0], at[1], at[2]);
                const std::size_t end = out.size();
                if (kind.mode == 2) {
                    out.resize(end + 4);
                    std::uint32_t bits = 0;
                    std::memcpy(&bits, &value, 4);
                    put(end, bits, 4);
                } else if (kind.mode == 1) {
                    out.resize(end + 2);
                    put(end, std::uint32_t(int(value)), 2);
                } else if (kind.mode == 12) { // exact for these integers
                    out.resize(end + 2);
                    int exponent = 0;
                    const float mantissa = std::frexp(std::abs(value), &exponent);
                    const std::uint32_t half =
                        value == 0.0f ? 0u
                                      : std::uint32_t(exponent + 14) << 10 |
                                            (std::uint32_t(mantissa * 2048.0f) & 1023u);
                    put(end, half | (value < 0.0f ? 0x8000u : 0u), 2);
                } else {
                    out.push_back(char(std::clamp(int(value), -128, 127)));
                }
            }
    out.resize(out.size() - kind.cut);
    return out;
}

ScalarMap readAs(const MrcKind& kind)
{
    const test::Folder folder;
    std::ofstream(folder / "a.map", std::ios::binary) << mrc(kind);
    return readMap(folder / "a.map");
}

TEST(ReadMrc, TakesEveryModeOrderAndPlace)
{
    std::vector<MrcKind> kinds(8);
    kinds[1].mode = 1;
    kinds[2].mode = 12;
    kinds[3].isBig = true;
    kinds[4].axes = {3, 1, 2};
    kinds[5].axes = {2, 3, 1};
    kinds[5].isBig = true;
    kinds[6].extended = 160;
    kinds[7].mode = 0;
    for (std::size_t k = 0; k < kinds.size(); ++k) {
        const ScalarMap map = readAs(kinds[k]);
        EXPECT_EQ(map.spacing, steps) << k;
        EXPECT_EQ(map.origin, Vec3d(0.0)) << k;
        ASSERT_EQ(map.values.size(), std::size_t(counts[0] * counts[1] * counts[2])) << k;
        std::size_t i = 0;
        for (int x = 0; x < counts[0]; ++x)
            for (int y = 0; y < counts[1]; ++y)
                for (int z = 0; z < counts[2]; ++z)
                    ASSERT_EQ(map.values[i++], valueAt(x, y, z)) << k << ": " << x << y << z;
    }
}

TEST(ReadMrc, LiesAtItsOriginElseAtItsStart)
{
    MrcKind kind;
    kind.axes = {3, 1, 2};
    kind.start = {7, -4, 2}; // of z, x, y
    EXPECT_EQ(readAs(kind).origin, Vec3d(-2.0, 2.0, 14.0));
    kind.origin = Vec3d(1.5, 0.0, -3.0);
    EXPECT_EQ(readAs(kind).origin, kind.origin);
}

TEST(ReadMrc, RefusesOthers)
{
    MrcKind bad;
    bad.mode = 4;
    EXPECT_THROW(readAs(bad), Error);
    bad = {};
    bad.angle = 60.0f;
    EXPECT_THROW(readAs(bad), Error);
    bad = {};
    bad.axes = {1, 1, 3};
    EXPECT_THROW(readAs(bad), Error);
    bad = {};
    bad.cut = 1;
    EXPECT_THROW(readAs(bad), Error);
}

/// The distance from a point, on a lattice.
ScalarMap conesAbout(const Vec3d& middle, const Vec3d& spacing, double factor)
{
    ScalarMap map;
    map.origin = Vec3d(-5.0, -6.0, -7.0);
    map.spacing = spacing;
    for (std::size_t a = 0; a < 3; ++a) map.counts[a] = 30;
    for (int x = 0; x < 30; ++x)
        for (int y = 0; y < 30; ++y)
            for (int z = 0; z < 30; ++z)
                map.values.push_back(
                    float(factor * (map.origin + spacing * Vec3d(x, y, z) - middle).length()));
    return map;
}

TEST(MapGrids, FogHasTheValuesInPlace)
{
    const Vec3d middle(1.0, 0.5, -0.25);
    const auto fog = fogOf(conesAbout(middle, Vec3d(0.5, 0.4, 0.6), 1.0));
    EXPECT_EQ(fog->getGridClass(), openvdb::GRID_FOG_VOLUME);
    EXPECT_EQ(fog->activeVoxelCount(), 27000u);
    for (auto voxel = fog->cbeginValueOn(); voxel; ++voxel)
        ASSERT_NEAR(*voxel, (fog->indexToWorld(voxel.getCoord()) - middle).length(), 1e-5);
}

// Where it has more than a value above 0, or less than one below 0, is inside.
TEST(MapGrids, LevelSetsAreDistancesFromTheValue)
{
    const Vec3d middle(1.0, 0.5, -0.25);
    for (const auto& [sign, spacing] :
         {std::pair(1.0, Vec3d(0.5)), {-1.0, Vec3d(0.5)}, {1.0, Vec3d(0.53, 0.5, 0.61)}}) {
        ScalarMap map = conesAbout(middle, spacing, -sign);
        for (float& value : map.values) value += float(sign * 6.0);
        const auto grid = levelSetOf(map, sign * 2.0); // 4 Å from the middle
        EXPECT_EQ(grid->getGridClass(), openvdb::GRID_LEVEL_SET);
        EXPECT_EQ(grid->background(), 1.5f);
        EXPECT_GT(grid->activeVoxelCount(), 3000u);
        for (auto voxel = grid->cbeginValueOn(); voxel; ++voxel) {
            const double there = (grid->indexToWorld(voxel.getCoord()) - middle).length() - 4.0;
            ASSERT_NEAR(*voxel, there, 0.17);
        }
        EXPECT_EQ(grid->tree().getValue(openvdb::Coord(12, 13, 13)), -1.5f);
    }
    ScalarMap flat = conesAbout(middle, Vec3d(1e6, 1e6, 1e-6), 1.0);
    EXPECT_THROW(levelSetOf(flat, 2.0), Error) << "too many cubes";
    EXPECT_THROW(levelSetOf(conesAbout(middle, Vec3d(0.5), 1.0), 99.0), Error);
}

} // namespace
} // namespace molsurf
