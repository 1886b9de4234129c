// SPDX-License-Identifier: MPL-2.0
#include "molsurf/scale/bricks/brick_file.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/core/transient_error.h"
#include "molsurf/show/io/json_members.h"
#include "molsurf/show/io/write_vdb.h"

#include <openvdb/io/Compression.h>
#include <openvdb/io/io.h>
#include <zlib.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace molsurf
{

template<typename Rows>
void members(Rows& rows, Section& section)
{
    rows(section.offset);
    rows(section.count);
}

template<typename Rows>
void members(Rows& rows, StoredGrid& grid)
{
    rows("name", grid.name);
    rows("type", grid.type);
    rows("class", grid.gridClass);
    rows("background", grid.background);
    rows("half", grid.half);
    if (rows.has("metadata", true)) rows("metadata", grid.metadata);
    rows("leaves", grid.leaves);
}

template<typename Rows>
void members(Rows& rows, Report::Group& group)
{
    rows("name", group.name);
    rows("atoms", group.atoms);
    rows("area", group.area);
    if (rows.has("color", true)) rows("color", group.color);
}

template<typename Rows>
void members(Rows& rows, EvolutionReport& evolution)
{
    rows("steps", evolution.steps);
    rows("energy", evolution.energy);
    rows("final_energy", evolution.finalEnergy);
    rows("area", evolution.area);
    rows("volume", evolution.volume);
    rows("mean_displacement", evolution.meanDisplacement);
    rows("max_speed", evolution.maxSpeed);
    rows("crevice_voxels", evolution.unresolvedGapVoxels);
}

template<typename Rows>
void members(Rows& rows, Displacements& moves)
{
    rows("count", moves.count);
    rows("moved", moves.moved);
    rows("square", moves.square);
    rows("bins", moves.bins);
}

template<typename Rows>
void members(Rows& rows, BrickHeader& header)
{
    rows("plan", header.plan);
    rows("brick", header.number);
    rows("grids", header.grids);
    rows("scalars", header.layout.scalars);
    rows("labels", header.layout.labels);
    rows("colors", header.layout.colors);
    rows("vertices", header.vertices);
    rows("areas", header.areas);
    rows("curvatures", header.curvatures);
    rows("triangles", header.triangles);
    rows("border", header.border);
    rows("open_edges", header.openEdges);
    rows("pieces", header.pieces);
    rows("closed", header.closed);
    rows("manifold", header.manifold);
    rows("degenerate_triangles", header.flat);
    rows("max_residual", header.sums.maxResidual);
    rows("kink_vertices", header.sums.kinkVertices);
    rows("unit_vertices", header.sums.unitVertices);
    rows("groups", header.sums.groups);
    rows("evolution", header.sums.evolution);
    rows("displacements", header.sums.displacements);
    rows("seconds", header.sums.seconds);
}

namespace
{

constexpr std::array<char, 8> magic = {'M', 'O', 'L', 'B', 'R', 'K', '0', '5'};

/// Behind the magic: place and length of the header, and the checksum of the rest.
struct Head {
    std::uint64_t header = 0, length = 0, checksum = 0;
};
constexpr std::uint64_t bodyAt = sizeof magic + sizeof(Head);

std::uint32_t addToChecksum(std::uint32_t sum, const void* from, std::size_t size)
{
    if (size == 0) return sum; // zlib takes null for a new start
    return std::uint32_t(crc32_z(sum, static_cast<const Bytef*>(from), size));
}

// Appends sections to the head, and knows where it is.
class Writer
{
public:
    explicit Writer(OutputFile& file) : file_(file) {}

    template<typename T>
    Section add(const std::vector<T>& records)
    {
        const Section section{at_, records.size()};
        bytes(records.data(), records.size() * sizeof(T));
        return section;
    }
    void bytes(const void* from, std::size_t size)
    {
        file_.write(from, size);
        at_ += size;
        checksum_ = addToChecksum(checksum_, from, size);
    }
    std::uint64_t at() const { return at_; }
    std::uint32_t checksum() const { return checksum_; }

private:
    OutputFile& file_;
    std::uint64_t at_ = bodyAt;
    std::uint32_t checksum_ = 0;
};

// The values of a leaf as they stand in a .vdb.
template<typename LeafT>
std::string valuesOf(const LeafT& leaf, const typename LeafT::ValueType& background,
                     std::uint32_t compression, bool half)
{
    std::ostringstream stream;
    openvdb::io::setDataCompression(stream, compression);
    openvdb::io::setGridBackgroundValuePtr(stream, &background);
    leaf.writeBuffers(stream, half);
    return stream.str();
}

template<typename T>
std::vector<double> numbersOf(const T& value)
{
    return {double(value)};
}
std::vector<double> numbersOf(const openvdb::Vec3s& value)
{
    return {value.x(), value.y(), value.z()};
}

std::map<std::string, std::string> wordsOf(const openvdb::MetaMap& metadata)
{
    std::map<std::string, std::string> words;
    for (auto it = metadata.beginMeta(); it != metadata.endMeta(); ++it)
        if (it->second->typeName() == openvdb::StringMetadata::staticTypeName())
            words.emplace(it->first, it->second->str());
    return words;
}

/// Writes the leaves of a grid, some thousands at a time: their values are compressed in parallel,
/// and written in their order.
template<typename GridT>
StoredGrid addGrid(const GridT& grid, std::uint32_t compression, Writer& writer,
                   const Progress& progress)
{
    using Leaf = typename GridT::TreeType::LeafNodeType;
    std::vector<const Leaf*> leaves;
    grid.tree().getNodes(leaves);
    std::vector<StoredLeaf> stored(leaves.size());
    const auto background = grid.background();
    const bool half = grid.saveFloatAsHalf();
    constexpr std::size_t run = 4096;
    for (std::size_t begin = 0; begin < leaves.size(); begin += run) {
        const std::size_t count = std::min(run, leaves.size() - begin);
        std::vector<std::string> values(count);
        parallelFor(count, progress, [&](std::size_t i) {
            const Leaf& leaf = *leaves[begin + i];
            values[i] = valuesOf(leaf, background, compression, half);
            stored[begin + i] = storedLeaf(leaf);
            stored[begin + i].size = values[i].size();
        });
        for (std::size_t i = 0; i < count; ++i) {
            stored[begin + i].offset = writer.at();
            writer.bytes(values[i].data(), values[i].size());
        }
    }
    return {grid.getName(),
            grid.type(),
            openvdb::GridBase::gridClassToString(grid.getGridClass()),
            numbersOf(background),
            half,
            writer.add(stored),
            wordsOf(grid)};
}

StoredGrid addAnyGrid(const openvdb::GridBase::Ptr& grid, std::uint32_t compression, Writer& writer,
                      const Progress& progress)
{
    if (const auto g = openvdb::gridPtrCast<openvdb::FloatGrid>(grid))
        return addGrid(*g, compression, writer, progress);
    if (const auto g = openvdb::gridPtrCast<openvdb::Int32Grid>(grid))
        return addGrid(*g, compression, writer, progress);
    return addGrid(*openvdb::gridPtrCast<openvdb::Vec3SGrid>(grid), compression, writer, progress);
}

void writeVertices(const Mesh& mesh, std::size_t count, const PlyLayout& layout, Writer& writer,
                   const Progress& progress)
{
    constexpr std::size_t run = 1 << 16;
    const std::size_t size = layout.vertexSize();
    std::vector<char> records(run * size);
    for (std::size_t begin = 0; begin < count; begin += run) {
        const std::size_t some = std::min(run, count - begin);
        parallelFor(some, progress, [&](std::size_t i) {
            encodeVertex(mesh, begin + i, records.data() + i * size);
        });
        writer.bytes(records.data(), some * size);
    }
}

/// Checks what a hostile header could break: that counts agree, and that sections follow one after
/// another as writeBrick() puts them, so that nothing lies outside and nothing counts twice.
/// @param[in] end  where the header begins
/// @throws std::range_error
void checkHeader(BrickHeader& h, std::uint64_t end)
{
    const auto check = [](bool good, const char* what) {
        if (!good) throw std::range_error(what);
    };
    std::uint64_t at = bodyAt;
    const auto skip = [&](const Section& section, std::uint64_t size, const char* what) {
        check(section.offset >= at && section.offset <= end &&
                  (size == 0 || section.count <= (end - section.offset) / size),
              what);
        at = section.offset + section.count * size;
    };
    const auto follow = [&](const Section& section, std::uint64_t size, const char* what) {
        check(section.offset == at, what);
        skip(section, size, what);
    };
    const auto isName = [](const std::string& name) {
        return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
            return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-';
        });
    };
    check(!h.grids.empty() && h.grids.front().name == "surface", "grids do not begin with surface");
    std::set<std::string> names;
    for (StoredGrid& grid : h.grids) {
        const bool vectors = grid.type == openvdb::Vec3SGrid::gridType();
        check(isName(grid.name) && names.insert(grid.name).second, "grids have no names");
        check(vectors || grid.type == openvdb::FloatGrid::gridType() ||
                  grid.type == openvdb::Int32Grid::gridType(),
              "grids have unknown types");
        check(grid.background.size() == (vectors ? 3u : 1u) &&
                  std::all_of(grid.background.begin(), grid.background.end(),
                              [](double value) { return std::abs(value) < 1e9; }),
              "grids have no background");
        grid.values = at;
        skip(grid.leaves, sizeof(StoredLeaf), "leaves lie outside of it");
    }
    for (const auto* columns : {&h.layout.scalars, &h.layout.labels})
        check(std::all_of(columns->begin(), columns->end(), isName),
              "vertices have values without names");
    follow(h.vertices, h.meshed() ? h.layout.vertexSize() : 0, "vertices lie elsewhere");
    if (h.meshed()) follow(h.triangles, 12, "triangles lie elsewhere");
    follow(h.areas, sizeof(float), "areas lie elsewhere");
    follow(h.curvatures, 2 * sizeof(float), "curvatures lie elsewhere");
    follow(h.border, sizeof(BorderVertex), "border lies elsewhere");
    follow(h.openEdges, sizeof(OpenEdge), "edges lie elsewhere");
    follow(h.pieces, sizeof(PieceMeasure), "pieces lie elsewhere");
    check(at == end, "sections leave something over");
    check(h.areas.count == h.vertices.count && h.curvatures.count == h.vertices.count,
          "vertices are not as many as their areas and curvatures");
    check(h.sums.kinkVertices <= h.vertices.count &&
              h.sums.unitVertices <= h.vertices.count - h.sums.kinkVertices,
          "vertices are fewer than those of a kind");
    constexpr double far = 1e6; // [Å], farther than any vertex lies from the surface
    check(h.sums.maxResidual >= 0.0 && h.sums.maxResidual < far, "its residual is no length");
    if (!h.sums.evolution) return;
    const EvolutionReport& e = *h.sums.evolution;
    const auto steps = std::size_t(e.steps);
    if (e.steps == 0 && e.energy.empty() && e.area.empty() && e.volume.empty()) return; // no flow
    check(e.steps >= 0 && e.energy.size() == steps + 1 && e.area.size() == steps + 1 &&
              e.volume.size() == steps + 1 && e.meanDisplacement.size() == steps &&
              e.maxSpeed.size() == steps,
          "steps are not as many as their sums");
}

} // namespace

