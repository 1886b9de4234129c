// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Products beside the level set and its mesh, a row each: who can give it, what it needs, how it
/// is made. makeSurface() is a loop over these rows; grids have rows of their own (field_table.h).

#include "molsurf/surface.h"
#include "molsurf/surface/product_cost.h"

#include <string>
#include <vector>

namespace molsurf
{

/// Ways to a surface that cannot give everything. Their bits make sets.
enum Way : unsigned {
    InBricks = 1,     ///< part of space by part
    BySymmetry = 2,   ///< from one unit, which rotations repeat
    InClosedForm = 4, ///< without voxels
    ByAtom = 8,       ///< with areas of atoms
    WithoutMesh = 16  ///< a level set alone
};

/// A run whose level set, mesh and measures are made, and whose products follow.
struct MadeRun {
    const BallSet& atoms;
    const SurfaceOptions& options;
    SurfaceSpec areasOf;           ///< the surface that areas are of
    std::vector<double> ballAreas; ///< on the surface of `options` [Å^2]; empty: not known
    Progress& progress;
    MolecularSurface& result;
};

/// A product.
struct ProductRow {
    const char* name;   ///< the option that asks for it, as messages name it
    unsigned missingIn; ///< ways to a surface that cannot give it, of Way
    bool (*asked)(const BallSet& atoms, const SurfaceOptions& options);
    /// Checks that the atoms have what an asked product needs. Null: nothing.
    /// @throws Error that names what they lack
    void (*check)(const BallSet& atoms, const SurfaceOptions& options) = nullptr;
    void (*make)(MadeRun& run) = nullptr; ///< null: the stages make it
    /// What it takes on top of a surface. Null: nothing to speak of, or the estimate of the surface
    /// has it.
    Cost (*cost)(const BallSet& atoms, const SurfaceOptions& options,
                 const SurfaceSize& size) = nullptr;
};

/// All of them, in the order in which they are made.
const std::vector<ProductRow>& productTable();

/// A number of the whole surface that `measures` asks for, in the report.
struct MeasureRow {
    const char* name; ///< of the option's word and of the key of the report
    const char* unit; ///< "" of a ratio
    const char* help; ///< what a help text says of it
    unsigned missingIn;
    double (*of)(const MolecularSurface& surface, const Progress& progress);
};

/// All of them, in the order of the report.
const std::vector<MeasureRow>& measureTable();

/// The request of the options that a way cannot give, in backticks; "": it gives all.
/// @param[in] atoms  for what only they ask for
std::string missingIn(Way way, const SurfaceOptions& options, const BallSet& atoms = {});

/// Tells whether SurfaceOptions::grid may be false: area, volume and pieces of the surface, and the
/// areas of its balls, are known in closed form, and nothing is asked for that needs voxels.
bool hasClosedForm(const SurfaceOptions& options);

/// What the stages have to make: what the options say that readers of the result need, and what
/// their products are made of.
Needs needsOf(const BallSet& atoms, const SurfaceOptions& options);

/// Checks that a way gives all of what the options ask for.
/// @throws Error(ErrorKind::Usage) that names the first thing that it does not
void checkWay(Way way, const SurfaceOptions& options);

/// Checks that atoms have what the products that are asked for need.
/// @throws Error that names what they lack
void checkProducts(const BallSet& atoms, const SurfaceOptions& options);

/// Makes the products that are asked for and that the stages do not make.
/// @param[in,out] result  of the stages, with what they know of areas of balls
void makeProducts(const BallSet& atoms, const SurfaceOptions& options, Progress& progress,
                  MolecularSurface& result);

} // namespace molsurf
