// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The mesh of the whole from the bricks' parts, welded vertex on vertex, without holding it.

#include "molsurf/report.h"
#include "molsurf/scale/bricks/brick_file.h"
#include "molsurf/show/io/output_file.h"

#include <cstdint>
#include <vector>

namespace molsurf
{

/// Where the vertices of each brick stand in the mesh of the whole: those that brick 1 owns, those
/// that brick 2 owns, ... Holds the vertices at the bricks' borders only.
class MergedMesh
{
public:
    /// @param[in] bricks  all of a plan, in their order; they must outlive it
    /// @throws Error(ErrorKind::Input) if a vertex of a brick is missing in the one that owns it,
    ///         or if the triangles of a brick, where it has them, are not what it says of them:
    ///         closed but for the open edges at its border, in so many pieces, at every vertex
    explicit MergedMesh(const std::vector<BrickFile>& bricks);

    std::size_t vertices() const { return firsts_.back(); }
    std::size_t triangles() const { return triangles_; }

    /// Writes binary PLY as writePly() does.
    /// @throws Error(ErrorKind::Output) if there are more vertices than its indices can count
    void writePly(OutputFile& file, const Progress& progress) const;

    /// Everything that SurfaceReport says of the whole. A mesh whose bricks do not fit along an
    /// edge counts as not closed.
    /// @throws Error(ErrorKind::Input) if it is closed and its numbers contradict each other
    SurfaceReport report() const;

private:
    void checkTriangles(std::size_t brick) const;
    std::uint64_t indexOf(std::size_t brick, std::uint32_t vertex) const;
    /// Whether the triangles of bricks pair up along their borders: closed and manifold are false
    /// where they do not.
    void pairBorders(SurfaceReport& report) const;

    const std::vector<BrickFile>& bricks_;
    std::vector<std::uint64_t> firsts_; // of each brick's vertices, and the end
    std::size_t triangles_ = 0;
    std::vector<std::vector<std::uint64_t>> foreign_; // vertices behind the owned ones
    std::vector<std::vector<BorderVertex>> border_;
};

} // namespace molsurf
