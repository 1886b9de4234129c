// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/measures/area_tables.h"

#include "molsurf/analysis/measures/polarity.h"
#include "molsurf/error.h"
#include "molsurf/molecule/selection/ball_names.h"
#include "molsurf/molecule/selection/subset.h"
#include "molsurf/molecule/structure/element.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <utility>

namespace molsurf
{

namespace
{

using Texts = std::vector<std::string>;
using Counts = std::vector<std::int64_t>;
using Numbers = std::vector<double>;

std::string lettered(char letter)
{
    return letter == '\0' || letter == ' ' ? "" : std::string(1, letter);
}

/// Rounds to 13 significant digits. Those after them are noise of summation; sums of the rounded
/// areas still are that of the whole to some 1e-10.
double digitsThatHold(double number)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.13g", number);
    return std::strtod(text, nullptr);
}

/// The columns that name residues, filled row by row.
class ResidueColumns
{
public:
    void add(const BallNames::Residue& r)
    {
        chain_.push_back(r.chain.empty() ? "_" : r.chain);
        name_.push_back(r.name);
        number_.push_back(r.number);
        code_.push_back(lettered(r.insertionCode));
        label_.push_back(r.labelChain);
    }

    /// @param[in] suffix  of the columns' names
    void moveTo(Table& table, const std::string& suffix = "")
    {
        table.columns.push_back({"chain" + suffix, std::move(chain_)});
        table.columns.push_back({"residue" + suffix, std::move(name_)});
        table.columns.push_back({"number" + suffix, std::move(number_)});
        table.columns.push_back({"insertion_code" + suffix, std::move(code_)});
        table.columns.push_back({"label_chain" + suffix, std::move(label_)});
    }

private:
    Texts chain_, name_, code_, label_;
    Counts number_;
};

/// The names of the balls of a table.
/// @param[in] atoms  checked: it has names
const BallNames& namesOf(const BallSet& atoms)
{
    if (!atoms.names)
        throw Error(ErrorKind::Usage, "table: expected `names` of the atoms, got none");
    return *atoms.names;
}

/// Checks that a surface has areas of these atoms.
void checkAreas(const BallSet& atoms, const MolecularSurface& result)
{
    const std::size_t areas = result.ballAreas.size();
    if (areas > 0 && areas <= atoms.balls.size()) return;
    throw Error(ErrorKind::Usage, "table: expected a surface with `ballAreas` of " +
                                      std::to_string(atoms.balls.size()) + " atoms, got " +
                                      std::to_string(areas));
}

/// The sum of each residue's balls.
Numbers sumsOf(const BallNames& names, const Numbers& values)
{
    Numbers out(names.residues.size(), 0.0);
    for (std::size_t i = 0; i < values.size(); ++i)
        out[std::size_t(names.residueOf[i])] += values[i];
    return out;
}

/// Areas of the first balls, 0 for those of another class.
Numbers areasOf(Polarity wanted, const std::vector<Polarity>& classes, const Numbers& areas)
{
    Numbers out;
    for (std::size_t i = 0; i < areas.size(); ++i)
        out.push_back(classes[i] == wanted ? areas[i] : 0.0);
    return out;
}

/// An atom with less area has none [Å^2]: measureInterfaces() notices no more of areas on meshes.
constexpr double coveredArea = 0.005;

/// The columns of areas by class.
constexpr std::array<std::pair<const char*, Polarity>, 2> classColumns = {
    std::pair("polar_area", Polarity::Polar), std::pair("apolar_area", Polarity::Apolar)};

/// Adds the mean of a value over each residue's part of the surface, and its integral.
/// @param[in] balls  how many own balls each residue has; residues with 0 have no row
void addValues(const BallSet& atoms, const Counts& balls, const MolecularSurface& result,
               Table& table)
{
    const BallNames& names = *atoms.names;
    Numbers sums(balls.size(), 0.0), areas(balls.size(), 0.0), mean, integral;
    for (std::size_t i = 0; i < result.ballValues.size(); ++i) {
        const auto residue = std::size_t(names.residueOf[i]);
        if (!std::isfinite(result.ballValues[i])) continue;
        sums[residue] += result.ballAreas[i] * result.ballValues[i];
        areas[residue] += result.ballAreas[i];
    }
    for (std::size_t r = 0; r < balls.size(); ++r) {
        if (balls[r] == 0) continue;
        const double none = std::numeric_limits<double>::quiet_NaN();
        mean.push_back(areas[r] > 0.0 ? sums[r] / areas[r] : none);
        integral.push_back(sums[r]);
    }
    const std::string& name = atoms.labels->values->name;
    table.columns.push_back({"mean_" + name, std::move(mean)});
    table.columns.push_back({"integral_" + name + "_A2", std::move(integral)});
}

/// Adds the mean depth of each residue's balls, and the depth of its alpha carbon, or NaN. (A
/// calcium ion is named CA, too, but is no carbon.)
/// @param[in] depths  of the balls [Å]
/// @param[in] balls   as of addValues()
void addDepths(const BallSet& atoms, const Numbers& depths, const Counts& balls, Table& table)
{
    constexpr std::uint8_t carbon = 6;
    const BallNames& names = *atoms.names;
    Numbers sums(balls.size(), 0.0), ofCa(balls.size(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < atoms.own(); ++i) {
        const auto residue = std::size_t(names.residueOf[i]);
        sums[residue] += depths[i];
        if (names.atoms[i].name == "CA" && names.atoms[i].element == carbon)
            ofCa[residue] = depths[i];
    }
    Numbers mean, ca;
    for (std::size_t r = 0; r < balls.size(); ++r) {
        if (balls[r] == 0) continue;
        mean.push_back(sums[r] / double(balls[r]));
        ca.push_back(ofCa[r]);
    }
    table.columns.push_back({"depth_A", std::move(mean)});
    table.columns.push_back({"ca_depth_A", std::move(ca)});
}

/// The names of the first balls, and their radii.
void addAtoms(const BallSet& atoms, std::size_t count, Table& table)
{
    const BallNames& names = namesOf(atoms);
    ResidueColumns residues;
    Texts name, altloc, element;
    Counts id;
    Numbers radius;
    for (std::size_t i = 0; i < count; ++i) {
        const BallNames::Atom& atom = names.atoms[i];
        residues.add(names.residues[std::size_t(names.residueOf[i])]);
        name.push_back(atom.name);
        altloc.push_back(lettered(atom.altloc));
        element.push_back(elementSymbol(atom.element));
        id.push_back(atoms.balls[i].atom);
        radius.push_back(atoms.balls[i].radius);
    }
    residues.moveTo(table);
    table.columns.push_back({"atom", std::move(name)});
    table.columns.push_back({"altloc", std::move(altloc)});
    table.columns.push_back({"element", std::move(element)});
    table.columns.push_back({"atom_id", std::move(id)});
    table.columns.push_back({"radius_A", std::move(radius)});
}

} // namespace

Table forceTable(const BallSet& atoms, const SurfaceSpec& spec, const Mesh& mesh)
{
    Table table{"forces", {}};
    addAtoms(atoms, atoms.balls.size(), table);
    const MolecularSurface::Gradients found = surfaceGradients(atoms, spec, mesh, Progress());
    const auto add = [&](const std::vector<openvdb::Vec3d>& gradients, const auto& names) {
        for (int axis = 0; axis < 3; ++axis) {
            Numbers values;
            for (const openvdb::Vec3d& g : gradients) values.push_back(digitsThatHold(g[axis]));
            table.columns.push_back({names[axis], std::move(values)});
        }
    };
    add(found.volume, std::array{"dV_dx_A2", "dV_dy_A2", "dV_dz_A2"});
    add(found.area, std::array{"dA_dx_A", "dA_dy_A", "dA_dz_A"});
    const auto addMarks = [&](const std::vector<char>& marks, const char* name) {
        if (!marks.empty()) table.columns.push_back({name, Counts(marks.begin(), marks.end())});
    };
    addMarks(found.besideGap, "beside_gap");
    addMarks(found.besideRidge, "beside_ridge");
    return table;
}

Table atomTable(const BallSet& atoms, const MolecularSurface& result)
{
    checkAreas(atoms, result);
    Table table{"atoms", {}};
    addAtoms(atoms, result.ballAreas.size(), table);
    table.columns.push_back({"area", result.ballAreas});
    const std::vector<Polarity> classes = polarityOf(atoms);
    for (const auto& [name, polarity] : classColumns)
        table.columns.push_back({name, areasOf(polarity, classes, result.ballAreas)});
    Numbers depth = result.ballDepths;
    depth.resize(std::min(depth.size(), result.ballAreas.size())); // without images
    if (!depth.empty()) table.columns.push_back({"depth_A", std::move(depth)});
    return table;
}

Table residueTable(const BallSet& atoms, double probe, const MolecularSurface& result)
{
    checkAreas(atoms, result);
    const BallNames& names = namesOf(atoms);
    const Numbers areas = sumsOf(names, result.ballAreas);
    Counts balls(areas.size(), 0);
    for (std::size_t i = 0; i < result.ballAreas.size(); ++i)
        ++balls[std::size_t(names.residueOf[i])];
    ResidueColumns residues;
    Counts count;
    Numbers area, relative;
    for (std::size_t r = 0; r < areas.size(); ++r) {
        if (balls[r] == 0) continue; // an image of the unit's residue
        residues.add(names.residues[r]);
        count.push_back(balls[r]);
        area.push_back(areas[r]);
        relative.push_back(areas[r] / largestAccessibleArea(names.residues[r].name)
                                          .value_or(std::numeric_limits<double>::quiet_NaN()));
    }
    Table table{"residues", {}};
    residues.moveTo(table);
    table.columns.push_back({"atoms", std::move(count)});
    table.columns.push_back({"area", std::move(area)});
    const std::vector<Polarity> classes = polarityOf(atoms);
    for (const auto& [name, polarity] : classColumns) {
        const Numbers sums = sumsOf(names, areasOf(polarity, classes, result.ballAreas));
        Numbers column;
        for (std::size_t r = 0; r < sums.size(); ++r)
            if (balls[r] > 0) column.push_back(sums[r]);
        table.columns.push_back({name, std::move(column)});
    }
    constexpr double ofMaxima = 1.4; // probe [Å]
    if (result.report.areasOf == nameOf(SurfaceKind::SolventAccessible) && probe == ofMaxima)
        table.columns.push_back({"relative_accessibility", std::move(relative)});
    if (!result.ballDepths.empty()) addDepths(atoms, result.ballDepths, balls, table);
    if (!result.ballValues.empty()) addValues(atoms, balls, result, table);
    return table;
}

std::optional<double> largestArea(const std::string& residue)
{
    return largestAccessibleArea(residue);
}

const char* nameOf(ContactLevel level)
{
    return level == ContactLevel::Atom    ? "atom"
           : level == ContactLevel::Chain ? "chain"
                                          : "residue";
}

Table contactTable(const BallSet& atoms, ContactLevel level, const MolecularSurface& result)
{
    const BallNames& names = namesOf(atoms);
    const std::size_t own = atoms.own();
    std::map<std::string, std::int32_t> chains;
    Texts chainNames;
    std::vector<std::int32_t> chainOf; // of residues
    for (const BallNames::Residue& r : names.residues) {
        const auto [place, isNew] = chains.emplace(r.chain, std::int32_t(chainNames.size()));
        if (isNew) chainNames.push_back(r.chain);
        chainOf.push_back(place->second);
    }
    const auto memberOf = [&](std::size_t ball) {
        const std::int32_t residue = names.residueOf[ball];
        if (level == ContactLevel::Atom) return std::int32_t(ball);
        return level == ContactLevel::Residue ? residue : chainOf[std::size_t(residue)];
    };
    struct Sum {
        double area = 0.0, distance = 0.0;
    };
    std::map<std::pair<std::int32_t, std::int32_t>, Sum> sums;
    for (const ContactArea& contact : result.contacts) {
        if (contact.balls[0] >= own) continue; // both are images
        const std::int32_t a = memberOf(contact.balls[0]), b = memberOf(contact.balls[1]);
        if (a == b) continue;
        Sum& sum = sums[{std::min(a, b), std::max(a, b)}];
        sum.area += contact.area;
        sum.distance = contact.distance; // for atoms only, of which a pair has one facet
    }
    Table table{"contacts", {}};
    for (const int side : {0, 1}) {
        const std::string suffix = side == 0 ? "_1" : "_2";
        ResidueColumns residues;
        Texts name, altloc;
        for (const auto& [pair, sum] : sums) {
            const auto member = std::size_t(side == 0 ? pair.first : pair.second);
            if (level == ContactLevel::Chain) {
                name.push_back(chainNames[member]);
                continue;
            }
            const bool atom = level == ContactLevel::Atom;
            residues.add(names.residues[atom ? std::size_t(names.residueOf[member]) : member]);
            if (!atom) continue;
            name.push_back(names.atoms[member].name);
            altloc.push_back(lettered(names.atoms[member].altloc));
        }
        if (level == ContactLevel::Chain) {
            table.columns.push_back({"chain" + suffix, std::move(name)});
            continue;
        }
        residues.moveTo(table, suffix);
        if (level == ContactLevel::Residue) continue;
        table.columns.push_back({"atom" + suffix, std::move(name)});
        table.columns.push_back({"altloc" + suffix, std::move(altloc)});
    }
    Numbers area, distance;
    for (const auto& [pair, sum] : sums) {
        area.push_back(sum.area);
        distance.push_back(sum.distance);
    }
    if (level == ContactLevel::Atom) table.columns.push_back({"distance_A", std::move(distance)});
    table.columns.push_back({"area", std::move(area)});
    return table;
}

Table interfaceTable(const BallSet& atoms, const Report& report)
{
    const BallNames& names = namesOf(atoms);
    ResidueColumns residues;
    Texts first, second, group;
    Numbers alone, together, buried, area;
    std::array<Numbers, 6> fits;
    std::array<Numbers, 2> byClass;
    Counts polarAtoms;
    const std::vector<Polarity> classes = polarityOf(atoms);
    for (const Report::Interface& interface : report.interfaces) {
        // By residue, those of the first group first: the areas apart, and together.
        using Key = std::pair<bool, std::int32_t>;
        std::map<Key, std::pair<double, double>> sums;
        std::map<Key, std::array<double, 2>> classSums;
        std::map<Key, std::int64_t> covered;
        for (const Report::Interface::Buried& b : interface.buried) {
            const Key key(!b.ofFirst, names.residueOf[b.ball]);
            auto& sum = sums[key];
            sum.first += b.alone;
            sum.second += b.together;
            for (std::size_t k = 0; k < classColumns.size(); ++k)
                if (classes[b.ball] == classColumns[k].second)
                    classSums[key][k] += b.alone - b.together;
            const bool isHydrogen = names.atoms[b.ball].element == 1;
            covered[key] +=
                classes[b.ball] == Polarity::Polar && !isHydrogen && b.together < coveredArea;
        }
        for (const auto& [key, sum] : sums) {
            first.push_back(interface.first);
            second.push_back(interface.second);
            group.push_back(key.first ? interface.second : interface.first);
            residues.add(names.residues[std::size_t(key.second)]);
            alone.push_back(sum.first);
            together.push_back(sum.second);
            buried.push_back(sum.first - sum.second);
            area.push_back(0.5 * (sum.first - sum.second));
            for (std::size_t k = 0; k < byClass.size(); ++k)
                byClass[k].push_back(classSums[key][k]);
            polarAtoms.push_back(covered[key]);
            const Report::Interface::Fit& fit = interface.fit;
            const std::array<double, 6> row = {fit.shape,    fit.distance,   fit.gapVolume,
                                               fit.gapIndex, fit.contact[0], fit.contact[1]};
            for (std::size_t k = 0; k < row.size(); ++k) fits[k].push_back(row[k]);
        }
    }
    Table table{"interfaces", {}};
    table.columns.push_back({"group_1", std::move(first)});
    table.columns.push_back({"group_2", std::move(second)});
    table.columns.push_back({"group", std::move(group)});
    residues.moveTo(table);
    table.columns.push_back({"area_alone", std::move(alone)});
    table.columns.push_back({"area_together", std::move(together)});
    table.columns.push_back({"buried_area", std::move(buried)});
    table.columns.push_back({"area", std::move(area)});
    table.columns.push_back({"buried_polar_area", std::move(byClass[0])});
    table.columns.push_back({"buried_apolar_area", std::move(byClass[1])});
    table.columns.push_back({"buried_polar_atoms", std::move(polarAtoms)});
    constexpr std::array<const char*, 6> ofPairs = {
        "shape_complementarity", "median_distance_A", "gap_volume",
        "gap_index_A",           "contact_area_1",    "contact_area_2"};
    for (std::size_t k = 0; k < ofPairs.size(); ++k)
        table.columns.push_back({ofPairs[k], std::move(fits[k])});
    return table;
}

void addOrigin(const BallSet& atoms, const std::string& kind, double probe, Table& table)
{
    const std::size_t rows =
        std::visit([](const auto& v) { return v.size(); }, table.columns[0].values);
    for (Table::Column& column : table.columns)
        if (auto* numbers = std::get_if<Numbers>(&column.values))
            for (double& number : *numbers) number = digitsThatHold(number);
    table.columns.push_back({"surface", Texts(rows, kind)});
    table.columns.push_back({"probe_A", Numbers(rows, probe)});
    table.columns.push_back(
        {"radii", Texts(rows, atoms.record.radii.empty() ? "input" : atoms.record.radii)});
}

std::vector<double> residueAreasOfBalls(const BallSet& atoms, const std::vector<double>& ballAreas)
{
    const Numbers sums = sumsOf(*atoms.names, ballAreas);
    Numbers out;
    for (std::size_t i = 0; i < ballAreas.size(); ++i)
        out.push_back(sums[std::size_t(atoms.names->residueOf[i])]);
    return out;
}

} // namespace molsurf
