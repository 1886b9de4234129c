// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// All bricks of a plan as one surface.

#include "molsurf/bricks.h"
#include "molsurf/options.h"
#include "molsurf/progress.h"
#include "molsurf/report.h"
#include "molsurf/scale/bricks/brick_file.h"
#include "molsurf/scale/bricks/merge_mesh.h"
#include "molsurf/show/io/output_file.h"

#include <openvdb/openvdb.h>

#include <string>
#include <vector>

namespace molsurf
{

/// The surface that the bricks make up. Holds neither its level set nor its mesh.
class MergedBricks
{
public:
    /// @param[in] paths    of all bricks of a plan, in their order
    /// @param[in] id       the name that they were written with
    /// @param[in] meshed   whether they have to hold vertices and triangles
    /// @throws Error(ErrorKind::Input) if a brick is missing, belongs to another plan, or cannot be
    ///         what a brick of this one is
    /// @throws Error(ErrorKind::Numeric) if there is no surface in them
    MergedBricks(const std::vector<std::string>& paths, const std::string& id,
                 const BrickPlan& plan, const SurfaceOptions& options, bool meshed);

    /// The report of the surface: all but who made it, and of what.
    const Report& report() const { return report_; }

    /// Writes the grids as one OpenVDB file.
    /// @param[in] metadata  of the file as a whole
    void writeVdb(const openvdb::MetaMap& metadata, OutputFile& file,
                  const Progress& progress) const;

    /// Writes the mesh as one .ply file.
    void writePly(OutputFile& file, const Progress& progress) const;

private:
    std::vector<BrickFile> bricks_;
    MergedMesh mesh_;
    Report report_;
};

} // namespace molsurf
