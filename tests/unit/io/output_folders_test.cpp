// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/output_folders.h"

#include "molsurf/error.h"
#include "support/folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace molsurf
{
namespace
{

namespace fs = std::filesystem;
using test::Folder;
using Names = std::vector<std::string>;

TEST(MadeFolders, GoAgainIfTheyAreEmpty)
{
    const Folder folder;
    {
        MadeFolders made;
        made.make(folder / "a/b");
        made.make(folder / "a/c");
        EXPECT_TRUE(fs::is_directory(folder / "a/b") && fs::is_directory(folder / "a/c"));
        EXPECT_EQ(made.made(), (Names{folder / "a/c", folder / "a/b", folder / "a"}));
    }
    EXPECT_EQ(folder.names(), Names());
}

TEST(MadeFolders, StayWithFiles)
{
    const Folder folder;
    {
        MadeFolders made;
        made.make(folder / "a/b");
        made.make(folder / "a/c");
        std::ofstream(folder / "a/b/file") << "text";
    }
    EXPECT_TRUE(fs::exists(folder / "a/b/file"));
    EXPECT_FALSE(fs::exists(folder / "a/c"));
}

TEST(MadeFolders, ThoseThatExistedStay)
{
    const Folder folder;
    fs::create_directory(folder / "old");
    {
        MadeFolders made;
        made.make(folder / "old");
        EXPECT_TRUE(made.made().empty());
        made.make(folder / "old/new/");
    }
    EXPECT_TRUE(fs::is_empty(folder / "old"));
}

TEST(MadeFolders, BehindAFileAreRefused)
{
    const Folder folder;
    std::ofstream(folder / "file") << "text";
    try {
        MadeFolders made;
        made.make(folder / "file/inner");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Output);
        EXPECT_NE(std::string(error.what()).find("cannot make the folder"), std::string::npos);
    }
    EXPECT_EQ(folder.names(), Names{"file"});
}

} // namespace
} // namespace molsurf