void writeBrick(const Brick& brick, const std::string& plan, std::size_t number, bool meshed,
                OutputFile& file, const Progress& progress)
{
    BrickHeader header;
    header.plan = plan;
    header.number = number;
    header.sums = brick;
    header.closed = brick.mesh.closed;
    header.manifold = brick.mesh.manifold;
    header.flat = brick.mesh.flat;

    Writer writer(file);
    Head head;
    file.write(magic.data(), magic.size());
    file.write(&head, sizeof head); // zeros until the checksum is known
    const std::uint32_t compression =
        vdbCompression(std::all_of(brick.grids.begin(), brick.grids.end(), [](const auto& grid) {
            return grid->template isType<openvdb::FloatGrid>();
        }));
    for (const auto& grid : brick.grids)
        header.grids.push_back(addAnyGrid(grid, compression, writer, progress));
    const Mesh& mesh = brick.mesh.mesh;
    header.layout = layoutOf(mesh);
    const std::size_t owned = brick.mesh.owned;
    header.vertices = {writer.at(), owned};
    header.triangles = {0, mesh.triangles.size()};
    if (meshed) {
        writeVertices(mesh, owned, header.layout, writer, progress);
        header.triangles = writer.add(mesh.triangles);
    }
    header.areas = writer.add(brick.mesh.areas);
    std::vector<std::array<float, 2>> curvatures(owned);
    parallelFor(owned, progress, [&](std::size_t n) {
        curvatures[n] = {mesh.scalars[0].values[n], mesh.scalars[1].values[n]};
    });
    header.curvatures = writer.add(curvatures);
    header.border = writer.add(brick.mesh.border);
    header.openEdges = writer.add(brick.mesh.openEdges);
    header.pieces = writer.add(brick.mesh.pieces);
    const std::string text = jsonText(header, -1);
    head.header = writer.at();
    head.length = text.size();
    writer.bytes(text.data(), text.size());
    head.checksum = writer.checksum();
    try {
        file.stream().seekp(std::streamoff(magic.size()));
    } catch (const std::ios_base::failure&) {
        file.fail("cannot write");
    }
    file.write(&head, sizeof head);
    file.finish();
}

