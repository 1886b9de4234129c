// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/write_structure.h"

#include "molsurf/error.h"

#include "support/folder.h"

#include <gtest/gtest.h>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

/// A residue with a deuterium, a hydrogen whose name begins with another letter, and dubnium.
BallSet methanol()
{
    BallSet atoms;
    BallNames& names = atoms.names.emplace();
    const auto add = [&](const char* name, std::uint8_t element, double x) {
        atoms.balls.push_back({{x, 2.0, 3.0}, 1.5, std::int32_t(atoms.balls.size())});
        names.atoms.push_back({name, '\0', element, 0.5f});
        names.residueOf.push_back(0);
    };
    names.residues.push_back({"A", "A", "MOH", 7, ' ', true});
    add("D1", 1, 1.0);
    add("HO", 1, 2.0);
    add("DX", 6, 3.0); // a name alone makes no deuterium
    return atoms;
}

std::string pdbOf(const BallSet& atoms, const std::vector<double>& values, const Vec3d& origin)
{
    return test::written([&](OutputFile& file) { writePdb(atoms, values, origin, file); });
}

// Names, places from the origin, occupancies, values and elements, in the columns of the format.
TEST(WriteStructure, OfAtomsHasTheirElementsAndValues)
{
    const std::string text = pdbOf(methanol(), {1.25, 0.0, 999.99}, Vec3d(1.0, 0.0, 5.0));
    std::vector<std::string> rows;
    std::istringstream lines(text);
    for (std::string one; std::getline(lines, one);)
        if (one.rfind("HETATM", 0) == 0) rows.push_back(one);
    ASSERT_EQ(rows.size(), 3u) << text;
    EXPECT_EQ(rows[0].substr(17, 49), "MOH A   7       0.000   2.000  -2.000  0.50  1.25");
    EXPECT_EQ(rows[2].substr(60, 6), "999.99");
    const char* const elements[] = {" D", " H", " C"};
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(rows[i].substr(76, 2), elements[i]) << text;
    const std::string cif = test::written([&](OutputFile& file) {
        writeMmcif(methanol(), {1.25, 0.0, 1e6}, Vec3d(0.0), file);
    });
    EXPECT_NE(cif.find(" D "), std::string::npos) << cif;
    EXPECT_NE(cif.find(" 1e+06 "), std::string::npos) << cif;
}

// What its columns do not hold is refused, and what they just hold is not.
TEST(WriteStructure, ChecksTheRoomOfAPdb)
{
    const auto refused = [](const BallSet& atoms, double value, const Vec3d& origin) {
        try {
            pdbOf(atoms, std::vector<double>(3, value), origin);
            return std::string();
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::Output);
            return std::string(error.what());
        }
    };
    EXPECT_NE(refused(methanol(), 999.996, Vec3d(0.0)).find("the area"), std::string::npos);
    EXPECT_EQ(refused(methanol(), 999.99, Vec3d(0.0)), "");
    EXPECT_NE(refused(methanol(), 1.0, Vec3d(1001.0, 0.0, 0.0)).find("the coordinate"),
              std::string::npos);
    EXPECT_EQ(refused(methanol(), 1.0, Vec3d(1000.9, 0.0, 0.0)).find("the coordinate"),
              std::string::npos);
    for (const int number : {-999, 9999, -1000, 10000}) {
        BallSet atoms = methanol();
        atoms.names->residues[0].number = number;
        EXPECT_EQ(refused(atoms, 1.0, Vec3d(0.0)).empty(), number > -1000 && number < 10000);
    }
    BallSet chain = methanol(), name = methanol(), residue = methanol();
    chain.names->residues[0].chain = "AB";
    name.names->atoms[0].name = "D1234";
    residue.names->residues[0].name = "MOHA";
    EXPECT_NE(refused(chain, 1.0, Vec3d(0.0)).find("the chain name AB"), std::string::npos);
    EXPECT_NE(refused(name, 1.0, Vec3d(0.0)).find("the atom name D1234"), std::string::npos);
    EXPECT_NE(refused(residue, 1.0, Vec3d(0.0)).find("the residue name MOHA"), std::string::npos);
}

} // namespace
} // namespace molsurf
