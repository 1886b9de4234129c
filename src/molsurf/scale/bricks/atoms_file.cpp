// SPDX-License-Identifier: MPL-2.0
#include "molsurf/scale/bricks/atoms_file.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/cancel.h"
#include "molsurf/kernel/core/memory.h"
#include "molsurf/kernel/core/transient_error.h"
#include "molsurf/kernel/pipeline/check_balls.h"
#include "molsurf/molecule/selection/scalar_map.h"
#include "molsurf/molecule/selection/subset.h"
#include "molsurf/scale/bricks/brick_file.h"
#include "molsurf/show/io/json_members.h"

#include <tbb/parallel_sort.h>
#include <zlib.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace molsurf
{

using openvdb::Coord;
using openvdb::Vec3d;

/// A copy in the header.
struct StoredCopy {
    std::size_t part = 0;
    Motion motion;
};

/// The lattice of a map in the header.
struct StoredMap {
    Vec3d origin, spacing;
    std::array<std::uint32_t, 3> counts{};
    std::uint32_t checksum = 0; ///< of its values
};

/// Values of balls in the header.
struct StoredValues {
    BallValues values; ///< without those of the balls, and without the map
    std::optional<StoredMap> map;
};

/// The header of a file: what all balls share.
struct AtomsHeader {
    std::size_t atoms = 0;
    std::vector<StoredCopy> copies;   ///< empty: nothing is folded
    std::vector<std::string> columns; ///< the names of what each ball has
    GaussianExtent extent;
    BallSet shared; ///< without balls and values
    std::optional<StoredValues> values;
};

template<typename Rows>
void members(Rows& rows, StoredCopy& copy)
{
    rows(copy.part);
    for (std::size_t k = 0; k < 3; ++k) {
        for (double& entry : copy.motion.rotation[k]) rows(entry);
        rows(copy.motion.translation[int(k)]);
    }
}

template<typename Rows>
void members(Rows& rows, GaussianExtent& extent)
{
    rows(extent.maxRadius);
    rows(extent.maxGrownRadius);
    rows(extent.maxTolerance);
}

template<typename Rows>
void members(Rows& rows, ResolutionGroup& group)
{
    rows(group.rule.select);
    rows(group.rule.resolution);
    rows(group.balls);
    rows(group.level);
}

template<typename Rows>
void members(Rows& rows, Group& group)
{
    rows(group.name);
    rows(group.balls);
    rows(group.color);
    rows(group.place);
}

template<typename Rows>
void members(Rows& rows, Coloring& coloring)
{
    rows("range", coloring.range);
    rows("palette", coloring.palette);
    rows("by_residue", coloring.byResidue);
    rows("flat", coloring.flat);
    rows("outward", coloring.potentialOffset);
}

template<typename Rows>
void members(Rows& rows, StoredMap& map)
{
    rows("origin", map.origin);
    rows("spacing", map.spacing);
    rows("counts", map.counts);
    rows("checksum", map.checksum);
}

template<typename Rows>
void members(Rows& rows, StoredValues& stored)
{
    BallValues& values = stored.values;
    rows("name", values.name);
    rows("title", values.title);
    rows("unit", values.unit);
    rows("palette", values.palette);
    rows("low", values.low);
    rows("high", values.high);
    rows("flat", values.flat);
    if (rows.has("centre", values.centre.has_value())) rows("centre", values.centre);
    if (rows.has("map", stored.map.has_value())) rows("map", stored.map);
}

template<typename Rows>
void members(Rows& rows, AtomsHeader& header)
{
    BallSet& shared = header.shared;
    rows("atoms", header.atoms);
    rows("copies", header.copies);
    rows("columns", header.columns);
    rows("model", shared.record.model);
    rows("extent", header.extent);
    rows("resolutions", shared.resolutions);
    rows("coloring", shared.coloring);
    if (!rows.has("chains", shared.labels.has_value())) return;
    BallLabels& labels = shared.labels ? *shared.labels : shared.labels.emplace();
    rows("chains", labels.chains);
    rows("chain_places", labels.chainPlaces);
    rows("groups", labels.groups);
    if (rows.has("values", header.values.has_value())) rows("values", header.values);
}

namespace
{

/// The file: this, records cell by cell, the values of a map, the cells, a header in JSON, and the
/// lengths of these three.
constexpr std::array<char, 8> atomsMark = {'M', 'O', 'L', 'A', 'T', 'M', '0', '2'};

/// The end of files that do not know copies.
constexpr std::array<char, 8> earlierMark = {'M', 'O', 'L', 'A', 'T', 'M', '0', '1'};

struct Tail {
    std::uint64_t map = 0, cells = 0, header = 0; ///< [byte]
    std::array<char, 8> mark = atomsMark;
};

constexpr double cellEdge = 20.0; // [Å]: small beside what is read around a brick

/// A ball in the file.
struct Record {
    double x, y, z, radius;
    std::int32_t atom, chain, group, resolution; // the last three: index, or -1
    float rate, level, value;
    std::uint8_t element;
    ResidueClass residueClass;
    std::uint8_t color[3], nothing[7];
};
static_assert(sizeof(Record) == 72);

std::uint32_t checksumOfBytes(const void* bytes, std::size_t size)
{
    return std::uint32_t(crc32_z(0, static_cast<const Bytef*>(bytes), size));
}

Coord cellOf(const Vec3d& x)
{
    return Coord::floor(x / cellEdge);
}

/// The record of ball i; what the balls do not have is 0, or -1 if it is an index.
Record recordOf(const BallSet& atoms, std::size_t i)
{
    const Ball& ball = atoms.balls[i];
    Record r{};
    r.x = ball.center.x();
    r.y = ball.center.y();
    r.z = ball.center.z();
    r.radius = ball.radius;
    r.atom = ball.atom;
    r.resolution = r.chain = r.group = -1;
    const auto put = [i](const auto& from, auto& to) {
        if (!from.empty()) to = from[i];
    };
    Decay decay;
    std::array<std::uint8_t, 3> color{};
    put(atoms.resolutionOf, r.resolution);
    put(atoms.decays, decay);
    put(atoms.colors, color);
    r.rate = decay.rate;
    r.level = decay.level;
    std::copy(color.begin(), color.end(), r.color);
    if (!atoms.labels) return r;
    const BallLabels& labels = *atoms.labels;
    put(labels.chainOf, r.chain);
    put(labels.groupOf, r.group);
    put(labels.elementOf, r.element);
    put(labels.residueClassOf, r.residueClass);
    if (labels.values) put(labels.values->valueOf, r.value);
    return r;
}

/// Calls f(name, column) for all that each ball may have.
template<typename Balls, typename F>
void forEachColumn(Balls& atoms, const F& f)
{
    f("resolution", atoms.resolutionOf);
    f("decay", atoms.decays);
    f("color", atoms.colors);
    if (!atoms.labels) return;
    f("chain", atoms.labels->chainOf);
    f("group", atoms.labels->groupOf);
    f("element", atoms.labels->elementOf);
    f("class", atoms.labels->residueClassOf);
    if (atoms.labels->values) f("value", atoms.labels->values->valueOf);
}

/// The names of what each ball has.
std::vector<std::string> columns(const BallSet& atoms)
{
    std::vector<std::string> names;
    forEachColumn(atoms, [&](const char* name, const auto& column) {
        if (!column.empty()) names.push_back(name);
    });
    return names;
}

/// Gives one entry to each column that the header names, by which addBall() knows it.
/// @throws std::range_error if the rest of the header asks for one that it does not name
void markColumns(const std::vector<std::string>& names, BallSet& atoms)
{
    std::set<std::string> lacking;
    if (!atoms.resolutions.empty()) lacking = {"resolution", "decay"};
    if (atoms.labels) lacking.insert({"chain", "element", "class"});
    if (atoms.labels && !atoms.labels->groups.empty()) lacking.insert("group");
    if (atoms.labels && atoms.labels->values) lacking.insert("value");
    forEachColumn(atoms, [&](const char* name, auto& column) {
        if (std::find(names.begin(), names.end(), name) == names.end()) return;
        column.resize(1);
        lacking.erase(name);
    });
    if (!lacking.empty()) throw std::range_error("header lacks the column " + *lacking.begin());
}

/// Adds the ball of a record.
/// @param[in] centre  where a motion brings it
/// @param[in] like    of markColumns(): columns that are empty there are not filled
/// @return false if an index is wrong
bool addBall(const Record& r, const Vec3d& centre, const BallSet& like, BallSet& out)
{
    const auto isIndex = [](std::int32_t i, std::size_t count) {
        return i >= -1 && i < std::int64_t(count);
    };
    const auto add = [](const auto& column, auto& to, const auto& value) {
        if (!column.empty()) to.push_back(value);
    };
    out.balls.push_back({centre, r.radius, r.atom});
    if (!isIndex(r.resolution, out.resolutions.size())) return false;
    add(like.resolutionOf, out.resolutionOf, r.resolution);
    add(like.decays, out.decays, Decay{r.rate, r.level});
    add(like.colors, out.colors, std::array<std::uint8_t, 3>{r.color[0], r.color[1], r.color[2]});
    if (!out.labels) return true;
    BallLabels& labels = *out.labels;
    const BallLabels& some = *like.labels;
    if (!isIndex(r.chain, labels.chains.size()) || !isIndex(r.group, labels.groups.size()) ||
        r.residueClass > ResidueClass::Other)
        return false;
    add(some.chainOf, labels.chainOf, r.chain);
    add(some.groupOf, labels.groupOf, r.group);
    add(some.elementOf, labels.elementOf, r.element);
    add(some.residueClassOf, labels.residueClassOf, r.residueClass);
    if (labels.values) add(some.values->valueOf, labels.values->valueOf, r.value);
    return true;
}

/// The copies of a folded set.
std::vector<StoredCopy> copiesOf(const Placement& placement)
{
    std::vector<StoredCopy> copies;
    if (!placement.folded) return copies;
    for (const Instance& copy : placement.instances) copies.push_back({copy.part, copy});
    return copies;
}

/// The motions of each part: where nothing is folded the only part stays where it is.
/// @throws std::range_error if a copy is none
std::vector<std::vector<Motion>> motionsOf(const std::vector<StoredCopy>& copies)
{
    if (copies.empty()) return {{Motion::identity()}};
    std::vector<std::vector<Motion>> motions;
    for (const StoredCopy& copy : copies) {
        if (copy.part >= copies.size()) throw std::range_error("copies are none");
        if (copy.part >= motions.size()) motions.resize(copy.part + 1);
        motions[copy.part].push_back(copy.motion);
    }
    return motions;
}

/// A box about a moved one. It is a little wider than that: places are rounded.
openvdb::BBoxd moved(const openvdb::BBoxd& box, const Motion& motion)
{
    constexpr double rounding = 1e-6; // [Å], far above that of places within 1e6 Å
    const Vec3d middle = motion.placed(box.getCenter()), half = 0.5 * box.extents();
    Vec3d reach(rounding);
    for (int k = 0; k < 3; ++k)
        for (int j = 0; j < 3; ++j)
            reach[k] += std::abs(motion.rotation[std::size_t(k)][std::size_t(j)]) * half[j];
    return {middle - reach, middle + reach};
}

/// The header of balls.
AtomsHeader headerOf(const BallSet& atoms, const GaussianExtent& extent)
{
    AtomsHeader header{atoms.balls.size(), copiesOf(atoms.placement), columns(atoms), extent, {},
                       std::nullopt};
    header.shared.record.model = atoms.record.model;
    header.shared.resolutions = atoms.resolutions;
    header.shared.coloring = atoms.coloring;
    if (!atoms.labels) return header;
    BallLabels& labels = header.shared.labels.emplace();
    labels.chains = atoms.labels->chains;
    labels.chainPlaces = atoms.labels->chainPlaces;
    labels.groups = atoms.labels->groups;
    if (!atoms.labels->values) return header;
    StoredValues& stored = header.values.emplace();
    stored.values = *atoms.labels->values;
    if (const ScalarMap* map = stored.values.field.get())
        stored.map = {map->origin,
                      map->spacing,
                      {std::uint32_t(map->counts[0]), std::uint32_t(map->counts[1]),
                       std::uint32_t(map->counts[2])},
                      checksumOfBytes(map->values.data(), 4 * map->values.size())};
    return header;
}

/// A ball by its part and the cell of its centre.
struct PlacedInCell {
    std::uint32_t part;
    Coord cell;
    std::uint32_t ball;

    bool operator<(const PlacedInCell& other) const
    {
        return std::tie(part, cell, ball) < std::tie(other.part, other.cell, other.ball);
    }
};

/// All balls in the order in which they are written.
std::vector<PlacedInCell> orderOf(const BallSet& atoms)
{
    const Placement& placement = atoms.placement;
    std::vector<PlacedInCell> order;
    order.reserve(atoms.balls.size());
    std::uint32_t part = 0;
    for (std::size_t i = 0; i < atoms.balls.size(); ++i) {
        while (placement.folded && i >= placement.begin[part + 1]) ++part;
        order.push_back({part, cellOf(atoms.balls[i].center), std::uint32_t(i)});
    }
    tbb::parallel_sort(order.begin(), order.end());
    return order;
}

} // namespace

std::string writeAtoms(const BallSet& atoms, const GaussianExtent& extent, OutputFile& file,
                       const Progress& progress)
{
    const std::vector<PlacedInCell> order = orderOf(atoms);
    stopIfCancelled(progress);

    file.write(atomsMark.data(), atomsMark.size());
    std::vector<AtomCell> cells;
    std::vector<Record> records;
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
        const auto [part, place, first] = order[begin];
        records.clear();
        for (; end < order.size() && order[end].cell == place && order[end].part == part; ++end)
            records.push_back(recordOf(atoms, order[end].ball));
        const std::size_t size = records.size() * sizeof(Record);
        cells.push_back({part,
                         {place.x(), place.y(), place.z()},
                         std::uint32_t(records.size()),
                         checksumOfBytes(records.data(), size)});
        file.write(records.data(), size);
    }
    Tail tail;
    if (atoms.labels && atoms.labels->values && atoms.labels->values->field) {
        const std::vector<float>& values = atoms.labels->values->field->values;
        tail.map = values.size() * sizeof(float);
        file.write(values.data(), tail.map);
    }
    const std::string header = jsonText(headerOf(atoms, extent), -1);
    tail.cells = cells.size() * sizeof(AtomCell);
    tail.header = header.size();
    std::string index(reinterpret_cast<const char*>(cells.data()), tail.cells);
    index += header;
    index.append(reinterpret_cast<const char*>(&tail), sizeof tail);
    file.write(index);
    file.finish();
    return index;
}

