// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The formats of output files, a row each: the words of the command line, its help, what a verb
/// writes, what a file cannot show, and the writers come from it.

#include <string>
#include <vector>

namespace molsurf
{
class OutputFile;
}

namespace molsurf::tool
{

/// What a file of a format holds or shows. Bits make sets.
enum Holds : unsigned {
    Grids = 1 << 0,             ///< the level set and its fields
    Triangles = 1 << 1,         ///< the mesh; of a whole by symmetry all of its triangles
    Numbers = 1 << 2,           ///< the report
    Areas = 1 << 3,             ///< a table of areas, or atoms with theirs
    FrameRows = 1 << 4,         ///< the table of all frames
    AllFrames = 1 << 17,        ///< rows of all frames in one file
    Stage = 1 << 5,             ///< a scene of OpenUSD: copies, or the volume of a .vdb
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
    Script = 1 << 19            ///< what opens another file of the run
};

/// What a file is written of, and how.
struct Writing;

/// A format.
struct Format {
    const char* word;  ///< how a file's name ends, without the first dot: "ply", "atoms.csv"
    unsigned verbs;    ///< that write it
    unsigned holds;    ///< of Holds
    const char* help;  ///< what a file is, for help texts; of two in turn with the same said once
    const char* table; ///< the table of areas that it has, one of areaTables(); "" if none
    void (*write)(const Writing& what, OutputFile& file); ///< null: a verb does so by itself
    const char* opens = ""; ///< of a Script: the format of the file that it opens
};

/// All of them, in the order of help texts.
const std::vector<Format>& formatTable();

/// What a verb's files are, for the help text of --output.
std::string filesOf(unsigned verb);

/// The format of a word, or null.
const Format* findFormat(const std::string& word);

/// ".vdb, .ply and .json": the formats that hold one of some things and that some verbs write.
std::string endingsOf(unsigned holds, unsigned verbs, const char* last = " and ");

} // namespace molsurf::tool
