// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/picture/atom_model.h"

#include "molsurf/error.h"
#include "molsurf/kernel/balls/ball_index.h"
#include "molsurf/kernel/core/orthonormal_basis.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/selection/groups.h"
#include "molsurf/molecule/selection/subset.h"
#include "molsurf/molecule/structure/element.h"
#include "molsurf/molecule/structure/residue_bonds.h"
#include "molsurf/molecule/structure/text_fields.h"
#include "molsurf/show/color/palette.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

constexpr int circle = 24; // corners of a tube
constexpr Color white = {255, 255, 255};
constexpr Color carbonColor = {242, 184, 60};

/// A point of a circle of `circle` corners.
Vec3d onCircle(int k, const Vec3d& u, const Vec3d& v)
{
    const double angle = 2.0 * M_PI * k / circle;
    return std::cos(angle) * u + std::sin(angle) * v;
}

/// Triangles between a ring of vertices and the one before it, the last ones of the mesh.
void joinRings(Mesh& mesh)
{
    const auto end = std::uint32_t(mesh.positions.size());
    const std::uint32_t upper = end - circle, lower = upper - circle;
    for (std::uint32_t k = 0; k < circle; ++k) {
        const std::uint32_t next = (k + 1) % circle;
        mesh.triangles.push_back({lower + k, lower + next, upper + k});
        mesh.triangles.push_back({lower + next, upper + next, upper + k});
    }
}

/// Adds a ring of vertices about a center, with normals outward in its plane.
void addRing(const Vec3d& center, const Vec3d& u, const Vec3d& v, const Color& color, Mesh& mesh)
{
    for (int k = 0; k < circle; ++k) {
        const Vec3d way = onCircle(k, u, v);
        mesh.positions.emplace_back(center + way);
        mesh.normals.emplace_back(way.unit());
        mesh.colors.push_back(color);
    }
}

openvdb::Vec4f ballAt(const Vec3d& x, double radius)
{
    return {float(x[0]), float(x[1]), float(x[2]), float(radius)};
}

void addBall(const Vec3d& at, double radius, const Color& color, AtomModel& model)
{
    AtomUnit& unit = model.units.back();
    unit.balls.push_back(ballAt(at, radius));
    unit.ballColors.push_back(color);
}

void addStick(const Vec3d& from, const Vec3d& to, double radius, const Color& color,
              AtomModel& model)
{
    AtomUnit& unit = model.units.back();
    unit.sticks.push_back({ballAt(from, radius), ballAt(to, radius)});
    unit.stickColors.push_back(color);
}

/// The bonds that tables and files know of atoms.
class KnownBonds
{
public:
    explicit KnownBonds(const ShownAtoms& shown) : names_(*shown.atoms.names)
    {
        for (const BallNames::Residue& residue : names_.residues) {
            const ResidueBonds* row = ResidueBonds::find(residue.name);
            if (shown.bonds && shown.bonds->residues.count(residue.name) > 0)
                row = &shown.bonds->residues.at(residue.name);
            rows_.push_back(row);
        }
        if (shown.bonds && !shown.bonds->links.empty()) addLinks(shown);
    }

    /// The bond of two atoms; nothing: neither the table nor the file knows of it.
    std::optional<BondOrder> between(std::size_t i, std::size_t j) const
    {
        const std::int32_t residue = names_.residueOf[i];
        const ResidueBonds* row = rows_[std::size_t(residue)];
        const std::string &a = names_.atoms[i].name, &b = names_.atoms[j].name;
        const bool inside = names_.residueOf[j] == residue;
        if (inside && row && row->has(a) && row->has(b)) return row->between(a, b);
        if (linked_.empty()) return {};
        const auto link = linked_.find({std::min(i, j), std::max(i, j)});
        if (link != linked_.end()) return link->second;
        if (inside && whole_[std::size_t(residue)]) return BondOrder::None;
        return {};
    }

private:
    /// The chain of the file, and which copy of it: "A-2" is the second one of A.
    static std::pair<std::string, std::string> copyOf(const std::string& chain)
    {
        const std::size_t dash = chain.rfind('-');
        if (dash == std::string::npos || dash == 0) return {chain, ""};
        return {chain.substr(0, dash), chain.substr(dash)};
    }

