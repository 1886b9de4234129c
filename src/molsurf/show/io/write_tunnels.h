// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Writes tunnels for programs that show or compare them.

#include "molsurf/atoms.h"
#include "molsurf/report.h"
#include "molsurf/show/io/output_file.h"

#include <openvdb/Types.h>

namespace molsurf
{

/// Writes tunnels as mmCIF, in the categories of the dictionary mmcif_tunnels: sb_ncbr_channel,
/// sb_ncbr_channel_props and sb_ncbr_channel_profile.
/// @param[in] atoms   that they are of
/// @param[in] origin  the point that is 0 in the file [Å]
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writeTunnelsCif(const BallSet& atoms, const Report::Tunnels& tunnels,
                     const openvdb::Vec3d& origin, OutputFile& file);

/// Writes commands of ChimeraX that show tunnels as markers, and of PyMOL that show them as
/// spheres: in both an object for each tunnel, with the colours of poreColor().
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writeTunnelsChimeraX(const Report::Tunnels& tunnels, const openvdb::Vec3d& origin,
                          OutputFile& file);
void writeTunnelsPymol(const Report::Tunnels& tunnels, const openvdb::Vec3d& origin,
                       OutputFile& file);

} // namespace molsurf
