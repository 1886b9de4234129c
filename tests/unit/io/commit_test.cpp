// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/commit.h"

#include "molsurf/error.h"
#include "molsurf/show/io/temporary_file.h"
#include "support/folder.h"

#include <gtest/gtest.h>

#include <sys/ptrace.h>
#include <sys/stat.h>
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

/// Kills the writing of files at every system call, and recovers.
/// @param[in] files  in a folder, and in "other" in it
/// @param[in] order  of the folders that are recovered
void killEverywhere(const Names& files, const Names& order)
{
    int kills = 0, allNew = 0;
    for (bool killed = true; killed; ++kills) {
        const Folder folder;
        std::filesystem::create_directory(folder / "other");
        Names paths;
        for (const std::string& file : files) paths.push_back(folder / file);
        for (const std::string& path : paths) std::ofstream(path) << "old";
        killed = killedAt(kills + 1, [&] { replaceAll(paths); });
        for (const std::string& place : order) recover(folder / place);
        const std::string content = contentOf(paths[0]);
        EXPECT_TRUE(content == "old" || content == "new") << content;
        for (const std::string& path : paths)
            EXPECT_EQ(contentOf(path), content) << path << " after " << kills << " system calls";
        const auto all = std::filesystem::recursive_directory_iterator(folder / ".");
        EXPECT_EQ(std::distance(begin(all), end(all)), std::ptrdiff_t(files.size()) + 1) << kills;
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
    killEverywhere({"a", "b", "c"}, {"."});
    killEverywhere({"a", "b"}, {"."});
}

TEST(Commit, IsWholeInTwoFolders)
{
    killEverywhere({"a", "b", "other/c"}, {".", "other"});
    killEverywhere({"a", "b", "other/c"}, {"other", "."});
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
    a.place(false);
    a.takeBack();
    EXPECT_FALSE(std::filesystem::exists(folder / "a"));
}

TEST(Commit, BringsBackWhatItHasReplaced)
{
    const Folder folder;
    const Names names = {"a", "b", "c"};
    for (const std::string& name : names) std::ofstream(folder / name) << "old";
    OutputFile a(folder / "a", true), b(folder / "b", true), c(folder / "c", true),
        d(folder / "d", false);
    for (OutputFile* file : {&a, &b, &c, &d}) writeText("new", *file);
    std::ofstream(folder / "d") << "other";
    EXPECT_THROW(commit({&a, &b, &c, &d}), Error);
    for (const std::string& name : names) EXPECT_EQ(contentOf(folder / name), "old") << name;
    EXPECT_EQ(contentOf(folder / "d"), "other");
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
    const Names names = {".a.12.part", ".a.part", ".vdb_molsurf.12.commit", ".vdb_molsurf.commit",
                         "a.12-0123abcd89abcdef.part"};
    for (const std::string& name : names) std::ofstream(folder / name) << "mine";
    recover(folder / ".");
    EXPECT_EQ(folder.names(), names);
    std::ofstream(folder / ".a.12-0123abcd89abcdef.part") << "a process that is gone";
    std::filesystem::create_directories(folder / ".bricks.12-0123abcd89abcdef.part/deep");
    recover(folder / ".");
    EXPECT_EQ(folder.names(), names);
}

TEST(Recover, DoesNotReplaceAFileThatCameMeanwhile)
{
    const Folder folder;
    const std::string maker = "12-0123abcd89abcdef";
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

const std::string maker = "12-0123abcd89abcdef", record = ".vdb_molsurf." + maker + ".commit";

/// Makes a complete file of a process that is gone.
void leaveComplete(const std::string& path)
{
    std::ofstream(temporaryName(path, maker)) << "new";
}

void writeRecord(const std::string& path, const std::string& entries)
{
    std::ofstream(path) << entries;
}

TEST(Recover, EndsWithRecordsThatNameEachOther)
{
    using namespace std::string_literals;
    const Folder folder;
    std::filesystem::create_directory(folder / "b");
    for (const std::string& entries : {"@.\0"s, "&.\0"s, "@b\0"s, "&b\0"s}) {
        writeRecord(folder / record, entries);
        writeRecord(folder / ("b/" + record), "@..\0"s);
        recover(folder / ".");
        recover(folder / "b");
        EXPECT_EQ(folder.names(), (Names{"b"})) << entries;
        EXPECT_TRUE(std::filesystem::is_empty(folder / "b")) << entries;
    }
}

// A record counts in its folder alone, and in others that have one which leads back.
TEST(Recover, WritesNowhereElse)
{
    using namespace std::string_literals;
    const Folder folder;
    for (const char* name : {"in", "other"}) std::filesystem::create_directory(folder / name);
    for (const char* name : {"a", "in/a", "other/a"}) leaveComplete(folder / name);
    writeRecord(folder / ("in/" + record),
                "=../a\0=.\0=..\0=/\0=\0&..\0&../other\0&none\0=../other/a\0=a\0"s);
    writeRecord(folder / ("other/" + record), "@.\0=a\0"s);
    recover(folder / "in");
    EXPECT_EQ(contentOf(folder / "in/a"), "new");
    EXPECT_FALSE(std::filesystem::exists(folder / "a"));
    EXPECT_FALSE(std::filesystem::exists(folder / "other/a"));
}

TEST(Recover, DoesAllThatTheFirstRecordDecides)
{
    using namespace std::string_literals;
    const Folder folder;
    std::filesystem::create_directory(folder / "b");
    writeRecord(folder / record, "&b\0=a\0"s);
    writeRecord(folder / ("b/" + record), "@..\0=c\0"s);
    for (const char* name : {"a", "b/c"}) leaveComplete(folder / name);
    recover(folder / ".");
    EXPECT_EQ(folder.names(), (Names{"a", "b"}));
    EXPECT_FALSE(std::filesystem::exists(folder / ("b/" + record)));
    for (const char* name : {"a", "b/c"}) EXPECT_EQ(contentOf(folder / name), "new");
}

TEST(Recover, NamesTheRecordThatItCannotFollow)
{
    const Folder folder;
    std::filesystem::create_directory(folder / "a");
    leaveComplete(folder / "a");
    writeRecord(folder / record, std::string("=a\0", 3));
    try {
        recover(folder / ".");
        FAIL() << "a file cannot replace a folder";
    } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find("remove " + (folder / ("./" + record))),
                  std::string::npos)
            << e.what();
    }
}

