// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/read_vdb.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/transient_error.h"
#include "molsurf/molecule/structure/load_text.h"

#include <openvdb/io/DelayedLoadMetadata.h>
#include <openvdb/io/Stream.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>

namespace molsurf
{

namespace
{

[[noreturn]] void cannotRead(const std::string& path, const std::string& why, bool passes = false)
{
    throw Error(ErrorKind::Input, "cannot read " + path + ": " + why, passes);
}

/// Has OpenVDB skip the sizes of leaves that a file may hold for readers that load later, while it
/// lives: it would take as much memory for them as they say.
class WithoutDelayedLoad
{
public:
    WithoutDelayedLoad() { openvdb::io::DelayedLoadMetadata::unregisterType(); }
    ~WithoutDelayedLoad() { openvdb::io::DelayedLoadMetadata::registerType(); }
    WithoutDelayedLoad(const WithoutDelayedLoad&) = delete;
    WithoutDelayedLoad& operator=(const WithoutDelayedLoad&) = delete;
};

} // namespace

bool isVdbFile(const std::string& path)
{
    if (readsOnce(path)) return false;
    std::ifstream stream(path, std::ios_base::binary);
    std::int64_t magic = 0;
    stream.read(reinterpret_cast<char*>(&magic), sizeof magic);
    return stream && magic == openvdb::OPENVDB_MAGIC;
}

std::string vdbText(const std::string& path, const std::string& name)
{
    const auto counted = [](std::size_t length) {
        const auto count = std::uint32_t(length);
        return std::string(reinterpret_cast<const char*>(&count), sizeof count);
    };
    const std::string type = "string"; // name, type and value are each a length and its bytes
    const std::string key = counted(name.size()) + name + counted(type.size()) + type;
    std::ifstream stream(path, std::ios_base::binary);
    std::string head;
    for (const std::size_t most : {std::size_t(1) << 14, std::size_t(1) << 20}) { // few have more
        const std::size_t known = head.size();
        head.resize(most);
        stream.read(head.data() + known, std::streamsize(most - known));
        head.resize(known + std::size_t(std::max<std::streamsize>(stream.gcount(), 0)));
        const std::size_t at = head.find(key);
        if (at == std::string::npos || head.size() - at < key.size() + 4) continue;
        std::uint32_t length = 0;
        std::memcpy(&length, head.data() + at + key.size(), sizeof length);
        const std::size_t begin = at + key.size() + 4;
        if (length <= head.size() - begin || !stream) return head.substr(begin, length);
    }
    return "";
}

VdbFile readVdb(const std::string& path, const std::function<bool(const VdbContent&)>& wanted)
{
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) cannotRead(path, "it is a folder");
    if (readsOnce(path)) cannotRead(path, "it is a pipe or a device, expected a .vdb file");
    errno = 0;
    std::ifstream stream(path, std::ios_base::binary);
    if (!stream) cannotRead(path, std::strerror(errno), mayPass(errno));
    try {
        // Not io::File: beyond the end of a file that is cut short it goes on with whatever its
        // variables held before. A stream that throws there stops it.
        stream.exceptions(std::ios_base::badbit | std::ios_base::failbit | std::ios_base::eofbit);
        const WithoutDelayedLoad guard;
        const VdbContent held = checkVdb(stream, std::filesystem::file_size(path));
        if (wanted && !wanted(held)) return {};
        stream.seekg(0);
        openvdb::io::Stream reader(stream, false);
        VdbFile content;
        content.grids = *reader.getGrids();
        content.metadata = *reader.getMetadata();
        return content;
    } catch (const Error&) {
        throw;
    } catch (const openvdb::Exception& e) {
        cannotRead(path, std::string("not a .vdb file, or damaged (") + e.what() + ")");
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::ios_base::failure&) {
        cannotRead(path, "not a .vdb file, or damaged or cut short");
    } catch (const std::exception& e) {
        cannotRead(path, std::string("not a .vdb file, or damaged (") + e.what() + ")");
    }
}

} // namespace molsurf
