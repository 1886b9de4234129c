// SPDX-License-Identifier: MPL-2.0
/// @file
/// Every fuzz target runs over its part of the corpus: what a fuzzer once needed to reach a line,
/// or to find a fault, keeps ending in a result or an Error.

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

// FUZZ_TARGETS is FUZZ_TARGET(dcd) FUZZ_TARGET(xtc) ...
#define FUZZ_TARGET(name) extern "C" int fuzz_##name(const std::uint8_t* data, std::size_t size);
FUZZ_TARGETS
#undef FUZZ_TARGET

namespace
{

struct Target {
    std::string name;
    int (*run)(const std::uint8_t* data, std::size_t size);
};

class FuzzCorpus : public testing::TestWithParam<Target>
{
};

// A target may send what the program prints elsewhere.
class KeepCout
{
public:
    ~KeepCout() { std::cout.rdbuf(kept_); }

private:
    std::streambuf* kept_ = std::cout.rdbuf();
};

TEST_P(FuzzCorpus, endsInAResultOrAnError)
{
    const KeepCout keepCout;
    std::size_t files = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(FUZZ_CORPUS "/" + GetParam().name)) {
        SCOPED_TRACE(entry.path().string());
        std::ifstream stream(entry.path(), std::ios::binary);
        const std::vector<char> bytes{std::istreambuf_iterator<char>(stream), {}};
        ASSERT_NO_THROW(
            GetParam().run(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
        ++files;
    }
    EXPECT_GT(files, 0u);
}

#define FUZZ_TARGET(name) Target{#name, &fuzz_##name},
INSTANTIATE_TEST_SUITE_P(all, FuzzCorpus, testing::ValuesIn(std::vector<Target>{FUZZ_TARGETS}),
                         [](const auto& info) { return info.param.name; });

} // namespace
