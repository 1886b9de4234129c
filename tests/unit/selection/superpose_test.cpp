// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/superpose.h"

#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/structure/read_structure.h"
#include "unit/structure/temp_file.h"

namespace molsurf::test
{
namespace
{

using openvdb::Vec3d;

/// A line of an atom of a PDB file; the letter of its location may be ' '.
std::string line(const char* name, char location, char chain, int number, const Vec3d& x,
                 double occupancy)
{
    static int serial = 0;
    return formatted("ATOM  %5d  %-3s%cGLY %c%4d    %8.3f%8.3f%8.3f%6.2f  0.00           %c\n",
                     ++serial % 10000, name, location, chain, number, x[0], x[1], x[2], occupancy,
                     name[0]);
}

// Of the locations of an atom that with the most counts, the first of equal ones, in any order.
TEST(Anchors, AreTheLocationsWithTheMost)
{
    for (const bool isFirst : {false, true}) {
        const std::string more = line("CA", isFirst ? 'A' : 'B', 'A', 1, {1, 0, 0}, 0.7),
                          less = line("CA", isFirst ? 'B' : 'A', 'A', 1, {9, 0, 0}, 0.3);
        const std::string text = (isFirst ? more + less : less + more) +
                                 line("CA", 'A', 'A', 2, {5, 0, 0}, 0.5) +
                                 line("CA", 'B', 'A', 2, {6, 0, 0}, 0.5) +
                                 line("CB", ' ', 'A', 2, {7, 0, 0}, 1.0) + "END\n";
        const Structure s = parseStructure(text, "a.pdb");
        const Anchors found = anchorsOf(s, {"auto", ""}, 0);
        ASSERT_EQ(found.atoms.size(), 2u);
        EXPECT_EQ(found.atoms.at(AtomKey("A", 1, ' ', "CA"))[0], 1.0) << isFirst;
        EXPECT_EQ(found.atoms.at(AtomKey("A", 2, ' ', "CA"))[0], 5.0);
        EXPECT_EQ(anchorsOf(s, {"name CB", ""}, 0).atoms.size(), 1u);
        EXPECT_EQ(anchorsOf(s, {"auto", "resid 2"}, 0).atoms.size(), 1u);
        EXPECT_HAS(errorOf(ErrorKind::Input,
                           [&] {
                               anchorsOf(s, {"auto", "name CB"}, 0);
                           }),
                   "there is no CA or C4'");
    }
}

// Names of chains do not count between two chains, and do between more.
TEST(Anchors, OfOneChainFitThoseOfAnother)
{
    const auto chain = [](char name, double shift, int from) {
        std::string text;
        for (int i = 0; i < 4; ++i)
            text +=
                line("CA", ' ', name, from + i, {shift + 3.0 * i, 2.0 * (i % 2), 1.0 * i * i}, 1.0);
        return text;
    };
    const auto anchors = [](const std::string& text) {
        return anchorsOf(parseStructure(text + "END\n", "a.pdb"), {"auto", ""}, 0);
    };
    const Anchors one = anchors(chain('A', 0.0, 1)), other = anchors(chain('B', 10.0, 1)),
                  later = anchors(chain('A', 10.0, 3)),
                  both = anchors(chain('A', 5.0, 1) + chain('B', 10.0, 1));
    EXPECT_EQ(superpositionOf(one, other).pairs, 4u);
    EXPECT_NEAR((superpositionOf(one, other).placed(Vec3d(1, 2, 3)) - Vec3d(11, 2, 3)).length(),
                0.0, 1e-9);
    EXPECT_NEAR(superpositionOf(one, both).placed(Vec3d(0.0))[0], 5.0, 1e-9);
    EXPECT_HAS(errorOf(ErrorKind::Input, [&] { superpositionOf(one, later); }), "got 2");
}

} // namespace
} // namespace molsurf::test
