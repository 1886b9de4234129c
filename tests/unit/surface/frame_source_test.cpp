// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/frame_source.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace molsurf
{
namespace
{

/// The numbers of frames of the models 1 to 10.
std::vector<int> numbersOf(const std::string& frames)
{
    const Progress progress;
    const FrameSource source(MOLSURF_TEST_DATA "/1d3z.pdb.gz", "", frames, Settings(), progress);
    std::vector<int> out;
    for (std::size_t i = 0; i < source.size(); ++i) out.push_back(source.number(i));
    return out;
}

TEST(FrameSource, StepsBeyondTheLastFrame)
{
    EXPECT_EQ(numbersOf("2-6:3"), (std::vector<int>{2, 5}));
    EXPECT_EQ(numbersOf("2-6:2147483647"), (std::vector<int>{2}));
    EXPECT_EQ(numbersOf("2-:2147483647"), (std::vector<int>{2}));
}

TEST(FrameSource, KeepsTheAtomsThatADistanceSelectsInTheFirstFrame)
{
    Settings asked;
    SelectOptions& options = asked.atoms;
    options.hetero = Hetero::All;
    options.select = "byres within 9 of resid 1 and x < 60";
    const Progress progress;
    for (const char* trajectory : {"", MOLSURF_TEST_DATA "/1d3z.xtc"}) {
        FrameSource source(MOLSURF_TEST_DATA "/1d3z.pdb.gz", trajectory, "1-3", asked, progress);
        const std::vector<Ball> first = source.balls(0).balls;
        const std::size_t shift = trajectory[0] ? 0 : 1231; // atoms of a model
        for (std::size_t i = 1; i < source.size(); ++i)
            for (std::size_t b = 0; b < first.size(); ++b)
                ASSERT_EQ(std::size_t(source.balls(i).balls[b].atom),
                          std::size_t(first[b].atom) + i * shift);
    }
}

// With update() a frame has the atoms that its own places select, as that model alone has.
TEST(FrameSource, TakesTheAtomsThatADistanceSelectsInEachFrame)
{
    Settings asked;
    SelectOptions& options = asked.atoms;
    options.hetero = Hetero::All;
    options.select = "within 9 of resid 1";
    const Progress progress;
    FrameSource source(MOLSURF_TEST_DATA "/1d3z.pdb.gz", "", "1-3", asked, progress);
    source.update();
    std::vector<std::size_t> counts;
    for (std::size_t i = 0; i < source.size(); ++i) {
        SelectOptions alone = options;
        alone.model = int(i) + 1;
        const BallSet model = readAtoms(MOLSURF_TEST_DATA "/1d3z.pdb.gz", alone, 1.4);
        ASSERT_EQ(source.balls(i).balls.size(), model.balls.size()) << i;
        for (std::size_t b = 0; b < model.balls.size(); ++b)
            EXPECT_EQ(source.balls(i).balls[b].center, model.balls[b].center);
        counts.push_back(model.balls.size());
    }
    EXPECT_NE(counts[0], counts[1]);
}

// Atoms that pictures show are those of the same frames: no file is read a second time.
TEST(FrameSource, GivesFurtherAtomsOfEachFrame)
{
    const Progress progress;
    for (const char* trajectory : {"", MOLSURF_TEST_DATA "/1d3z.xtc"}) {
        FrameSource source(MOLSURF_TEST_DATA "/1d3z.pdb.gz", trajectory, "1-3", Settings(),
                           progress);
        SelectOptions some;
        some.select = "within 5 of resid 10";
        const FrameSource::Choice choice = source.choose(some);
        for (std::size_t i = source.size(); i-- > 0;) {
            const std::vector<Ball>& all = source.balls(i).balls;
            const std::vector<Ball>& near = source.balls(i, choice).balls;
            ASSERT_EQ(near.size(), source.balls(0, choice).balls.size()) << i;
            ASSERT_LT(near.size(), all.size());
            for (const Ball& ball : near) {
                const auto same = std::find_if(all.begin(), all.end(), [&](const Ball& other) {
                    return other.atom == ball.atom;
                });
                ASSERT_NE(same, all.end());
                EXPECT_EQ(same->center, ball.center) << i;
            }
        }
    }
}

} // namespace
} // namespace molsurf
