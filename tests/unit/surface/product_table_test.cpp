// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/product_table.h"

#include "molsurf/error.h"
#include "support/molecules.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

namespace molsurf
{
namespace
{

std::map<std::string, double> measuresOf(const std::vector<Ball>& balls, SurfaceOptions options)
{
    for (const MeasureRow& row : measureTable())
        if (options.grid || !(row.missingIn & InClosedForm)) options.measures.push_back(row.name);
    const Report report = makeSurface(balls, options).report;
    return {report.measures.begin(), report.measures.end()};
}

std::string refusal(const SurfaceOptions& options)
{
    try {
        checkOptions(options);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST(ProductTable, MeasuresOfABallAreKnown)
{
    SurfaceOptions options;
    options.kind = SurfaceKind::VanDerWaals;
    options.voxel = 0.25;
    auto found = measuresOf({{openvdb::Vec3d(40.0, -7.0, 3.0), 5.0, 0}}, options);
    EXPECT_NEAR(found["sphericity"], 1.0, 1e-9); // in closed form
    EXPECT_NEAR(found["gyration_radius"], std::sqrt(0.6) * 5.0, 2e-3);
}

TEST(ProductTable, TwoBallsApartHaveTheirMomentsBySteiner)
{
    SurfaceOptions options;
    options.kind = SurfaceKind::VanDerWaals;
    options.voxel = 0.25;
    auto found = measuresOf(
        {{openvdb::Vec3d(-6.0, 0, 0), 4.0, 0}, {openvdb::Vec3d(6.0, 0, 0), 4.0, 1}}, options);
    EXPECT_NEAR(found["sphericity"], std::cbrt(0.5), 1e-9);
    EXPECT_NEAR(found["gyration_radius"], std::sqrt(0.6 * 16.0 + 36.0), 3e-3);
}

TEST(ProductTable, AWayRefusesWhatItCannotGive)
{
    SurfaceOptions options;
    options.kind = SurfaceKind::VanDerWaals;
    options.grid = false;
    options.measures = {"sphericity"};
    EXPECT_EQ(refusal(options), "");
    EXPECT_NEAR(measuresOf({{openvdb::Vec3d(0.0), 5.0, 0}}, options)["sphericity"], 1.0, 1e-9);
    options.measures = {"gyration_radius"};
    EXPECT_EQ(missingIn(InClosedForm, options), "`measures` gyration_radius");
    EXPECT_NE(refusal(options), "");
    EXPECT_EQ(missingIn(InBricks, options), "`measures` gyration_radius");
}

// The mesh of a unit or of prototypes is not that of the whole.
TEST(ProductTable, MeasuresAreOfAWhole)
{
    BallSet atoms;
    atoms.balls = test::randomBalls(9, 5.0, {20, 0, 0}, 1);
    atoms.placement.instances = {{Motion::identity(), 0, "1"}, {Motion::identity(), 0, "2"}};
    SurfaceOptions options;
    options.measures = {"sphericity"};
    try {
        checkProducts(atoms, options);
        FAIL();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(),
                     "`measures`: expected one surface, and not `instances` or `bySymmetry`");
    }
}

// A number that nobody asked for is not there, and names are those of rows.
TEST(ProductTable, MeasuresAreAskedForByName)
{
    SurfaceOptions options;
    options.voxel = 1.0;
    EXPECT_TRUE(
        makeSurface(test::randomBalls(9, 5.0, {0, 0, 0}, 1), options).report.measures.empty());
    options.measures = {"girth"};
    EXPECT_EQ(refusal(options), "`measures`: there is no measure 'girth'");
}

} // namespace molsurf
