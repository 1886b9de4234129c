// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// What all fuzz targets share: the input as a file, and errors that are no findings.

#include "molsurf/error.h"

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>

namespace molsurf::fuzz
{

/// A file in memory that holds the input while the object lives.
class InputFile
{
public:
    /// @param[in] name  what it ends in: the extension tells some readers the format
    InputFile(const std::uint8_t* data, std::size_t size, const std::string& name)
        : path_("/dev/shm/molsurf_fuzz." + std::to_string(getpid()) + name)
    {
        std::FILE* file = std::fopen(path_.c_str(), "wb");
        if (size > 0) std::fwrite(data, 1, size, file);
        std::fclose(file);
    }
    ~InputFile() { std::remove(path_.c_str()); }
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    const std::string& path() const { return path_; }

private:
    std::string path_;
};

/// Runs a reader. What it refuses with a message is in order.
template<typename Read>
void tryTo(const Read& read)
{
    try {
        read();
    } catch (const Error&) {
    }
}

} // namespace molsurf::fuzz
