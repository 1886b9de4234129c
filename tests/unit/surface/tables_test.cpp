// SPDX-License-Identifier: MPL-2.0
// Tables of areas, as callers of the face have them.

#include "molsurf/error.h"
#include "molsurf/tables.h"

#include <gtest/gtest.h>

#include <functional>
#include <numeric>

namespace molsurf
{
namespace
{

BallSet named(const std::string& file)
{
    SelectOptions select;
    select.names = true;
    return readAtoms(std::string(MOLSURF_TEST_DATA) + "/" + file, select);
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

TEST(Tables, OfAtomsAndResiduesAddUpToTheArea)
{
    const BallSet atoms = named("1crn.pdb");
    const MolecularSurface result = makeSurface(atoms, exact());
    const Table byAtom = atomTable(atoms, 1.4, result),
                byResidue = residueTable(atoms, 1.4, result);
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

TEST(Tables, SayWhatTheyLack)
{
    BallSet atoms = named("1crn.pdb");
    const MolecularSurface result = makeSurface(atoms, exact());
    EXPECT_EQ(usageOf([&] { residueTable(atoms, 1.4, MolecularSurface()); }),
              "table: expected a surface with `ballAreas` of 327 atoms, got 0");
    atoms.names.reset();
    const std::string noNames = "table: expected `names` of the atoms, got none";
    EXPECT_EQ(usageOf([&] { atomTable(atoms, 1.4, result); }), noNames);
    EXPECT_EQ(usageOf([&] { residueTable(atoms, 1.4, result); }), noNames);
    EXPECT_EQ(usageOf([&] { contactTable(atoms, ContactLevel::Chain, result); }), noNames);
    EXPECT_EQ(usageOf([&] { interfaceTable(atoms, result.report); }), noNames);
}

} // namespace
} // namespace molsurf