    /// Finds the atoms of the file's links by their names. Links name chains of the file, and hold
    /// within each copy of them.
    void addLinks(const ShownAtoms& shown)
    {
        std::map<FileBonds::End, std::vector<std::size_t>> ends; // by names in the file
        for (const FileBonds::Link& link : shown.bonds->links) ends[link.a], ends[link.b];
        std::vector<char> linked(names_.atoms.size(), 0);
        for (std::size_t i = 0; i < names_.atoms.size(); ++i) {
            const BallNames::Residue& residue = names_.residues[std::size_t(names_.residueOf[i])];
            for (const std::string& chain :
                 {residue.labelChain, copyOf(residue.labelChain).first}) {
                const auto found =
                    ends.find({chain, residue.number, residue.insertionCode, names_.atoms[i].name});
                if (found == ends.end()) continue;
                found->second.push_back(i);
                linked[i] = 1;
                break;
            }
        }
        const auto chainOf = [&](std::size_t i) { // which copy, "" or "-2"
            return copyOf(names_.residues[std::size_t(names_.residueOf[i])].labelChain).second;
        };
        for (const FileBonds::Link& link : shown.bonds->links)
            for (const std::size_t i : ends[link.a])
                for (const std::size_t j : ends[link.b])
                    if (i != j && chainOf(i) == chainOf(j))
                        linked_[{std::min(i, j), std::max(i, j)}] = link.order;
        whole_.assign(names_.residues.size(), 1);
        for (std::size_t i = 0; i < linked.size(); ++i)
            if (!linked[i]) whole_[std::size_t(names_.residueOf[i])] = 0;
    }

    const BallNames& names_;
    std::vector<const ResidueBonds*> rows_; ///< of residues; null: it has none
    std::map<std::pair<std::size_t, std::size_t>, BondOrder> linked_; ///< by the file, i < j
    std::vector<char> whole_; ///< residues whose atoms are all linked: they have no other bonds
};

struct Bond {
    std::size_t i, j; ///< atoms
    BondOrder order;
};

/// Pairs of atoms that the table of residues or the file joins, and of others those as near as
/// their covalent radii (Cordero et al., Dalton Transactions 2008, as gemmi has them) and a
/// tolerance of 0.45 Å.
std::vector<Bond> bondsOf(const ShownAtoms& shown)
{
    constexpr double tolerance = 0.45, least = 0.4, reach = 3.0; // [Å]
    const BallSet& atoms = shown.atoms;
    const BallIndex index(atoms.balls, {1.0, 1.0, 2.0});
    const KnownBonds known(shown);
    const std::vector<std::uint8_t>& element = atoms.labels->elementOf;
    std::vector<Bond> bonds;
    for (std::size_t i = 0; i < atoms.balls.size(); ++i) {
        const Vec3d& x = atoms.balls[i].center;
        index.forEachNear(x, x, reach, [&](const Ball& other, std::int32_t at) {
            const auto j = std::size_t(at);
            if (j <= i || (element[i] == 1 && element[j] == 1)) return;
            const double d2 = (other.center - x).lengthSqr();
            if (d2 > reach * reach) return; // the index gives some that lie farther
            const double far = covalentRadius(element[i]) + covalentRadius(element[j]) + tolerance;
            const bool near = d2 > least * least && d2 < far * far;
            const BondOrder order =
                known.between(i, j).value_or(near ? BondOrder::Single : BondOrder::None);
            if (order != BondOrder::None) bonds.push_back({i, j, order});
        });
    }
    return bonds;
}

/// The colours that the atoms have; else elements by theirs, but carbon: it has the colour of its
/// chain, or one that differs from a grey surface.
std::vector<Color> atomColors(const ShownAtoms& shown, const Progress& progress, AtomModel& model)
{
    const BallSet& atoms = shown.atoms;
    const BallLabels& labels = *atoms.labels;
    if (!atoms.colors.empty()) return atoms.colors;
    std::vector<Color> colors = ballColors(atoms, ColorBy::Element, progress);
    const std::vector<Color> ofChains =
        shown.byChain ? chainColors(atoms, progress) : std::vector<Color>();
    for (std::size_t i = 0; i < colors.size(); ++i) {
        const bool carbon = labels.elementOf[i] == carbonElement;
        const auto chain = std::size_t(labels.chainOf[i]);
        if (carbon) colors[i] = shown.byChain ? ofChains[chain] : carbonColor;
        if (carbon && shown.byChain)
            addEntry({labels.chains[chain], colors[i]}, model.chains);
        else
            addEntry({elementSymbol(labels.elementOf[i]), colors[i]}, model.elements);
    }
    return colors;
}

