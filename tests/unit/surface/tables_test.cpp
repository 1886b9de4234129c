// SPDX-License-Identifier: MPL-2.0
// Tables of areas, as callers of the face have them.

#include "molsurf/analysis/measures/lining.h"
#include "molsurf/analysis/measures/polarity.h"
#include "molsurf/error.h"
#include "molsurf/surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace molsurf
{
namespace
{

BallSet named(const std::string& file)
{
    return readAtoms(std::string(MOLSURF_TEST_DATA) + "/" + file);
}

SurfaceOptions exact()
{
    SurfaceOptions options;
    options.kind = SurfaceKind::SolventAccessible;
    options.grid = false;
    options.ballAreas = options.contacts = true;
    return options;
}

template<typename T>
const std::vector<T>& column(const Table& table, const char* name)
{
    for (const Table::Column& one : table.columns)
        if (one.name == name) return std::get<std::vector<T>>(one.values);
    throw std::out_of_range(name);
}

double sum(const std::vector<double>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0);
}

std::string usageOf(const std::function<void()>& call)
{
    try {
        call();
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::Usage);
        return e.what();
    }
    return "taken";
}

// Tien's maxima are of a probe of 1.4 Å and of the solvent-accessible surface.
TEST(Tables, RelativeAccessibilityIsOfItsProbe)
{
    const BallSet atoms = named("1crn.pdb");
    const auto has = [&](double probe, const MolecularSurface& result) {
        const Table table = residueTable(atoms, probe, result);
        return std::any_of(table.columns.begin(), table.columns.end(),
                           [](const auto& c) { return c.name == "relative_accessibility"; });
    };
    const MolecularSurface result = makeSurface(atoms, exact());
    EXPECT_TRUE(has(1.4, result));
    EXPECT_FALSE(has(1.5, result));
    SurfaceOptions other = exact();
    other.kind = SurfaceKind::VanDerWaals;
    other.contacts = false;
    EXPECT_FALSE(has(1.4, makeSurface(atoms, other)));
}

/// A ball of each of some residues.
BallSet residuesNamed(const std::vector<std::string>& all)
{
    BallSet atoms;
    BallNames& names = atoms.names.emplace();
    for (std::size_t i = 0; i < all.size(); ++i) {
        atoms.balls.push_back({{4.0 * double(i), 0.0, 0.0}, 1.5, std::int32_t(10 + i)});
        names.atoms.push_back({"CA", '\0', 6, 1.0f});
        names.residueOf.push_back(std::int32_t(i));
        names.residues.push_back({"A", "A", all[i], int(i) + 1, ' ', false});
    }
    return atoms;
}

// Kyte and Doolittle: Lys -3.9, Arg -4.5, Asp and Glu -3.5, Ala 1.8. Protonated Asp and neutral
// Lys, as force fields name them, have the values of their parents, but no charge.
TEST(Tables, ALiningHasTheChargeAndTheMeanOfItsResidues)
{
    const BallSet atoms = residuesNamed({"LYS", "ARG", "ASP", "ALA", "LYN", "HEM", "GLU", "ASH"});
    const Lining one = liningOf(atoms, {{0, 1.0}, {3, 3.0}});
    EXPECT_NEAR(one.hydrophobicity, (-3.9 + 3.0 * 1.8) / 4.0, 1e-6);
    EXPECT_EQ(one.charge, 1.0);
    EXPECT_EQ(one.residues, "A/LYS1 A/ALA4");
    EXPECT_EQ(one.atoms, "10 13");
    EXPECT_EQ(liningOf(atoms, {{0, 1.0}, {1, 1.0}, {4, 1.0}, {2, 1.0}}).charge, 1.0);
    EXPECT_EQ(liningOf(atoms, {{6, 1.0}, {2, 1.0}, {7, 1.0}}).charge, -2.0);
    EXPECT_NEAR(liningOf(atoms, {{7, 1.0}, {4, 1.0}}).hydrophobicity, -3.7, 1e-6);
    const Lining mixed = liningOf(atoms, {{5, 7.0}, {3, 1.0}}); // a haem has no value
    EXPECT_NEAR(mixed.hydrophobicity, 1.8, 1e-6);
    EXPECT_EQ(mixed.charge, 0.0);
    const Lining none = liningOf(atoms, {{5, 1.0}});
    EXPECT_TRUE(std::isnan(none.hydrophobicity) && std::isnan(none.charge));
    EXPECT_EQ(none.residues, "A/HEM6");
}

