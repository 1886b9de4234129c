// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/frame_files.h"

#include "molsurf/show/io/usda_text.h"

#include "support/folder.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
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

// A file that counts the same frame in other digits is another one; its own need not be there yet.
TEST(FrameFiles, AFrameIsListedOnce)
{
    const test::Folder folder;
    for (const char* name : {"a.1.vdb", "a.0002.vdb", "a.0003.usda", "b.0004.vdb", "a.vdb"})
        std::ofstream(folder / name) << "no grid";
    FrameOptions known;
    const FrameFiles files = framesBeside(folder / "a.0001.vdb", "", known);
    const std::vector<std::pair<int, std::string>> expected = {{1, "a.0001.vdb"},
                                                               {2, "a.0002.vdb"}};
    EXPECT_EQ(files.frames, expected);
    EXPECT_TRUE(files.leftOut.empty());
    EXPECT_EQ(framesBeside(folder / "a.0001.vdb", "others", known).leftOut,
              std::vector<std::string>{"a.0002.vdb"});
}

void writeStage(const std::filesystem::path& path, const char* options)
{
    std::ofstream(path) << usdaFirstLine << "\n(\n    customLayerData = {\n"
                        << usdaDataLine(usdaFrameOptions, options) << "\n    }\n)\n";
}

// A file is read again when it has changed, and not before.
TEST(FrameFiles, OptionsAreThoseOfTheFileAsItIs)
{
    const auto path = std::filesystem::path(testing::TempDir()) / "frame_options.0001.usda";
    FrameOptions known;
    writeStage(path, "first");
    EXPECT_EQ(known.of(std::filesystem::directory_entry(path)), "first");
    const auto before = std::filesystem::last_write_time(path);
    writeStage(path, "other");
    std::filesystem::last_write_time(path, before);
    EXPECT_EQ(known.of(std::filesystem::directory_entry(path)), "first");
    std::filesystem::last_write_time(path, before + std::chrono::seconds(2));
    EXPECT_EQ(known.of(std::filesystem::directory_entry(path)), "other");
    std::filesystem::remove(path);
}

} // namespace
} // namespace molsurf
