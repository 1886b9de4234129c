// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The user's request as values.

#include "require.h"

#include "molsurf/request/format_table.h"
#include "molsurf/request/request.h"
#include "molsurf/surface/field_table.h"

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace molsurf
{
struct Anchors;
} // namespace molsurf

namespace molsurf::tool
{

using namespace holds;

/// The values of the options that were given, by name; in the order of the command line if one was
/// given more than once.
using GivenOptions = std::map<std::string, std::vector<std::string>>;

/// A command line. The settings and the first part are set by options, see optionTable(), the
/// second part is made of them.
struct CommandLine : Request {
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
    int firstFrame = 1;            ///< number of the first file of frames
    std::string groupsFile;
    std::vector<double> lod; ///< voxels of levels of detail [Å], the finest first; empty: one
    std::vector<std::string> areas; ///< tables of areas in the report: "atoms", "residues", ...
    double wall = 0.0;              ///< least thickness of a print [mm]; 0: none
    std::string viewed;             ///< atoms that face the eye, a selection; empty: none
    std::string zoomed;             ///< atoms that fill the frame, a selection; empty: none
    std::vector<ShowRule> shows;    ///< atoms that pictures show beside the surface
    std::size_t shownPockets = 0;   ///< how many bodies of pockets pictures and pages show at most,
                                    ///< the largest ones

    bool showsPockets() const { return shownPockets > 0; }
    std::vector<NoteText> notes; ///< labels and rulers of pictures
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

    std::string inputSha256, identity;      ///< as tools/identity.h has them; empty: not known yet
    std::size_t brick = 0;                  ///< BricksRun: its number, from 1
    std::shared_ptr<const Anchors> anchors; ///< of the first structure, for `superpose`
    std::vector<std::string> warnings;      ///< one line each

    bool has(const char* option) const { return given.count(option) > 0; }
};

} // namespace molsurf::tool