AtomsFile::AtomsFile(const std::string& path)
    : path_(path), file_(open(path.c_str(), O_RDONLY | O_CLOEXEC))
{
    if (!file_)
        throw Error(ErrorKind::Input,
                    "cannot read " + path + ": " + std::strerror(errno) +
                        " [hint: it has to lie beside the plan]",
                    mayPass(errno));
    const off_t end = lseek(file_.get(), 0, SEEK_END);
    try {
        readIndex(end < 0 ? 0 : std::uint64_t(end));
    } catch (const nlohmann::json::exception&) {
        refuse("its header cannot be read");
    } catch (const std::range_error& e) {
        refuse(std::string("its ") + e.what());
    }
}

void AtomsFile::refuse(const std::string& what) const
{
    throw Error(ErrorKind::Input, path_ + ": is no file of the atoms of a plan: " + what +
                                      " [hint: vdb_molsurf bricks plan writes one]");
}

void AtomsFile::readIndex(std::uint64_t size)
{
    Tail tail; // at the end; before it, backward: the header, the cells and the map
    if (size < atomsMark.size() + sizeof tail) refuse("it is too short");
    readAt(file_, path_, size - sizeof tail, &tail, sizeof tail);
    if (tail.mark == earlierMark) refuse("it is of an earlier version of the program");
    if (tail.mark != atomsMark) refuse("it does not end with MOLATM02");
    const std::uint64_t most = size - atomsMark.size() - sizeof tail;
    if (tail.map > most || tail.cells > most || tail.header > most ||
        tail.map + tail.cells + tail.header > most || tail.cells % sizeof(AtomCell) != 0)
        refuse("it is cut short");
    const std::uint64_t header = size - sizeof tail - tail.header, cells = header - tail.cells;
    index_.resize(size - cells);
    readAt(file_, path_, cells, index_.data(), index_.size());
    cells_.resize(tail.cells / sizeof(AtomCell));
    if (tail.cells > 0) std::memcpy(cells_.data(), index_.data(), tail.cells);
    std::uint64_t atoms = 0;
    for (const AtomCell& cell : cells_) atoms += cell.count;
    const auto h = JsonReader::valueOf<AtomsHeader>(
        nlohmann::json::parse(index_.substr(tail.cells, tail.header)));
    if (atoms == 0 || atoms > most / sizeof(Record) || atoms != h.atoms ||
        atoms * sizeof(Record) != most - tail.map - tail.cells - tail.header)
        refuse("its atoms are not as many as it says");
    motions_ = motionsOf(h.copies);
    for (const AtomCell& cell : cells_)
        if (cell.part >= motions_.size()) refuse("a cell is of no part");
    shared_ = h.shared;
    extent_ = h.extent;
    if (h.values) shared_.labels->values = h.values->values;
    if (shared_.labels && !shared_.labels->chainPlaces.empty() &&
        shared_.labels->chainPlaces.size() != shared_.labels->chains.size())
        refuse("its places of chains are none");
    markColumns(h.columns, shared_);
    if (h.values && h.values->map) readMap(*h.values->map, cells - tail.map, tail.map);
}

