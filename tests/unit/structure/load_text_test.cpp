// SPDX-License-Identifier: MPL-2.0
#include "molsurf/structure/load_text.h"
#include "unit/structure/temp_file.h"

#include <unistd.h>

#include <cstdio>

namespace molsurf::test
{
namespace
{

std::string loadError(const std::string& path)
{
    return errorOf(ErrorKind::Input, [&] { loadText(path); });
}

TEST(LoadText, UnpacksGzipWhateverTheName)
{
    const std::string packed = contentOf(dataFile("1a8o.pdb.gz"));
    const TempFile file("structure.txt", packed);
    const std::string text = loadText(file.path());
    EXPECT_EQ(text, loadText(dataFile("1a8o.pdb.gz")));
    EXPECT_EQ(text.substr(0, 6), "HEADER");
    EXPECT_HAS(text.substr(text.size() - 81), "END  ");
}

TEST(LoadText, JoinsMembersOfAConcatenatedGzip)
{
    const std::string packed = contentOf(dataFile("1a8o.pdb.gz"));
    const TempFile twice("twice.gz", packed + packed);
    const std::string once = loadText(dataFile("1a8o.pdb.gz"));
    EXPECT_EQ(loadText(twice.path()), once + once);
}

TEST(LoadText, RefusesEveryTruncationOfAGzip)
{
    const std::string packed = contentOf(dataFile("1a8o.pdb.gz"));
    for (const std::size_t size : {std::size_t{2}, std::size_t{12}, packed.size() / 2,
                                   packed.size() - 9, packed.size() - 8, packed.size() - 1}) {
        const TempFile cut("cut.pdb.gz", packed.substr(0, size));
        const std::string message = loadError(cut.path());
        EXPECT_HAS(message, "is cut short");
        EXPECT_HAS(message, cut.path());
    }
}

TEST(LoadText, RefusesDamagedGzip)
{
    std::string packed = contentOf(dataFile("1a8o.pdb.gz"));
    packed[packed.size() - 6] = static_cast<char>(packed[packed.size() - 6] ^ 1); // checksum
    const TempFile damaged("damaged.pdb.gz", packed);
    EXPECT_HAS(loadError(damaged.path()), "damaged gzip data");
}

TEST(LoadText, ReadsStandardInput)
{
    ASSERT_NE(std::freopen(dataFile("1a8o.pdb.gz").c_str(), "rb", stdin), nullptr);
    EXPECT_EQ(loadText("-"), loadText(dataFile("1a8o.pdb.gz")));
    EXPECT_HAS(loadError("-"), "standard input: is empty"); // it is at its end
}

TEST(LoadText, RemovesByteOrderMark)
{
    const TempFile file("a.pdb", "\xEF\xBB\xBFREMARK\n");
    EXPECT_EQ(loadText(file.path()), "REMARK\n");
}

TEST(LoadText, RefusesMissingFileFolderAndEmptyFile)
{
    EXPECT_HAS(loadError("/nonexistent/1abc.pdb"), "/nonexistent/1abc.pdb: cannot be opened");
    EXPECT_HAS(loadError(std::filesystem::temp_directory_path().string()), "is a folder");
    const TempFile empty("empty.pdb", "");
    EXPECT_HAS(loadError(empty.path()), "is empty");
    const TempFile blank("blank.pdb", " \n\n");
    EXPECT_HAS(loadError(blank.path()), "is empty");
}

TEST(LoadText, RefusesUnreadableFile)
{
    const TempFile file("secret.pdb", "ATOM\n");
    std::filesystem::permissions(file.path(), std::filesystem::perms::none);
    const uid_t user = ::geteuid();
    if (user == 0 && ::seteuid(65534) != 0)
        GTEST_SKIP() << "root, who may read everything, stays root";
    EXPECT_HAS(loadError(file.path()), "cannot be opened");
    ASSERT_EQ(::seteuid(user), 0);
}

} // namespace
} // namespace molsurf::test
