// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/load_text.h"

#include "molsurf/error.h"
#include "molsurf/molecule/structure/archive.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <boost/iostreams/device/array.hpp>
#include <boost/iostreams/filter/bzip2.hpp>
#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filter/lzma.hpp>
#include <boost/iostreams/filtering_stream.hpp>
#include <boost/iostreams/filtering_streambuf.hpp>
#include <boost/iostreams/operations.hpp>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

namespace molsurf
{
namespace
{

/// Largest size of a text. Files of atoms shrink to a tenth, hardly ever to a fiftieth.
struct Limit {
    explicit Limit(std::size_t maxBytes) : bytes(maxBytes ? maxBytes : std::size_t{4} << 30)
    {
        if (maxBytes) ratio = std::numeric_limits<std::size_t>::max();
    }

    /// Largest size of a text of which there are so many bytes, packed.
    std::size_t ofPacked(std::size_t packed) const
    {
        const std::size_t likely = packed > bytes / ratio ? bytes : packed * ratio;
        return std::min(bytes, std::max(likely, unsuspected));
    }

    std::size_t bytes;
    std::size_t ratio = 200;                         ///< of unpacked to packed bytes
    std::size_t unsuspected = std::size_t{16} << 20; ///< unpacked bytes at any ratio
    bool isOption = true;                            ///< whether its caller may raise it
};

[[noreturn]] void failTooLarge(const std::string& path, const std::string& what, const Limit& limit)
{
    failAt(path, what + (limit.isOption ? " [hint: `maxInput` 10G takes up to 10 GiB]" : ""));
}

void checkSize(std::size_t bytes, const Limit& limit, const std::string& path)
{
    if (bytes > limit.bytes)
        failTooLarge(path, "expected at most " + std::to_string(limit.bytes) + " bytes of text",
                     limit);
}

/// A text that grows by blocks and is never held twice, as a string that grows would be.
class Growing
{
public:
    void append(const char* bytes, std::size_t count)
    {
        while (count > 0) {
            if (blocks_.empty() || blocks_.back().size() == block) {
                blocks_.emplace_back();
                blocks_.back().reserve(block);
            }
            const std::size_t part = std::min(count, block - blocks_.back().size());
            blocks_.back().append(bytes, part);
            size_ += part;
            bytes += part;
            count -= part;
        }
    }

    std::size_t size() const { return size_; }

    /// The whole text; each block goes as soon as it is copied.
    std::string take()
    {
        std::string text;
        text.reserve(size_);
        for (std::string& part : blocks_) {
            text += part;
            std::string().swap(part);
        }
        blocks_.clear();
        return text;
    }

private:
    static constexpr std::size_t block = std::size_t{1} << 20;
    std::vector<std::string> blocks_;
    std::size_t size_ = 0;
};

/// Reads to the end of a file or a pipe.
/// @param[in] expected  its size, as far as it is known [bytes]
std::string readAll(std::FILE* file, const std::string& path, std::size_t expected,
                    const Limit& limit)
{
    checkSize(expected, limit, path);
    std::string bytes(expected, '\0');
    bytes.resize(std::fread(bytes.data(), 1, expected, file));
    Growing more; // of a pipe, or of a file that grew
    std::vector<char> piece(std::size_t{1} << 16);
    for (std::size_t got = 0; (got = std::fread(piece.data(), 1, piece.size(), file)) > 0;) {
        if (more.size() == 0) more.append(bytes.data(), bytes.size());
        more.append(piece.data(), got);
        checkSize(more.size(), limit, path);
    }
    if (std::ferror(file)) failBySystem(path, "cannot be read");
    return more.size() > 0 ? more.take() : bytes;
}

std::string readBytes(const std::string& path, const Limit& limit)
{
    if (path == "-") return readAll(stdin, path, 0, limit);
    std::error_code status;
    if (const auto member = memberOf(path)) {
        const std::uintmax_t packed = std::filesystem::file_size(member->archive, status);
        return readMember(*member, limit.ofPacked(status ? 0 : std::size_t(packed)));
    }
    if (std::filesystem::is_directory(path, status)) {
        failAt(path, "is a folder, expected a file");
    }
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                               &std::fclose);
    if (!file) failBySystem(path, "cannot be opened");
    const std::uintmax_t size = std::filesystem::file_size(path, status);
    return readAll(file.get(), path, status ? 0 : std::size_t(size), limit);
}

bool isGzip(const std::string& bytes, std::size_t at)
{
    return bytes.size() - at >= 2 && bytes[at] == '\x1f' && bytes[at + 1] == '\x8b';
}

/// Unpacks one gzip member that starts at `begin`, appends it to `text`, and returns its end.
std::size_t unpackMember(std::string& bytes, std::size_t begin, const std::string& path,
                         const Limit& limit, Growing& text)
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
            failTooLarge(path,
                         "its gzip data unpack to more than " + std::to_string(limit.ratio) +
                             " times their size, which no file of atoms does",
                         limit);
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
    Growing text;
    std::size_t next = 0;
    while (isGzip(bytes, next)) next = unpackMember(bytes, next, path, limit, text);
    if (bytes.find_first_not_of('\0', next) != std::string::npos) // tapes end with zeros
        failAt(path, "has damaged gzip data: expected another member behind byte " +
                         std::to_string(next) + ", or the end [copy or download it again]");
    std::string().swap(bytes);
    return text.take();
}

