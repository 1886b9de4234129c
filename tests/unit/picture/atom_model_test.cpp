// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/picture/atom_model.h"

#include "molsurf/error.h"
#include "molsurf/molecule/structure/residue_bonds.h"
#include "molsurf/show/picture/draw_mesh.h"
#include "molsurf/show/picture/style.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;
using openvdb::Vec3f;

BallSet atomsOf(const char* select)
{
    SelectOptions options;
    options.select = select;
    return readAtoms(MOLSURF_TEST_DATA "/1crn.pdb", options);
}

AtomModel modelOf(const BallSet& atoms, const char* style)
{
    return atomModel({{atoms, parseShow(style)}}, Progress());
}

/// How many balls, sticks and meshes of tubes there are.
std::array<int, 3> partsOf(const AtomModel& model)
{
    std::array<int, 3> count{};
    for (const AtomUnit& unit : model.units) {
        count[0] += int(unit.balls.size());
        count[1] += int(unit.sticks.size());
        count[2] += !unit.mesh.triangles.empty();
    }
    return count;
}

Vec3d centerOf(const openvdb::Vec4f& ball)
{
    return {ball[0], ball[1], ball[2]};
}

// Crambin is one chain of 327 atoms with 5 prolines, 2 tyrosines, a phenylalanine and 3 disulfides:
// a tree of its atoms has 326 bonds, and each ring one more.
TEST(AtomModel, HasTheBondsOfCrambin)
{
    const auto [balls, sticks, tubes] = partsOf(modelOf(atomsOf(""), "sticks"));
    EXPECT_EQ(balls, 327);
    EXPECT_EQ(sticks, 2 * (326 + 5 + 2 + 1 + 3));
    EXPECT_EQ(tubes, 0);
    EXPECT_EQ(partsOf(modelOf(atomsOf(""), "balls"))[1], sticks);
    EXPECT_EQ(partsOf(modelOf(atomsOf(""), "spheres")), (std::array<int, 3>{327, 0, 0}));
}

// Two atoms of hydrogen are never bonded, whatever is as near as its radii say is.
TEST(AtomModel, BondsByDistance)
{
    BallSet atoms = atomsOf("/1/A/1/N,CA");
    ASSERT_EQ(atoms.balls.size(), 2u);
    atoms.names->residues[0].name = "XXX"; // of which no table knows
    const auto sticksAt = [&](double distance, std::uint8_t a, std::uint8_t b) {
        atoms.balls[1].center = atoms.balls[0].center + Vec3d(0.0, distance, 0.0);
        atoms.labels->elementOf = {a, b};
        return partsOf(modelOf(atoms, "sticks"))[1];
    };
    EXPECT_EQ(sticksAt(0.73 + 0.71 + 0.44, 6, 7), 2);
    EXPECT_EQ(sticksAt(0.73 + 0.71 + 0.46, 6, 7), 0);
    EXPECT_EQ(sticksAt(0.75, 1, 1), 0);
    EXPECT_EQ(sticksAt(1.0, 1, 7), 2);
    EXPECT_EQ(sticksAt(2.1, 26, 7), 2); // iron
}

// The table of residues joins what lies too far apart, and parts what lies too near: of ATP in
// 4AT1, with names of 1990, the ribose's O2* and O3* lie 2.0 Å apart.
TEST(AtomModel, BondsByTheTable)
{
    BallSet atoms = atomsOf("/1/A/1/N,CA"); // of a threonine
    atoms.balls[1].center = atoms.balls[0].center + Vec3d(0.0, 2.4, 0.0);
    EXPECT_EQ(partsOf(modelOf(atoms, "sticks"))[1], 2);
    atoms.names->atoms[1].name = "O";
    atoms.balls[1].center = atoms.balls[0].center + Vec3d(0.0, 1.4, 0.0);
    EXPECT_EQ(partsOf(modelOf(atoms, "sticks"))[1], 0);

    SelectOptions options;
    options.select = "resn ATP and chain B";
    options.hetero = Hetero::All;
    const BallSet ligand = readAtoms(MOLSURF_TEST_DATA "/4at1.ent.gz", options);
    ASSERT_EQ(ligand.balls.size(), 31u);
    EXPECT_EQ(partsOf(modelOf(ligand, "sticks"))[1], 2 * (31 - 1 + 3)); // three rings
}

