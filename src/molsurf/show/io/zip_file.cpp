// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/zip_file.h"

#include "molsurf/error.h"

#include <limits>
#include <new>

namespace molsurf
{

namespace
{

// Of the format: APPNOTE.TXT 4.3.7, 4.3.12 and 4.3.16.
constexpr std::uint32_t fileMark = 0x04034b50, entryMark = 0x02014b50, endMark = 0x06054b50;
constexpr std::uint16_t version = 20, noFlags = 0, deflated = 8, midnight = 0, firstDay = 0x21;

/// Numbers of 2 and 4 bytes, the lowest first.
class Record
{
public:
    Record& two(std::uint32_t value) { return number(value, 2); }
    Record& four(std::uint32_t value) { return number(value, 4); }
    const std::string& bytes() const { return bytes_; }

private:
    Record& number(std::uint32_t value, int count)
    {
        for (int i = 0; i < count; ++i) bytes_ += char(value >> 8 * i & 0xff);
        return *this;
    }

    std::string bytes_;
};

} // namespace

ZipFile::~ZipFile()
{
    if (packing_) deflateEnd(&stream_);
}

void ZipFile::begin(const std::string& name)
{
    constexpr int rawWindow = -15, memory = 8; // no header of zlib; zlib's own default
    stream_ = {};
    if (deflateInit2(&stream_, Z_DEFAULT_COMPRESSION, Z_DEFLATED, rawWindow, memory,
                     Z_DEFAULT_STRATEGY) != Z_OK)
        throw std::bad_alloc();
    packing_ = true;
    name_ = name;
    packed_.clear();
    size_ = 0;
    crc_ = 0;
}

void ZipFile::put(std::string_view bytes)
{
    size_ += bytes.size();
    crc_ = std::uint32_t(crc32_z(crc_, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
    pack(bytes, Z_NO_FLUSH);
}

void ZipFile::pack(std::string_view bytes, int flush)
{
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data())); // is not written
    stream_.avail_in = uInt(bytes.size());
    char room[1 << 15];
    do {
        stream_.next_out = reinterpret_cast<Bytef*>(room);
        stream_.avail_out = sizeof room;
        deflate(&stream_, flush);
        packed_.append(room, sizeof room - stream_.avail_out);
    } while (stream_.avail_out == 0);
}

void ZipFile::end()
{
    pack({}, Z_FINISH);
    deflateEnd(&stream_);
    packing_ = false;
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    if (size_ > most || at_ + packed_.size() > most)
        throw Error(ErrorKind::Output, "cannot write " + to_.path() +
                                           ": expected at most 4 GiB of text, got " +
                                           std::to_string(size_) + " bytes");
    Record head;
    head.two(version).two(noFlags).two(deflated).two(midnight).two(firstDay).four(crc_);
    head.four(std::uint32_t(packed_.size())).four(std::uint32_t(size_));
    head.two(std::uint32_t(name_.size())).two(0);
    const std::string local = Record().four(fileMark).bytes() + head.bytes() + name_;
    table_ += Record().four(entryMark).two(version).bytes() + head.bytes() +
              Record().two(0).two(0).two(0).four(0).four(std::uint32_t(at_)).bytes() + name_;
    to_.write(local);
    to_.write(packed_);
    at_ += local.size() + packed_.size();
    ++files_;
}

void ZipFile::finish()
{
    to_.write(table_);
    Record last;
    last.four(endMark).two(0).two(0).two(files_).two(files_);
    last.four(std::uint32_t(table_.size())).four(std::uint32_t(at_)).two(0);
    to_.write(last.bytes());
}

} // namespace molsurf
