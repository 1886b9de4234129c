// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Many small writes as few large ones.

#include "molsurf/io/output_file.h"

#include <cstddef>
#include <vector>

namespace molsurf
{

/// Collects small pieces and hands them on in large ones. Without flush() the last are lost.
class Buffer
{
public:
    explicit Buffer(OutputFile& file) : file_(file), bytes_(capacity) {}

    // A place for `size` bytes, which is at most a few hundred.
    char* take(std::size_t size)
    {
        if (used_ + size > capacity) flush();
        char* place = bytes_.data() + used_;
        used_ += size;
        return place;
    }

    // Gives back what the last take() asked too much.
    void untake(std::size_t size) { used_ -= size; }

    void flush()
    {
        file_.write(bytes_.data(), used_);
        used_ = 0;
    }

private:
    static constexpr std::size_t capacity = std::size_t(1) << 20;
    OutputFile& file_;
    std::vector<char> bytes_;
    std::size_t used_ = 0;
};

} // namespace molsurf