/// How many sticks the bonds of threonine 1 of crambin have, whose name the table lacks.
/// @param[in] links  pairs of atoms that a file joins
int sticksOf(const std::vector<std::array<const char*, 2>>& links, const char* residue = "XXX")
{
    ShownAtoms shown{atomsOf("/1/A/1"), parseShow("sticks"), nullptr};
    shown.atoms.names->residues[0].name = residue;
    const auto bonds = std::make_shared<FileBonds>();
    for (const auto& [a, b] : links) bonds->links.push_back({{"A", 1, ' ', a}, {"A", 1, ' ', b}});
    shown.bonds = bonds;
    return partsOf(atomModel({shown}, Progress()))[1];
}

// A link of the file joins what lies too far apart. A residue all of whose atoms are linked has no
// other bonds; the table of residues knows better than both.
TEST(AtomModel, BondsOfTheFile)
{
    constexpr int bonds = 6; // N-CA-C-O, CA-CB-OG1, CB-CG2
    EXPECT_EQ(sticksOf({}), 2 * bonds);
    EXPECT_EQ(sticksOf({{"N", "CB"}}), 2 * (bonds + 1)); // 2.5 Å
    EXPECT_EQ(sticksOf({{"N", "CA"}, {"C", "O"}, {"CB", "OG1"}, {"CB", "CG2"}}), 2 * 4);
    EXPECT_EQ(sticksOf({{"N", "CB"}}, "THR"), 2 * bonds);
    // What the file says of a component comes before the table.
    ShownAtoms shown{atomsOf("/1/A/1"), parseShow("sticks"), nullptr};
    const auto own = std::make_shared<FileBonds>();
    own->residues["THR"].add("N", "CA", BondOrder::Single);
    own->residues["THR"].finish();
    shown.bonds = own;
    EXPECT_EQ(partsOf(atomModel({shown}, Progress()))[1], 2 * (bonds - 0));
    own->residues["THR"].add("CB", "CG2", BondOrder::Single);
    own->residues["THR"].add("CA", "C", BondOrder::Single);
    own->residues["THR"].finish();
    EXPECT_EQ(partsOf(atomModel({shown}, Progress()))[1], 2 * (bonds - 1)); // CA-CB is none there
}

// The copies of an assembly have the bonds of their atoms in the file.
TEST(AtomModel, BondsOfTheFileInACopy)
{
    ShownAtoms shown{atomsOf("/1/A/1/N,CB"), parseShow("sticks"), nullptr};
    shown.atoms.names->residues[0].name = "XXX";
    const auto bonds = std::make_shared<FileBonds>();
    bonds->links.push_back({{"A", 1, ' ', "N"}, {"A", 1, ' ', "CB"}}); // 2.5 Å
    shown.bonds = bonds;
    for (const auto& [chain, sticks] : {std::pair("A", 2), {"A-2", 2}, {"B-2", 0}}) {
        shown.atoms.names->residues[0].labelChain = chain;
        EXPECT_EQ(partsOf(atomModel({shown}, Progress()))[1], sticks) << chain;
    }
}

// What a file joins is no longer than 3 Å either.
TEST(AtomModel, NoBondIsLonger)
{
    ShownAtoms shown{atomsOf("/1/A/1/N,CA"), parseShow("sticks"), nullptr};
    shown.atoms.names->residues[0].name = "XXX";
    const auto bonds = std::make_shared<FileBonds>();
    bonds->links.push_back({{"A", 1, ' ', "N"}, {"A", 1, ' ', "CA"}});
    shown.bonds = bonds;
    const auto sticksAt = [&](double distance, std::uint8_t element) {
        shown.atoms.balls[1].center = shown.atoms.balls[0].center + Vec3d(0.0, distance, 0.0);
        shown.atoms.labels->elementOf = {element, element};
        return partsOf(atomModel({shown}, Progress()))[1];
    };
    for (const std::uint8_t element : {std::uint8_t(6), std::uint8_t(55)}) { // carbon and caesium
        EXPECT_EQ(sticksAt(2.99, element), 2);
        EXPECT_EQ(sticksAt(3.01, element), 0);
    }
}