bool beginsWith(const std::string& bytes, std::string_view magic)
{
    return std::string_view(bytes).substr(0, magic.size()) == magic;
}

/// Unpacks bytes by a filter of Boost.Iostreams.
template<typename Filter>
std::string unpackBy(const Filter& filter, const char* kind, const std::string& bytes,
                     const std::string& path, const Limit& limit)
{
    namespace io = boost::iostreams;
    Growing text;
    try {
        io::filtering_istreambuf stream;
        stream.push(filter);
        stream.push(io::array_source(bytes.data(), bytes.size()));
        std::vector<char> buffer(std::size_t{1} << 16);
        for (std::streamsize got = 0;
             (got = io::read(stream, buffer.data(), std::streamsize(buffer.size()))) > 0;) {
            text.append(buffer.data(), std::size_t(got));
            checkSize(text.size(), limit, path);
            if (text.size() > limit.unsuspected && text.size() / limit.ratio > bytes.size())
                failTooLarge(path,
                             std::string("its ") + kind + " data unpack to more than " +
                                 std::to_string(limit.ratio) +
                                 " times their size, which no file of atoms does",
                             limit);
        }
    } catch (const std::ios_base::failure&) {
        failAt(path, std::string("has damaged ") + kind +
                         " data, or is cut short [copy or download it again]");
    }
    return text.take();
}

/// Unpacks what is packed by gzip, bzip2 or xz.
std::string unpackAny(std::string bytes, const std::string& path, const Limit& limit)
{
    namespace io = boost::iostreams;
    if (isGzip(bytes, 0)) return unpack(std::move(bytes), path, limit);
    if (beginsWith(bytes, "BZh"))
        return unpackBy(io::bzip2_decompressor(), "bzip2", bytes, path, limit);
    if (beginsWith(bytes, std::string_view("\xFD"
                                           "7zXZ\0",
                                           6)))
        return unpackBy(io::lzma_decompressor(), "xz", bytes, path, limit);
    return bytes;
}

void appendUtf8(std::uint32_t code, std::string& out)
{
    const auto tail = [&](int shift) { out += char(0x80 | (code >> shift & 0x3f)); };
    if (code < 0x80) {
        out += char(code);
    } else if (code < 0x800) {
        out += char(0xc0 | code >> 6);
        tail(0);
    } else if (code < 0x10000) {
        out += char(0xe0 | code >> 12);
        tail(6);
        tail(0);
    } else {
        out += char(0xf0 | code >> 18);
        tail(12);
        tail(6);
        tail(0);
    }
}