/// Half a stick from each end of a line between two atoms.
void addHalves(const Vec3d& a, const Vec3d& b, double radius, const Color& ofA, const Color& ofB,
               AtomModel& model)
{
    const Vec3d middle = 0.5 * (a + b);
    addStick(a, middle, radius, ofA, model);
    addStick(b, middle, radius, ofB, model);
}

/// Balls of some size, and half a stick from each end of a bond.
void addBonded(const ShownAtoms& shown, const Progress& progress, double stick,
               double (*sizeOf)(const Ball&), AtomModel& model)
{
    const BallSet& atoms = shown.atoms;
    const std::vector<Color> colors = atomColors(shown, progress, model);
    for (std::size_t i = 0; i < atoms.balls.size(); ++i)
        addBall(atoms.balls[i].center, sizeOf(atoms.balls[i]), colors[i], model);
    for (const auto& [i, j, order] : bondsOf(shown))
        addHalves(atoms.balls[i].center, atoms.balls[j].center, stick, colors[i], colors[j], model);
}

constexpr double stickRadius = 0.25, thinStick = 0.14, tubeRadius = 0.6; // [Å]

void addSticks(const ShownAtoms& shown, const Progress& progress, AtomModel& model)
{
    addBonded(
        shown, progress, stickRadius, [](const Ball&) { return stickRadius; }, model);
}

void addBalls(const ShownAtoms& shown, const Progress& progress, AtomModel& model)
{
    addBonded(
        shown, progress, thinStick, [](const Ball& ball) { return 0.27 * ball.radius; }, model);
}

/// The way aside from a bond, in the plane of the neighbours of its ends and toward most of them:
/// of an aromatic bond those in its ring.
/// @param[in] at  the bonds of each atom
Vec3d asideOf(const Bond& bond, const std::vector<Bond>& bonds,
              const std::vector<std::vector<std::size_t>>& at, const BallSet& atoms)
{
    const Vec3d a = atoms.balls[bond.i].center, b = atoms.balls[bond.j].center;
    const Vec3d along = (b - a).unit();
    Vec3d sum(0.0), any(0.0);
    for (const std::size_t end : {bond.i, bond.j}) {
        for (const std::size_t n : at[end]) {
            const Bond& other = bonds[n];
            const std::size_t far = other.i == end ? other.j : other.i;
            if (far == bond.i || far == bond.j) continue;
            if (bond.order == BondOrder::Aromatic && other.order != BondOrder::Aromatic) continue;
            const Vec3d way = atoms.balls[far].center - atoms.balls[end].center;
            const Vec3d across = way - way.dot(along) * along;
            sum += across;
            if (across.lengthSqr() > any.lengthSqr()) any = across;
        }
    }
    constexpr double least = 0.3; // of neighbours on both sides the sum is next to nothing [Å]
    if (sum.length() > least) return sum.unit();
    return any.length() > least ? any.unit() : perpendicular(along)[0];
}

/// A row of short sticks: each has the middle half of a third of the line.
void addDashes(const Vec3d& a, const Vec3d& b, double radius, const Color& ofA, const Color& ofB,
               AtomModel& model)
{
    constexpr int dashes = 3;
    for (int k = 0; k < dashes; ++k) {
        const double from = (2.0 * k + 0.5) / (2.0 * dashes), to = from + 0.5 / dashes;
        const Vec3d start = a + from * (b - a), end = a + to * (b - a);
        addHalves(start, end, radius, ofA, ofB, model);
    }
}

