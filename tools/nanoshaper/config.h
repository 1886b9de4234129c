// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The configuration file of NanoShaper: "Key = value" on each line, "#" before comments.

#include "molsurf/options.h"

#include <string>
#include <vector>

namespace molsurf::nanoshaper
{

/// The user's request. The defaults are those of NanoShaper.
struct Config {
    std::string file;                    ///< its own path
    std::string input = "molecule.xyzr"; ///< XYZR_FileName
    std::string folder;                  ///< Output_Folder
    std::string root;                    ///< Root_FileName: how the names of all files begin
    SurfaceKind kind = SurfaceKind::SolventExcluded;
    double scale = 2.0;      ///< Grid_scale: voxels an Å
    double probe = 1.4;      ///< [Å]
    double blobbyness = 2.5; ///< -Blobbyness: decay of the Gaussians
    bool mesh = true;        ///< Triangulation
    bool msms = false;       ///< Save_Mesh_MSMS_Format
    bool ply = false;        ///< Save_Mesh_PLY_Format
    bool normals = false;    ///< Compute_Vertex_Normals: in .off
    bool atoms = false;      ///< Vertex_Atom_Info: in .off
    bool fill = false;       ///< Cavity_Detection_Filling
    double filled = 11.4; ///< Conditional_Volume_Filling_Value: volume of cavities that are [Å^3]
    int threads = 0;      ///< Number_thread; 0: as many as there are
    std::vector<std::string> warnings; ///< one line each, as of unknown keys

    /// A file of results: how its name ends is "triangulatedSurf.off".
    std::string path(const std::string& end) const;
};

/// Reads a configuration file.
/// @throws Error(ErrorKind::Input) with the line, if a value is wrong, or asks for what this
///         program cannot make
Config readConfig(const std::string& path);

/// The text of --help, and the manual page, which --man prints.
std::string helpText();
std::string manualText();

} // namespace molsurf::nanoshaper