/// UTF-16 behind its byte order mark, as UTF-8.
std::string fromUtf16(const std::string& text, bool bigEndian, const std::string& path)
{
    if (text.size() % 2 != 0)
        failAt(path, "is cut short: its UTF-16 text has an odd number of bytes");
    const auto unit = [&](std::size_t i) {
        const auto first = static_cast<unsigned char>(text[i]);
        const auto second = static_cast<unsigned char>(text[i + 1]);
        return std::uint32_t(bigEndian ? first << 8 | second : second << 8 | first);
    };
    std::string out;
    for (std::size_t i = 2; i < text.size(); i += 2) {
        std::uint32_t code = unit(i);
        const bool high = code >= 0xd800 && code < 0xdc00;
        if (high && i + 2 < text.size() && unit(i + 2) >= 0xdc00 && unit(i + 2) < 0xe000) {
            code = 0x10000 + ((code - 0xd800) << 10) + (unit(i + 2) - 0xdc00);
            i += 2;
        }
        appendUtf8(code, out);
    }
    return out;
}

/// Makes every end of a line LF where some are CR alone. Binary files stay as they are.
void endLinesByLf(std::string& text)
{
    constexpr std::size_t head = 4096, lastAscii = 0x7f;
    const auto first = static_cast<unsigned char>(text.empty() ? 0 : text[0]);
    if (first > lastAscii || text.substr(0, head).find('\0') != std::string::npos) return;
    bool lone = false;
    for (std::size_t i = text.find('\r'); i != std::string::npos && !lone;
         i = text.find('\r', i + 1))
        lone = i + 1 >= text.size() || text[i + 1] != '\n';
    if (!lone) return;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n') continue;
        text[kept++] = text[i] == '\r' ? '\n' : text[i];
    }
    text.resize(kept);
}

} // namespace

bool readsOnce(const std::string& path)
{
    std::error_code ignored;
    return path == "-" || std::filesystem::is_other(path, ignored);
}

std::string loadBytes(const std::string& path, std::size_t maxBytes)
{
    return readBytes(path, Limit(maxBytes));
}

std::string withoutMark(std::string text)
{
    if (text.compare(0, 3, "\xEF\xBB\xBF") == 0) text.erase(0, 3);
    return text;
}

namespace
{

std::string unpackedText(std::string bytes, const std::string& path, const Limit& limit)
{
    checkSize(bytes.size(), limit, path);
    std::string text = std::move(bytes);
    text = unpackAny(std::move(text), path, limit);
    if (beginsWith(text, "\xFF\xFE") || beginsWith(text, "\xFE\xFF"))
        text = fromUtf16(text, text[0] == '\xFE', path);
    text = withoutMark(std::move(text));
    endLinesByLf(text);
    if (text.find_first_not_of(" \t\r\n") == std::string::npos) failAt(path, "is empty");
    return text;
}

} // namespace

std::string unpackedText(std::string bytes, const std::string& path, std::size_t maxBytes)
{
    return unpackedText(std::move(bytes), path, Limit(maxBytes));
}

std::string loadText(const std::string& path, std::size_t maxBytes)
{
    return unpackedText(readBytes(path, Limit(maxBytes)), path, maxBytes);
}

std::string loadSmallText(const std::string& path, std::size_t mostBytes)
{
    Limit limit(mostBytes);
    limit.isOption = false;
    return unpackedText(readBytes(path, limit), path, limit);
}

std::string loadUnpacked(const std::string& path, std::size_t maxBytes)
{
    const Limit limit(maxBytes);
    std::string bytes = readBytes(path, limit);
    checkSize(bytes.size(), limit, path);
    return unpackAny(std::move(bytes), path, limit);
}

std::string unpackedBegin(const std::string& path, std::size_t count)
{
    namespace io = boost::iostreams;
    std::ifstream file(path, std::ios::binary);
    std::string magic(2, '\0');
    file.read(magic.data(), 2);
    file.clear();
    file.seekg(0);
    std::string out(count, '\0');
    if (isGzip(magic, 0)) {
        io::filtering_istream in;
        in.push(io::gzip_decompressor());
        in.push(file);
        in.read(out.data(), std::streamsize(count));
        out.resize(std::size_t(in.gcount()));
    } else {
        file.read(out.data(), std::streamsize(count));
        out.resize(std::size_t(file.gcount()));
    }
    return out;
}

} // namespace molsurf