void AtomsFile::readMap(const StoredMap& stored, std::uint64_t at, std::uint64_t bytes)
{
    ScalarMap map;
    map.origin = stored.origin;
    map.spacing = stored.spacing;
    std::copy(stored.counts.begin(), stored.counts.end(), map.counts);
    if (double(map.counts[0]) * double(map.counts[1]) * double(map.counts[2]) * 4.0 !=
        double(bytes))
        refuse("its map is cut short");
    map.values.resize(bytes / sizeof(float));
    readAt(file_, path_, at, map.values.data(), bytes);
    if (checksumOfBytes(map.values.data(), bytes) != stored.checksum) refuse("its map is damaged");
    shared_.labels->values->field = std::make_shared<ScalarMap>(std::move(map));
}

void AtomsFile::readCell(const AtomCell& cell, std::uint64_t at, const openvdb::BBoxd& space,
                         const std::vector<const Motion*>& motions, BallSet& out) const
{
    std::vector<Record> records(cell.count);
    readAt(file_, path_, at, records.data(), records.size() * sizeof(Record));
    if (checksumOfBytes(records.data(), records.size() * sizeof(Record)) != cell.checksum)
        refuse("its checksum is another");
    for (const Motion* motion : motions) {
        for (const Record& r : records) {
            const Vec3d centre = motion->placed(Vec3d(r.x, r.y, r.z));
            if (space.isInside(centre) && !addBall(r, centre, shared_, out))
                refuse("it has a wrong index");
        }
    }
}

