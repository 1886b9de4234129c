// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/check_vdb.h"

#include <openvdb/io/Compression.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace molsurf
{

namespace
{

using openvdb::Coord;
namespace io = openvdb::io;

[[noreturn]] void refuseBytes(const std::string& what)
{
    throw std::runtime_error(what);
}

/// A type of values, by its name in a file.
struct VoxelType {
    std::string_view name;
    std::uint64_t size, half; ///< of a value, and of one as half floats [byte]
};

constexpr VoxelType types[] = {{"float", 4, 2},  {"double", 8, 2},  {"int32", 4, 4},
                               {"int64", 8, 8},  {"vec3i", 12, 12}, {"vec3s", 12, 6},
                               {"vec3d", 24, 6}, {"bool", 1, 1},    {"mask", 1, 1}};

constexpr const char* frustum = "NonlinearFrustumMap"; ///< holds another map

/// Size of the map of a transform in a file [byte]; it is the same for all maps of a type.
std::uint64_t sizeOfMap(const std::string& type)
{
    if (type == frustum || !openvdb::math::MapRegistry::isRegistered(type))
        refuseBytes("it has an unknown transform");
    std::ostringstream text;
    openvdb::math::MapRegistry::createMap(type)->write(text);
    return std::uint64_t(text.tellp());
}

/// The number of values of a node, by level: 8^3 of a leaf (0), 16^3 and 32^3.
constexpr std::uint64_t valuesOf[] = {512, 4096, 32768};

constexpr int rootSpan = 4096; ///< voxels of a child of the root along an edge

class Checker
{
public:
    Checker(std::istream& stream, std::uint64_t size) : stream_(stream), left_(size) {}

    VdbContent file()
    {
        if (take<std::int64_t>() != openvdb::OPENVDB_MAGIC)
            refuseBytes("it has another magic number");
        const auto version = take<std::uint32_t>();
        if (version < openvdb::OPENVDB_FILE_VERSION_NODE_MASK_COMPRESSION)
            refuseBytes("it is of version " + std::to_string(version) +
                        " of the format, before 222");
        skip(2 * sizeof(std::uint32_t) + sizeof(char)); // version of the library, offsets
        const auto uuid = take<std::array<char, 36>>();
        if (!std::all_of(uuid.begin(), uuid.end(), [](char c) {
                return c == '-' || std::isxdigit(static_cast<unsigned char>(c));
            }))
            refuseBytes(
                "its identifier is none"); // OpenVDB passes over blanks, and would be out of step
        metadata();
        const auto grids = take<std::int32_t>();
        for (std::int32_t g = 0; g < grids; ++g) grid();
        return content_;
    }

    void leaf(const std::string& type, bool half, std::uint32_t compression)
    {
        setType(type);
        half_ = half;
        compression_ = compression;
        leafValues();
        if (left_ > 0) refuseBytes("there is more than its values");
    }

private:
    void need(std::uint64_t bytes) const
    {
        if (bytes > left_) refuseBytes("cut short, or a length in it is wrong");
    }

    void read(void* to, std::uint64_t bytes)
    {
        need(bytes);
        left_ -= bytes;
        stream_.read(static_cast<char*>(to), std::streamsize(bytes));
    }

    void skip(std::uint64_t bytes)
    {
        need(bytes);
        while (bytes > 0) {
            std::array<char, 1 << 14> nothing;
            const std::uint64_t some = std::min<std::uint64_t>(bytes, nothing.size());
            read(nothing.data(), some);
            bytes -= some;
        }
    }

    template<typename T>
    T take()
    {
        T value;
        read(&value, sizeof value);
        return value;
    }

    std::string text()
    {
        const auto size = take<std::uint32_t>();
        need(size);
        std::string out(size, ' ');
        read(out.data(), size);
        return out;
    }

    void metadata()
    {
        const auto count = take<std::uint32_t>();
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::string name = text(), type = text();
            const auto size = take<std::uint32_t>();
            if (name == openvdb::GridBase::META_SAVE_HALF_FLOAT) {
                if (type != "bool" || size != 1) refuseBytes(name + " is not true or false");
                half_ = take<std::uint8_t>() != 0;
                continue;
            }
            if (type != "string" && openvdb::Metadata::isRegisteredType(type)) {
                if (openvdb::Metadata::createMetadata(type)->size() != size)
                    refuseBytes("metadata of type " + type + " have another length than that");
            }
            skip(size);
        }
    }

    void setType(const std::string& name)
    {
        const auto type = std::find_if(std::begin(types), std::end(types),
                                       [&](const VoxelType& t) { return t.name == name; });
        if (type == std::end(types)) refuseBytes("it has a grid of type " + name);
        type_ = *type;
    }

    void transform()
    {
        std::string name = text();
        if (name == frustum) {
            skip(8 * sizeof(double)); // box, taper and depth
            name = text();
        }
        skip(sizeOfMap(name));
    }

    void grid()
    {
        constexpr std::string_view before = "Tree_", after = "_5_4_3", halves = "_HalfFloat";
        content_.spline = text() == "spline" || content_.spline; // its name
        std::string name = text();
        if (name.size() > halves.size() &&
            name.compare(name.size() - halves.size(), halves.size(), halves) == 0)
            name.resize(name.size() - halves.size());
        if (name.size() < before.size() + after.size() || name.rfind(before, 0) != 0 ||
            name.compare(name.size() - after.size(), after.size(), after) != 0)
            refuseBytes("it has a grid of type " + name);
        setType(name.substr(before.size(), name.size() - before.size() - after.size()));
        const bool instance = !text().empty();
        skip(3 * sizeof(std::int64_t)); // places in the file, which are not used
        compression_ = take<std::uint32_t>();
        half_ = false; // whatever its type's name says: OpenVDB takes the word of the metadata
        metadata();
        transform();
        if (!instance) tree();
    }

    void tree()
    {
        skip(sizeof(std::int32_t)); // number of buffers
        skip(type_.size);           // background
        const auto tiles = take<std::uint32_t>(), children = take<std::uint32_t>();
        std::set<Coord> origins;
        const auto origin = [&] {
            const auto xyz = take<std::array<std::int32_t, 3>>();
            const Coord at(xyz[0], xyz[1], xyz[2]);
            if ((at & (rootSpan - 1)) != Coord(0) || !origins.insert(at).second)
                refuseBytes("it has two nodes in one place");
        };
        for (std::uint32_t i = 0; i < tiles; ++i) {
            origin();
            skip(type_.size + sizeof(bool));
        }
        leaves_ = 0;
        for (std::uint32_t i = 0; i < children; ++i) {
            origin();
            node(2);
        }
        for (std::uint64_t i = 0; i < leaves_; ++i) leafValues(); // behind the topology of all
        constexpr std::uint64_t ofLeaf = 128; // beside its values: mask, place, allocation
        content_.leaves = std::max(content_.leaves, leaves_);
        content_.bytes += leaves_ * (valuesOf[0] * type_.size + ofLeaf);
    }

    /// A mask of a node.
    /// @return how many of it are on
    std::uint64_t mask(std::uint64_t values)
    {
        std::array<std::uint64_t, 512> words;
        read(words.data(), values / 8);
        std::uint64_t on = 0;
        for (std::uint64_t i = 0; i < values / 64; ++i)
            on += std::uint64_t(__builtin_popcountll(words[i]));
        return on;
    }

    void node(int level)
    {
        const std::uint64_t values = valuesOf[level], children = mask(values);
        if (level == 0) {
            ++leaves_;
            return;
        }
        const std::uint64_t on = mask(values);
        nodeValues(values, on);
        content_.bytes += values * std::max<std::uint64_t>(type_.size, sizeof(void*));
        for (std::uint64_t i = 0; i < children; ++i) node(level - 1);
    }

    void leafValues()
    {
        constexpr std::uint64_t values = valuesOf[0], origin = 3 * sizeof(std::int32_t);
        const std::uint64_t on = mask(values);
        if (type_.name == "bool")
            skip(origin + values / 8);
        else if (type_.name == "mask")
            skip(origin);
        else
            nodeValues(values, on);
    }

    /// Passes over what io::readCompressedValues() reads: how inactive values are kept, one or two
    /// of these with a mask that tells them apart, and the active values or all.
    /// @param[in] on  how many of the values are active
    void nodeValues(std::uint64_t values, std::uint64_t on)
    {
        const auto kind = take<std::int8_t>();
        if (kind == io::NO_MASK_AND_ONE_INACTIVE_VAL || kind == io::MASK_AND_ONE_INACTIVE_VAL)
            skip(type_.size);
        if (kind == io::MASK_AND_TWO_INACTIVE_VALS) skip(2 * type_.size);
        if (kind == io::MASK_AND_NO_INACTIVE_VALS || kind == io::MASK_AND_ONE_INACTIVE_VAL ||
            kind == io::MASK_AND_TWO_INACTIVE_VALS)
            skip(values / 8);
        const bool few =
            (compression_ & io::COMPRESS_ACTIVE_MASK) && kind != io::NO_MASK_AND_ALL_VALS;
        const bool halves = half_ && type_.half != type_.size;
        const std::uint64_t bytes = (few ? on : values) * (halves ? type_.half : type_.size);
        if (halves && bytes == 0) return;
        if (compression_ & (io::COMPRESS_BLOSC | io::COMPRESS_ZIP))
            packed(bytes);
        else
            skip(bytes);
    }

    /// @param[in] bytes  that they unpack to
    void packed(std::uint64_t bytes)
    {
        const auto size = take<std::int64_t>(); // as they are if it is below 0
        if (size <= 0) {
            if (size != -std::int64_t(bytes)) refuseBytes("it has values of another length");
            return skip(bytes);
        }
        if (!(compression_ & io::COMPRESS_BLOSC)) return skip(std::uint64_t(size));
        // Four bytes of versions, then the lengths of values, of a block and of all.
        const auto head = take<std::array<std::uint32_t, 4>>();
        if (head[1] != bytes || head[3] > std::uint64_t(size) || size < std::int64_t(sizeof head))
            refuseBytes("it has values of another length");
        skip(std::uint64_t(size) - sizeof head);
    }

    std::istream& stream_;
    std::uint64_t left_; // bytes of the file
    VoxelType type_ = types[0];
    bool half_ = false;
    std::uint32_t compression_ = 0;
    std::uint64_t leaves_ = 0; // of the tree at hand
    VdbContent content_;
};

} // namespace

VdbContent checkVdb(std::istream& stream, std::uint64_t size)
{
    return Checker(stream, size).file();
}

void checkVdbLeaf(std::istream& stream, std::uint64_t size, const std::string& type, bool half,
                  std::uint32_t compression)
{
    Checker(stream, size).leaf(type, half, compression);
}

} // namespace molsurf
