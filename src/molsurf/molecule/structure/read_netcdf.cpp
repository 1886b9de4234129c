// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/trajectory.h"

#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/structure/byte_order.h"

#include <algorithm>
#include <cstring>

namespace molsurf
{

namespace
{

// The classic format of NetCDF (versions 1, 2 and 5): dimensions, attributes, variables; then the
// variables of fixed size, and record by record those of the unlimited dimension. Numbers have the
// most significant byte first; names and lists are filled up to 4 bytes.
// docs.unidata.ucar.edu/nug, "File Format Specifications".
constexpr std::uint64_t listOfDimensions = 10, listOfVariables = 11, listOfAttributes = 12;
constexpr std::uint64_t floatType = 5, doubleType = 6;

/// Bytes of a number of a type, 0: there is no such type.
std::uint64_t bytesOf(std::uint64_t type)
{
    constexpr std::uint64_t sizes[] = {0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
    return type < std::size(sizes) ? sizes[type] : 0;
}

std::uint64_t filledUp(std::uint64_t size)
{
    return (size + 3) / 4 * 4;
}

/// A NetCDF trajectory of Amber: the variable "coordinates" by frame, atom and axis; or a restart
/// file, which has one frame. Å, unless scale_factor changes that.
class NetcdfFile : public Trajectory
{
public:
    explicit NetcdfFile(const std::string& path) : Trajectory(path)
    {
        char magic[4] = {};
        file_.read(magic, sizeof magic);
        version_ = magic[3];
        if (std::memcmp(magic, "CDF", 3) != 0 || (version_ != 1 && version_ != 2 && version_ != 5))
            fail("expected NetCDF of version 1, 2 or 5");
        const std::uint64_t promised = count(), unknown = version_ == 5 ? ~0ull : 0xffffffffull;
        readDimensions();
        attributes(nullptr);
        readVariables();
        if (!found_)
            fail("expected a variable \"coordinates\" by atom and axis, as Amber writes "
                 "[hint: cpptraj writes FILE.dcd]");
        if (!isRecord_) {
            frames_ = 1;
            if (begin_ + frameBytes() > size_) fail("cut short");
            return;
        }
        const std::uint64_t whole =
            begin_ + frameBytes() > size_ ? 0 : 1 + (size_ - begin_ - frameBytes()) / recordSize_;
        frames_ = std::size_t(promised == unknown ? whole : std::min(whole, promised));
        if (frames_ == 0) fail("expected frames, got none");
        if (promised != unknown && whole < promised)
            warning_ = formatted("it is cut short: %zu frames of %llu are whole", frames_,
                                 static_cast<unsigned long long>(promised));
    }

    std::size_t frames() const override { return frames_; }

protected:
    std::vector<openvdb::Vec3f> load(std::size_t frame) override
    {
        file_.clear();
        file_.seekg(std::streamoff(begin_ + frame * recordSize_));
        std::vector<char> bytes(frameBytes());
        if (!file_.read(bytes.data(), std::streamsize(bytes.size()))) fail("cut short");
        std::vector<openvdb::Vec3f> out(atoms_);
        for (std::size_t i = 0; i < 3 * atoms_; ++i)
            out[i / 3][int(i % 3)] =
                float(scale_ * realAt(&bytes[i * bytesOf(type_)], bytesOf(type_), ByteOrder::Big));
        return out;
    }

private:
    std::uint64_t frameBytes() const { return 3 * atoms_ * bytesOf(type_); }

    std::uint64_t word(std::size_t size = 4)
    {
        char bytes[8] = {};
        if (!file_.read(bytes, std::streamsize(size))) fail("cut short");
        return unsignedAt(bytes, size, ByteOrder::Big);
    }

    /// A number of things, none of which takes less than a byte.
    std::uint64_t count() { return word(version_ == 5 ? 8 : 4); }

    std::uint64_t countHere()
    {
        const std::uint64_t value = count();
        if (value > size_) fail("is damaged: a list has " + std::to_string(value) + " entries");
        return value;
    }

    std::string text(std::uint64_t size)
    {
        std::string out(size, ' ');
        file_.read(out.data(), std::streamsize(size));
        file_.seekg(std::streamoff(filledUp(size) - size), std::ios::cur);
        if (!file_) fail("cut short");
        return out;
    }

    /// The length of a list.
    std::uint64_t list(std::uint64_t kind)
    {
        const std::uint64_t mark = word(), length = countHere();
        if (mark != kind && (mark != 0 || length != 0)) fail("is damaged: expected a list");
        return length;
    }

    void readDimensions()
    {
        for (std::uint64_t left = list(listOfDimensions); left > 0; --left) {
            text(countHere());
            lengths_.push_back(count());
        }
    }

    /// Passes over attributes.
    /// @param[out] scale  gets "scale_factor" if it is there
    void attributes(double* scale)
    {
        for (std::uint64_t left = list(listOfAttributes); left > 0; --left) {
            const std::string name = text(countHere());
            const std::uint64_t type = word(), size = bytesOf(type);
            const std::string values = text(countHere() * size);
            if (size == 0) fail("is damaged: an attribute of type " + std::to_string(type));
            if (scale && name == "scale_factor" && values.size() >= size &&
                (type == floatType || type == doubleType))
                *scale = realAt(values.data(), size, ByteOrder::Big);
        }
    }

    void readVariables()
    {
        for (std::uint64_t left = list(listOfVariables); left > 0; --left) {
            const std::string name = text(countHere());
            std::vector<std::uint64_t> lengths;
            for (std::uint64_t k = countHere(); k > 0; --k) {
                const std::uint64_t dimension = count();
                if (dimension >= lengths_.size()) fail("is damaged: a dimension is missing");
                lengths.push_back(lengths_[dimension]);
            }
            double scale = 1.0;
            attributes(&scale);
            const std::uint64_t type = word(), size = count(), begin = word(version_ == 1 ? 4 : 8);
            const bool isRecord = !lengths.empty() && lengths[0] == 0;
            if (isRecord) recordSize_ += size;
            if (name != "coordinates") continue;
            if (isRecord) lengths.erase(lengths.begin());
            if (lengths.size() != 2 || lengths[1] != 3 || (type != floatType && type != doubleType))
                fail("expected \"coordinates\" by atom and three axes, in floats or doubles");
            if (lengths[0] == 0 || lengths[0] > size_) fail("is damaged: its atoms do not fit");
            found_ = true;
            isRecord_ = isRecord;
            atoms_ = std::size_t(lengths[0]);
            type_ = type;
            begin_ = begin;
            scale_ = scale;
        }
    }

    int version_ = 0;
    std::vector<std::uint64_t> lengths_; ///< of dimensions; 0: unlimited
    bool found_ = false, isRecord_ = false;
    std::uint64_t type_ = floatType, begin_ = 0, recordSize_ = 0; ///< [byte]
    double scale_ = 1.0;
    std::size_t frames_ = 0;
};

} // namespace

std::unique_ptr<Trajectory> openNetcdf(const std::string& path)
{
    return std::make_unique<NetcdfFile>(path);
}

} // namespace molsurf