std::vector<const Motion*> AtomsFile::motionsInto(const openvdb::BBoxd& space,
                                                  const AtomCell& cell) const
{
    const Vec3d low = cellEdge * Vec3d(cell.place[0], cell.place[1], cell.place[2]);
    const openvdb::BBoxd box(low, low + Vec3d(cellEdge));
    std::vector<const Motion*> out;
    for (const Motion& motion : motions_[cell.part])
        if (space.hasOverlap(moved(box, motion))) out.push_back(&motion);
    return out;
}

BallSet AtomsFile::within(const openvdb::BBoxd& space) const
{
    constexpr double bytesPerBall = 100.0; // with its labels
    BallSet out = subset(shared_, {}, Counted::Whole);
    std::vector<std::vector<const Motion*>> motions;
    double most = 0.0;
    for (const AtomCell& cell : cells_) {
        motions.push_back(motionsInto(space, cell));
        most += double(cell.count) * double(motions.back().size());
    }
    needMemory(path_ + ": its atoms take", bytesPerBall * most, 0);
    std::uint64_t at = atomsMark.size();
    for (std::size_t c = 0; c < cells_.size(); ++c) {
        if (!motions[c].empty()) readCell(cells_[c], at, space, motions[c], out);
        at += std::uint64_t(cells_[c].count) * sizeof(Record);
    }
    checkFinite(out.balls);
    return out;
}

} // namespace molsurf
