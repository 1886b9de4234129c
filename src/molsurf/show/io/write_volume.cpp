// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/write_volume.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/show/io/dx_array.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace molsurf
{

namespace
{

using openvdb::Coord;
using openvdb::Vec3d;

/// The points that are written.
struct DenseBox {
    Coord first, size; ///< [voxel]
    Vec3d corner;      ///< place of the first one [Å]
    double voxel;      ///< [Å]

    std::uint64_t count() const
    {
        return std::uint64_t(size.x()) * std::uint64_t(size.y()) * std::uint64_t(size.z());
    }
};

DenseBox denseBoxOf(const openvdb::FloatGrid& surface, const Vec3d& origin, const OutputFile& file)
{
    const double h = surface.voxelSize()[0];
    const Vec3d zero = surface.indexToWorld(Vec3d(0.0));
    for (const Vec3d& axis : {Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1)})
        if (!(surface.indexToWorld(axis) - zero).eq(h * axis, 1e-6 * h))
            throw Error(ErrorKind::Input, "cannot write " + file.path() +
                                              ": expected a level set along the axes, got one that "
                                              "is turned");
    const openvdb::CoordBBox box = surface.evalActiveVoxelBoundingBox();
    const DenseBox dense{box.min(), box.dim(), surface.transform().indexToWorld(box.min()) - origin,
                         h};
    if (dense.count() > std::numeric_limits<std::int32_t>::max())
        throw Error(ErrorKind::Output,
                    "cannot write " + file.path() +
                        formatted(": its box has %d x %d x %d points, expected at most 2^31 [hint: "
                                  "larger voxels, or .vdb, which holds those of the band alone]",
                                  dense.size.x(), dense.size.y(), dense.size.z()));
    return dense;
}

/// Calls a function with each value, axis `fast` fastest and `slow` slowest: 0 and 2, either way.
template<typename Each>
void forEachValue(const openvdb::FloatGrid& surface, const DenseBox& box, int slow, int fast,
                  const Each& each)
{
    const auto values = surface.getConstAccessor();
    Coord at;
    for (at[slow] = 0; at[slow] < box.size[slow]; ++at[slow])
        for (at[1] = 0; at[1] < box.size[1]; ++at[1])
            for (at[fast] = 0; at[fast] < box.size[fast]; ++at[fast])
                each(values.getValue(box.first + at));
}

/// The header of a map: 256 words of 4 bytes.
class MrcHeader
{
public:
    void put(std::size_t word, std::int32_t value) { words_[word - 1] = value; }
    void put(std::size_t word, double value)
    {
        const float number = float(value);
        std::memcpy(&words_[word - 1], &number, sizeof number);
    }
    void put(std::size_t word, const char* text)
    {
        std::memcpy(&words_[word - 1], text, std::strlen(text));
    }
    const void* bytes() const { return words_.data(); }
    std::size_t size() const { return sizeof words_; }

private:
    std::array<std::int32_t, 256> words_{};
};

/// Least, largest and mean value, and the standard deviation.
struct ValueStatistics {
    double low = std::numeric_limits<double>::max(), high = -low, sum = 0.0, squares = 0.0;

    void add(double value)
    {
        low = std::min(low, value);
        high = std::max(high, value);
        sum += value;
        squares += value * value;
    }
};

/// Writes a map.
/// @param[in] each  calls a function with each value, x fastest
template<typename Each>
void writeMap(const DenseBox& box, const char* label, const Each& each, OutputFile& file)
{
    ValueStatistics values;
    each([&](float value) { values.add(value); });
    const double count = double(box.count()), mean = values.sum / count;
    MrcHeader header; // words are counted from 1, as the format's description does
    for (int axis = 0; axis < 3; ++axis) {
        const std::size_t a = std::size_t(axis);
        header.put(1 + a, box.size[axis]);
        header.put(5 + a, std::int32_t(std::lround(box.corner[axis] / box.voxel)));
        header.put(8 + a, box.size[axis]);
        header.put(11 + a, box.size[axis] * box.voxel);
        header.put(14 + a, 90.0);
        header.put(17 + a, axis + 1);
        header.put(50 + a, box.corner[axis]);
    }
    constexpr std::int32_t floats = 2, volume = 1, version = 20140, labels = 1;
    header.put(4, floats);
    header.put(20, values.low);
    header.put(21, values.high);
    header.put(22, mean);
    header.put(23, volume);
    header.put(28, version);
    header.put(53, "MAP ");
    header.put(54, std::int32_t(0x4444)); // little-endian, as this machine is
    header.put(55, std::sqrt(std::max(0.0, values.squares / count - mean * mean)));
    header.put(56, labels);
    header.put(57, label);
    file.write(header.bytes(), header.size());
    Buffer buffer(file);
    each([&](float value) { std::memcpy(buffer.take(sizeof value), &value, sizeof value); });
    buffer.flush();
    file.finish();
}

} // namespace

void writeMrc(const openvdb::FloatGrid& surface, const Vec3d& origin, OutputFile& file)
{
    const DenseBox box = denseBoxOf(surface, origin, file);
    writeMap(
        box, "vdb_molsurf: signed distance from the surface [A], negative inside",
        [&](const auto& each) { forEachValue(surface, box, 2, 0, each); }, file);
}

void writeMrc(const PixelBox& box, const std::vector<float>& values, const char* label,
              OutputFile& file)
{
    writeMap(
        {Coord(0), Coord(box.count), box.corner, box.pixel}, label,
        [&](const auto& each) { std::for_each(values.begin(), values.end(), each); }, file);
}

void writeDx(const openvdb::FloatGrid& surface, const Vec3d& origin, OutputFile& file)
{
    const DenseBox box = denseBoxOf(surface, origin, file);
    TextOutput out(file);
    DxArray array("signed distance from the surface [A], negative inside",
                  {box.size.x(), box.size.y(), box.size.z()}, box.corner, Vec3d(box.voxel), out);
    forEachValue(surface, box, 0, 2, [&](float value) { array.add(value); });
    array.finish();
}

} // namespace molsurf