// The record of a first folder decides, and a process that holds it is at it.
TEST(Recover, LeavesARecordWhoseFirstFolderIsNotDone)
{
    using namespace std::string_literals;
    const Folder folder;
    std::filesystem::create_directory(folder / "b");
    writeRecord(folder / record, "&b\0"s);
    writeRecord(folder / ("b/" + record), "@..\0=a\0"s);
    leaveComplete(folder / "b/a");
    {
        const FileDescriptor other = lockAbandoned(folder / record, maker);
        ASSERT_TRUE(other);
        recover(folder / "b");
        EXPECT_TRUE(std::filesystem::exists(folder / ("b/" + record)));
        EXPECT_FALSE(std::filesystem::exists(folder / "b/a"));
    }
    recover(folder / "b");
    EXPECT_EQ(contentOf(folder / "b/a"), "new");
    EXPECT_EQ(folder.names(), (Names{"b"}));
}

TEST(Recover, LeavesSymbolicLinksPipesAndWhatIsOfOthers)
{
    const Folder folder;
    const std::string part = temporaryName(folder / "a", maker);
    std::ofstream(folder / "mine") << "mine";
    std::filesystem::create_symlink("mine", part);
    recover(folder / ".");
    EXPECT_TRUE(std::filesystem::is_symlink(part));
    std::filesystem::remove(part);
    ASSERT_EQ(mkfifo(part.c_str(), 0600), 0);
    recover(folder / ".");
    EXPECT_TRUE(std::filesystem::is_fifo(part));
    std::filesystem::remove(part);
    if (geteuid() != 0) GTEST_SKIP() << "files cannot be given to others here";
    leaveComplete(folder / "a");
    writeRecord(folder / record, std::string("=a\0", 3));
    ASSERT_EQ(chown((folder / record).c_str(), 65534, 65534), 0);
    ASSERT_EQ(chown(part.c_str(), 65534, 65534), 0);
    const Names before = folder.names();
    recover(folder / ".");
    EXPECT_EQ(folder.names(), before);
}

} // namespace
} // namespace molsurf
