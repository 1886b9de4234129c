// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// 3MF, the 3D Manufacturing Format.

#include "molsurf/mesh.h"
#include "molsurf/show/io/output_file.h"

#include <cstddef>
#include <string>

namespace molsurf
{

/// The colours that slicers tell apart in paint, one an extruder or filament.
constexpr std::size_t mostPaints = 16;

/// How many colours the vertices of a mesh have.
std::size_t colorsIn(const Mesh& mesh);

/// Writes a .3mf: one object in millimetres with six decimals, so that slicers leave its parts
/// where they are, and, if there are colours, the three of each triangle's corners (sRGB). The
/// format has no place for normals and other attributes. One mesh gives the same bytes; the
/// identifiers (UUID) that the format wants are made of the mesh.
///
/// Slicers pass over these colours. For them up to mostPaints colours are paint, too: each
/// triangle has the number of its colour in the attribute slic3rpe:mmu_segmentation, as PrusaSlicer
/// reads it. (The paint_color of others is in no namespace, and strict readers refuse such files.)
/// Parts are volumes of the object, with an extruder each, in Metadata/Slic3r_PE_model.config.
///
/// @param[in] name    of the object
/// @param[in] perAngstrom  millimetres per Å
/// @throws Error(ErrorKind::Output) if the file cannot be written, or if it holds more than 4 GiB
void write3mf(const Mesh& mesh, const std::string& name, double perAngstrom, OutputFile& file);

} // namespace molsurf
