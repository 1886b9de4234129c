// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "molsurf/error.h"
#include "support/folder.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace molsurf::test
{

/// A file with the given content, gone at the end of the scope.
class TempFile
{
public:
    TempFile(const std::string& name, const std::string& content)
        : folder_(std::filesystem::temp_directory_path() /
                  ("molsurf_test_" + std::to_string(::getpid()) + "_" + std::to_string(next_++)))
    {
        std::filesystem::create_directories(folder_);
        path_ = (folder_ / name).string();
        std::ofstream(path_, std::ios::binary) << content;
    }
    ~TempFile()
    {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    TempFile(const TempFile&) = delete;
    TempFile& operator=(const TempFile&) = delete;

    const std::string& path() const { return path_; }

private:
    static inline int next_ = 0;
    std::filesystem::path folder_;
    std::string path_;
};

/// The message of the Error that `call` throws; fails if it throws none or one of another kind.
template<typename CommandLine>
std::string errorOf(ErrorKind kind, CommandLine call)
{
    try {
        call();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), kind) << error.what();
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        return error.what();
    }
    ADD_FAILURE() << "no Error was thrown";
    return "";
}

/// A file of tests/data.
inline std::string dataFile(const std::string& name)
{
    return std::string(MOLSURF_TEST_DATA) + "/" + name;
}

#define EXPECT_HAS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

} // namespace molsurf::test
