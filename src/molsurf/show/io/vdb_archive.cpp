// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/vdb_archive.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/content_digest.h"
#include "molsurf/show/io/output_buffer.h"

#include <openvdb/Exceptions.h>

#include <cerrno>
#include <cstddef>
#include <ios>
#include <streambuf>
#include <string>
#include <string_view>

namespace molsurf
{

namespace
{

/// Where the identifier is: behind magic number, version of the format, version of the library and
/// a byte that says whether there are offsets.
constexpr std::size_t identifierPlace = 8 + 4 + 2 * 4 + 1;
constexpr std::string_view noIdentifier = "00000000-0000-0000-0000-000000000000";

/// Passes an archive on, with another identifier.
class ArchiveBuffer : public std::streambuf
{
public:
    /// @param[in] to  null: nowhere
    ArchiveBuffer(OutputFile* to, std::string_view identifier) : to_(to), identifier_(identifier) {}

    /// Of all bytes, the last of which are handed on.
    const ContentDigest& finish()
    {
        buffer_.flush();
        return digest_;
    }

protected:
    std::streamsize xsputn(const char* bytes, std::streamsize size) override
    {
        std::string head;
        if (header_ < identifierPlace + identifier_.size()) {
            head = withIdentifier(bytes, std::size_t(size));
            bytes = head.data();
        }
        buffer_.append(bytes, std::size_t(size));
        return size;
    }

    int_type overflow(int_type c) override
    {
        const char byte = traits_type::to_char_type(c);
        return xsputn(&byte, 1) == 1 ? traits_type::not_eof(c) : traits_type::eof();
    }

    pos_type seekoff(off_type by, std::ios_base::seekdir from,
                     std::ios_base::openmode which) override
    {
        buffer_.flush();
        return to_ ? to_->stream().rdbuf()->pubseekoff(by, from, which) : pos_type(off_type(-1));
    }

    pos_type seekpos(pos_type to, std::ios_base::openmode which) override
    {
        buffer_.flush();
        return to_ ? to_->stream().rdbuf()->pubseekpos(to, which) : pos_type(off_type(-1));
    }

private:
    std::string withIdentifier(const char* bytes, std::size_t size)
    {
        std::string out(bytes, size);
        for (char& byte : out) {
            const std::size_t at = header_++ - identifierPlace; // huge before it
            if (at < identifier_.size()) byte = identifier_[at];
        }
        return out;
    }

    OutputFile* to_;
    std::string identifier_;
    std::size_t header_ = 0; // bytes until the end of the identifier, which come in their order
    ContentDigest digest_;
    Buffer buffer_{[this](const char* bytes, std::size_t size) {
        digest_.add(bytes, size);
        if (to_) to_->write(bytes, size);
    }};
};

/// @return the identifier of the archive
std::string pass(const std::function<void(std::ostream&)>& write, OutputFile* to,
                 std::string_view identifier)
{
    ArchiveBuffer buffer(to, identifier);
    std::ostream out(&buffer);
    out.exceptions(std::ios_base::badbit | std::ios_base::failbit);
    write(out);
    return buffer.finish().uuid();
}

} // namespace

void writeArchive(const std::function<void(std::ostream&)>& write, OutputFile& file)
{
    try {
        errno = 0;
        std::ostream& out = file.stream();
        if (file.seekable()) {
            const std::string identifier = pass(write, &file, noIdentifier);
            out.seekp(std::streamoff(identifierPlace));
            out.write(identifier.data(), std::streamsize(identifier.size()));
        } else {
            pass(write, &file, pass(write, nullptr, noIdentifier));
        }
    } catch (const std::ios_base::failure&) {
        file.fail("cannot write");
    } catch (const openvdb::Exception& e) {
        throw Error(ErrorKind::Output, "cannot write " + file.path() + ": " + e.what());
    }
    file.finish();
}

} // namespace molsurf
