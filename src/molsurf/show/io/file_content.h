// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The contents of files: which options a format shows.

namespace molsurf::holds
{

/// Contents of a file of a format. Bits make sets.
enum Content : unsigned {
    Grids = 1 << 0,             ///< the level set and its fields
    Triangles = 1 << 1,         ///< the mesh; of a whole by symmetry all of its triangles
    Numbers = 1 << 2,           ///< the report
    Areas = 1 << 3,             ///< a table of areas, or atoms with theirs
    FrameRows = 1 << 4,         ///< the table of all frames
    AllFrames = 1 << 17,        ///< rows of all frames in one file
    Stage = 1 << 5,             ///< a scene of OpenUSD: mesh, copies, film or the volume of a .vdb
    Colors = 1 << 6,            ///< of vertices, voxels or copies
    ColorChoices = 1 << 7,      ///< several colourings, to choose from
    PlainColor = 1 << 8,        ///< the colour of what has no other
    CutBorders = 1 << 9,        ///< borders between colours, where they are asked for
    VertexCurvatures = 1 << 10, ///< attributes of vertices
    Millimetres = 1 << 11,      ///< lengths for a print
    SceneUnits = 1 << 12,       ///< lengths as another program takes them
    Copies = 1 << 13,           ///< all copies of an assembly
    Levels = 1 << 14,           ///< levels of detail
    Views = 1 << 15,            ///< the surface as seen from somewhere, with crisp borders
    Pixels = 1 << 16,           ///< a picture
    Volume = 1 << 18,           ///< the level set on all points of a box
    Paint = 1 << 20,            ///< colours of triangles for slicers, of which there are few
    Script = 1 << 19,           ///< what opens another file of the run
    Solver = 1 << 21,           ///< what APBS reads
    Shares = 1 << 22,           ///< shares of frames, on voxels
    Numbered = 1 << 24,         ///< a file of each pocket
    Moving = 1 << 23,           ///< the pictures of a turntable or of frames in one film
    BareGrids = 1 << 25,        ///< the level set and its fields without metadata of the run
    Density = 1 << 26,          ///< a density on pixels of a tomogram
    Mask = 1 << 27              ///< a soft mask on such pixels
};

/// The contents of files that are no meshes, by the ending of their names.
constexpr unsigned heldByVdb = Grids | Colors | SceneUnits;
constexpr unsigned heldByNvdb = BareGrids | Colors | SceneUnits;
constexpr unsigned anyGrids = Grids | BareGrids;
constexpr unsigned heldByPng = Colors | PlainColor | Copies | Views | Pixels;
constexpr unsigned heldByHtml = Colors | ColorChoices | PlainColor | Copies | Levels | Views;

} // namespace molsurf::holds
