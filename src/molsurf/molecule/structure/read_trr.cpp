// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/trajectory.h"

#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/structure/byte_order.h"

#include <array>

namespace molsurf
{

namespace
{

constexpr std::uint32_t trrMark = 1993;

/// A .trr file of GROMACS: numbers of XDR (the most significant byte first), coordinates in
/// nanometres, in single or double precision. Frames without coordinates are passed over.
class TrrFile : public Trajectory
{
public:
    explicit TrrFile(const std::string& path) : Trajectory(path)
    {
        for (std::uint64_t at = 0; at < size_;) {
            const std::uint64_t end = addFrame(at);
            if (end > size_) {
                if (frames_.empty()) fail("cut short");
                warning_ =
                    formatted("the last frame is cut short: %zu frames are whole", frames_.size());
                break;
            }
            at = end;
        }
        if (frames_.empty()) fail("expected frames with coordinates, got none");
    }

    std::size_t frames() const override { return frames_.size(); }

protected:
    std::vector<openvdb::Vec3f> load(std::size_t frame) override
    {
        const auto& [begin, width] = frames_[frame];
        file_.clear();
        file_.seekg(std::streamoff(begin));
        std::vector<char> bytes(3 * atoms_ * width);
        if (!file_.read(bytes.data(), std::streamsize(bytes.size()))) fail("cut short");
        std::vector<openvdb::Vec3f> out(atoms_);
        for (std::size_t i = 0; i < 3 * atoms_; ++i)
            out[i / 3][int(i % 3)] = float(10.0 * realAt(&bytes[i * width], width, ByteOrder::Big));
        return out;
    }

private:
    struct Frame {
        std::uint64_t begin; ///< of the coordinates [byte]
        std::size_t width;   ///< of a number [byte]
    };

    /// The blocks of a frame, in the order in which the header gives their sizes [byte].
    enum Part {
        Input,
        Energy,
        Cell,
        Virial,
        Pressure,
        Topology,
        Symbols,
        Positions,
        Velocities,
        Forces,
        Parts
    };

    std::uint32_t word()
    {
        char bytes[4] = {};
        file_.read(bytes, sizeof bytes);
        return std::uint32_t(unsignedAt(bytes, sizeof bytes, ByteOrder::Big));
    }

    /// Reads the header of a frame, and lists it if it has coordinates.
    /// @return its end in the file, which may be cut short [byte]
    std::uint64_t addFrame(std::uint64_t at)
    {
        file_.clear();
        file_.seekg(std::streamoff(at));
        if (word() != trrMark) fail("expected a frame of TRR at byte " + std::to_string(at));
        word(); // the length of the version, and a byte
        file_.seekg((word() + 3) / 4 * 4, std::ios::cur);
        std::array<std::uint64_t, Parts> sizes{};
        for (std::uint64_t& size : sizes) size = word();
        const std::size_t atoms = word();
        word(); // the step
        word(); // of the energy
        if (!file_) return size_ + 1;
        std::size_t width = sizes[Cell] / 9;
        for (const Part part : {Positions, Velocities, Forces})
            if (width == 0 && atoms > 0) width = sizes[part] / (3 * atoms);
        if (width != 4 && width != 8)
            fail("expected a frame of TRR with numbers of 4 or 8 bytes, got " +
                 std::to_string(width) + " [hint: gmx trjconv writes FILE.xtc]");
        if (sizes[Positions] != 0 && sizes[Positions] != 3 * atoms * width)
            fail(formatted("expected coordinates of %zu atoms, got %llu bytes", atoms,
                           static_cast<unsigned long long>(sizes[Positions])));
        std::uint64_t end = std::uint64_t(file_.tellg()) + 2 * width; // the time and lambda
        for (const Part part : {Input, Energy, Cell, Virial, Pressure, Topology, Symbols})
            end += sizes[part];
        const Frame frame{end, width};
        for (const Part part : {Positions, Velocities, Forces}) end += sizes[part];
        if (sizes[Positions] == 0 || end > size_) return end;
        if (!frames_.empty() && atoms != atoms_)
            fail(formatted("frame %zu has %zu atoms, the first one %zu", frames_.size() + 1, atoms,
                           atoms_));
        atoms_ = atoms;
        frames_.push_back(frame);
        return end;
    }

    std::vector<Frame> frames_;
};

} // namespace

std::unique_ptr<Trajectory> openTrr(const std::string& path)
{
    return std::make_unique<TrrFile>(path);
}

} // namespace molsurf
