// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The user's request as values.

#include "require.h"

#include "molsurf/analysis/measures/area_tables.h"
#include "molsurf/settings.h"
#include "molsurf/show/io/file_content.h"
#include "molsurf/show/io/frame_files.h"
#include "molsurf/show/picture/atom_model.h"
#include "molsurf/surface/field_table.h"
#include "molsurf/surface/file_settings.h"
#include "molsurf/surface/picture_settings.h"

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace molsurf
{
class OutputFile;
struct Anchors;
} // namespace molsurf

namespace molsurf::tool
{
class Film;
struct PanelSurface;
} // namespace molsurf::tool

namespace molsurf::tool
{

// The formats of output files, a row each: the words of the command line, its help, what a verb
// writes, what a file cannot show, and the writers come from it.

using namespace holds;

/// Source of a file, and how it is written.
struct Writing;

/// A format.
struct Format {
    const char* word;  ///< how a file's name ends, without the first dot: "ply", "atoms.csv"
    unsigned verbs;    ///< that write it
    unsigned holds;    ///< of holds::Content
    const char* help;  ///< what a file is, for help texts; of two in turn with the same said once;
                       ///< "": an option that asks for it says it
    const char* table; ///< the table of areas that it has, one of areaTables(); "" if none
    void (*write)(const Writing& what, OutputFile& file); ///< null: a verb does so by itself
    const char* opens = ""; ///< of a Script: the format of the file that it opens
};

/// All of them, in the order of help texts.
const std::vector<Format>& formatTable();

/// The files of a verb, for the help text of --output.
std::string filesOf(unsigned verb);

/// The format of a word, or null.
const Format* findFormat(const std::string& word);

/// ".vdb, .ply and .json": the formats that hold one of some things and that some verbs write.
std::string endingsOf(unsigned holds, unsigned verbs, const char* last = " and ");

/// The things that the program does. Their bits make sets.
enum Verb : unsigned {
    Build = 1,
    Batch = 2,
    Compare = 4,
    Convert = 8,
    Info = 16,
    BricksPlan = 32,
    BricksRun = 64,
    BricksMerge = 128
};

/// One file to write.
struct Output {
    std::string path; ///< "-" is standard output
    const Format* format;
    std::string beside{};         ///< of a Stage: the .vdb that it shows, or the .usda of a frame
    std::size_t pocket = 0;       ///< of a Numbered one: which, from 1
    double turn = 0.0;            ///< of a picture of a turntable, beside that of all [degree]
    std::shared_ptr<Film> film{}; ///< of all frames, which gets a picture of each; null: none

    /// Whether it holds one of these.
    bool holds(unsigned some) const { return (format->holds & some) != 0; }
};

/// A further picture beside the first one.
struct Panel {
    std::string file{};                ///< of another structure; empty: it is of the same
    openvdb::Vec3d toEye{0.0};         ///< from there
    std::optional<SurfaceKind> kind{}; ///< or of that kind

    bool hasSurface() const { return !file.empty() || kind; }
};

/// The values of the options that were given, by name; in the order of the command line if one was
/// given more than once.
using GivenOptions = std::map<std::string, std::vector<std::string>>;

/// A command line. The settings and the first part are set by options, see optionTable(), the
/// second part is made of them.
struct CommandLine : Settings, PictureSettings, FileSettings {
    Verb verb = Build;
    std::string command;             ///< the command line as typed, quoted for a shell
    std::vector<std::string> inputs; ///< the words that are no options
    GivenOptions given;

