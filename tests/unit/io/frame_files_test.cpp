// SPDX-License-Identifier: MPL-2.0
#include "molsurf/io/frame_files.h"

#include <gtest/gtest.h>

#include <string>

namespace molsurf
{
namespace
{

void expectName(const char* path, const char* stem, std::optional<int> frame)
{
    const FrameName name = frameName(path);
    EXPECT_EQ(name.stem, stem) << path;
    EXPECT_EQ(name.frame, frame) << path;
}

TEST(FrameFiles, AreNamedByStemAndNumber)
{
    expectName("name.0001.vdb", "name", 1);
    expectName("folder.2/name.12.usda", "name", 12);
    expectName("a.b.0300.vdb", "a.b", 300);
    for (const char* none : {"name.vdb", "name.x1.vdb", "name.-1.vdb", "name.1e2.vdb"})
        expectName(none, std::string(none).substr(0, std::string(none).size() - 4).c_str(), {});
    expectName(".0001.vdb", ".0001", {}); // a number and nothing that it counts
}

} // namespace
} // namespace molsurf
