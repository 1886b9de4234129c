// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Trajectories in the DCD format of CHARMM, X-PLOR and NAMD.

#include "molsurf/structure/trajectory.h"

namespace molsurf
{

/// A .dcd file, read frame by frame. Of either byte order, with or without unit cells, fixed atoms
/// and a fourth dimension (which is passed over); record markers of 4 bytes.
class DcdFile : public Trajectory
{
public:
    /// Reads the header.
    /// @throws Error(ErrorKind::Input) if the file cannot be opened or is no such file, or if it
    ///         ends within a frame. That it holds fewer than its header says is a warning.
    explicit DcdFile(const std::string& path);

    std::size_t frames() const override { return frames_; }

protected:
    std::vector<openvdb::Vec3f> load(std::size_t frame) override;

private:
    std::uint32_t word(const char* bytes) const;
    std::vector<char> record(); ///< the content of the record that comes next
    std::uint64_t frameSize(bool first) const;
    std::vector<float> axis(std::size_t count);
    void readHeader();

    bool swapped_ = false, cell_ = false, fourth_ = false;
    std::size_t frames_ = 0;
    std::vector<std::size_t> free_; ///< atoms that move; empty: all
    std::uint64_t begin_ = 0;
};

} // namespace molsurf