    std::vector<std::string> paths;       ///< of --output
    std::string format;                   ///< of standard output; empty: none
    std::string folder;                   ///< Batch: where the files go
    std::string formats = "vdb,ply,json"; ///< Batch: of every structure
    bool force = false;
    bool skipExisting = false; ///< Build: nothing is done where it was done before
    std::string frames;        ///< of --frames; empty: none
    std::string superpose;     ///< atoms that lay B on A, panels on the first structure, frames
                               ///< on the first one: "auto" or a selection; empty: nothing moves
    bool updateSelections = false; ///< whether selections by distance are those of each frame
    std::optional<double> iso;     ///< value of a map at which convert makes a level set
    std::string trajectory;        ///< the file with the frames; empty: models are
    double fps = 0.0;              ///< frames per second; 0: times are in frames
    int firstFrame = 1;            ///< number of the first file of frames
    std::string groupsFile;
    std::vector<double> lod; ///< voxels of levels of detail [Å], the finest first; empty: one
    std::optional<ApbsGrid> apbsGrid{}; ///< known when the atoms are
    std::vector<std::string> areas;     ///< tables of areas in the report: "atoms", "residues", ...
    ContactLevel contacts = ContactLevel::Residue; ///< of tables of contacts
    bool weld = false;                             ///< units of a whole share their vertices
    double wall = 0.0;                             ///< least thickness of a print [mm]; 0: none
    std::string viewed;           ///< atoms that face the eye, a selection; empty: none
    std::vector<ShowRule> shows;  ///< atoms that pictures show beside the surface
    std::size_t shownPockets = 0; ///< how many bodies of pockets pictures and pages show at most,
                                  ///< the largest ones

    bool showsPockets() const { return shownPockets > 0; }
    std::vector<NoteText> notes; ///< labels and rulers of pictures
    std::vector<Panel> panels;   ///< of pictures, beside the first one
    int turntable = 0;           ///< number of pictures; 0: one
    bool colorBySign = false;    ///< Compare: by the signed distance
    double colorRange = 0.0;     ///< Compare: distance at the end of the colours [Å]; 0: choose
    int bricks = 0;              ///< BricksPlan: how many; 0: by `memory`
    std::size_t memory = 0;      ///< bytes at most; 0: no limit
    double hours = 24.0;         ///< that a surface may take, by the estimate
    bool dryRun = false;         ///< only say what it takes
    std::vector<Requirement> required; ///< of the mesh, or nothing is written
    int threads = 0;                   ///< 0: as many as there are
    bool quiet = false;
    bool verbose = false;
    bool progress = true;
    std::string config;

    std::string input;                      ///< the first of `inputs`
    std::string inputSha256, identity;      ///< as tools/identity.h has them; empty: not known yet
    std::size_t brick = 0;                  ///< BricksRun: its number, from 1
    std::vector<Output> outputs;            ///< Batch: extensions in the place of paths
    std::shared_ptr<const Anchors> anchors; ///< of the first structure, for `superpose`
    /// Of `panels` that have one, once they are made.
    std::shared_ptr<std::vector<PanelSurface>> panelSurfaces;
    int frame = 0;                     ///< the number of the one that is built; 0: none is
    std::vector<std::string> warnings; ///< one line each
    /// Of the files in the folders of frames.
    std::shared_ptr<FrameOptions> frameOptions = std::make_shared<FrameOptions>();

    bool has(const char* option) const { return given.count(option) > 0; }

    /// Whether one of the files holds one of these.
    bool writes(unsigned some) const;

    /// Whether there are files, and each holds one of these.
    bool writesOnly(unsigned some) const;

    /// Whether one of the surfaces is of such a kind, or the grid `sas` is.
    template<typename Such>
    bool builds(const Such& such) const
    {
        bool any = such(options.kind) ||
                   (hasField(options.fields, "sas") && such(SurfaceKind::SolventAccessible));
        for (const auto& [group, kind] : options.surfaceOf) any = any || such(kind);
        for (const Panel& panel : panels) any = any || (panel.kind && such(*panel.kind));
        return any;
    }

    /// Whether copies of an assembly, which nodes place, have colours.
    bool colorsCopies() const
    {
        return colorGroups && colorGroups->kind == GroupBy::Kind::Copy && atoms.assembly.repeats();
    }
};

} // namespace molsurf::tool