/// Double and triple bonds as lines side by side, aromatic ones with dashes inside of their ring.
void addOrders(const ShownAtoms& shown, const Progress& progress, AtomModel& model)
{
    // [Å]; the balls hide the ends of the lines
    constexpr double joint = 0.28, single = 0.12, thin = 0.08, dash = 0.06, apart = 0.16,
                     wide = 0.19, inside = 0.36;
    const BallSet& atoms = shown.atoms;
    const std::vector<Color> colors = atomColors(shown, progress, model);
    for (std::size_t i = 0; i < atoms.balls.size(); ++i)
        addBall(atoms.balls[i].center, joint, colors[i], model);
    const std::vector<Bond> bonds = bondsOf(shown);
    std::vector<std::vector<std::size_t>> at(atoms.balls.size());
    for (std::size_t n = 0; n < bonds.size(); ++n)
        for (const std::size_t end : {bonds[n].i, bonds[n].j}) at[end].push_back(n);
    for (const Bond& bond : bonds) {
        const Vec3d a = atoms.balls[bond.i].center, b = atoms.balls[bond.j].center;
        const Color &ofA = colors[bond.i], &ofB = colors[bond.j];
        const auto line = [&](const Vec3d& aside, double radius) {
            addHalves(a + aside, b + aside, radius, ofA, ofB, model);
        };
        if (bond.order == BondOrder::Single) {
            line(Vec3d(0.0), single);
            continue;
        }
        const Vec3d aside = asideOf(bond, bonds, at, atoms);
        if (bond.order == BondOrder::Double) {
            for (const double side : {-apart, apart}) line(side * aside, thin);
        } else if (bond.order == BondOrder::Triple) {
            for (const double side : {-wide, 0.0, wide}) line(side * aside, thin);
        } else {
            line(Vec3d(0.0), single);
            addDashes(a + inside * aside, b + inside * aside, dash, ofA, ofB, model);
        }
    }
}

void addSpheres(const ShownAtoms& shown, const Progress& progress, AtomModel& model)
{
    const BallSet& atoms = shown.atoms;
    const std::vector<Color> colors = atomColors(shown, progress, model);
    for (std::size_t i = 0; i < atoms.balls.size(); ++i)
        addBall(atoms.balls[i].center, atoms.balls[i].radius, colors[i], model);
}

/// A cubic through p[1] at 0 and p[2] at 1 (Catmull and Rom), and its derivative.
std::array<Vec3d, 2> onCurve(const std::array<Vec3d, 4>& p, double t)
{
    const Vec3d a = 0.5 * (p[2] - p[0]), b = p[0] - 2.5 * p[1] + 2.0 * p[2] - 0.5 * p[3],
                c = 0.5 * (p[3] - p[0]) + 1.5 * (p[1] - p[2]);
    return {p[1] + t * (a + t * (b + t * c)), a + t * (2.0 * b + t * 3.0 * c)};
}

/// A tube through at least two points, with round ends: rings along the cubics between them, each
/// turned from the one before by parallel transport. Beyond the ends the curve goes on straight.
void addTube(const std::vector<Vec3d>& points, const std::vector<Color>& colors, AtomModel& model)
{
    constexpr int pieces = 8; // between two points
    const std::size_t last = points.size() - 1;
    const auto point = [&](std::ptrdiff_t i) {
        if (i < 0) return 2.0 * points[0] - points[1];
        return std::size_t(i) > last ? 2.0 * points[last] - points[last - 1]
                                     : points[std::size_t(i)];
    };
    Vec3d u(0.0);
    for (std::size_t n = 0; n <= last * pieces; ++n) {
        const auto i = std::ptrdiff_t(std::min(n / pieces, last - 1));
        const double t = double(n) / pieces - double(i);
        const auto [at, along] = onCurve({point(i - 1), point(i), point(i + 1), point(i + 2)}, t);
        const Vec3d way = along.lengthSqr() > 0.0 ? along.unit() : Vec3d(0, 0, 1);
        u -= u.dot(way) * way; // the last ring's, at right angles to the way
        u = u.lengthSqr() > 1e-6 ? u.unit() : perpendicular(way)[0];
        Mesh& mesh = model.units.back().mesh;
        const Color& color = colors[(n + pieces / 2) / pieces]; // of the nearest point
        addRing(at, tubeRadius * u, tubeRadius * way.cross(u), color, mesh);
        if (n > 0) joinRings(mesh);
    }
    addBall(points.front(), tubeRadius, colors.front(), model);
    addBall(points.back(), tubeRadius, colors.back(), model);
}

/// 0 for the CA of an amino acid, 1 for the P of a nucleotide, else -1.
int backboneKind(const BallSet& atoms, std::size_t i)
{
    const std::string& name = atoms.names->atoms[i].name;
    return name == "CA" && atoms.labels->elementOf[i] == carbonElement ? 0 : name == "P" ? 1 : -1;
}