// What lines a tunnel counts by the length of the way beside it: half of that to either station.
TEST(Tables, TheLiningOfATunnelIsWeighedByLength)
{
    const BallSet atoms = residuesNamed({"LYS", "ALA"});
    Report::Tunnels::Tunnel tunnel;
    tunnel.stations.resize(3);
    tunnel.stations[1].distance = 1.0;
    tunnel.stations[2].distance = 4.0;
    tunnel.stations[0].lining = {0};    // 0.5 Å
    tunnel.stations[1].lining = {0, 1}; // 2 Å
    tunnel.stations[2].lining = {1};    // 1.5 Å
    EXPECT_NEAR(liningOfTunnel(atoms, tunnel).hydrophobicity, (-3.9 * 2.5 + 1.8 * 3.5) / 6.0, 1e-6);
}

// A tunnel's curvature is its length by the straight way, in any direction.
TEST(Tables, ACurvatureIsALengthByItsChord)
{
    Report::Tunnels::Tunnel tunnel;
    tunnel.stations.resize(2);
    tunnel.stations[0].place = {1.0, 2.0, 3.0};
    tunnel.stations[1].distance = 9.0;
    for (const std::array<double, 3>& to : {std::array{1.0, 2.0, 9.0}, std::array{1.0, 8.0, 3.0},
                                            std::array{7.0, 2.0, 3.0}, std::array{3.0, 6.0, 7.0}}) {
        tunnel.stations[1].place = to;
        EXPECT_NEAR(tunnel.curvature(), 1.5, 1e-12);
    }
}

// The mean of a value over a residue's area is that of the balls that have one.
TEST(Tables, AMeanIsOfWhatHasAValue)
{
    BallSet atoms = residuesNamed({"LYS", "ALA"});
    for (const int residue : {0, 0, 1}) {
        atoms.balls.push_back({{9.0, 0.0, 0.0}, 1.5, 20});
        atoms.names->atoms.push_back({"CB", '\0', 6, 1.0f});
        atoms.names->residueOf.push_back(residue);
    }
    atoms.labels.emplace().values.emplace().name = "charge";
    MolecularSurface result;
    const double none = std::numeric_limits<double>::quiet_NaN();
    result.ballAreas = {1.0, 2.0, 3.0, 4.0, 0.0};
    result.ballValues = {0.5, none, -0.5, none, 7.0};
    const Table table = residueTable(atoms, 1.4, result);
    EXPECT_NEAR(column<double>(table, "mean_charge")[0], (0.5 - 1.5) / 4.0, 1e-12);
    EXPECT_NEAR(column<double>(table, "integral_charge_A2")[0], -1.0, 1e-12);
    EXPECT_TRUE(std::isnan(column<double>(table, "mean_charge")[1])); // without area
    EXPECT_EQ(column<double>(table, "integral_charge_A2")[1], 0.0);
    EXPECT_EQ(column<double>(table, "area")[0], 8.0);
}

// Rows of an interface have the residues of the first group first, and what each loses.
TEST(Tables, AnInterfaceBeginsWithItsFirstGroup)
{
    const BallSet atoms = residuesNamed({"LYS", "ALA", "GLU"});
    Report report;
    report.interfaces.resize(1);
    Report::Interface& one = report.interfaces[0];
    one.first = "A";
    one.second = "B";
    one.buried.resize(2);
    one.buried[0].ball = 0;
    one.buried[0].ofFirst = false;
    one.buried[0].alone = 5.0;
    one.buried[0].together = 2.0;
    one.buried[1].ball = 2;
    one.buried[1].ofFirst = true;
    one.buried[1].alone = 7.0;
    one.buried[1].together = 6.0;
    const Table table = interfaceTable(atoms, report);
    EXPECT_EQ(column<std::string>(table, "group"), (std::vector<std::string>{"A", "B"}));
    EXPECT_EQ(column<std::string>(table, "residue"), (std::vector<std::string>{"GLU", "LYS"}));
    EXPECT_EQ(column<double>(table, "buried_area"), (std::vector<double>{1.0, 3.0}));
    EXPECT_EQ(column<double>(table, "area"), (std::vector<double>{0.5, 1.5}));
    EXPECT_EQ(column<double>(table, "buried_apolar_area"), (std::vector<double>{1.0, 3.0}));
}

