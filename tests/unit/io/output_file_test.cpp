// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/output_file.h"

#include "molsurf/error.h"
#include "molsurf/show/io/temporary_file.h"
#include "support/folder.h"

#include <gtest/gtest.h>

#include <functional>

namespace molsurf
{
namespace
{

using test::contentOf;
using test::Folder;
using Names = std::vector<std::string>;

// The message of the Error(Output) that must come.
std::string refusal(const std::function<void()>& act)
{
    try {
        act();
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::Output);
        EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
        return e.what();
    }
    ADD_FAILURE() << "expected an Error";
    return "";
}

TEST(OutputFile, AppearsAtCommitAndNotBefore)
{
    const Folder folder;
    OutputFile file(folder / "a.ply", false);
    file.write("abc", 3);
    file.finish();
    EXPECT_FALSE(std::filesystem::exists(folder / "a.ply"));
    EXPECT_EQ(folder.names(), Names{std::filesystem::path(temporaryName("a.ply")).filename()});
    file.commit();
    EXPECT_EQ(contentOf(folder / "a.ply"), "abc");
    EXPECT_EQ(folder.names(), Names{"a.ply"});
}

TEST(OutputFile, WithoutCommitLeavesNothing)
{
    const Folder folder;
    {
        OutputFile file(folder / "a.ply", false);
        file.write("abc", 3);
    }
    EXPECT_EQ(folder.names(), Names{});
}

TEST(OutputFile, WithoutCommitLeavesTheOldFile)
{
    const Folder folder;
    std::ofstream(folder / "a.ply") << "old";
    {
        OutputFile file(folder / "a.ply", true);
        file.write("new", 3);
    }
    EXPECT_EQ(contentOf(folder / "a.ply"), "old");
    EXPECT_EQ(folder.names(), Names{"a.ply"});
}

TEST(OutputFile, ReplacesOnlyIfTold)
{
    const Folder folder;
    std::ofstream(folder / "a.ply") << "old";
    const std::string why = refusal([&] { checkWritable(folder / "a.ply", false); });
    EXPECT_NE(why.find("exists"), std::string::npos) << why;
    EXPECT_NE(why.find("`force`"), std::string::npos) << why;
    refusal([&] { OutputFile(folder / "a.ply", false); });
    EXPECT_EQ(contentOf(folder / "a.ply"), "old");

    OutputFile file(folder / "a.ply", true);
    file.write("new", 3);
    file.commit();
    EXPECT_EQ(contentOf(folder / "a.ply"), "new");
}

TEST(OutputFile, DoesNotReplaceAFileThatCameMeanwhile)
{
    const Folder folder;
    OutputFile file(folder / "a.ply", false);
    std::ofstream(folder / "a.ply") << "other";
    refusal([&] { file.commit(); });
    EXPECT_EQ(contentOf(folder / "a.ply"), "other");
}

TEST(OutputFile, RefusesFoldersThatAreNotThereAndFoldersAsFiles)
{
    const Folder folder;
    const std::string why = refusal([&] { checkWritable(folder / "none/a.ply", false); });
    EXPECT_NE(why.find(folder / "none"), std::string::npos) << why;
    EXPECT_NE(why.find("No such file"), std::string::npos) << why;
    std::filesystem::create_directory(folder / "a.ply");
    refusal([&] { checkWritable(folder / "a.ply", true); });
    refusal([&] { checkWritable("/dev/null", true); });
}

TEST(OutputFile, RefusesNamesThatAreTooLong)
{
    const Folder folder;
    for (const int length : {255, 256, 5000}) {
        const std::string why =
            refusal([&] { checkWritable(folder / std::string(std::size_t(length), 'a'), true); });
        EXPECT_NE(why.find("File name too long"), std::string::npos) << why;
    }
    checkWritable(folder / std::string(220, 'a'), false);
}

TEST(OutputFile, FollowsASymbolicLink)
{
    const Folder folder;
    std::ofstream(folder / "real.ply") << "old";
    std::filesystem::create_symlink("real.ply", folder / "a.ply");
    OutputFile file(folder / "a.ply", true);
    file.write("new", 3);
    file.commit();
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "a.ply"));
    EXPECT_EQ(contentOf(folder / "real.ply"), "new");
}

TEST(OutputFile, StandardOutputHasNoTemporaryFile)
{
    EXPECT_EQ(temporaryName("-"), "");
    EXPECT_NO_THROW(checkWritable("-", false));
    OutputFile file("-", false);
    EXPECT_FALSE(file.seekable());
}

} // namespace
} // namespace molsurf
