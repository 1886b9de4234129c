// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/frame_source.h"

#include <gtest/gtest.h>

namespace molsurf
{
namespace
{

/// The numbers of frames of the models 1 to 10.
std::vector<int> numbersOf(const std::string& frames)
{
    const Progress progress;
    const FrameSource source(MOLSURF_TEST_DATA "/1d3z.pdb.gz", "", frames, {}, 1.4, progress);
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

} // namespace
} // namespace molsurf
