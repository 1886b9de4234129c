// SPDX-License-Identifier: MPL-2.0
#include "molsurf/io/commit.h"

#include "molsurf/error.h"
#include "molsurf/io/temporary_file.h"
#include "support/folder.h"

#include <gtest/gtest.h>

#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>

namespace molsurf
{
namespace
{

using test::contentOf;
using test::Folder;
using Names = std::vector<std::string>;

/// Runs `act` in a process of its own that is killed before its system call `last`, counted from 1.
/// @return false if the process ended before, or cannot be traced
bool killedAt(int last, const std::function<void()>& act)
{
    const pid_t child = fork();
    if (child == 0) {
        if (ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) _exit(1);
        raise(SIGSTOP);
        act();
        _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    for (int stop = 0; WIFSTOPPED(status) && stop < 2 * last - 1; ++stop) { // one before, one after
        ptrace(PTRACE_SYSCALL, child, nullptr, nullptr);
        waitpid(child, &status, 0);
    }
    if (!WIFSTOPPED(status)) return false;
    kill(child, SIGKILL);
    waitpid(child, &status, 0);
    return true;
}

void writeText(const std::string& text, OutputFile& file)
{
    file.write(text.data(), text.size());
}

/// Writes "new" to all paths.
void replaceAll(const Names& paths)
{
    std::vector<std::unique_ptr<OutputFile>> files;
    std::vector<OutputFile*> all;
    for (const std::string& path : paths) {
        files.push_back(std::make_unique<OutputFile>(path, true));
        writeText("new", *files.back());
        all.push_back(files.back().get());
    }
    commit(all);
}

/// Kills the writing of three files at every system call, and recovers.
/// @param[in] second  the folder that the third file lies in, seen from that of the others
/// @param[in] order   of the folders that are recovered
void killEverywhere(const std::string& second, const Names& order)
{
    int kills = 0, allNew = 0;
    for (bool killed = true; killed; ++kills) {
        const Folder folder;
        std::filesystem::create_directory(folder / "other");
        const Names paths = {folder / "a", folder / "b", folder / second + "/c"};
        for (const std::string& path : paths) std::ofstream(path) << "old";
        killed = killedAt(kills + 1, [&] { replaceAll(paths); });
        for (const std::string& place : order) recover(folder / place);
        const std::string content = contentOf(paths[0]);
        EXPECT_TRUE(content == "old" || content == "new") << content;
        for (const std::string& path : paths)
            EXPECT_EQ(contentOf(path), content) << path << " after " << kills << " system calls";
        Names names = {"a", "b", "other"};
        if (second == ".") names.insert(names.begin() + 2, "c");
        EXPECT_EQ(folder.names(), names) << kills;
        const auto inOther = std::filesystem::directory_iterator(folder / "other");
        EXPECT_EQ(std::distance(begin(inOther), end(inOther)), second == "." ? 0 : 1) << kills;
        allNew += content == "new";
    }
    if (kills == 1) GTEST_SKIP() << "processes cannot be traced here";
    testing::Test::RecordProperty("kills", kills - 1);
    EXPECT_GT(kills, 20);
    EXPECT_GT(allNew, 5);
    EXPECT_LT(allNew, kills - 10);
}

TEST(Commit, IsWholeWheneverItIsKilled)
{
    killEverywhere(".", {"."});
}

TEST(Commit, IsWholeInTwoFolders)
{
    killEverywhere("other", {".", "other"});
    killEverywhere("other", {"other", "."});
}

TEST(Commit, PlacesNoFileIfOneIsThereAlready)
{
    const Folder folder;
    OutputFile a(folder / "a", false), b(folder / "b", false);
    writeText("new", a);
    writeText("new", b);
    std::ofstream(folder / "b") << "other";
    EXPECT_THROW(commit({&a, &b}), Error);
    EXPECT_FALSE(std::filesystem::exists(folder / "a"));
    EXPECT_EQ(contentOf(folder / "b"), "other");
    a.place();
    a.takeBack();
    EXPECT_FALSE(std::filesystem::exists(folder / "a"));
}

TEST(Commit, LeavesNoRecord)
{
    const Folder folder;
    replaceAll({folder / "a", folder / "b"});
    EXPECT_EQ(folder.names(), (Names{"a", "b"}));
}

TEST(Recover, LeavesFilesOfProcessesAtWork)
{
    const Folder folder;
    OutputFile file(folder / "a", false);
    const Names before = folder.names();
    ASSERT_EQ(before.size(), 1u);
    recover(folder / ".");
    EXPECT_EQ(folder.names(), before);
}

TEST(Recover, LeavesFilesOfOtherNames)
{
    const Folder folder;
    const Names names = {".a.12.part", ".a.part", ".vdb_molsurf.commit", "a.12-0123abcd.part"};
    for (const std::string& name : names) std::ofstream(folder / name) << "mine";
    recover(folder / ".");
    EXPECT_EQ(folder.names(), names);
    std::ofstream(folder / ".a.12-0123abcd.part") << "a process that is gone";
    std::filesystem::create_directories(folder / ".bricks.12-0123abcd.part/deep");
    recover(folder / ".");
    EXPECT_EQ(folder.names(), names);
}

TEST(Recover, DoesNotReplaceAFileThatCameMeanwhile)
{
    const Folder folder;
    const std::string maker = "12-0123abcd";
    std::ofstream(folder / ".vdb_molsurf." + maker + ".commit") << std::string("+a\0=b\0", 6);
    for (const char* name : {"a", "b"}) {
        std::ofstream(folder / name) << "other";
        std::ofstream(temporaryName(folder / name, maker)) << "new";
    }
    recover(folder / ".");
    EXPECT_EQ(folder.names(), (Names{"a", "b"}));
    EXPECT_EQ(contentOf(folder / "a"), "other");
    EXPECT_EQ(contentOf(folder / "b"), "new");
}

TEST(Recover, EndsWithARecordThatNamesItsOwnFolder)
{
    const Folder folder;
    std::ofstream(folder / ".vdb_molsurf.12-0123abcd.commit") << std::string("@.\0", 3);
    recover(folder / ".");
}

} // namespace
} // namespace molsurf
