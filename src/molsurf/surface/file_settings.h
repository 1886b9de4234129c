// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The options of files but pictures, a row each: the command line and Python's save() take them.

#include "molsurf/analysis/measures/area_tables.h"
#include "molsurf/mesh.h"
#include "molsurf/progress.h"
#include "molsurf/show/io/scene.h"
#include "molsurf/show/io/write_apbs.h"
#include "molsurf/show/io/write_mesh.h"
#include "molsurf/surface/option_row.h"
#include "molsurf/surface/tomogram_map.h"

#include <string>
#include <vector>

namespace molsurf
{

/// The closed pieces of the surface that meshes and pictures have.
enum class KeptPieces { All, Outer, Cavities };

/// Their words: all, outer, cavities.
const char* nameOf(KeptPieces pieces);

/// How files hold a surface.
struct FileSettings {
    bool sharpColors = false; ///< mesh files have the borders between colours cut
    KeptPieces pieces = KeptPieces::All;
    Scene scene;             ///< of the .vdb and the node of the .glb
    bool forApbs = false;    ///< a folder gets the files that APBS reads
    bool center = false;     ///< the middle of the surface comes to the origin
    double printScale = 0.0; ///< of .stl, .obj, .wrl and .3mf [mm/Å]; 0: they are in Å
    std::string apbsInput;   ///< whose lattice is used; empty: that of gridAround()
    Dielectric dielectric;
    double fps = 0.0;                              ///< frames per second; 0: times are in frames
    int turntable = 0;                             ///< number of pictures round the upright; 0: one
    bool weld = false;                             ///< units of a whole share their vertices
    ContactLevel contacts = ContactLevel::Residue; ///< of tables of contacts
    TomogramSettings tomogram;                     ///< of densities and masks

    /// The unit of the formats that are printed from.
    LengthUnit printUnit() const
    {
        return printScale > 0.0 ? LengthUnit{printScale, "mm"} : LengthUnit{};
    }
};

/// An option of files.
using FileSetting = OptionRow<FileSettings>;

/// All of them, in the order of help texts.
const std::vector<FileSetting>& fileSettings();

/// Removes the closed pieces that are not wanted: by the sign of their volume they are cavities.
/// @throws Error(ErrorKind::Input) if none stays
void keepPieces(KeptPieces kept, const Progress& progress, Mesh& mesh);

/// Moves a mesh so that the middle of its box is the origin.
/// @param[in] center  null, or the point that becomes the origin instead [Å]
/// @return where the origin was taken from [Å]
openvdb::Vec3d moveToOrigin(Mesh& mesh, const openvdb::Vec3d* center = nullptr);

} // namespace molsurf
