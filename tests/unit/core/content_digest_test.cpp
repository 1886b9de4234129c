// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/core/content_digest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>
#include <string>

namespace molsurf
{
namespace
{

std::string uuidOf(const std::string& bytes, std::size_t piece)
{
    ContentDigest digest;
    for (std::size_t at = 0; at < bytes.size(); at += piece)
        digest.add(bytes.data() + at, std::min(piece, bytes.size() - at));
    return digest.uuid();
}

TEST(ContentDigest, DoesNotDependOnThePieces)
{
    const std::string bytes = "The same bytes, whatever pieces they come in.";
    for (const std::size_t piece : {1, 3, 7, 8, 9, 16})
        EXPECT_EQ(uuidOf(bytes, piece), uuidOf(bytes, bytes.size())) << piece;
}

TEST(ContentDigest, EachBitOfEachByteAndTheLengthCount)
{
    const std::string bytes(37, '\0');
    std::set<std::string> seen{uuidOf(bytes, 37), uuidOf(bytes + '\0', 38)};
    for (std::size_t at = 0; at < bytes.size(); ++at)
        for (int bit = 0; bit < 8; ++bit) {
            std::string other = bytes;
            other[at] = char(1 << bit);
            seen.insert(uuidOf(other, 37));
        }
    EXPECT_EQ(seen.size(), 2 + 37 * 8u);
}

// A last bit that was turned changes about half of all.
TEST(ContentDigest, TheLastByteReachesTheWholeUuid)
{
    const std::string a = uuidOf("content a", 9), b = uuidOf("content b", 9);
    int same = 0;
    for (std::size_t at = 0; at < a.size(); ++at) same += a[at] == b[at];
    EXPECT_LT(same, 16); // four dashes and the version among them
}

TEST(ContentDigest, IsOfVersionEight)
{
    const std::regex form("[0-9a-f]{8}-[0-9a-f]{4}-8[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}");
    for (const char* bytes : {"", "a", "12345678", "123456789"})
        EXPECT_TRUE(std::regex_match(uuidOf(bytes, 1), form)) << bytes;
}

} // namespace
} // namespace molsurf
