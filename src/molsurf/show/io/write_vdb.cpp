// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/write_vdb.h"

#include "molsurf/show/io/vdb_archive.h"

#include <openvdb/io/Archive.h>
#include <openvdb/io/Compression.h>

#include <algorithm>

namespace molsurf
{

namespace
{

// io::File ignores a disk that fills up while it writes. The same archive on a stream of our own,
// which throws, does not.
class StreamArchive : public openvdb::io::Archive
{
public:
    explicit StreamArchive(std::uint32_t compression) { setCompression(compression); }

    void writeTo(std::ostream& stream, bool seekable, const openvdb::GridCPtrVec& grids,
                 const openvdb::MetaMap& metadata) const
    {
        Archive::write(stream, grids, seekable, metadata);
    }
};

} // namespace

std::uint32_t vdbCompression(bool floatsAlone)
{
    const std::uint32_t active = openvdb::io::COMPRESS_ACTIVE_MASK;
    return floatsAlone ? active : active | openvdb::io::COMPRESS_BLOSC;
}

void writeVdb(const openvdb::GridCPtrVec& grids, const openvdb::MetaMap& metadata, OutputFile& file)
{
    const bool floatsAlone = std::all_of(grids.begin(), grids.end(), [](const auto& grid) {
        return grid->template isType<openvdb::FloatGrid>();
    });
    const StreamArchive archive(vdbCompression(floatsAlone));
    writeArchive([&](std::ostream& out) { archive.writeTo(out, file.seekable(), grids, metadata); },
                 file);
}

} // namespace molsurf
