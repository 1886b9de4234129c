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
#include "molsurf/show/io/json_number.h"

#include <nlohmann/json.hpp>
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

namespace
{

using Json = nlohmann::ordered_json;

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

Json json(const std::optional<std::array<std::uint8_t, 3>>& color)
{
    return color ? Json(*color) : Json();
}

Json json(const BallValues& values)
{
    Json out = {{"name", values.name},       {"title", values.title}, {"unit", values.unit},
                {"palette", values.palette}, {"low", values.low},     {"high", values.high},
                {"flat", values.flat}};
    if (values.centre) out["centre"] = {values.centre->x(), values.centre->y(), values.centre->z()};
    if (const ScalarMap* map = values.field.get()) {
        out["map"] = {{"origin", {map->origin.x(), map->origin.y(), map->origin.z()}},
                      {"spacing", {map->spacing.x(), map->spacing.y(), map->spacing.z()}},
                      {"counts", {map->counts[0], map->counts[1], map->counts[2]}},
                      {"checksum", checksumOfBytes(map->values.data(), 4 * map->values.size())}};
    }
    return out;
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
Json columns(const BallSet& atoms)
{
    Json names = Json::array();
    forEachColumn(atoms, [&](const char* name, const auto& column) {
        if (!column.empty()) names.push_back(name);
    });
    return names;
}

/// Gives one entry to each column that the header names, by which addBall() knows it.
/// @throws std::range_error if the rest of the header asks for one that it does not name
void markColumns(const Json& names, BallSet& atoms)
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

/// The copies of a folded set, one a row: its part, and its motion row by row.
Json copiesOf(const Placement& placement)
{
    Json rows = Json::array();
    if (!placement.folded) return rows;
    for (const Instance& copy : placement.instances) {
        Json row = {copy.part};
        for (std::size_t k = 0; k < 3; ++k) {
            for (const double entry : copy.rotation[k]) row.push_back(entry);
            row.push_back(copy.translation[int(k)]);
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

/// The motions of each part: where nothing is folded the only part stays where it is.
/// @throws std::range_error if a copy is none
std::vector<std::vector<Motion>> parseCopies(const Json& rows)
{
    if (rows.empty()) return {{Motion::identity()}};
    std::vector<std::vector<Motion>> motions;
    for (const Json& row : rows) {
        const std::size_t part = jsonNumber<std::uint32_t>(row.at(0));
        const auto numbers = jsonNumbers<double>(row);
        if (numbers.size() != 13 || part >= rows.size()) throw std::range_error("copies are none");
        if (part >= motions.size()) motions.resize(part + 1);
        Motion& motion = motions[part].emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            for (std::size_t j = 0; j < 3; ++j) motion.rotation[k][j] = numbers[1 + 4 * k + j];
            motion.translation[int(k)] = numbers[4 + 4 * k];
        }
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

/// The header: values that all balls share.
std::string headerText(const BallSet& atoms, const GaussianExtent& extent)
{
    Json resolutions = Json::array(), groups = Json::array();
    for (const ResolutionGroup& r : atoms.resolutions)
        resolutions.push_back({r.rule.select, r.rule.resolution, r.balls, r.level});
    Json out = {{"atoms", atoms.balls.size()},
                {"copies", copiesOf(atoms.placement)},
                {"columns", columns(atoms)},
                {"model", atoms.record.model},
                {"extent", {extent.maxRadius, extent.maxGrownRadius, extent.maxTolerance}},
                {"resolutions", std::move(resolutions)}};
    const Coloring& coloring = atoms.coloring;
    out["coloring"] = {
        {"range", coloring.range ? Json(*coloring.range) : Json()},
        {"palette", coloring.palette},
        {"by_residue", coloring.byResidue},
        {"flat", coloring.flat},
        {"outward", coloring.potentialOffset ? Json(*coloring.potentialOffset) : Json()}};
    if (atoms.labels) {
        const BallLabels& labels = *atoms.labels;
        for (const Group& g : labels.groups)
            groups.push_back({g.name, g.balls, json(g.color), g.place});
        out["chains"] = labels.chains;
        out["chain_places"] = labels.chainPlaces;
        out["groups"] = std::move(groups);
        if (labels.values) out["values"] = json(*labels.values);
    }
    return out.dump(-1, ' ', false, Json::error_handler_t::replace);
}

template<typename T>
std::optional<T> optional(const Json& json)
{
    return json.is_null() ? std::nullopt : std::optional<T>(json.get<T>());
}

Vec3d vector(const Json& json)
{
    const auto x = jsonNumbers<double>(json);
    if (x.size() != 3) throw std::range_error("places are none");
    return {x[0], x[1], x[2]};
}

BallValues parseValues(const Json& j)
{
    BallValues values;
    values.name = j.at("name");
    values.title = j.at("title");
    values.unit = j.at("unit");
    values.palette = j.at("palette");
    values.low = jsonNumber<double>(j.at("low"));
    values.high = jsonNumber<double>(j.at("high"));
    values.flat = j.at("flat");
    if (j.contains("centre")) values.centre = vector(j["centre"]);
    return values;
}

/// The lattice of a map, without its values.
ScalarMap parseMap(const Json& j)
{
    ScalarMap map;
    map.origin = vector(j.at("origin"));
    map.spacing = vector(j.at("spacing"));
    const auto counts = jsonNumbers<std::uint32_t>(j.at("counts"));
    if (counts.size() != 3) throw std::range_error("counts are none");
    std::copy(counts.begin(), counts.end(), map.counts);
    return map;
}

/// The opposite of headerText(), but for "columns", "extent" and the map.
BallSet parseHeader(const Json& j)
{
    BallSet out;
    out.record.model = jsonNumber<int>(j.at("model"));
    for (const Json& r : j.at("resolutions")) {
        out.resolutions.push_back({{r.at(0), jsonNumber<double>(r.at(1))},
                                   jsonNumber<std::size_t>(r.at(2)),
                                   jsonNumber<double>(r.at(3))});
    }
    const Json& coloring = j.at("coloring");
    out.coloring.range = optional<std::array<double, 2>>(coloring.at("range"));
    out.coloring.palette = coloring.at("palette");
    out.coloring.byResidue = coloring.at("by_residue");
    out.coloring.flat = coloring.at("flat");
    out.coloring.potentialOffset = optional<double>(coloring.at("outward"));
    if (!j.contains("chains")) return out;
    BallLabels& labels = out.labels.emplace();
    labels.chains = j["chains"].get<std::vector<std::string>>();
    labels.chainPlaces = jsonNumbers<std::int32_t>(j.at("chain_places"));
    if (!labels.chainPlaces.empty() && labels.chainPlaces.size() != labels.chains.size())
        throw std::range_error("places of chains are none");
    for (const Json& g : j.at("groups")) {
        labels.groups.push_back({g.at(0), jsonNumber<std::size_t>(g.at(1)),
                                 optional<std::array<std::uint8_t, 3>>(g.at(2)),
                                 jsonNumber<std::int32_t>(g.at(3))});
    }
    if (j.contains("values")) labels.values = parseValues(j["values"]);
    return out;
}

} // namespace

namespace
{

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
    const std::string header = headerText(atoms, extent);
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
    } catch (const Json::exception&) {
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
    const Json j = Json::parse(index_.substr(tail.cells, tail.header));
    if (atoms == 0 || atoms > most / sizeof(Record) ||
        atoms != jsonNumber<std::uint64_t>(j.at("atoms")) ||
        atoms * sizeof(Record) != most - tail.map - tail.cells - tail.header)
        refuse("its atoms are not as many as it says");
    motions_ = parseCopies(j.at("copies"));
    for (const AtomCell& cell : cells_)
        if (cell.part >= motions_.size()) refuse("a cell is of no part");
    shared_ = parseHeader(j);
    const Vec3d lengths = vector(j.at("extent"));
    extent_ = {lengths[0], lengths[1], lengths[2]};
    markColumns(j.at("columns"), shared_);
    if (!shared_.labels || !shared_.labels->values || !j["values"].contains("map")) return;
    ScalarMap map = parseMap(j["values"]["map"]);
    if (double(map.counts[0]) * double(map.counts[1]) * double(map.counts[2]) * 4.0 !=
        double(tail.map))
        refuse("its map is cut short");
    map.values.resize(tail.map / sizeof(float));
    readAt(file_, path_, cells - tail.map, map.values.data(), tail.map);
    if (checksumOfBytes(map.values.data(), tail.map) !=
        jsonNumber<std::uint32_t>(j["values"]["map"].at("checksum")))
        refuse("its map is damaged");
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
