// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/archive.h"

#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <sys/stat.h>

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string_view>

namespace molsurf
{

namespace
{

constexpr const char* separator = "::";
constexpr std::size_t block = 512;            ///< [byte]
constexpr std::int64_t longestNote = 1 << 20; ///< of a name or of PAX records [byte]

using Header = std::array<char, block>;

std::string textAt(const Header& header, std::size_t at, std::size_t size)
{
    const char* begin = header.data() + at;
    return {begin, strnlen(begin, size)};
}

/// A number of a header: octal digits, or bytes behind one with the highest bit. Less than 0: none.
std::int64_t numberAt(const Header& header, std::size_t at, std::size_t size)
{
    std::int64_t number = 0;
    if (header[at] & 0x80) {
        for (std::size_t i = at + 1; i < at + size; ++i) {
            if (number >> 54) return -1;
            number = number * 256 + static_cast<unsigned char>(header[i]);
        }
        return number;
    }
    const std::string text = textAt(header, at, size);
    for (const char digit : text.substr(std::min(text.find_first_not_of(' '), text.size()))) {
        if (digit == ' ') break;
        if (digit < '0' || digit > '7') return -1;
        number = number * 8 + (digit - '0');
    }
    return number;
}

/// Whether the checksum of a header is right.
bool isHeader(const Header& header)
{
    constexpr std::size_t at = 148, size = 8; // the sum counts itself as spaces
    std::int64_t sum = std::int64_t(' ' * size);
    for (std::size_t i = 0; i < block; ++i)
        if (i < at || i >= at + size) sum += static_cast<unsigned char>(header[i]);
    return numberAt(header, at, size) == sum;
}

/// Reads the name and the size of the member behind PAX records, "LENGTH KEY=VALUE" each.
void readRecords(std::string_view text, std::string& name, std::int64_t& size)
{
    while (!text.empty()) {
        const std::size_t space = std::min(text.find(' '), text.size());
        std::size_t length = 0;
        if (!parseWhole(text.substr(0, space), length) || length <= space || length > text.size())
            return;
        const std::string_view record = text.substr(space + 1, length - space - 2);
        text.remove_prefix(length);
        if (record.rfind("path=", 0) == 0) name = record.substr(5);
        if (record.rfind("size=", 0) == 0) parseWhole(record.substr(5), size);
    }
}

/// An archive that is open, packed or not, with the places of its members.
class Archive
{
public:
    explicit Archive(const std::string& path, const struct stat& state)
        : path_(path), state_(state), file_(gzopen(path.c_str(), "rb"), &gzclose)
    {
        if (!file_) failBySystem(path, "cannot be opened");
        gzbuffer(file_.get(), 1 << 18);
        readPlaces();
    }

    bool isOf(const std::string& path, const struct stat& state) const
    {
        return path == path_ && state.st_dev == state_.st_dev && state.st_ino == state_.st_ino &&
               state.st_size == state_.st_size && state.st_mtim.tv_sec == state_.st_mtim.tv_sec &&
               state.st_mtim.tv_nsec == state_.st_mtim.tv_nsec;
    }

    const std::vector<std::string>& names() const { return names_; }

    const std::string& content(const std::string& name, std::size_t maxBytes)
    {
        const auto place = places_.find(name);
        if (place == places_.end()) failAt(path_, "has no member " + name);
        const auto [offset, size] = place->second;
        if (maxBytes > 0 && std::uint64_t(size) > maxBytes)
            failAt(path_ + separator + name, "expected at most " + std::to_string(maxBytes) +
                                                 " bytes [hint: a larger `maxInput`]");
        if (name == last_) return content_;
        last_.clear();
        content_.assign(std::size_t(size), '\0');
        seek(offset);
        read(content_.data(), content_.size());
        last_ = name;
        return content_;
    }

private:
    void seek(std::int64_t offset)
    {
        if (gzseek(file_.get(), z_off_t(offset), SEEK_SET) != z_off_t(offset)) failToRead();
    }

    [[noreturn]] void failToRead()
    {
        int problem = Z_OK;
        gzerror(file_.get(), &problem);
        if (problem == Z_ERRNO) failBySystem(path_, "cannot be read");
        failAt(path_, problem == Z_DATA_ERROR ? "has damaged gzip data" : "is cut short");
    }

    void read(char* to, std::size_t size)
    {
        while (size > 0) {
            const unsigned part = unsigned(std::min<std::size_t>(size, 1 << 30));
            const int got = gzread(file_.get(), to, part);
            if (got <= 0) failToRead();
            to += got;
            size -= std::size_t(got);
        }
    }

