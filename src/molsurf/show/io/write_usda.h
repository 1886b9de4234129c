// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A .vdb file, or a numbered sequence of them, as a volume of OpenUSD.

#include "molsurf/atoms.h"
#include "molsurf/show/io/output_file.h"

#include <openvdb/openvdb.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace molsurf
{

/// The .vdb file or files that a .usda file refers to, and their scale.
struct UsdVolume {
    std::string name;             ///< of the prim; letters that USD does not take become _
    double metersPerUnit = 1e-10; ///< of the grids' transforms
    std::string file;             ///< the .vdb, relative to the .usda
    /// Frames of a sequence and their files, the first one first; empty: no sequence.
    std::vector<std::pair<int, std::string>> frames;
    double framesPerSecond = 24.0;
    std::map<int, std::string> extents; ///< of other frames, as text: extentsOfUsda()
    /// Light that fog of density 1 scatters on its way through a unit of length, as optical depth.
    double scattering = 0.5;
    std::vector<Instance>
        copies; ///< of the volume, in units of the grids; empty: it is where it is
};

/// Writes USD as text: a Volume with an OpenVDBAsset for each grid, whose field class, type and
/// vector role are the grid's. Up is z, as in the other files. Fog (`density`, and `Cd` if there is
/// one) has a Material; the variant `materialx` of the set `fog` has its nodes, and `plain` is
/// selected, since OpenUSD knows them only where MaterialX is built in. Copies are a
/// PointInstancer, as writeUsdaInstances() writes it.
///
/// @param[in] grids  as they are in the .vdb; of a sequence those of one frame
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writeUsda(const openvdb::GridCPtrVec& grids, const UsdVolume& volume, OutputFile& file);

/// Whether a file is one that writeUsda() has made.
bool isOwnUsda(const std::string& path);

/// The extents of the frames in a file that writeUsda() has made, as they stand there.
std::map<int, std::string> extentsOfUsda(const std::string& path);

} // namespace molsurf
