// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Trajectories in the XTC format of GROMACS.

#include "molsurf/molecule/structure/trajectory.h"

namespace molsurf
{

/// An .xtc file, read frame by frame: numbers of XDR (the most significant byte first) and
/// coordinates in nanometres, rounded to 1 / precision and packed by van Hoesel's scheme. What the
/// scheme is, is told in the source.
class XtcFile : public Trajectory
{
public:
    /// Whether a file begins as this format does; false if it cannot be read.
    static bool recognizes(const std::string& path);

    /// Finds the frames.
    /// @throws Error(ErrorKind::Input) if the file cannot be opened or is no such file, if it ends
    ///         within a frame, or if its frames have different numbers of atoms
    explicit XtcFile(const std::string& path);

    std::size_t frames() const override { return begins_.size(); }

protected:
    std::vector<openvdb::Vec3f> load(std::size_t frame) override;

private:
    std::uint32_t word();
    std::uint64_t startFrame(std::size_t frame); ///< its end in the file, or 0 if it is cut short

    std::vector<std::uint64_t> begins_; ///< of each frame [byte]
    bool wide_ = false;                 ///< of the frame that was started: a length of 8 bytes
};

} // namespace molsurf