    /// @return false at the end
    bool readHeader(std::int64_t at, Header& header)
    {
        seek(at);
        const int got = gzread(file_.get(), header.data(), 1);
        if (got == 0) {
            int problem = Z_OK;
            gzerror(file_.get(), &problem);
            // Some archives are without their blocks of zeros. Of one that is packed that may be a
            // damaged member of gzip, with all that is behind it.
            if (problem == Z_OK && gzdirect(file_.get())) return false;
        }
        if (got != 1) failToRead();
        read(header.data() + 1, block - 1);
        if (std::all_of(header.begin(), header.end(), [](char c) { return c == '\0'; }))
            return false;
        if (!isHeader(header))
            failAt(path_, "is no .tar, or is damaged: expected the header of a member at byte " +
                              std::to_string(at));
        return true;
    }

    std::string note(std::int64_t size)
    {
        if (size < 0 || size > longestNote)
            failAt(path_, "has a name of a member that is too long");
        std::string text(std::size_t(size), '\0');
        read(text.data(), text.size());
        return text;
    }

    void readPlaces()
    {
        constexpr std::size_t kindAt = 156, sizeAt = 124, sizeLength = 12;
        std::string name; // by a note before the member
        std::int64_t size = -1, at = 0;
        for (Header header; readHeader(at, header);) {
            // L: a long name of GNU, K: a long link, x: attributes of the next member, g: of all;
            // 0, none, 7: a file
            const char kind = header[kindAt];
            std::int64_t length = numberAt(header, sizeAt, sizeLength);
            if (kind == 'L') {
                name = note(length).c_str();
            } else if (kind == 'x') {
                readRecords(note(length), name, size);
            } else if (kind != 'g' && kind != 'K') {
                if (size >= 0) length = size;
                if (name.empty()) name = nameIn(header);
                if (kind == '0' || kind == '\0' || kind == '7') add(name, at + block, length);
                name.clear();
                size = -1;
            }
            if (length < 0 || length > std::int64_t(1) << 60)
                failAt(path_, "has a member without a size at byte " + std::to_string(at));
            at += std::int64_t(block) * (1 + (length + std::int64_t(block) - 1) / block);
        }
    }

    static std::string nameIn(const Header& header)
    {
        const std::string name = textAt(header, 0, 100);
        const bool whole = textAt(header, 257, 5) == "ustar" && header[262] == '\0'; // not GNU's
        const std::string prefix = whole ? textAt(header, 345, 155) : "";
        return prefix.empty() ? name : prefix + "/" + name;
    }

    /// Of two members with one name the last counts.
    void add(const std::string& name, std::int64_t at, std::int64_t size)
    {
        const auto [place, fresh] = places_.insert_or_assign(name, std::pair(at, size));
        if (fresh) names_.push_back(place->first);
    }

    std::string path_;
    struct stat state_;
    std::unique_ptr<gzFile_s, int (*)(gzFile)> file_;
    std::map<std::string, std::pair<std::int64_t, std::int64_t>> places_; // offset and size [byte]
    std::vector<std::string> names_;
    std::string last_, content_; // of the member that was read last
};

/// The archive of a path, kept open for the next call. To be called under a lock.
Archive& opened(const std::string& path)
{
    static std::unique_ptr<Archive> kept;
    struct stat state;
    if (stat(path.c_str(), &state) != 0) failBySystem(path, "cannot be opened");
    if (!kept || !kept->isOf(path, state)) {
        kept.reset();
        kept = std::make_unique<Archive>(path, state);
    }
    return *kept;
}

std::mutex& turn()
{
    static std::mutex one;
    return one;
}

} // namespace

bool isArchiveName(const std::string& path)
{
    const std::string name = lowered(path);
    const auto ends = [&](std::string_view ending) {
        return name.size() > ending.size() &&
               name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
    };
    return ends(".tar") || ends(".tar.gz") || ends(".tgz");
}

std::optional<ArchiveMember> memberOf(const std::string& path)
{
    const std::size_t at = path.find(separator);
    if (at == std::string::npos) return std::nullopt;
    ArchiveMember member{path.substr(0, at), path.substr(at + std::strlen(separator))};
    struct stat state;
    const bool there = isArchiveName(member.archive) && stat(member.archive.c_str(), &state) == 0 &&
                       S_ISREG(state.st_mode) && stat(path.c_str(), &state) != 0;
    return there ? std::optional(member) : std::nullopt;
}

std::vector<std::string> membersIn(const std::string& archive)
{
    const std::lock_guard<std::mutex> lock(turn());
    std::vector<std::string> paths;
    for (const std::string& name : opened(archive).names())
        paths.push_back(archive + separator + name);
    return paths;
}

std::string readMember(const ArchiveMember& member, std::size_t maxBytes)
{
    const std::lock_guard<std::mutex> lock(turn());
    return opened(member.archive).content(member.name, maxBytes);
}

std::string inputStem(const std::string& input)
{
    const auto member = memberOf(input);
    std::filesystem::path name = std::filesystem::path(member ? member->name : input).filename();
    for (const char* const packed : {".gz", ".bz2", ".xz"})
        if (name.extension() == packed) {
            name = name.stem();
            break;
        }
    return name.stem().string();
}

} // namespace molsurf
