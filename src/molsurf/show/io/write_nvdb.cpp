// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/write_nvdb.h"

#include "molsurf/error.h"

#include <nanovdb/util/IO.h>
#include <nanovdb/util/OpenToNanoVDB.h>

#include <sstream>
#include <stdexcept>

namespace molsurf
{

void writeNvdb(const openvdb::GridCPtrVec& grids, OutputFile& file)
{
    for (const openvdb::GridBase::ConstPtr& grid : grids) {
        nanovdb::GridHandle<nanovdb::HostBuffer> handle;
        try {
            handle = nanovdb::openToNanoVDB(openvdb::ConstPtrCast<openvdb::GridBase>(grid));
        } catch (const std::runtime_error& e) {
            throw Error(ErrorKind::Output, "cannot write " + file.path() + ": grid " +
                                               grid->getName() + ": " + e.what());
        }
        nanovdb::io::Segment segment(nanovdb::io::Codec::NONE);
        segment.add(handle);
        segment.meta[0].fileSize = handle.size();
        std::ostringstream header;
        segment.write(header);
        file.write(header.str());
        file.write(handle.data(), handle.size());
    }
    file.finish();
}

} // namespace molsurf