// Phenylalanine 13: a double bond C=O, six aromatic ones, four single ones.
TEST(AtomModel, DrawsOrders)
{
    const AtomModel model = modelOf(atomsOf("/1/A/13"), "orders");
    constexpr int dashes = 3;
    EXPECT_EQ(partsOf(model)[1], 2 * (4 + 2 + 6 * (1 + dashes)));
    // Dashes lie inside of the ring: nearer to its middle than any of its atoms.
    const BallSet atoms = atomsOf("/1/A/13");
    Vec3d middle(0.0);
    for (std::size_t i = 0; i < atoms.balls.size(); ++i)
        for (const char* name : {"CG", "CD1", "CD2", "CE1", "CE2", "CZ"})
            if (atoms.names->atoms[i].name == name) middle += atoms.balls[i].center / 6.0;
    int near = 0;
    for (const auto& ends : model.units[0].sticks)
        near += (centerOf(ends[0]) - middle).length() < 1.15;
    EXPECT_EQ(near, 2 * 6 * dashes);
}

// A stick reaches from its atom to the middle of the bond, and has its radius.
TEST(AtomModel, SticksLieBetweenTheirAtoms)
{
    const BallSet atoms = atomsOf("/1/A/1/N,CA");
    const AtomModel model = modelOf(atoms, "sticks");
    const Vec3d &a = atoms.balls[0].center, &b = atoms.balls[1].center, along = (b - a).unit();
    for (const auto& [from, to] : model.units[0].sticks) {
        const Vec3d end = (centerOf(from) - a).length() < 1e-5 ? a : b;
        EXPECT_NEAR((centerOf(from) - end).length(), 0.0, 1e-5);
        const Vec3d way = end == a ? along : -along;
        EXPECT_NEAR((centerOf(to) - end - 0.5 * (b - a).length() * way).length(), 0.0, 1e-5);
        EXPECT_FLOAT_EQ(from[3], 0.25f);
        EXPECT_FLOAT_EQ(to[3], 0.25f);
    }
}

// The rings of a tube have every CA in their middles, and a chain that is broken two tubes.
TEST(AtomModel, TubesGoThroughTheBackbone)
{
    BallSet atoms = atomsOf("A/1-20|A/31-46");
    const AtomModel model = modelOf(atoms, "tube");
    EXPECT_EQ(partsOf(model), (std::array<int, 3>{4, 0, 1})); // two ends each
    const Mesh& mesh = model.units[0].mesh;
    std::vector<Vec3d> middles;
    for (std::size_t v = 0; v < mesh.positions.size(); v += 24) {
        Vec3d sum(0.0);
        for (std::size_t k = 0; k < 24; ++k) sum += Vec3d(mesh.positions[v + k]);
        middles.push_back(sum / 24.0);
    }
    EXPECT_EQ(middles.size(), std::size_t(8 * 19 + 1 + 8 * 15 + 1));
    std::size_t traced = 0;
    for (std::size_t i = 0; i < atoms.balls.size(); ++i) {
        if (atoms.names->atoms[i].name != "CA") continue;
        double nearest = 1.0;
        for (const Vec3d& x : middles)
            nearest = std::min(nearest, (x - atoms.balls[i].center).length());
        EXPECT_LT(nearest, 1e-4);
        ++traced;
    }
    EXPECT_EQ(traced, 36u);
}

// What a model itself takes is a part of what is estimated, most of which is Embree's.
TEST(AtomModel, TellsWhatItTakes)
{
    const BallSet atoms = atomsOf("");
    for (const AtomStyle& style : atomStyles()) {
        const ShownAtoms shown{atoms, {"", &style}};
        const AtomModel model = atomModel({shown}, Progress());
        const AtomUnit& unit = model.units[0];
        const double held = double(unit.mesh.positions.size() * (2 * sizeof(Vec3f) + 3) +
                                   unit.mesh.triangles.size() * 12 +
                                   unit.balls.size() * (sizeof(openvdb::Vec4f) + 3) +
                                   unit.sticks.size() * (2 * sizeof(openvdb::Vec4f) + 3));
        EXPECT_GT(bytesOfModel({shown}), held) << style.word;
        EXPECT_LT(bytesOfModel({shown}), 20.0 * held) << style.word;
    }
}

