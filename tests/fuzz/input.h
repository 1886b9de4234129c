// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// What the fuzz targets share: the bytes that libFuzzer makes, as a file without a disk.

#include "molsurf/error.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <string>

namespace molsurf::fuzz
{

/// Makes the bytes the content of a file in memory.
/// @param[in] ending  that the name of the file shall have
/// @return a link to the file, which the build made: FUZZ_INPUT + ending
inline std::string inputFile(const std::uint8_t* data, std::size_t size, const std::string& ending)
{
    static const int file = [] {
        const int made = memfd_create("input", 0);
        if (made < 0 || dup2(made, FUZZ_DESCRIPTOR) < 0) std::abort();
        return FUZZ_DESCRIPTOR;
    }();
    if (ftruncate(file, 0) != 0 || pwrite(file, data, size, 0) != ssize_t(size)) std::abort();
    return FUZZ_INPUT + ending;
}

/// Runs what may end in an Error; every other end is a finding.
template<typename F>
void expectErrorAtMost(const F& f)
{
    try {
        f();
    } catch (const Error&) {
    }
}

} // namespace molsurf::fuzz
