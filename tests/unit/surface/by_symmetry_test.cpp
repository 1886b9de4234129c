// SPDX-License-Identifier: MPL-2.0
// A whole from one unit of it, against the whole in one piece.

#include "molsurf/error.h"
#include "molsurf/kernel/mesh/measure.h"
#include "molsurf/kernel/mesh/topology.h"
#include "molsurf/molecule/selection/groups.h"
#include "molsurf/molecule/selection/select_balls.h"
#include "molsurf/molecule/selection/subset.h"
#include "molsurf/molecule/structure/rotation_group.h"
#include "molsurf/surface.h"
#include "molsurf/surface/run.h"
#include "molsurf/surface/unit_mesh.h"
#include "support/groups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace molsurf::test
{
namespace
{

using openvdb::Vec3d;

/// Atoms of one chain at random places within a ball.
Structure blob(const Vec3d& middle, double radius, std::size_t atoms, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-1.0, 1.0);
    Structure s;
    s.source = "blob";
    s.format = "PQR";
    s.hasRadii = true;
    s.chains = s.asyms = {"A"};
    Residue residue{};
    residue.name = "ALA";
    s.residues = {residue};
    while (s.atoms.size() < atoms) {
        const Vec3d x{place(random), place(random), place(random)};
        if (x.length() > 1.0) continue;
        Atom atom{};
        atom.position = middle + radius * x;
        atom.radius = float(1.6 + 0.2 * place(random));
        atom.element = 6;
        s.atoms.push_back(atom);
    }
    s.models = {{1, 0, atoms}};
    return s;
}

/// The operators about another centre, turned.
std::vector<Operator> elsewhere(const std::vector<Operator>& operators, const Vec3d& centre)
{
    const Operator there = turn({1, 2, 3}, 0.7, centre), back = inverseOf(there);
    std::vector<Operator> out;
    for (const Operator& op : operators) out.push_back(multiplied(there, multiplied(op, back)));
    return out;
}

struct Case {
    const char* name;
    std::vector<Operator> operators;
    double away;     ///< of the blob's middle from the centre [Å]
    Vec3d direction; ///< of it
};

std::vector<Case> cases()
{
    return {{"C2", cyclic(2), 6.0, {1, 0.2, 0.1}},      {"C3", cyclic(3), 7.0, {1, 0.2, 0.1}},
            {"C4", cyclic(4), 8.0, {1, 0.2, 0.1}},      {"C7", cyclic(7), 13.0, {1, 0.2, 0.1}},
            {"D2", dihedral(2), 8.0, {1, 0.8, 0.9}},    {"D3", dihedral(3), 11.0, {1, 0.3, 0.5}},
            {"T", tetrahedral(), 14.0, {1, 0.3, 0.2}},  {"O", octahedral(), 20.0, {1, 0.5, 0.2}},
            {"I", icosahedral(), 32.0, {0.3, 0.9, 1.2}}};
}

SelectOptions assembly(bool bySymmetry, const SurfaceOptions& surface)
{
    SelectOptions options;
    options.assembly.name = "1";
    options.assembly.bySymmetry = bySymmetry;
    options.assembly.surroundings = surroundingsOf(surface);
    return options;
}

/// Puts the balls of the first atoms of a blob into one group, and the others into another.
void groupBalls(BallSet& atoms)
{
    BallLabels& labels = *atoms.labels;
    labels.groups = {{"first", 0, {}}, {"last", 0, {}}};
    labels.groupOf.clear();
    for (const Ball& ball : atoms.balls) labels.groupOf.push_back(ball.atom < 80 ? 0 : 1);
    countBalls(atoms, labels.groupOf, labels.groups);
}

// Groups with surfaces of their own are those of the whole, and their borders are glued, each with
// those of its own group.
TEST(UnitParts, AreThoseOfTheWhole)
{
    for (const SurfaceKind kind : {SurfaceKind::Variational, SurfaceKind::VanDerWaals}) {
        SurfaceOptions options;
        options.kind = kind;
        options.split = true;
        Structure s = blob({7.0, 4.0, 6.0}, 6.5, 200, 7);
        s.assemblies = {assemblyOf(dihedral(3))};
        BallSet unit = selectBalls(s, assembly(true, options));
        BallSet whole = selectBalls(s, assembly(false, options));
        groupBalls(unit);
        groupBalls(whole);
        const MolecularSurface a = makeUnitSurface(unit, options), b = makeSurface(whole, options);
        EXPECT_EQ(a.report.atoms, b.report.atoms);
        ASSERT_EQ(a.report.parts.size(), 2u);
        ASSERT_EQ(a.report.groups.size(), b.report.groups.size());
        for (std::size_t p = 0; p < 2; ++p) {
            const Report::Part &found = a.report.parts[p], &expected = b.report.parts[p];
            EXPECT_EQ(found.name, expected.name);
            EXPECT_EQ(found.atoms, expected.atoms);
            EXPECT_EQ(a.report.groups[p].atoms, b.report.groups[p].atoms);
            EXPECT_NEAR(found.surface.area, expected.surface.area, 1e-2 * expected.surface.area);
            EXPECT_NEAR(found.surface.volume, expected.surface.volume,
                        5e-3 * expected.surface.volume);
        }
        EXPECT_TRUE(a.report.surface.closed);
        ASSERT_EQ(a.mesh.parts.size(), 2u);
        ASSERT_TRUE(a.report.symmetry);
        EXPECT_EQ(a.report.instances.size(), 2u * 6u);
        ASSERT_FALSE(a.shared.empty());
        for (const MolecularSurface::SharedVertex& shared : a.shared) {
            const Motion& motion = unit.placement.instances[std::size_t(shared.motion)];
            const Vec3d there = motion.placed(Vec3d(a.mesh.positions[shared.other]));
            EXPECT_LT((there - Vec3d(a.mesh.positions[shared.vertex])).length(), 1e-3);
        }
        EXPECT_TRUE(checkTopology(makeSurface(unit, options).mesh, Progress()).closed);
    }
}

class BySymmetry : public testing::TestWithParam<SurfaceKind>
{
};

TEST_P(BySymmetry, IsTheWhole)
{
    SurfaceOptions options;
    options.kind = GetParam();
    int fitting = 0; // cases whose borders fit everywhere
    int known = 0;   // whose pieces are
    for (const Case& c : cases()) {
        SCOPED_TRACE(c.name);
        const Vec3d centre(11.0, -7.0, 23.0);
        const Operator there = turn({1, 2, 3}, 0.7, centre);
        Structure s = blob(there.placed(c.away * c.direction.unit()), 6.5, 200, 7);
        s.assemblies = {assemblyOf(elsewhere(c.operators, centre))};
        const BallSet unit = selectBalls(s, assembly(true, options));
        const BallSet whole = selectBalls(s, assembly(false, options));
        ASSERT_TRUE(unit.placement.unit);
        EXPECT_EQ(unit.placement.unit->pointGroup, c.name);
        EXPECT_NEAR((unit.placement.unit->centre - centre).length(), 0.0,
                    c.name[0] == 'C' ? 50.0 : 1e-3);
        EXPECT_LT(unit.placement.unit->deviation, 1e-4);

        const MolecularSurface a = makeUnitSurface(unit, options), b = makeSurface(whole, options);
        const SurfaceReport &found = a.report.surface, &expected = b.report.surface;
        const bool exact = options.kind == SurfaceKind::SolventAccessible ||
                           options.kind == SurfaceKind::VanDerWaals;
        EXPECT_EQ(a.report.atoms, b.report.atoms);
        const bool rough = options.kind == SurfaceKind::Gaussian; // with pieces as small as voxels
        const double tolerance = exact ? 1e-4 : rough ? 1e-2 : 3e-3;
        // Of a unit of ses there is the mesh alone, which may lack what is narrower than a voxel.
        const bool closedForm = options.kind == SurfaceKind::SolventExcluded;
        const SurfaceReport alike = closedForm ? measure(b.mesh, Progress()) : expected;
        EXPECT_NEAR(found.area, alike.area, tolerance * expected.area);
        EXPECT_NEAR(found.volume, expected.volume, (exact ? 1e-5 : 2e-3) * expected.volume);
        EXPECT_FALSE(a.surface);
        // Else a gap or neck about as narrow as a voxel is there on one side of a border alone.
        const bool fits = a.report.symmetry->openVertices == 0;
        if (exact || (fits && !rough)) {
            if (options.kind == SurfaceKind::Variational) {
                // Necks of the offset surface that are thinner than a voxel are those of its place
                // on the grid, another one in each copy of the whole.
                ASSERT_TRUE(expected.eulerCharacteristic);
                const int own = found.eulerCharacteristic.value_or(*expected.eulerCharacteristic);
                EXPECT_NEAR(own, *expected.eulerCharacteristic, 8);
            } else if (found.eulerCharacteristic || closedForm) {
                EXPECT_EQ(closedForm ? found.meshEulerCharacteristic : found.eulerCharacteristic,
                          alike.eulerCharacteristic);
            }
        }
        if (exact || closedForm) {
            EXPECT_EQ(found.eulerCharacteristic.has_value(), exact);
            EXPECT_FALSE(found.piecesKnown);
        } else {
            EXPECT_EQ(found.eulerCharacteristic.has_value(), found.piecesKnown);
            known += found.piecesKnown;
        }
        EXPECT_TRUE(found.closed);
        const Mesh welded = wholeMesh(unit, a, a.mesh, true, {}, Progress());
        const Topology topology = checkTopology(welded, Progress());
        EXPECT_TRUE(topology.closed && topology.oriented);
        // Triangles that join vertices of the wrong units are as large as the whole. A mesh bridges
        // the creases of a union, which its closed form has.
        const double area = exact ? measure(b.mesh, Progress()).area : found.area;
        EXPECT_NEAR(measure(welded, Progress()).area, area, 0.02 * area);
        EXPECT_EQ(welded.positions.size(), found.vertices);
        EXPECT_EQ(welded.triangles.size(), found.triangles);
        const double flat = piecesOf(welded, Progress()).triangles.area;
        EXPECT_NEAR(*found.triangleArea, flat, 1e-3 * flat);
        if (exact || rough) continue;
        if (fits) {
            ++fitting;
            EXPECT_EQ(found.meshComponents, alike.meshComponents);
        }
        if (found.piecesKnown) {
            EXPECT_NEAR(found.outerArea, expected.outerArea, 5e-3 * expected.outerArea);
        }
        EXPECT_NEAR(found.meanCurvature.mean, expected.meanCurvature.mean, 0.01);
    }
    if (options.kind <= SurfaceKind::SolventExcluded) {
        EXPECT_GE(fitting, 7);
    }
    if (options.kind == SurfaceKind::Variational) {
        EXPECT_GE(known, 7);
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, BySymmetry,
                         testing::Values(SurfaceKind::Variational, SurfaceKind::SolventExcluded,
                                         SurfaceKind::SolventAccessible, SurfaceKind::VanDerWaals,
                                         SurfaceKind::Gaussian),
                         [](const auto& info) { return std::string(nameOf(info.param)); });

/// Borders that are glued otherwise than the whole is made a handle in each unit of the first, and
/// a flat bubble at the axis of the second.
TEST(UnitTopology, IsThatOfTheWholeOrNotKnown)
{
    struct Molecule {
        int order;
        Vec3d centre;
        std::vector<Vec3d> places;
    };
    const std::vector<Molecule> all = {
        {5,
         {-2.25151, -9.67404, 0.0},
         {{-0.839, -7.497, -15.614}, {-1.563, -9.042, -11.213}, {-3.681, -4.463, -9.351}}},
        {7,
         {9.29562, -2.70496, 0.0},
         {{2.554, -2.894, 26.179},
          {2.157, -5.437, 29.383},
          {8.329, -3.689, 24.833},
          {6.293, -7.518, 29.074},
          {4.150, -7.187, 25.041},
          {6.551, -7.637, 28.708},
          {3.584, -4.116, 24.394},
          {5.329, -5.107, 24.426}}}};
    for (const Molecule& molecule : all) {
        SCOPED_TRACE(molecule.order);
        Structure s = blob(Vec3d(0.0), 1.0, molecule.places.size(), 1);
        for (std::size_t i = 0; i < s.atoms.size(); ++i) {
            s.atoms[i].position = molecule.places[i];
            s.atoms[i].radius = 1.7f;
        }
        std::vector<Operator> operators;
        for (int k = 0; k < molecule.order; ++k) {
            operators.push_back(turn({0, 0, 1}, 2.0 * M_PI * k / molecule.order));
            operators.back().translation =
                molecule.centre - operators.back().placed(molecule.centre);
        }
        s.assemblies = {assemblyOf(operators)};
        SurfaceOptions options;
        const MolecularSurface whole =
            makeSurface(selectBalls(s, assembly(false, options)), options);
        ASSERT_EQ(whole.report.surface.eulerCharacteristic, std::optional<int>(2));
        const MolecularSurface unit =
            makeUnitSurface(selectBalls(s, assembly(true, options)), options);
        const SurfaceReport& found = unit.report.surface;
        EXPECT_EQ(found.eulerCharacteristic.value_or(2), 2);
        EXPECT_EQ(found.piecesKnown, found.eulerCharacteristic.has_value());
        if (found.piecesKnown) {
            EXPECT_EQ(found.components, 1u);
            EXPECT_TRUE(found.cavities.empty());
        }
    }
}

/// A helix has ends: only the axes that take it onto itself count.
TEST(SymmetricUnit, OfAHelix)
{
    const SurfaceOptions options;
    Structure s = blob({9.0, 1.0, 0.0}, 5.0, 60, 3);
    s.assemblies = {assemblyOf(helix(7, 6.0, 0.8))};
    try {
        selectBalls(s, assembly(true, options));
        ADD_FAILURE() << "expected an Error";
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::Input);
        EXPECT_NE(std::string(e.what()).find("a helix with ends"), std::string::npos) << e.what();
    }
    // Three strands of it have a three-fold axis: a unit is one strand.
    std::vector<Operator> strands;
    for (const Operator& op : helix(5, 6.0, 0.5))
        for (const Operator& strand : cyclic(3)) strands.push_back(multiplied(strand, op));
    s.assemblies = {assemblyOf(strands)};
    const BallSet unit = selectBalls(s, assembly(true, options));
    EXPECT_EQ(unit.placement.unit->pointGroup, "C3");
    EXPECT_EQ(unit.placement.unit->copies, 5u);
    const MolecularSurface a = makeUnitSurface(unit, options);
    const MolecularSurface b = makeSurface(selectBalls(s, assembly(false, options)), options);
    EXPECT_NEAR(a.report.surface.area, b.report.surface.area, 3e-3 * b.report.surface.area);
    EXPECT_NEAR(a.report.surface.volume, b.report.surface.volume, 2e-3 * b.report.surface.volume);
    EXPECT_TRUE(a.report.surface.closed);
}

TEST(SymmetricUnit, RefusesWhatIsNoGroup)
{
    Structure s = blob({9.0, 1.0, 0.0}, 5.0, 60, 3);
    std::vector<Operator> some = icosahedral();
    some.resize(4);
    some.push_back(turn({1, 2, 3}, 1.0, {40, 0, 0}));
    std::vector<Operator> bent = cyclic(5);
    bent[2].translation += Vec3d(1.2, 0, 0); // as near as findSymmetry() takes it, but too far
    for (const auto& operators : {some, bent}) {
        s.assemblies = {assemblyOf(operators)};
        SelectOptions options;
        options.assembly.name = "1";
        options.assembly.bySymmetry = true;
        try {
            selectBalls(s, options);
            ADD_FAILURE() << "expected an Error";
        } catch (const Error& e) {
            EXPECT_EQ(e.kind(), ErrorKind::Input);
            EXPECT_NE(std::string(e.what()).find("by symmetry"), std::string::npos) << e.what();
        }
    }
}

/// Operators of files have six digits or fewer: the motions are a group all the same.
TEST(SymmetricUnit, MotionsAreAGroup)
{
    std::vector<Operator> rounded = elsewhere(icosahedral(), {100.0, 50.0, -30.0});
    for (Operator& op : rounded) {
        for (auto& row : op.rotation)
            for (double& x : row) x = std::round(1e5 * x) / 1e5;
        for (int i = 0; i < 3; ++i) op.translation[i] = std::round(1e3 * op.translation[i]) / 1e3;
    }
    const RotationGroup group = findRotationGroup(assemblyOf(rounded), {130.0, 70.0, 10.0});
    ASSERT_EQ(group.motions.size(), 60u);
    const Vec3d x(140.0, 80.0, 20.0);
    for (std::size_t k = 0; k < 60; ++k) {
        const Operator& m = group.motions[k];
        EXPECT_NEAR((m.placed(group.symmetry.centre) - group.symmetry.centre).length(), 0.0, 1e-9);
        for (std::size_t l = 0; l < 60; ++l) {
            const Vec3d both = m.placed(group.motions[l].placed(x));
            EXPECT_NEAR((both - group.motions[group.product[k][l]].placed(x)).length(), 0.0, 1e-9);
        }
        EXPECT_EQ(group.product[k][group.inverse[k]], 0u);
    }
}

/// An ion on an axis stands in the place of its images: each unit has its part of it.
TEST(SymmetricUnit, SharesABallOnAnAxis)
{
    for (const int fold : {2, 3, 5}) {
        Structure s = blob({12.0, 1.0, 0.0}, 5.0, 60, 3);
        Atom ion = s.atoms[0];
        ion.position = Vec3d(0.0, 0.0, 9.0);
        s.atoms.push_back(ion);
        ++s.models[0].end;
        s.assemblies = {assemblyOf(cyclic(fold))};
        for (const SurfaceKind kind :
             {SurfaceKind::SolventAccessible, SurfaceKind::SolventExcluded}) {
            SurfaceOptions options;
            options.kind = kind;
            const MolecularSurface a =
                makeSurface(selectBalls(s, assembly(true, options)), options);
            const MolecularSurface b =
                makeSurface(selectBalls(s, assembly(false, options)), options);
            EXPECT_NEAR(a.report.surface.area, b.report.surface.area, 2e-3 * b.report.surface.area)
                << fold;
            EXPECT_NEAR(a.report.surface.volume, b.report.surface.volume,
                        2e-3 * b.report.surface.volume);
            EXPECT_TRUE(a.report.surface.closed) << fold;
        }
    }
}

/// On a lattice atoms are on axes, stand in the places of others' images, and have four and more
/// spheres through a point, which fall apart in another way in each unit.
TEST(SymmetricUnit, OnALatticeIsTheWhole)
{
    std::mt19937 random(5);
    const auto below = [&](int count) { return int(random() % unsigned(count)); };
    const std::vector<Case> all = cases();
    int shared = 0; // draws with atoms in the places of others' images
    for (int draw = 0; draw < 60; ++draw) {
        const Case& c = all[std::size_t(draw) % all.size()];
        SCOPED_TRACE(std::string(c.name) + " " + std::to_string(draw));
        const double edge = draw % 2 ? 3.0 : 1.5;
        Structure s = blob({0, 0, 0}, 1.0, std::size_t(1 + below(9)), 3);
        for (Atom& atom : s.atoms) {
            atom.radius = 1.7f;
            atom.position = Vec3d(1 + below(4), below(4), below(4)) * edge;
        }
        s.assemblies = {assemblyOf(c.operators)};
        SurfaceOptions options;
        options.kind = draw % 3 ? SurfaceKind::SolventAccessible : SurfaceKind::VanDerWaals;
        options.grid = false;
        const BallSet unit = selectBalls(s, assembly(true, options));
        const BallSet whole = selectBalls(s, assembly(false, options));
        const SurfaceReport found = makeUnitSurface(unit, options).report.surface;
        const SurfaceReport expected = makeSurface(whole, options).report.surface;
        EXPECT_NEAR(found.area, expected.area, 1e-6 * expected.area);
        EXPECT_NEAR(found.volume, expected.volume, 1e-6 * expected.volume);
        ASSERT_TRUE(found.eulerCharacteristic);
        EXPECT_EQ(*found.eulerCharacteristic, *expected.eulerCharacteristic);
        shared += unit.whole() != whole.balls.size();
    }
    EXPECT_GE(shared, 3);
}

/// Groups count the whole; a name stands for all copies that the rotations make of a chain.
TEST(SymmetricUnit, GroupsAddUp)
{
    const SurfaceOptions options;
    Structure s = blob({9.0, 1.0, 0.0}, 6.0, 100, 3);
    for (std::size_t i = 0; i < s.atoms.size(); ++i) s.atoms[i].residue = i % 3 == 0;
    s.chains.push_back("B");
    s.asyms.push_back("B");
    s.residues.push_back(s.residues[0]);
    s.residues[1].chain = s.residues[1].asym = 1;
    s.assemblies = {assemblyOf(dihedral(3))};
    SelectOptions select = assembly(true, options);
    LabelOptions labels;
    labels.groups = {{"b", "B", {}}};
    const BallSet unit = selectBalls(s, select, labels);
    EXPECT_EQ(unit.labels->chains.size(), 2u); // images have their names
    const MolecularSurface a = makeUnitSurface(unit, options);
    select.assembly.bySymmetry = false;
    const MolecularSurface b = makeSurface(selectBalls(s, select, labels), options);
    ASSERT_EQ(a.report.groups.size(), b.report.groups.size());
    double area = 0.0;
    for (std::size_t g = 0; g < a.report.groups.size(); ++g) {
        EXPECT_EQ(a.report.groups[g].name, b.report.groups[g].name);
        EXPECT_EQ(a.report.groups[g].atoms, b.report.groups[g].atoms);
        EXPECT_NEAR(a.report.groups[g].area, b.report.groups[g].area,
                    1e-2 * b.report.groups[g].area);
        EXPECT_NEAR(a.report.groups[g].volume, b.report.groups[g].volume,
                    3e-2 * b.report.groups[g].volume);
        area += a.report.groups[g].area;
    }
    EXPECT_NEAR(area, a.report.surface.area, 1e-6 * area);
}

/// Every interface of the whole is one of the unit's, as often as they say.
TEST(SymmetricUnit, InterfacesCountTheWhole)
{
    for (const SurfaceKind kind : {SurfaceKind::SolventAccessible, SurfaceKind::SolventExcluded}) {
        SurfaceOptions options;
        options.kind = kind;
        options.interfaces = true;
        Structure s = blob({9.0, 1.0, 1.0}, 6.0, 120, 3);
        s.assemblies = {assemblyOf(dihedral(3))};
        SelectOptions select = assembly(true, options);
        LabelOptions labels;
        labels.groupBy = parseGroupBy("copy");
        const Report a = makeSurface(selectBalls(s, select, labels), options).report;
        select.assembly.bySymmetry = false;
        const Report b = makeSurface(selectBalls(s, select, labels), options).report;
        double found = 0.0, expected = 0.0;
        std::size_t count = 0;
        for (const Report::Interface& i : a.interfaces) {
            found += double(i.count) * i.area;
            count += i.count;
        }
        for (const Report::Interface& i : b.interfaces) expected += i.area;
        EXPECT_EQ(count, b.interfaces.size());
        EXPECT_GT(expected, 100.0);
        const bool exact = kind == SurfaceKind::SolventAccessible;
        EXPECT_NEAR(found, expected, (exact ? 1e-4 : 1e-2) * expected);
    }
}

/// The rows of a unit are the contacts of its balls, with one another and with images.
TEST(SymmetricUnit, ContactsAreThoseOfItsBalls)
{
    SurfaceOptions options;
    options.kind = SurfaceKind::SolventAccessible;
    options.contacts = true;
    Structure s = blob({9.0, 1.0, 1.0}, 6.0, 120, 3);
    s.assemblies = {assemblyOf(dihedral(3))};
    SelectOptions select = assembly(true, options);
    const BallSet unit = selectBalls(s, select);
    const Table table = contactTable(unit, ContactLevel::Atom, makeUnitSurface(unit, options));
    select.assembly.bySymmetry = false;
    const MolecularSurface whole = makeSurface(selectBalls(s, select), options);
    double expected = 0.0, found = 0.0;
    std::size_t count = 0, across = 0;
    for (const ContactArea& contact : whole.contacts) {
        if (contact.balls[0] >= s.atoms.size()) continue;
        expected += contact.area;
        ++count;
        across += contact.balls[1] >= s.atoms.size();
    }
    for (const Table::Column& column : table.columns) {
        if (column.name != "area") continue;
        const auto& areas = std::get<std::vector<double>>(column.values);
        EXPECT_EQ(areas.size(), count);
        for (const double area : areas) found += area;
    }
    EXPECT_GT(across, 20u);
    EXPECT_NEAR(found, expected, 1e-3 * expected);
}

TEST(SymmetricUnit, RefusesWhatNeedsTheWhole)
{
    Structure s = blob({9.0, 1.0, 0.0}, 5.0, 60, 3);
    s.assemblies = {assemblyOf(cyclic(3))};
    const BallSet unit = selectBalls(s, assembly(true, {}));
    SurfaceOptions cavities, sas;
    cavities.fillCavities = true;
    sas.fields = {"sas"};
    EXPECT_THROW(makeUnitSurface(unit, cavities), Error);
    EXPECT_THROW(makeUnitSurface(unit, sas), Error);
}

/// The vertices of a border lie where those of the neighbour do.
TEST(SymmetricUnit, BordersMeet)
{
    const SurfaceOptions options;
    Structure s = blob({9.0, 1.0, 0.0}, 6.0, 150, 3);
    s.assemblies = {assemblyOf(dihedral(3))};
    const BallSet unit = selectBalls(s, assembly(true, options));
    const MolecularSurface a = makeUnitSurface(unit, options);
    ASSERT_FALSE(a.shared.empty());
    for (const MolecularSurface::SharedVertex& v : a.shared) {
        const Instance& m = unit.placement.instances[std::size_t(v.motion)];
        const Operator op{m.rotation, m.translation, {}};
        const Vec3d there = op.placed(Vec3d(a.mesh.positions[v.other]));
        EXPECT_NEAR((there - Vec3d(a.mesh.positions[v.vertex])).length(), 0.0, 1e-4);
    }
    // Apart, every unit is a part of its own.
    const Mesh apart = wholeMesh(unit, a, a.mesh, false, {}, Progress());
    EXPECT_EQ(apart.parts.size(), 6u);
    EXPECT_EQ(apart.triangles.size(), a.report.surface.triangles);
    EXPECT_FALSE(checkTopology(apart, Progress()).closed);
}

/// A column that is a vector, at a vertex.
Vec3d vectorAt(const Mesh& mesh, const std::string& name, std::size_t vertex)
{
    Vec3d out(0.0);
    for (const auto& scalar : mesh.scalars)
        for (int a = 0; a < 3; ++a)
            if (scalar.name == name + "_" + "xyz"[a]) out[a] = double(scalar.values[vertex]);
    return out;
}

/// makeSurface() gives the mesh of the whole: of a unit, and of prototypes, of which each copy is a
/// part.
TEST(SymmetricUnit, SurfacesAreThoseOfTheWhole)
{
    SurfaceOptions options;
    options.fields = {"principal_direction_1"};
    Structure s = blob({9.0, 1.0, 0.0}, 6.0, 150, 3);
    s.assemblies = {assemblyOf(dihedral(3))};
    const BallSet unit = selectBalls(s, assembly(true, options));
    const MolecularSurface whole = makeSurface(unit, options);
    EXPECT_EQ(whole.mesh.triangles.size(), whole.report.surface.triangles);
    EXPECT_TRUE(whole.shared.empty());
    EXPECT_TRUE(checkTopology(whole.mesh, Progress()).closed);

    SelectOptions select = assembly(false, options);
    select.assembly.instances = true;
    const BallSet prototype = selectBalls(s, select);
    const MolecularSurface copies = makeSurface(prototype, options);
    const MolecularSurface one = makeUnitSurface(prototype, options);
    ASSERT_EQ(copies.mesh.parts.size(), 6u);
    EXPECT_EQ(copies.mesh.triangles.size(), 6 * one.mesh.triangles.size());
    EXPECT_TRUE(checkTopology(copies.mesh, Progress()).closed);
    const std::size_t count = one.mesh.positions.size();
    ASSERT_EQ(copies.mesh.positions.size(), 6 * count);
    for (std::size_t k = 0; k < 6; ++k) {
        const Vec3d there = prototype.placement.instances[k].placed(Vec3d(one.mesh.positions[7]));
        EXPECT_NEAR((Vec3d(copies.mesh.positions[k * count + 7]) - there).length(), 0.0, 1e-4);
        const Vec3d way = prototype.placement.instances[k].turned(Vec3d(one.mesh.normals[7]));
        EXPECT_NEAR((Vec3d(copies.mesh.normals[k * count + 7]) - way).length(), 0.0, 1e-4);
        const Vec3d direction = vectorAt(one.mesh, "principal_direction_1", 7);
        EXPECT_NEAR(direction.length(), 1.0, 1e-4);
        EXPECT_NEAR((vectorAt(copies.mesh, "principal_direction_1", k * count + 7) -
                     prototype.placement.instances[k].turned(direction))
                        .length(),
                    0.0, 1e-4);
    }

    const BallSet all = selectBalls(s, assembly(false, options));
    for (const BallSet* atoms : {&unit, &prototype}) {
        const WholeBalls balls = ballsOfWhole(*atoms);
        ASSERT_EQ(balls.balls.size(), all.balls.size());
        for (std::size_t i = 0; i < all.balls.size(); ++i) {
            const Ball& ball = balls.balls[i];
            EXPECT_EQ(atoms->balls[balls.sources[i]].atom, ball.atom);
            EXPECT_TRUE(std::any_of(all.balls.begin(), all.balls.end(), [&](const Ball& other) {
                return other.atom == ball.atom && (other.center - ball.center).length() < 1e-6;
            })) << i;
        }
    }
}

} // namespace
} // namespace molsurf::test
