// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Trajectories: files with the coordinates of the same atoms in many frames.

#include <openvdb/Types.h>

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace molsurf
{

/// A trajectory, read frame by frame.
class Trajectory
{
public:
    virtual ~Trajectory() = default;
    Trajectory(const Trajectory&) = delete;
    Trajectory& operator=(const Trajectory&) = delete;

    std::size_t atoms() const { return atoms_; }
    virtual std::size_t frames() const = 0;

    /// One line on what is odd about the file; empty if nothing is.
    const std::string& warning() const { return warning_; }

    /// The coordinates of all atoms in a frame [Å].
    /// @param[in] frame  from 0, below frames()
    /// @throws Error(ErrorKind::Input) if it cannot be read, or if a coordinate is no number or
    ///         beyond 1e6 Å
    std::vector<openvdb::Vec3f> read(std::size_t frame);

protected:
    /// Opens the file.
    /// @throws Error(ErrorKind::Input) if that cannot be
    explicit Trajectory(const std::string& path);

    /// @throws Error(ErrorKind::Input) with the name of the file and the message
    [[noreturn]] void fail(const std::string& message) const;

    /// Reads a frame; read() then checks its positions.
    virtual std::vector<openvdb::Vec3f> load(std::size_t frame) = 0;

    std::ifstream file_;
    std::uint64_t size_ = 0; ///< of the file [byte]
    std::size_t atoms_ = 0;
    std::string warning_;

private:
    std::string path_;
};

/// Opens a trajectory in the DCD format of CHARMM, X-PLOR and NAMD.
/// @throws Error(ErrorKind::Input) if the file cannot be opened or is no such file, or if it ends
///         within a frame. That it holds fewer than its header says is a warning.
std::unique_ptr<Trajectory> openDcd(const std::string& path);

/// Opens a trajectory in the TRR format of GROMACS.
/// @throws Error(ErrorKind::Input) as openDcd(); a last frame that is cut short is a warning
std::unique_ptr<Trajectory> openTrr(const std::string& path);

/// Opens a trajectory in the NetCDF format of Amber, or a restart file, which has one frame.
/// @throws Error(ErrorKind::Input) as openDcd()
std::unique_ptr<Trajectory> openNetcdf(const std::string& path);

/// Opens a trajectory by what the file begins with, not by its name.
/// @throws Error(ErrorKind::Input) if the file cannot be opened, is of no known kind or is cut
/// short
std::unique_ptr<Trajectory> openTrajectory(const std::string& path);

} // namespace molsurf
