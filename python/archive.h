// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Molecules and surfaces as bytes, for pickles. They are read by the same version of the module
/// alone; a damaged text is an error.

#include <molsurf/molecule/selection/point_charges.h>
#include <molsurf/molsurf.h>

#include <openvdb/io/Stream.h>

#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace molsurf::python
{

/// A sum of bytes that is another one if a byte changes (FNV-1a).
inline std::uint64_t sumOf(const char* bytes, std::size_t size)
{
    std::uint64_t sum = 0xcbf29ce484222325u;
    for (std::size_t i = 0; i < size; ++i)
        sum = (sum ^ static_cast<unsigned char>(bytes[i])) * 0x100000001b3u;
    return sum;
}

/// Appends values to a text.
class Packer
{
public:
    template<typename... T>
    void operator()(const T&... values)
    {
        (add(values), ...);
    }
    /// The text, with its sum at the end.
    std::string take()
    {
        const std::uint64_t sum = sumOf(bytes_.data(), bytes_.size());
        raw(&sum, sizeof sum);
        return std::move(bytes_);
    }

private:
    void raw(const void* data, std::size_t size)
    {
        bytes_.append(static_cast<const char*>(data), size);
    }
    void add(const std::string& text)
    {
        add(std::uint64_t(text.size()));
        raw(text.data(), text.size());
    }
    template<typename T>
    void add(const std::vector<T>& values)
    {
        add(std::uint64_t(values.size()));
        if constexpr (std::is_trivially_copyable_v<T>)
            raw(values.data(), values.size() * sizeof(T));
        else
            for (const T& value : values) add(value);
    }
    template<typename T>
    void add(const std::optional<T>& value)
    {
        add(value.has_value());
        if (value) add(*value);
    }
    template<typename T>
    void add(const std::shared_ptr<const T>& value)
    {
        add(bool(value));
        if (value) add(*value);
    }
    template<typename A, typename B>
    void add(const std::pair<A, B>& both)
    {
        (*this)(both.first, both.second);
    }
    template<typename T>
    void add(const T& value)
    {
        if constexpr (std::is_trivially_copyable_v<T>)
            raw(&value, sizeof value);
        else
            members(*this, value);
    }

    std::string bytes_;
};

/// Reads what Packer wrote. The sum keeps out whatever else a text may hold: numbers of atoms that
/// are not there, flags that are neither 0 nor 1, grids that would take any memory.
class Unpacker
{
public:
    /// @throws std::invalid_argument if the text is not as it was written
    Unpacker(const char* data, std::size_t size) : at_(data), left_(size)
    {
        std::uint64_t sum = 0;
        if (size < sizeof sum) throw std::invalid_argument("the pickle is damaged");
        left_ -= sizeof sum;
        std::memcpy(&sum, data + left_, sizeof sum);
        if (sum != sumOf(data, left_)) throw std::invalid_argument("the pickle is damaged");
    }

    template<typename... T>
    void operator()(T&... values)
    {
        (get(values), ...);
    }
    bool done() const { return left_ == 0; }

private:
    void raw(void* data, std::size_t size)
    {
        if (size > left_) throw std::invalid_argument("the pickle is damaged");
        if (size > 0) std::memcpy(data, at_, size);
        at_ += size;
        left_ -= size;
    }
    /// A number of things that take at least so many bytes each.
    std::size_t count(std::size_t least)
    {
        std::uint64_t n = 0;
        raw(&n, sizeof n);
        if (n > left_ / least) throw std::invalid_argument("the pickle is damaged");
        return std::size_t(n);
    }
    void get(std::string& text)
    {
        text.resize(count(1));
        raw(text.data(), text.size());
    }
    template<typename T>
    void get(std::vector<T>& values)
    {
        if constexpr (std::is_trivially_copyable_v<T>) {
            values.resize(count(sizeof(T)));
            raw(values.data(), values.size() * sizeof(T));
        } else {
            values.resize(count(1));
            for (T& value : values) get(value);
        }
    }
    template<typename T>
    void get(std::optional<T>& value)
    {
        bool there = false;
        get(there);
        value.reset();
        if (there) get(value.emplace());
    }
    template<typename T>
    void get(std::shared_ptr<const T>& value)
    {
        bool there = false;
        get(there);
        if (!there) return value.reset();
        T read;
        get(read);
        value = std::make_shared<const T>(std::move(read));
    }
    template<typename A, typename B>
    void get(std::pair<A, B>& both)
    {
        (*this)(both.first, both.second);
    }
    template<typename T>
    void get(T& value)
    {
        if constexpr (std::is_trivially_copyable_v<T>)
            raw(&value, sizeof value);
        else
            members(*this, value);
    }

    const char* at_;
    std::size_t left_;
};

// The members of each type that is not copied byte by byte. V is const or not.
#define MOLSURF_MEMBERS(Type, ...)                                                                 \
    template<typename A>                                                                           \
    void members(A& archive, const Type& v)                                                        \
    {                                                                                              \
        archive(__VA_ARGS__);                                                                      \
    }                                                                                              \
    template<typename A>                                                                           \
    void members(A& archive, Type& v)                                                              \
    {                                                                                              \
        archive(__VA_ARGS__);                                                                      \
    }

MOLSURF_MEMBERS(ResolutionRule, v.select, v.resolution)
MOLSURF_MEMBERS(ResolutionGroup, v.rule, v.balls, v.level)
MOLSURF_MEMBERS(Excluded, v.reason, v.count)
MOLSURF_MEMBERS(Instance, v.part, v.name, v.rotation, v.translation)
MOLSURF_MEMBERS(Placement::Unit, v.pointGroup, v.centre, v.copies, v.deviation, v.product,
                v.inverse)
MOLSURF_MEMBERS(Placement, v.copies, v.begin, v.numbers, v.instances, v.unit, v.around, v.motionOf)
MOLSURF_MEMBERS(Group, v.name, v.balls, v.color, v.place)
MOLSURF_MEMBERS(BallValues, v.name, v.title, v.unit, v.palette, v.low, v.high, v.centre, v.valueOf,
                v.flat)
MOLSURF_MEMBERS(Coloring, v.range, v.palette, v.byResidue, v.flat, v.potentialOffset)
MOLSURF_MEMBERS(BallLabels, v.chainOf, v.chains, v.groupOf, v.groups, v.colorGroups, v.colorGroupOf,
                v.elementOf, v.residueClassOf, v.values, v.patchValues, v.warnings, v.chainColors,
                v.chainPlaces)
MOLSURF_MEMBERS(BallNames::Residue, v.chain, v.labelChain, v.name, v.number, v.insertionCode,
                v.hetatm)
MOLSURF_MEMBERS(BallNames::Atom, v.name, v.altloc, v.element, v.occupancy)
MOLSURF_MEMBERS(BallNames, v.residues, v.residueOf, v.atoms)
MOLSURF_MEMBERS(PointCharge, v.position, v.charge, v.radius, v.atom, v.residue, v.chain, v.number)
MOLSURF_MEMBERS(PointCharges, v.atoms)
MOLSURF_MEMBERS(SelectionRecord, v.input, v.isFile, v.drops, v.beads, v.beadAtoms, v.radii, v.model,
                v.membrane, v.warnings)
MOLSURF_MEMBERS(BallSet, v.balls, v.decays, v.resolutions, v.resolutionOf, v.placement, v.labels,
                v.names, v.charges, v.colors, v.coloring, v.record)
MOLSURF_MEMBERS(SearchPlaces, v.pocketAt, v.pore, v.tunnelsFrom)
MOLSURF_MEMBERS(SearchPlaces::PoreWay, v.ends, v.axis)
MOLSURF_MEMBERS(Attribute<float>, v.name, v.values, v.names)
MOLSURF_MEMBERS(Attribute<std::int32_t>, v.name, v.values, v.names)
MOLSURF_MEMBERS(MeshPart, v.name, v.firstTriangle)
MOLSURF_MEMBERS(Mesh, v.positions, v.normals, v.triangles, v.scalars, v.labels, v.colors, v.parts)
MOLSURF_MEMBERS(SurfaceReport::Shape, v.leastAngle, v.below20, v.below28, v.shortestEdge,
                v.longestEdge, v.keptPieces, v.eulerNumbers)
MOLSURF_MEMBERS(SurfaceReport, v.kind, v.area, v.volume, v.eulerCharacteristic,
                v.meshEulerCharacteristic, v.meshArea, v.meshVolume, v.meshComponents,
                v.triangleArea, v.piecesKnown, v.components, v.cavities, v.outerArea, v.outerVolume,
                v.vertices, v.triangles, v.closed, v.manifold, v.degenerateTriangles, v.maxResidual,
                v.gradientShare, v.kinkShare, v.cuspLength, v.meanCurvature, v.gaussianCurvature,
                v.integrals, v.shape)
MOLSURF_MEMBERS(EvolutionReport::Gaps, v.found, v.closed, v.nearest, v.closedByField,
                v.widestClosed, v.opensBelow)
MOLSURF_MEMBERS(EvolutionReport, v.steps, v.converged, v.energy, v.area, v.volume,
                v.meanDisplacement, v.maxSpeed, v.displacementRms, v.displacementTail,
                v.toleranceMet, v.areaError, v.unsettledShare, v.finalEnergy, v.unresolvedGapVoxels,
                v.frontSteps, v.restlessFronts, v.gaps, v.walls)
MOLSURF_MEMBERS(Report::Group, v.name, v.atoms, v.area, v.volume, v.color, v.aloneArea)
MOLSURF_MEMBERS(Report::Interface, v.first, v.second, v.area, v.count, v.fit, v.buried)
MOLSURF_MEMBERS(Report::Pockets::Pocket, v.volume, v.area, v.depth, v.radius, v.centre, v.open,
                v.mouths, v.rank, v.neighbours, v.lining)
MOLSURF_MEMBERS(Report::Pockets, v.probeIn, v.probeOut, v.cut, v.neck, v.voxel, v.list, v.isChosen)
MOLSURF_MEMBERS(Report::Patches::Patch, v.area, v.integral, v.centre, v.parts)
MOLSURF_MEMBERS(Report::Patches, v.value, v.above, v.level, v.list)
MOLSURF_MEMBERS(Report::Pore::Station, v.place, v.normal, v.distance, v.radius, v.isBottleneck,
                v.lining)
MOLSURF_MEMBERS(Report::Pore::Way, v.radius, v.place)
MOLSURF_MEMBERS(Report::Pore, v.axis, v.stations, v.crossed, v.bundle, v.others)
MOLSURF_MEMBERS(Report::Tunnels::Tunnel, v.number, v.stations)
MOLSURF_MEMBERS(Report::Tunnels, v.start, v.startRadius, v.probe, v.probeOut, v.list)
MOLSURF_MEMBERS(Report::Resolution, v.select, v.resolution, v.atoms, v.level)
MOLSURF_MEMBERS(Report::Part, v.name, v.atoms, v.surface)
MOLSURF_MEMBERS(Report::Copy, v.part, v.name, v.matrix)
MOLSURF_MEMBERS(Report::Symmetry, v.pointGroup, v.order, v.copies, v.deviation, v.gap,
                v.openVertices)
MOLSURF_MEMBERS(Report, v.program, v.version, v.command, v.input, v.atoms, v.voxel, v.center,
                v.surface, v.coarse, v.resolutions, v.groups, v.interfaces, v.pockets, v.patches,
                v.pore, v.tunnels, v.parts, v.instances, v.symmetry, v.evolution, v.activeVoxels,
                v.gridBytes, v.seconds, v.peakMemoryBytes, v.threads, v.warnings, v.areasOf,
                v.polarArea, v.apolarArea, v.measures)

#undef MOLSURF_MEMBERS

/// Grids as the text of a stream of OpenVDB, but for its random identifier: pickles of equal
/// surfaces are equal.
inline std::string packGrids(const openvdb::GridCPtrVec& grids)
{
    std::ostringstream out(std::ios::binary);
    openvdb::io::Stream stream(out);
    stream.write(grids);
    constexpr std::size_t identifierPlace = 21, letters = 36;
    return out.str().replace(identifierPlace, letters, "00000000-0000-0000-0000-000000000000");
}

inline openvdb::GridPtrVec unpackGrids(const std::string& bytes)
{
    std::istringstream in(bytes, std::ios::binary);
    return *openvdb::io::Stream(in, false).getGrids();
}

} // namespace molsurf::python
