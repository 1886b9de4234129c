// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/pipeline/surface_kind.h"
#include "support/runs.h"

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <limits>
#include <string>

namespace molsurf
{
namespace
{

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

void expectRefused(const std::string& name, const std::function<void(SurfaceOptions&)>& change)
{
    SurfaceOptions options;
    change(options);
    try {
        checkOptions(options);
        ADD_FAILURE() << name << " was taken";
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::Usage);
        EXPECT_NE(std::string(e.what()).find(name), std::string::npos) << e.what();
    }
}

TEST(CheckOptions, RefusesWhatIsOutOfRangeAndNamesTheOption)
{
    for (const double x : {0.0, -0.5, 0.049, 10.1, inf, nan})
        expectRefused("`voxel`", [x](SurfaceOptions& o) { o.voxel = x; });
    for (const double x : {-0.1, 101.0, inf, nan})
        expectRefused("`probe`", [x](SurfaceOptions& o) { o.probe = x; });
    for (const double x : {0.0, -1.0, 101.0, inf, nan})
        expectRefused("`epsilon`", [x](SurfaceOptions& o) { o.epsilon = x; });
    for (const double x : {-0.01, 1e7, inf, nan})
        expectRefused("`lambda`", [x](SurfaceOptions& o) { o.evolution.lambda = x; });
    for (const double x : {0.0, -1.0, inf, nan})
        expectRefused("`tolerance`", [x](SurfaceOptions& o) { o.evolution.tolerance = x; });
    for (const int x : {-1, 3})
        expectRefused("`splineLevel`", [x](SurfaceOptions& o) { o.splineLevel = x; });
    expectRefused("`fields`", [](SurfaceOptions& o) { o.fields = {"sas", "colour"}; });
}

TEST(CheckOptions, TakesTheDefaultsAndTheEndsOfTheRanges)
{
    EXPECT_NO_THROW(checkOptions(SurfaceOptions()));
    SurfaceOptions options;
    options.voxel = minVoxel;
    options.probe = 0.0;
    options.evolution.lambda = 0.0;
    options.splineLevel = 2;
    EXPECT_NO_THROW(checkOptions(options));
    options.voxel = maxVoxel;
    EXPECT_NO_THROW(checkOptions(options));
}

TEST(Run, ChecksItsOptionsAndInput)
{
    SurfaceOptions options;
    options.voxel = 0.0;
    try {
        test::runOn(test::balls("1crn.pdb"), options);
        FAIL() << "expected an Error";
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::Usage);
    }
    try {
        test::runOn({});
        FAIL() << "expected an Error";
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::Input);
    }
}

// Cancelled at once, and after every so many questions: in each stage.
TEST(Run, StopsWhenCancelled)
{
    struct StopAfter : Progress {
        explicit StopAfter(int n) : left(n) {}
        mutable std::atomic<int> left;
        bool cancelled() const override { return --left < 0; }
    };
    const std::vector<Ball> balls = {{openvdb::Vec3f(0.1f, 0.2f, 0.3f), 1.7f, 0}};
    StopAfter count(1 << 30);
    makeSurface(balls, SurfaceOptions(), &count);
    const int questions = (1 << 30) - count.left;
    ASSERT_GT(questions, 20);
    for (int k = 0; k < 10; ++k) {
        StopAfter progress(k * questions / 11);
        EXPECT_THROW(makeSurface(balls, SurfaceOptions(), &progress), Cancelled) << k;
    }
}

TEST(Run, TellsItsProgress)
{
    struct Listen : Progress {
        std::vector<std::string> stages;
        bool good = true;
        void update(const char* stage, double fraction) override
        {
            if (stages.empty() || stages.back() != stage) stages.push_back(stage);
            good = good && fraction >= 0.0 && fraction <= 1.0;
        }
    } progress;
    makeSurface({{openvdb::Vec3f(0.1f, 0.2f, 0.3f), 1.7f, 0}}, SurfaceOptions(), &progress);
    EXPECT_TRUE(progress.good);
    ASSERT_GE(progress.stages.size(), 5u);
    EXPECT_EQ(progress.stages.front(), "density");
    EXPECT_EQ(progress.stages.back(), "color");
}

} // namespace
} // namespace molsurf
