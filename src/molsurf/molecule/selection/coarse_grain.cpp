// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/coarse_grain.h"

#include "molsurf/error.h"
#include "molsurf/kernel/balls/bead_radii.h"
#include "molsurf/molecule/selection/match_atoms.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;
using std::string_view;
using Members = std::vector<std::size_t>; // indices of balls, ascending

/// Atoms of a ligand, or of what else is no residue, that share a bead, as in the usual four-to-one
/// maps.
constexpr int ligandAtoms = 4;
constexpr int maxAtoms = 1'000'000;

bool isOneOf(const std::string& name, std::initializer_list<string_view> names)
{
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// Sugar atoms are primed; old files have an asterisk.
bool isPrimed(const std::string& name)
{
    return !name.empty() && (name.back() == '\'' || name.back() == '*');
}

/// Parts of a polymer's residue, one bead each.
enum class Part : std::uint8_t { Backbone, SideChain, Phosphate, Sugar, Base };

/// The kind of a residue, by the names of its atoms.
enum class Kind : std::uint8_t { AminoAcid, Nucleotide, Other };

Part partOf(Kind kind, const std::string& name)
{
    if (kind == Kind::AminoAcid) {
        return isOneOf(name, {"N", "CA", "C", "O", "OXT", "OT1", "OT2"}) ? Part::Backbone
                                                                         : Part::SideChain;
    }
    if (isOneOf(name, {"P", "OP1", "OP2", "OP3", "O1P", "O2P", "O3P", "O5'", "O5*"})) {
        return Part::Phosphate;
    }
    return isPrimed(name) ? Part::Sugar : Part::Base;
}

/// Gathers the balls of the beads.
class Grouping
{
public:
    Grouping(const Structure& structure, const std::vector<Ball>& balls,
             const std::vector<CoarseRule>& rules, const std::vector<std::int32_t>& ruleOf)
        : structure_(structure), balls_(balls), rules_(rules), ruleOf_(ruleOf)
    {
        // Balls come residue by residue, as the atoms of the file do.
        std::map<std::int32_t, Members> residues;
        for (std::size_t i = 0; i < balls.size(); ++i) residues[atom(i).residue].push_back(i);
        for (const auto& [index, members] : residues) addResidue(index, members);
        for (const auto& [key, units] : chains_) cut(units, rules_[std::get<0>(key)].atoms);
        std::sort(beads_.begin(), beads_.end());
    }

    std::vector<Members> take() { return std::move(beads_); }

private:
    /// A heavy atom and its hydrogens, which stay together.
    using Unit = Members;

    const Atom& atom(std::size_t ball) const
    {
        return structure_.atoms[std::size_t(balls_[ball].atom)];
    }

    std::size_t rule(std::size_t ball) const
    {
        return std::size_t(ruleOf_[std::size_t(balls_[ball].atom)]);
    }

    /// Makes the beads of a residue: waters whole, ligands cut into parts, backbone and side chain
    /// of others.
    void addResidue(std::int32_t index, const Members& members)
    {
        const Residue& residue = structure_.residues[std::size_t(index)];
        std::map<std::size_t, Members> byRule;
        for (const std::size_t i : members) byRule[rule(i)].push_back(i);
        for (const auto& [r, chosen] : byRule) {
            const CoarseRule& how = rules_[r];
            if (how.level == CoarseRule::Level::Atom) {
                for (const std::size_t i : chosen) beads_.push_back({i});
            } else if (residue.water()) {
                beads_.push_back(chosen);
            } else if (residue.hetero()) {
                cut(unitsOf(chosen),
                    how.level == CoarseRule::Level::Residue ? ligandAtoms : how.atoms);
            } else if (how.level == CoarseRule::Level::Residue) {
                addParts(members, chosen);
            } else {
                auto& units = chains_[{r, residue.chain, residue.asym}];
                for (Unit& unit : unitsOf(chosen)) units.push_back(std::move(unit));
            }
        }
    }

    /// The beads of a polymer's residue, of which only some atoms may be chosen.
    void addParts(const Members& residue, const Members& chosen)
    {
        bool ca = false, peptide = false, primed = false;
        for (const std::size_t i : residue) {
            const std::string& name = atom(i).name;
            ca = ca || name == "CA";
            peptide = peptide || name == "N" || name == "C" || name == "O";
            primed = primed || isOneOf(name, {"C1'", "C4'", "C1*", "C4*", "P"});
        }
        const Kind kind = ca && peptide ? Kind::AminoAcid : primed ? Kind::Nucleotide : Kind::Other;
        if (kind == Kind::Other) return cut(unitsOf(chosen), ligandAtoms);
        std::map<Part, Members> parts;
        for (const Unit& unit : unitsOf(chosen)) {
            Members& part = parts[partOf(kind, atom(unit[0]).name)];
            part.insert(part.end(), unit.begin(), unit.end());
        }
        for (auto& [part, members] : parts) {
            std::sort(members.begin(), members.end());
            beads_.push_back(std::move(members));
        }
    }

    /// Every hydrogen with the nearest heavy atom; the heavy one first.
    std::vector<Unit> unitsOf(const Members& members) const
    {
        std::vector<Unit> units;
        for (const std::size_t i : members) {
            if (atom(i).element != 1) units.push_back({i});
        }
        if (units.empty()) return {members};
        for (const std::size_t i : members) {
            if (atom(i).element != 1) continue;
            auto away = [&](const Unit& u) {
                return (atom(u[0]).position - atom(i).position).lengthSqr();
            };
            std::min_element(units.begin(), units.end(), [&](const Unit& a, const Unit& b) {
                return away(a) < away(b);
            })->push_back(i);
        }
        return units;
    }

    /// Cuts units into beads of about so many atoms: their number is rounded.
    void cut(std::vector<Unit> units, int atoms)
    {
        std::size_t count = 0;
        for (const Unit& unit : units) count += unit.size();
        const std::size_t wanted = (2 * count + std::size_t(atoms)) / (2 * std::size_t(atoms));
        const std::size_t beads = std::clamp<std::size_t>(wanted, 1, units.size());
        cut(units.begin(), units.end(), beads);
    }

    using UnitIterator = std::vector<Unit>::iterator;

    /// Recursive bisection, as of a k-d tree: cuts across the longest extent so that both parts
    /// hold the atoms of their share of the beads.
    void cut(UnitIterator begin, UnitIterator end, std::size_t beads)
    {
        if (beads <= 1 || end - begin <= 1) {
            Members members;
            for (auto u = begin; u != end; ++u) members.insert(members.end(), u->begin(), u->end());
            std::sort(members.begin(), members.end());
            if (!members.empty()) beads_.push_back(std::move(members));
            return;
        }
        Vec3d low(std::numeric_limits<double>::max()), high = -low;
        for (auto u = begin; u != end; ++u) {
            low = openvdb::math::minComponent(low, atom((*u)[0]).position);
            high = openvdb::math::maxComponent(high, atom((*u)[0]).position);
        }
        const Vec3d extent = high - low;
        const int axis = extent[0] >= extent[1] && extent[0] >= extent[2] ? 0
                         : extent[1] >= extent[2]                         ? 1
                                                                          : 2;
        std::sort(begin, end, [&](const Unit& a, const Unit& b) {
            const double x = atom(a[0]).position[axis], y = atom(b[0]).position[axis];
            return x < y || (x == y && a[0] < b[0]);
        });
        const std::size_t first = beads / 2;
        std::size_t total = 0, sum = 0;
        for (auto u = begin; u != end; ++u) total += u->size();
        auto middle = begin;
        while (sum * beads < total * first) sum += (middle++)->size();
        // Each side needs a unit a bead.
        const auto least = begin + static_cast<std::ptrdiff_t>(first);
        const auto most = end - static_cast<std::ptrdiff_t>(beads - first);
        middle = std::clamp(middle, least, most);
        cut(begin, middle, first);
        cut(middle, end, beads - first);
    }

    const Structure& structure_;
    const std::vector<Ball>& balls_;
    const std::vector<CoarseRule>& rules_;
    const std::vector<std::int32_t>& ruleOf_;
    std::vector<Members> beads_;
    std::map<std::tuple<std::size_t, std::int32_t, std::int32_t>, std::vector<Unit>> chains_;
};

/// Centre by volume, and the atom nearest to it.
Ball beadOf(const Structure& structure, const std::vector<Ball>& balls, const Members& members)
{
    auto position = [&](std::size_t i) {
        return structure.atoms[std::size_t(balls[i].atom)].position;
    };
    Vec3d centre(0.0);
    double volume = 0.0;
    for (const std::size_t i : members) {
        const double r = static_cast<double>(balls[i].radius), cube = r * r * r;
        centre += cube * position(i);
        volume += cube;
    }
    centre /= volume;
    const std::size_t nearest =
        *std::min_element(members.begin(), members.end(), [&](std::size_t a, std::size_t b) {
            return (position(a) - centre).lengthSqr() < (position(b) - centre).lengthSqr();
        });
    return {centre, 0.0, balls[nearest].atom};
}

} // namespace

