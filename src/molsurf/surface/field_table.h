// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The grids beside `surface`, a row each: words, estimates, refusals and the grids come from it.

#include "molsurf/kernel/pipeline/derived_grids.h"
#include "molsurf/show/color/label.h"
#include "molsurf/show/color/value_colors.h"
#include "molsurf/surface.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace molsurf
{

/// Sources of the grids of balls. A source that several of them need is computed once, when the
/// first asks for it.
struct FieldSource {
    const BallSet& atoms;
    const SurfaceOptions& options;
    const MolecularSurface& result;       ///< with a level set
    const std::vector<Color>* ballColors; ///< null: colours are none, or those of vertices
    double reach; ///< farthest that a point of the band may lie from the balls [Å]
    const Progress& progress;
    /// Of voxels in the order of their tree: of the band, and of all that have colours.
    struct Voxels {
        openvdb::BoolGrid::Ptr grid{};
        std::optional<Labels> owners{};
    };
    std::array<Voxels, 2> found{};

    /// The voxels of the band, or those that have colours: where there is fog all of the inside.
    const openvdb::BoolGrid& voxels(bool colored) { return *of(colored).grid; }

    /// The ball of each such voxel.
    const Labels& owners(bool colored);

private:
    Voxels& of(bool colored);
};

/// A grid beside `surface`. `ofBalls` makes it; without that SurfaceRun::fields(), a product or the
/// caller of makeSurface() does.
struct FieldRow {
    std::string name;       ///< of the command line and of the grid
    int values = 1;         ///< numbers of a voxel
    unsigned missingIn = 0; ///< ways to a surface that cannot give it, of Way
    const char* help = "";  ///< what a help text says of it
    /// Another request that it needs, with a hint, and whether that is given.
    const char* needs = nullptr;
    bool (*given)(const SurfaceOptions& options) = nullptr;
    bool needsLabels = false; ///< whether the balls need labels for it
    bool atVertices = false;  ///< whether meshes have it, too
    bool inTables = false;    ///< whether tables of areas have it, too
    bool ofColors = false;    ///< whether it is of what SurfaceOptions::color shows
    openvdb::GridBase::Ptr (*ofBalls)(FieldSource& from) = nullptr; ///< null: it has nothing
};

/// All of them, in the order of files.
const std::vector<FieldRow>& fieldTable();

/// The row of a name, or null.
const FieldRow* findField(const std::string& name);

/// The names of those that need nothing else to be asked for, and no work beside the surface.
std::vector<std::string> fieldNames();

} // namespace molsurf
