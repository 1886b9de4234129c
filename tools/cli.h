// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The command line: what the user typed, as values. The only place that knows an option's name and
/// its help text.

#include "molsurf/io/scene.h"
#include "molsurf/picture/draw_mesh.h"
#include "molsurf/surface/options.h"

#include <string>
#include <vector>

namespace molsurf::tool
{

/// Kinds of output files.
enum class Format { Vdb, Ply, Obj, Stl, Off, Glb, Json, Png, Html, Usda, Csv, ThreeMf };

/// One -o.
struct Output {
    std::string path; ///< "-" is standard output
    Format format;
    std::string of;    ///< Usda: the .vdb beside it
    double turn = 0.0; ///< Png: of a turntable, beside that of the picture [degree]
};

/// What the tool is asked to do.
enum class Verb {
    Build,
    Batch,
    Compare,
    Info,
    Plan,
    Brick,
    Merge,
    Mesh,
    Color,
    Help,
    BatchHelp,
    CompareHelp,
    InfoHelp,
    PlanHelp,
    BrickHelp,
    MergeHelp,
    MeshHelp,
    ColorHelp,
    ListRadii,
    Version,
    Man,       ///< `--man`, for the build
    Completion ///< `--bash-completion`, for the build
};

/// A parsed command line.
struct Call {
    Verb verb = Verb::Build;
    std::string command;         ///< the command line as typed, quoted for a shell
    std::string input;           ///< Build, Plan: a file, or "-"; Batch: the list, likewise; Brick,
                                 ///< Merge: the manifest of a plan; Mesh, Color: a .vdb
    std::string frames;          ///< Build: of --frames; empty: none
    std::string trajectory;      ///< Build: a .dcd or .xtc with the frames; empty: models are
    bool warm = false;           ///< Build: a frame begins at the surface of the one before
    int frame = 0;               ///< Build: the number of the one that is built; 0: none is
    std::string folder;          ///< Batch: where the files go
    std::vector<Output> outputs; ///< Build: at least one; Batch: extensions in the place of paths
    std::vector<std::string> files; ///< Info: at least one; Compare: two
    Options options;                ///< Build, Compare
    DrawOptions picture;            ///< Build
    bool legend = true;             ///< Build: beside pictures that have colours
    Scene scene;                    ///< Build: of the .vdb and the node of the .glb
    bool center = false;            ///< Build: the middle of the surface comes to the origin
    double printScale = 0.0;        ///< Build: of .stl and .obj [mm/Å]; 0: they are in Å
    bool colorBySign = false;       ///< Compare: by the signed distance
    double colorRange = 0.0;        ///< Compare: distance at the end of the colours [Å]; 0: choose
    std::vector<std::string> given; ///< Compare: options that are for structures only; Batch: one
                                    ///< line, all that the surfaces depend on; Plan: the words
                                    ///< that make the options
    std::vector<std::string> read;  ///< Plan: files that the options were read from
    std::size_t bricks = 0;         ///< Plan: how many; 0: by `memory`. Brick: the number of one
    std::size_t memory = 0;         ///< Plan, Build: bytes at most; 0: no limit
    bool dryRun = false;            ///< Build: only say what it takes
    int threads = 0;                ///< 0: as many as there are
    bool force = false;
    bool quiet = false;
    bool verbose = false;
    bool progress = true;
    std::vector<std::string> warnings; ///< one line each
};

/// @throws Error(ErrorKind::Usage) if the call is wrong
/// @throws Error(ErrorKind::Input) if the file of --config cannot be read
Call parseCall(int argc, const char* const* argv);

/// The text of --help.
std::string helpText();

/// The text of `batch --help`.
std::string batchHelpText();

/// The text of `compare --help`.
std::string compareHelpText();

/// The text of `mesh --help`, or of `color --help`.
std::string storedHelpText(Verb verb);

/// One line of the table of options.
struct OptionText {
    std::string group;  ///< title
    std::string name;   ///< "output"
    std::string letter; ///< "o", or empty
    std::string value;  ///< "FILE"; empty for a switch
    std::string text;   ///< what --help says of it
    std::string preset; ///< default; empty: none
};

/// All options of Build, Batch, Compare, Mesh or Color, in the order of their help.
std::vector<OptionText> optionTexts(Verb verb);

/// The text of `info --help`.
std::string infoHelpText();

/// The texts of `plan --help`, `brick --help` and `merge --help`.
std::string planHelpText();
std::string brickHelpText();
std::string mergeHelpText();

/// The words the options use for these values.
const char* nameOf(Regularizer regularizer);
const char* nameOf(Flow flow);

} // namespace molsurf::tool