/// Through the CA of amino acids and the P of nucleotides, broken where neighbours are too far
/// apart to be bonded.
void addTubes(const ShownAtoms& shown, const Progress& progress, AtomModel& model)
{
    const BallSet& atoms = shown.atoms;
    constexpr double farthest[] = {4.4, 8.0}; // of CA, of P [Å]
    const std::vector<Color> ofChains =
        atoms.colors.empty() ? chainColors(atoms, progress) : std::vector<Color>();
    std::vector<Vec3d> points;
    std::vector<Color> colors; // of the points
    std::int32_t chain = -1;
    int kind = 0;
    const auto end = [&] {
        if (points.size() > 1) {
            addTube(points, colors, model);
            if (!ofChains.empty())
                addEntry({atoms.labels->chains[std::size_t(chain)], colors[0]}, model.chains);
        }
        points.clear();
        colors.clear();
    };
    for (std::size_t i = 0; i < atoms.balls.size(); ++i) {
        const int found = backboneKind(atoms, i);
        if (found < 0) continue;
        const Vec3d& x = atoms.balls[i].center;
        const std::int32_t own = atoms.labels->chainOf[i];
        if (points.empty() || own != chain || found != kind ||
            (x - points.back()).length() > farthest[found])
            end();
        chain = own;
        kind = found;
        points.push_back(x);
        colors.push_back(ofChains.empty() ? atoms.colors[i] : ofChains[std::size_t(own)]);
    }
    end();
}

// Measured, with what Embree takes, on 289,001 atoms, by vdb_molsurf 4v5a.cif.gz --voxel 2
// --select AA/1-9 --show polymer=spheres, or sticks, orders, tube; and on 10^5 copies.
constexpr double bytesPerBall = 150.0, bytesPerBondedAtom = 400.0, bytesPerCopy = 1300.0;
constexpr double bytesPerBackboneAtom = 50e3;

double bytesOfBonded(const BallSet& atoms)
{
    return bytesPerBondedAtom * double(atoms.balls.size());
}

double bytesOfOrders(const BallSet& atoms)
{
    constexpr double more = 2.0; // of all bonds double or aromatic
    return more * bytesOfBonded(atoms);
}

double bytesOfSpheres(const BallSet& atoms)
{
    return bytesPerBall * double(atoms.balls.size());
}

double bytesOfTubes(const BallSet& atoms)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < atoms.balls.size(); ++i) count += backboneKind(atoms, i) >= 0;
    return bytesPerBackboneAtom * double(count);
}

} // namespace

const std::vector<AtomStyle>& atomStyles()
{
    static const std::vector<AtomStyle> all = {
        {"sticks", "bonds", addSticks, bytesOfBonded},
        {"balls", "small balls and thin bonds", addBalls, bytesOfBonded},
        {"orders", "thin bonds, double, triple and aromatic ones as such", addOrders,
         bytesOfOrders},
        {"spheres", "by van der Waals radii", addSpheres, bytesOfSpheres},
        {"tube", "the backbone", addTubes, bytesOfTubes}};
    return all;
}

namespace
{

using Values = std::vector<std::string>;

/// A hint on what stands in the place of a style: a word of another program, a slip, or a selection
/// without a style.
/// @param[in] others  words that are no styles, and are taken, too
std::string styleMeant(const std::string& text, const std::string& word, const Values& others,
                       Values words)
{
    words.insert(words.end(), others.begin(), others.end());
    const std::string near = didYouMean(word, words,
                                        {{"cartoon ribbon ribbons backbone trace ca", "tube"},
                                         {"line lines licorice wire bonds stick", "sticks"},
                                         {"cpk vdw spacefill sphere", "spheres"},
                                         {"ball-and-stick ball+stick ballandstick", "balls"}});
    const bool bare = near.empty() && text.find('=') == std::string::npos &&
                      text.find_first_of(" /()") != std::string::npos; // a selection
    return bare ? " [hint: `show` " + inQuotes(text + "=sticks") + "]" : near;
}

/// Takes a word behind that of a style.
void takeAddition(const std::string& word, const std::string& text, ShowRule& rule)
{
    const std::pair<const char*, bool ShowRule::*> switches[] = {{"golden", &ShowRule::golden},
                                                                 {"others", &ShowRule::others}};
    for (const auto& [name, member] : switches)
        if (word == name) {
            rule.*member = true;
            return;
        }
    rule.color = parseColor(word);
    if (!rule.color)
        throw Error(ErrorKind::Usage, "`show`: expected golden, others or a colour behind " +
                                          std::string(rule.style->word) + ", got " +
                                          inQuotes(word) + " in " + inQuotes(text) +
                                          didYouMean(word, {"golden", "others"}, {}));
}

} // namespace

