// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Gives the grids of a .vdb their place and scale in the scene of another program.

#include "molsurf/show/io/grid_form.h"

#include <openvdb/openvdb.h>

#include <optional>
#include <string>
#include <vector>

namespace molsurf
{

/// The programs whose conventions are known.
enum class Host {
    None,     ///< grids as they are: Å, a voxel's value at the voxel's coordinate
    Blender,  ///< from 5.0 on, OpenVDB's own convention
    Blender4, ///< up to 4.5: it shows the value of a voxel half a voxel farther along each axis
    Houdini,  ///< OpenVDB's own convention
    Usd,      ///< the same, and a .usda file beside the .vdb
    Unreal,   ///< the same, of fogs and colours that share a box, with 16 bits
    Arnold    ///< the same
};

/// The program that the grids are for, their scale and their origin.
struct Scene {
    Host host = Host::None;
    double scale = 1.0;         ///< scene units per Å, > 0
    openvdb::Vec3d center{0.0}; ///< comes to the origin [Å]
    /// Optical depth of an Å of the inside of `density`, > 0, whatever the scale: values are this
    /// over `scale`; 0: they are 1 inside.
    double fogDensity = 0.0;
    GridForm form;
    bool known() const { return host != Host::None; }
};

/// Reads "blender", "blender4", "houdini", "usd", "unreal" or "arnold", perhaps with "=SCALE": a
/// number, or one of
/// - "mn-0.01" and "mn-0.1": of Molecular Nodes up to and from its line for Blender 5.2;
/// - "nm": a unit is a nanometre, 0.1 units per Å.
///
/// @return nothing if it is none of these
std::optional<Scene> parseScene(const std::string& text);

/// The word of parseScene(); "none".
const char* nameOf(Host host);

/// The words of all programs.
std::vector<std::string> hostNames();

/// The power of a length that the values of a field have: 1 for distances, -1 for the mean
/// curvature, 0 for colours. Names of parts, "surface_A", are those of their fields.
int lengthPower(const openvdb::GridBase& grid);

/// Grids for a scene: moved by -center, scaled, and for Blender up to 4.5 shifted by minus half a
/// voxel, so that it shows them where they are. Values that have a unit of length are scaled too,
/// with the background. Then they get the scene's form. The grids themselves stay as they are;
/// those that change only their place share their voxels with the result.
///
/// @param[in] isMoved  whether Scene::center counts
/// @param[in] grids  with voxels that are cubes along the axes, and no grid of its kind other than
///                   float where the values have a unit
/// @throws Error(ErrorKind::Usage) if none is of a kind that the program takes; as formed()
openvdb::GridCPtrVec placeInScene(const openvdb::GridCPtrVec& grids, const Scene& scene,
                                  bool isMoved);

/// Adds to the metadata of a file how its grids lie in their scene, so that they can be read back.
void describeScene(const Scene& scene, openvdb::MetaMap& metadata);

} // namespace molsurf
