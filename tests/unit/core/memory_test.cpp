// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/core/memory.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/transient_error.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <optional>
#include <string>

namespace molsurf
{
namespace
{

std::optional<Error> refusal(double more, std::size_t memory)
{
    try {
        needMemory("atoms take", more, memory);
    } catch (const Error& error) {
        return error;
    }
    return std::nullopt;
}

TEST(NeedMemory, TheHintIsEnough)
{
    constexpr double more = 3e9;
    const auto error = refusal(more, 1000000000);
    ASSERT_TRUE(error);
    const std::string text = error->what(), mark = "[hint: `memory` ";
    ASSERT_NE(text.find(mark), std::string::npos) << text;
    const std::size_t hinted = std::stoul(text.substr(text.find(mark) + mark.size()));
    EXPECT_FALSE(refusal(more, hinted << 20)) << text;
}

/// A limit that a person gives stays; another machine has other memory.
TEST(NeedMemory, PassesOnAnotherMachineAlone)
{
    EXPECT_FALSE(refusal(3e9, 1000000000)->mayPass());
    const auto error = refusal(1e18, 0);
    ASSERT_TRUE(error);
    EXPECT_TRUE(error->mayPass());
    EXPECT_EQ(std::string(error->what()).find("hint"), std::string::npos);
}

TEST(NeedMemory, CountsWhatTheProcessHas)
{
    EXPECT_FALSE(hasMemory(1e9, 1000000000));
    EXPECT_TRUE(hasMemory(1e9, 3000000000));
}

TEST(MayPass, WhatIsMissingForAWhile)
{
    for (const int reason :
         {ENOSPC, EDQUOT, ENOMEM, EMFILE, ENFILE, EAGAIN, EIO, ESTALE, ETIMEDOUT})
        EXPECT_TRUE(mayPass(reason)) << reason;
    for (const int reason : {0, ENOENT, EACCES, EPERM, EROFS, EISDIR, ENAMETOOLONG, EINVAL, EPIPE})
        EXPECT_FALSE(mayPass(reason)) << reason;
}

} // namespace
} // namespace molsurf