ShowRule parseShow(const std::string& text, const std::vector<std::string>& others)
{
    const std::size_t equals = text.rfind('=');
    const bool named = equals != std::string::npos;
    ShowRule rule{named ? text.substr(0, equals) : "", nullptr};
    const std::string tail = lowered(named ? text.substr(equals + 1) : text);
    const std::string word = tail.substr(0, tail.find(','));
    Values words;
    for (const AtomStyle& style : atomStyles()) {
        if (word == style.word) rule.style = &style;
        words.push_back(style.word);
    }
    if (!rule.style || (named && rule.select.empty()))
        throw Error(ErrorKind::Usage, "`show`: expected " + joinWords(words, ", ") +
                                          ", or SELECTION= and one of them, got " + inQuotes(text) +
                                          styleMeant(text, word, named ? Values() : others, words));
    for (std::size_t end = word.size(); end < tail.size();) {
        const std::size_t begin = end + 1;
        end = std::min(tail.find(',', begin), tail.size());
        takeAddition(tail.substr(begin, end - begin), text, rule);
    }
    return rule;
}

double bytesOfModel(const std::vector<ShownAtoms>& shown)
{
    double bytes = 0.0;
    for (const ShownAtoms& some : shown)
        bytes += some.rule.style->bytesOf(some.atoms) +
                 bytesPerCopy * double(some.atoms.placement.instances.size());
    return bytes;
}

namespace
{

/// Adds a unit if it has something in it, and its copies.
void addUnit(const ShownAtoms& some, const std::vector<MeshInstance>& copies,
             const Progress& progress, AtomModel& model)
{
    const std::size_t place = model.units.size();
    model.units.emplace_back();
    some.rule.style->add(some, progress, model);
    if (model.units.back().empty()) return model.units.pop_back();
    for (const MeshInstance& copy : copies) {
        model.copies.push_back(copy);
        model.copies.back().part = place;
    }
}

/// A prototype with its names and colours.
BallSet prototypeOf(const BallSet& atoms, std::size_t p)
{
    const auto [begin, end] = atoms.prototype(p);
    std::vector<std::size_t> which(end - begin);
    std::iota(which.begin(), which.end(), begin);
    BallSet out = subset(atoms, which);
    out.labels->chainColors = atoms.labels->chainColors;
    const BallNames& all = *atoms.names;
    BallNames& names = out.names.emplace();
    names.residues = all.residues;
    for (const std::size_t i : which) {
        names.residueOf.push_back(all.residueOf[i]);
        names.atoms.push_back(all.atoms[i]);
    }
    return out;
}

/// Adds atoms as they are, or each prototype of an assembly once, with its copies.
void addAtoms(const ShownAtoms& some, const Progress& progress, AtomModel& model)
{
    const BallSet& atoms = some.atoms;
    if (atoms.placement.isWhole())
        return addUnit(some, {{Motion::identity(), 0, "", white}}, progress, model);
    const std::vector<Color> colors =
        some.rule.byCopy ? instanceColors(atoms, progress) : std::vector<Color>();
    for (std::size_t p = 0; p < atoms.placement.prototypes(); ++p) {
        const ShownAtoms part{prototypeOf(atoms, p), some.rule, some.bonds, some.byChain};
        std::vector<MeshInstance> copies;
        for (std::size_t i = 0; i < atoms.placement.instances.size(); ++i) {
            const Instance& copy = atoms.placement.instances[i];
            const Color& color = colors.empty() ? white : colors[i];
            if (copy.part == p) copies.push_back({copy, p, "", color});
        }
        addUnit(part, copies, progress, model);
    }
}

} // namespace

AtomModel atomModel(const std::vector<ShownAtoms>& shown, const Progress& progress)
{
    AtomModel model;
    for (const ShownAtoms& some : shown) {
        const std::size_t before = model.units.size();
        addAtoms(some, progress, model);
        if (model.units.size() > before) continue;
        const ShowRule& rule = some.rule;
        throw Error(ErrorKind::Input, "`show` " + (rule.select.empty() ? "" : rule.select + "=") +
                                          rule.style->word + ": there is nothing to show");
    }
    return model;
}

void addBodies(const Bodies& bodies, AtomModel& model)
{
    const bool throughLight = !model.units.empty();
    model.bodies = bodies;
    if (throughLight) return;
    model.units.emplace_back().mesh = std::exchange(model.bodies.mesh, {});
    model.copies.push_back({Motion::identity(), 0, "", white});
}

} // namespace molsurf