openvdb::CoordBBox anySpace()
{
    constexpr int far = 1 << 26; // [voxel]
    return {openvdb::Coord(-far), openvdb::Coord(far - 1)};
}

BrickFile::BrickFile(const std::string& path, const openvdb::CoordBBox& box)
    : path_(path), box_(box), file_(open(path.c_str(), O_RDONLY | O_CLOEXEC))
{
    const auto noBrick = [&](const std::string& why) {
        refuse("is not the file of a brick: " + why);
    };
    if (!file_)
        throw Error(ErrorKind::Input, "cannot read " + path + ": " + strerror(errno),
                    mayPass(errno));
    std::array<char, 8> mark{};
    Head head;
    const off_t end = lseek(file_.get(), 0, SEEK_END);
    const std::uint64_t size = end < 0 ? 0 : std::uint64_t(end);
    if (size < bodyAt) noBrick("it is too short");
    try {
        read(0, mark.data(), mark.size());
        if (mark != magic) noBrick("it does not begin with MOLBRK05");
        read(mark.size(), &head, sizeof head);
        if (head.header < bodyAt || head.header > size || head.length != size - head.header)
            noBrick("it is cut short");
        if (checksumOf(size) != head.checksum) noBrick("it is damaged: its checksum is another");
        std::string text(head.length, ' ');
        read(head.header, text.data(), text.size());
        header_ = JsonReader::valueOf<BrickHeader>(nlohmann::json::parse(text));
        checkHeader(header_, head.header);
    } catch (const nlohmann::json::exception&) {
        noBrick("its header cannot be read");
    } catch (const std::range_error& e) {
        noBrick(std::string("its ") + e.what());
    }
}

