// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Mesh files. They hold the mesh and nothing else: no time, path or command line, so that the same
/// mesh gives the same bytes.

#include "molsurf/mesh.h"
#include "molsurf/show/io/file_content.h"
#include "molsurf/show/io/output_file.h"

#include <string>
#include <vector>

namespace molsurf
{

/// Writes binary little-endian PLY.
///
/// Vertices come first: float x y z [Å], float nx ny nz (unit, outward), then each of Mesh::scalars
/// as float and of Mesh::labels as int under its own name, then, if there are colours, uchar red
/// green blue. A face is `list uchar int vertex_indices` of three indices and nothing else.
///
/// @param[in] comments  lines for the header
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writePly(const Mesh& mesh, OutputFile& file, const std::vector<std::string>& comments = {});

/// The unit of the formats that are printed from.
struct LengthUnit {
    double perAngstrom = 1.0; ///< units per Å
    const char* name = "Angstrom";
};

/// Writes Wavefront OBJ: positions [unit], normals, faces; an object ("o NAME") for each of the
/// mesh's parts. Numbers have the fewest digits that give the same float back. Colours, from 0 to
/// 1, stand behind the positions, as MeshLab, Blender and others read them; the format has no place
/// for other attributes.
///
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writeObj(const Mesh& mesh, OutputFile& file, const LengthUnit& unit = {});

/// Writes binary STL: triangles [unit] with facet normals (zero for a triangle without area). The
/// format has no place for attributes, and no shared vertices.
///
/// @throws Error(ErrorKind::Output) if the file cannot be written, or if there are more triangles
///         than the format can count
void writeStl(const Mesh& mesh, OutputFile& file, const LengthUnit& unit = {});

/// Writes OFF as text: positions [Å] and faces; with colours it is COFF, with red, green, blue and
/// alpha from 0 to 255 behind each position. The format has no place for other attributes.
///
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writeOff(const Mesh& mesh, OutputFile& file);

/// Writes VRML 2.0 (ISO/IEC 14772-1:1997) as text: one IndexedFaceSet with positions [unit],
/// normals and, if there are any, colours from 0 to 1 at the vertices. The format has no place for
/// other attributes.
///
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writeWrl(const Mesh& mesh, OutputFile& file, const LengthUnit& unit = {});

/// Name and unit in a mesh file.
struct MeshTitle {
    std::string name = "surface"; ///< of the object, in formats that have names
    LengthUnit unit{};            ///< in formats that are printed from
};

/// A format of mesh files.
struct MeshFormat {
    const char* word; ///< how a file's name ends: "ply"
    unsigned holds;   ///< of holds::Content
    const char* help; ///< what a file is, for help texts
    /// @throws Error(ErrorKind::Output) if the file cannot be written
    void (*write)(const Mesh& mesh, const MeshTitle& title, OutputFile& file);
};

/// All of them, in the order of help texts.
const std::vector<MeshFormat>& meshFormats();

} // namespace molsurf
