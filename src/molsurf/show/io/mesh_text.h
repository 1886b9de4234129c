// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Tokenizer that the readers of .ply, .obj and .stl files share.

#include "molsurf/error.h"
#include "molsurf/kernel/mesh/check_arrays.h"
#include "molsurf/mesh.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace molsurf
{

[[noreturn]] inline void badMesh(const std::string& message, bool passes = false)
{
    throw Error(ErrorKind::Input, message, passes);
}

/// The words of a text, line by line.
class MeshText
{
public:
    explicit MeshText(std::string_view text) : at_(text.data()), end_(at_ + text.size()) {}

    /// Goes to the next line that has a word.
    /// @return false at the end
    bool nextLine()
    {
        while (at_ != end_) {
            const char* stop = at_;
            while (stop != end_ && *stop != '\n' && *stop != '\r') ++stop;
            word_ = at_;
            lineEnd_ = stop;
            const bool feed = stop != end_ && *stop == '\r' && stop + 1 != end_ && stop[1] == '\n';
            at_ = stop == end_ ? stop : stop + (feed ? 2 : 1);
            ++line_;
            skipBlanks();
            if (word_ != lineEnd_) return true;
        }
        return false;
    }

    /// The next word of the line; empty at its end.
    std::string_view word()
    {
        skipBlanks();
        const char* begin = word_;
        while (word_ != lineEnd_ && !blank(*word_)) ++word_;
        return {begin, std::size_t(word_ - begin)};
    }

    /// The next word as a number.
    /// @throws Error(ErrorKind::Input) if it is none
    template<typename T>
    T number(const char* what)
    {
        const std::string_view text = word();
        const char* begin = text.data();
        const char* end = begin + text.size();
        if (begin != end && *begin == '+') ++begin;
        T value{};
        const auto [stop, failure] = std::from_chars(begin, end, value);
        if (failure == std::errc::result_out_of_range && tiny(text)) return T(0);
        if (failure != std::errc() || stop != end) fail(what, text);
        return value;
    }

    [[noreturn]] void fail(const std::string& expected, std::string_view got) const
    {
        const std::string shown(got.substr(0, 40));
        badMesh("line " + std::to_string(line_) + ": expected " + expected + ", got " +
                (got.empty() ? "nothing" : "'" + shown + "'"));
    }

    std::size_t line() const { return line_; }
    /// The text after the present line.
    std::string_view rest() const { return {at_, std::size_t(end_ - at_)}; }
    bool lineDone()
    {
        skipBlanks();
        return word_ == lineEnd_;
    }

private:
    static bool blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
    void skipBlanks()
    {
        while (word_ != lineEnd_ && blank(*word_)) ++word_;
    }
    /// A number too small for its type is 0; one too large is an error.
    static bool tiny(std::string_view text)
    {
        const std::size_t e = text.find_first_of("eE");
        return e != std::string_view::npos && e + 1 < text.size() && text[e + 1] == '-';
    }

    const char* at_;
    const char* end_;
    const char* word_ = nullptr;
    const char* lineEnd_ = nullptr;
    std::size_t line_ = 0;
};

/// A position, if it can be one.
/// @throws Error(ErrorKind::Input)
inline openvdb::Vec3f checkedPosition(double x, double y, double z, std::size_t vertex)
{
    checkPosition({x, y, z}, vertex);
    return {float(x), float(y), float(z)};
}

/// Adds a polygon as a fan of triangles.
inline void addPolygon(const std::vector<std::uint32_t>& corners, Mesh& mesh)
{
    for (std::size_t k = 2; k < corners.size(); ++k)
        mesh.triangles.push_back({corners[0], corners[k - 1], corners[k]});
}

} // namespace molsurf
