// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/select_balls.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/cancel.h"
#include "molsurf/kernel/core/memory.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/selection/alternate_locations.h"
#include "molsurf/molecule/selection/assembly.h"
#include "molsurf/molecule/selection/ball_names.h"
#include "molsurf/molecule/selection/ball_values.h"
#include "molsurf/molecule/selection/choose_copies.h"
#include "molsurf/molecule/selection/coarse_grain.h"
#include "molsurf/molecule/selection/groups.h"
#include "molsurf/molecule/selection/match_atoms.h"
#include "molsurf/molecule/selection/membrane.h"
#include "molsurf/molecule/selection/point_charges.h"
#include "molsurf/molecule/selection/radii.h"
#include "molsurf/molecule/selection/residue_roles.h"
#include "molsurf/molecule/selection/subset.h"
#include "molsurf/molecule/selection/symmetric_unit.h"
#include "molsurf/molecule/structure/read_structure.h"
#include "molsurf/molecule/structure/symmetry.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace molsurf
{
namespace
{

using Indices = std::vector<std::int32_t>;

/// The model that the option and the selection name.
const Model& chooseModel(const Structure& structure, const SelectOptions& options,
                         const std::vector<int>& selected)
{
    int number = options.model;
    for (const int named : selected) {
        if (named != 0 && number != 0 && named != number) {
            throw Error(ErrorKind::Usage, "selection " + inQuotes(options.select) +
                                              " names model " + std::to_string(named) +
                                              ", expected " + std::to_string(number) +
                                              " [one run uses one model]");
        }
        if (named != 0) number = named;
    }
    if (number == 0) return structure.models.front();
    std::vector<std::string> numbers;
    for (const Model& model : structure.models) {
        if (model.number == number) return model;
        numbers.push_back(std::to_string(model.number));
    }
    failAt(structure.source, "model " + std::to_string(number) + ": expected " +
                                 (numbers.size() > 1 ? "one of " : "the only one, ") +
                                 joined(numbers));
}

/// Narrows a list of atoms step by step, and keeps the count of what each step takes out.
class Filter
{
public:
    Filter(const Model& model, BallSet& out) : out_(out)
    {
        for (std::size_t i = model.begin; i < model.end; ++i) {
            atoms_.push_back(static_cast<std::int32_t>(i));
        }
    }

    /// Takes out the atoms for which `isDropped(index)` is true.
    template<typename Predicate>
    void drop(const std::string& reason, Predicate isDropped)
    {
        const auto end = std::remove_if(atoms_.begin(), atoms_.end(), isDropped);
        note(reason, std::size_t(atoms_.end() - end));
        atoms_.erase(end, atoms_.end());
    }

    void dropLowerOccupancies(const Structure& structure)
    {
        note("alternate location", keepHighestOccupancy(structure, atoms_));
    }

    void note(const std::string& reason, std::size_t count)
    {
        if (count > 0) out_.record.drops.push_back({reason, count});
    }

    const Indices& atoms() const { return atoms_; }

private:
    BallSet& out_;
    Indices atoms_;
};

void chooseAltloc(const Structure& structure, const std::string& altloc, Filter& filter,
                  BallSet& out)
{
    if (altloc == "all") return;
    if (altloc.empty()) return filter.dropLowerOccupancies(structure);
    if (altloc.size() != 1) {
        throw Error(ErrorKind::Usage,
                    "alternate location: expected one character or all, got " + inQuotes(altloc));
    }
    std::set<std::string> labels;
    for (const std::int32_t i : filter.atoms()) {
        const char label = structure.atoms[std::size_t(i)].altloc;
        if (label != '\0') labels.emplace(1, label);
    }
    if (labels.empty()) {
        out.record.warnings.push_back("alternate location " + altloc +
                                      ": the selected atoms have no alternate locations");
    } else if (labels.count(altloc) == 0) {
        failAt(structure.source, "alternate location " + inQuotes(altloc) + ": expected one of " +
                                     joined({labels.begin(), labels.end()}));
    }
    std::set<std::pair<std::int32_t, std::string>> labelled; // that the label has
    for (const std::int32_t i : filter.atoms()) {
        const Atom& atom = structure.atoms[std::size_t(i)];
        if (atom.altloc == altloc[0]) labelled.emplace(atom.residue, atom.name);
    }
    filter.drop("alternate location", [&](std::int32_t i) {
        const Atom& atom = structure.atoms[std::size_t(i)];
        return atom.altloc == '\0' ? labelled.count({atom.residue, atom.name}) > 0
                                   : atom.altloc != altloc[0];
    });
}

/// "Zn (2 atoms), unknown element of atom UNK (1 atom)"
std::string describeCounts(const std::map<std::string, std::size_t>& counts)
{
    std::vector<std::string> parts;
    for (const auto& [name, count] : counts) {
        parts.push_back(name + " (" + counted(count, "atom", "atoms") + ")");
    }
    return joined(parts);
}

/// The set of radii to use: for beads a Martini set, unless another one than the default is named.
std::string radiiName(const Structure& structure, const std::string& asked)
{
    const bool beads = structure.beads != BeadKind::None;
    if (asked != "martini" && !(asked == "bondi" && beads)) return asked;
    return structure.beads == BeadKind::Martini3 ? "martini3" : "martini2";
}

/// "the file has Martini beads, not atoms: radii martini2 for 80 beads of 2.64 Å, 12 of 2.41 Å"
std::string describeBeads(BeadKind beads, const std::string& set, const std::vector<double>& radii)
{
    std::map<double, std::size_t, std::greater<double>> counts;
    for (const double r : radii) ++counts[r];
    std::string text = "the file has atoms, not beads";
    if (beads == BeadKind::Unnamed) text = "the file has beads, not atoms (one or a few a residue)";
    if (beads == BeadKind::Martini2) text = "the file has beads of Martini 2, not atoms";
    if (beads == BeadKind::Martini3) text = "the file has beads of Martini 3, not atoms";
    text += ": radii " + set + " were used:";
    for (const auto& [radius, count] : counts) {
        text += formatted("%s %zu of %.2f Å", text.back() == ':' ? "" : ",", count, radius);
    }
    return text;
}

/// The radius of every chosen atom [Å].
std::vector<double> findRadii(const Structure& structure, const SelectOptions& options,
                              const Indices& atoms, BallSet& out)
{
    std::vector<double> radii;
    radii.reserve(atoms.size());
    if (structure.hasRadii) {
        for (const std::int32_t i : atoms) {
            radii.push_back(structure.atoms[std::size_t(i)].radius);
        }
        return radii;
    }
    const RadiiSet set = readRadii(radiiName(structure, options.radii), options.limits.maxInput),
                   fallback = readRadii("bondi");
    out.record.radii = std::filesystem::path(set.name).filename().string();
    std::vector<std::string>& warnings = out.record.warnings;
    std::map<std::string, std::size_t> uncovered, unknown;
    for (const std::int32_t i : atoms) {
        const Atom& atom = structure.atoms[std::size_t(i)];
        if (atom.radius >= 0.0) { // a sphere of an integrative model
            radii.push_back(atom.radius);
            continue;
        }
        const std::string& residue = residueOf(structure, atom).name;
        double radius = set.find(residue, atom.name, atom.element);
        if (radius < 0) {
            radius = fallback.find(residue, atom.name, atom.element);
            auto& counts = radius < 0 ? unknown : uncovered;
            ++counts[atom.element != 0 ? elementSymbol(atom.element)
                                       : "unknown element of atom " + inQuotes(atom.name)];
        }
        radii.push_back(radius < 0 ? unknownRadius : radius);
    }
    if (set.name == "martini2" || set.name == "martini3") {
        warnings.push_back(describeBeads(structure.beads, set.name, radii));
    }
    if (!uncovered.empty()) {
        warnings.push_back("radii " + set.name + " lacks " + describeCounts(uncovered) +
                           ": bondi was used for them");
    }
    if (!unknown.empty()) {
        warnings.push_back("no radius is known for " + describeCounts(unknown) +
                           ": 1.70 Å was used");
    }
    return radii;
}

/// The balls in the coordinates of the file.
std::vector<Ball> makeBalls(const Structure& structure, const SelectOptions& options,
                            Filter& filter, BallSet& out)
{
    const std::vector<double> radii = findRadii(structure, options, filter.atoms(), out);
    std::vector<Ball> balls;
    balls.reserve(radii.size());
    std::size_t hydrogens = 0; // that the radii of heavy atoms include
    for (std::size_t i = 0; i < radii.size(); ++i) {
        const std::int32_t atom = filter.atoms()[i];
        if (radii[i] <= 0) {
            hydrogens += !structure.hasRadii && structure.atoms[std::size_t(atom)].element == 1;
            continue;
        }
        const auto& position = structure.atoms[std::size_t(atom)].position;
        balls.push_back({position, radii[i], atom});
    }
    filter.note("hydrogen in radii of heavy atoms", hydrogens);
    filter.note("zero radius", radii.size() - balls.size() - hydrogens);
    return balls;
}

/// The same for balls of one place and radius.
std::uint64_t hashOf(const Ball& ball)
{
    std::uint64_t hash = 0;
    for (const double value : {ball.center.x(), ball.center.y(), ball.center.z(), ball.radius}) {
        const double positive = value + 0.0; // -0 is 0
        std::uint64_t bits;
        std::memcpy(&bits, &positive, sizeof bits);
        hash = (hash ^ bits) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 29;
    }
    return hash;
}

/// Whether each ball is the same as one before it of the same prototype.
std::vector<char> findDuplicates(const BallSet& atoms)
{
    const std::vector<Ball>& balls = atoms.balls;
    struct Entry {
        std::uint64_t hash;
        std::uint32_t prototype, ball;
        auto key() const { return std::make_tuple(hash, prototype, ball); }
    };
    std::vector<Entry> entries(balls.size());
    for (std::size_t p = 0; p < atoms.placement.prototypes(); ++p) {
        const auto [begin, end] = atoms.prototype(p);
        for (std::size_t i = begin; i < end; ++i)
            entries[i] = {hashOf(balls[i]), std::uint32_t(p), std::uint32_t(i)};
    }
    tbb::parallel_sort(entries.begin(), entries.end(),
                       [](const Entry& a, const Entry& b) { return a.key() < b.key(); });
    std::vector<char> duplicate(balls.size(), 0);
    for (std::size_t n = 1, first = 0; n < entries.size(); ++n) {
        const Entry &a = entries[first], &b = entries[n];
        const bool same = a.hash == b.hash && a.prototype == b.prototype &&
                          balls[a.ball].center == balls[b.ball].center &&
                          balls[a.ball].radius == balls[b.ball].radius;
        duplicate[b.ball] = same;
        if (!same) first = n;
    }
    return duplicate;
}

/// Leaves out each ball that is the same as one before it, and warns of it: a sum of Gaussians
/// would count it twice. Prototypes are surfaces of their own, and keep theirs.
void dropDuplicates(const Structure& structure, Filter& filter, BallSet& out)
{
    std::vector<std::size_t>& begin = out.placement.begin;
    const std::vector<char> duplicate = findDuplicates(out);
    const std::size_t first =
        std::size_t(std::find(duplicate.begin(), duplicate.end(), 1) - duplicate.begin());
    if (first == duplicate.size()) return;
    const std::size_t atom = std::size_t(out.balls[first].atom);
    std::size_t kept = 0, copy = 0;
    for (std::size_t i = 0; i < out.balls.size(); ++i) {
        while (begin[copy] == i) begin[copy++] = kept; // empty copies begin at the same ball
        if (!duplicate[i]) out.balls[kept++] = out.balls[i];
    }
    std::fill(begin.begin() + std::ptrdiff_t(copy), begin.end(), kept);
    const std::size_t count = out.balls.size() - kept;
    out.balls.resize(kept);
    filter.note("duplicate", count);
    out.record.warnings.push_back(
        counted(count, "atom lies", "atoms lie") +
        " exactly where another of the same radius lies: dropped; the first is " +
        describeAtom(structure, atom));
}

/// Whether two balls of a whole are the same, or in one of 10^6 wholes have the same hash. Tables
/// of bits leave few balls whose hashes are compared.
bool hasDuplicates(const RepeatedBalls& balls)
{
    constexpr std::size_t bitsPerBall = 8;
    std::size_t bits = 64;
    while (bits < bitsPerBall * balls.size()) bits *= 2;
    std::vector<bool> once(bits), twice(bits);
    balls.forEach([&](const Ball& ball, std::size_t) {
        const std::size_t bit = hashOf(ball) & (bits - 1);
        if (once[bit]) twice[bit] = true;
        once[bit] = true;
    });
    std::vector<std::uint64_t> hashes;
    balls.forEach([&](const Ball& ball, std::size_t) {
        const std::uint64_t hash = hashOf(ball);
        if (twice[hash & (bits - 1)]) hashes.push_back(hash);
    });
    tbb::parallel_sort(hashes.begin(), hashes.end());
    return std::adjacent_find(hashes.begin(), hashes.end()) != hashes.end();
}

/// The box about the centres; not a number along an axis where one of these is none.
openvdb::BBoxd boxOfCentres(const RepeatedBalls& balls)
{
    openvdb::Vec3d low(HUGE_VAL), high(-HUGE_VAL);
    balls.forEach([&](const Ball& ball, std::size_t) {
        for (int axis = 0; axis < 3; ++axis) {
            const double x = ball.center[axis];
            if (x < low[axis] || std::isnan(x)) low[axis] = x;
            if (x > high[axis] || std::isnan(x)) high[axis] = x;
        }
    });
    return {low, high};
}

/// Refuses a molecule that no grid can hold.
void checkExtent(const Structure& structure, const openvdb::BBoxd& centres)
{
    constexpr double largest = 1e6; // [Å]
    for (int axis = 0; axis < 3; ++axis) {
        const double extent = centres.max()[axis] - centres.min()[axis];
        if (extent <= largest) continue; // false for NaN
        failAt(structure.source, std::string("the molecule's extent in ") + "xyz"[axis] +
                                     ": expected at most 1e6 Å, got " + std::to_string(extent) +
                                     " Å [an atom or an assembly operator is wrong]");
    }
}

/// The largest coordinate of a box [Å].
double farthestOf(const openvdb::BBoxd& centres)
{
    double farthest = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        farthest =
            std::max({farthest, std::abs(centres.min()[axis]), std::abs(centres.max()[axis])});
    return farthest;
}

/// Vertices of meshes have single precision: far from the origin they are moved by what that leaves
/// out.
void warnOfRounding(const openvdb::BBoxd& centres, std::vector<std::string>& warnings)
{
    constexpr double far = 1e4, digit = 0x1p-23; // [Å], and the last bit of 1 in a float
    const double farthest = farthestOf(centres);
    if (farthest < far) return;
    warnings.push_back(formatted(
        "atoms lie up to %.3g Å from the origin, where vertices are rounded to %.1g Å [hint: "
        "move the molecule to the origin]",
        farthest, farthest * digit));
}

std::string describeDrops(const std::vector<Excluded>& drops)
{
    std::vector<std::string> parts;
    for (const Excluded& drop : drops)
        parts.push_back(std::to_string(drop.count) + " " + drop.reason);
    return joined(parts);
}

/// "free ion (CL, NA)": with the names of the residues that some atoms belong to.
template<typename IsOne>
std::string describeRole(const Structure& structure, const std::string& what, const Indices& atoms,
                         const IsOne& isOne)
{
    constexpr std::size_t most = 6;
    std::set<std::string> names;
    for (const std::int32_t i : atoms)
        if (isOne(i)) names.insert(residueOf(structure, structure.atoms[std::size_t(i)]).name);
    return what + " (" + joined({names.begin(), names.end()}, most) + ")";
}

/// The assembly that is asked for, if it can be built; otherwise nullptr.
const Assembly* assemblyOf(const Structure& structure, const SelectOptions& options)
{
    for (const Assembly& assembly : structure.assemblies)
        if (assembly.name == options.assembly.name && assembly.problem.empty()) return &assembly;
    return nullptr;
}

/// Leaves out ligands and ions that do not count.
void dropHetero(const Structure& structure, const SelectOptions& options, const Model& model,
                Filter& filter)
{
    const auto residueAt = [&](std::int32_t i) -> const Residue& {
        return residueOf(structure, structure.atoms[std::size_t(i)]);
    };
    if (options.hetero == Hetero::None)
        return filter.drop("ligand or ion", [&](std::int32_t i) { return residueAt(i).hetero(); });
    const bool polymer = std::any_of(filter.atoms().begin(), filter.atoms().end(),
                                     [&](std::int32_t i) { return residueAt(i).polymer(); });
    if (options.hetero == Hetero::All || !polymer) return;
    const std::vector<Role> roles = rolesIn(structure, model, assemblyOf(structure, options));
    const auto drop = [&](Role role, const char* what) {
        const auto isOne = [&](std::int32_t i) {
            return roles[std::size_t(structure.atoms[std::size_t(i)].residue)] == role;
        };
        filter.drop(describeRole(structure, what, filter.atoms(), isOne), isOne);
    };
    if (!options.ions) drop(Role::FreeIon, "free ion");
    drop(Role::Buffer, "buffer");
    drop(Role::Lipid, "lipid");
    drop(Role::Apart, "ligand apart");
}

/// Leaves out what is in the file in the place of atoms.
void dropParticles(const Structure& structure, Filter& filter)
{
    const auto drop = [&](AtomRole role, const char* what) {
        filter.drop(what,
                    [&](std::int32_t i) { return structure.atoms[std::size_t(i)].role == role; });
    };
    drop(AtomRole::Particle, "particle that is no atom");
    drop(AtomRole::CoarserScale, "sphere of a coarser scale");
}

void applyFilters(const Structure& structure, const SelectOptions& options, const AtomMatch& match,
                  const Model& model, Filter& filter, BallSet& out)
{
    auto atomAt = [&](std::int32_t i) -> const Atom& { return structure.atoms[std::size_t(i)]; };
    auto residueAt = [&](std::int32_t i) -> const Residue& {
        return residueOf(structure, atomAt(i));
    };
    if (!options.select.empty()) {
        filter.drop("not selected", [&](std::int32_t i) { return !match.atoms[std::size_t(i)]; });
    }
    filter.drop("dummy", [&](std::int32_t i) {
        return atomAt(i).name == "DUM" || residueAt(i).name == "DUM";
    });
    dropParticles(structure, filter);
    if (!options.waters) filter.drop("water", [&](std::int32_t i) { return residueAt(i).water(); });
    dropHetero(structure, options, model, filter);
    if (!options.hydrogens) {
        filter.drop("hydrogen", [&](std::int32_t i) { return atomAt(i).element == 1; });
    }
    chooseAltloc(structure, options.altloc, filter, out);
}

/// Gives every ball the rate of the last rule that has its atom.
void applyResolutions(const Selections& selections, const SelectOptions& options, BallSet& out)
{
    if (options.resolutions.empty()) return;
    const std::vector<std::int32_t> ruleOf =
        selections.lastRules(options.resolutions, out.record.warnings);
    for (const ResolutionRule& rule : options.resolutions) out.resolutions.push_back({rule, 0});
    out.decays.resize(out.balls.size());
    out.resolutionOf.resize(out.balls.size());
    for (std::size_t i = 0; i < out.balls.size(); ++i) {
        const std::int32_t r = ruleOf[std::size_t(out.balls[i].atom)];
        out.resolutionOf[i] = r;
        if (r < 0) continue;
        const double d = options.resolutions[std::size_t(r)].resolution;
        out.decays[i].rate = float(M_PI * M_PI / (d * d));
    }
    countBalls(out, out.resolutionOf, out.resolutions);
    for (const ResolutionGroup& group : out.resolutions) {
        if (group.balls > 0) continue;
        out.record.warnings.push_back("resolution " + inQuotes(group.rule.select) +
                                      ": no ball is left for it");
    }
}

/// The values of the balls.
/// @param[in] probe  of the surface that depths are below [Å]
BallValues valuesBy(const ValueBy& by, const Structure& structure, const SelectOptions& options,
                    double probe, const Progress& progress, BallSet& out)
{
    BallPlaces places{openvdb::Vec3d(0.0), {}};
    for (const Ball& ball : out.balls)
        places.centre += openvdb::Vec3d(ball.center) / double(out.balls.size());
    if (out.placement.unit) places.centre = out.placement.unit->centre;
    if (by.kind == ValueBy::Kind::Depth) places.depths = ballDepths(out, probe, progress);
    BallValues values = ballValues(structure, out.balls, by, out.coloring, places,
                                   options.limits.maxInput, out.record.warnings);
    const std::size_t none = std::size_t(std::count_if(values.valueOf.begin(), values.valueOf.end(),
                                                       [](float v) { return !std::isfinite(v); }));
    if (none == values.valueOf.size() && !values.byPoint())
        failAt(structure.source, values.title + ": no atom has one");
    return values;
}

/// Adds the values that colours show and those that patches are of.
void addValues(const Structure& structure, const SelectOptions& options, const LabelOptions& labels,
               double probe, const Progress& progress, BallSet& out)
{
    const std::optional<ValueBy>&colored = labels.valueBy, &patched = labels.patchBy;
    if (colored) out.labels->values = valuesBy(*colored, structure, options, probe, progress, out);
    const bool same = colored && patched && textOf(*colored) == textOf(*patched);
    if (patched)
        out.labels->patchValues =
            same ? out.labels->values
                 : valuesBy(*patched, structure, options, probe, progress, out);
}

/// Adds the labels, if any are asked for. Prototypes are their groups.
/// @param[in] options  whose groups have the numbers of their copies
void addLabels(const Selections& selections, const LabelOptions& options, BallSet& out)
{
    const std::vector<GroupRule>& groups = options.groups;
    const bool several = out.placement.prototypes() > 1 && !out.placement.folded;
    const bool grouped = !groups.empty() || options.groupBy;
    if (several && grouped)
        throw Error(ErrorKind::Usage,
                    "`groups` and `groupBy`: expected one prototype, the assembly has " +
                        std::to_string(out.placement.copies) + " with `instances`");
    const bool valued = options.valueBy || options.patchBy || !options.colorGroups.empty();
    if (!options.labels && !valued && !grouped && !several) return;
    out.labels = labelBalls(selections, out, groups,
                            several ? GroupBy{GroupBy::Kind::Copy} : options.groupBy);
    if (!options.colorGroups.empty())
        addColorGroups(selections, out, options.colorGroups, *out.labels);
    out.record.warnings.insert(out.record.warnings.end(), out.labels->warnings.begin(),
                               out.labels->warnings.end());
}

/// Counts the beads of the whole, and the atoms that they stand for.
/// @param[in] atoms  that the bead of each representative atom stands for; 0: it is no bead
void countBeads(const std::vector<std::int32_t>& atoms, BallSet& out)
{
    const std::size_t times = out.placement.order();
    for (std::size_t i = 0; i < out.own(); ++i) {
        const std::int32_t n = atoms[std::size_t(out.balls[i].atom)];
        out.record.beads += times * (n > 0);
        out.record.beadAtoms += times * std::size_t(n);
    }
}

/// The groups, with the numbers of their copies.
/// @param[in] balls  in the coordinates of the file
std::vector<GroupRule> withCopies(const Structure& structure,
                                  const std::optional<std::string>& assembly,
                                  std::vector<GroupRule> groups, const std::vector<Ball>& balls)
{
    for (GroupRule& group : groups) {
        if (group.copies.all()) continue;
        const std::string where = "group " + group.name + ": copies: ";
        if (!assembly) {
            throw Error(ErrorKind::Input, where + "expected an assembly [hint: `assembly`]");
        }
        try {
            checkCopies(group.copies);
            group.copyNumbers = findCopies(structure, *assembly, group.copies, balls);
        } catch (const Error& e) { // the file of groups is wrong, not the call
            throw Error(ErrorKind::Input, where + e.what());
        }
    }
    return groups;
}

/// Refuses an assembly whose balls take more memory than there is. They took 75 bytes each, with
/// labels and names, in capsids of 0.3 and 2.9 million.
void checkFits(const AssemblyCopies& assembly, std::size_t memory)
{
    constexpr double perBall = 80.0;
    double balls = 0.0;
    for (const AssemblyCopy& copy : assembly.copies)
        balls += double(assembly.parts[copy.part].size());
    needMemory(assembly.title + "its atoms take", perBall * balls, memory);
}

/// Whether nothing is asked for but places and radii, so that copies of balls are alike.
bool wantsPlacesAlone(const SelectOptions& options, const LabelOptions& labels)
{
    return options.coarse.empty() && options.resolutions.empty() && !labels.labels &&
           !labels.names && !labels.charges && labels.groups.empty() && !labels.groupBy &&
           !labels.valueBy && !labels.patchBy && labels.colorGroups.empty();
}

/// Puts each part of an assembly once, if its copies have no duplicates and lie where balls may.
bool fold(const AssemblyCopies& copies, BallSet& out)
{
    constexpr double farthest = 1e6; // [Å]
    for (const AssemblyCopy& copy : copies.copies)
        if (!std::isfinite(copy.op.translation.lengthSqr())) return false;
    out.placement = foldAssembly(copies, out.balls);
    const RepeatedBalls whole = repeatedBalls(out);
    if (farthestOf(boxOfCentres(whole)) <= farthest && !hasDuplicates(whole)) return true;
    out.balls.clear();
    return false;
}

/// Puts the balls where they belong: as in the file, as a unit of a whole, each prototype or part
/// of an assembly once, or all of its copies.
/// @param[in] balls   in the coordinates of the file
/// @param[in] folded  whether parts may be put once
void placeBalls(const Structure& structure, const SelectOptions& options, bool folded,
                std::vector<Ball> balls, BallSet& out)
{
    const AssemblyChoice& assembly = options.assembly;
    if (!assembly.name) {
        out.balls = std::move(balls);
        out.placement.begin = {0, out.balls.size()};
        out.placement.numbers = {1};
        return;
    }
    const auto place = assembly.bySymmetry  ? chooseUnit
                       : assembly.instances ? instanceAssembly
                                            : expandAssembly;
    const AssemblyCopies copies = copiesOf(structure, *assembly.name, assembly.copies, balls, out);
    if (place == expandAssembly) {
        if (folded && copies.copies.size() > 1 && fold(copies, out)) return;
        checkFits(copies, options.limits.memory);
    }
    out.placement = place(copies, out.balls);
}

} // namespace

void checkOptions(const SelectOptions& options)
{
    const AssemblyChoice& assembly = options.assembly;
    checkCopies(assembly.copies);
    const std::pair<const char*, bool> ofAssemblies[] = {{"`copies`", !assembly.copies.all()},
                                                         {"`instances`", assembly.instances},
                                                         {"`bySymmetry`", assembly.bySymmetry}};
    for (const auto& [name, given] : ofAssemblies) {
        if (given && !assembly.name)
            throw Error(ErrorKind::Usage,
                        std::string(name) +
                            " is for an assembly [hint: `assembly` 1, for example]");
        if (given && assembly.bySymmetry && name != std::string("`bySymmetry`"))
            throw Error(ErrorKind::Usage, std::string("`bySymmetry` and ") + name + " together");
    }
}

void checkOptions(const LabelOptions& options)
{
    if (options.groupBy && options.groupBy->kind == GroupBy::Kind::Residues &&
        options.groupBy->residues < 1)
        throw Error(ErrorKind::Usage, "`groupBy`: expected at least one residue, got " +
                                          std::to_string(options.groupBy->residues));
}

BallSet selectBalls(const Selections& selections, const SelectOptions& options,
                    const LabelOptions& labels, double probe, const Progress& progress)
{
    const Structure& structure = selections.structure();
    if (!structure.placed)
        failAt(structure.source, "has no coordinates, expected them from a trajectory beside it "
                                 "[hint: `trajectory` FILE.dcd or FILE.xtc, with `frames`]");
    if (structure.hasRadii && options.radii != "bondi") {
        throw Error(ErrorKind::Usage, "radii " + inQuotes(options.radii) +
                                          ": expected none, since " +
                                          displayName(structure.source) + " has its own");
    }
    const AtomMatch match = options.select.empty() ? AtomMatch() : selections.match(options.select);
    const Model& model = chooseModel(structure, options, match.models);
    if (!model.problem.empty()) failAt(structure.source, model.problem);
    BallSet out;
    out.record.model = model.number;
    out.record.membrane = membraneNormal(structure, model);
    out.record.warnings = structure.warnings;
    out.record.warnings.insert(out.record.warnings.end(), match.warnings.begin(),
                               match.warnings.end());
    Filter filter(model, out);
    applyFilters(structure, options, match, model, filter, out);
    if (labels.charges)
        out.charges = std::make_shared<const PointCharges>(pointCharges(structure, filter.atoms()));
    std::vector<Ball> balls = makeBalls(structure, options, filter, out);
    std::vector<std::int32_t> beadAtoms; // by the representative atom: how many a bead stands for
    if (!options.coarse.empty()) {
        CoarseBalls coarse = coarseGrain(selections, balls, options.coarse, probe, progress);
        balls = std::move(coarse.balls);
        beadAtoms = std::move(coarse.beadAtoms);
        out.record.warnings.insert(out.record.warnings.end(), coarse.warnings.begin(),
                                   coarse.warnings.end());
    }
    stopIfCancelled(progress);
    LabelOptions labelled = labels;
    for (std::vector<GroupRule>* groups : {&labelled.groups, &labelled.colorGroups})
        *groups = withCopies(structure, options.assembly.name, std::move(*groups), balls);
    placeBalls(structure, options, options.assembly.folded && wantsPlacesAlone(options, labels),
               std::move(balls), out);
    if (out.balls.empty()) {
        const bool anyWater = std::any_of(out.record.drops.begin(), out.record.drops.end(),
                                          [](auto& drop) { return drop.reason == "water"; });
        failAt(structure.source, "nothing is left of " + std::to_string(model.end - model.begin) +
                                     " atoms: dropped " + describeDrops(out.record.drops) +
                                     (anyWater ? " [hint: `waters` keeps it]" : ""));
    }
    if (!out.placement.folded) dropDuplicates(structure, filter, out); // folded, there are none
    checkExtent(structure, boxOfCentres(repeatedBalls(out)));
    surround(options.assembly.surroundings, out);
    warnOfRounding(boxOfCentres(repeatedBalls(out)), out.record.warnings);
    if (!beadAtoms.empty()) countBeads(beadAtoms, out);
    stopIfCancelled(progress);
    applyResolutions(selections, options, out);
    addLabels(selections, labelled, out);
    stopIfCancelled(progress);
    out.coloring = labels.coloring;
    addValues(structure, options, labels, probe, progress, out);
    if (labels.plainColor) out.colors.assign(out.balls.size(), *labels.plainColor);
    if (labels.names) out.names = ballNames(structure, out);
    return out;
}

std::string describeGuesses(const Structure& structure)
{
    std::set<std::string> names;
    std::size_t unknown = 0;
    const bool beads = structure.beads != BeadKind::None;
    const Model& model = structure.models.front();
    for (std::size_t i = model.begin; i < model.end && !beads; ++i) {
        const Atom& atom = structure.atoms[i];
        if (atom.element != 0 || atom.role != AtomRole::Atom) continue;
        ++unknown;
        names.insert(atom.name);
    }
    std::string text = "elements of " + counted(structure.guessed, "atom", "atoms") +
                       " were told by names" + (structure.placed ? "" : " and masses");
    if (beads) text = "the file names no elements";
    if (unknown == 0) return text;
    constexpr std::size_t most = 6;
    return text + "; " + std::to_string(unknown) +
           " unknown: " + joined({names.begin(), names.end()}, most);
}

/// How many atoms of the file the balls are made of.
static std::size_t atomsOfFile(const Structure& structure, const BallSet& selection)
{
    std::vector<char> used(structure.atoms.size());
    for (const Ball& ball : selection.balls) used[std::size_t(ball.atom)] = 1;
    return std::size_t(std::count(used.begin(), used.end(), char{1}));
}

std::string describeSelection(const Structure& structure, const BallSet& selection)
{
    const auto some = [](std::size_t n, const std::string& what) {
        return counted(n, what, what + "s");
    };
    std::size_t atoms = structure.atoms.size();
    for (const Model& model : structure.models) {
        if (model.number == selection.record.model) {
            atoms = model.end - model.begin;
            break;
        }
    }
    std::string text = displayName(structure.source) + ": " + structure.format + ", " +
                       some(structure.models.size(), "model") + ", " + some(atoms, "atom");
    if (structure.models.size() > 1) text += " in model " + std::to_string(selection.record.model);
    const Placement& placement = selection.placement;
    const std::size_t used = placement.folded ? repeatedBalls(selection).size() : selection.own();
    text += "; used " + some(used, selection.record.beads > 0 ? "ball" : "atom");
    if (const auto& unit = placement.unit) {
        text += " (" + counted(unit->copies, "copy", "copies") + ") in each of " +
                std::to_string(placement.order()) + " units that rotations make (" +
                (unit->pointGroup.empty() ? "no point group" : unit->pointGroup) + "), and " +
                std::to_string(placement.around) + " around one";
    } else if (placement.folded) {
        text += " (" + std::to_string(placement.instances.size()) + " copies of " +
                std::to_string(atomsOfFile(structure, selection)) + " in the file)";
    } else if (!placement.isWhole()) {
        text += " of " + some(placement.copies, "prototype") + " for " +
                std::to_string(placement.instances.size()) + " copies";
    } else if (placement.copies > 1)
        text += " (" + std::to_string(placement.copies) + " copies of " +
                std::to_string(atomsOfFile(structure, selection)) + " in the file)";
    if (selection.record.beads > 0) {
        text += ", of them " + some(selection.record.beads, "bead") + " for " +
                some(selection.record.beadAtoms, "atom");
    }
    if (placement.copies == 1 && placement.isWhole()) {
        for (const Assembly& assembly : structure.assemblies) {
            const std::size_t copies = operatorsOf(assembly).size();
            if (copies < 2 || !assembly.problem.empty()) continue;
            text += "; assembly " + assembly.name + " has " + std::to_string(copies) +
                    " copies [hint: `assembly` " + assembly.name + "]";
            break;
        }
    }
    if (!selection.record.drops.empty())
        text += "; dropped " + describeDrops(selection.record.drops);
    if (structure.guessed > 0) text += "; " + describeGuesses(structure);
    return text;
}

} // namespace molsurf
