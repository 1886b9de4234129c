// SPDX-License-Identifier: MPL-2.0
#include "molsurf/structure/load_text.h"

#include "molsurf/error.h"
#include "molsurf/structure/text_fields.h"

#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>
#include <memory>
#include <utility>

namespace molsurf
{
namespace
{

/// What a text may have. Files of atoms shrink to a tenth, hardly ever to a fiftieth.
struct Limit {
    explicit Limit(std::size_t maxBytes) : bytes(maxBytes ? maxBytes : std::size_t{4} << 30)
    {
        if (maxBytes) ratio = std::numeric_limits<std::size_t>::max();
    }

    std::size_t bytes;
    std::size_t ratio = 200;                         ///< of unpacked to packed bytes
    std::size_t unsuspected = std::size_t{16} << 20; ///< unpacked bytes at any ratio
};

[[noreturn]] void failTooLarge(const std::string& path, const std::string& what)
{
    failAt(path, what + " [hint: `maxInput` 10G takes up to 10 GiB]");
}

void checkSize(std::size_t bytes, const Limit& limit, const std::string& path)
{
    if (bytes > limit.bytes)
        failTooLarge(path, "expected at most " + std::to_string(limit.bytes) + " bytes of text");
}

/// Reads to the end of a file or a pipe.
/// @param[in] expected  its size, as far as it is known [bytes]
std::string readAll(std::FILE* file, const std::string& path, std::size_t expected,
                    const Limit& limit)
{
    checkSize(expected, limit, path);
    constexpr std::size_t chunk = std::size_t{1} << 20;
    std::string bytes;
    bytes.reserve(expected + chunk);
    std::size_t got = 0;
    do {
        const std::size_t size = bytes.size();
        if (bytes.capacity() < size + chunk) // not twice the limit
            bytes.reserve(std::min(2 * bytes.capacity(), limit.bytes) + chunk);
        bytes.resize(size + chunk);
        got = std::fread(&bytes[size], 1, chunk, file);
        bytes.resize(size + got);
        checkSize(bytes.size(), limit, path);
    } while (got == chunk);
    if (std::ferror(file)) failAt(path, std::string("cannot be read: ") + std::strerror(errno));
    return bytes;
}

std::string readBytes(const std::string& path, const Limit& limit)
{
    if (path == "-") return readAll(stdin, path, 0, limit);
    std::error_code status;
    if (std::filesystem::is_directory(path, status)) {
        failAt(path, "is a folder, expected a file");
    }
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                               &std::fclose);
    if (!file) failAt(path, std::string("cannot be opened: ") + std::strerror(errno));
    const std::uintmax_t size = std::filesystem::file_size(path, status);
    return readAll(file.get(), path, status ? 0 : std::size_t(size), limit);
}

bool isGzip(const std::string& bytes, std::size_t at)
{
    return bytes.size() - at >= 2 && bytes[at] == '\x1f' && bytes[at + 1] == '\x8b';
}

/// Unpacks one gzip member that starts at `begin`, appends it to `text`, and returns its end.
std::size_t unpackMember(std::string& bytes, std::size_t begin, const std::string& path,
                         const Limit& limit, std::string& text)
{
    constexpr std::size_t maxFeed = std::size_t{1} << 30; // zlib counts with 32 bits
    z_stream stream{};
    constexpr int gzipOnly = 16 + MAX_WBITS;
    if (inflateInit2(&stream, gzipOnly) != Z_OK) failAt(path, "no memory to unpack it");
    const std::unique_ptr<z_stream, int (*)(z_stream*)> guard(&stream, &inflateEnd);
    std::size_t next = begin;
    char buffer[1 << 16];
    int state = Z_OK;
    while (state != Z_STREAM_END) {
        const std::size_t feed = std::min(bytes.size() - next, maxFeed);
        stream.next_in = reinterpret_cast<Bytef*>(&bytes[next]);
        stream.avail_in = static_cast<uInt>(feed);
        stream.next_out = reinterpret_cast<Bytef*>(buffer);
        stream.avail_out = sizeof buffer;
        state = inflate(&stream, Z_NO_FLUSH);
        next += feed - stream.avail_in;
        text.append(buffer, sizeof buffer - stream.avail_out);
        checkSize(text.size(), limit, path);
        if (text.size() > limit.unsuspected && text.size() / limit.ratio > next)
            failTooLarge(path, "its gzip data unpack to more than " + std::to_string(limit.ratio) +
                                   " times their size, which no file of atoms does");
        if (state == Z_BUF_ERROR || (state == Z_OK && next == bytes.size() && stream.avail_out)) {
            failAt(path, "is cut short: its gzip data end after " + std::to_string(bytes.size()) +
                             " bytes without the closing checksum [copy or download it again]");
        }
        if (state != Z_OK && state != Z_STREAM_END) {
            failAt(path, std::string("has damaged gzip data: ") +
                             (stream.msg ? stream.msg : "unknown error") +
                             " [copy or download it again]");
        }
    }
    return next;
}

std::string unpack(std::string bytes, const std::string& path, const Limit& limit)
{
    std::string text;
    text.reserve(std::min(bytes.size() * 5, limit.bytes));
    std::size_t next = 0;
    while (isGzip(bytes, next)) next = unpackMember(bytes, next, path, limit, text);
    return text;
}

} // namespace

std::string loadBytes(const std::string& path, std::size_t maxBytes)
{
    return readBytes(path, Limit(maxBytes));
}

std::string withoutMark(std::string text)
{
    if (text.compare(0, 3, "\xEF\xBB\xBF") == 0) text.erase(0, 3);
    return text;
}

std::string unpackedText(std::string bytes, const std::string& path, std::size_t maxBytes)
{
    const Limit limit(maxBytes);
    checkSize(bytes.size(), limit, path);
    std::string text = std::move(bytes);
    if (isGzip(text, 0)) text = unpack(std::move(text), path, limit);
    text = withoutMark(std::move(text));
    if (text.find_first_not_of(" \t\r\n") == std::string::npos) failAt(path, "is empty");
    return text;
}

std::string loadText(const std::string& path, std::size_t maxBytes)
{
    return unpackedText(readBytes(path, Limit(maxBytes)), path, maxBytes);
}

} // namespace molsurf
