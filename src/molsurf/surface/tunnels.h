// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The tunnels of a molecule as a product of a run.

#include "molsurf/analysis/measures/lining.h"
#include "molsurf/mesh.h"
#include "molsurf/show/io/output_file.h"
#include "molsurf/surface.h"

#include <openvdb/Types.h>

namespace molsurf
{

/// Puts the tunnels that atoms were read with in a report.
/// @param[in] atoms  with BallSet::tunnelsFrom
void addTunnels(const BallSet& atoms, const SurfaceOptions& options, Progress& progress,
                Report& report);

/// What lines a tunnel, each ball by the length of the way that it is beside.
Lining liningOfTunnel(const BallSet& atoms, const Report::Tunnels::Tunnel& tunnel);

/// The tunnels as closed tubes, a part each, coloured by poreColor() of their radii, which the
/// scalar "radius" has.
Mesh tunnelTubes(const Report::Tunnels& tunnels);

/// The balls of tunnels as atoms, whose B factors are to be their radii: a residue TUN for each
/// tunnel, with its number.
BallSet tunnelBalls(const Report::Tunnels& tunnels);

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