TEST(AtomModel, RefusesWhatItCannotShow)
{
    EXPECT_THROW(modelOf(atomsOf("A//CB"), "tube"), Error);
    EXPECT_THROW(parseShow("stick"), Error);
    EXPECT_THROW(parseShow("=sticks"), Error);
    EXPECT_THROW(parseShow("(HEM)="), Error);
    EXPECT_EQ(parseShow("A/1-3=Tube").select, "A/1-3");
    EXPECT_EQ(parseShow("A/1-3=Tube").style->word, std::string("tube"));
    EXPECT_THROW(parseShow("spheres,other"), Error);
    EXPECT_THROW(parseShow("spheres,"), Error);
    EXPECT_THROW(parseShow("(HEM),others=sticks,"), Error);
}

TEST(AtomModel, TakesWordsBehindAStyle)
{
    const ShowRule rule = parseShow("A/1,2=spheres,others,#0a0b0c");
    EXPECT_EQ(rule.select, "A/1,2");
    EXPECT_EQ(rule.style->word, std::string("spheres"));
    EXPECT_TRUE(rule.others);
    EXPECT_FALSE(rule.golden);
    EXPECT_EQ(rule.color, (Color{10, 11, 12}));
    EXPECT_TRUE(parseShow("sticks,Golden").golden);
    EXPECT_FALSE(parseShow("sticks").color);
}

// The balls of a copy lie where its motion brings them, and are held once.
TEST(AtomModel, HoldsCopiesOnce)
{
    BallSet atoms = atomsOf("/1/A/1-2");
    const auto count = int(atoms.balls.size());
    const Motion turn{{{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}}, {30, 0, 0}};
    atoms.placement.instances = {{Motion::identity(), 0, "1"}, {turn, 0, "2"}, {turn, 0, "3"}};
    const AtomModel model = modelOf(atoms, "spheres");
    EXPECT_EQ(partsOf(model), (std::array<int, 3>{count, 0, 0}));
    ASSERT_EQ(model.copies.size(), 3u);
    EXPECT_EQ(model.copies[1].translation, Vec3d(30, 0, 0));
}

// Two prototypes of one assembly have units of their own, whose atoms are not bonded.
TEST(AtomModel, PrototypesAreApart)
{
    BallSet atoms = atomsOf("/1/A/1/N,CA");
    atoms.placement.copies = 2;
    atoms.placement.begin = {0, 1, 2};
    atoms.placement.numbers = {1, 2};
    atoms.placement.instances = {{Motion::identity(), 1, "1"}, {Motion::identity(), 0, "2"}};
    const AtomModel model = modelOf(atoms, "sticks");
    ASSERT_EQ(model.units.size(), 2u);
    EXPECT_EQ(model.copies.size(), 2u);
    EXPECT_EQ(partsOf(model), (std::array<int, 3>{2, 0, 0}));
    for (const MeshInstance& copy : model.copies)
        EXPECT_NEAR(
            (centerOf(model.units[copy.part].balls[0]) - atoms.balls[copy.part].center).length(),
            0.0, 1e-5);
}

// Atoms with colours of their own keep them, also along a tube.
TEST(AtomModel, TakesTheColorsOfTheAtoms)
{
    BallSet atoms = atomsOf("A/1-20");
    atoms.colors.assign(atoms.balls.size(), {1, 2, 3});
    for (const char* style : {"spheres", "sticks", "tube"}) {
        const AtomModel model = modelOf(atoms, style);
        const AtomUnit& unit = model.units[0];
        for (const auto* colors : {&unit.ballColors, &unit.stickColors, &unit.mesh.colors})
            for (const Color& color : *colors) EXPECT_EQ(color, (Color{1, 2, 3})) << style;
        EXPECT_TRUE(model.chains.empty() && model.elements.empty()) << style;
    }
}

