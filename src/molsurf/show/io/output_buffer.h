// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Many small writes as few large ones.

#include "molsurf/show/io/output_file.h"

#include <charconv>
#include <cstddef>
#include <string_view>
#include <type_traits>
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

/// Text into a file. Without finish() the last of it is lost.
class TextOutput
{
public:
    explicit TextOutput(OutputFile& file) : file_(file), buffer_(file) {}

    TextOutput& operator<<(std::string_view text)
    {
        for (std::size_t at = 0; at < text.size(); at += piece) {
            const std::string_view now = text.substr(at, piece);
            now.copy(buffer_.take(now.size()), now.size());
        }
        return *this;
    }

    /// A number with the fewest digits that give it back.
    template<typename Number, typename = std::enable_if_t<std::is_arithmetic_v<Number>>>
    TextOutput& operator<<(Number number)
    {
        return put(number);
    }

    /// A number with so many digits behind the point.
    TextOutput& fixed(double number, int digits)
    {
        return put(number, std::chars_format::fixed, digits);
    }

    void finish()
    {
        buffer_.flush();
        file_.finish();
    }

private:
    template<typename... Form>
    TextOutput& put(Form... form)
    {
        char* to = buffer_.take(longest);
        const char* end = std::to_chars(to, to + longest, form...).ptr;
        buffer_.untake(std::size_t(to + longest - end));
        return *this;
    }

    static constexpr std::size_t piece = 256, longest = 32;
    OutputFile& file_;
    Buffer buffer_;
};

} // namespace molsurf
