// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// ZIP archives.

#include "molsurf/show/io/output_file.h"

#include <zlib.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace molsurf
{

/// Writes a ZIP archive, one file after another. All are packed, of 1 January 1980, so that equal
/// content has equal bytes.
class ZipFile
{
public:
    explicit ZipFile(OutputFile& to) : to_(to) {}
    ~ZipFile();
    ZipFile(const ZipFile&) = delete;
    ZipFile& operator=(const ZipFile&) = delete;

    /// Begins a file; put() adds to it.
    void begin(const std::string& name);
    void put(std::string_view bytes);

    /// Ends the last file.
    /// @throws Error(ErrorKind::Output) if it has more than 4 GiB, or cannot be written
    void end();

    /// Writes the table of the files, at the end of the archive.
    void finish();

private:
    void pack(std::string_view bytes, int flush);

    OutputFile& to_;
    z_stream stream_{};
    bool packing_ = false;
    std::string name_, packed_, table_;
    std::uint64_t size_ = 0, at_ = 0; // of the file, unpacked; of the archive until now
    std::uint32_t crc_ = 0;
    std::uint16_t files_ = 0;
};

} // namespace molsurf
