// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Many small writes as few large ones.

#include "molsurf/show/io/output_file.h"

#include <tbb/task_group.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <functional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace molsurf
{

/// Collects small pieces and hands them on in large ones, each while the next one is collected.
/// Without flush() the last are lost.
class Buffer
{
public:
    /// Takes a large piece: on any thread, one after another.
    using Sink = std::function<void(const char*, std::size_t)>;

    explicit Buffer(OutputFile& file)
        : Buffer(Sink([&file](const char* bytes, std::size_t size) { file.write(bytes, size); }))
    {
    }
    explicit Buffer(Sink sink) : sink_(std::move(sink)), bytes_(capacity) {}
    ~Buffer() noexcept
    {
        try {
            handed_.wait();
        } catch (...) { // only where an error is on its way already: flush() throws
        }
    }
    Buffer(const Buffer&) = delete;
    Buffer& operator=(const Buffer&) = delete;

    // A place for `size` bytes, which is at most a few hundred.
    char* take(std::size_t size)
    {
        if (used_ + size > capacity) handOn();
        char* place = bytes_.data() + used_;
        used_ += size;
        return place;
    }

    void append(const char* bytes, std::size_t size)
    {
        while (size > 0) {
            if (used_ == capacity) handOn();
            const std::size_t now = std::min(size, capacity - used_);
            std::copy_n(bytes, now, take(now));
            bytes += now;
            size -= now;
        }
    }

    // Gives back what the last take() asked too much.
    void untake(std::size_t size) { used_ -= size; }

    void flush()
    {
        handed_.wait();
        sink_(bytes_.data(), used_);
        used_ = 0;
    }

private:
    void handOn()
    {
        handed_.wait();
        bytes_.swap(before_);
        bytes_.resize(capacity);
        handed_.run([this, size = used_] { sink_(before_.data(), size); });
        used_ = 0;
    }

    static constexpr std::size_t capacity = std::size_t(1) << 20;
    Sink sink_;
    std::vector<char> bytes_, before_; // what is collected, and what is handed on
    std::size_t used_ = 0;
    tbb::task_group handed_;
};

/// Text into a file. Without finish() the last of it is lost.
class TextOutput
{
public:
    explicit TextOutput(OutputFile& file) : file_(file), buffer_(file) {}

    TextOutput& operator<<(std::string_view text)
    {
        buffer_.append(text.data(), text.size());
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

    static constexpr std::size_t longest = 32;
    OutputFile& file_;
    Buffer buffer_;
};

} // namespace molsurf
