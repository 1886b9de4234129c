// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Atoms in, molecular surface out.

#include "molsurf/atoms.h"
#include "molsurf/mesh.h"
#include "molsurf/options.h"
#include "molsurf/progress.h"
#include "molsurf/report.h"

#include <openvdb/openvdb.h>

#include <memory>
#include <vector>

namespace molsurf
{

/// The surface of a molecule.
struct MolecularSurface {
    openvdb::FloatGrid::Ptr surface; ///< signed distance to the molecular surface [Å]; null with
                                     ///< parts, whose surfaces are among the fields
    std::vector<openvdb::GridBase::Ptr> fields; ///< the grids that SurfaceOptions::fields asked for
    Mesh mesh;
    Report report; ///< program, command, input and the like are left to the caller
};

/// What the flow of one frame of a trajectory leaves for the next: how far the surface at rest lies
/// from the one that it began at.
class WarmStart
{
public:
    struct State;
    WarmStart();
    ~WarmStart();
    WarmStart(WarmStart&& other) noexcept;
    WarmStart& operator=(WarmStart&& other) noexcept;

    /// Whether there is nothing to begin with.
    bool empty() const { return !state; }

    std::unique_ptr<State> state; ///< private to the library
};

/// Builds the surface of atoms, with what is known of them: resolutions, groups, colours.
///
/// @param[in]     balls     at least one, finite
/// @param[in]     options   in their ranges, see checkOptions()
/// @param[in]     progress  null, or what is told of the progress and may end the run
/// @param[in,out] warm      null, or what a run with nearly the same balls and the same options
///                          left, or empty: the flow begins nearer to its rest. Afterwards that of
///                          this run; left alone by surfaces of parts and those that do not flow.
/// @throws Error(ErrorKind::Usage) for an option out of its range
/// @throws Error(ErrorKind::Input) that names the first ball at fault by its index
/// @throws Error(ErrorKind::Numeric) if there is no surface at this resolution
/// @throws Error(ErrorKind::Check) if the result contradicts itself
/// @throws Cancelled if the progress object says so
MolecularSurface makeSurface(const BallSet& balls, const SurfaceOptions& options = {},
                             Progress* progress = nullptr, WarmStart* warm = nullptr);

/// The same of balls of which nothing else is known.
MolecularSurface makeSurface(const std::vector<Ball>& balls, const SurfaceOptions& options = {},
                             Progress* progress = nullptr);

} // namespace molsurf
