// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/trajectory.h"

#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/structure/byte_order.h"

#include <cstring>

namespace molsurf
{

namespace
{

constexpr std::size_t dcdHeaderSize = 84;         // "CORD" and 20 words
constexpr std::uint32_t largestRecord = 1u << 30; // of a record [byte]

/// A .dcd file, read frame by frame. Of either byte order, with or without unit cells, fixed atoms
/// and a fourth dimension (which is passed over); record markers of 4 or 8 bytes, as Fortran's
/// compilers write them.
class DcdFile : public Trajectory
{
public:
    explicit DcdFile(const std::string& path) : Trajectory(path) { readHeader(); }

    std::size_t frames() const override { return frames_; }

protected:
    std::vector<openvdb::Vec3f> load(std::size_t frame) override
    {
        std::vector<openvdb::Vec3f> out;
        if (frame > 0 && !free_.empty()) out = load(0); // where the fixed atoms are
        file_.clear();
        file_.seekg(std::streamoff(
            begin_ + (frame > 0 ? frameSize(true) + (frame - 1) * frameSize(false) : 0)));
        if (cell_) record();
        const bool all = frame == 0 || free_.empty();
        out.resize(atoms_);
        for (int a = 0; a < 3; ++a) {
            const std::vector<float> values = axis(all ? atoms_ : free_.size());
            for (std::size_t i = 0; i < values.size(); ++i) out[all ? i : free_[i]][a] = values[i];
        }
        return out;
    }

private:
    std::uint32_t word(const char* bytes) const
    {
        return std::uint32_t(unsignedAt(bytes, 4, order_));
    }

    /// The marker of a record that comes next: its length.
    std::uint64_t mark()
    {
        char bytes[8] = {};
        if (!file_.read(bytes, mark_)) fail("cut short");
        return unsignedAt(bytes, std::size_t(mark_), order_);
    }

    /// The content of the record that comes next.
    std::vector<char> record()
    {
        const std::uint64_t size = mark();
        if (size > largestRecord)
            fail("expected a record of DCD, got one of " + std::to_string(size) + " bytes");
        if (size > size_ - std::uint64_t(file_.tellg())) fail("cut short");
        std::vector<char> content(size);
        if (!file_.read(content.data(), std::streamsize(size))) fail("cut short");
        if (mark() != size) fail("a record of DCD ends with another length than it begins with");
        return content;
    }

    void readHeader()
    {
        char first[12] = {};
        file_.read(first, sizeof first);
        const bool narrow = file_ && std::memcmp(first + 4, "CORD", 4) == 0;
        const bool wide = file_ && std::memcmp(first + 8, "CORD", 4) == 0;
        mark_ = wide && !narrow ? 8 : 4;
        order_ = first[0] == 0 ? ByteOrder::Big : ByteOrder::Little; // 84 is in front or behind
        file_.clear();
        file_.seekg(0);
        if ((!narrow && !wide) || mark() != dcdHeaderSize)
            fail("expected a trajectory in the DCD format or in XTC");
        file_.seekg(0);
        const std::vector<char> header = record();
        const auto control = [&](std::size_t i) { return word(&header[4 + 4 * i]); };
        const bool charmm = control(19) != 0;
        cell_ = charmm && control(10) != 0;
        fourth_ = charmm && control(11) != 0;
        const std::uint32_t promised = control(0), fixed = control(8);
        record(); // titles
        const std::vector<char> count = record();
        if (count.size() != 4)
            fail("expected the number of atoms in 4 bytes, got " + std::to_string(count.size()));
        atoms_ = word(count.data());
        if (atoms_ == 0 || atoms_ > largestRecord / 4 || fixed >= atoms_)
            fail("expected atoms that move, got " + std::to_string(atoms_) + " of which " +
                 std::to_string(fixed) + " are fixed");
        if (fixed > 0) {
            const std::vector<char> list = record();
            if (list.size() != 4 * (atoms_ - fixed)) fail("the list of atoms that move is damaged");
            for (std::size_t i = 0; i < atoms_ - fixed; ++i) {
                const std::size_t atom = word(&list[4 * i]);
                if (atom < 1 || atom > atoms_) fail("the list of atoms that move is damaged");
                free_.push_back(atom - 1);
            }
        }
        begin_ = std::uint64_t(file_.tellg());
        const std::uint64_t rest = size_ - begin_, one = frameSize(true), more = frameSize(false);
        frames_ = rest < one ? 0 : std::size_t(1 + (rest - one) / more);
        const bool whole = rest == 0 || (rest >= one && (rest - one) % more == 0);
        const std::string told = "its header tells of " + std::to_string(promised) + " frames, ";
        if (!whole) fail("cut short: " + told + std::to_string(frames_) + " are whole");
        if (frames_ < promised) // as headers of runs that ended early do
            warning_ = told + counted(frames_, "is there", "are there");
        if (frames_ == 0) fail("it has no frame");
    }

    std::uint64_t frameSize(bool first) const
    {
        const std::uint64_t count = first || free_.empty() ? atoms_ : free_.size();
        constexpr std::uint64_t cellBytes = 48;
        const auto marks = std::uint64_t(2 * mark_); // of a record
        return (cell_ ? cellBytes + marks : 0) + (fourth_ ? 4u : 3u) * (4 * count + marks);
    }

    std::vector<float> axis(std::size_t count)
    {
        const std::vector<char> content = record();
        if (content.size() != 4 * count)
            fail("expected " + std::to_string(count) + " coordinates in a record, got " +
                 std::to_string(content.size() / 4));
        std::vector<float> out(count);
        for (std::size_t i = 0; i < count; ++i) out[i] = float(realAt(&content[4 * i], 4, order_));
        return out;
    }

    std::streamsize mark_ = 4; ///< bytes of a marker
    ByteOrder order_ = ByteOrder::Little;
    bool cell_ = false, fourth_ = false;
    std::size_t frames_ = 0;
    std::vector<std::size_t> free_; ///< atoms that move; empty: all
    std::uint64_t begin_ = 0;
};

} // namespace

std::unique_ptr<Trajectory> openDcd(const std::string& path)
{
    return std::make_unique<DcdFile>(path);
}

} // namespace molsurf