// A row has the mouth by which the largest ball gets out, and the area of all.
TEST(Tables, APocketHasItsWidestMouth)
{
    const BallSet atoms = residuesNamed({"LYS", "ALA"});
    Report::Pockets pockets;
    pockets.probeIn = 1.4;
    pockets.list.emplace_back();
    Report::Pockets::Pocket& pocket = pockets.list[0];
    pocket.volume = 123.4567891;
    pocket.mouths = {{30.0, 1.5, {1.0, 2.0, 3.0}}, {20.0, 2.5, {4.0, 5.0, 6.0}}, {5.0, 2.0, {}}};
    pocket.lining = {{1, 3.0}, {0, 1.0}};
    pocket.neighbours = {3, 5};
    pocket.rank = 2;
    pocket.open = true;
    const Table table = pockets.table(atoms);
    const auto number = [&](const char* name) { return column<double>(table, name)[0]; };
    EXPECT_EQ(number("volume"), 123.4568);
    EXPECT_EQ(number("mouth_area"), 55.0);
    EXPECT_EQ(number("mouth_radius_A"), 2.5);
    EXPECT_EQ(number("mouth_y_A"), 5.0);
    EXPECT_EQ(number("probe_in_A"), 1.4);
    EXPECT_NEAR(number("hydrophobicity"), (3.0 * 1.8 - 3.9) / 4.0, 1e-6);
    EXPECT_EQ(number("charge"), 1.0);
    EXPECT_EQ(column<std::int64_t>(table, "mouths")[0], 3);
    EXPECT_EQ(column<std::int64_t>(table, "rank")[0], 2);
    EXPECT_EQ(column<std::int64_t>(table, "open")[0], 1);
    EXPECT_EQ(column<std::string>(table, "neighbours")[0], "3 5");
    pocket.mouths.clear();
    EXPECT_TRUE(std::isnan(column<double>(pockets.table(atoms), "mouth_radius_A")[0]));
}

// Where no pocket is at the atoms that were asked for the table has a row all the same: closed.
TEST(Tables, APocketThatIsAskedForHasARow)
{
    const BallSet atoms = residuesNamed({"LYS"});
    for (const bool isChosen : {false, true}) {
        Report::Pockets none;
        none.isChosen = isChosen;
        const Table table = none.table(atoms);
        ASSERT_EQ(column<double>(table, "volume").size(), isChosen ? 1u : 0u);
        EXPECT_EQ(column<double>(table, "voxel_A").size(), isChosen ? 1u : 0u);
        if (isChosen) {
            EXPECT_EQ(column<double>(table, "volume")[0], 0.0);
        }
    }
}

// Hydrogens are of the class of the nearest heavy atom of their residue.
TEST(Tables, AHydrogenIsOfTheClassOfItsHeavyAtom)
{
    BallSet atoms;
    BallNames& names = atoms.names.emplace();
    const auto add = [&](int residue, std::uint8_t element, double x) {
        atoms.balls.push_back({{x, 0.0, 0.0}, 1.5, std::int32_t(atoms.balls.size())});
        names.atoms.push_back({"X", '\0', element, 1.0f});
        names.residueOf.push_back(residue);
    };
    for (const int number : {1, 2, 3})
        names.residues.push_back({"A", "A", "LIG", number, ' ', false});
    add(0, 1, -1.0); // beside the carbon
    add(0, 6, 0.0);
    add(0, 7, 1.5);
    add(0, 1, 2.5);  // beside the nitrogen
    add(1, 8, 3.0);  // nearer to it, of another residue
    add(1, 1, 20.0); // far from its oxygen
    add(2, 1, 0.1);  // of a residue without any other
    add(2, 0, 0.2);
    for (const std::uint8_t apolar : {9, 15, 16, 17, 34, 35, 53}) add(0, apolar, 50.0);
    for (const std::uint8_t polar : {11, 30, 12}) add(0, polar, 60.0);
    using P = Polarity;
    std::vector<P> expected = {P::Apolar, P::Apolar, P::Polar, P::Polar,
                               P::Polar,  P::Polar,  P::Polar, P::Unknown};
    expected.insert(expected.end(), 7, P::Apolar);
    expected.insert(expected.end(), 3, P::Polar);
    EXPECT_EQ(polarityOf(atoms), expected);
}

