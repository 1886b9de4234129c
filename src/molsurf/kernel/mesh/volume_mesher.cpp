// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/mesh/volume_mesher.h"

namespace molsurf
{

void meshVolume(const openvdb::FloatGrid& surface, openvdb::tools::VolumeToMesh& mesher)
{
    mesher(surface);
}

} // namespace molsurf
