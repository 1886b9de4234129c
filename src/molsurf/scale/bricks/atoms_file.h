// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The atoms of a plan on disk, sorted by place: a brick reads its own and those around it.

#include "molsurf/atoms.h"
#include "molsurf/kernel/core/file_descriptor.h"
#include "molsurf/kernel/levelset/gaussian_sum.h"
#include "molsurf/show/io/output_file.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace molsurf
{

/// Some atoms of the file: those of a part in one cube of space.
struct AtomCell {
    std::uint32_t part;                ///< 0 where no copies repeat parts
    std::array<std::int32_t, 3> place; ///< of the cube, in its edges
    std::uint32_t count;               ///< atoms in it, which follow those of the cell before
    std::uint32_t checksum;            ///< CRC-32 of their records
};

/// Writes balls with all that bricks use of them: labels, colours, values and resolutions, but no
/// names. Those of a folded set are written once, with the motions that make the whole.
/// @param[in] extent  of the Gaussians of all of them
/// @return the index of the file: the cells and what all balls share. It identifies the content
std::string writeAtoms(const BallSet& atoms, const GaussianExtent& extent, OutputFile& file,
                       const Progress& progress);

struct StoredMap;

/// The atoms of a plan. Nothing is read but the index, until balls are asked for.
class AtomsFile
{
public:
    /// @throws Error(ErrorKind::Input) if it cannot be read, is damaged, or holds no atoms
    explicit AtomsFile(const std::string& path);

    /// As writeAtoms() gave it.
    const std::string& index() const { return index_; }

    const GaussianExtent& extent() const { return extent_; }

    /// The balls in a box, as ballsIn() gives those of the whole but for their order.
    /// @param[in] space  [Å]
    /// @throws Error(ErrorKind::Input) if the records are damaged, or more atoms than memory holds
    BallSet within(const openvdb::BBoxd& space) const;

private:
    [[noreturn]] void refuse(const std::string& what) const;
    void readIndex(std::uint64_t size);
    void readMap(const StoredMap& stored, std::uint64_t at, std::uint64_t bytes);
    std::vector<const Motion*> motionsInto(const openvdb::BBoxd& space, const AtomCell& cell) const;
    void readCell(const AtomCell& cell, std::uint64_t at, const openvdb::BBoxd& space,
                  const std::vector<const Motion*>& motions, BallSet& out) const;

    std::string path_, index_;
    FileDescriptor file_;
    std::vector<AtomCell> cells_;
    std::vector<std::vector<Motion>> motions_; ///< of each part
    GaussianExtent extent_;
    BallSet shared_; ///< no balls, but one entry of all that each has
};

} // namespace molsurf