TEST(Tables, OfAtomsAndResiduesAddUpToTheArea)
{
    const BallSet atoms = named("1crn.pdb");
    const MolecularSurface result = makeSurface(atoms, exact());
    const Table byAtom = atomTable(atoms, result), byResidue = residueTable(atoms, 1.4, result);
    EXPECT_EQ(column<std::string>(byAtom, "atom").front(), "N");
    EXPECT_EQ(column<double>(byAtom, "area").size(), 327u);
    EXPECT_EQ(column<std::string>(byResidue, "residue").front(), "THR");
    EXPECT_EQ(column<std::int64_t>(byResidue, "number").back(), 46);
    EXPECT_NEAR(sum(column<double>(byAtom, "area")), result.report.surface.area, 1e-6);
    EXPECT_NEAR(sum(column<double>(byResidue, "area")), result.report.surface.area, 1e-6);
    EXPECT_NEAR(column<double>(byResidue, "relative_accessibility")[0] * *largestArea("THR"),
                column<double>(byResidue, "area")[0], 1e-9);
    EXPECT_FALSE(largestArea("HOH"));
    for (const double share : column<double>(byResidue, "relative_accessibility"))
        EXPECT_TRUE(share >= 0.0 && share < 1.5) << share;
}

// An ion of calcium is named as the CA of an amino acid.
TEST(Tables, OfResiduesHaveADepthOfCarbonsAlone)
{
    BallSet atoms = named("1crn.pdb");
    const std::int32_t first = atoms.names->residueOf[0];
    for (std::size_t i = 0; atoms.names->residueOf[i] == first; ++i)
        if (atoms.names->atoms[i].name == "CA") atoms.names->atoms[i].element = 20;
    SurfaceOptions options = exact();
    options.fields = {"depth"};
    const std::vector<double> depths =
        column<double>(residueTable(atoms, 1.4, makeSurface(atoms, options)), "ca_depth_A");
    EXPECT_TRUE(std::isnan(depths[0]));
    EXPECT_GT(depths[1], 0.0);
}

TEST(Tables, OfContactsHaveALevel)
{
    const BallSet atoms = named("1a8o.cif.gz");
    const MolecularSurface result = makeSurface(atoms, exact());
    EXPECT_EQ(column<double>(contactTable(atoms, ContactLevel::Atom, result), "area").size(),
              result.contacts.size());
    double apart = 0.0; // centres of atoms
    for (const ContactArea& contact : result.contacts)
        apart += double(
            (atoms.balls[contact.balls[0]].center - atoms.balls[contact.balls[1]].center).length());
    EXPECT_NEAR(sum(column<double>(contactTable(atoms, ContactLevel::Atom, result), "distance_A")),
                apart, 1e-4 * apart);
    EXPECT_GT(
        column<std::string>(contactTable(atoms, ContactLevel::Residue, result), "residue_2").size(),
        100u);
    EXPECT_TRUE(column<double>(contactTable(atoms, ContactLevel::Chain, result), "area").empty());
}

TEST(Tables, OfAPocketWeighItsWallAndNameItsWidestMouth)
{
    const BallSet atoms = named("1crn.pdb");
    const auto ballOf = [&](int number) {
        std::size_t i = 0;
        while (atoms.names->residues[std::size_t(atoms.names->residueOf[i])].number != number) ++i;
        return i;
    };
    Report::Pockets::Pocket pocket;
    pocket.lining = {{ballOf(1), 30.0}, {ballOf(3), 10.0}}; // of THR and CYS
    pocket.mouths = {{9.0, 2.5}, {4.0, 1.5}};
    Report::Pockets report;
    report.list = {pocket};
    const Table table = report.table(atoms);
    EXPECT_NEAR(column<double>(table, "hydrophobicity")[0], (30.0 * -0.7 + 10.0 * 2.5) / 40.0,
                1e-6);
    EXPECT_EQ(column<double>(table, "mouth_radius_A")[0], 2.5);
    EXPECT_EQ(column<double>(table, "mouth_area")[0], 13.0);
}

TEST(Tables, SayWhatTheyLack)
{
    BallSet atoms = named("1crn.pdb");
    const MolecularSurface result = makeSurface(atoms, exact());
    EXPECT_EQ(usageOf([&] { residueTable(atoms, 1.4, MolecularSurface()); }),
              "table: expected a surface with `ballAreas` of 327 atoms, got 0");
    atoms.names.reset();
    const std::string noNames = "table: expected `names` of the atoms, got none";
    EXPECT_EQ(usageOf([&] { atomTable(atoms, result); }), noNames);
    EXPECT_EQ(usageOf([&] { residueTable(atoms, 1.4, result); }), noNames);
    EXPECT_EQ(usageOf([&] { contactTable(atoms, ContactLevel::Chain, result); }), noNames);
    EXPECT_EQ(usageOf([&] { interfaceTable(atoms, result.report); }), noNames);
}

} // namespace
} // namespace molsurf
