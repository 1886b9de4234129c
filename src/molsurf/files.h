// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Writes surfaces to files and reads meshes from files. A file is written under a temporary name
/// in its folder and renamed when it is complete, so a failure leaves none.

#include "molsurf/mesh.h"
#include "molsurf/report.h"
#include "molsurf/surface.h"

#include <string>
#include <utility>
#include <vector>

namespace molsurf
{

/// How the names of files of atoms end: ".pdb", ".cif", ... Each may have a further ".gz",
/// ".bz2" or ".xz".
std::vector<std::string> structureEndings();

/// How the names of mesh files end: ".ply", ".obj", ...
std::vector<std::string> meshEndings();

/// How the names of files of a surface end: ".vdb", ".ply", ".atoms.csv", ...
std::vector<std::string> surfaceEndings();

/// Writes a mesh in the format that the extension tells, one of meshEndings(); .ply (binary) has
/// all attributes. Lengths are in Å.
/// @param[in] replace  whether a file that exists may be replaced
/// @throws Error(ErrorKind::Usage) if the extension is another one
/// @throws Error(ErrorKind::Output) if the file cannot be written, or if it exists and may not be
///         replaced
void writeMesh(const Mesh& mesh, const std::string& path, bool replace = true);

/// Writes the grids of a surface as an OpenVDB file, the level set first.
/// @param[in] replace  whether a file that exists may be replaced
/// @param[in] scene    "blender", "blender4", "houdini" or "usd", perhaps with "=SCALE", places and
/// scales them
///                     for that program: docs/artists.md; empty: they lie as they are, in Å
/// @throws Error(ErrorKind::Usage) if the scene is none of these
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writeVdb(const MolecularSurface& surface, const std::string& path, bool replace = true,
              const std::string& scene = "");

/// Writes a report as JSON.
/// @param[in] replace  whether a file that exists may be replaced
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writeReport(const Report& report, const std::string& path, bool replace = true);

/// Draws a mesh and writes the picture as PNG.
/// @param[in] width    width of the picture [pixel], in [16, 16384]; the height follows the shape
/// @param[in] replace  whether a file that exists may be replaced
/// @throws Error(ErrorKind::Usage) if the width is out of its range
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writePicture(const Mesh& mesh, const std::string& path, int width = 1200, bool replace = true);

/// Draws the surface of atoms with the legend of its colours, or, if the name ends in .html, writes
/// a page that shows it in a browser and names its atoms.
/// @param[in] options   that the surface was made with
/// @param[in] settings  names and values of the picture's options on the command line, such as
///                      {"size", "600"} or {"pieces", "outer"}; the value of a switch does not
///                      matter
/// @param[in] replace   as above
/// @throws Error(ErrorKind::Usage) if a setting is wrong
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writePicture(const BallSet& atoms, const MolecularSurface& surface,
                  const SurfaceOptions& options, const std::string& path,
                  const std::vector<std::pair<std::string, std::string>>& settings = {},
                  bool replace = true);

/// A surface in a picture or page, with what it was made of and with. None is null.
struct ShownSurface {
    const BallSet* atoms;
    const MolecularSurface* surface;
    const SurfaceOptions* options;
    std::string name{}; ///< below its panel, or in the menu of a page
    /// Atoms with names that a picture shows beside it, and how: a word as of --show. Surfaces of
    /// atoms in the same places that have none show those of the first.
    std::vector<std::pair<std::string, const BallSet*>> show{};
};

/// Draws surfaces side by side, from one eye, in one scale and with one legend, or writes a page
/// that shows them side by side or one at a time. The first one decides the view.
/// @param[in] surfaces  at least one; those of atoms in the same places lie in one place on a page,
///                      and the labels and rulers of a picture are theirs alone
/// @param[in] settings  as above; pages take the view, the plain colour, the opacity and the walls
/// @throws as above
void writePicture(const std::vector<ShownSurface>& surfaces, const std::string& path,
                  const std::vector<std::pair<std::string, std::string>>& settings = {},
                  bool replace = true);

/// Writes a surface in the format that the end of the name says, one of surfaceEndings(): the file
/// that the command writes under that name. With {"for", "apbs"} it writes into a folder the files
/// that APBS reads: maps of the dielectric and of ions, charges and its input
/// (docs/electrostatics.md). Several files, as the pictures of a turntable and those of pockets,
/// come all or none. A film without a `turntable` is a turn of 36 pictures.
///
/// @param[in] surfaces  one; of pictures, films and pages more, as writePicture() takes
///                      them
/// @param[in] settings  names and values of the options of files and pictures on the command line,
///                      such as {"pieces", "outer"}, {"sharp-colors", ""} or {"print-scale", "0.5"}
/// @param[in] replace   as above
/// @throws Error(ErrorKind::Usage) if a setting is wrong or one that the file does not show, if the
///         name ends otherwise, or if the surface was made without what the file holds: tables
///         need Products::ballAreas and the like, APBS atoms that were read with
///         LabelOptions::charges and are the whole
/// @throws Error(ErrorKind::Output) if a file cannot be written
void writeSurface(const std::vector<ShownSurface>& surfaces, const std::string& path,
                  const std::vector<std::pair<std::string, std::string>>& settings = {},
                  bool replace = true);

/// Reads positions and triangles from a file in the format that the extension tells: .ply (text or
/// binary, of either byte order), .obj, or .stl (text or binary). Polygons are split into fans.
/// Normals, colours and other attributes, materials and groups are skipped.
///
/// Vertices at the same place become one in a .stl file, whose triangles share none, and in others
/// if the mesh is not closed otherwise. Triangles with two corners at the same place are dropped,
/// and so are vertices without triangles.
///
/// @return a mesh with at least one triangle, positions finite and below 1e6 Å, without normals
/// @throws Error(ErrorKind::Input) if the file cannot be read, is damaged or cut short, or has no
///         triangle; the message names the line, vertex or face
Mesh readMesh(const std::string& path);

} // namespace molsurf
