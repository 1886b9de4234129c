// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Trajectories in the DCD format of CHARMM, X-PLOR and NAMD.

#include <openvdb/Types.h>

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace molsurf
{

/// A .dcd file, read frame by frame. Of either byte order, with or without unit cells, fixed atoms
/// and a fourth dimension (which is passed over); record markers of 4 bytes.
class DcdFile
{
public:
    /// Reads the header.
    /// @throws Error(ErrorKind::Input) if the file cannot be opened or is no such file, or if it is
    ///         cut short: it ends within a frame, or holds fewer than its header says
    explicit DcdFile(const std::string& path);

    std::size_t atoms() const { return atoms_; }
    std::size_t frames() const { return frames_; }

    /// The coordinates of all atoms in a frame [Å].
    /// @param[in] frame  from 0, below frames()
    /// @throws Error(ErrorKind::Input) if it cannot be read
    std::vector<openvdb::Vec3f> read(std::size_t frame);

private:
    [[noreturn]] void fail(const std::string& message) const;
    std::uint32_t word(const char* bytes) const;
    std::vector<char> record(); ///< the content of the record that comes next
    std::uint64_t frameSize(bool first) const;
    std::vector<float> axis(std::size_t count);
    void readHeader();

    std::string path_;
    std::ifstream file_;
    bool swapped_ = false, cell_ = false, fourth_ = false;
    std::size_t atoms_ = 0, frames_ = 0;
    std::vector<std::size_t> free_; ///< atoms that move; empty: all
    std::uint64_t begin_ = 0, size_ = 0;
};

} // namespace molsurf
