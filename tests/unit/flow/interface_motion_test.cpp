// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/flow/interface_motion.h"

#include "support/fields.h"

#include <gtest/gtest.h>

#include <cmath>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

constexpr double edge = 0.25, width = 3.0 * edge;
const Vec3d centre(0.31, -0.12, 0.07);

/// The ways that are measured as a ball of 2 Å becomes larger.
Displacements waysOf(double growth, const Region& region = {})
{
    const auto ball = [](double radius) {
        return [radius](const Vec3d& x) { return (x - centre).length() - radius; };
    };
    const LeafTable table = test::bandTable(ball(2.0), centre, 2.0, edge, width);
    LeafField before = std::move(test::filled(table, edge, ball(2.0)).values);
    SparseField after = test::filled(table, edge, ball(2.0 + growth));
    InterfaceMotion motion(table, region, edge);
    reinitialize(after, {width, 2, Repair::Errors, motion.watch()}, Progress(), before);
    float largest = 0.0f;
    for (const float way : motion.largest()) largest = std::max(largest, way);
    EXPECT_NEAR(largest, std::abs(growth) / edge, 0.1 * std::abs(growth) / edge + 1e-3);
    return motion.sum();
}

// By short ways crossings stay on their edges, by long ones they come to others.
TEST(InterfaceMotion, IsAlongTheNormal)
{
    for (const double way : {0.02, 0.1, 0.6, -0.02, -0.1, -0.6}) {
        const Displacements ways = waysOf(way * edge);
        EXPECT_GT(ways.count, 900u);
        EXPECT_NEAR(ways.mean(), std::abs(way), 0.06 * std::abs(way)) << way;
        EXPECT_NEAR(ways.quantile(0.5), std::abs(way), 0.13 * std::abs(way)) << way;
    }
}

// What stands has no way, however far its values are from a distance.
TEST(InterfaceMotion, IsNoneWhereValuesAloneChange)
{
    const auto ball = [](double scale) {
        return [scale](const Vec3d& x) { return scale * ((x - centre).length() - 2.0); };
    };
    const LeafTable table = test::bandTable(ball(1.0), centre, 2.0, edge, width);
    LeafField before = std::move(test::filled(table, edge, ball(0.8)).values);
    SparseField after = test::filled(table, edge, ball(1.0));
    const Region everywhere;
    InterfaceMotion motion(table, everywhere, edge);
    reinitialize(after, {width, 1, Repair::Errors, motion.watch()}, Progress(), before);
    EXPECT_GT(motion.sum().count, 1000u);
    EXPECT_LT(motion.sum().rms(), 1e-3);
}

TEST(InterfaceMotion, CountsWhatARegionOwns)
{
    Region half;
    half.owned = openvdb::CoordBBox(openvdb::Coord(-1000), openvdb::Coord(-1, 1000, 1000));
    const double share = double(waysOf(0.1 * edge, half).count) / double(waysOf(0.1 * edge).count);
    EXPECT_GT(share, 0.3);
    EXPECT_LT(share, 0.5);
}

} // namespace
} // namespace molsurf
