// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/archive.h"

#include "unit/structure/temp_file.h"

#include <zlib.h>

#include <cstdio>
#include <string>
#include <vector>

namespace molsurf::test
{
namespace
{

/// A header of .tar and the blocks behind it.
/// @param[in] size  that the header gives [byte]
std::string entry(const std::string& name, char kind, std::size_t size, std::string data)
{
    std::string header(512, '\0');
    header.replace(0, name.size(), name);
    char number[16];
    std::snprintf(number, sizeof number, "%011zo", size);
    header.replace(124, 11, number);
    header[156] = kind;
    header.replace(148, 8, 8, ' ');
    unsigned sum = 0;
    for (const char c : header) sum += static_cast<unsigned char>(c);
    std::snprintf(number, sizeof number, "%06o", sum);
    header.replace(148, 6, number).replace(154, 1, 1, '\0');
    data.resize((data.size() + 511) / 512 * 512);
    return header + data;
}

std::string entry(const std::string& name, const std::string& data)
{
    return entry(name, '0', data.size(), data);
}

/// Headers have no room for sizes from 8 GiB: a record before them has it.
TEST(Archive, ASizeInARecordCounts)
{
    const TempFile tar("a.tar", entry("x", 'x', 12, "12 size=600\n") +
                                    entry("a.pdb", '0', 0, std::string(600, 'a')) +
                                    entry("b.pdb", "bb") + std::string(1024, '\0'));
    EXPECT_EQ(membersIn(tar.path()),
              (std::vector<std::string>{tar.path() + "::a.pdb", tar.path() + "::b.pdb"}));
    EXPECT_EQ(readMember({tar.path(), "a.pdb"}, 0), std::string(600, 'a'));
    EXPECT_EQ(readMember({tar.path(), "b.pdb"}, 0), "bb");
}

TEST(Archive, AMemberThatIsCutShortSpoilsNoOther)
{
    const std::string bytes = entry("a.pdb", "aa") + entry("b.pdb", std::string(2000, 'b'));
    const TempFile tar("a.tar", bytes.substr(0, bytes.size() - 1024));
    EXPECT_EQ(readMember({tar.path(), "a.pdb"}, 0), "aa");
    EXPECT_HAS(errorOf(ErrorKind::Input,
                       [&] {
                           readMember({tar.path(), "b.pdb"}, 0);
                       }),
               "is cut short");
    EXPECT_EQ(readMember({tar.path(), "a.pdb"}, 0), "aa");
}

/// Bytes as a member of gzip.
std::string packed(std::string bytes)
{
    z_stream stream{};
    EXPECT_EQ(deflateInit2(&stream, 1, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY), Z_OK);
    std::string out(deflateBound(&stream, uLong(bytes.size())), '\0');
    stream.next_in = reinterpret_cast<Bytef*>(bytes.data());
    stream.avail_in = uInt(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = uInt(out.size());
    EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
    out.resize(stream.total_out);
    deflateEnd(&stream);
    return out;
}

TEST(Archive, ADamagedMemberOfGzipLosesNoFiles)
{
    const std::string first = packed(entry("a.pdb", "aa"));
    std::string second = packed(entry("b.pdb", "bb") + std::string(1024, '\0'));
    const TempFile whole("whole.tar.gz", first + second);
    EXPECT_EQ(membersIn(whole.path()).size(), 2u);
    second[0] = 'x';
    const TempFile damaged("damaged.tar.gz", first + second);
    EXPECT_HAS(errorOf(ErrorKind::Input, [&] { membersIn(damaged.path()); }), "is cut short");
}

TEST(Archive, MembersAreHeldToALimit)
{
    const TempFile tar("a.tar", entry("a.pdb", "12345"));
    EXPECT_EQ(readMember({tar.path(), "a.pdb"}, 5), "12345");
    EXPECT_HAS(errorOf(ErrorKind::Input,
                       [&] {
                           readMember({tar.path(), "a.pdb"}, 4);
                       }),
               "::a.pdb: expected at most 4 bytes");
}

} // namespace
} // namespace molsurf::test