CoarseRule parseCoarse(const std::string& text)
{
    CoarseRule rule;
    const std::size_t equals = text.rfind('=');
    if (equals != std::string::npos) {
        rule.select = trimmed(string_view(text).substr(0, equals));
    }
    const string_view word =
        trimmed(string_view(text).substr(equals == std::string::npos ? 0 : equals + 1));
    const bool named = equals == std::string::npos || !rule.select.empty();
    if (named && word == "atom") return rule;
    if (named && word == "residue") {
        rule.level = CoarseRule::Level::Residue;
        return rule;
    }
    if (named && parseInteger(word, rule.atoms) && rule.atoms >= 1 && rule.atoms <= maxAtoms) {
        if (rule.atoms > 1) rule.level = CoarseRule::Level::Cluster;
        return rule;
    }
    throw Error(ErrorKind::Usage,
                "`coarse`: expected atom, residue, a number of atoms from 1 to 1000000, or "
                "SELECTION= and one of them, got " +
                    inQuotes(text));
}

std::string nameOf(const CoarseRule& rule)
{
    std::string word = std::to_string(rule.atoms);
    if (rule.level == CoarseRule::Level::Atom) word = "atom";
    if (rule.level == CoarseRule::Level::Residue) word = "residue";
    return rule.select.empty() ? word : rule.select + "=" + word;
}

CoarseBalls coarseGrain(const Selections& selections, const std::vector<Ball>& balls,
                        const std::vector<CoarseRule>& given, double probe,
                        const Progress& progress)
{
    const Structure& structure = selections.structure();
    CoarseBalls out;
    std::vector<CoarseRule> rules(1); // atom
    rules.insert(rules.end(), given.begin(), given.end());
    const std::vector<std::int32_t> ruleOf = selections.lastRules(rules, out.warnings);
    out.members = Grouping(structure, balls, rules, ruleOf).take();
    out.balls.reserve(out.members.size());
    out.beadAtoms.resize(structure.atoms.size());
    for (const Members& bead : out.members) {
        const auto atom = std::size_t(balls[bead[0]].atom);
        if (rules[std::size_t(ruleOf[atom])].level == CoarseRule::Level::Atom) {
            out.balls.push_back(balls[bead[0]]);
            continue;
        }
        out.balls.push_back(beadOf(structure, balls, bead));
        out.beadAtoms[std::size_t(out.balls.back().atom)] = std::int32_t(bead.size());
    }
    sizeBeads(balls, out.members, probe, out.balls, progress);
    return out;
}

} // namespace molsurf
