// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/load_text.h"
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

TEST(LoadText, TakesNothingButMembersAndZerosBehindAGzip)
{
    const std::string packed = contentOf(dataFile("1a8o.pdb.gz"));
    const std::string once = loadText(dataFile("1a8o.pdb.gz"));
    EXPECT_EQ(unpackedText(packed + std::string(1000, '\0'), "a"), once);
    std::string damaged = packed + packed;
    damaged[packed.size()] = static_cast<char>(damaged[packed.size()] ^ 1); // of the magic
    for (const std::string& bytes :
         {damaged, packed + "\x1f", packed + std::string(1, '\0') + packed})
        EXPECT_HAS(errorOf(ErrorKind::Input, [&] { unpackedText(bytes, "a"); }),
                   "another member behind byte " + std::to_string(packed.size()));
}

TEST(LoadText, ReadsStandardInput)
{
    ASSERT_NE(std::freopen(dataFile("1a8o.pdb.gz").c_str(), "rb", stdin), nullptr);
    EXPECT_EQ(loadText("-"), loadText(dataFile("1a8o.pdb.gz")));
    EXPECT_HAS(loadError("-"), "standard input: is empty"); // it is at its end
}

/// The bytes of a literal that may hold zeros.
template<std::size_t n>
std::string bytesOf(const char (&literal)[n])
{
    return std::string(literal, n - 1);
}

TEST(LoadText, UnpacksBzip2AndXz)
{
    const std::string packed[] = {
        bytesOf("\x42\x5a\x68\x39\x31\x41\x59\x26\x53\x59\xe8\x79\x3f\x85\x00\x00\x02\xc6\x00\x00"
                "\x10\x22\x0a\x10\x00\x20\x00\x22\x18\x68\x30\x09\x4e\x29\x85\xdc\x91\x4e\x14\x24"
                "\x3a\x1e\x4f\xe1\x40"),
        bytesOf("\xfd\x37\x7a\x58\x5a\x00\x00\x04\xe6\xd6\xb4\x46\x02\x00\x21\x01\x16\x00\x00\x00"
                "\x74\x2f\xe5\xa3\x01\x00\x06\x52\x45\x4d\x41\x52\x4b\x0a\x00\x00\xac\x8e\xdf\xff"
                "\xd2\x8a\xb1\xa2\x00\x01\x1f\x07\x16\x2e\xb8\x73\x1f\xb6\xf3\x7d\x01\x00\x00\x00"
                "\x00\x04\x59\x5a")};
    for (const std::string& bytes : packed) {
        EXPECT_EQ(unpackedText(bytes, "a"), "REMARK\n");
        for (const std::size_t size : {std::size_t{6}, bytes.size() / 2, bytes.size() - 1})
            EXPECT_HAS(errorOf(ErrorKind::Input, [&] { unpackedText(bytes.substr(0, size), "a"); }),
                       "or is cut short");
    }
    EXPECT_EQ(unpackedText(packed[0] + packed[0], "a"), "REMARK\nREMARK\n");
    EXPECT_HAS(errorOf(ErrorKind::Input, [&] { unpackedText(packed[0], "a", 4); }), "at most 4");
}

TEST(LoadText, RefusesABzip2ThatUnpacksWithoutEnd)
{
    const std::string bomb =
        bytesOf("\x42\x5a\x68\x39\x31\x41\x59\x26\x53\x59\x16\x9e\x02\xcb\x01\x41\x41\x04\x80\xa0"
                "\x00\x00\x01\x00\x08\x20\x00\x30\xcc\x05\x29\xa6\x40\x90\x26\xc5\x02\x40\x9e\x2e"
                "\xe4\x8a\x70\xa1\x20\x2d\x3c\x05\x96"); // of 40 MiB
    EXPECT_HAS(errorOf(ErrorKind::Input, [&] { unpackedText(bomb, "a"); }),
               "its bzip2 data unpack to more than 200 times their size");
}

TEST(LoadText, EndsOfLinesAreOfAnyKind)
{
    EXPECT_EQ(unpackedText("A\rB\rC", "a"), "A\nB\nC");
    EXPECT_EQ(unpackedText("A\rB\r\nC\nD\r", "a"), "A\nB\nC\nD\n");
    EXPECT_EQ(unpackedText("A\r\nB\r\n", "a"), "A\r\nB\r\n"); // what readers know
    const std::string binary = bytesOf("A\0B\rC");
    EXPECT_EQ(unpackedText(binary, "a"), binary);
}

TEST(LoadText, TurnsUtf16IntoUtf8)
{
    EXPECT_EQ(unpackedText(bytesOf("\xFF\xFE"
                                   "A\0\xE9\0\n\0"),
                           "a"),
              "A\xC3\xA9\n");
    EXPECT_EQ(unpackedText(bytesOf("\xFE\xFF\0A\x20\xAC\xD8\x3D\xDE\x00\0\n"), "a"),
              "A\xE2\x82\xAC\xF0\x9F\x98\x80\n");
    EXPECT_HAS(errorOf(ErrorKind::Input,
                       [] {
                           unpackedText("\xFF\xFE"
                                        "ABC",
                                        "a");
                       }),
               "odd number");
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