void BrickFile::refuse(const std::string& what) const
{
    throw Error(ErrorKind::Input, path_ + " " + what + " [hint: run the brick again with `force`]");
}

std::vector<StoredLeaf> BrickFile::leaves(std::size_t g) const
{
    const StoredGrid& grid = header_.grids[g];
    std::vector<StoredLeaf> all = read<StoredLeaf>(grid.leaves);
    std::uint64_t at = grid.values;
    for (const StoredLeaf& leaf : all) {
        const openvdb::Coord origin(leaf.origin[0], leaf.origin[1], leaf.origin[2]);
        if ((origin & 7) != openvdb::Coord(0)) refuse("has a leaf between leaves");
        if (!box_.isInside(origin)) refuse("has a leaf far away");
        if (leaf.offset != at || leaf.size > grid.leaves.offset - at)
            refuse("has a leaf whose values lie elsewhere");
        at += leaf.size;
    }
    if (at != grid.leaves.offset) refuse("has values of no leaf");
    return all;
}

std::uint64_t BrickFile::checksumOf(std::uint64_t size) const
{
    constexpr std::uint64_t run = 1 << 20;
    std::vector<char> bytes(run);
    std::uint32_t sum = 0;
    for (std::uint64_t at = bodyAt; at < size; at += run) {
        const std::size_t count = std::size_t(std::min(run, size - at));
        read(at, bytes.data(), count);
        sum = addToChecksum(sum, bytes.data(), count);
    }
    return sum;
}

void readAt(const FileDescriptor& file, const std::string& path, std::uint64_t offset, void* to,
            std::size_t bytes)
{
    char* at = static_cast<char*>(to);
    while (bytes > 0) {
        const ssize_t got = pread(file.get(), at, bytes, off_t(offset));
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0)
            throw Error(ErrorKind::Input,
                        "cannot read " + path + ": " +
                            (got < 0 ? std::strerror(errno) : "it is cut short"),
                        got < 0 && mayPass(errno));
        at += got;
        offset += std::uint64_t(got);
        bytes -= std::size_t(got);
    }
}

} // namespace molsurf
