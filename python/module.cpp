// SPDX-License-Identifier: MPL-2.0
// The module vdb_molsurf._core: the face of the library for the Python part of the package, which
// checks arguments and gives them their types.

#include "archive.h"
#include "arrays.h"
#include "signals.h"

#include <molsurf/molecule/selection/shown_atoms.h>
#include <molsurf/molecule/structure/sha256.h>
#include <molsurf/request/identity.h>
#include <molsurf/request/request_table.h>
#include <molsurf/request/resolve.h>

#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <tuple>

namespace molsurf::python
{

using openvdb::Vec3d;

namespace
{

/// Names of settings and their values, as people would type them.
using Given = std::vector<std::pair<std::string, std::vector<std::string>>>;

Settings settingsOf(const Given& given)
{
    Settings settings;
    for (const auto& [name, values] : given)
        for (const Setting& row : settingTable())
            if (row.name == name) row.set(settings, values);
    return settings;
}

using GroupWords = std::vector<std::pair<std::string, std::string>>;

/// Atoms, with what they were asked for.
struct Molecule {
    std::shared_ptr<BallSet> atoms;
    std::string source;                              ///< the name of the file
    std::shared_ptr<const molsurf::Molecule> file{}; ///< null: of a pickle
    GroupWords groups{};
    SearchPlaces places{}; ///< that read() was asked for
};

/// A surface, with all that it was made from.
struct MadeSurface {
    MolecularSurface result;
    std::shared_ptr<BallSet> atoms;
    SurfaceOptions options;
    std::vector<std::int32_t> atom;                  ///< of each vertex, its place in `atoms`
    std::shared_ptr<const molsurf::Molecule> file{}; ///< of the atoms; null: there is none
    SelectOptions select{};                          ///< that the atoms were chosen by
    std::shared_ptr<const SurfaceDistance> distance{};
};

std::array<PyObject*, 5> errorTypes; ///< by ErrorKind

/// A message with names as Python has them: `maxSteps` becomes `max_steps`.
std::string withKeywords(const std::string& message)
{
    std::string out;
    bool inside = false;
    for (const char letter : message) {
        inside = inside != (letter == '`');
        const bool capital = inside && letter >= 'A' && letter <= 'Z';
        if (capital) out += '_';
        out += capital ? char(letter - 'A' + 'a') : letter;
    }
    for (const auto& [from, to] : {std::pair("`surface`", "`kind`"), {"`lambda`", "`lambda_`"}})
        for (std::size_t at = 0; (at = out.find(from, at)) != std::string::npos;)
            out.replace(at, std::strlen(from), to);
    return out;
}

void translate(const std::exception_ptr& thrown, void*)
{
    try {
        std::rethrow_exception(thrown);
    } catch (const Error& e) {
        PyObject* const type = errorTypes[std::size_t(e.kind())];
        const nb::object error = nb::handle(type)(withKeywords(e.what()));
        error.attr("may_pass") = e.mayPass();
        PyErr_SetObject(type, error.ptr());
    }
}

void addErrors(nb::module_& m)
{
    const std::pair<const char*, PyObject*> kinds[] = {{"OptionError", PyExc_ValueError},
                                                       {"InputError", PyExc_ValueError},
                                                       {"NumericError", PyExc_ArithmeticError},
                                                       {"OutputError", PyExc_OSError},
                                                       {"CheckError", PyExc_RuntimeError}};
    for (std::size_t k = 0; k < errorTypes.size(); ++k) {
        const std::string name = std::string("vdb_molsurf.") + kinds[k].first;
        nb::dict members;
        members["may_pass"] = false;
        errorTypes[k] = PyErr_NewException(name.c_str(), kinds[k].second, members.ptr());
        m.attr(kinds[k].first) = nb::handle(errorTypes[k]);
    }
    nb::register_exception_translator(translate, nullptr);
}

nb::list describeSettings()
{
    const char* types[] = {"switch", "whole", "number", "text", "word", "list", "rules"};
    const char* parts[] = {"balls", "molecule", "surface"};
    nb::list out;
    for (const Setting& row : settingTable()) {
        nb::dict one;
        one["name"] = row.name;
        one["type"] = types[std::size_t(row.type)];
        one["text"] = withKeywords(row.text);
        one["value"] = row.value ? row.value : ""; // what the text calls it: "L"
        one["preset"] = row.preset;
        one["words"] = row.words;
        one["low"] = row.low;
        one["high"] = row.high;
        one["of"] = parts[std::size_t(row.of)];
        one["default"] = row.get                           ? nb::cast(row.get(Settings()))
                         : row.type == SettingType::Switch ? nb::cast(false)
                                                           : nb::none();
        out.append(one);
    }
    return out;
}

/// Names that options had before, and theirs of today.
nb::dict formerNames()
{
    nb::dict out;
    for (const OptionRow<Request>& row : requestTable())
        if (row.former) out[row.former] = row.name;
    return out;
}

Settings settingsOf(const Given& given, const GroupWords& groups)
{
    Settings settings = settingsOf(given);
    for (const auto& [group, select] : groups)
        settings.labels.groups.push_back({group, select, {}});
    resolveGroups(settings);
    if (settings.colorGroups) { // of copies, too
        settings.labels.groupBy = settings.colorGroups;
        settings.options.color = ColorBy::Group;
    }
    return settings;
}

Molecule readMolecule(const std::string& name, const std::optional<nb::bytes>& content,
                      const Given& given, const GroupWords& groups, const How& how)
{
    const Settings settings = settingsOf(given, groups);
    checkOptions(settings.atoms);
    checkOptions(settings.places);
    checkOptions(settings.labels);
    const ReadLimits& limits = settings.atoms.limits;
    FileContent bytes{name, content ? std::string(content->c_str(), content->size()) : ""};
    Molecule out{nullptr, name, nullptr, groups};
    run(how, [&](const Progress& progress) {
        out.file = std::make_shared<const molsurf::Molecule>(
            content ? molsurf::Molecule(std::move(bytes), progress, limits)
                    : molsurf::Molecule(name, progress, limits));
        out.atoms = std::make_shared<BallSet>(
            out.file->balls(settings.atoms, settings.labels, probeOf(settings.options), progress));
        out.places = out.file->places(settings.places, *out.atoms);
        return 0;
    });
    return out;
}

[[noreturn]] void failWithoutFile(const char* what)
{
    throw Error(ErrorKind::Usage, std::string(what) + ": expected a molecule that read() made, got "
                                                      "one of a pickle, which has no file");
}

/// The file of atoms, with these where they are now.
molsurf::Molecule movedTo(const BallSet& now, const molsurf::Molecule& file)
{
    std::vector<std::int32_t> atoms;
    std::vector<Vec3d> places;
    for (const Ball& ball : now.balls) {
        atoms.push_back(ball.atom);
        places.push_back(ball.center);
    }
    return file.moved(atoms, places);
}

/// The same atoms, where they are now, with other labels and places.
/// @param[in] settings  as of read(), with what is asked for
std::pair<std::shared_ptr<BallSet>, SearchPlaces> asked(const Molecule& molecule,
                                                        const Settings& settings, const How& how)
{
    if (!molecule.file) failWithoutFile("surface");
    const BallSet& now = *molecule.atoms;
    const double probe = probeOf(settings.options);
    return run(how, [&](const Progress& progress) {
        const auto ballsOf = [&](const molsurf::Molecule& file) {
            return file.balls(settings.atoms, settings.labels, probe, progress);
        };
        auto out = std::make_shared<BallSet>(ballsOf(*molecule.file));
        bool moved = false;
        for (std::size_t i = 0; i < now.balls.size(); ++i)
            moved |= now.balls[i].center != out->balls[i].center;
        if (moved && now.placement.copies > 1)
            throw Error(ErrorKind::Usage, "surface: expected copies of an assembly where the file "
                                          "has them, got others [hint: ask read() for it]");
        const molsurf::Molecule file = moved ? movedTo(now, *molecule.file) : *molecule.file;
        if (moved) *out = ballsOf(file);
        for (std::size_t i = 0; i < now.balls.size(); ++i)
            out->balls[i].radius = now.balls[i].radius;
        const SearchPlaces found = file.places(settings.places, *out);
        return std::pair(out, found);
    });
}

/// The places in `atoms` of those that a selection takes.
std::vector<std::int32_t> selected(const Molecule& molecule, const std::string& selection)
{
    if (!molecule.file) failWithoutFile("select");
    std::set<std::size_t> taken;
    for (const std::size_t atom : molecule.file->select(selection)) taken.insert(atom);
    std::vector<std::int32_t> out;
    for (std::size_t i = 0; i < molecule.atoms->own(); ++i)
        if (taken.count(std::size_t(molecule.atoms->balls[i].atom)) > 0)
            out.push_back(std::int32_t(i));
    return out;
}

/// The atoms that a selection takes, used or not, where they are now.
BallSet atomsOf(const MadeSurface& surface, const std::string& selection)
{
    if (!surface.file)
        throw Error(ErrorKind::Usage,
                    "label, ruler and zoom: expected places (x, y, z) for a surface "
                    "that is not of a molecule of read(), got " +
                        selection);
    const BallSet& now = *surface.atoms;
    const bool one = now.placement.copies == 1 && now.record.beads == 0;
    const molsurf::Molecule file = one ? movedTo(now, *surface.file) : *surface.file;
    return file.balls(besideSurface(surface.select, selection));
}

/// The middle of the atoms that a selection takes, and the name of their residue.
nb::tuple placeOf(const MadeSurface& surface, const std::string& selection)
{
    const BallSet atoms = atomsOf(surface, selection);
    const Vec3d middle = middleOf(atoms);
    const BallNames::Residue& first = atoms.names->residues[0];
    const std::string code(first.insertionCode == ' ' ? 0 : 1, first.insertionCode);
    return nb::make_tuple(nb::make_tuple(middle[0], middle[1], middle[2]),
                          first.chain + " " + first.name + " " + std::to_string(first.number) +
                              code);
}

/// Makes labels of atoms, which count places in the BallSet, those of the file.
/// @return the labels as they were
std::vector<std::int32_t> takeAtoms(const std::vector<std::int32_t>& fileIds,
                                    MolecularSurface& result)
{
    const auto idOf = [&](std::int32_t atom) {
        return atom < 0 ? atom : fileIds[std::size_t(atom)];
    };
    std::vector<std::int32_t> places;
    for (Attribute<std::int32_t>& label : result.mesh.labels) {
        if (label.name != "atom_id") continue;
        places = label.values;
        for (std::int32_t& atom : label.values) atom = idOf(atom);
    }
    for (const openvdb::GridBase::Ptr& grid : result.fields)
        if (const auto ids = openvdb::gridPtrCast<openvdb::Int32Grid>(grid);
            ids && grid->getName() == "atom_id")
            for (auto voxel = ids->beginValueOn(); voxel; ++voxel) voxel.setValue(idOf(*voxel));
    return places;
}

/// The balls of the unit that those around it are images of.
std::vector<std::int32_t> imagesOf(const BallSet& atoms)
{
    if (atoms.placement.around == 0) return {};
    std::multimap<std::int32_t, std::size_t> own;
    for (std::size_t i = 0; i < atoms.own(); ++i) own.emplace(atoms.balls[i].atom, i);
    std::vector<std::int32_t> out;
    for (std::size_t i = atoms.own(); i < atoms.balls.size(); ++i) {
        const Instance& motion =
            atoms.placement.instances[std::size_t(atoms.placement.motionOf[i])];
        const auto same = own.equal_range(atoms.balls[i].atom);
        double least = std::numeric_limits<double>::infinity();
        out.push_back(-1);
        for (auto one = same.first; one != same.second; ++one) {
            const double apart = (motion.placed(Vec3d(atoms.balls[one->second].center)) -
                                  Vec3d(atoms.balls[i].center))
                                     .lengthSqr();
            if (apart >= least) continue;
            least = apart;
            out.back() = std::int32_t(one->second);
        }
    }
    return out;
}

/// @param[in] balls  the surface's own, which are kept
MadeSurface surfaceOf(std::shared_ptr<BallSet> balls, const std::string& source,
                      const SurfaceOptions& options, const How& how)
{
    MadeSurface out;
    out.options = options;
    std::vector<std::int32_t> fileIds;
    for (std::size_t i = 0; i < balls->balls.size(); ++i) {
        fileIds.push_back(balls->balls[i].atom);
        balls->balls[i].atom = std::int32_t(i);
    }
    out.result = run(how, [&](Progress& progress) {
        checkMemory(*balls, options, 0, progress);
        MolecularSurface made = makeSurface(*balls, options, &progress);
        out.atom = takeAtoms(fileIds, made);
        return made;
    });
    for (std::size_t i = 0; i < fileIds.size(); ++i) balls->balls[i].atom = fileIds[i];
    out.atoms = std::move(balls);
    const auto own = std::int32_t(out.atoms->own());
    const std::vector<std::int32_t> images = imagesOf(*out.atoms);
    for (std::int32_t& atom : out.atom)
        if (atom >= own) atom = images[std::size_t(atom - own)];
    Report& report = out.result.report;
    report.input = source;
    report.voxel = options.grid ? options.voxel : 0.0;
    report.warnings.insert(report.warnings.begin(), out.atoms->record.warnings.begin(),
                           out.atoms->record.warnings.end());
    for (std::string& warning : report.warnings) warning = withKeywords(warning);
    report.threads =
        how.threads > 0
            ? how.threads
            : int(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
    return out;
}

/// Options of the surface of a molecule.
/// @param[in] extra  switches that have no row
SurfaceOptions optionsOf(SurfaceOptions options, const std::vector<std::string>& extra,
                         const std::string& areasOf)
{
    options.energy = false;
    for (const std::string& name : extra) {
        if (name == "atom_areas") options.ballAreas = true;
        if (name == "no_grid") options.grid = false;
    }
    if (!areasOf.empty()) options.areasOf = settingsOf({{"surface", {areasOf}}}).options.kind;
    return options;
}

/// Adds the warnings of settings to those of a surface.
void addWarnings(const Settings& settings, const Given& given, Report& report)
{
    const auto isGiven = [&](const char* name) {
        return std::any_of(given.begin(), given.end(),
                           [&](const auto& one) { return one.first == name; });
    };
    for (const std::string& warning : settingWarnings(settings, isGiven))
        report.warnings.push_back(withKeywords(warning));
}

nb::tuple pairsOf(std::vector<ContactArea>&& contacts)
{
    std::vector<std::array<std::int32_t, 2>> pairs;
    std::vector<double> areas, distances;
    for (const ContactArea& contact : contacts) {
        pairs.push_back({std::int32_t(contact.balls[0]), std::int32_t(contact.balls[1])});
        areas.push_back(contact.area);
        distances.push_back(contact.distance);
    }
    return nb::make_tuple(owned<std::int32_t>(std::move(pairs)), owned<double>(std::move(areas)),
                          owned<double>(std::move(distances)));
}

/// Points and pairs have no atom of their own in copies.
void checkWhole(const MadeSurface& surface, const char* what)
{
    if (!surface.atoms->placement.isWhole())
        throw Error(ErrorKind::Usage, std::string(what) +
                                          ": expected a surface of all its atoms [hint: without "
                                          "by_symmetry and instances]");
}

nb::tuple distancesOf(MadeSurface& surface, const Positions& positions, const How& how)
{
    checkWhole(surface, "distance");
    std::vector<Vec3d> points;
    for (std::size_t i = 0; i < positions.shape(0); ++i)
        points.emplace_back(positions.data() + 3 * i);
    std::vector<double> distance;
    std::vector<Vec3d> closest, normal;
    std::vector<std::int32_t> atom;
    auto to = surface.distance;
    const auto found = run(how, [&](Progress& progress) {
        if (!to) {
            to = std::make_shared<SurfaceDistance>(*surface.atoms, surface.options, surface.result,
                                                   progress);
        }
        return to->at(points, progress);
    });
    surface.distance = to;
    for (const PointDistance& d : found) {
        distance.push_back(d.distance);
        closest.push_back(d.closest);
        normal.push_back(d.normal);
        atom.push_back(d.ball);
    }
    return nb::make_tuple(owned<double>(std::move(distance)), owned<double>(std::move(closest)),
                          owned<double>(std::move(normal)), owned<std::int32_t>(std::move(atom)));
}

/// Derivatives of volume and area by the atoms' places, and the numbers of atoms beside gaps and
/// beside ridges.
nb::tuple gradientsOf(MadeSurface& surface, const How& how)
{
    checkWhole(surface, "forces");
    MolecularSurface::Gradients found = run(how, [&](Progress& progress) {
        return surfaceGradients(*surface.atoms, surface.options, surface.result.mesh, progress);
    });
    const auto marked = [](const std::vector<char>& marks) {
        return std::count(marks.begin(), marks.end(), 1);
    };
    const auto gaps = marked(found.besideGap), ridges = marked(found.besideRidge);
    return nb::make_tuple(owned<double>(std::move(found.volume)),
                          owned<double>(std::move(found.area)), gaps, ridges);
}

/// Finds the contacts that a table shows, unless the surface has them.
void needContacts(MadeSurface& surface)
{
    if (!surface.result.contacts.empty()) return;
    checkWhole(surface, "contacts");
    surface.result.contacts = run(How(), [&](Progress& p) {
        return contactAreas(surface.atoms->balls, probeOf(surface.options), p);
    });
}

nb::dict tableOf(MadeSurface& surface, const std::string& name, const std::string& level)
{
    const BallSet& atoms = *surface.atoms;
    MolecularSurface& result = surface.result;
    const double probe = probeOf(surface.options);
    if (name == "atoms") return dictOf(atomTable(atoms, result));
    if (name == "residues") return dictOf(residueTable(atoms, probe, result));
    if (name == "interfaces") return dictOf(interfaceTable(atoms, result.report));
    if (name == "pockets") {
        if (!result.report.pockets)
            throw Error(ErrorKind::Usage, "table: expected a surface with `pockets`, got none");
        return dictOf(result.report.pockets->table(atoms));
    }
    if (name == "patches") {
        if (!result.report.patches)
            throw Error(ErrorKind::Usage, "table: expected a surface with `patches`, got none");
        return dictOf(result.report.patches->table(atoms));
    }
    if (name == "pore") {
        if (!result.report.pore)
            throw Error(ErrorKind::Usage, "table: expected a surface with `pore`, got none");
        return dictOf(result.report.pore->table(atoms));
    }
    if (name == "tunnels") {
        if (!result.report.tunnels)
            throw Error(ErrorKind::Usage, "table: expected a surface with `tunnelsFrom`, got none");
        return dictOf(result.report.tunnels->table(atoms));
    }
    needContacts(surface);
    for (const ContactLevel one : {ContactLevel::Atom, ContactLevel::Chain})
        if (level == nameOf(one)) return dictOf(contactTable(atoms, one, result));
    return dictOf(contactTable(atoms, ContactLevel::Residue, result));
}

/// The columns of atoms that are texts and numbers; empty without names.
nb::dict namesOf(const BallSet& atoms)
{
    nb::dict out;
    if (!atoms.names) return out;
    std::vector<std::string> name, residue, chain, altloc, code;
    std::vector<std::int32_t> number, index, id;
    std::vector<std::int32_t> element;
    for (std::size_t i = 0; i < atoms.own(); ++i) {
        const BallNames::Atom& atom = atoms.names->atoms[i];
        const BallNames::Residue& r = atoms.names->residues[std::size_t(atoms.names->residueOf[i])];
        name.push_back(atom.name);
        altloc.push_back(atom.altloc == '\0' ? "" : std::string(1, atom.altloc));
        element.push_back(atom.element);
        residue.push_back(r.name);
        chain.push_back(r.chain);
        code.push_back(r.insertionCode == ' ' ? "" : std::string(1, r.insertionCode));
        number.push_back(r.number);
        index.push_back(atoms.names->residueOf[i]);
        id.push_back(atoms.balls[i].atom);
    }
    out["atom"] = name;
    out["altloc"] = altloc;
    out["element"] = owned<std::int32_t>(std::move(element));
    out["residue"] = residue;
    out["chain"] = chain;
    out["insertion_code"] = code;
    out["number"] = owned<std::int32_t>(std::move(number));
    out["residue_index"] = owned<std::int32_t>(std::move(index));
    out["atom_id"] = owned<std::int32_t>(std::move(id));
    return out;
}

nb::bytes bytesOf(const std::string& text)
{
    return nb::bytes(text.data(), text.size());
}

nb::bytes pack(const BallSet& atoms, const std::string& source, const SearchPlaces& places)
{
    if (atoms.labels && atoms.labels->values && atoms.labels->values->field)
        throw nb::type_error("atoms with the values of a map cannot be pickled");
    Packer packer;
    packer(std::string(MOLSURF_VERSION), source, atoms, places);
    return bytesOf(packer.take());
}

void checkVersion(const std::string& version)
{
    if (version != MOLSURF_VERSION)
        throw nb::value_error(
            ("the pickle is of version " + version.substr(0, 20) + ", expected " MOLSURF_VERSION)
                .c_str());
}

Molecule unpackMolecule(const nb::bytes& bytes)
{
    Unpacker unpacker(bytes.c_str(), bytes.size());
    std::string version;
    unpacker(version);
    checkVersion(version);
    Molecule out{std::make_shared<BallSet>(), ""};
    unpacker(out.source, *out.atoms, out.places);
    return out;
}

nb::bytes packSurface(const MadeSurface& surface)
{
    const MolecularSurface& result = surface.result;
    const openvdb::GridPtrVec all = result.grids();
    const openvdb::GridCPtrVec grids(all.begin(), all.end());
    Packer packer;
    const nb::bytes atoms = pack(*surface.atoms, "", {});
    packer(std::string(MOLSURF_VERSION), std::string(atoms.c_str(), atoms.size()), result.mesh,
           result.shared, result.ballAreas, result.ballValues, result.contacts, result.report,
           surface.atom, bool(result.surface), grids.empty() ? std::string() : packGrids(grids));
    return bytesOf(packer.take());
}

/// @param[in] options  that it was made with
MadeSurface unpackSurface(const nb::bytes& bytes, const SurfaceOptions& options)
{
    Unpacker unpacker(bytes.c_str(), bytes.size());
    std::string version, atoms, grids;
    unpacker(version);
    checkVersion(version);
    MadeSurface out;
    MolecularSurface& result = out.result;
    bool first = false;
    unpacker(atoms, result.mesh, result.shared, result.ballAreas, result.ballValues,
             result.contacts, result.report, out.atom, first, grids);
    out.atoms = unpackMolecule(bytesOf(atoms)).atoms;
    out.options = options;
    if (!grids.empty())
        for (const openvdb::GridBase::Ptr& grid : unpackGrids(grids)) result.fields.push_back(grid);
    if (first && !result.fields.empty()) {
        result.surface = openvdb::gridPtrCast<openvdb::FloatGrid>(result.fields.front());
        result.fields.erase(result.fields.begin());
    }
    return out;
}

/// A mesh of arrays.
Mesh meshOf(const Floats3& vertices, const Whole3& faces)
{
    Mesh mesh;
    for (std::size_t i = 0; i < vertices.shape(0); ++i)
        mesh.positions.emplace_back(vertices.data() + 3 * i);
    for (std::size_t i = 0; i < faces.shape(0); ++i) {
        const std::int32_t* t = faces.data() + 3 * i;
        mesh.triangles.push_back({std::uint32_t(t[0]), std::uint32_t(t[1]), std::uint32_t(t[2])});
    }
    return mesh;
}

nb::dict dictOf(Comparison::OneWay&& way)
{
    nb::dict out;
    out["distance"] = owned<float>(std::move(way.distance));
    out["signed_distance"] = owned<float>(std::move(way.signedDistance));
    out["mean"] = way.mean;
    out["rms"] = way.rms;
    out["max"] = way.max;
    out["max_at"] = nb::make_tuple(way.maxAt[0], way.maxAt[1], way.maxAt[2]);
    out["mean_signed"] = way.meanSigned;
    out["inside"] = way.inside;
    return out;
}

nb::tuple comparisonOf(const Mesh& a, const Mesh& b, const How& how)
{
    Comparison both = run(how, [&](Progress& progress) { return compare(a, b, &progress); });
    return nb::make_tuple(both.hausdorff, dictOf(std::move(both.aToB)),
                          dictOf(std::move(both.bToA)));
}

using Words = std::vector<std::pair<std::string, std::string>>;

/// What a picture or page shows beside a surface: the name of that, other surfaces with names, and
/// atoms with words of styles.
using Beside = std::tuple<std::string, std::vector<std::pair<std::string, const MadeSurface*>>,
                          std::vector<std::pair<std::string, const Molecule*>>>;

/// Writes a file, with the options of files and pictures that are given.
void save(MadeSurface& surface, const std::string& path, bool replace, const Words& settings,
          const Beside& beside)
{
    const std::filesystem::path file = path;
    if (file.extension() == ".csv" && file.stem().extension() == ".contacts") needContacts(surface);
    nb::gil_scoped_release free;
    const auto& [name, panels, show] = beside;
    std::vector<ShownSurface> shown = {
        {surface.atoms.get(), &surface.result, &surface.options, name}};
    for (const auto& [title, other] : panels)
        shown.push_back({other->atoms.get(), &other->result, &other->options, title});
    for (const auto& [style, atoms] : show) shown[0].show.emplace_back(style, atoms->atoms.get());
    writeSurface(shown, path, settings, replace);
}

void addMolecule(nb::module_& m)
{
    nb::class_<Molecule>(m, "Molecule")
        .def("__len__", [](const Molecule& v) { return v.atoms->own(); })
        .def_ro("source", &Molecule::source)
        .def_prop_ro("positions",
                     [](nb::handle_t<Molecule> self) {
                         BallSet& atoms = *nb::cast<Molecule&>(self).atoms;
                         return columnsOf(atoms, atoms.balls.data()->center.asPointer(), 3, self);
                     })
        .def_prop_ro("radii",
                     [](nb::handle_t<Molecule> self) {
                         BallSet& atoms = *nb::cast<Molecule&>(self).atoms;
                         return columnsOf(atoms, &atoms.balls.data()->radius, 1, self);
                     })
        .def_prop_ro("names", [](const Molecule& v) { return namesOf(*v.atoms); })
        .def_prop_ro("warnings",
                     [](const Molecule& v) {
                         std::vector<std::string> all = v.atoms->record.warnings;
                         for (std::string& warning : all) warning = withKeywords(warning);
                         return all;
                     })
        .def_prop_ro("copies",
                     [](const Molecule& v) {
                         const Placement& placement = v.atoms->placement;
                         return placement.isWhole() ? placement.copies : placement.instances.size();
                     })
        .def_prop_ro("is_whole", [](const Molecule& v) { return v.atoms->placement.isWhole(); })
        .def_prop_ro("groups",
                     [](const Molecule& v) {
                         std::vector<std::string> all;
                         if (v.atoms->labels)
                             for (const Group& group : v.atoms->labels->groups)
                                 all.push_back(group.name);
                         return all;
                     })
        .def("surface",
             [](const Molecule& v, const Given& given, const std::vector<std::string>& extra,
                const std::string& areasOf, bool again, Listener progress, int threads) {
                 const How how{progress, threads};
                 const Settings settings = settingsOf(given, v.groups);
                 SurfaceOptions options = optionsOf(settings.options, extra, areasOf);
                 const bool grouped = v.atoms->labels && !v.atoms->labels->groups.empty();
                 again = again || (settings.labels.groupBy && !grouped);
                 auto [atoms, places] =
                     again ? asked(v, settings, how)
                           : std::pair(std::make_shared<BallSet>(*v.atoms), v.places);
                 options.places = std::move(places);
                 MadeSurface made = surfaceOf(std::move(atoms), v.source, options, how);
                 addWarnings(settings, given, made.result.report);
                 made.file = v.file;
                 made.select = settings.atoms;
                 return made;
             })
        .def("select",
             [](const Molecule& v, const std::string& selection) {
                 return owned<std::int32_t>(selected(v, selection));
             })
        .def("__getstate__", [](const Molecule& v) { return pack(*v.atoms, v.source, v.places); })
        .def("__setstate__",
             [](Molecule& v, const nb::bytes& bytes) { new (&v) Molecule(unpackMolecule(bytes)); });
}

void addSurface(nb::module_& m)
{
    nb::class_<MadeSurface> type(m, "Surface");
    const auto add = [&](const char* name, auto f) {
        type.def_prop_ro(name, [f](nb::handle_t<MadeSurface> self) {
            return f(nb::cast<MadeSurface&>(self), self);
        });
    };
    add("vertices",
        [](MadeSurface& s, nb::handle o) { return view<float>(s.result.mesh.positions, o); });
    add("normals",
        [](MadeSurface& s, nb::handle o) { return view<float>(s.result.mesh.normals, o); });
    add("faces", [](MadeSurface& s, nb::handle o) {
        return view<std::int32_t>(s.result.mesh.triangles, o); // indices are below 2^31
    });
    add("colors",
        [](MadeSurface& s, nb::handle o) { return view<std::uint8_t>(s.result.mesh.colors, o); });
    add("atom", [](MadeSurface& s, nb::handle o) { return view<std::int32_t>(s.atom, o); });
    add("atom_areas",
        [](MadeSurface& s, nb::handle o) { return view<double>(s.result.ballAreas, o); });
    add("vertex_data", [](MadeSurface& s, nb::handle o) {
        nb::dict all;
        for (auto& one : s.result.mesh.scalars) all[one.name.c_str()] = view<float>(one.values, o);
        for (auto& one : s.result.mesh.labels)
            all[one.name.c_str()] = view<std::int32_t>(one.values, o);
        return all;
    });
    add("area", [](MadeSurface& s, nb::handle) { return s.result.report.surface.area; });
    add("volume", [](MadeSurface& s, nb::handle) { return s.result.report.surface.volume; });
    add("closed", [](MadeSurface& s, nb::handle) { return s.result.report.surface.closed; });
    add("kind", [](MadeSurface& s, nb::handle) { return std::string(nameOf(s.options.kind)); });
    add("voxel", [](MadeSurface& s, nb::handle) { return s.options.voxel; });
    add("atoms", [](MadeSurface& s, nb::handle) { return s.atoms->own(); });
    add("cavities", [](MadeSurface& s, nb::handle) {
        std::vector<std::array<double, 2>> all;
        for (const SurfaceReport::Cavity& cavity : s.result.report.surface.cavities)
            all.push_back({cavity.area, cavity.volume});
        return owned<double>(std::move(all));
    });
    type.def_prop_ro("warnings", [](const MadeSurface& s) { return s.result.report.warnings; });
    type.def("report_text",
             [](const MadeSurface& s) {
                 Report report = s.result.report;
                 report.inputSha256 = inputSha256(s.atoms->record);
                 return bytesOf(reportText(report));
             })
        .def("contacts",
             [](MadeSurface& s) {
                 needContacts(s);
                 return pairsOf(std::vector<ContactArea>(s.result.contacts));
             })
        .def("distance",
             [](MadeSurface& s, const Positions& points, Listener progress, int threads) {
                 return distancesOf(s, points, {progress, threads});
             })
        .def("voxels",
             [](const MadeSurface& s) {
                 if (!s.result.surface)
                     throw Error(ErrorKind::Usage, "voxels: the surface has no grid of its own");
                 Voxels all = voxelsOf(*s.result.surface);
                 return nb::make_tuple(owned<std::int32_t>(std::move(all.coordinates)),
                                       owned<float>(std::move(all.values)), all.edge,
                                       nb::make_tuple(all.origin[0], all.origin[1], all.origin[2]));
             })
        .def("table", tableOf)
        .def("gradients",
             [](MadeSurface& s, Listener progress, int threads) {
                 return gradientsOf(s, {progress, threads});
             })
        .def("place", placeOf)
        .def("places",
             [](const MadeSurface& s, const std::string& selection) {
                 std::vector<std::array<double, 3>> all;
                 for (const Ball& ball : atomsOf(s, selection).balls)
                     all.push_back({ball.center[0], ball.center[1], ball.center[2]});
                 return all;
             })
        .def("save", save)
        .def("state", packSurface);
}

void addFunctions(nb::module_& m)
{
    m.def("settings", describeSettings);
    m.def("former_names", formerNames);
    using Pairs = std::vector<std::pair<std::string, std::vector<std::string>>>;
    m.def("options_sha256", [](const Pairs& pairs) {
        std::vector<GivenOption> given;
        for (const auto& [name, values] : pairs) {
            const OptionRow<Request>* row = findRow(requestTable(), name);
            given.push_back(row ? givenOption(*row, values) : GivenOption{name, values, {}});
        }
        return identityOf(optionsLine(given));
    });
    m.def("input_sha256",
          [](const std::string& path) { return sha256OfInput(path, ReadLimits().maxInput); });
    m.def("structure_endings", structureEndings);
    m.def("surface_endings", surfaceEndings);
    // Whether a colour needs what read() takes from a file; what is no colour does not.
    m.def("is_of_file", [](const std::string& color) {
        try {
            const Settings s = settingsOf({{"color", {color}}});
            return s.colorGroups || !s.colorGroupsFile.empty() || s.labels.valueBy ||
                   s.labels.plainColor;
        } catch (const Error&) {
            return false;
        }
    });
    m.def("read", [](const std::string& name, const std::optional<nb::bytes>& content,
                     const Given& given, const GroupWords& groups, Listener progress, int threads) {
        return readMolecule(name, content, given, groups, {progress, threads});
    });
    m.def("surface", [](const Positions& positions, const Numbers& radii, const Given& given,
                        const std::vector<std::string>& extra, const std::string& areasOf,
                        Listener progress, int threads) {
        auto atoms = std::make_shared<BallSet>();
        atoms->balls = ballsOf(positions, radii);
        const Settings settings = settingsOf(given, {});
        MadeSurface made = surfaceOf(
            std::move(atoms), "", optionsOf(settings.options, extra, areasOf), {progress, threads});
        addWarnings(settings, given, made.result.report);
        return made;
    });
    m.def("areas", [](const Positions& positions, const Numbers& radii, double probe,
                      Listener progress, int threads) {
        const std::vector<Ball> balls = ballsOf(positions, radii);
        return owned<double>(
            run({progress, threads}, [&](Progress& p) { return exposedAreas(balls, probe, p); }));
    });
    m.def("contacts", [](const Positions& positions, const Numbers& radii, double probe,
                         Listener progress, int threads) {
        const std::vector<Ball> balls = ballsOf(positions, radii);
        return pairsOf(
            run({progress, threads}, [&](Progress& p) { return contactAreas(balls, probe, p); }));
    });
    m.def("radii",
          [](const std::vector<std::string>& names, const std::vector<std::string>& residues,
             const std::vector<std::string>& elements, const std::string& set) {
              return owned<double>(atomRadii(names, residues, elements, set));
          });
    m.def("compare", [](const Floats3& va, const Whole3& fa, const Floats3& vb, const Whole3& fb,
                        Listener progress, int threads) {
        return comparisonOf(meshOf(va, fa), meshOf(vb, fb), {progress, threads});
    });
    m.def("largest_area", [](const std::string& residue) { return largestArea(residue); });
    m.def("read_mesh", [](const std::string& path) {
        Mesh mesh = readMesh(path);
        return nb::make_tuple(owned<float>(std::move(mesh.positions)),
                              owned<std::int32_t>(std::move(mesh.triangles)));
    });
    m.def("unpack_surface", [](const nb::bytes& bytes, const Given& given,
                               const std::vector<std::string>& extra, const std::string& areasOf) {
        return unpackSurface(bytes, optionsOf(settingsOf(given, {}).options, extra, areasOf));
    });
}

} // namespace

} // namespace molsurf::python

NB_MODULE(_core, m)
{
    openvdb::initialize();
    m.attr("__version__") = MOLSURF_VERSION;
    molsurf::python::addErrors(m);
    molsurf::python::addMolecule(m);
    molsurf::python::addSurface(m);
    molsurf::python::addFunctions(m);
}