/// A box from -h to h with normals to the outside.
Mesh box(float h)
{
    Mesh mesh;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0f, 1.0f}) {
            const auto first = std::uint32_t(mesh.positions.size());
            Vec3f n(0.0f), u(0.0f), v(0.0f);
            n[axis] = side;
            u[(axis + 1) % 3] = h;
            v[(axis + 2) % 3] = side * h;
            for (const auto& [s, t] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
                mesh.positions.push_back(h * n + float(s) * u + float(t) * v);
                mesh.normals.push_back(n);
            }
            mesh.triangles.push_back({first, first + 1, first + 2});
            mesh.triangles.push_back({first, first + 2, first + 3});
        }
    }
    return mesh;
}

/// What is seen in the middle of a picture of a box of 4 Å with an atom in it.
Color middleOf(const Vec3d& atom, double opacity, std::optional<double> clip)
{
    BallSet atoms = atomsOf("/1/A/1/N");
    atoms.balls[0] = {atom, 1.0, 0};
    DrawOptions options;
    options.width = 64;
    options.toEye = {0, 0, 1};
    options.up = {0, 1, 0};
    options.style = findStyle("flat");
    options.plain = {255, 255, 0};
    options.opacity = opacity;
    options.clip = clip;
    options.model = std::make_shared<AtomModel>(modelOf(atoms, "spheres"));
    const Picture picture = drawMesh(box(4.0f), options, Progress());
    const std::size_t at = 3 * std::size_t(picture.height / 2 * picture.width + picture.width / 2);
    return {picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]};
}

// The frame has all of a copy that lies aside, and the ball is round.
TEST(AtomModel, CopiesAreSeenWhereTheyLie)
{
    BallSet atoms = atomsOf("/1/A/1/N");
    atoms.balls[0] = {{5, 0, 0}, 2.0, 0};
    const Motion turn{{{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}}, {0, 15, 0}}; // to (0, 20, 0)
    atoms.placement.instances = {{turn, 0, "1"}};
    DrawOptions options;
    options.width = 100;
    options.toEye = {0, 0, 1};
    options.up = {0, 1, 0};
    options.style = findStyle("flat");
    options.model = std::make_shared<AtomModel>(modelOf(atoms, "spheres"));
    options.frame = PictureFrame{{0, 20, 0}, 8.0, 8.0};
    const Picture picture = drawMesh(box(4.0f), options, Progress());
    double blue = 0.0;
    for (std::size_t n = 0; n < picture.rgb.size(); n += 3)
        blue += Color{picture.rgb[n], picture.rgb[n + 1], picture.rgb[n + 2]} == Color{48, 80, 248};
    EXPECT_NEAR(blue * 0.08 * 0.08, M_PI * 4.0, 1.0); // area [Å^2] without its rim
    options.frame.reset();
    const Picture all = drawMesh(box(4.0f), options, Progress());
    EXPECT_NEAR(double(all.height) / all.width, (22.0 + 4.0) / 8.0, 0.05);
}

TEST(AtomModel, IsSeenBeforeTheSurfaceThroughItAndWhereItIsCut)
{
    constexpr Color nitrogen = {48, 80, 248}, surface = {255, 255, 0};
    EXPECT_EQ(middleOf({0, 0, 3.5}, 1.0, {}), nitrogen);  // half out
    EXPECT_EQ(middleOf({0, 0, 0}, 1.0, {}), surface);     // inside
    EXPECT_EQ(middleOf({0, 0, -5}, 1.0, {}), surface);    // behind
    EXPECT_EQ(middleOf({0, 0, 0.5}, 1.0, 1.0), nitrogen); // cut at 1 Å, it reaches 1.5
    EXPECT_EQ(middleOf({0, 0, 3}, 1.0, 1.0), nitrogen);   // whole above the cut
    EXPECT_EQ(middleOf({0, 0, -1}, 1.0, 1.0), surface);   // below it
    // A half of the light of the front wall; the back one is behind the atom.
    const Color through = middleOf({0, 0, 0}, 0.5, {});
    const auto half = [](int a, int b) {
        const Vec3f mean = 0.5f * (linearLight(Color{std::uint8_t(a), 0, 0}) +
                                   linearLight(Color{std::uint8_t(b), 0, 0}));
        return int(fromLinearLight(double(mean[0])));
    };
    for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(int(through[k]), half(nitrogen[k], surface[k]), 3) << k;
}

} // namespace
} // namespace molsurf
